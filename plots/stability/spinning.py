"""Energy error of a free top by spin and step, for three rotation updates."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "A fast spin for 10 s: the explicit torque blows up, the splitting never"
SCALE = (1e-6, 10)
SECONDS = 10


def draw(data, mine):
    figure, parts = figures.maps(data, mine, columns=3, height=3.4, sharey=True)
    for table, part, grid in parts:
        constant = table.only("update", "law")["energy error"][0]
        for axes, update in zip(grid, ("first order", "exponential", "splitting")):
            some = table.only("update", update)
            mesh = figures.field(axes, some, "spin", "h", "energy error", SCALE, lost="lost")
            h = [min(some["h"]), max(some["h"])]
            if update != "splitting":
                figures.law(axes, [(constant / (step * SECONDS)) ** 0.5 for step in h], h, "h |ω|² t = C")
            axes.set(title=update, xlabel="|ω| [rad/s]")
        grid[0].set_ylabel("h [s]")
        grid[0].legend(loc="lower left", facecolor="white", framealpha=1, frameon=True, fontsize=8)
        part.colorbar(mesh, ax=grid, label="energy error, over the energy", extend="both")
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
