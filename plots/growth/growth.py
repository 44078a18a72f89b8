"""Larger scenes: time for each link and ball, and the depth to which a stack sinks."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "A link or a ball costs more only when a scene leaves the cache"
WAYS = {"as given": "sweeps in the given order", "spatial_decomposition": "in stripes",
        "two threads": "in stripes, two threads"}


def draw(data, mine):
    timed = "body" in set(data.table["what"])
    figure, axes = figures.new(columns=3 if timed else 1, height=3.6)
    stands = axes[-1] if timed else axes
    sunk = data.table.only("what", "stands").only("case", "sunk")
    stands.plot(sunk["n"], sunk["value"], **figures.STYLES[0])
    if mine:
        own = mine.table.only("what", "stands").only("case", "sunk")
        stands.plot(own["n"], own["value"], **figures.MINE)
    stands.set(title="A stack has sunk after 1 s", xlabel="balls", ylabel="radii", xscale="log", yscale="log",
               ylim=(1e-3, 1e-1))
    if timed:
        link = data.table.only("what", "link").only("case", "time")
        axes[0].plot(link["n"], link["value"], **figures.STYLES[0])
        axes[0].set(title="A wire, solved directly", xlabel="links", ylabel="µs a step and link", xscale="log", yscale="log",
                    ylim=(0.05, 5))
        for style, (which, label) in zip(figures.STYLES, WAYS.items()):
            some = data.table.only("what", "body").only("case", which)
            axes[1].plot(some["n"], some["value"], label=label, **style)
        axes[1].set(title="Balls in a stack", xlabel="balls", ylabel="µs a step and ball", xscale="log", yscale="log",
                    ylim=(1, 50))
        axes[1].legend(loc="lower left", fontsize=8)
    for one in axes if timed else [axes]:
        figures.tidy(one)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
