"""Sizes of pictures, so that a page reserves their space and text does not jump when they load."""

import re
import struct
from pathlib import Path

_SVG = re.compile(r'<svg\b[^>]*\bwidth="([0-9.]+)(px|pt|)"[^>]*\bheight="([0-9.]+)(?:px|pt|)"')
_PIXELS = {"": 1, "px": 1, "pt": 4 / 3}


def size_of(picture: Path) -> tuple[int, int] | None:
    """Returns width and height in pixels; None if the file does not contain them."""
    if picture.suffix == ".svg":
        found = _SVG.search(picture.read_text(encoding="utf-8", errors="replace")[:2000])
        return tuple(round(float(found[k]) * _PIXELS[found[2]]) for k in (1, 3)) if found else None
    with picture.open("rb") as file:
        head = file.read(32)
    if head[:8] == b"\x89PNG\r\n\x1a\n":
        return struct.unpack(">II", head[16:24])
    if head[:4] == b"RIFF" and head[8:16] == b"WEBPVP8X":
        return tuple(1 + int.from_bytes(head[k:k + 3], "little") for k in (24, 27))
    return None
