"""Four models of friction, by direction, in a stack, and under a spinning disc."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Normal forces as limits correct the stack; the cone also corrects directions"
MODELS = ("box", "two passes", "sliding tangents", "cone")
# Where two are alike both are seen: a thin dark line on a wide pale one. In a stack others are alike than elsewhere.
WIDE, WIDE_IN_STACK = ("box", "sliding tangents"), ("box", "two passes")


def draw(data, mine):
    figure, _ = figures.new(height=7.4)
    figure.clear()
    push, distance = (figure.add_subplot(2, 2, k + 1, projection="polar") for k in range(2))
    stack, spin = (figure.add_subplot(2, 2, k + 3) for k in range(2))
    for axes, what, title in ((push, "push", "push that moves a block, μ m g = 1"),
                              (distance, "distance", "way to a stop, v²/(2μg) = 1")):
        _by_direction(axes, data.table.only("what", what), mine and mine.table.only("what", what))
        axes.set_title(title, pad=10)
    for axes, what, wide in ((stack, "stack", WIDE_IN_STACK), (spin, "spin", WIDE)):
        for model, style in _styles(wide):
            some = data.table.only("what", what).only("model", model)
            marks = style | ({"markevery": max(1, len(some.rows) // 12)} if what == "spin" else {})
            axes.plot(some["at"], some["value"], label=model, **marks)
            if mine:
                own = mine.table.only("what", what).only("model", model)
                axes.plot(own["at"], own["value"], markevery=marks.get("markevery"),
                          **(figures.MINE | {"label": "yours" if model == "cone" else None}))
    stack.set(title="μ that holds n points on a slope, tan θ = 1", xlabel="points", ylabel="μ / tan θ")
    spin.set(title="spin of a disc on its flat side", xlabel="time, 3Rω/(4μg) = 1", ylabel="ω, at first 1")
    spin.plot((0, 1), (1, 0), color="#777777", linewidth=1, zorder=1)
    stack.legend(loc="upper left", fontsize=9)
    for axes in (stack, spin):
        figures.tidy(axes)
    return figure


def _styles(wide):
    for model, style in zip(MODELS, figures.STYLES):
        if model in wide:
            yield model, style | {"linewidth": 6, "linestyle": "-", "marker": "", "alpha": 0.35, "zorder": 1.5}
        else:
            yield model, style | {"linewidth": 1.4, "linestyle": "-", "markersize": 4}


def _by_direction(axes, table, own):
    closed = sorted(table.values("at"))
    for model, style in _styles(WIDE):
        some = table.only("model", model)
        axes.plot([*some["at"], closed[0] + 2 * math.pi], [*some["value"], some["value"][0]], **style)
        if own:
            axes.plot(own.only("model", model)["at"], own.only("model", model)["value"], **figures.MINE)
    axes.set_rmin(0)
    axes.set_rmax(1.5)
    axes.set_rticks([0.5, 1], ["", "1"])
    axes.set_xticks([k * math.pi / 4 for k in range(8)])
    axes.tick_params(labelsize=8)
    axes.grid(color=figures.FAINT, linewidth=0.6)


if __name__ == "__main__":
    figures.main(draw, TITLE)
