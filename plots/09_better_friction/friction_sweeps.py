"""Changes that sweeps return with each model of friction: a pile, and a rod that slides on its end."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Sweeps on the cone may be slow, not converge, or have two solutions"
RODS = {"cone 0.75": "cone, ρ = 0.75", "cone -0.75": "cone, ρ = -0.75", "cone -1.5": "cone, ρ = -1.5",
        "two passes -1.5": "two passes, ρ = -1.5"}


def draw(data, mine):
    figure, (pile, rod) = figures.new(columns=2)
    for axes, what, names in ((pile, "pile", {
name: name for name in ("box", "two passes", "cone")}),
                              (rod, "rod", RODS)):
        for (which, name), style in zip(names.items(), figures.STYLES):
            some = _positive(data.table.only("what", what).only("which", which))
            few = max(1, len(some[0]) // 10) if what == "pile" or len(some[0]) < 6 else 6
            size = 9 if which == "cone 0.75" else 4.5  # the two of 0.75 are on each other
            axes.plot(*some, label=name, markevery=few, **(style | {"markersize": size}))
            if mine:
                own = _positive(mine.table.only("what", what).only("which", which))
                axes.plot(*own, markevery=few, **(figures.MINE | {"label": None}))
    rod_sweeps = range(1, 61)
    rod.plot(rod_sweeps, [0.75**n for n in rod_sweeps], color="#777777", linewidth=1, zorder=1)
    rod.annotate("0.75ⁿ", (40, 0.75**40), xytext=(-28, -20), textcoords="offset points", fontsize=9)
    rod.set_xlim(0, 60)
    pile.set(title="thirty balls in a pyramid, μ = 1")
    rod.set(title="a rod that slides on its end")
    for axes in (pile, rod):
        axes.set(yscale="log", xlabel="sweeps", ylabel="what the sweep returned, g h = 1", ylim=(1e-13, 30))
        figures.tidy(axes)
    pile.legend(loc="upper right")
    rod.legend(loc="lower left", fontsize=8)
    return figure


def _positive(table):
    """Returns sweeps and values, without zeros, which a logarithmic axis cannot show."""
    kept = [(sweep, value) for sweep, value in zip(table["sweep"], table["value"]) if value > 0]
    return [list(column) for column in zip(*kept)]


if __name__ == "__main__":
    figures.main(draw, TITLE)
