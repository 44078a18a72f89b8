"""Error of mechanisms against time and against the step, by leapfrog and by steps of order four."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Composed steps reach order four on seven mechanisms with independent answers"


METHODS = {"composed": {"linestyle": "-"}, "leapfrog": {"linestyle": ":", "fillstyle": "none"}}


def draw(data, mine):
    figure, ((over_step, over_time), (energy, key)) = figures.new(columns=2, rows=2, height=6.6)
    panels = (over_step, "h [s]", "error"), (over_time, "us a second", "error"), (energy, "h [s]", "energy change")
    for scene, style in zip(data.table.values("scene"), figures.STYLES):
        for method, changed in METHODS.items():
            some = data.table.only("scene", scene).only("method", method)
            for panel, across, along in panels:
                if along == "error" or scene != "andrews":
                    panel.plot(some[across], some[along], **style | changed)
        key.plot([], [], **style | METHODS["composed"], label=scene.replace("_", " "))
    for panel, across, along in panels:
        panel.set(xscale="log", yscale="log")
        figures.tidy(panel)
    over_step.set(title="The error, over the step", xlabel="h [s]", ylabel="error of the scene")
    over_time.set(title="The error, over time", xlabel="computing time for a second of motion [µs]")
    energy.set(title="Largest change of the energy", xlabel="h [s]", ylabel="of the largest kinetic energy")
    key.plot([], [], color=figures.INK, **METHODS["composed"], label="composed, order four")
    key.plot([], [], color=figures.INK, **METHODS["leapfrog"], label="leapfrog, five steps for one")
    key.legend(loc="center", fontsize=10)
    key.axis("off")
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
