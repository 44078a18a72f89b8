"""Error of a resting ball's depth and impulse by k and d, for the shortest and the longest step, with the laws' lines."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "A ball at rest is exact to round-off for every k, d and h"
DEPTHS, IMPULSES = (1e-16, 1e-3), (1e-16, 1e-11)
U, G = 2.0**-54, 9.81


def draw(data, mine):
    steps = min(data.table["h"]), max(data.table["h"])
    figure, parts = figures.maps(data, mine, rows=2, columns=2, height=5.8, sharex=True, sharey=True)
    for table, part, (depths, impulses) in parts:
        for depth, impulse, h in zip(depths, impulses, steps):
            some = table.only("h", h)
            deep = figures.field(depth, some, "k", "d", "gap error", DEPTHS)
            pressed = figures.field(impulse, some, "k", "d", "impulse error", IMPULSES)
            depth.set_title(f"h = 1/{1 / h:.0f} s")
            impulse.set_xlabel("k [N/m], of 1 kg")
            impulse.set_xticks([1e3, 1e6, 1e9, 1e12])
            _depths(depth, h, table.values("d"))
            _impulses(impulse, h, table)
        impulses[0].legend(loc="upper right", facecolor="white", framealpha=1, frameon=True, fontsize=8)
        depths[0].set_ylabel("d [steps]")
        impulses[0].set_ylabel("d [steps]")
        part.colorbar(deep, ax=list(depths), label="error of the depth, over mg/k", extend="min")
        part.colorbar(pressed, ax=list(impulses), label="error of λ, over h m g", extend="min")
    return figure


def _depths(axes, h, ds):
    """Draws where the law allows a depth error of 10⁻¹², 10⁻⁹, 10⁻⁶."""
    w = math.ulp(h * G)
    for power in (-12, -9, -6):
        line = [(10.0**power * G / (U * (d / 2 + 1) + 2 * d * h * w), d) for d in ds]
        figures.law(axes, *zip(*line), linewidth=1.2)
        _name(axes, line[len(line) // 4], figures.number(10.0**power), leftward=True)


def _impulses(axes, h, table):
    """Draws where the law allows a hop to change the impulse by a power of ten. This does not depend on k."""
    ks = min(table["k"]), max(table["k"])
    for power in (-15, -14, -13, -12):
        d = (4 * U / (h**2 * G * 10.0**power) - 1) / 4
        if min(table["d"]) < d < max(table["d"]):
            figures.law(axes, ks, (d, d), "at most, by the law", linewidth=1.2)
            _name(axes, (ks[0], d), figures.number(10.0**power))


def _name(axes, place, text, leftward=False):
    axes.annotate(text, place, xytext=(-5, 0) if leftward else (5, 5), textcoords="offset points",
                  fontsize=8, ha="right" if leftward else "left",
                  bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8})


if __name__ == "__main__":
    figures.main(draw, TITLE)
