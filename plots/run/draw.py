"""Draws columns of runs over time, for ./course run --plot.

    draw.py --data DATA.json --out FIGURE.png [--out FIGURE.svg]

DATA.json has a title, the command, and parts: each a name with its unit, and curves of a label, times and values.
"""

import argparse
import json
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402

_NAMED = 12  # labels; more would hide the curves
_ROUNDINGS = 1e-10  # relative: what changes by less is drawn as constant


def draw(parts: list[dict]):
    figure, grid = figures.new(rows=len(parts), height=0.8 + 2.8 * len(parts), sharex=True, squeeze=False)
    for part, axes in zip(parts, grid[:, 0]):
        for k, curve in enumerate(part["curves"]):
            style = figures.STYLES[k % len(figures.STYLES)]
            axes.plot(curve["time"], curve["values"], label=curve["label"], color=style["color"],
                      linestyle=style["linestyle"], linewidth=1.4)
        axes.set_ylabel(part["name"])
        axes.margins(x=0)
        _calm(axes, [value for curve in part["curves"] for value in curve["values"] if math.isfinite(value)])
        figures.tidy(axes)
        if 1 < len(part["curves"]) <= _NAMED:
            axes.legend(loc="best", ncol=1 + (len(part["curves"]) > 4), frameon=True, framealpha=0.8, edgecolor="none")
    grid[-1, 0].set_xlabel("time [s]")
    return figure


def _calm(axes, values: list[float]) -> None:
    """Sets limits of the axes so that round-off does not fill them."""
    middle = (max(values, default=0) + min(values, default=0)) / 2
    if values and 0 < max(values) - min(values) < _ROUNDINGS * abs(middle):
        axes.set_ylim(sorted((0.9 * middle, 1.1 * middle)))


def main() -> None:
    parser = argparse.ArgumentParser(description="Draws columns of runs over time.")
    parser.add_argument("--data", type=Path, required=True, help="what ./course run --plot writes")
    parser.add_argument("--out", type=Path, action="append", required=True, help="a figure, .png or .svg")
    arguments = parser.parse_args()
    data = json.loads(arguments.data.read_text(encoding="utf-8"))
    figures.save(draw(data["parts"]), data["title"], data["command"], arguments.out)


if __name__ == "__main__":
    main()
