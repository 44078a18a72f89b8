"""Energy of an orbit: against the cost of one orbit, and over many orbits."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Leapfrog's energy error stays bounded; that of RK4 grows"
COST, ORBIT, ERROR = "evaluations an orbit", "orbit", "energy error"


def draw(data, mine):
    figure, (cost, time) = figures.new(columns=2, sharey=True)
    for method, style in zip(data.table.values("method"), figures.STYLES):
        _plot(cost, data.table.only("method", method).only(ORBIT, 1), COST, label=method, **style)
        _plot(time, _many_orbits(data.table, method), ORBIT, label=method, markevery=3, **style)
    if mine:
        _plot(cost, mine.table.only("method", "leapfrog").only(ORBIT, 1), COST, **figures.MINE)
        _plot(time, _many_orbits(mine.table, "leapfrog"), ORBIT, **figures.MINE)

    figures.slope(cost, -2, (400, 3200), 2e-4, "-2")
    figures.slope(cost, -4, (1600, 6400), 2e-8, "-4")
    cost.set(title="one orbit", xlabel="evaluations of the force in an orbit", ylabel="largest energy error, relative")
    time.set(title="1000 evaluations an orbit", xlabel="orbits")
    for axes in (cost, time):
        axes.set(xscale="log", yscale="log")
        figures.tidy(axes)
    cost.legend()
    return figure


def _many_orbits(table, method):
    long_run = table.only("method", method).only(COST, 1000)
    return figures.Table(long_run.columns, [row for row in long_run.rows if row[2] > 1])


def _plot(axes, table, x, **style):
    axes.plot(table[x], table[ERROR], **style)


if __name__ == "__main__":
    figures.main(draw, TITLE)
