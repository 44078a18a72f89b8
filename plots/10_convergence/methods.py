"""Error of one step's velocities against work, for methods of many kinds, on nine problems."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "The cheapest method for a step depends on the scene"
METHODS = ("sweeps", "mixed sweeps", "conjugate gradients", "block descent", "Newton", "splitting", "direct")
PANELS = (("stack", "box", "10 spheres"), ("heavy", "box", "10 spheres, 1000:1"), ("wire", "box", "20 links, 1000:1"),
          ("tower", "box", "20 cubes, box"), ("wall", "box", "60 bricks, box"), ("pile", "box", "60 cubes, box"),
          ("tower", "cone", "20 cubes, cones"), ("wall", "cone", "60 bricks, cones"), ("block", "cone", "a block, cones"))
LEAST = 1e-12  # drawn at the lower edge
GOAL = 1e-6


def draw(data, mine):
    figure, axes = figures.new(columns=3, rows=3, height=8.6, sharex=True, sharey=True)
    for panel, (scene, friction, title) in zip(axes.flat, PANELS):
        table = data.table.only("scene", scene).only("friction", friction)
        best = _cheapest(table)
        for method, style in zip(METHODS, figures.STYLES):
            if method not in table["method"]:  # a solver for boxes in a problem with cones, or the other way round
                continue
            some = table.only("method", method)
            _curve(panel, some, style | ({"linewidth": 3, "zorder": 3} if method == best else {"linewidth": 1.1}))
        if mine:
            some = mine.table.only("scene", scene).only("friction", friction)
            panel.plot(some["cost [sweeps]"], [max(error, LEAST) for error in some["error"]], **figures.MINE)
        panel.set(xscale="log", yscale="log", ylim=(LEAST / 3, 3), xlim=(0.8, 6000))
        panel.set_title(f"{title}\ncheapest to 10⁻⁶: {best}")
        panel.axhline(GOAL, color="#BBBBBB", linewidth=0.8)
        figures.tidy(panel)
    for panel in axes[:, 0]:
        panel.set_ylabel("error of velocities, by mass")
    for panel in axes[-1]:
        panel.set_xlabel("cost, in sweeps")
    for method, style in zip(METHODS, figures.STYLES):
        axes[1, 2].plot([], [], label=method, **style)
    axes[1, 2].legend(loc="lower left", fontsize=8)
    return figure


def _cheapest(table) -> str:
    """The method that brings the error to GOAL for the least cost."""
    reached = [(cost, method) for cost, error, method in zip(table["cost [sweeps]"], table["error"], table["method"])
               if error <= GOAL]
    return min(reached)[1]


def _curve(panel, table, style):
    """Draws one curve in the order of cost, and ends it where the error reaches round-off."""
    points = sorted(zip(table["cost [sweeps]"], table["error"]))
    shown = []
    for cost, error in points:
        shown.append((cost, max(error, LEAST)))
        if error <= LEAST:
            break
    if not shown:
        return
    single = len(shown) == 1
    marks = {"markevery": max(1, len(shown) // 5)} | ({"markersize": 9} if single else {})
    panel.plot(*zip(*shown), **style | marks)


if __name__ == "__main__":
    figures.main(draw, TITLE)
