"""Runs one exercise's tests in a process of their own, with limits, and reports the result."""

import json
import math
import os
import re
import signal
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import crash
from errors import BadInput
from machine import Limits, start_limited
from manifest import Exercise

_MARK = re.compile(r"^\[ *(RUN|OK|FAILED|SKIPPED) *\] (\S+?)(?: \(\d+ ms\))?$")
_MEMORY = 4 << 30
_OUTPUT = 64 << 20
_WAITING = 5  # on the clock, over processor time: for what waits, or is kept waiting by others
_PATIENCE = 20  # the same where nobody looks on


@dataclass
class Test:
    name: str  # Suite.Name
    skipped: bool
    failures: list[str]
    rank: int = 0  # 2: it explains why others fail, too; 1: it fits a mistake that is known; see tests/support/checks.hpp


@dataclass
class Trial:
    tests: list[Test] | None  # None if the program did not live to report them
    exit_code: int
    timed_out: bool  # of processor time; or of the clock: then its exit code is that of a killed program
    output: str
    crashed_at: tuple[Exercise, int] | None = None  # the student's file and line, if that is known
    unfinished: str = field(init=False)  # the test that was running at the end

    def __post_init__(self):
        self.unfinished = ""
        for line in self.output.splitlines():
            mark = _MARK.match(line)
            if mark:
                self.unfinished = mark[2] if mark[1] == "RUN" else ""

    def printed_by(self, test: str) -> str:
        """Returns the program's output during this test, without GoogleTest's own lines."""
        body, inside = [], False
        for line in self.output.splitlines():
            mark = _MARK.match(line)
            if mark:
                inside = mark[2] == test and mark[1] == "RUN"
            elif inside:
                body.append(line)
        return "\n".join(body)


def time_limit() -> float:
    """Returns the seconds of processor time for all tests of an exercise."""
    given = os.environ.get("COURSE_TIME_LIMIT", "20")
    try:
        limit = float(given)
    except ValueError:
        limit = 0.0
    if not 0 < limit < float("inf"):
        raise BadInput(f"COURSE_TIME_LIMIT must be a positive number of seconds, but is {given!r}")
    return limit


def clock_limit() -> float:
    """Returns the seconds on the clock for all tests of an exercise."""
    return _WAITING * math.ceil(time_limit())


def run_tests(program: Path, test_filter: str, seed: int | None = None, *, processor: float | None = None,
              more: dict[str, str] | None = None, exercise: Exercise | None = None) -> Trial:
    """Runs the tests in an environment without GoogleTest's variables, but with `more`. A crash is located in
    the exercise's file.

    Processor time counts, whatever else the machine does: time_limit(), or the given seconds of `processor`. A busy
    machine gets enough time on the clock for these.
    """
    env = {name: value for name, value in os.environ.items() if not name.startswith("GTEST_")} | (more or {})
    if seed is not None:
        env["SPOOK_SEED"] = str(seed)
    with tempfile.TemporaryDirectory(prefix="course-") as folder:
        report, printed = Path(folder, "report.json"), Path(folder, "output")
        trace = Path(folder, "trace")
        if exercise:
            env[crash.VARIABLE] = str(trace)
        command = [str(program), f"--gtest_filter={test_filter}", f"--gtest_output=json:{report}",
                   "--gtest_color=no"]
        with open(printed, "wb") as out:
            code, timed_out = run_limited(command, out, env, folder, processor)
        tests = _read_report(report) if report.exists() else None
        crashed_at = crash.place(program, trace, [exercise]) if exercise else None
        return Trial(tests, code, timed_out, printed.read_text(encoding="utf-8", errors="replace"), crashed_at)


def run_limited(command: list[str], out, env: dict[str, str], folder: str,
                processor: float | None = None, memory: int | None = _MEMORY) -> tuple[int, bool]:
    """Returns the exit code, and whether it ran for too long. Memory and written files are limited, too."""
    # A loop that never ends may also fill the memory or the disk.
    limits = Limits(math.ceil(processor or time_limit()), memory, _OUTPUT)
    process = start_limited(command, limits, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT,
                            env=env, cwd=folder)
    timed_out = False
    try:
        process.wait(_PATIENCE * processor if processor else clock_limit())
    except subprocess.TimeoutExpired:
        timed_out = True
    finally:
        if process.poll() is None:
            process.kill()
            process.wait()
    return process.returncode, timed_out or process.returncode == -signal.SIGXCPU


def _read_report(report: Path) -> list[Test] | None:
    try:
        suites = json.loads(report.read_text(encoding="utf-8", errors="replace")).get("testsuites", [])
    except ValueError:
        return None
    return [Test(f"{suite['name']}.{test['name']}", test.get("result") == "SKIPPED",
                 [_as_utf8(failure["failure"]) for failure in test.get("failures", [])], int(test.get("rank", 0)))
            for suite in suites for test in suite["testsuite"] if test.get("status") == "RUN"]


def _as_utf8(text: str) -> str:
    """Decodes letters such as λ, of which GoogleTest 1.12 escapes each byte."""
    try:
        return text.encode("latin-1").decode("utf-8")
    except UnicodeError:
        return text
