"""Error against time and against row updates: a line for each solver and step, a point for each number of sweeps."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Speed against error"


def draw(data, mine):
    figure, (time, updates) = figures.new(columns=2, sharey=True)
    lines = sorted({(row[1], row[3]) for row in data.table.rows}, reverse=True)
    if len({h for _, h in lines}) == len(data.table.rows) / max(1, len({solver for solver, _ in lines})):
        lines = [(solver, None) for solver in data.table.values("solver")]  # no sweeps to tell apart: a line over h
    for (solver, h), style in zip(lines, figures.STYLES * len(lines)):
        some = data.table.only("solver", solver)
        some = some if h is None else some.only("h", h)
        label = solver if h is None else f"{solver}, h = {h:.4g} s"
        cost = [us / step for us, step in zip(some["us a step"], some["h"])]
        spread = [[max(0, (us - low) / step) for us, low, step in zip(some["us a step"], some["quartile below"], some["h"])],
                  [max(0, (high - us) / step) for us, high, step in zip(some["us a step"], some["quartile above"], some["h"])]]
        time.errorbar(cost, some["error"], xerr=spread, label=label, capsize=2, **style)
        if any(some["row updates a second"]):
            updates.plot(some["row updates a second"], some["error"], label=label, **style)
    if mine:
        own = mine.table
        time.plot([us / step for us, step in zip(own["us a step"], own["h"])], own["error"], **figures.MINE)
        if any(own["row updates a second"]):
            updates.plot(own["row updates a second"], own["error"], **figures.MINE)
    time.set(xlabel="time to compute a second of it [µs]", ylabel=f"error of {data.table['scene'][0]}, relative")
    updates.set(xlabel="row updates in a second of it")
    for axes in (time, updates):
        axes.set(xscale="log", yscale="log")
        figures.tidy(axes)
    time.legend(fontsize=8)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
