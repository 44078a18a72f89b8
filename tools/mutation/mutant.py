"""A change to a file: one place, with another text."""

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Mutant:
    kind: str
    start: int
    end: int
    text: str

    def of(self, source: str) -> str:
        return source[: self.start] + self.text + source[self.end:]

    def line(self, source: str) -> int:
        return source.count("\n", 0, self.start) + 1

    def before(self, source: str) -> str:
        """Returns the changed lines, without comments, on one line."""
        first, last = self._lines(source)
        return _joined(source[first:last])

    def after(self, source: str) -> str:
        first, last = self._lines(source)
        return _joined(source[first:self.start] + self.text + source[self.end:last])

    def _lines(self, source: str) -> tuple[int, int]:
        last = source.find("\n", self.end)
        return source.rfind("\n", 0, self.start) + 1, len(source) if last < 0 else last


def _joined(text: str) -> str:
    return " ".join(re.sub(r"//.*", "", text).split())
