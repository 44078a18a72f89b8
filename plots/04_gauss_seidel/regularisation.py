"""Sweeps over the mass ratio for three Σ, and two rows that contradict each other."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Σ bounds the number of sweeps, and gives contradictory rows a solution"
X, Y = "ratio or sweep", "sweeps or impulse"


def draw(data, mine):
    figure, (ratio, rows) = figures.new(columns=2)
    ratios = data.table.only("what", "ratio")
    for Sigma, style in zip(ratios.values("Sigma"), figures.STYLES):
        some = ratios.only("Sigma", Sigma)
        ratio.plot(some[X], some[Y], label=f"m Σ = {figures.number(Sigma)}", **style | {"linestyle": "none"})
        ratio.plot(some[X], some["predicted or velocity"], color=style["color"], linestyle=style["linestyle"])
    for Sigma, style in zip(data.table.only("what", "contradict").values("Sigma"), figures.STYLES):
        some = data.table.only("what", "contradict").only("Sigma", Sigma)
        rows.plot(some[X], some[Y], label=f"Σ = {Sigma:g}", markevery=20, **style)
    if mine:
        some = mine.table.only("what", "ratio")
        ratio.plot(some[X], some[Y], **figures.MINE)
        some = mine.table.only("what", "contradict")
        rows.plot(some[X], some[Y], markevery=20, **figures.MINE)
    ratio.set(xscale="log", yscale="log", xlabel="mass ratio, the heavy body on top", ylabel="sweeps to 1e-6")
    rows.set(xlabel="sweeps", ylabel="impulse of the first of two rows [N s]", title="two rows for 1 and 2 m/s at once")
    for axes in (ratio, rows):
        axes.legend()
        figures.tidy(axes)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
