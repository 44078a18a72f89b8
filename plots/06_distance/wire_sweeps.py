"""Tension errors of a wire against sweeps, and its stretch when the sweeps are too few."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "A hanging wire needs many sweeps; with fewer it is elastic"
K = 1e8  # of the wires that are hung [N/m]


def draw(data, mine):
    figure, (tension, stretch) = figures.new(columns=2)
    _tensions(tension, data.table.only("what", "tension"))
    _stretches(stretch, data.table.only("what", "stretch"))
    if mine:
        some = mine.table.only("what", "tension")
        tension.plot(some["sweeps"], some["value"], **figures.MINE)
        some = mine.table.only("what", "stretch")
        stretch.plot(some["sweeps"], some["value"], **figures.MINE)
    for axes in (tension, stretch):
        figures.tidy(axes)
        axes.legend(fontsize=8, loc="lower left")
    return figure


def _tensions(axes, table):
    for (links, ratio), style in zip(_wires(table), figures.STYLES):
        some = table.only("links", links).only("ratio", ratio)
        axes.plot(some["sweeps"], some["value"], label=f"{links:g} links, {ratio:g}:1",
                  markevery=max(1, len(some.rows) // 12), **style)
        if ratio == 1:
            rate = math.cos(math.pi / (2 * links)) ** 2
            last = some["sweeps"][-1]
            line = [0.5 * last, last]
            axes.plot(line, [some["value"][-1] * 3 * rate ** (n - last) for n in line], color="#777777", linewidth=1)
    axes.plot([], [], color="#777777", linewidth=1, label="slope of cos²(π/(2N))")
    axes.set(xscale="log", yscale="log", xlabel="sweeps", ylabel="tension error, over that of the top", title="one solve")


def _stretches(axes, table):
    for (links, ratio), style in zip(_wires(table), figures.STYLES):
        some = table.only("links", links).only("ratio", ratio)
        axes.plot(some["sweeps"], some["value"], label=f"{links:g} links, {ratio:g}:1", **style)
        right = sum(ratio + links - k for k in range(1, int(links) + 1)) * 9.81 / K
        axes.axhline(right, color=style["color"], linestyle=style["linestyle"], linewidth=0.8)
    axes.annotate("ΣT/k: right", (2500, right), xytext=(0, 4), textcoords="offset points", fontsize=8)
    figures.slope(axes, -1, (300, 3000), 12, "-1")
    axes.set(xscale="log", yscale="log", ylim=(1e-7, 1e3), xlabel="sweeps in each step", ylabel="stretch, over the length",
             title="10 s, h = 1/60 s")


def _wires(table):
    return sorted(set(zip(table["links"], table["ratio"])))


if __name__ == "__main__":
    figures.main(draw, TITLE)
