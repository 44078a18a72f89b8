"""Pairs compared by three broad phases, and their time, over the number of spheres."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "All pairs cost N² comparisons, sweep and prune N^(5/3), a spatial hash N"


def draw(data, mine):
    figure, (compared, time) = figures.new(columns=2)
    for way, style in zip(data.table.values("way"), figures.STYLES):
        some = data.table.only("way", way)
        compared.plot(some["bodies"], some["compared"], label=way, **style)
        time.plot(some["bodies"], some["time [ms]"], label=way, **style)
        time.fill_between(some["bodies"], some["quartile below"], some["quartile above"], color=style["color"],
                          alpha=0.25, linewidth=0)
    touching = data.table.only("way", "spatial hash")
    compared.plot(touching["bodies"], touching["pairs"], color="#777777", linewidth=1, label="pairs that touch")
    if mine:
        some = [row for row in mine.table.rows if row[0] != "all pairs"]
        time.plot([row[1] for row in some], [row[4] for row in some], **figures.MINE)
    figures.slope(compared, 2, (4e3, 1.2e4), 2e7, "2")
    figures.slope(compared, 5 / 3, (8e3, 4e4), 1e6, "5/3")
    figures.slope(compared, 1, (1e4, 5e4), 5e4, "1")
    compared.set(xscale="log", yscale="log", ylim=(7e2, 3e9), xlabel="spheres", ylabel="pairs of bounds compared")
    time.set(xscale="log", yscale="log", xlabel="spheres", ylabel="time [ms], median")
    for axes in (compared, time):
        figures.tidy(axes)
        axes.legend(fontsize=8, loc="upper left")
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
