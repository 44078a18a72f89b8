"""Changes an operator, or adds or drops a sign."""

from collections.abc import Iterator

from cpp_source import Source
from mutant import Mutant

_BINARY = {
    "+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",), "+=": ("-=", "="), "-=": ("+=", "="),
    "*=": ("/=", "="), "/=": ("*=", "="), "<": ("<=", ">="), "<=": ("<", ">"),
    ">": (">=", "<="), ">=": (">", "<"),
    "==": ("!=",), "!=": ("==",), "&&": ("||",), "||": ("&&",), "=": ("+=", "-="),
}
# They say the same of x and of -x.
_ASK_WHETHER_FINITE = {"require_all_finite", "require_finite", "isfinite", "isnan", "isinf"}
_BEFORE_AN_OPERAND = {"(", "=", "return", ",", "?", ":", "+=", "*", "/", "<", ">", "<=", ">=", "{"}
_NO_OPERAND = {"const", "auto", "int", "double", "bool", "return", "static_cast", "true", "false", "using",
               "if", "for", "while", "else", "static", "constexpr", "template", "typename", "break",
               "continue"}


def operators(source: Source) -> Iterator[Mutant]:
    for k in source.code:
        token = source.tokens[k]
        if token.kind == "sign" and source.spaced(k) and source.text[token.end] in " \n":
            if token.text == "=" and not source.is_assignment(k):
                continue
            for other in _BINARY.get(token.text, ()):
                yield Mutant("operator", token.start, token.end, other)
        elif token.text in ("-", "!"):
            yield Mutant("sign", token.start, token.end, "")
        elif token.text in ("++", "--"):
            yield Mutant("operator", token.start, token.end, "--" if token.text == "++" else "++")


def added_signs(source: Source) -> Iterator[Mutant]:
    for k in source.code:
        token, before = source.tokens[k], source.tokens[k - 1].text
        starts = token.kind == "name" and token.text not in _NO_OPERAND and before in _BEFORE_AN_OPERAND
        if source.is_at(k + 1, ")") and _is_asked_to_be_finite(source, k):
            continue
        is_sign = before in ("*", "/", "<", ">") and not source.spaced(k - 1)  # a pointer's, a template's
        if starts and not is_sign:
            yield Mutant("sign", token.start, token.start, "-")


def _is_asked_to_be_finite(source: Source, k: int) -> bool:
    """Tells whether k, before a closing bracket, is the last argument of one of those calls."""
    return source.tokens[source.partner[k + 1] - 1].text in _ASK_WHETHER_FINITE
