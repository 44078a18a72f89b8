"""Peaks of a bouncing ball with and without correction, and how often the notes' law adds energy."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Corrected impacts have exact peaks; guarded impacts add no energy"


def draw(data, mine):
    figure, (bounce, seen, gain) = figures.new(columns=3, height=3.6)
    some = data.table.only("what", "bounce")
    for e, style in zip(some.values("e"), figures.STYLES):
        one = some.only("e", e)
        number = [0, *one["mu or h"]]
        bounce.plot(number, [1, *one["expected or largest"]], color=style["color"], linestyle=style["linestyle"])
        bounce.plot(number, [1, *one["value"]], color=style["color"], marker=style["marker"], linestyle="none",
                    label=f"e = {e:g}")
    bounce.set(yscale="log", ylim=(2e-3, 2), xlabel="bounce", ylabel="peak [m]", title="peaks and h₀ e²ⁿ")

    late, in_time = data.table.only("what", "late"), data.table.only("what", "in time")
    steps = late["mu or h"]
    seen.plot(steps, late["value"], label="velocities only", **figures.STYLES[1])
    seen.plot(steps, in_time["value"], label="put back, (7.16)", **figures.STYLES[2])
    figures.slope(seen, 1, (min(steps), min(steps) * 8), min(late["value"]) / 30, "1")
    seen.set(xscale="log", yscale="log", xlabel="h [s]", ylabel="error of the peak [m]", title="third peak, e = 0.7")

    gains = data.table.only("what", "gain")
    for mu, style in zip(gains.values("mu or h"), figures.STYLES):
        one = gains.only("mu or h", mu)
        gain.plot(one["e"], [100 * share for share in one["value"]], label=f"μ = {mu:g}", **style)
    gain.plot([0, 1], [0, 0], color="#000000", linewidth=2.5, label="guarded")
    gain.set(xlabel="e", ylabel="boxes that gain energy [%]", title="landing on a corner")

    if mine:
        own = mine.table.only("what", "bounce")
        bounce.plot(own["mu or h"], own["value"], **figures.MINE)
        own = mine.table.only("what", "late")
        seen.plot(own["mu or h"], own["value"], **figures.MINE)
        own = mine.table.only("what", "gain")
        gain.plot(own["e"], [100 * share for share in own["value"]], **figures.MINE)
    seen.legend(loc="center right", fontsize=8)
    bounce.legend(loc="lower left", fontsize=8)
    gain.legend(fontsize=8)
    for axes in (bounce, seen, gain):
        figures.tidy(axes)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
