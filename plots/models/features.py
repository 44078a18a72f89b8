"""Nanoseconds a body for features that a scene does not need, and for some that it needs."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "In free fall, unused features cost no time"


def draw(data, mine):
    figure, axes = figures.new(height=2.9)
    names = [f"{row[0]}" + (f", {row[1]:g} bodies" if row[1] != 1000 else "") for row in data.table.rows]
    low = [us - below for us, below in zip(data.table["ns a body"], data.table["quartile below"])]
    high = [above - us for us, above in zip(data.table["ns a body"], data.table["quartile above"])]
    colours = [figures.STYLES[0]["color"] if stages == 2 else figures.STYLES[1]["color"] for stages in data.table["stages"]]
    axes.barh(names, data.table["ns a body"], xerr=[low, high], color=colours, height=0.6, capsize=2)
    ends = [max(pair) for pair in zip(data.table["ns a body"], (mine or data).table["ns a body"])]
    for k, (ns, stages, end) in enumerate(zip(data.table["ns a body"], data.table["stages"], ends)):
        axes.annotate(f"{ns:.3g} ns, {stages:g} stages", (end, k), xytext=(8, 0),
                      textcoords="offset points", va="center", fontsize=8)
    if mine:
        axes.plot(mine.table["ns a body"], names, **figures.MINE)
        axes.legend(loc="lower right")
    axes.invert_yaxis()
    axes.set(xlabel="time a step and body [ns], median", xlim=(0, 1.3 * max(ends)))
    figures.tidy(axes)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
