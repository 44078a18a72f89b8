"""Errors over time on a wire, times over links, and factorisations where bounds hold."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "The direct solver: as exact as numbers are, for the time of a few sweeps"


def draw(data, mine):
    figure, (errors, times, bounds) = figures.new(columns=3, height=3.9)
    _errors(errors, data.table)
    _times(times, data.table)
    _bounds(bounds, data.table.only("what", "bounds"))
    if mine:
        some = mine.table.only("what", "direct")
        errors.plot(some["us"], some["value"], **figures.MINE)
        some = mine.table.only("what", "direct by links")
        times.plot(some["size"], some["us"], **figures.MINE)
        some = mine.table.only("what", "bounds")
        bounds.plot(some["size"], some["value"], **figures.MINE)
    for axes in (errors, times, bounds):
        figures.tidy(axes)
    return figure


def _errors(axes, table):
    for ratio, style in zip(table.only("what", "direct").values("ratio"), figures.STYLES):
        swept = table.only("what", "sweeps").only("ratio", ratio)
        axes.plot(swept["us"], swept["value"], label=f"sweeps, {figures.number(ratio)}:1", markevery=5, **style)
        at_once = table.only("what", "direct").only("ratio", ratio)
        axes.plot(at_once["us"], at_once["value"], label=f"direct, {figures.number(ratio)}:1",
                  **style | {"linestyle": "none", "markersize": 11, "fillstyle": "none"})
    axes.set(xscale="log", yscale="log", xlabel="time [µs]", ylabel="largest relative error of an impulse",
             title="100 links, one solve")
    axes.legend(fontsize=7.5, loc="center left")


def _times(axes, table):
    names = {"direct by links": "direct", "a sweep": "one sweep"}
    for (what, name), style in zip(names.items(), figures.STYLES):
        some = table.only("what", what)
        axes.plot(some["size"], some["us"], label=name, **style)
    figures.slope(axes, 1, (1e3, 3e4), 3, "1")
    axes.set(xscale="log", yscale="log", xlabel="links", ylabel="time [µs]", title="a wire, 1000:1")
    axes.legend(fontsize=8, loc="upper left")


def _bounds(axes, table):
    for ratio, style in zip(table.values("ratio"), figures.STYLES):
        some = table.only("ratio", ratio)
        axes.plot(some["size"], some["value"], label=f"{figures.number(ratio)}:1", **style)
    axes.set(xscale="log", ylim=(0, 50), xlabel="boxes", ylabel="factorisations", title="friction boxes, to 10⁻⁶ m/s")
    axes.legend(fontsize=8, loc="upper right")


if __name__ == "__main__":
    figures.main(draw, TITLE)
