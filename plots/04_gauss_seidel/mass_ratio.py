"""Errors against sweeps, for mass ratios; lines are the prediction."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "With a heavy body on a light one each sweep removes a small part of the error"


def draw(data, mine):
    figure, axes = figures.new(height=4.2)
    for ratio, style in zip(data.table.values("ratio"), figures.STYLES):
        top = data.table.only("ratio", ratio).only("heavy", "on top")
        marks = style | {"linestyle": "none"}
        axes.plot(top["sweeps"], top["error"], **marks)
        axes.annotate(f"{figures.number(ratio)}:1", (top["sweeps"][-1], 1e-6), xytext=(0, -14),
                      textcoords="offset points", ha="center", fontsize=9)
        curve = [10 ** (k / 40) for k in range(0, 301)]
        rate = 1 / (1 + 1 / ratio)
        shown = [(n, rate**n) for n in curve if rate**n > 1e-6]
        axes.plot(*zip(*shown), color=style["color"], linestyle=style["linestyle"], linewidth=1.2)
    below = data.table.only("ratio", 1000).only("heavy", "below")
    axes.plot(below["sweeps"], below["error"], color="#777777", marker="+")
    axes.annotate("1:1000", (below["sweeps"][-1], 1e-6), xytext=(0, -14), textcoords="offset points",
                  ha="center", fontsize=9)
    harmonic = [1, 1e6]
    axes.plot(harmonic, [1 / n for n in harmonic], color="#BBBBBB", linewidth=1)
    axes.annotate("1/N", (2e5, 5e-6), xytext=(6, 4), textcoords="offset points", fontsize=9)
    if mine:
        top = mine.table.only("heavy", "on top")
        axes.plot(top["sweeps"], top["error"], **figures.MINE)
        axes.legend(loc="upper right")
    axes.set(xscale="log", yscale="log", ylim=(3e-7, 2), xlabel="sweeps",
             ylabel="error of the impulse between them, relative")
    figures.tidy(axes)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
