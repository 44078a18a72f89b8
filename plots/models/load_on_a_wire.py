"""The load's error against the row updates in a second, for models of the same wire: the best runs of each."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402
from matplotlib.ticker import NullLocator  # noqa: E402

TITLE = "One row carries the load for a thousandth of the updates of any wire of links"
COST = "row updates a second"  # the same on every machine
LOST, TOP = 1.0, 60.0  # an error of the wire's length; the upper edge
BELOW_THE_LINE = ("bodies", 10)  # begins right below the line of 2 %, which its name must not touch


def draw(data, mine):
    figure, axes = figures.new(height=4.2)
    kinds = [("row", 1), ("points", 10), ("bodies", 10), ("points", 100), ("bodies", 100)]
    names = {"row": "one row", "points": "points, {:g} links", "bodies": "rigid bodies, {:g} links"}
    for k, ((model, links), style) in enumerate(zip(kinds, figures.STYLES)):
        some = data.table.only("model", model).only("links", links)
        name = names[model].format(links)
        points = [(cost, error) for cost, error in zip(some[COST], some["error"]) if error < LOST]
        best = figures.front(points)
        axes.plot([cost for cost, _ in best], [error for _, error in best], **style | {"linewidth": 1.2})
        rest = [point for point in points if point not in best]
        axes.plot([cost for cost, _ in rest], [error for _, error in rest], **style | {"linestyle": "none", "alpha": 0.35})
        lost = [cost for cost, error in zip(some[COST], some["error"]) if not error < LOST]
        axes.plot(lost, [LOST * 2 ** (k + 1)] * len(lost),
                  **style | {"linestyle": "none", "fillstyle": "none", "markersize": 4.5})
        place, side = ((12, -3), "left") if (model, links) == BELOW_THE_LINE else ((-8, 2), "right")
        axes.annotate(name, best[0] if best else (min(lost), LOST * 2 ** (k + 1)), xytext=place,
                      textcoords="offset points", ha=side, va="top", fontsize=9, color=style["color"])
    if mine:
        kept = [(cost, error) for cost, error in zip(mine.table[COST], mine.table["error"]) if error < LOST]
        axes.plot([cost for cost, _ in kept], [error for _, error in kept], **figures.MINE)
        axes.legend(loc="lower left")
    axes.axhline(0.02, color="#777777", linewidth=1)
    axes.annotate("2 %", (4, 0.02), xytext=(4, 4), textcoords="offset points", fontsize=9)
    axes.axhline(LOST, color="#777777", linewidth=1)
    axes.annotate("lost: an error above the wire's length, however large", (4, LOST), xytext=(4, 4),
                  textcoords="offset points", fontsize=9)
    axes.set(xscale="log", yscale="log", xlim=(4, 4e8), ylim=(1e-4, TOP),
             xlabel="row updates for a second of motion", ylabel="error of the load's place, over the length")
    axes.set_yticks([10.0**power for power in range(-4, 1)])
    axes.yaxis.set_minor_locator(NullLocator())
    figures.tidy(axes)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
