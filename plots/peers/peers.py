"""Error against the time to simulate a second, a part for each scene: a line for the best runs of each engine."""

import math
import sys
import textwrap
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402
from matplotlib.legend import Legend  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.ticker import NullFormatter  # noqa: E402

TITLE = "In most scenes ours takes at most half of the others' time at equal error"

ENGINES = dict(zip(("spook", "Bullet", "ODE", "DART", "MuJoCo"), figures.STYLES))
ROW, LEGEND = 2.7, 0.65  # heights [inches]
BEST, LOST = 1e-15, 1.0  # errors are drawn between these


def draw(data, mine):
    scenes = data.table.values("scene")
    columns = 3
    rows = math.ceil(len(scenes) / columns)
    figure, grid = figures.new(columns=columns, rows=rows + 1, height=ROW * rows + LEGEND, squeeze=False,
                               gridspec_kw={"height_ratios": [LEGEND] + [ROW] * rows})
    head, parts = grid[0], list(grid[1:].flat)
    for axes in head:
        axes.axis("off")
    _legend(head[columns // 2], data.table)
    for axes, scene in zip(parts, scenes):
        some = data.table.only("scene", scene)
        for engine in some.values("engine"):
            _draw_engine(axes, some.only("engine", engine), ENGINES[engine])
        axes.axhline(LOST, color=figures.INK, linewidth=0.8)
        axes.set(xscale="log", yscale="log")
        axes.set_title(f"{scene}\n{_at_equal_error(some)}", fontsize=8)
        axes.set_ylabel(textwrap.fill(some["error is"][0], 30), fontsize=8)
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.tick_params(labelsize=8)
        figures.tidy(axes)
    for axes in parts[len(scenes):]:
        axes.axis("off")
    for axes in parts[max(0, len(scenes) - columns):len(scenes)]:
        axes.set_xlabel("time for a simulated second [µs]", fontsize=8.5)
    return figure


def _draw_engine(axes, some, style):
    """A line of the runs with a smaller error than each cheaper one, whatever their solver; the others are pale."""
    points = [(time, max(error, BEST)) for time, error in zip(some["us a second"], some["error"]) if error < LOST]
    best = figures.front(points)
    rest = [point for point in points if point not in best]
    small = style | {"markersize": 4.5}
    axes.plot([time for time, _ in best], [error for _, error in best], **small)
    axes.plot([time for time, _ in rest], [error for _, error in rest],
              **small | {"linestyle": "none", "alpha": 0.3, "markersize": 3.5})
    lost = [time for time, error in zip(some["us a second"], some["error"]) if not error < LOST and time > 0]
    axes.plot(lost, [LOST] * len(lost), **small | {"linestyle": "none", "fillstyle": "none"})


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
    """Draws one legend above the first row: the engines, and below them the two kinds of points."""
    engines = [Line2D([], [], label=engine, **ENGINES[engine]) for engine in table.values("engine")]
    kind = {"color": figures.INK, "marker": "o", "linestyle": "none", "markersize": 4.5}
    kinds = [Line2D([], [], label="pale: dearer than another run of the engine with as small an error", **kind, alpha=0.3),
             Line2D([], [], label="hollow: lost", **kind, fillstyle="none")]
    # Two legends, since the columns of a single one would be as wide as the longest label. No layout knows them: they are
    # wider than the column of panels below.
    for handles, place in ((engines, "upper center"), (kinds, "lower center")):
        legend = Legend(axes, handles, [handle.get_label() for handle in handles], loc=place, ncol=len(handles),
                        fontsize=9, borderaxespad=0)
        legend.set_in_layout(False)
        axes.add_artist(legend)


if __name__ == "__main__":
    figures.main(draw, TITLE)
