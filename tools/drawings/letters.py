"""Letters as shapes, so that a drawing looks the same where its fonts are missing: DejaVu Sans for words, STIX for
symbols. Both come with matplotlib."""

import functools
from pathlib import Path

import matplotlib
from matplotlib import ft2font
from matplotlib.path import Path as Outline

EM = 1000  # units of a letter's size
_FONTS = Path(matplotlib.get_data_path(), "fonts", "ttf")
_NO_HINTING = ft2font.LoadFlags.NO_HINTING if hasattr(ft2font, "LoadFlags") else ft2font.LOAD_NO_HINTING
# Each face: its file, and how wide its letters are drawn. DejaVu's own condensed letters are as narrow.
_FACES = {"words": ("DejaVuSans.ttf", 0.88), "upright": ("STIXGeneral.ttf", 1.0),
          "italic": ("STIXGeneralItalic.ttf", 1.0)}
_MARKS = {Outline.MOVETO: "M", Outline.LINETO: "L", Outline.CURVE3: "Q", Outline.CURVE4: "C"}
_POINTS = {Outline.MOVETO: 1, Outline.LINETO: 1, Outline.CURVE3: 2, Outline.CURVE4: 3}


@functools.cache
def _font(face: str) -> ft2font.FT2Font:
    font = ft2font.FT2Font(str(_FONTS / _FACES[face][0]))
    font.set_size(EM, 72)
    return font


@functools.cache
def letter(face: str, character: str) -> tuple[str, float]:
    """The outline of a letter, as the data of an SVG path with y up, and how far the next one is, both in EM."""
    if _font(face).get_char_index(ord(character)) == 0:
        if face == "words":
            raise ValueError(f"no letter for {character!r} in a label")
        face = "words"
    font, wide = _font(face), _FACES[face][1]
    glyph = font.load_char(ord(character), flags=_NO_HINTING)
    points, codes = font.get_path()
    data, k = [], 0
    while k < len(codes):
        if codes[k] == Outline.CLOSEPOLY:
            data.append("Z")
            k += 1
            continue
        count = _POINTS[codes[k]]
        numbers = (f"{round(wide * x)} {round(y)}" for x, y in points[k:k + count])
        data.append(_MARKS[codes[k]] + " ".join(numbers))
        k += count
    return "".join(data), wide * glyph.linearHoriAdvance / 65536
