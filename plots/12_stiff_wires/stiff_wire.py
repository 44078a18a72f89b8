"""Energy of a swinging wire, its links' errors against the load, and its loss and its path's error against the step."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "With h²K on the change of velocity, a swinging wire is stable and keeps its energy"
NAMES = {"change": "K on the change", "velocity": "K on the velocity", "none": "no K"}
RATES = (480, 240, 120, 60, 30)
TOP = 3  # where what is lost is drawn


def draw(data, mine):
    figure, ((energy, ratio), (loss, path)) = figures.new(columns=2, rows=2, height=6.6)
    _energies(energy, data.table.only("what", "energy"))
    _ratios(ratio, data.table.only("what", "ratio"))
    steps = data.table.only("what", "step").only("ratio", 1000)
    _steps(loss, steps, "value", 8e-6, 4e-3)
    loss.set(ylabel="energy lost, over m g l (1 - cos 30°)", title="loss of energy in 5 s, 1000:1")
    _steps(path, steps, "path or time", 3e-5, 5e-3)
    path.set(ylabel="largest error of the load's path [m]", title="path of the load in 5 s, 1000:1")
    if mine:
        own = mine.table.only("what", "energy").only("form", "change")
        energy.plot(own["path or time"], own["value"], markevery=25, **figures.MINE)
        own = mine.table.only("what", "step").only("ratio", 1000).only("form", "change")
        loss.plot(own["h"], own["value"], **figures.MINE)
        path.plot(own["h"], own["path or time"], **figures.MINE)
        own = mine.table.only("what", "ratio").only("form", "change")
        ratio.plot(own["ratio"], [min(value, TOP) for value in own["value"]], **figures.MINE)
    for axes, place in ((energy, "lower left"), (ratio, "center right"), (loss, "lower right"), (path, "lower right")):
        figures.tidy(axes)
        axes.legend(fontsize=8, loc=place)
    return figure


def _energies(axes, table):
    for (form, name), style in zip(NAMES.items(), figures.STYLES):
        some = table.only("form", form)
        axes.plot(some["path or time"], some["value"], label=name, **style | {"marker": ""})
        if some["highest or lost"][-1]:  # lost
            axes.plot(some["path or time"][-1], some["value"][-1], color=style["color"], marker="x", markersize=8)
    axes.set(ylim=(-0.16, 0.02), xlabel="t [s]", ylabel="energy gained, over m g l (1 - cos 30°)", title="1000:1, h = 1/60 s")


def _steps(axes, table, what, second, first):
    """Draws one column of the table against h, with lines of known slope that begin at these heights."""
    for form, style in zip(("change", "velocity"), figures.STYLES):
        some = table.only("form", form)
        axes.plot(some["h"], some[what], label=NAMES[form], **style)
    figures.slope(axes, 2, (1 / 480, 1 / 160), second, "2")
    figures.slope(axes, 1, (1 / 480, 1 / 160), first, "1")
    axes.set(xscale="log", yscale="log", xlabel="h [s]")
    axes.set_xticks([1 / rate for rate in RATES])
    axes.set_xticklabels([f"1/{rate}" for rate in RATES])
    axes.xaxis.set_minor_formatter(figures.NullFormatter())


def _ratios(axes, table):
    cases = (("change", 100, "100 links"), ("change", 10, "10 links"), ("quarter", 100, "100, h²K/4"))
    for (form, links, name), style in zip(cases, (figures.STYLES[0], figures.STYLES[2], figures.STYLES[3])):
        some = table.only("form", form).only("links", links)
        axes.plot(some["ratio"], [min(value, TOP) for value in some["value"]], label=name, **style)
    lag = (1 / 60) ** 2 * 2 * 9.81 * (1 - math.cos(math.pi / 6)) / 10 * 7 / 4
    axes.axhline(lag, color="#999999", linewidth=1)
    axes.annotate("h²ω²(1+2d)/4", (1, lag), xytext=(0, -11), textcoords="offset points", fontsize=8)
    axes.annotate("lost", (1, TOP), xytext=(0, -4), textcoords="offset points", fontsize=8)
    axes.set(xscale="log", yscale="log", ylim=(5e-5, 6), xlabel="load over a point's mass",
             ylabel="largest error of a link, over its length", title="h = 1/60 s, 5 s")


if __name__ == "__main__":
    figures.main(draw, TITLE)
