"""Formats output: colour only on a terminal, plain letters where symbols cannot be printed."""

import os
import sys
import textwrap
import time

WIDTH = 80
_WHOLE_WORDS = {"break_long_words": False, "break_on_hyphens": False}
_CODES = {"green": "32", "red": "31", "yellow": "33", "bold": "1", "dim": "2"}


def prepare() -> None:
    """Keeps text that the terminal cannot print from ending the program."""
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="replace")


def paint(text: str, *styles: str) -> str:
    if not sys.stdout.isatty() or os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return text
    return "".join(f"\033[{_CODES[style]}m" for style in styles) + text + "\033[0m"


def symbol(state: str) -> str:
    fancy = {"done": "✓", "wrong": "✗", "not started": "·"}
    plain = {"done": "+", "wrong": "x", "not started": "-"}
    mark = fancy[state] if _can_print("✓✗·") else plain[state]
    return paint(mark, {"done": "green", "wrong": "red", "not started": "dim"}[state])


def _can_print(text: str) -> bool:
    try:
        text.encode(sys.stdout.encoding or "ascii")
        return True
    except UnicodeEncodeError:
        return False


def counted(count: int, what: str) -> str:
    return f"{count} {what}" + ("" if count == 1 else "s")


def fold(text: str, indent: str = "") -> str:
    """Fills paragraphs to the width; code (fenced, or indented by four) and lists keep their lines."""
    blocks = []
    in_code = False
    for paragraph in text.split("\n\n"):
        fences = paragraph.count("```")
        keep = in_code or fences or paragraph.startswith(("    ", "|", "- ", "$$"))
        in_code ^= fences % 2 == 1
        blocks.append(textwrap.indent(paragraph, indent) if keep else textwrap.fill(
            " ".join(paragraph.split()), WIDTH, initial_indent=indent, subsequent_indent=indent, **_WHOLE_WORDS))
    return "\n\n".join(blocks)


def fold_lines(text: str, indent: str = "") -> str:
    """Breaks each line that is too long, and continues at its own indent: tables keep their layout."""
    return "\n".join(
        textwrap.fill(line, WIDTH, initial_indent=indent,
                      subsequent_indent=indent + line[: len(line) - len(line.lstrip())], **_WHOLE_WORDS)
        for line in text.splitlines())


class Live:
    """Shows how long work takes, on one line of stderr; nothing if it takes less than a second."""

    def __init__(self, what: str, delay: float = 1.0):
        self._what, self._start = what, time.monotonic() + delay
        self._tty = sys.stderr.isatty()
        self._shown = False

    def update(self, detail: str = "") -> None:
        if time.monotonic() < self._start or (self._shown and not self._tty):
            return
        if self._tty:
            line = f"{self._what} {detail}"[: WIDTH - 1]
            print(f"\r\033[K{line}", end="", file=sys.stderr, flush=True)
        else:
            print(f"{self._what} ...", file=sys.stderr, flush=True)
        self._shown = True

    def done(self) -> None:
        if self._shown and self._tty:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


class Bar:
    """Shows a count and its remaining time on one line of stderr."""

    def __init__(self, what: str, total: int):
        self._live, self._total, self._count = Live(what), total, 0
        self._start = time.monotonic()

    def step(self, name: str = "") -> None:
        self._count += 1
        filled = 20 * self._count // self._total
        left = (time.monotonic() - self._start) / self._count * (self._total - self._count)
        bar = f"[{'#' * filled}{'.' * (20 - filled)}]"
        self._live.update(f"{bar} {self._count}/{self._total} {_duration(left)} left {name}")

    def done(self) -> None:
        self._live.done()


def _duration(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"
