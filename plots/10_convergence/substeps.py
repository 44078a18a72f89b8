"""The error that so many row updates in each step leave, as sweeps or as substeps, cold or warm."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Many sweeps, or many steps of one sweep; and when a warm start is safe"
METHODS = ("sweeps", "substeps", "warm sweeps", "warm substeps")


def draw(data, mine):
    figure, axes = figures.new(columns=2, height=3.8, sharey=True)
    for panel, scene, title in zip(axes, ("wire", "stack"), ("ten links, a load of 100:1", "ten bodies")):
        table = data.table.only("scene", scene)
        for method, style in zip(METHODS, figures.STYLES):
            some = table.only("method", method)
            panel.plot(some["updates"], [max(error, 1e-12) for error in some["error"]], label=method, **style)
        if mine:
            some = mine.table.only("scene", scene)
            some = figures.Table(some.columns, [row for row in some.rows if row[1] in METHODS])
            panel.plot(some["updates"], [max(error, 1e-12) for error in some["error"]], **figures.MINE)
        least = table.only("method", "needed")["updates"][0]
        panel.axvline(least, color="#777777", linewidth=1)
        panel.set(xscale="log", yscale="log", ylim=(5e-13, 3e6), xlabel="updates of each row in 1/60 s",
                  title=f"{scene}: {title}; grey: n of (10.12), {least:.3g}")
        panel.axhline(1, color="#BBBBBB", linewidth=0.8)
        figures.tidy(panel)
    axes[0].set_ylabel("worst gap, over a link")
    axes[0].legend(loc="lower left", fontsize=8)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
