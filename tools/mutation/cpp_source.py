"""C++ as tokens, as far as a mutator needs: names, operators, and the insides of functions."""

import re
from dataclasses import dataclass
from functools import cached_property

_TOKEN = re.compile(r"""
    (?P<skip>\s+|//[^\n]*|/\*.*?\*/|^[ ]*\#[^\n]*)
  | (?P<text>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')
  | (?P<number>(?:0[xX][0-9a-fA-F']+|(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[uUlLfF]*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<sign><=>|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|::|.)
""", re.VERBOSE | re.MULTILINE | re.DOTALL)
_NO_EXPRESSION = {"const", "auto", "if", "for", "while", "else", "using", "static", "struct", "class",
                  "template", "switch", "case", "do", "int", "double", "bool", "explicit", "private",
                  "public", "constexpr", "return", "typename", "default", "break", "continue"}
_CLOSING = {"(": ")", "[": "]", "{": "}"}


@dataclass(frozen=True)
class Token:
    kind: str  # text, number, name, sign
    text: str
    start: int
    end: int


class Source:
    """A file, laid out by clang-format: a space before binary operators, none before a template's `<`."""

    def __init__(self, text: str):
        self.text = text
        self.tokens = [Token(found.lastgroup, found[0], found.start(), found.end())
                       for found in _TOKEN.finditer(text) if found.lastgroup != "skip"]

    def is_at(self, k: int, *texts: str) -> bool:
        """Tells whether these tokens are at k."""
        return [token.text for token in self.tokens[max(k, 0):k + len(texts)]] == list(texts)

    def spaced(self, k: int) -> bool:
        """Tells whether there is a space before token k, which makes an operator binary."""
        return k > 0 and self.tokens[k - 1].end < self.tokens[k].start

    @cached_property
    def partner(self) -> dict[int, int]:
        """Returns the closing bracket of each opening one, and the reverse."""
        pairs, stack = {}, []
        for k, token in enumerate(self.tokens):
            if token.text in _CLOSING and token.kind == "sign":
                stack.append(k)
            elif stack and token.text == _CLOSING[self.tokens[stack[-1]].text] and token.kind == "sign":
                pairs[k] = stack.pop()
                pairs[pairs[k]] = k
        return pairs

    @cached_property
    def code(self) -> list[int]:
        """Returns the tokens that can be changed: those between a function's or a class's braces, without template
        arguments, and the values of constants outside."""
        inside = []
        begin = k = 0
        while k < len(self.tokens):
            text = self.tokens[k].text
            if text == "{" and not any(self.is_at(at, "namespace") for at in range(begin, k)):
                inside += range(k + 1, self.partner[k])
                begin = k = self.partner[k] + 1
                continue
            if text == ";" and not self.is_at(begin, "template"):
                first = next((at for at in range(begin, k) if self.tokens[at].text in ("=", "(")), k)
                inside += range(first + 1, k) if self.is_at(first, "=") else ()
            k += 1
            if text in (";", "{", "}"):
                begin = k
        return [k for k in inside if k not in self._in_angles and k not in self._of_no_contract]

    @cached_property
    def _of_no_contract(self) -> set[int]:
        """Returns tokens that no contract fixes: an error's words beside the parameter's name, and reserved sizes."""
        inside: set[int] = set()
        for k in range(len(self.tokens)):
            if self.is_at(k, "reject", "("):
                inside |= set(range(k + 2, self.partner[k + 1]))
            elif self.is_at(k, ".", "reserve", "("):
                inside |= set(range(k - 1, self.partner[k + 2]))
        return inside

    @cached_property
    def _in_angles(self) -> set[int]:
        """Returns templates' angle brackets and their content."""
        inside: set[int] = set()
        for k, token in enumerate(self.tokens):
            opens = token.text == "<" and k > 0 and (not self.spaced(k) or self.is_at(k - 1, "template"))
            if opens and k not in inside:
                inside |= set(range(k, self._angle_end(k) + 1))
        return inside

    def _angle_end(self, k: int) -> int:
        depth = 0
        for at in range(k, len(self.tokens)):
            text = self.tokens[at].text
            depth += {"<": 1, ">": -1, ">>": -2}.get(text, 0)
            if depth <= 0 or text in (";", "{"):
                return at
        return k

    def up_to(self, k: int, *ends: str) -> int:
        """Returns the first of these tokens from k on, past brackets; or the end of the bracket around k."""
        while k < len(self.tokens) and self.tokens[k].text not in ends:
            if self.tokens[k].text in _CLOSING:
                k = self.partner.get(k, k)
            elif k in self.partner:
                break
            k += 1
        return min(k, len(self.tokens) - 1)

    def arguments(self, k: int) -> list[tuple[int, int]]:
        """Returns the arguments of the bracket that opens at k, as ranges in the text."""
        close, begin, found = self.partner[k], k + 1, []
        while begin < close:
            end = self.up_to(begin, ",")
            found.append((self.tokens[begin].start, self.tokens[end - 1].end))
            begin = end + 1
        return found

    def begins_statement(self, k: int) -> bool:
        before = self.tokens[k - 1].text
        if before == ")":
            return self.tokens[self.partner[k - 1] - 1].text in ("if", "for", "while", "constexpr")
        return before in (";", "{", "}", "else")

    def is_member(self, k: int) -> bool:
        """Tells whether the statement at k declares a member of a struct or a class."""
        opens = max((at for at in self.partner if at < k < self.partner[at] and self.is_at(at, "{")), default=0)
        return self.is_at(opens - 2, "struct") or self.is_at(opens - 2, "class")

    def is_expression(self, k: int) -> bool:
        """Tells whether the statement that begins at k is an expression, and declares nothing."""
        if self.tokens[k].kind != "name":
            return self.tokens[k].text in ("++", "--", "*")
        if self.tokens[k].text in _NO_EXPRESSION:
            return False
        while self.is_at(k + 1, "::"):
            k += 2
        if k + 1 in self._in_angles:
            return False
        # Name and name, `Net net;`, or name and reference, `Vec3& a = ...`: a declaration.
        following = self.tokens[k + 1]
        return following.kind == "sign" and following.text not in ("&", "*", "{", ":")

    def is_assignment(self, k: int) -> bool:
        """Tells whether the `=` at k assigns to an existing variable."""
        begin = k
        while begin > 0 and not self.begins_statement(begin):
            begin = self.partner[begin] if self.tokens[begin].text in (")", "]") else begin
            begin -= 0 if self.begins_statement(begin) else 1
        return self.is_expression(begin)
