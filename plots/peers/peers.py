"""Error against the time to simulate a second, a part for each scene: a line for each engine's solver and sweeps."""

import math
import sys
import textwrap
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402
from matplotlib.ticker import NullFormatter  # noqa: E402

TITLE = "Ours beside Bullet, ODE, DART and MuJoCo: speed against error"

COLOURS = {"spook": "#0072B2", "Bullet": "#D55E00", "ODE": "#009E73", "DART": "#CC79A7", "MuJoCo": "#E69F00"}
LINES = {"spook": "-", "Bullet": "--", "ODE": "-.", "DART": ":", "MuJoCo": (0, (5, 1))}
# All at once, by sweeps, or what no other has: told apart without colour, too.
SOLVERS = {"direct": "o", "stiff": "*", "composed": "*", "auto": "o", "gauss_seidel": "s", "cone": "s", "dantzig": "o",
           "sequential": "s", "step": "o", "quick": "s", "quick 0.4": "^",
           "reduced": "D", "soft steps": "^", "newton": "o", "pyramids": "^", "sweeps": "s"}
BEST, LOST = 1e-15, 1.0  # errors are drawn between these


def draw(data, mine):
    scenes = data.table.values("scene")
    columns = 3
    rows = math.ceil((len(scenes) + 1) / columns)
    figure, grid = figures.new(columns=columns, rows=rows, height=2.6 * rows, squeeze=False)
    parts = list(grid.flat)
    for axes, scene in zip(parts, scenes):
        some = data.table.only("scene", scene)
        for engine in some.values("engine"):
            for solver in some.only("engine", engine).values("solver"):
                _draw_line(axes, some.only("engine", engine).only("solver", solver), engine, solver)
        axes.axhline(LOST, color=figures.INK, linewidth=0.8)
        axes.set(xscale="log", yscale="log")
        axes.set_title(f"{scene}\n{_at_equal_error(some)}", fontsize=7.2)
        axes.set_ylabel(textwrap.fill(some["error is"][0], 30), fontsize=7.5)
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.tick_params(labelsize=8)
        figures.tidy(axes)
    for axes in parts[len(scenes):]:
        axes.axis("off")
    for axes in parts[max(0, len(scenes) - columns):len(scenes)]:
        axes.set_xlabel("time for a simulated second [µs]", fontsize=8.5)
    _legend(parts[-1], data.table)
    return figure


def _draw_line(axes, some, engine, solver):
    """From short steps to long ones; what is lost is hollow, on the line at the top."""
    points = sorted(zip(some["sweeps"], some["us a second"], some["error"]))
    for sweeps in sorted({point[0] for point in points}):
        kept = [(time, max(error, BEST)) for count, time, error in points if count == sweeps and error < LOST]
        if kept:
            axes.plot(*zip(*kept), **_style(engine, solver))
    lost = [time for _, time, error in points if not error < LOST and time > 0]
    axes.plot(lost, [LOST] * len(lost), **_style(engine, solver) | {"linestyle": "none", "fillstyle": "none"})


def _style(engine, solver) -> dict:
    return {"color": COLOURS[engine], "linestyle": LINES[engine], "marker": SOLVERS[solver], "markersize": 4.5,
            "linewidth": 1}


def _at_equal_error(some) -> str:
    """Our least time over the others' least, for each error that one of the others has: the range of it."""
    ours = [(time, error) for engine, time, error in zip(some["engine"], some["us a second"], some["error"])
            if engine == "spook" and error < LOST]
    others = [(time, error) for engine, time, error in zip(some["engine"], some["us a second"], some["error"])
              if engine != "spook" and error < LOST]
    if not others:
        return "only spook keeps it"
    ratios, missed = [], False
    for error in sorted({error for _, error in others}):
        reached = [time for time, own in ours if own <= error]
        least = min(time for time, other in others if other <= error)
        if reached:
            ratios.append(min(reached) / least)
        else:
            missed = True
    said = [f"ours / fastest other: {_range(ratios)}"] if ratios else []
    return "\n".join(said + (["the least error is another's"] if missed else []))


def _range(ratios) -> str:
    low, high = (f"{value:.2g}" for value in (min(ratios), max(ratios)))
    return low if low == high else f"{low} to {high}"


def _legend(axes, table):
    for engine, solver in dict.fromkeys(zip(table["engine"], table["solver"])):
        axes.plot([], [], label=f"{engine} {solver}", **_style(engine, solver))
    axes.plot([], [], color=figures.INK, marker="o", linestyle="none", fillstyle="none", label="hollow: lost")
    axes.legend(loc="center", fontsize=8)


if __name__ == "__main__":
    figures.main(draw, TITLE)
