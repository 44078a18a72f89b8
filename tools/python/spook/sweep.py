"""Runs a scene with every combination of some options and parameters."""

from __future__ import annotations

import difflib
import html
import math
import os
import sys
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import Any, Iterable, Iterator

import numpy as np

from . import grid, manifest
from ._spook import SimulationDiverged
from .scene import OPTIONS, Scene

RESULTS = ("error", "order", "state", "us_per_step", "seconds", "steps", "row_updates", "unsolved_steps", "why", "note")
_OF_FITS = ("runs", "order", "half_width")
_OF_MEANS = ("runs", "unsolved", "lost", "mean", "half_width", "order")
_SENTENCES = ("why", "note")  # columns that a printed table leaves out


class Table:
    """Rows, each a dict. `table["error"]` is a column; pandas.DataFrame(table.rows) converts it.

    `skipped` has a dict for each refused combination, with the reason as "why".
    """

    def __init__(self, rows: list[dict[str, Any]], names: Iterable[str] = (), skipped: list[dict[str, Any]] | None = None,
                 made: tuple[str, str] | None = None):
        self.rows = rows
        self.skipped = skipped or []
        self._names = tuple(names)  # what is swept
        self._made = made  # the call and the scene's name, for the manifest

    @property
    def columns(self) -> list[str]:
        return list(self.rows[0]) if self.rows else []

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self.rows)

    def __getitem__(self, column: str) -> np.ndarray:
        if column not in self.columns:
            raise KeyError(f"{column!r} is no column; there are: {', '.join(self.columns)}")
        return np.array([row[column] for row in self.rows])

    def where(self, **values: Any) -> Table:
        """Returns the rows with these values: table.where(solver="direct", h="1/60"). Numbers may be typed or
        computed."""
        for name in values:
            if self.rows and name not in self.columns:
                raise KeyError(f"{name!r} is no column; there are: {', '.join(self.columns)}")
        rows = [row for row in self.rows if all(grid.same(row[name], value) for name, value in values.items())]
        return Table(rows, self._names, made=self._made)

    def means(self, over: str = grid.SEED) -> Table:
        """Returns the mean error over seeds, or another name, for each other combination.

        Columns: `runs`, how many of them are `unsolved`, how many `lost` ones are left out, `mean`, `half_width`, and
        the `order` of the means.
        half_width is that of the 95 % confidence interval of the mean, if errors are normally distributed; NaN for
        fewer than two runs. Runs without an error are left out, too. Raises KeyError for a name that is not swept.
        """
        if over not in self._names:
            raise KeyError(f"{over!r} is not swept; swept are: {', '.join(self._names)}")
        found = grid.means(self._runs(), self._names, over)
        return Table([{**grid.columns(mean.point, _OF_MEANS), "runs": mean.runs, "unsolved": mean.unsolved,
                       "lost": mean.lost, "mean": _or_nan(mean.mean), "half_width": _or_nan(mean.half_width),
                       "order": _or_nan(order)}
                      for mean, order in zip(found, grid.mean_orders(found))], made=self._made)

    def fits(self) -> Table:
        """Returns the order by a line through log(error) over log(h), or else d, or else k, for each other combination.

        Columns: `runs`, `order`, and `half_width` of its 95 % confidence interval. All seeds are in one line. Lost runs
        and errors at round-off are left out. So are combinations with fewer than three values of h, or with runs that
        end at different times.
        """
        return Table([{**grid.columns(fit.point, _OF_FITS), "runs": fit.runs, "order": fit.order,
                       "half_width": fit.half_width} for fit in grid.fits(self._runs(), self._names)], made=self._made)

    def _runs(self) -> list[grid.Row]:
        columns = grid.columns({name: name for name in self._names}, RESULTS)
        return [_run_of({name: row[column] for column, name in columns.items()}, row) for row in self.rows]

    def to_csv(self, file: str | os.PathLike) -> None:
        """Writes a line of column names and a line for each row, and FILE.manifest.json with the call, versions and
        machine. Raises OSError."""
        grid.write_csv(file, self.rows)
        self._write_manifest(file)

    def to_parquet(self, file: str | os.PathLike) -> None:
        """Writes a column for each name, and a manifest as to_csv. Raises OSError; ImportError without the package
        pyarrow."""
        grid.write_parquet(file, self.rows)
        self._write_manifest(file)

    def _write_manifest(self, file: str | os.PathLike) -> None:
        if self._made:
            manifest.write(file, *self._made)

    def __repr__(self) -> str:
        lines = self._lines()
        widths = [max(map(len, column)) for column in zip(*lines)]
        table = "\n".join("  ".join(word.rjust(width) for word, width in zip(line, widths)) for line in lines)
        return table + (f"\n{len(self.skipped)} combinations skipped: see skipped" if self.skipped else "")

    def _repr_html_(self) -> str:
        def line(words: Iterable[str], tag: str) -> str:
            return "<tr>" + "".join(f"<{tag}>{html.escape(word)}</{tag}>" for word in words) + "</tr>"

        head, *rows = self._lines()
        body = "".join(line(row, "td") for row in rows)
        return f"<table>{line(head, 'th')}{body}</table>"

    def _lines(self) -> list[list[str]]:
        """Returns the cells of a printed table: its names, and its rows."""
        shown = [name for name in self.columns if name not in _SENTENCES]
        return [shown, *([_short(row[name]) for name in shown] for row in self.rows)]


