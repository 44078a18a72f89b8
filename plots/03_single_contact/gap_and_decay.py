"""The depth of a resting contact against k, and the decay of a violation against d."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "k sets the depth at rest, d the decay of a violation"


def draw(data, mine):
    figure, (depth, decay) = figures.new(columns=2)
    _depth(depth, data.table.only("what", "gap"))
    for k, style in zip(data.table.only("what", "decay").values("k"), figures.STYLES):
        some = data.table.only("what", "decay").only("k", k)
        decay.plot(some["d"], some["predicted"], color=style["color"], linestyle=style["linestyle"])
        decay.plot(some["d"], some["value"], label=f"k = {figures.number(k)} N/m", linestyle="none",
                   color=style["color"], marker=style["marker"])
    if mine:
        some = mine.table.only("what", "gap")
        depth.plot(some["k"], [-gap for gap in some["value"]], **figures.MINE)
        some = mine.table.only("what", "decay")
        decay.plot(some["d"], some["value"], **figures.MINE)
    decay.axhline(1 / 3, color="#BBBBBB", linewidth=1)
    decay.annotate("1/3", (0.25, 1 / 3), xytext=(0, 4), textcoords="offset points", fontsize=9)
    decay.set(xscale="log", ylim=(0.25, 1), xlabel="d [steps]", ylabel="factor a step", title="decay, h = 1/60 s")
    decay.set_xticks([0.25, 1, 2, 5, 10, 30], ["1/4", "1", "2", "5", "10", "30"])
    decay.minorticks_off()
    depth.legend()
    decay.legend(loc="lower right")
    for axes in (depth, decay):
        figures.tidy(axes)
    return figure


def _depth(axes, table):
    k = table.values("k")
    axes.plot(k, [9.81 / value for value in k], color="#777777", label="m g/k")
    for d, style in zip(table.values("d"), figures.STYLES):
        some = table.only("d", d)
        axes.plot(some["k"], [-gap for gap in some["value"]], linestyle="none", color=style["color"],
                  marker=style["marker"], label=f"d = {d:g}, three steps h", fillstyle="none")
    axes.set(xscale="log", yscale="log", xlabel="k [N/m]", ylabel="depth at rest [m]", title="rest, 1 kg")


if __name__ == "__main__":
    figures.main(draw, TITLE)
