"""Fingerprints of a program that do not change with names, comments and spaces.

Winnowing (Schleimer, Wilkerson, Aiken 2003): every run of K tokens has a number, and the least of each W consecutive
runs is kept. So any K + W - 1 tokens that two programs share give them a common fingerprint.
"""

import re
import zlib
from dataclasses import dataclass

from marker import blanked

K, W = 14, 6
_TOKEN = re.compile(r"[A-Za-z_]\w*|\d[\w.']*|::|->|<<|>>|&&|\|\||[-+*/%<>=!&|^]=|\+\+|--|[^\s\w]")
_KEPT = frozenset("auto bool break case catch const continue do double else false float for if int new nullptr return "
                  "size_t static std struct switch template throw true try typename "
                  "using void while Vec3 Mat3 Quat".split())


@dataclass(frozen=True)
class Token:
    text: str
    start: int  # in the source
    end: int


def tokens_of(source: str) -> list[Token]:
    """Returns the tokens without comments and preprocessor lines. All names of the program's own are equal."""
    code = re.sub(r"^[ \t]*#[^\n]*", lambda line: " " * len(line[0]), blanked(source), flags=re.MULTILINE)
    found = []
    for match in _TOKEN.finditer(code):
        text = match[0]
        if (text[0].isalpha() or text[0] == "_") and text not in _KEPT:
            text = "name"
        found.append(Token(text, match.start(), match.end()))
    return found


def fingerprints(tokens: list[Token]) -> dict[int, int]:
    """Returns each fingerprint, with the start of its first run of tokens."""
    runs = [zlib.crc32(" ".join(token.text for token in tokens[at: at + K]).encode())
            for at in range(max(len(tokens) - K + 1, 0))]
    kept: dict[int, int] = {}
    for begin in range(max(len(runs) - W + 1, 1 if runs else 0)):
        window = runs[begin: begin + W]
        least = min(window)
        kept.setdefault(least, begin + len(window) - 1 - window[::-1].index(least))
    return kept
