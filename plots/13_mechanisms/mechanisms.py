"""Momentum with and without the second term, and the errors of four mechanisms over the step."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402
from matplotlib.ticker import NullLocator  # noqa: E402

TITLE = "With the second term a bead keeps its momentum, and errors fall with h²"
SCENES = {"door": "door [rad]", "physical_pendulum": "physical pendulum [rad]", "gyroscope": "gyroscope [rad]",
          "bead": "bead [relative]"}


def draw(data, mine):
    figure, (momentum, errors) = figures.new(columns=2, height=3.6)
    for style, (which, label) in zip(figures.STYLES, (("with", "with the second term"), ("without", "without it"))):
        some = data.table.only("what", which).only("h [s]", 1e-3)
        momentum.plot(some["time [s]"], some["value"], color=style["color"], label=label)
        if mine:
            own = mine.table.only("what", which).only("h [s]", 1e-3)
            momentum.plot(own["time [s]"], own["value"], **figures.MINE)
    momentum.set(title="a bead slides out along a rod", xlabel="time [s]", ylabel="angular momentum, 1 at the start",
                 ylim=(0.9, 2.1))
    momentum.legend(loc="upper left", fontsize=8)
    for style, (name, label) in zip(figures.STYLES, SCENES.items()):
        some = data.table.only("what", name)
        errors.plot([1000 * h for h in some["h [s]"]], some["value"], label=label, **style)
        if mine:
            own = mine.table.only("what", name)
            errors.plot([1000 * h for h in own["h [s]"]], own["value"], **figures.MINE)
    errors.set(title="four mechanisms", xlabel="h [ms]", ylabel="largest error", xscale="log", yscale="log")
    errors.set_xticks([1, 2, 4, 8], ["1", "2", "4", "8"])
    errors.xaxis.set_minor_locator(NullLocator())
    figures.slope(errors, 2, (4, 7), 3e-5, "2")
    errors.legend(loc="upper left", fontsize=8)
    for axes in (momentum, errors):
        figures.tidy(axes)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
