"""Detects files that an editor did not save as UTF-8, the only encoding that the compiler reads."""

import codecs
from pathlib import Path

from errors import CourseError
from paths import shown

# Those of UTF-32 first: that of UTF-16 is the beginning of one.
_MARKS = {codecs.BOM_UTF32_LE: "UTF-32", codecs.BOM_UTF32_BE: "UTF-32", codecs.BOM_UTF16_LE: "UTF-16",
          codecs.BOM_UTF16_BE: "UTF-16"}


def encoding_of(content: bytes) -> str:
    """Detects UTF-16 or UTF-32 by its mark or by its zero bytes; empty for what a compiler may read."""
    marked = next((name for mark, name in _MARKS.items() if content.startswith(mark)), "")
    if marked or b"\0" not in content:
        return marked
    beginning = content[:64]
    if b"\0\0\0" in beginning:
        return "UTF-32"
    return "UTF-16" if beginning.count(b"\0") >= 16 else "bytes with zeros"


def decoded(content: bytes) -> str:
    """Decodes UTF-8, UTF-16 or UTF-32, with or without a mark, and takes all else for Latin-1."""
    name = encoding_of(content)
    if name in ("UTF-16", "UTF-32"):
        marked = content.startswith(tuple(_MARKS))
        big = content[:64:2].count(0) > content[1:64:2].count(0)  # the high byte of a Latin letter is 0
        return content.decode(name if marked else name + ("-BE" if big else "-LE"))
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def complaint(file: Path) -> str:
    """Says in one sentence that no compiler reads the file; empty if compilers read it."""
    name = encoding_of(file.read_bytes()) if file.exists() else ""
    if not name:
        return ""
    return f"{shown(file)} is saved as {name}, and the compiler reads UTF-8: save it as UTF-8 in your editor."


def refuse_odd(file: Path) -> None:
    if said := complaint(file):
        raise CourseError(said.rstrip("."))
