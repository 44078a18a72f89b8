"""Error of the lowest contact's depth by sweeps: towers by their height, two bodies by their mass ratio."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "With few sweeps a tower sinks too deep, as a closed form predicts"
SCALE = (1e-6, 1e5)
G, A = 9.81, 4 * 60 / 13
TOWER_SIGMA, RATIO_K = 4 * 3600 / (1e8 * 13), 1e6


def draw(data, mine):
    figure, parts = figures.maps(data, mine, columns=2, height=3.6)
    for table, part, (towers, ratios) in parts:
        for axes, what in ((towers, "tower"), (ratios, "ratio")):
            some = table.only("what", what)
            mesh = figures.field(axes, some, "across", "sweeps", "error", SCALE, lost="lost")
        heights = sorted(table.only("what", "tower").values("across"))
        slow = [math.pi**2 / (4 * n**2) for n in heights]
        figures.law(towers, heights, [math.log(1 + s / TOWER_SIGMA) / s for s in slow], "twice as deep")
        deep = [n * 60**-2 * G * 13 / 4 / 0.25 for n in heights]
        figures.law(towers, heights, deep, "25 cm", linestyle="--")
        across = sorted(table.only("what", "ratio").values("across"))
        for deeper, dash, name in ((lambda r: (1 + 1 / r) * G / RATIO_K, "-", "twice as deep"),
                                   (lambda r: 0.25, "--", "25 cm")):
            line = [(ratio, _sweeps(ratio, deeper(ratio))) for ratio in across]
            figures.law(ratios, *zip(*[(x, y) for x, y in line if y >= 1]), name, linestyle=dash)
        towers.set(title="equal spheres", xlabel="spheres", ylabel="sweeps a step")
        ratios.set(title="a heavy sphere on a light one", xlabel="mass ratio")
        towers.legend(loc="upper left", facecolor="white", framealpha=1, frameon=True, fontsize=8)
        label = "lowest depth over the right one, less 1"
        part.colorbar(mesh, ax=[towers, ratios], label=label, extend="min")
    return figure


def _sweeps(ratio, deeper):
    """Returns the number of sweeps after which the lowest contact of two is deeper by that, from Eq. (4.10)."""
    soft = 4 * 3600 / (RATIO_K * 13) / ratio
    rate = -math.log1p(soft) - math.log1p(1 / ratio + soft)  # of ρ
    first = G / 60 * ratio / A * -math.expm1(rate) / math.exp(rate)
    return math.log(1 + first / deeper) / -rate


if __name__ == "__main__":
    figures.main(draw, TITLE)
