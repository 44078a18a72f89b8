"""The box's strength and reach by direction, and the steepest slope that it holds."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "The friction box is √2 too strong along its diagonals, and right on a slope"
ANGLE = "angle [rad]"


def draw(data, mine):
    figure, grid = figures.new(columns=3, height=3.4, polar=2)
    push, distance, slope = grid
    for axes, what, title in ((push, "push", "push that moves it, μ m g = 1"),
                              (distance, "distance", "way to a stop, v²/(2μg) = 1")):
        some = data.table.only("what", what)
        unit = 0.5 if what == "push" else 1.0
        closed = [*some[ANGLE], 2 * math.pi]
        axes.plot(closed, [1] * len(closed), color="#777777", linestyle="--", linewidth=1)
        axes.plot(closed, [value / unit for value in [*some["predicted"], some["predicted"][0]]],
                  color=figures.STYLES[0]["color"])
        axes.plot(some[ANGLE], [value / unit for value in some["value"]], color=figures.STYLES[1]["color"],
                  linestyle="none", marker="s", markersize=3)
        if mine:
            own = mine.table.only("what", what)
            axes.plot(own[ANGLE], [value / unit for value in own["value"]], **figures.MINE)
        axes.set_title(title, pad=10)
        axes.set_rmax(1.5)
        axes.set_rticks([0.5, 1], [])
        axes.set_xticks([k * math.pi / 4 for k in range(8)])
        axes.tick_params(labelsize=8)
        axes.grid(color=figures.FAINT, linewidth=0.6)

    some = data.table.only("what", "slope")
    degrees = [math.degrees(angle) for angle in some[ANGLE]]
    slope.plot(degrees, some["predicted"], color=figures.STYLES[0]["color"], label="predicted")
    slope.plot(degrees, some["value"], color=figures.STYLES[1]["color"], linestyle="none", marker="s", markersize=4,
               label="measured")
    if mine:
        own = mine.table.only("what", "slope")
        slope.plot([math.degrees(angle) for angle in own[ANGLE]], own["value"], **figures.MINE)
    slope.plot([], [], color="#777777", linestyle="--", linewidth=1, label="Coulomb, where it differs")
    slope.set(title="μ that holds a slope", xlabel="θ [degrees]", ylabel="μ", yscale="log")
    slope.legend(loc="lower right", fontsize=8)
    figures.tidy(slope)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
