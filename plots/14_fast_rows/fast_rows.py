"""Gain by blocks, colours and lanes, as counts and as times."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Blocks save sweeps on dragged rods; colours shorten chains of updates"
TIMES = {"in order": "row by row, in order", "in packs": "packs of four", "two threads": "packs, two threads"}
FLOORS = {"memory": "its bytes, from memory", "operations": "its operations, in registers"}


def draw(data, mine):
    timed = "time" in set(data.table["what"])
    figure, axes = figures.new(columns=3 if timed else 2, height=3.6)
    rod, chains = axes[:2]
    for style, (which, label) in zip(figures.STYLES, (("rows", "row by row"), ("repeats", "its rows three times"),
                                                      ("blocks", "as a block"))):
        some = data.table.only("what", "rod").only("case", which)
        rod.plot(some["x"], some["value"], label=label, **style)
        if mine:
            own = mine.table.only("what", "rod").only("case", which)
            rod.plot(own["x"], own["value"], **figures.MINE)
    rod.set(title="A rod that is dragged", xlabel="μ", ylabel="sweeps to 1e-9 m/s", yscale="log",
            ylim=(1, 20_000))
    rod.legend(loc="upper left", fontsize=8)

    names = [name for name in data.table.only("what", "rows")["case"] if name.endswith("balls") or "tower" in name]
    for style, (which, label) in zip(figures.STYLES, (("rows", "rows"), ("in order", "chain, in order"),
                                                      ("by colour", "chain, by colour"))):
        heights = [data.table.only("what", which).only("case", name)["value"][0] for name in names]
        chains.plot(range(len(names)), heights, color=style["color"], marker=style["marker"], linestyle="", label=label)
    chains.set(title="Longest chain of updates", ylabel="updates", yscale="log", ylim=(5, 1e6), xticks=range(len(names)),
               xlim=(-0.5, len(names) - 0.5))
    chains.set_xticklabels(names, fontsize=7, rotation=15)
    chains.legend(loc="upper left", fontsize=8)

    if timed:
        times = data.table.only("what", "time")
        for style, (which, label) in zip(figures.STYLES, TIMES.items()):
            some = times.only("case", which)
            axes[2].plot(some["x"], some["value"], label=label, **style)
        for line, (which, label) in zip((":", "--"), FLOORS.items()):
            axes[2].axhline(times.only("case", which)["value"][0], color="grey", linestyle=line, label=label)
        axes[2].set(title="One update, on one machine", xlabel="rows", ylabel="ns", xscale="log", yscale="log",
                    ylim=(0.2, 200))
        axes[2].legend(loc="lower left", fontsize=7)
    for one in axes:
        figures.tidy(one)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
