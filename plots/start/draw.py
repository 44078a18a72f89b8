"""Draws speed against error: the cost of an error, one line for each scene and choice of parameters.

    draw.py --results RESULTS.json --out FIGURE.png

RESULTS.json is a list of outputs of `spook run --json`. Exit status 1 if the numbers do not support the caption.
"""

import argparse
import json
import sys
import textwrap
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "machinery"))
import figures  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
from claims import ROUNDINGS, ClaimError, Series, caption  # noqa: E402
from matplotlib.colors import to_hex, to_rgb  # noqa: E402
from matplotlib.patheffects import withStroke  # noqa: E402
from matplotlib.ticker import LogLocator, NullLocator  # noqa: E402
from matplotlib.transforms import Bbox  # noqa: E402

# Okabe and Ito's colours: told apart by the colour-blind, and by marker and dash in grey.
STYLES = [("#0072B2", "o", "-"), ("#D55E00", "s", "--"), ("#009E73", "^", "-"), ("#CC79A7", "D", "-."),
          ("#000000", "v", "--"), ("#56B4E9", "p", ":"), ("#E69F00", "h", "-"), ("#777777", "<", "--")]
INK, FAINT = "#333333", "#DDDDDD"
HALO = [withStroke(linewidth=3, foreground="white")]


def read(path: Path) -> list[Series]:
    """Returns one series for each scene and set of parameters, in the order of the file."""
    groups: dict[str, list[dict]] = {}
    for result in json.loads(path.read_text(encoding="utf-8")):
        if result["us_per_step"] is not None and result["error"]["value"] is not None:
            key = json.dumps([result["scene"], result["parameters"], result["solver"]])
            groups.setdefault(key, []).append(result)
    if not groups:
        raise ValueError("there is nothing to draw")
    runs = list(groups.values())
    return [Series(points[0]["scene"], choice(points[0], runs), sorted(points, key=order)) for points in runs]


def order(result: dict):
    """Sorts from little work to much."""
    return -result["h"], result["iterations"] or 0


def cost(result: dict) -> float:
    """Returns the time to compute one second of the scene [µs]."""
    return result["us_per_step"] / result["h"]


def choice(result: dict, runs: list[list[dict]]) -> str:
    """Returns the label of a line: parameters in which other lines of its scene differ, and those that were asked
    for."""
    others = [points[0]["parameters"] for points in runs if points[0]["scene"] == result["scene"]]
    asked = {text.split("=")[0] for text in result.get("asked", [])}
    return ", ".join(value if isinstance(value, str) else f"{name} {value:g}"
                     for name, value in result["parameters"].items()
                     if name in asked or any(other[name] != value for other in others))


def draw(all_series: list[Series], text: str):
    plt.rcParams.update({"font.size": 10, "axes.edgecolor": INK, "text.color": INK, "axes.labelcolor": INK,
                         "xtick.color": INK, "ytick.color": INK})
    styled = list(zip(all_series, STYLES * len(all_series)))
    exact = [pair for pair in styled if min(pair[0].errors) < ROUNDINGS]
    lines = textwrap.wrap(text, 122)

    heights = [4.6, 0.25 + 0.27 * len(exact), 0.45 + 0.19 * len(lines)]  # errors, roundings, caption [inches]
    figure = plt.figure(figsize=(8.6, sum(heights) + 1.1))
    total = figure.get_figheight()
    bottom = heights[2] + 0.30
    below = figure.add_axes([0.095, bottom / total, 0.885, heights[1] / total])
    above = figure.add_axes([0.095, (bottom + heights[1] + 0.08) / total, 0.885, heights[0] / total], sharex=below)

    draw_errors(above, styled)
    draw_exact(below, exact)
    costs = [cost(point) for series in all_series for point in series.points]
    above.set_xlim(min(costs) / 1.6, max(costs) * 3)
    name_lines(above, styled)
    draw_guide(above)
    figure.text(0.02, 1 - 0.32 / total, "At order two, half the step gives a quarter of the error", fontsize=14, fontweight="bold")
    figure.text(0.02, 1 - 0.54 / total, subtitle(all_series), fontsize=9)
    figure.text(0.02, 0.12 / total, "\n".join(lines), fontsize=9, va="bottom", linespacing=1.4)
    return figure


def draw_errors(axes, styled) -> None:
    """Draws errors above round-off against their cost."""
    axes.set(xscale="log", yscale="log", ylabel="error, relative")
    for series, (colour, marker, dash) in styled:
        shown = [(cost(point), error) for point, error in zip(series.points, series.errors) if error > 0]
        if max(series.errors) >= ROUNDINGS:
            axes.plot(*zip(*shown), color=colour, marker=marker, linestyle=dash, linewidth=1.6, markersize=6.5,
                      markeredgecolor="white", markeredgewidth=0.7)
            doubtful = [(cost(point), error) for point, error in zip(series.points, series.errors)
                        if error > 0 and point["state"]["name"] != "sound"]
            axes.plot([x for x, _ in doubtful], [y for _, y in doubtful], color=colour, marker=marker, markersize=6.5,
                      linestyle="none", markerfacecolor="white")
    errors = [error for series, _ in styled for error in series.errors if error >= ROUNDINGS]
    axes.set_ylim(min(errors) / 8, max(errors) * 8)
    axes.yaxis.set_major_locator(LogLocator(numticks=12))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.grid(color=FAINT, linewidth=0.6)
    axes.tick_params(axis="x", which="both", length=0, labelbottom=False)
    axes.spines[["top", "right", "bottom"]].set_visible(False)


