"""Error against time and against row updates: one line for each method and step, one point for each number of
sweeps."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Speed against error: a smaller error costs more work"


def draw(data, mine):
    figure, (time, updates) = figures.new(columns=2, sharey=True)
    shown = _with_a_place(data.table)
    for (name, h), style in zip(_lines(shown), figures.STYLES * len(shown.rows)):
        some = shown.only("line", name)
        some = some if h is None else some.only("h", h)
        label = name if h is None else f"{name}, h = {_step(h)}"
        cost = [us / step for us, step in zip(some["us a step"], some["h"])]
        spread = [[max(0, (us - low) / step) for us, low, step in zip(some["us a step"], some["quartile below"], some["h"])],
                  [max(0, (high - us) / step) for us, high, step in zip(some["us a step"], some["quartile above"], some["h"])]]
        time.errorbar(cost, some["error"], xerr=spread, capsize=2, **style | {"marker": ""})
        _marked(time, cost, some, label, style)
        if any(some["row updates a second"]):
            _marked(updates, some["row updates a second"], some, label, style)
    if mine:
        own = _with_a_place(mine.table)
        time.plot([us / step for us, step in zip(own["us a step"], own["h"])], own["error"], **figures.MINE)
        if any(own["row updates a second"]):
            updates.plot(own["row updates a second"], own["error"], **figures.MINE)
    time.set(xlabel="computing time for a second of motion [µs]", ylabel=f"error of {data.table['scene'][0]}, relative")
    updates.set(xlabel="row updates for a second of motion")
    for axes in (time, updates):
        axes.set(xscale="log", yscale="log")
        figures.tidy(axes)
    if hidden := len(data.table.rows) - len(shown.rows):
        time.plot([], [], linestyle="none", label=f"not drawn: {hidden} lost, or with an error of 0")
    if any(state != "sound" for state in shown["state"]):
        time.plot([], [], color=figures.INK, marker="o", linestyle="none", fillstyle="none",
                  label="hollow: not sound")
    time.legend(fontsize=8, title=str(data.table["all have"][0]) or None, title_fontsize=8)
    return figure


def _with_a_place(table):
    """Returns the rows that logarithmic axes can show: a run that diverged has no error and no cost."""
    errors, costs = table["error"], table["us a step"]
    return figures.Table(table.columns, [row for row, error, cost in zip(table.rows, errors, costs)
                                         if 0 < error < math.inf and cost > 0])


def _lines(table):
    """Returns lines by name and step; for methods without sweeps a line over h."""
    lines = list(dict.fromkeys(zip(table["line"], table["h"])))
    if len(lines) == len(table.rows):
        return [(name, None) for name in table.values("line")]
    return sorted(lines, key=lambda line: -line[1])


def _marked(axes, cost, some, label, style):
    """Draws a line with hollow points for runs that were not sound."""
    axes.plot(cost, some["error"], label=label, **style | {"fillstyle": "none"})
    sound = [k for k, state in enumerate(some["state"]) if state == "sound"]
    axes.plot([cost[k] for k in sound], [some["error"][k] for k in sound], **style | {"linestyle": "none"})


def _step(h):
    return f"1/{1 / h:.0f} s" if abs(1 / h - round(1 / h)) < 1e-6 and h < 1 else f"{h:.4g} s"


if __name__ == "__main__":
    figures.main(draw, TITLE)
