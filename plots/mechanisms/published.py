"""Error of mechanisms against time and against the step, by leapfrog and by steps of order four."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Mechanisms with answers from elsewhere: steps of order two and of order four"


def draw(data, mine):
    figure, axes = figures.new(columns=3, height=4.0)
    for scene, style in zip(data.table.values("scene"), figures.STYLES):
        for method, changed in (("composed", {}), ("leapfrog", {"linestyle": ":", "fillstyle": "none"})):
            some = data.table.only("scene", scene).only("method", method)
            label = scene if method == "composed" else None
            for panel, across, along in zip(axes, ("h [s]", "us a second", "h [s]"),
                                            ("error", "error", "energy change")):
                if along == "error" or scene != "andrews":
                    panel.plot(some[across], some[along], **style | changed, label=label)
    for panel in axes:
        panel.set(xscale="log", yscale="log")
        figures.tidy(panel)
    axes[0].set(xlabel="h [s]", ylabel="error of the scene")
    axes[1].set(xlabel="time to compute a second of it [µs]")
    axes[2].set(xlabel="h [s]", ylabel="largest change of energy, over the largest kinetic energy")
    axes[0].plot([], [], color=figures.INK, label="composed")
    axes[0].plot([], [], color=figures.INK, linestyle=":", label="leapfrog")
    axes[0].legend(fontsize=8)
    return figure


if __name__ == "__main__":
    figures.main(draw, TITLE)
