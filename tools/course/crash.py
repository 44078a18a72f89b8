"""Finds the line of a student's file in which a program crashed, and the reason if the program printed one."""

import re
from pathlib import Path

import machine
from manifest import Exercise
from paths import shown

VARIABLE = "SPOOK_CRASH_TRACE"  # names the file that chapters/common/crash_trace.cpp writes

_ASSERTIONS = tuple(re.compile(text, re.MULTILINE) for text in (
    r"^(?P<where>.*:\d+: .*)Assertion [`'](?P<claim>.*)' failed\.?$",  # assert of Linux, and GCC's library
    r"^(?P<where>.*:\d+: )assertion (?P<claim>.*) failed: .*$",  # clang's library
    r"^Assertion failed: \((?P<claim>.*)\), function .*, file (?P<where>.*), line \d+\.$"))  # assert of macOS
_CLAIMS = (  # what the libraries assert, and what it means to a student
    (r"__\w+ < (this->)?size\(\)|__n < _Nm|__n < _Size", "an index is past the end of a {kind}"),
    (r"!this->empty\(\)|!empty\(\)", "a {kind} is empty, and has neither a first nor a last element"),
    (r"index >= 0 && index < |row >= 0 && row < |startRow >= 0|start >= 0 |i>=0 && ",
     "an index or a block is outside its vector or matrix"),
    (r"you mixed different sizes|lhs.cols\(\) == rhs.rows\(\)|rows\(\) == other.rows\(\)|aLhs.rows\(\) == aRhs.rows\(\)",
     "two vectors or matrices have sizes that do not match"),
    (r"_M_is_engaged\(\)|has_value\(\)", "the value of an empty optional is read"),
    (r"__lo < __hi|!\(__hi < __lo\)|!__comp\(__hi, __lo\)", "the lower bound of std::clamp is above its upper bound"),
)
_SIGNALS = {"SIGFPE": "an integer is divided by 0",
            "SIGSEGV": "invalid address: an index far past the end, a reference to a destroyed object, or a "
                       "function that calls itself without end",
            "SIGILL": "an instruction that ends a program: of __builtin_trap(), or at the end of a function that "
                      "returns nothing although it must",
            "SIGTRAP": "an instruction that stops a program for a debugger",
            "SIGKILL": "the program sent itself this signal, or the system did because its memory was used up",
            "SIGSYS": "a system call that the kernel refuses by ending the program"}
_OF_AN_INDEX = ("SIGBUS", "SIGABRT")  # what else a wrong index ends in
_OWNERS = {"/c++/": " of the C++ library", "/Eigen/": " of Eigen"}  # of the file that asserts
_KINDS = ("vector", "array", "span", "deque", "basic_string")


def place(program: Path, trace: Path, exercises: list[Exercise]) -> tuple[Exercise, int] | None:
    """Returns the innermost line of a student's file in the trace."""
    addresses = trace.read_text(encoding="ascii").split() if trace.exists() else []
    if not addresses:
        return None
    by_file = {str(exercise.file): exercise for exercise in exercises}
    lines = machine.lines_at(program, addresses)
    return next(((by_file[file], number) for file, number in lines if file in by_file), None)


def ending(signal_name: str, output: str) -> str:
    """Returns "crashed (SIGSEGV)", or "fails an assertion of the C++ library", which also ends a program by a
    signal."""
    found = _last_assertion(output) if signal_name == "SIGABRT" else None
    if not found:
        return f"crashed ({signal_name})"
    owner = next((of for part, of in _OWNERS.items() if part in found["where"]), "")
    return f"fails an assertion{owner}"


def explained(signal_name: str, output: str, where: tuple[Exercise, int] | None) -> str:
    """Returns "chapters/01_leapfrog/kick.cpp:7: an index is past the end of a std::vector", and the line itself."""
    why = _cause(output) or _SIGNALS.get(signal_name, "")
    if where is None:
        if not why and signal_name not in _OF_AN_INDEX:
            return "The program sent itself this signal, or another process did."
        return (f"{why[:1].upper()}{why[1:]}." if why else
                "That is most often an index past the end, or a function that calls itself without end.")
    exercise, number = where
    lines = (exercise.source() or "").splitlines()
    text = lines[number - 1].strip() if number <= len(lines) else ""
    return f"{shown(exercise.file)}:{number}: {why or 'it crashed here'}\n    {text}".rstrip()


def without_assertion(printed: str) -> str:
    """Returns the output of the student's code, without that of libraries."""
    for assertion in _ASSERTIONS:
        printed = assertion.sub("", printed)
    return printed


def _cause(output: str) -> str:
    """Explains a failed assertion, or returns its text; empty if there was none."""
    found = _last_assertion(output)
    if not found:
        return ""
    for claim, meaning in _CLAIMS:
        if re.search(claim, found["claim"]):
            kinds = [kind for kind in _KINDS if f"std::{kind}<" in found["where"] or f"/{kind}:" in found["where"]]
            return meaning.format(kind=f"std::{kinds[0]}" if kinds else "container")
    return f"the assertion {found['claim']} failed"


def _last_assertion(output: str) -> re.Match[str] | None:
    """Returns the assertion that ended the program."""
    found = [match for assertion in _ASSERTIONS for match in assertion.finditer(output)]
    return max(found, key=re.Match.start, default=None)
