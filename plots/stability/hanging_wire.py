"""Stretch of a hanging wire under few sweeps a step, by links and load."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "With few sweeps a hanging wire is a spring of predictable stiffness"
SCALE = (1e-5, 1)


def draw(data, mine):
    figure, parts = figures.maps(data, mine, columns=3, height=3.6, sharey=True)
    for table, part, grid in parts:
        limits = None
        for axes, h in zip(grid, sorted(table.values("h"), reverse=True)):
            some = table.only("h", h)
            mesh = figures.field(axes, some, "links", "ratio", "stretch", SCALE, lost="lost")
            for level, dash in ((0.01, "--"), (0.5, "-")):
                law = [(n, _ratio(some.only("links", n), level)) for n in sorted(some.values("links"))]
                law = [(links, ratio) for links, ratio in law if ratio]
                figures.law(axes, *zip(*law), f"ΣT/k' = {100 * level:g} %", linestyle=dash)
            if limits is None:  # those of a coarser map are wider
                limits = {"xlim": axes.get_xlim(), "ylim": axes.get_ylim()}
            axes.set(title=f"h = 1/{1 / h:.0f} s, {some['sweeps'][0]:g} sweeps", xlabel="links",
                     xticks=[10, 100, 1000, 10_000], **limits)
        grid[0].set(ylabel="load over a point's mass")
        grid[1].legend(loc="upper right", facecolor="white", framealpha=1, frameon=True, fontsize=8)
        part.colorbar(mesh, ax=grid, label="stretch over the length", extend="min")
    return figure


def _ratio(table, level):
    """Returns the ratio at which the prediction, linear in the ratio, has that level; None below a ratio of 1."""
    (r1, p1), (r2, p2) = sorted(zip(table["ratio"], table["predicted"]))[:2]
    ratio = r1 + (level - p1) * (r2 - r1) / (p2 - p1)
    return ratio if ratio >= 1 else None


if __name__ == "__main__":
    figures.main(draw, TITLE)
