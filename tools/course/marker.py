"""A stub is a file that still calls not_implemented(), outside comments and strings."""

import re

_SPLICE = r"\\[ \t]*\r?\n"  # joins a line to the next, also within //, /* and */
_COMMENT_OR_LITERAL = re.compile(
    rf"/(?:{_SPLICE})*/(?:{_SPLICE}|[^\n])*"
    rf"|/(?:{_SPLICE})*\*.*?(?:\*(?:{_SPLICE})*/|\Z)"
    r'|R"([^()\\\s]{0,16})\((?:.*?\)\1"|.*)'  # one without an end goes on to the end: each is looked through once
    r'|"(?:\\.|[^"\\\n])*"?'  # one without an end goes on to the end of its line, for the same reason
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])*'?",  # not the quote in 1'000
    re.DOTALL,
)
_MARKER = re.compile(r"\bnot_implemented\s*\(")
_NOTHING_ELSE = re.compile(r"\{\s*not_implemented\s*\([^;{}]*\)\s*;\s*\}")


def code_of(source: str) -> str:
    """Returns the source without comments, strings and characters; every line keeps its number."""
    return _COMMENT_OR_LITERAL.sub(lambda match: " " + "\n" * match.group().count("\n"), source)


def blanked(source: str) -> str:
    """Returns the source with spaces in their place: everything keeps its line and column."""
    return _COMMENT_OR_LITERAL.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), source)


def marker_line(source: str) -> int | None:
    """Returns the line of the first call of not_implemented(), counted from 1."""
    found = _MARKER.search(code_of(source))
    return source_line(code_of(source), found.start()) if found else None


def source_line(source: str, position: int) -> int:
    return source.count("\n", 0, position) + 1


def is_stub(source: str) -> bool:
    return marker_line(source) is not None


def is_untouched(source: str) -> bool:
    """Returns True if a file is a stub and nothing else: one function, which only calls not_implemented()."""
    code = code_of(source)
    return code.count("{") == 2 and _NOTHING_ELSE.search(code) is not None


def is_empty(source: str) -> bool:
    """Tells whether a file has nothing but white space and comments."""
    return not code_of(source).replace("\ufeff", "").strip()
