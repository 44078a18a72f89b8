"""Drops a statement, negates a condition, or ends a loop elsewhere."""

from collections.abc import Iterator

from cpp_source import Source
from mutant import Mutant

_LEAVE = {"return", "break", "continue"}


def statements(source: Source) -> Iterator[Mutant]:
    for k in source.code:
        if source.begins_statement(k) and (source.is_expression(k) or _leaves_early(source, k)):
            end = source.up_to(k, ";")
            if source.is_at(end, ";"):
                yield Mutant("statement", source.tokens[k].start, source.tokens[end].end, ";")


def conditions(source: Source) -> Iterator[Mutant]:
    for k in source.code:
        if source.tokens[k].text in ("if", "while") and source.is_at(k + 1, "("):
            begin, end = source.tokens[k + 1].end, source.tokens[source.partner[k + 1]].start
            condition = source.text[begin:end]
            yield Mutant("condition", begin, end, f"!({condition})")
            yield Mutant("condition", begin, end, f"false && ({condition})")
            if source.tokens[k].text == "if":
                yield Mutant("condition", begin, end, f"true || ({condition})")
        elif source.tokens[k].text == "?":
            colon = source.up_to(k + 1, ":")
            if not source.is_at(colon, ":"):
                continue
            end = source.tokens[source.up_to(colon + 1, ";", ",") - 1].end
            yes = source.text[source.tokens[k + 1].start:source.tokens[colon - 1].end]
            no = source.text[source.tokens[colon + 1].start:end]
            yield Mutant("condition", source.tokens[k + 1].start, end, f"{no} : {yes}")


def loops(source: Source) -> Iterator[Mutant]:
    """Ends for (...; k < n; ...) one earlier; one later is `<=`, an operator."""
    for k in source.code:
        if source.is_at(k, "for", "("):
            first = source.up_to(k + 2, ";")
            if not source.is_at(first, ";"):
                continue
            end = source.tokens[source.up_to(first + 1, ";")].start
            yield Mutant("bound", end, end, " - 1")


def _leaves_early(source: Source, k: int) -> bool:
    """Tells whether a return is early. A function's last return is not: without it there is no result."""
    if source.tokens[k].text not in _LEAVE:
        return False
    last = source.is_at(source.up_to(k, ";") + 1, "}")
    return not last or source.tokens[k - 1].text in (")", "else")
