"""./course run --sweep: the same scene with other values, one table row for each."""

import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import grid
from grid import ORDERED, SEED, Fit, Mean, Row, columns, number
from terminal import counted, fold

RESULTS = ("error", "error_name", "unit", "state", "why", "note", "residual", "us_per_step", "row_updates", "steps",
           "time", "order")  # columns of --csv beside those of a point, and h


@dataclass(frozen=True)
class Result:
    point: Mapping[str, str]  # what is swept, as typed
    run: dict | None  # as run --json prints it; None for a run that did not get to its end
    why: str  # it did not


@dataclass(frozen=True)
class Sweep:
    axes: Mapping[str, Sequence[str]]
    results: list[Result]
    skipped: list[Result]  # combinations that the engine refuses, and why
    shard: str = ""  # "1/2" of a part

    def rows(self) -> list[Row]:
        return [_row(result) for result in self.results]

    def orders(self) -> list[tuple[float | None, float | None]]:
        """Returns for each run the ratio of errors, and the order."""
        return grid.orders(self.rows(), self.axes)

    def means(self) -> list[Mean]:
        return grid.means(self.rows(), self.axes) if len(self.axes.get(SEED, ())) > 1 else []

    def fits(self) -> list[Fit]:
        return grid.fits(self.rows(), self.axes)

    def names(self) -> list[str]:
        """Returns the names of the table's columns, which a table without rows has, too."""
        return list(columns(dict.fromkeys(self.axes), RESULTS) | dict.fromkeys((*RESULTS, "h")))

    def table(self) -> list[dict[str, Any]]:
        """Returns a flat row for each run, for --csv: its values as typed, but h in seconds; its numbers; its state."""
        h = next((result.run["h"] for result in self.results if result.run), None)  # of all runs, where it is not swept
        return [columns(result.point, RESULTS) | _numbers(result) | {"order": order, "h": _step(result, h)}
                for result, (_, order) in zip(self.results, self.orders())]


def _row(result: Result) -> Row:
    run = result.run
    if run is None:
        return Row(result.point, None, "lost")
    return Row(result.point, run["error"]["value"], run["state"]["name"], run["time"], grid.round_off(run["steps"]))


def _numbers(result: Result) -> dict[str, Any]:
    """Returns the columns of RESULTS."""
    run = result.run
    if run is None:
        return dict.fromkeys(RESULTS) | {"state": "lost", "why": result.why}
    return dict.fromkeys(RESULTS) | {
        "error": run["error"]["value"], "error_name": run["error"]["name"], "unit": run["error"]["unit"],
        "state": run["state"]["name"], "why": run["state"]["reason"], "note": run["state"].get("note", "")} | {
        name: run[name] for name in ("residual", "us_per_step", "row_updates", "steps", "time")}


def _step(result: Result, h: float | None) -> float | None:
    """Returns the step of a run [s]. A run that blew up has that of its point, or that of the other runs."""
    if result.run is None:
        return number(result.point["h"]) if "h" in result.point else h
    return result.run["h"]


def result_of(scene: str, point: Mapping[str, str], row: Mapping[str, str]) -> Result:
    """Returns the result of a run from its row in the table of a sweep."""
    if not row.get("steps"):  # it did not get to its end
        return Result(point, None, row["why"])
    numbers = {name: number(row[name]) if row[name] else None for name in ("error", "h", "residual", "us_per_step", "time")}
    counts = {name: int(row[name]) for name in ("row_updates", "steps")}
    error = {"name": row["error_name"], "value": numbers["error"], "unit": row["unit"]}
    return Result(point, numbers | counts | {"scene": scene, "error": error, "state": {
        "name": row["state"], "reason": row["why"], "note": row["note"]}}, "")


def skipped_points(skipped: Sequence[Result]) -> list[dict[str, Any]]:
    """Returns each combination that the engine refuses, and why, as --json and the manifest of a table have them."""
    return [{"point": dict(one.point), "why": one.why} for one in skipped]


def as_json(sweep: Sweep) -> str:
    runs = [{"point": dict(result.point), "observed_order": order, "why": result.why or None}
            | (result.run or {}) for result, (_, order) in zip(sweep.results, sweep.orders())]
    return json.dumps({"sweep": {name: list(values) for name, values in sweep.axes.items()}, "runs": runs,
                       "skipped": skipped_points(sweep.skipped),
                       "means": [{"point": mean.point, "runs": mean.runs, "unsolved": mean.unsolved, "lost": mean.lost,
                                  "mean": mean.mean, "half_width": mean.half_width, "observed_order": order}
                                 for mean, order in zip(sweep.means(), grid.mean_orders(sweep.means()))],
                       "fits": [{"point": fit.point, "runs": fit.runs, "order": fit.order, "half_width": fit.half_width}
                                for fit in sweep.fits()]}, ensure_ascii=False)


