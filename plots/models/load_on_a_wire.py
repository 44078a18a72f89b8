"""The load's error against the time to compute a second, for models of the same wire."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Model only what a scene needs: a load of 1 kg on a wire of 10 g"
COST = "us a second"


def draw(data, mine):
    figure, axes = figures.new(height=4.2)
    kinds = [("row", 1), ("points", 10), ("bodies", 10), ("points", 100), ("bodies", 100)]
    names = {"row": "one row", "points": "points, {:g} links", "bodies": "rigid bodies, {:g} links"}
    for (model, links), style in zip(kinds, figures.STYLES):
        some = data.table.only("model", model).only("links", links)
        _plot(axes, some, label=names[model].format(links), **style | {"linestyle": "none"})
    for k, h in enumerate(data.table.only("model", "row")["h"]):
        row = data.table.only("model", "row").only("h", h)
        axes.annotate(f"h = 1/{1 / h:.0f}", (row[COST][0], row["error"][0]), xytext=(0, -14 if k else 8),
                      textcoords="offset points", ha="center", fontsize=8)
    if mine:
        # How far a load has flown says nothing, and would squeeze all others: all that is far is at 100.
        own = figures.Table([COST, "error"], [[us, min(error, 100)] for us, error in
                                              zip(mine.table[COST], mine.table["error"])])
        _plot(axes, own, **figures.MINE)
    axes.axhline(0.02, color="#777777", linewidth=1)
    axes.annotate("2 %", (1, 0.02), xytext=(4, 4), textcoords="offset points", fontsize=9)
    axes.axhline(1, color="#777777", linewidth=1, linestyle=":")
    axes.annotate("lost", (1, 1), xytext=(4, 4), textcoords="offset points", fontsize=9)
    axes.set(xscale="log", yscale="log", xlim=(1, 1e6), xlabel="time to compute a second of it [µs]",
             ylabel="error of the load's place, over the length")
    # On the left there is nothing between 2 % and lost. Among markers those of a legend are taken for some.
    axes.legend(loc="center left", bbox_to_anchor=(2, 0.14), bbox_transform=axes.transData, fontsize=8)
    figures.tidy(axes)
    return figure


def _plot(axes, table, **style):
    shown = [(us, error) for us, error in zip(table[COST], table["error"]) if math.isfinite(error)]
    axes.plot(*zip(*shown), **style)


if __name__ == "__main__":
    figures.main(draw, TITLE)
