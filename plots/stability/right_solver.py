"""Errors of the hard cases with a solver that fits them."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "The hard cases again, with a solver that fits them"
PANELS = {"hanging": ("hanging wires, direct", "links", "load over a point's mass"),
          "swinging": ("100 links that swing, stiff", "load over a point's mass", "h [s]"),
          "towers": ("boxes with friction, direct", "boxes", "top over a box's mass")}


def draw(data, mine):
    figure, parts = figures.maps(data, mine, columns=3, height=3.6)
    for table, part, grid in parts:
        for axes, (what, (title, across, up)) in zip(grid, PANELS.items()):
            some = table.only("what", what)
            mesh = figures.field(axes, some, "across", "up", "error", (1e-16, 1), lost="lost")
            axes.set(title=title, xlabel=across, ylabel=up)
            if what == "swinging":
                loads = some.values("across")
                figures.law(axes, loads, [some.only("across", load)["law"][0] for load in loads],
                            "2/ω without K")
                axes.legend(loc="lower left", facecolor="white", framealpha=1, frameon=True, fontsize=8)
        part.colorbar(mesh, ax=grid, label="error, relative", extend="min")
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
