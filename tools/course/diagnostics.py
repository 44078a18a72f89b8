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
_INSTANTIATED = re.compile(r":\d+:\d+:\s+(?:recursively )?required from|: note: in instantiation of")
# What is behind an error that does not say so: words of the compiler, and the cause.
_CAUSES = [(re.compile(words), cause) for words, cause in (
    (r"YOU_MIXED_MATRICES_OF_DIFFERENT_SIZES",
     "two parts of one expression have different sizes, such as a Vec3 and a Twist<6>"),
    (r"INVALID_VECTOR_VECTOR_PRODUCT", "a * b is no product of two vectors: a.dot(b) is a number, a.cross(b) a vector"),
    (r"INVALID_MATRIX_PRODUCT", "the left matrix must have as many columns as the right one has rows"),
)]
_EIGEN_PAGE = "chapters/EIGEN.md"
_PART = re.compile(r"(?:\.|->)(?:head|tail|segment|block|topLeftCorner|bottomRightCorner)<")
_NEEDS_REQUIRE = re.compile(r"\b(?:require_\w+|reject)\b.*not declared|undeclared identifier '(?:require_\w+|reject)'")


def _lines(output: str) -> list[str]:
    return _ANSI.sub("", output).replace(f"{ROOT}/", "").splitlines()


def first_error(output: str, exercise: Exercise) -> list[str]:
    """Returns the first error with its code, below the student's line that led there."""
    lines = _lines(output)
    name = exercise.file.name
    for k, line in enumerate(lines):
        found = _ERROR.match(line)
        if found:
            led_there = [] if found["file"].endswith(name) else _innermost_line(lines, k, name)
            return led_there + _with_details(lines, k) + _cause(lines, k)
    does_not_link = linker_error(output)
    return [does_not_link] if does_not_link else lines[-3:]


def _innermost_line(lines: list[str], k: int, name: str) -> list[str]:
    """The student's line from which the templates of a library were called: of several, the one next to the error."""
    before, after = [], []
    for line in reversed(lines[:k]):  # GCC tells the way before the error
        if _ERROR.match(line):
            break
        before.insert(0, line)
        if "In instantiation of" in line:
            break
    for line in lines[k + 1:]:  # and clang after it
        if _ERROR.match(line):
            break
        after.append(line)
    way = [line for line in before + after if f"/{name}:" in line and _INSTANTIATED.search(line)]
    return way[:1] or [line for line in lines[:k] if f"/{name}:" in line and "FAILED" not in line][-1:]


def _cause(lines: list[str], k: int) -> list[str]:
    """The likely cause of an error, where the compiler's words do not tell it; at most one."""
    if _NEEDS_REQUIRE.search(lines[k]):
        return ['Cause: #include "common/require.hpp" is missing.']
    code = "".join(_with_details(lines, k)[1:2])
    if _PART.search(code) and ("expected primary-expression" in lines[k] or "'template' keyword" in lines[k]):
        return [f"Cause: in a template whose size is a parameter, .tail<3>() is written .template tail<3>(); see {_EIGEN_PAGE}."]
    return [f"Cause: {cause}; see {_EIGEN_PAGE}." for words, cause in _CAUSES if words.search(lines[k])][:1]


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
