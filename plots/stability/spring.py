"""Error of a mass on a spring over a period, by stiffness and step: leapfrog on the force, and SPOOK."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "A spring as a force limits the step; as a constraint it never does"
SCALE = (1e-6, 1)


def draw(data, mine):
    figure, parts = figures.maps(data, mine, columns=2, height=3.6, sharey=True)
    for table, part, grid in parts:
        names = {"force": "a force, by leapfrog", "distance": "a distance, by SPOOK, d = 3"}
        for axes, (what, title) in zip(grid, names.items()):
            some = table.only("what", what)
            mesh = figures.field(axes, some, "k", "h", "error", SCALE, lost="lost")
            axes.set(title=title, xlabel="k [N/m], of 1 kg")
        h = [min(table["h"]), max(table["h"])]
        figures.law(grid[0], [4 / step**2 for step in h], h, "h = 2/ω")
        figures.law(grid[1], [4 / step**2 for step in h], h, linestyle=":")
        grid[0].set_ylabel("h [s]")
        grid[0].legend(loc="lower left", facecolor="white", framealpha=1, frameon=True)
        part.colorbar(mesh, ax=grid, label="largest error in a period [m], of 1 m", extend="both")
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