def sweep(scene: Scene | str, *, jobs: int | None = None, progress: bool = True, **lists: Any) -> Table:
    """Runs the scene with every combination of the listed values, on all cores, or on so many.

    The scene is a Scene, or a name of scenes(). A name is a parameter of the scene, or else an option of Scene.run; its
    value a list, or one value. A row has these, and:

        h             as a number [s]
        error         against the known answer
        order         observed, from the last row where only h (or else d, or k) differs: log(e/e')/log(h/h'). NaN if
                      an error is at round-off, or the two runs end at different times
        state         sound, unsolved, lost, or blew up
        us_per_step   [µs]; while other cores run, more than alone. jobs=1 measures speed
        seconds       the time to compute the run [s]
        steps         their number
        row_updates   the same cost on every machine
        unsolved_steps, why, note   as in a Run: why is its reason

    A parameter of a file with the name of one of these has a column with "=" after its name.

    Refused combinations are skipped: the table's `skipped` has them. Raises ValueError, before any run, for a
    value that every combination refuses.
    """
    if isinstance(scene, str):
        scene = Scene(scene)
    if not isinstance(scene, Scene):
        raise TypeError(f"sweep: scene: a Scene or a name, got {scene!r}")
    _require_known(scene, lists)
    axes = {name: list(value) if isinstance(value, (list, tuple, range, np.ndarray)) else [value]
            for name, value in lists.items()}
    for name, values in axes.items():
        if not values:
            raise ValueError(f"{name} must have at least one value, but the list is empty")
    points = grid.combinations(axes)
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs must be at least 1, but is {jobs}")
    prepared = [_prepared(scene, point) for point in points]
    refusals = [run if isinstance(run, str) else "" for run in prepared]
    if why := grid.impossible_value(points, refusals) or (all(refusals) and next(iter(refusals), "")):
        raise ValueError(why)
    asked = [(point, run) for point, run in zip(points, prepared) if not isinstance(run, str)]
    with ThreadPoolExecutor(jobs or _processors()) as pool:
        futures = [pool.submit(_row, *run) for _, run in asked]
        try:
            for done, _ in enumerate(as_completed(futures), 1):
                _tell(done, len(futures), progress)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    rows = [{**grid.columns(point, RESULTS), **future.result()} for (point, _), future in zip(asked, futures)]
    runs = [_run_of(point, row) for (point, _), row in zip(asked, rows)]
    for row, (_, order) in zip(rows, grid.orders(runs, axes)):
        row["order"] = _or_nan(order)
    named = ", ".join(f"{name}={values!r}" for name, values in axes.items())
    skipped = [{**grid.columns(point, RESULTS), "why": why} for point, why in zip(points, refusals) if why]
    return Table(rows, axes, skipped, (f"spook.sweep({scene!r}, {named})", scene.name))


def _require_known(scene: Scene, names: Iterable[str]) -> None:
    known = [*scene.about["parameters"], *OPTIONS]
    for name in names:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise ValueError(f"{name} is neither a parameter of {scene.name} nor an option of run; "
                             + (f"did you mean {near[0]}?" if near else f"there are: {', '.join(known)}"))


def _processors() -> int:
    """Returns the number of processors for this process; macOS only reports the total."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _prepared(scene: Scene, point: dict[str, Any]) -> tuple[Scene, dict[str, Any]] | str:
    """Returns the scene and options of a run, or the reason why they are refused."""
    options = {name: value for name, value in point.items() if name in OPTIONS and name not in scene.about["parameters"]}
    try:
        changed = scene.with_parameters(**{name: value for name, value in point.items() if name not in options})
        changed.check(options)
    except ValueError as error:
        return str(error)
    return changed, options


def _row(scene: Scene, options: dict[str, Any]) -> dict[str, Any]:
    none = dict.fromkeys(("h", *RESULTS), math.nan) | {"why": "", "note": ""}
    try:
        run = scene.run_with(options)
    except SimulationDiverged as diverged:
        return none | {"h": grid.number(options.get("h", scene.about["h"])), "state": "blew up", "why": str(diverged)}
    return none | {"h": run.h, "error": run.error, "state": run.state, "us_per_step": _or_nan(run.us_per_step),
                   "seconds": run.seconds, "steps": run.steps, "row_updates": run.row_updates,
                   "unsolved_steps": run.unsolved_steps, "why": run.reason, "note": run.note}


def _run_of(point: dict[str, Any], row: dict[str, Any]) -> grid.Row:
    """Returns a row of a sweep's table as orders and means take it. The steps of a run that blew up are not known."""
    steps = row["steps"]
    end = None if math.isnan(steps) else steps * row["h"]
    return grid.Row(point, row["error"], row["state"], end, grid.round_off(steps))


def _or_nan(number: float | None) -> float:
    return math.nan if number is None else number


def _tell(done: int, of: int, progress: bool) -> None:
    if progress and (sys.stderr.isatty() or "ipykernel" in sys.modules):
        print(f"\r{done} of {of} runs" + ("\n" if done == of else ""), end="", file=sys.stderr, flush=True)


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
