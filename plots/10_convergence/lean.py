"""Lean and sinking of a tower of boxes with few sweeps, by order."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "With too few sweeps a tower leans in a fixed order, and sinks in random order"
NAMES = {"up": "up", "down": "down", "random step": "new in each step", "random sweep": "new in each sweep"}


def draw(data, mine):
    figure, axes = figures.new(columns=2)
    for panel, column in zip(axes, ("tilt", "sunk")):
        for (order, name), style in zip(NAMES.items(), figures.STYLES):
            some = data.table.only("order", order)
            counts = some.values("sweeps")
            means = [sum(values) / len(values) for values in (some.only("sweeps", n)[column] for n in counts)]
            panel.plot(counts, means, label=name, **style)
        if mine:
            panel.plot(mine.table["sweeps"], mine.table[column], **figures.MINE)
        panel.set(xscale="log", yscale="log", xlabel="sweeps in each step")
        figures.tidy(panel)
    axes[0].set_ylabel("tilt of the top, root mean square [°]")
    axes[1].set_ylabel("how far the top has sunk [m]")
    axes[0].legend()
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
