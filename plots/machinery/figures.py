"""The common part of all figures: numbers of an experiment, a style that is readable in grey, and the caption.

A drawing is a file NAME.py beside its experiment NAME.cpp, with a function draw(data, mine) that returns a figure, a
TITLE, and, at its end,

    if __name__ == "__main__":
        figures.main(draw, TITLE)

    NAME.py --data FOLDER [--mine FOLDER] --out FIGURE.png [--out FIGURE.svg]     .pdf also works
"""

import argparse
import csv
import json
import math
import re
import sys
import textwrap
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.patches import Rectangle  # noqa: E402
from matplotlib.patheffects import withStroke  # noqa: E402
from matplotlib.ticker import NullFormatter  # noqa: E402

# Okabe and Ito's colours: told apart by the colour-blind, and by marker and dash in grey.
STYLES = [{"color": "#0072B2", "marker": "o", "linestyle": "-"},
          {"color": "#D55E00", "marker": "s", "linestyle": "--"},
          {"color": "#009E73", "marker": "^", "linestyle": "-."},
          {"color": "#CC79A7", "marker": "D", "linestyle": ":"},
          {"color": "#E69F00", "marker": "v", "linestyle": "-"},
          {"color": "#56B4E9", "marker": "p", "linestyle": "--"},
          {"color": "#000000", "marker": "x", "linestyle": "-."}]
# Hollow: where yours is as the reference, its marker is seen inside.
MINE = {"marker": "*", "markersize": 12, "fillstyle": "none", "linestyle": "none", "color": "#000000",
        "zorder": 4, "label": "yours"}
INK, FAINT = "#333333", "#DDDDDD"
WIDTH = 8.0  # inches
# On dark paper: these, and greys between paper and ink. Every other colour, such as those of maps, stays.
DARK = {"#ffffff": "#16181c", "#0072b2": "#4db2f0", "#d55e00": "#ff8c42", "#009e73": "#2fc99a",
        "#cc79a7": "#e59ac4", "#e69f00": "#f0b429", "#56b4e9": "#8fd0f5", "#d00000": "#ff6b6b"}
_NUMBER = r"-?\d+\.\d+(?:e-?\d+)?"
DARK_PAPER, DARK_INK = 0x18, 0xE0  # in place of white and of INK


@dataclass
class Table:
    """Rows of a CSV file, with numbers as floats and other cells as text."""

    columns: list[str]
    rows: list[list]

    def only(self, column: str, value) -> "Table":
        """Returns the rows with this value. Throws LookupError if there is none: a curve without points is not seen."""
        k = self.columns.index(column)
        rows = [row for row in self.rows if row[k] == value]
        if not rows:
            raise LookupError(f"no row has {value!r} as {column!r}")
        return Table(self.columns, rows)

    def __getitem__(self, column: str) -> list:
        k = self.columns.index(column)
        return [row[k] for row in self.rows]

    def values(self, column: str) -> list:
        """Returns each value of a column once, in order of appearance."""
        return list(dict.fromkeys(self[column]))


