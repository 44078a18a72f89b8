"""Error of a resting ball's depth and impulse by k and d, with lines of equal rounding."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "A ball at rest: right for every k and d, but for roundings"
SCALE = (1e-16, 1e-3)
U, G = 2.0**-54, 9.81


def draw(data, mine):
    table = (mine or data).table
    figure, grid = figures.new(columns=2, height=3.6, sharey=True)
    for axes, value, title in ((grid[0], "gap error", "depth"), (grid[1], "impulse error", "impulse")):
        mesh = figures.field(axes, table, "k", "d", value, SCALE)
        axes.set(title=title, xlabel="k [N/m], of 1 kg")
    ds = table.values("d")
    for power in (-12, -9, -6):
        line = [(10.0**power * G / (U * (d / 2 + 1)), d) for d in ds]
        figures.law(grid[0], *zip(*line), None if power > -12 else "(d/2 + 1) u k/(mg)", linewidth=1.2)
        k, d = line[len(line) // 3]
        grid[0].annotate(figures.number(10.0**power), (k, d), xytext=(5, 0), textcoords="offset points", fontsize=9,
                         color="white" if power < -7 else figures.INK)
    grid[0].set_ylabel("d [steps]")
    grid[0].legend(loc="upper left", facecolor="white", framealpha=1, frameon=True)
    figure.colorbar(mesh, ax=grid, label="relative error", extend="min")
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
