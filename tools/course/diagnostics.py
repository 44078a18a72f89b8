"""Extracts the useful part of a compiler's messages for a student."""

import re

from manifest import Exercise
from paths import ROOT

_ANSI = re.compile(r"\x1b\[[0-9;]*[mK]")
_ERROR = re.compile(r"^(?P<file>[^\s:]+):\d+:\d+: (?:fatal )?error: ")
_LOCATED = re.compile(r"^[^\s:]+:\d+:(?:\d+:)? |^\[\d+/\d+\]|^ninja: |^In file included")
# GNU's linker, LLVM's, and Apple's.
_LINKER = re.compile(r"(undefined reference to|multiple definition of|undefined symbol:|duplicate symbol:?"
                     r"|Undefined symbols for) .*$")
_DETAIL_LINES = 4


def _lines(output: str) -> list[str]:
    return _ANSI.sub("", output).replace(f"{ROOT}/", "").splitlines()


def first_error(output: str, exercise: Exercise) -> list[str]:
    """Returns the first error with its code, below the student's line that led there."""
    lines = _lines(output)
    name = exercise.file.name
    for k, line in enumerate(lines):
        found = _ERROR.match(line)
        if found:
            led_there = [] if found["file"].endswith(name) else [
                earlier for earlier in lines[:k] if f"/{name}:" in earlier and "FAILED" not in earlier][-1:]
            return led_there + _with_details(lines, k)
    does_not_link = linker_error(output)
    return [does_not_link] if does_not_link else lines[-3:]


def linker_error(output: str) -> str | None:
    """Returns the symbol that is undefined or defined twice. Apple's linker names it in the line below."""
    lines = _lines(output)
    for k, line in enumerate(lines):
        found = _LINKER.search(line)
        if found:
            below = lines[k + 1:k + 2] if found[0].endswith(":") else []
            return " ".join([found[0], *(text.strip() for text in below)])
    return None


def warnings(output: str, exercise: Exercise) -> list[str]:
    """Returns the warnings about the student's file, one line each."""
    return [line for line in _lines(output) if "warning: " in line and f"/{exercise.file.name}:" in line]


def _with_details(lines: list[str], k: int) -> list[str]:
    details = []
    for line in lines[k + 1: k + 1 + _DETAIL_LINES]:
        if _LOCATED.match(line):
            break
        details.append(line)
    return [lines[k]] + details
