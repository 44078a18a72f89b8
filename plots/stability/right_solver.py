"""Errors of the hard cases with a suitable solver."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "With a solver that fits, the hard cases hold"
PANELS = {"hanging": ("hanging wires, direct", "links", "load over a point's mass", "of the stretch, over the length"),
          "swinging": ("100 links that swing, stiff", "load over a point's mass", "h [s]",
                       "of a link, the largest, over its length"),
          "towers": ("boxes with friction, direct", "boxes", "top over a box's mass", "of the sinkings, over the top's")}


def draw(data, mine):
    figure, parts = figures.maps(data, mine, columns=3, height=4.4)
    for table, part, grid in parts:
        for axes, (what, (title, across, up, error)) in zip(grid, PANELS.items()):
            some = table.only("what", what)
            mesh = figures.field(axes, some, "across", "up", "error", (1e-16, 1), lost="lost")
            axes.set(title=title, xlabel=across, ylabel=up)
            if what == "swinging":
                loads = some.values("across")
                figures.law(axes, loads, [some.only("across", load)["law"][0] for load in loads],
                            "2/ω without K")
                axes.legend(loc="lower left", facecolor="white", framealpha=1, frameon=True, fontsize=8)
            if any(some["lost"]):
                figures.say_lost(axes, "lost", loc="lower left")
            _mark_unsound(axes, some)
            bar = part.colorbar(mesh, ax=axes, location="bottom", extend="min", aspect=14)
            bar.set_label(f"error {error}", fontsize=8)
            bar.ax.tick_params(labelsize=7)
    return figure


def _mark_unsound(axes, table):
    """Marks runs that were not sound, but not lost either, by circles."""
    unsound = [row for row, state, lost in zip(table.rows, table["state"], table["lost"]) if state != "sound" and not lost]
    across, up = table.columns.index("across"), table.columns.index("up")
    axes.plot([row[across] for row in unsound], [row[up] for row in unsound], color="white", marker="o",
              linestyle="none", fillstyle="none", label="not sound")


if __name__ == "__main__":
    figures.main(draw, TITLE)
