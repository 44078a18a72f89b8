"""Changes a name by one letter, one end, or one sign."""

import re
from collections.abc import Iterator

from cpp_source import Source
from mutant import Mutant

_PAIRS = (
    ("sin", "cos"), ("min", "max"), ("minCoeff", "maxCoeff"), ("cwiseMin", "cwiseMax"), ("lower", "upper"),
    ("lo", "hi"), ("first", "second"), ("row", "col"), ("rows", "cols"), ("head", "tail"), ("floor", "ceil"),
    ("norm", "squaredNorm"), ("topLeftCorner", "bottomRightCorner"), ("lower_bound", "upper_bound"),
    ("i", "j"), ("a", "b"), ("u", "v"), ("1", "2"), ("Zero", "Ones"), ("Identity", "Ones"),
    ("isnan", "isinf"), ("next", "last"), ("linear", "angular"), ("before", "after"))
_OTHER = {one: two for pair in _PAIRS for one, two in (pair, pair[::-1])} | {"Ones": "Zero"}
_TURN = {"x": "y", "y": "z", "z": "x", "UnitX": "UnitY", "UnitY": "UnitZ", "UnitZ": "UnitX"}
# Gi, MinvGj; room_lo, face_i; t1, on_i
_ENDING = re.compile(r"(.*_|[A-Za-z]*[A-Z]|[a-z]+)?(lo|hi|i|j|a|b|u|v|first|second|lower|upper|1|2)")


def names(source: Source) -> Iterator[Mutant]:
    known = {token.text for token in source.tokens}
    for k in source.code:
        token = source.tokens[k]
        other = _other(token.text, called=source.is_at(k + 1, "(")) if token.kind == "name" else ""
        # A member may have a name that nothing else in the file has; a variable may not.
        if other and (other in known or source.tokens[k - 1].text in (".", "->", "::")):
            kind = "function" if source.is_at(k + 1, "(") else "name"
            yield Mutant(kind, token.start, token.end, other)


def _other(name: str, called: bool) -> str:
    if called and name in _TURN:
        return _TURN[name]
    if name in _OTHER:
        return _OTHER[name]
    found = _ENDING.fullmatch(name)
    if not found or not found[1] or (found[1][-1].islower() and not found[2].isdigit()):
        return ""
    return found[1] + _OTHER[found[2]]
