"""A pen that writes SVG: a few shapes, labels with the lesson's symbols, and one style, for light pages and dark ones.

Points are (x, y) in pixels, y down, on a card of 720 pixels' width. `Frame` and `View` bring metres there, from two and
from three dimensions. A style is a colour and perhaps a weight, "impulse bold"; see palette.py. In a label, what is
between $ signs is mathematics: "the arm $r_i$", "$v_{n+1/2}$", "$h^2 K$".
"""

import math
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from html import escape

from letters import EM, letter
from palette import SIZES, style_sheet

Point = tuple[float, float]
WIDTH = 720
_RUN = re.compile(r"([_^])(?:\{([^}]*)\}|(.))|([^_^]+)")
_SHIFT = {"": 0, "_": 5, "^": -7}  # pixels down
_SYMBOLS, _RAISED = 1.2, 0.85  # sizes of symbols, and of those that are raised or lowered, over that of words
_TAGS = re.compile(r"class=\"([^\"]*)\"")


@dataclass(frozen=True)
class Label:
    words: str
    left: float
    right: float
    top: float
    bottom: float


class Drawing:
    def __init__(self, height: float, title: str, width: float = WIDTH):
        self.width, self.height, self.title = width, height, title
        self.labels: list[Label] = []
        self._parts: list[str] = []
        self._letters: dict[tuple[str, str], str] = {}  # names of their outlines
        self._shapes: list[str] = []  # outlines of letters, and labels made of them

    def svg(self) -> str:
        used = {word for part in self._shapes + self._parts for words in _TAGS.findall(part) for word in words.split()}
        size = f'width="{_number(self.width)}" height="{_number(self.height)}"'
        return "\n".join([
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_number(self.width)} {_number(self.height)}" '
            f'{size} role="img">', f"<title>{escape(self.title)}</title>", f"<style>{style_sheet(used)}</style>",
            *(["<defs>", *self._shapes, "</defs>"] if self._shapes else []),
            f'<rect class="paper" {size} rx="10"/>', *self._parts, "</svg>", ""])

    def line(self, start: Point, end: Point, style: str = "ink") -> None:
        self.path([start, end], style)

    def path(self, points: Iterable[Point], style: str = "ink", closed: bool = False) -> None:
        """Draws straight lines from point to point; a style with "fill" fills the shape with the colour's tint."""
        data = "M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in points) + ("Z" if closed else "")
        self._add("path", style, d=data)

    def circle(self, centre: Point, radius: float, style: str = "ink") -> None:
        self._add("circle", style, cx=centre[0], cy=centre[1], r=radius)

    def dot(self, centre: Point, style: str = "ink", radius: float = 4) -> None:
        self._add("circle", f"on-{style}", cx=centre[0], cy=centre[1], r=radius)

    def box(self, corner: Point, width: float, height: float, style: str = "ink", round_by: float = 0) -> None:
        self._add("rect", style, x=corner[0], y=corner[1], width=width, height=height,
                  **({"rx": round_by} if round_by else {}))

    def bar(self, corner: Point, width: float, height: float, style: str) -> None:
        """Draws a box of a full colour."""
        self._add("rect", f"on-{style}", x=corner[0], y=corner[1], width=width, height=height)

    def arrow(self, start: Point, end: Point, style: str = "ink", both: bool = False) -> None:
        """Draws an arrow from start to its tip at end."""
        colour = style.split()[0]
        size = 13 if "bold" in style else 9 if "thin" in style else 11
        length = math.dist(start, end)
        unit = ((end[0] - start[0]) / length, (end[1] - start[1]) / length)
        back = 0.8 * min(size, length)
        self.line(_along(start, unit, back) if both else start, _along(end, unit, -back), style)
        self._head(end, unit, size, colour)
        if both:
            self._head(start, (-unit[0], -unit[1]), size, colour)

    def arc(self, centre: Point, radius: float, start: float, end: float, style: str = "ink",
            arrow: bool = False) -> None:
        """Draws an arc. Angles are in degrees, counterclockwise from the right; from start to end, either way
        around."""
        count = max(2, int(abs(end - start) / 4) + 1)
        last = end - math.copysign(math.degrees(8 / radius), end - start) if arrow else end
        self.path((turned(centre, radius, start + (last - start) * k / count) for k in range(count + 1)), style)
        if arrow:
            away = math.radians(end) + math.copysign(math.pi / 2 - 0.35 * 9 / radius, end - start)
            self._head(turned(centre, radius, end), (math.cos(away), -math.sin(away)), 10, style.split()[0])

    def curve(self, function: Callable[[float], Point], start: float, end: float, style: str = "ink",
              count: int = 80) -> None:
        self.path([function(start + (end - start) * k / count) for k in range(count + 1)], style)

    def spring(self, start: Point, end: Point, style: str = "ink", turns: int = 6, width: float = 9) -> None:
        """Draws a zigzag between two short straight ends."""
        length = math.dist(start, end)
        unit = ((end[0] - start[0]) / length, (end[1] - start[1]) / length)
        across = (-unit[1], unit[0])
        lead = 0.15 * length
        points = [start, _along(start, unit, lead)]
        for k in range(2 * turns):
            at = _along(start, unit, lead + (length - 2 * lead) * (k + 0.5) / (2 * turns))
            points.append(_along(at, across, width if k % 2 else -width))
        self.path([*points, _along(end, unit, -lead), end], style)

    def text(self, at: Point, label: str, style: str = "ink", anchor: str = "middle", size: str = "") -> None:
        """`at` is on the base line; anchor is start, middle or end; size is "", small or large."""
        for k, line in enumerate(label.split("\n")):
            self._line_of_text((at[0], at[1] + 21 * k), line, style, anchor, SIZES[size])

    def _line_of_text(self, at: Point, line: str, style: str, anchor: str, size: float) -> None:
        scale = size / EM
        letters, width = self._placed(line, scale)
        left = at[0] - {"start": 0, "middle": width / 2, "end": width}[anchor] * scale
        name = f"t{len(self.labels)}"
        self._shapes.append(f'<g id="{name}" transform="translate({_number(left)} {_number(at[1])}) '
                            f'scale({scale:g} {-scale:g})">{letters}</g>')
        # First a rim of paper, which keeps what the label crosses away from its letters.
        for classes in ("rim", f"on-{style}"):
            self._parts.append(f'<use class="{classes}" href="#{name}"/>')
        self.labels.append(Label(line.replace("$", ""), left, left + width * scale, at[1] - 0.7 * size, at[1] + 2))

    def _placed(self, line: str, scale: float) -> tuple[str, float]:
        """The letters of a line, side by side, and its width, in EM."""
        uses, x = [], 0.0
        for face, text, size, down in _runs(line):
            placed, inside = [], 0.0
            for character in text:
                data, onward = letter(face, character)
                if data:
                    placed.append(f'<use href="#{self._outline(face, character, data)}" x="{round(inside)}"/>')
                inside += onward
            where = [f"translate({round(x)} {round(-down / scale)})"] if x or down else []
            where += [f"scale({size:g})"] if size != 1 else []
            uses.append(f'<g transform="{" ".join(where)}">{"".join(placed)}</g>' if where else "".join(placed))
            x += size * inside
        return "".join(uses), x

    def _outline(self, face: str, character: str, data: str) -> str:
        """The name of a letter's outline, which is written once."""
        if (face, character) not in self._letters:
            self._letters[face, character] = f"g{len(self._letters)}"
            self._shapes.append(f'<path id="{self._letters[face, character]}" class="letter" d="{data}"/>')
        return self._letters[face, character]

    def _head(self, tip: Point, unit: Point, size: float, colour: str) -> None:
        left, right = (-unit[1], unit[0]), (unit[1], -unit[0])
        base = _along(tip, unit, -size)
        points = [tip, _along(base, left, 0.42 * size), _along(base, right, 0.42 * size)]
        self._add("path", f"on-{colour}", d="M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in points) + "Z")

    def _add(self, shape: str, style: str, **values) -> None:
        words = " ".join(f'{name}="{value if isinstance(value, str) else _number(value)}"'
                         for name, value in values.items())
        self._parts.append(f'<{shape} class="{style}" {words}/>')


class Frame:
    """Maps metres in a plane, y up, to pixels: frame(x, y)."""

    def __init__(self, origin: Point, scale: float, scale_y: float | None = None):
        self.origin, self.scale, self.scale_y = origin, scale, scale_y or scale

    def __call__(self, x: float, y: float) -> Point:
        return self.origin[0] + self.scale * x, self.origin[1] - self.scale_y * y


class View:
    """Maps metres in space, z up, seen from a direction without perspective, to pixels: view(x, y, z)."""

    def __init__(self, origin: Point, scale: float, azimuth: float = 30, elevation: float = 20):
        a, e = math.radians(azimuth), math.radians(elevation)
        self.origin, self.scale = origin, scale
        self.right = (-math.sin(a), math.cos(a), 0.0)
        self.up = (-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e))
        self.towards = (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))

    def __call__(self, x: float, y: float, z: float) -> Point:
        across = sum(a * b for a, b in zip(self.right, (x, y, z)))
        above = sum(a * b for a, b in zip(self.up, (x, y, z)))
        return self.origin[0] + self.scale * across, self.origin[1] - self.scale * above

    def depth(self, x: float, y: float, z: float) -> float:
        """Returns the depth of a point; larger is nearer to the eye."""
        return sum(a * b for a, b in zip(self.towards, (x, y, z)))


