"""The book's typeface as WOFF2, reduced to the letters of the book."""

import io
from pathlib import Path

from needs import BOOK_FONTS

_FEATURES = ["kern", "liga", "lnum", "tnum", "mark", "ccmp"]
_ALWAYS = "".join(map(chr, range(0x20, 0x7f)))  # what scripts write


def typefaces(text: str) -> dict[Path, bytes]:
    """Returns each font's place in the site and its content, with the letters of `text` only. The same text gives the
    same files."""
    letters = {ord(letter) for letter in text + _ALWAYS}
    return {Path("assets/fonts", f"{font.stem}.woff2"): _subset(font, letters) for font in BOOK_FONTS}


def _subset(font: Path, letters: set[int]) -> bytes:
    from fontTools.subset import Options, Subsetter
    from fontTools.ttLib import TTFont

    options = Options(layout_features=_FEATURES, desubroutinize=True, hinting=False, notdef_outline=True)
    options.drop_tables += ["FFTM"]
    with TTFont(font, recalcTimestamp=False) as face:
        subsetter = Subsetter(options)
        subsetter.populate(unicodes=letters)
        subsetter.subset(face)
        face.flavor = "woff2"
        content = io.BytesIO()
        face.save(content)
        return content.getvalue()
