"""Residuals over sweeps in four scenes, for orders, a warm start and conjugate gradients."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "A warm start begins a hundred times nearer; conjugate gradients finish stacks"
SCENES = {"stack": "20 bodies, one on the other", "wire": "20 points, a load of 100:1",
          "pile": "55 smooth balls", "wall": "27 bricks, with friction"}
FIXED = {"up": "-", "down": "--", "given": ":"}  # one colour, as they have one rate
METHODS = {"random": "new at random", "warm": "up, warm", "conjugate": "conjugate, five sweeps each", "nonlinear": "conjugate, on sweeps"}


def draw(data, mine):
    figure, axes = figures.new(columns=2, height=6.6, rows=2, sharey=True)
    for panel, (scene, title) in zip(axes.flat, SCENES.items()):
        table = data.table.only("scene", scene)
        for method, dash in FIXED.items():
            some = table.only("method", method)
            panel.plot(some["sweeps"], some["residual"], color="#000000", linestyle=dash, linewidth=1.2,
                       label="as given" if method == "given" else method)
        for (method, name), style in zip(METHODS.items(), figures.STYLES):
            some = table.only("method", method)
            panel.plot(some["sweeps"], some["residual"], label=name, markevery=3, **style | {"linestyle": "-"})
            if method == "random":
                panel.fill_between(some["sweeps"], some["low"], some["high"], color=style["color"], alpha=0.2,
                                   linewidth=0)
        if mine:
            some = mine.table.only("scene", scene)
            some = figures.Table(some.columns, [row for row in some.rows if row[1] in {**FIXED, **METHODS}])
            panel.plot(some["sweeps"], some["residual"], **figures.MINE | {"markersize": 6})
        panel.set(xscale="log", yscale="log", xlim=(1, 5000), ylim=(1e-7, 2),
                  title=f"{scene}: {title}")
        figures.tidy(panel)
    for panel in axes[1]:
        panel.set_xlabel("row updates, in sweeps")
    for panel in axes[:, 0]:
        panel.set_ylabel("residual, over that of λ = 0")
    axes[0, 0].legend(fontsize=8, loc="lower left")
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
