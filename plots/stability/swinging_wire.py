"""Error of the load on a swinging wire, by load and step, and the step that its tension allows."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Solved exactly, a swinging wire holds up to the step that its tension sets"
SCALE = (1e-6, 1e-1)


def draw(data, mine):
    counts = data.table.only("what", "map").values("links")
    figure, parts = figures.maps(data, mine, columns=len(counts), height=3.4, sharey=True)
    for table, part, grid in parts:
        for axes, links in zip(grid, counts):
            some = table.only("what", "map").only("links", links)
            mesh = figures.field(axes, some, "ratio", "h", "error", SCALE, lost="lost")
            ratios = some.values("ratio")
            largest = [some.only("ratio", ratio)["largest step"][0] for ratio in ratios]
            figures.law(axes, ratios, largest, "2/ω")
            axes.set(title=f"{links:g} links", xlabel="load over a point's mass")
        grid[0].set_ylabel("h [s]")
        grid[0].legend(loc="lower left", facecolor="white", framealpha=1, frameon=True)
        part.colorbar(mesh, ax=grid, label="error of the load's place [m]", extend="both")
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
