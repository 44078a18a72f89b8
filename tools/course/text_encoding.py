"""Files that an editor saved as something else than UTF-8, which is all that compilers read."""

import codecs
from pathlib import Path

from errors import CourseError
from paths import shown

# Those of UTF-32 first: that of UTF-16 is the beginning of one.
_MARKS = {codecs.BOM_UTF32_LE: "UTF-32", codecs.BOM_UTF32_BE: "UTF-32", codecs.BOM_UTF16_LE: "UTF-16",
          codecs.BOM_UTF16_BE: "UTF-16"}


def encoding_of(content: bytes) -> str:
    """UTF-16 or UTF-32 by its mark at the beginning, or by its zero bytes; empty for what a compiler may read."""
    marked = next((name for mark, name in _MARKS.items() if content.startswith(mark)), "")
    if marked or b"\0" not in content:
        return marked
    return "UTF-32" if b"\0\0\0" in content[:64] else "UTF-16" if content[:64].count(b"\0") >= 16 else "bytes with zeros"


def complaint(file: Path) -> str:
    """One sentence about a file that no compiler reads; empty if there is nothing to complain about."""
    name = encoding_of(file.read_bytes()) if file.exists() else ""
    return f"{shown(file)} is saved as {name}, and the compiler reads UTF-8: save it as UTF-8 in your editor." if name else ""


def refuse_odd(file: Path) -> None:
    if said := complaint(file):
        raise CourseError(said.rstrip("."))
