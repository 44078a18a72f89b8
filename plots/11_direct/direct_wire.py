"""Errors over time on a wire, times over links, and factorisations where bounds hold."""

import sys
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "The direct solver reaches round-off in the time of a few sweeps"


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
    """Draws medians and the whole range of the draws with an active bound, and the others one by one."""
    for ratio, style in zip(table.values("ratio"), figures.STYLES):
        some, name = table.only("ratio", ratio), f"{figures.number(ratio)}:1"
        sizes = some.values("size")
        counts = [_counts(some.only("size", size)) for size in sizes]
        axes.plot(sizes, [median(held) for held, _ in counts], label=name, **style)
        axes.fill_between(sizes, [min(held) for held, _ in counts], [max(held) for held, _ in counts],
                          color=style["color"], alpha=0.15, linewidth=0)
        free = [(size, count) for size, (_, ones) in zip(sizes, counts) for count in ones]
        if free:
            axes.plot(*zip(*free), label=f"{name}, no bound holds",
                      **style | {"linestyle": "none", "fillstyle": "none"})
    axes.set(xscale="log", ylim=(0, 50), xlabel="boxes", ylabel="factorisations",
             title="friction boxes, to 10⁻⁶ m/s")
    axes.legend(fontsize=8, loc="upper left")


def _counts(table):
    """Returns the factorisations of the draws with an active bound, and of those without."""
    draws = list(zip(table["value"], table["held"]))
    return [count for count, held in draws if held > 0], [count for count, held in draws if held == 0]


if __name__ == "__main__":
    figures.main(draw, TITLE)