def as_text(sweep: Sweep) -> str:
    ended = next((result.run for result in sweep.results if result.run), None)
    lost = [f"{named(result.point)}: {result.why}" for result in sweep.results if result.why]
    if ended is None:
        return "\n".join([*_after(lost), *_skipped(sweep.skipped)]).strip()
    unit = ended["error"]["unit"]
    about = fold(f"{ended['scene']}: {ended['error']['name']}{f' [{unit}]' if unit else ''}")
    return "\n".join([about, "", *_runs(sweep), *_order_note(sweep), *_mean_lines(sweep), *_fit_lines(sweep),
                      *_after(lost),
                      *_skipped(sweep.skipped)]).rstrip()


def _runs(sweep: Sweep) -> list[str]:
    rows = sweep.rows()
    shows_state = any(result.run and row.state != "sound" for result, row in zip(sweep.results, rows))
    lines = [_head(sweep.axes, "error", "ratio", "order", "state", "residual [m/s]", "µs a step")]
    for result, row, (ratio, order) in zip(sweep.results, rows, sweep.orders()):
        run = result.run or {}
        lines.append([*result.point.values(), _shown(row.error, "none" if run else "lost"),
                      _shown(ratio, "", ".3g"), _shown(order, "", ".2f"), row.state if shows_state and run else "",
                      _shown(run.get("residual"), "", ".2g"), _shown(run.get("us_per_step"), "", ".3g")])
    return _aligned(lines, kept=len(sweep.axes) + 1, left=len(sweep.axes))


def _head(names: Collection[str], *results: str) -> list[str]:
    """Returns the first line of a table."""
    return [*columns(dict.fromkeys(names), results), *results]


def _order_note(sweep: Sweep) -> list[str]:
    """Returns lines about orders, and about errors that show none."""
    name = next((name for name in ORDERED if name in sweep.axes), None)
    if name is None:
        return []
    notes = []
    if any(order is not None for _, order in sweep.orders()):
        rest = ", all else equal" if len(sweep.axes) > 1 else ""
        notes.append(f"order p: the error is proportional to {name}^p; computed from each row and the row before{rest}")
    if any(row.at_round_off for row in sweep.rows()):
        notes.append("no order where an error is at round-off, that is, at most 4 units in the last place for each step")
    if ends := grid.uneven(sweep.rows(), sweep.axes):
        notes.append(f"no order between runs that end at different times, from {ends[0]:.4g} to {ends[1]:.4g} s: "
                     "choose a time that is a multiple of each h")
    return [part for note in notes for part in ("", *fold(note).splitlines())]


def _mean_lines(sweep: Sweep) -> list[str]:
    found = sweep.means()
    if not found:
        return []
    lines = [_head(found[0].point, "runs", "mean error", "±", "order", "unsolved", "lost")]
    for mean, order in zip(found, grid.mean_orders(found)):
        lines.append([*mean.point.values(), str(mean.runs), _shown(mean.mean, "none"), _shown(mean.half_width, "", ".2g"),
                      _shown(order, "", ".2f"), str(mean.unsolved or ""), str(mean.lost or "")])
    lost = "; lost runs are left out" if any(mean.lost for mean in found) else ""
    part = f" of shard {sweep.shard}" if sweep.shard else ""
    return ["", *fold(f"mean over seeds{part}, with its 95 % confidence interval{lost}").splitlines(), "",
            *_aligned(lines, kept=len(lines[0]) - 3, left=len(found[0].point))]


def _fit_lines(sweep: Sweep) -> list[str]:
    found = sweep.fits()
    if not found:
        return []
    part = f" of shard {sweep.shard}" if sweep.shard else ""
    lines = [_head(found[0].point, "runs", "order", "±")]
    lines += [[*fit.point.values(), str(fit.runs), _shown(fit.order, "", ".2f"), _shown(fit.half_width, "", ".2g")]
              for fit in found]
    told = f"order of all runs{part}, by a straight line in log(error), with its 95 % confidence interval"
    return ["", *fold(told).splitlines(), "",
            *_aligned(lines, kept=len(lines[0]), left=len(found[0].point))]


def _skipped(skipped: list[Result]) -> list[str]:
    if not skipped:
        return []
    reasons: dict[str, int] = {}
    for one in skipped:
        reasons[one.why] = reasons.get(one.why, 0) + 1
    lines = [f"{counted(count, 'combination')} skipped: {why}" for why, count in reasons.items()]
    return ["", *[part for line in lines for part in fold(line).splitlines()]]


def _after(lost: list[str]) -> list[str]:
    return ["", *[part for line in lost for part in fold(line).splitlines()]] if lost else []


def named(point: Mapping[str, str]) -> str:
    return ", ".join(f"{name} = {value}" for name, value in point.items())


def _aligned(rows: list[list[str]], kept: int, left: int) -> list[str]:
    """Returns lines of a table: the first `kept` columns, and others with content; the first `left` to the left."""
    columns = [k for k in range(len(rows[0])) if k < kept or any(row[k] for row in rows[1:])]
    widths = {k: max(len(row[k]) for row in rows) for k in columns}
    return ["  ".join(row[k].ljust(widths[k]) if k < left else row[k].rjust(widths[k]) for k in columns).rstrip()
            for row in rows]


def _shown(value: float | None, otherwise: str, form: str = ".4g") -> str:
    if value is None:
        return otherwise
    text = format(value, form)
    return text.removeprefix("-") if text.strip("-0.") == "" else text  # no -0.00
