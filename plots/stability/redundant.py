"""Errors of a box on a hundred contacts and of a loop that can not close, by stiffness and sweeps."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "More rows than there is to hold: softness decides, after many sweeps"
SCALE = (1e-6, 1)


def draw(data, mine):
    figure, grid = figures.new(columns=2, height=3.6)
    for axes, what, title in ((grid[0], "box", "depth of a box on a hundred contacts"),
                              (grid[1], "loop", "place between two rods that do not fit")):
        some = (mine or data).table.only("what", what)
        mesh = figures.field(axes, some, "k", "sweeps", "error", SCALE)
        axes.set(title=title, xlabel="k [N/m], of 1 kg", ylabel="sweeps a step")
        sweeps = max(some["sweeps"])
        sigma = [4 * 3600 / (13 * k) for k in some.values("k")]  # Eq. (3.6), h = 1/60 s, d = 3, times 1 kg
        if what == "box":
            name, law = "N²/(2π² mΣ)", [100**2 / (2 * math.pi**2 * soft) for soft in sigma]
        else:
            name, law = "1 % by w₁, w₂", [math.log(50) / (2 * math.log1p(soft)) for soft in sigma]
        line = zip(some.values("k"), law)
        figures.law(axes, *zip(*[(k, n) for k, n in line if min(some["sweeps"]) <= n <= sweeps]), name)
        axes.legend(loc="lower right", facecolor="white", framealpha=1, frameon=True)
    figure.colorbar(mesh, ax=grid, label="error, over mg/(100 k), and over 10 cm", extend="both")
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
