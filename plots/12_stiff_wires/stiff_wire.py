"""Energy of a swinging wire, its errors against the step, and its links' errors against the load."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "A wire that swings under a load, with h²K and without"
NAMES = {"change": "K on the change", "velocity": "K on the velocity", "none": "no K"}
TOP = 3  # where what is lost is drawn


def draw(data, mine):
    figure, (energy, step, ratio) = figures.new(columns=3, height=3.8)
    _energies(energy, data.table.only("what", "energy"))
    _steps(step, data.table.only("what", "step").only("ratio", 1000))
    _ratios(ratio, data.table.only("what", "ratio"))
    if mine:
        own = mine.table.only("what", "energy").only("form", "change")
        energy.plot(own["path or time"], own["value"], markevery=25, **figures.MINE)
        own = mine.table.only("what", "step").only("ratio", 1000).only("form", "change")
        step.plot(own["h"], own["value"], **figures.MINE)
        step.plot(own["h"], own["path or time"], **figures.MINE | {"label": None})
        own = mine.table.only("what", "ratio").only("form", "change")
        ratio.plot(own["ratio"], [min(value, TOP) for value in own["value"]], **figures.MINE)
    for axes in (energy, step, ratio):
        figures.tidy(axes)
        axes.legend(fontsize=8, loc="lower left" if axes is energy else "upper left" if axes is step else "center right")
    return figure


def _energies(axes, table):
    for (form, name), style in zip(NAMES.items(), figures.STYLES):
        some = table.only("form", form)
        axes.plot(some["path or time"], some["value"], label=name, **style | {"marker": ""})
        if some["highest or lost"][-1]:  # lost
            axes.plot(some["path or time"][-1], some["value"][-1], color=style["color"], marker="x", markersize=8)
    axes.set(ylim=(-0.16, 0.02), xlabel="t [s]", ylabel="energy gained, over m g l (1 - cos 30°)", title="1000:1, h = 1/60 s")


def _steps(axes, table):
    for form, style in zip(("change", "velocity"), figures.STYLES):
        some = table.only("form", form)
        axes.plot(some["h"], some["value"], label=f"loss, {NAMES[form]}", **style)
        axes.plot(some["h"], some["path or time"], label="path [m]", fillstyle="none", linewidth=0.9, **style)
    figures.slope(axes, 2, (1 / 480, 1 / 160), 8e-6, "2")
    figures.slope(axes, 1, (1 / 480, 1 / 160), 4e-3, "1")
    axes.set(xscale="log", yscale="log", ylim=(5e-6, 30), xlabel="h [s]", title="1000:1, 5 s")


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
