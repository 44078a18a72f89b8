"""Error against row updates in each step: sweeps and substeps, cold and warm, and two substep methods of games."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

TITLE = "Substeps beat sweeps on a cold wire; a warm start needs enough of either"
METHODS = ("sweeps", "substeps", "warm sweeps", "warm substeps", "XPBD", "relaxed substeps")
LEAST, LOST = 1e-12, 1e6  # drawn at the lower edge, and at the upper one


def draw(data, mine):
    figure, axes = figures.new(columns=2, height=4.2, sharey=True)
    for panel, scene, title in zip(axes, ("wire", "stack"), ("ten links, a load of 100:1", "ten bodies of 1 kg")):
        table = data.table.only("scene", scene)
        for method, style in zip(METHODS, figures.STYLES):
            some = table.only("method", method)
            _line(panel, some["updates"], some["error"], method, style)
        if mine:
            some = mine.table.only("scene", scene)
            some = figures.Table(some.columns, [row for row in some.rows if row[1] in METHODS])
            panel.plot(some["updates"], [max(error, LEAST) for error in some["error"]], **figures.MINE)
        least = table.only("method", "needed")["updates"][0]
        panel.axvline(least, color="#777777", linewidth=1)
        panel.annotate(f"n of (10.12): {least:.3g}", (least, 3e3), xytext=(3, 0), textcoords="offset points",
                       ha="left", va="center", rotation=90, fontsize=8)
        panel.set(xscale="log", yscale="log", ylim=(LEAST / 3, 2 * LOST), xlabel="n, updates of each row in 1/60 s",
                  title=f"{scene}: {title}")
        panel.axhline(1, color="#BBBBBB", linewidth=0.8)
        figures.tidy(panel)
    axes[0].set_ylabel("mean error of the worst gap, over a link")
    axes[0].annotate("lost", (1, LOST), fontsize=8, va="center")
    axes[0].annotate("10⁻¹² or less", (1, LEAST), fontsize=8, va="center")
    axes[0].plot([], [], color=figures.INK, marker="x", linestyle="none", label="lost, or 10⁻¹² or less")
    axes[0].legend(loc="lower left", fontsize=8, bbox_to_anchor=(0, 0.06), title="k = 10⁸ N/m, d = 3, 10 s",
                   title_fontsize=8)
    return figure


def _line(panel, updates, errors, label, style):
    """Draws one curve, with a cross in place of the marker for points beyond either edge."""
    shown = [min(max(error, LEAST), LOST) for error in errors]
    inside = [LEAST < error < LOST for error in errors]
    panel.plot(updates, shown, label=label, **style | {"markevery": [k for k, held in enumerate(inside) if held]})
    beyond = [k for k, held in enumerate(inside) if not held]
    panel.plot([updates[k] for k in beyond], [shown[k] for k in beyond], color=style["color"], marker="x",
               markersize=7, linestyle="none")


if __name__ == "__main__":
    figures.main(draw, TITLE)
