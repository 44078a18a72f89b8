"""Soft steps of large structures: operations for each cube, and how far pyramids sink."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "With soft steps a cube costs the same in any field, and pyramids stand"
COUNTS = {"updates": "row updates", "pairs": "pairs looked at", "contacts": "contacts"}
DEPTHS = {"tower": "a tower as high, (10.18)", "sunk": "a pyramid"}


def draw(data, mine):
    figure, axes = figures.new(columns=2, height=3.6)
    for part, names in zip(axes, (COUNTS, DEPTHS)):
        for style, (what, label) in zip(figures.STYLES, names.items()):
            some = data.table.only("what", what)
            part.plot(some["n"], some["value"], label=label, **style)
            if mine:
                own = mine.table.only("what", what)
                part.plot(own["n"], own["value"], **figures.MINE)
        part.legend(fontsize=8)
    axes[0].set(title="work in a step, for each cube", xlabel="cubes", xscale="log", yscale="log", ylim=(1, 1e3))
    axes[1].set(title="The top has sunk after 1,000 steps", xlabel="cubes in the lowest layer", ylabel="m",
                xscale="log", yscale="log")
    for one in axes:
        figures.tidy(one)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
