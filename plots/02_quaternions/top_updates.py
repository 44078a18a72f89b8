"""Errors of three updates against the number of steps and against their time."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Only the splitting turns an asymmetric top with second-order accuracy"
ERROR = "error [rad]"


def draw(data, mine):
    figure, (steps, time) = figures.new(columns=2, sharey=True)
    for method, style in zip(data.table.values("method"), figures.STYLES):
        some = data.table.only("method", method)
        steps.plot(some["steps"], some[ERROR], label=method, **style)
        time.plot(_microseconds(some), some[ERROR], **style)
    if mine:
        steps.plot(mine.table["steps"], mine.table[ERROR], **figures.MINE)
        time.plot(_microseconds(mine.table), mine.table[ERROR], **figures.MINE)
    figures.slope(steps, -1, (2000, 10000), 2.5e-3, "-1")
    figures.slope(steps, -2, (2000, 10000), 6e-7, "-2")
    steps.set(xlabel="steps", ylabel="error of the orientation [rad]")
    time.set(xlabel="time to compute 10 s [µs], median")
    for axes in (steps, time):
        axes.set(xscale="log", yscale="log")
        figures.tidy(axes)
    steps.legend(loc="lower left")
    return figure


def _microseconds(table):
    return [count * ns / 1000 for count, ns in zip(table["steps"], table["ns a step"])]


if __name__ == "__main__":
    figures.main(draw, TITLE)