def draw_exact(axes, exact) -> None:
    """Draws a row for each series that reaches round-off, where a logarithm would only magnify noise."""
    axes.set(xscale="log", xlabel="time to compute one second of the scene [µs]", ylim=(-0.7, len(exact) - 0.3))
    axes.invert_yaxis()
    dearest = max((cost(point) for series, _ in exact for point in series.points), default=1)
    for row, (series, (colour, marker, dash)) in enumerate(exact):
        shown = [cost(point) for point, error in zip(series.points, series.errors) if error < ROUNDINGS]
        axes.plot(shown, [row] * len(shown), color=colour, marker=marker, linestyle=dash, linewidth=1.6, markersize=6.5,
                  markeredgecolor="white", markeredgewidth=0.7)
        onward = max(shown) < dearest / 4  # with room on the right
        axes.annotate(series.label, (max(shown) if onward else min(shown), row), xytext=(8 if onward else -8, 0),
                      textcoords="offset points", ha="left" if onward else "right", va="center", fontsize=9,
                      color=darker(colour))
    axes.set_yticks([])
    axes.set_ylabel("exact", rotation=0, ha="right", va="center", labelpad=6)
    axes.set_facecolor("#F4F4F4")
    axes.grid(axis="x", color=FAINT, linewidth=0.6)
    axes.spines[["top", "right", "left"]].set_visible(False)


def name_lines(axes, styled) -> None:
    """Writes each line's name beside its last or its first point."""
    shown = [[(cost(point), error) for point, error in zip(series.points, series.errors) if error >= ROUNDINGS]
             for series, _ in styled]
    markers = [axes.transData.transform(point) for points in shown for point in points]
    names: list[Bbox] = []
    for (series, (colour, _, _)), points in zip(styled, shown):
        if points:
            names.append(place_name(axes, series.label, colour, points, markers, names))


def place_name(axes, label, colour, points, markers, names) -> Bbox:
    """Writes a name at the first of some places where it hides no marker and no other name, or else at the last of
    them."""
    first, last = points[0], points[-1]
    for point, offset in ((last, (8, 0)), (first, (-4, 12)), (last, (0, -13)), (first, (8, 10))):
        name = axes.annotate(label, point, xytext=offset, textcoords="offset points", va="center", fontsize=9,
                             color=darker(colour), path_effects=HALO)
        box = name.get_window_extent(axes.figure.canvas.get_renderer())
        free = not box.padded(3).count_contains(markers) and not any(box.overlaps(other) for other in names)
        if free:
            break
        name.set_visible(False)
    name.set_visible(True)
    return box


def darker(colour: str) -> str:
    """Returns the same hue, dark enough for letters."""
    return to_hex([0.72 * channel for channel in to_rgb(colour)])


def draw_guide(axes) -> None:
    """Explains the slopes, in the corner that has no points."""
    x = axes.get_xlim()[0] * 1.5
    y = axes.get_ylim()[1] / 6
    axes.annotate("twice the time buys", (x, y), xytext=(0, 6), textcoords="offset points", fontsize=9)
    for power, gain in ((1, "half the error: order 1"), (2, "a quarter: order 2")):
        end = (5 * x, y / 5**power)
        axes.plot([x, end[0]], [y, end[1]], color="#999999", linewidth=1)
        axes.annotate(gain, end, xytext=(5, 0), textcoords="offset points", va="center", fontsize=9)


def subtitle(all_series: list[Series]) -> str:
    """Describes the points of a line."""
    steps = sorted({point["h"] for series in all_series if series.varies_h for point in series.points})
    said = [f"A point for each step h, from {1000 * steps[-1]:.3g} to {1000 * steps[0]:.3g} ms"] if steps else []
    said += [f"{series.label}: for each number of sweeps, h = {1000 * series.points[0]['h']:.3g} ms"
             for series in all_series if not series.varies_h and len(series.points) > 1]
    if any(point["state"]["name"] != "sound" for series in all_series for point in series.points):
        said.append("hollow: not solved")
    return "; ".join(said)


def main() -> int:
    parser = argparse.ArgumentParser(description="Draws speed against error.")
    parser.add_argument("--results", type=Path, required=True, help="a list of what `spook run --json` printed")
    parser.add_argument("--out", type=Path, required=True, help="the figure")
    arguments = parser.parse_args()
    try:
        all_series = read(arguments.results)
        figures.write(draw(all_series, caption(all_series)), arguments.out, dpi=150)
    except ClaimError as error:
        print(f"draw.py: {error}", file=sys.stderr)
        return 1
    except (OSError, ValueError, KeyError, TypeError) as error:
        print(f"draw.py: {arguments.results}: {error!r}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
