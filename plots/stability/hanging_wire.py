"""Stretch of a hanging wire under 50 sweeps a step, by links and load, with the lines on which ΣT/k' is 1 % and 50 %."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "A hanging wire with 50 sweeps a step: n sweeps are a spring of k' = 4 n m/(h² (1+4d))"
SCALE = (1e-5, 1)


def draw(data, mine):
    table = (mine or data).table
    figure, grid = figures.new(columns=2, height=3.6, sharey=True)
    for axes, h in zip(grid, table.values("h")):
        some = table.only("h", h)
        mesh = figures.field(axes, some, "links", "ratio", "stretch", SCALE, lost="lost")
        for level, dash in ((0.01, "--"), (0.5, "-")):
            lines = [(links, _ratio(some.only("links", links), level)) for links in some.values("links")]
            lines = [(links, ratio) for links, ratio in lines if ratio]
            figures.law(axes, *zip(*lines), f"ΣT/k' = {100 * level:g} %", linestyle=dash)
        axes.set(title=f"h = 1/{1 / h:.0f} s", xlabel="links")
    grid[0].set_ylabel("load over a point's mass")
    grid[1].legend(loc="upper right", facecolor="white", framealpha=1, frameon=True)
    figure.colorbar(mesh, ax=grid, label="stretch over the length", extend="min")
    return figure


def _ratio(table, level):
    """Where the prediction, linear in the ratio, has that level; None below a ratio of 1."""
    (r1, p1), (r2, p2) = list(zip(table["ratio"], table["predicted"]))[:2]
    ratio = r1 + (level - p1) * (r2 - r1) / (p2 - p1)
    return ratio if ratio >= 1 else None


if __name__ == "__main__":
    figures.main(draw, TITLE)