def turned(centre: Point, radius: float, degrees: float) -> Point:
    a = math.radians(degrees)
    return centre[0] + radius * math.cos(a), centre[1] - radius * math.sin(a)


def between(start: Point, end: Point, part: float = 0.5) -> Point:
    return start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])


def _along(start: Point, unit: Point, by: float) -> Point:
    return start[0] + by * unit[0], start[1] + by * unit[1]


def _number(value: float) -> str:
    """Returns a coordinate to a tenth of a pixel. It is rounded twice, so that a computation's last bits change
    nothing."""
    return f"{round(round(float(value), 6), 1) + 0.0:g}" if abs(value) < 1e5 else f"{value:.0f}"


def _runs(label: str) -> list[tuple[str, str, float, float]]:
    """A label's pieces: face, text, size over that of words, pixels down. Mathematics is between $ signs."""
    result = []
    for k, part in enumerate(label.split("$")):
        result += _mathematics(part) if k % 2 else [("words", part, 1, 0)] if part else []
    return result


def _mathematics(part: str) -> list[tuple[str, str, float, float]]:
    result = []
    for mark, group, single, plain in _RUN.findall(part):
        size = _RAISED if mark else _SYMBOLS
        result += [("italic" if letters else "upright", text, size, _SHIFT[mark])
                   for letters, text in _letters(group or single or plain)]
    return result


def _letters(text: str) -> list[tuple[bool, str]]:
    """Letters are in italics; digits, capital Greek, signs, and words such as cos upright."""
    found = re.findall(r"([A-Za-zα-ω]+)|([^A-Za-zα-ω]+)", text)
    return [(0 < len(letters) < 3, letters or others) for letters, others in found]
