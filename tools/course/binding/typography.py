"""Typesets text that was typed with the keyboard's characters: x_n, 2^l, -1, u', "quoted"."""

import re

_UNITS = r"(?:per cent|kg|km|m|cm|mm|µm|s|ms|µs|ns|min|N|J|Hz|rad|steps?|sweeps?)"
_LETTER = r"(?:(?<![A-Za-z_])[A-Za-z]|[Α-Ωα-ω])"  # a symbol of one letter; a Greek one may follow another

_RULES = tuple((re.compile(pattern), by) for pattern, by in (
    # What belongs together stays on one line: "h = 1/60", "5 s", "chapter 09", "Eq. (4.2)".
    (r"(?<!\S)(\(?\S{1,4}) (=|≤|≥|≈|&lt;|&gt;) (?=\S{1,9}(?!\S))", "\\1\u00a0\\2\u00a0"),
    (rf"(\d) (?={_UNITS}\b|%)", "\\1\u00a0"),
    (r"\b(N|kg) (?=(?:m|s)[²³]?(?![\w²³]))", "\\1\u00a0"),
    (r"\b([Cc]hapters?|Eq\.) (?=\(?\d)", "\\1\u00a0"),
    # An apostrophe, of "it's" and "bodies'"; else a prime, of u'.
    (r"'(?=[A-Za-z])|(?<=[a-z]s)'", "’"),
    (r"(?<=\S)'", "′"),
    (r'(?<![^\s(\[])"', "“"),
    (r'"', "”"),
    # A minus sign, where a hyphen stands for one.
    (r" - ", "\u00a0−\u00a0"),
    (r" -$", "\u00a0−"),
    (r"(?<=[\s(\[=,/+±|≤≥:×·])-(?=[^\s-])", "−"),
    (r"(?<![A-Za-z\d])([A-Za-z])-(?=\d)|(?<=\d)(e)-(?=\d)", r"\1\2−"),
    # Powers and indices.
    (r"\^\(([^()]*)\)|\^(\w)", r"<sup>\1\2</sup>"),
    (rf"({_LETTER})_([A-Za-z]{{1,5}}|\d{{1,2}})(?![A-Za-z_\d])", r"\1<sub>\2</sub>"),
))


def typeset(text: str, begins_a_line: bool = False) -> str:
    """Typesets text in which &, < and > are escaped, outside of code and formulas. Text that does not begin a line
    follows code or a formula without a space, as in `x`-axis."""
    if begins_a_line:
        return typeset(" " + text)[1:]
    for pattern, by in _RULES:
        text = pattern.sub(by, text)
    return text
