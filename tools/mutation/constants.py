"""Changes a number."""

import re
from collections.abc import Iterator

from cpp_source import Source
from mutant import Mutant


def constants(source: Source) -> Iterator[Mutant]:
    for k in source.code:
        token = source.tokens[k]
        if token.kind == "number":
            for other in _others(token.text):
                yield Mutant("constant", token.start, token.end, other)
        elif token.text in ("true", "false"):
            yield Mutant("constant", token.start, token.end, "false" if token.text == "true" else "true")


def _others(number: str) -> list[str]:
    if re.fullmatch(r"\d+", number):
        value = int(number)
        return ["1"] if value == 0 else [str(value - 1), str(value + 1), f"(-{value})"]
    if "x" in number or not re.fullmatch(r"[\d.eE+-]+", number):
        return []
    value = float(number)
    if value == 0:
        return ["1.0"]
    # A number that is written with its power of ten is a tolerance.
    scales = (1e4, 0) if "e" in number.lower() else (2, 0.5)
    return [*(f"{scale * value:.17g}" for scale in scales), f"(-{number})"]


def indices(source: Source) -> Iterator[Mutant]:
    """Changes [k] to [k + 1], col(k) to col(k + 1); numeric indices are constants."""
    for k in source.code:
        token = source.tokens[k]
        if token.kind == "name" and source.is_at(k + 1, "]") and source.is_at(k - 1, "["):
            yield Mutant("index", token.end, token.end, " + 1")
        elif (token.kind == "name" and source.is_at(k + 1, ")") and source.is_at(k - 1, "(")
              and source.tokens[k - 2].text in ("row", "col", "Unit")):
            yield Mutant("index", token.end, token.end, " + 1")