@dataclass
class Data:
    table: Table
    claims: list[dict]

    @classmethod
    def read(cls, folder: Path) -> "Data":
        with open(folder / "table.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        claims = json.loads((folder / "claims.json").read_text(encoding="utf-8"))
        return cls(Table(rows[0], [[_number_or_text(cell) for cell in row] for row in rows[1:]]), claims)


def _number_or_text(cell: str):
    try:
        return float(cell)
    except ValueError:
        return cell


def new(columns: int = 1, height: float = 3.8, polar: int = 0, rows: int = 1, **options):
    """Returns a figure and its axes, the first few of them polar. Further options are those of plt.subplots."""
    plt.rcParams.update({"font.size": 10, "axes.edgecolor": INK, "text.color": INK, "axes.labelcolor": INK,
                         "xtick.color": INK, "ytick.color": INK, "lines.linewidth": 1.6, "lines.markersize": 5.5,
                         "legend.frameon": False, "legend.fontsize": 9, "axes.titlesize": 10})
    if not polar:
        return plt.subplots(rows, columns, figsize=(WIDTH, height), layout="constrained", **options)
    figure = plt.figure(figsize=(WIDTH, height), layout="constrained")
    return figure, [figure.add_subplot(1, columns, k + 1, projection="polar" if k < polar else None)
                    for k in range(columns)]


def maps(data: Data, mine: Data | None, columns: int, height: float, rows: int = 1, **options):
    """Returns a figure of maps, and its parts: the reference's, and below it the student's, if there is one. A part is
    a table, the place of a colour bar, and axes, as of plt.subplots."""
    if mine is None:
        figure, grid = new(columns=columns, height=height, rows=rows, **options)
        return figure, [(data.table, figure, grid)]
    figure, _ = new(height=2 * height + 0.6)
    figure.clear()
    parts = []
    for part, whose, name in zip(figure.subfigures(2, 1), (data, mine), ("the reference", "yours")):
        part.suptitle(name, x=0.012, ha="left", fontsize=10, fontweight="bold")
        parts.append((whose.table, part, part.subplots(rows, columns, **options)))
    return figure, parts


def tidy(axes) -> None:
    axes.grid(color=FAINT, linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        if side in axes.spines:
            axes.spines[side].set_visible(False)


def slope(axes, power: float, x: tuple[float, float], y: float, text: str) -> None:
    """Draws a line of that slope on logarithmic axes from (x[0], y), with its name at its end."""
    end = y * (x[1] / x[0]) ** power
    axes.plot(x, (y, end), color="#999999", linewidth=1)
    axes.annotate(text, (x[1], end), xytext=(4, 0), textcoords="offset points", va="center", fontsize=9)


def front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Returns the points, by cost, that have a smaller error than every cheaper one."""
    kept: list[tuple[float, float]] = []
    for cost, error in sorted(points):
        if not kept or error < kept[-1][1]:
            kept.append((cost, error))
    return kept


def field(axes, table: Table, x: str, y: str, value: str, scale: tuple[float, float],
          lost: str | None = None):
    """Draws a map on logarithmic axes, one cell for each row of the table. The colour shows the value on a logarithmic
    scale, lighter for more. Cells in which the column `lost` is not 0 are white and hatched. Returns the object for a
    colour bar."""
    across, up = sorted(table.values(x)), sorted(table.values(y))
    cells = np.full((len(up), len(across)), np.nan)
    gone = np.zeros(cells.shape, dtype=bool)
    marks = table[lost] if lost else [0] * len(table.rows)
    for column, row, found, mark in zip(table[x], table[y], table[value], marks):
        k = up.index(row), across.index(column)
        gone[k] = mark != 0
        cells[k] = np.nan if gone[k] else min(max(found, scale[0]), scale[1])
    sides = _sides(across), _sides(up)
    mesh = axes.pcolormesh(*sides, cells, cmap="cividis", norm=LogNorm(*scale), rasterized=True)
    for row, column in zip(*np.nonzero(gone)):
        left, right = sides[0][column:column + 2]
        low, high = sides[1][row:row + 2]
        axes.add_patch(Rectangle((left, low), right - left, high - low, facecolor="white",
                                 edgecolor="#888888", hatch="////", linewidth=0))
    axes.set(xscale="log", yscale="log", xlim=sides[0][[0, -1]], ylim=sides[1][[0, -1]])
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_formatter(NullFormatter())  # on short axes they would be written over each other
    return mesh


def _sides(centres: list[float]) -> np.ndarray:
    """Returns the edges of the cells around these values, on a logarithmic axis."""
    log = np.log(centres)
    between = (log[1:] + log[:-1]) / 2
    return np.exp([2 * log[0] - between[0], *between, 2 * log[-1] - between[-1]])


def say_lost(axes, where: str, **place) -> None:
    """Explains the hatching of a map in a legend."""
    patch = Rectangle((0, 0), 1, 1, facecolor="white", edgecolor="#888888", hatch="////", linewidth=0.5)
    axes.legend([*axes.get_legend_handles_labels()[0], patch], [*axes.get_legend_handles_labels()[1], where],
                facecolor="white", framealpha=1, frameon=True, fontsize=8, **place)


def law(axes, x, y, text: str | None = None, **style) -> None:
    """Draws the line of a law over a map, visible on dark and on light cells."""
    edge = [withStroke(linewidth=3.5, foreground="white")]
    axes.plot(x, y, color="#D00000", path_effects=edge, label=text, **style)


def caption(figure: Figure, title: str, text: str) -> None:
    """Writes the title above the figure and its claims below. The figure grows by their height."""
    lines = textwrap.wrap(text, 118)
    if not _can_reserve_room(figure):
        figure.text(0.012, 1.02, title, fontsize=12, fontweight="bold", va="bottom")
        figure.text(0.012, -0.02, "\n".join(lines), fontsize=9, va="top", linespacing=1.35)
        return
    above, below = 0.34, 0.16 + 0.165 * len(lines)
    height = figure.get_figheight()
    total = height + above + below
    figure.set_figheight(total)
    figure.get_layout_engine().set(rect=(0, below / total, 1, height / total))
    figure.text(0.012, 1 - 0.08 / total, title, fontsize=12, fontweight="bold", va="top")
    figure.text(0.012, 0.08 / total, "\n".join(lines), fontsize=9, va="bottom", linespacing=1.35)


def _can_reserve_room(figure: Figure) -> bool:
    """Tells whether this matplotlib reserves room for text. Before 3.6 text is outside the layout, and the saved figure
    grows."""
    return hasattr(figure, "get_layout_engine")


def _sentence(text: str) -> str:
    """Returns the text with a capital letter, unless it begins with a symbol: n sweeps are not N."""
    begins_with_symbol = len(text.split()[0]) == 1 and text[0] != "a"
    return (text[0] if begins_with_symbol else text[0].upper()) + text[1:] + "."


def number(value: float) -> str:
    """Returns a number as 1000, 0.1 or 10⁻⁶."""
    if value != 0 and not 1e-3 < abs(value) < 1e4:
        exponent = round(math.log10(abs(value)))
        if math.isclose(abs(value), 10.0**exponent):
            superscripts = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
            return ("-" if value < 0 else "") + "10" + str(exponent).translate(superscripts)
    return f"{value:g}"


def _with_steady_names(svg: str) -> str:
    """Gives clip paths names by their order. Matplotlib would name those of polar axes by their place in memory."""
    names: dict[str, str] = {}
    return re.sub(r"\b[pm][0-9a-f]{10}\b", lambda found: names.setdefault(found[0], f"shape{len(names)}"), svg)


def on_dark_paper(colour: str) -> str:
    """Returns the colour, as #rrggbb, that takes the place of this one where the reader's page is dark."""
    red, green, blue = (int(colour[k:k + 2], 16) for k in (1, 3, 5))
    if colour in DARK or not red == green == blue:
        return DARK.get(colour, colour)
    ink = int(INK[1:3], 16)
    grey = min(255, round(DARK_PAPER + (DARK_INK - DARK_PAPER) * (255 - red) / (255 - ink)))
    return f"#{grey:02x}{grey:02x}{grey:02x}"


def _short(svg: str) -> str:
    """Returns the same picture with one line for each element, to a hundredth of a point, and without metadata, names
    that nothing refers to, and groups without attributes."""
    def rounded(value: re.Match) -> str:
        return f"{round(float(value[0]), 2) + 0.0:g}" if abs(float(value[0])) < 1e4 else value[0]

    svg = re.sub(r'(?<=href="data:)[^"]*', lambda image: "".join(image[0].split()), svg)
    svg = re.sub(r"<!DOCTYPE.*?>\s*| *<metadata>.*?</metadata>\n", "", svg, flags=re.DOTALL)
    svg = re.sub(r'(?<= )(d|x|y)="([^"]*)"',
                 lambda part: f'{part[1]}="{re.sub(_NUMBER, rounded, " ".join(part[2].split()))}"', svg)
    svg = re.sub("^ +", "", svg, flags=re.MULTILINE)
    used = set(re.findall(r"#([\w-]+)[\")]", svg))
    svg = re.sub(r' id="([^"]*)"', lambda name: name[0] if name[1] in used else "", svg).replace("<g/>\n", "")
    return _without_bare_groups(svg)


def _without_bare_groups(svg: str) -> str:
    inner = r"<g>\n((?:<(?!/?g\b).*\n)*)</g>\n"
    while (less := re.sub(inner, r"\1", svg)) != svg:
        svg = less
    return svg


def _for_light_and_dark(svg: str) -> str:
    """Names the colours, each with its light and its dark value. What knows no such names draws the light ones."""
    found = sorted(set(re.findall(r"(?:fill|stroke): (#[0-9a-f]{6})", svg)))
    named = {colour: f"--c{k}" for k, colour in enumerate(found) if on_dark_paper(colour) != colour}
    if not named:
        return svg
    light, dark = (";".join(f"{name}:{value(colour)}" for colour, name in named.items())
                   for value in (str, on_dark_paper))
    style = f"<style>svg{{{light}}}@media (prefers-color-scheme:dark){{svg{{{dark}}}}}</style>"
    svg = re.sub(r"(fill|stroke): (#[0-9a-f]{6})",
                 lambda use: f"{use[0]}; {use[1]}: var({named[use[2]]})" if use[2] in named else use[0], svg)
    return re.sub(r"(<svg\b[^>]*>)", rf"\1\n{style}", svg, count=1)


def _with_styles_named(svg: str) -> str:
    """Gives each style that is used twice or more a name. Hundreds of ticks would repeat theirs."""
    used = Counter(re.findall(r' style="([^"]*)"', svg))
    names = {style: f"s{k}" for k, style in enumerate(style for style, times in used.items() if times > 1)}
    if not names:
        return svg
    rules = "".join(f".{name}{{{style}}}" for style, name in names.items())
    svg = re.sub(r' style="([^"]*)"', lambda use: f' class="{names[use[1]]}"' if use[1] in names else use[0], svg)
    return re.sub(r"(<svg\b[^>]*>)", lambda start: f"{start[1]}\n<style>{rules}</style>", svg, count=1)


def main(draw: Callable[[Data, Data | None], Figure], title: str) -> None:
    parser = argparse.ArgumentParser(description=title)
    parser.add_argument("--data", type=Path, required=True, help="the folder that the experiment wrote")
    parser.add_argument("--mine", type=Path, help="the same, of a student's functions")
    parser.add_argument("--out", type=Path, action="append", required=True, help="a figure: .png, .svg or .pdf")
    arguments = parser.parse_args()
    try:
        data = Data.read(arguments.data)
        mine = Data.read(arguments.mine) if arguments.mine else None
    except (OSError, ValueError, IndexError) as error:
        sys.exit(f"{parser.prog}: {error!r}")
    save(draw(data, mine), title, " ".join(_sentence(claim["text"]) for claim in data.claims), arguments.out)


def save(figure: Figure, title: str, text: str, paths: list[Path]) -> None:
    caption(figure, title, text)
    for path in paths:
        box = {} if _can_reserve_room(figure) else {"bbox_inches": "tight", "pad_inches": 0.1}
        write(figure, path, dpi=120, **box)


def write(figure: Figure, path: Path, **options) -> None:
    """Saves a figure; an SVG fits a light page and a dark one, and its letters are shapes, so it needs no font."""
    path.parent.mkdir(parents=True, exist_ok=True)
    # Without a date or a version in it, the same numbers give the same bytes.
    metadata = {".svg": {"Date": None, "Creator": None}, ".pdf": {"CreationDate": None, "Creator": None}}.get(
        path.suffix, {"Software": None})
    plt.rcParams.update({"svg.hashsalt": "figure", "svg.fonttype": "path"})
    figure.savefig(path, metadata=metadata, **options)
    if path.suffix == ".svg":
        svg = re.sub(" +$", "", _with_steady_names(path.read_text(encoding="utf-8")), flags=re.MULTILINE)
        path.write_text(_with_styles_named(_for_light_and_dark(_short(svg))), encoding="utf-8")
