"""Errors of a box on a hundred contacts and of a loop that cannot close, by stiffness and sweeps."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402
import numpy as np  # noqa: E402

TITLE = "Redundant rows share their load by softness, after many sweeps"
SCALE = (1e-6, 1)


def draw(data, mine):
    figure, parts = figures.maps(data, mine, columns=2, height=3.6)
    for table, part, grid in parts:
        for axes, what, title in ((grid[0], "box", "depth of a box on a hundred contacts"),
                                  (grid[1], "loop", "place between two rods that do not fit")):
            some = table.only("what", what)
            mesh = figures.field(axes, some, "k", "sweeps", "error", SCALE)
            axes.set(title=title, xlabel="k [N/m], of 1 kg", ylabel="sweeps a step")
            ks = np.geomspace(min(some["k"]), max(some["k"]), 50)
            sigma = 4 * 3600 / (13 * ks)  # Eq. (3.6), h = 1/60 s, d = 3, 1 kg
            if what == "box":
                name, law = "N²/(2π² mΣ)", 100**2 / (2 * np.pi**2 * sigma)
            else:
                name, law = "1 % by w₁, w₂", np.log(50) / (2 * np.log1p(sigma))
            figures.law(axes, ks, law, name)
            axes.legend(loc="lower right", facecolor="white", framealpha=1, frameon=True)
        part.colorbar(mesh, ax=grid, label="error, over mg/(100 k), and over 10 cm", extend="both")
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
