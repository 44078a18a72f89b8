"""Drops a call, or reorders its arguments."""

from collections.abc import Iterator

from cpp_source import Source
from mutant import Mutant

_CAN_BE_DROPPED = {"transpose", "normalized", "conjugate", "inverse", "cwiseInverse", "cwiseAbs", "cwiseAbs2",
                   "asDiagonal", "norm", "array", "diagonal"}
_IN_ANY_ORDER = {"min", "max", "minmax", "dot", "if", "for", "while", "switch", "touch"}
_OF_ONE = {"abs", "sqrt", "exp", "log"}


def calls(source: Source) -> Iterator[Mutant]:
    for k in source.code:
        name = source.tokens[k]
        if name.kind != "name" or not source.is_at(k + 1, "("):
            continue
        if source.is_at(k - 1, ".") and name.text in _CAN_BE_DROPPED and source.is_at(k + 2, ")"):
            yield Mutant("call", source.tokens[k - 1].start, source.tokens[k + 2].end, "")
        if name.text in _OF_ONE:
            begin = source.tokens[k - 2].start if source.is_at(k - 2, "std", "::") else name.start
            yield Mutant("call", begin, name.end, "")
        if name.text == "cross":
            yield from _other_way_round(source, k)
        if name.text not in _IN_ANY_ORDER:
            yield from _exchanged(source, k + 1)


def _exchanged(source: Source, bracket: int) -> Iterator[Mutant]:
    arguments = source.arguments(bracket)
    for (begin, end), (next_begin, next_end) in zip(arguments, arguments[1:]):
        between = source.text[end:next_begin]
        text = source.text[next_begin:next_end] + between + source.text[begin:end]
        yield Mutant("arguments", begin, next_end, text)


def _other_way_round(source: Source, k: int) -> Iterator[Mutant]:
    """Changes a.cross(b) to b.cross(a)."""
    begin = _operand(source, k - 1)
    close = source.partner[k + 1]
    one = source.text[source.tokens[begin].start:source.tokens[k - 1].start]
    two = source.text[source.tokens[k + 1].end:source.tokens[close].start]
    yield Mutant("arguments", source.tokens[begin].start, source.tokens[close].end, f"({two}).cross({one})")


def _operand(source: Source, dot: int) -> int:
    """Returns the first token of the operand before a dot: names, calls and indices joined by dots."""
    k = dot - 1
    while True:
        while source.tokens[k].text in (")", "]"):
            k = source.partner[k] - 1
            if source.tokens[k].kind != "name" and source.tokens[k].text not in (")", "]"):
                return k + 1
        if source.tokens[k - 1].text not in (".", "::"):
            return k
        k -= 2
