"""The tests and a student's function, each in a process of its own; see tests/remote.

The tests are ours, and run as the grader. The student's function is isolated, without the tests: it gets calls over a
socket, and answers them. The calls and the verdicts are made where it has no access.
"""

import contextlib
import os
import random
import signal
import socket
import threading
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from grading.confined import Limits, high, pipe, reap, rest_of, spawn, text_of, waits
from grading.isolation import ENVIRONMENT, Isolation, User

_LARGEST_REPORT = 1 << 20
_CHANNEL, _REPORT = 3, 4
_TOLD = 77  # exit code of a test that has told how the other ended: tests/remote/report.hpp
_counting, _pairs_on = threading.Lock(), Counter()
_EXTENSIONS, _COMPUTES = 2, 0.5  # of a deadline; seconds of processor time, without which it only waits
SLOW = 1.0  # seconds on the clock, above which a test's processor time is looked up: that takes milliseconds
_LINGER = 2.0  # seconds that a process has to end after its socket has closed


@dataclass(frozen=True)
class Ran:
    """The result of one test: its output, and the end of the function's process."""

    verdict: tuple[bytes, ...] | None = None  # GoogleTest's result, tests that ran, "skipped", failures
    nonsense: bool = False  # something came back that is no answer
    code: int = 0  # of the student's process: exit code, or minus the signal
    tests_code: int = 0  # of the test's own process
    output: str = ""
    timed_out: bool = False  # on the clock
    too_much: bool = False
    cpu: float = 0.0  # seconds of the student's process
    clock: float = 0.0  # seconds that the test took
    used: float = 0.0  # of a slow one or the last: processor seconds of both processes since the last slow one


class Pair:
    def __init__(self, isolation: Isolation, user: User, tests: Path, exercise: str, answers: Path, limits: Limits,
                 env: dict[str, str], threads: bool = False):
        """Starts both. `threads`: the function starts threads, and races show only if they run at once."""
        self._isolation, self._user, self._limits = isolation, user, limits
        self._stack = contextlib.ExitStack()
        self.was_asked = False  # whether the student's program came as far as its main
        self._printed, printed_in = pipe(self._stack)
        self._report, report_in = pipe(self._stack)
        tests_to, self._tests_from = pipe(self._stack)
        ours, theirs = socket.socketpair()
        ours_high, theirs_high = high(ours.detach()), high(theirs.detach())
        self._core = _take_core()
        with contextlib.nullcontext() if threads else _only_on(self._core):
            self._answers = spawn(isolation.command([str(answers)], limits, user, (answers,)), ENVIRONMENT,
                                  {1: printed_in.fileno(), 2: printed_in.fileno(), _CHANNEL: theirs_high})
            self._tests = spawn(isolation.command_of_tests([str(tests), exercise], limits, (tests,)),
                                ENVIRONMENT | env,
                                {0: tests_to.fileno(), _CHANNEL: ours_high, _REPORT: report_in.fileno()})
        for end in (printed_in, report_in, tests_to):
            end.close()
        os.close(ours_high)
        os.close(theirs_high)
        self._running = {self._answers, self._tests}
        self._counted = 0.0  # of their processor time
        self.alive = True

    def close(self) -> None:
        for process in self._running:
            reap(process)
        self._running.clear()
        if self.alive:
            with _counting:
                _pairs_on[self._core] -= 1
        self.alive = False
        self._stack.close()
        self._isolation.clear(self._user)

    def used_since(self) -> float:
        """Returns the seconds of processor time of both processes that no result has told yet."""
        return self._newly_used() if self.alive else 0.0

    def run(self, test: str) -> Ran:
        """Runs one test. A pair that cannot continue is closed afterwards."""
        with contextlib.suppress(BrokenPipeError):
            self._tests_from.write(test.encode() + b"\n")
        printed, records, state = bytearray(), [], bytearray()
        too_much, begun = False, time.monotonic()
        report = self._report.fileno()
        for ready in self._waits([self._printed.fileno(), report]):
            more = os.read(ready, 1 << 16)
            if ready == report:
                state += more
                records += _records(state)
                if not more or (records and records[-1][0] == b"done"):
                    timed_out = False
                    break
            else:
                printed += more
            if len(printed) > self._limits.output or len(state) > _LARGEST_REPORT:
                timed_out, too_much = False, True
                break
        else:
            timed_out = True
        printed += rest_of(self._printed.fileno())
        found = {record[0]: record[1:] for record in records}
        self.was_asked = self.was_asked or b"partner" in found or b"verdict" in found
        cpu = _processor_time(self._answers) if timed_out else 0.0
        code = 0
        if b"partner" in found:
            code, cpu = exit_code(found[b"partner"][0]), float(found[b"partner"][1])
        elif not timed_out:
            code, cpu = self._last_words(too_much)
        of_test = exit_code(found.get(b"done", (b"0",))[0])
        clock = time.monotonic() - begun
        ends = timed_out or too_much or b"partner" not in found or b"nonsense" in found
        before = self._counted
        used = self._newly_used() if clock > SLOW or ends else 0.0
        # A process that has ended may be gone, but its last words tell what it used.
        ran = Ran(found.get(b"verdict"), b"nonsense" in found, code, 0 if of_test == _TOLD else of_test,
                  text_of(printed), timed_out, too_much, cpu, clock, max(used, cpu - before, 0.0))
        if ends:
            self.close()
        return ran

    def _waits(self, descriptors: list[int]):
        """Waits until the deadline, and a little longer while both still compute: then the machine is slow."""
        used = self._used()
        for _ in range(1 + _EXTENSIONS):
            yield from waits(descriptors, time.monotonic() + self._limits.wall)
            before, used = used, self._used()
            if used - before < _COMPUTES:
                return

    def _used(self) -> float:
        return _processor_time(self._answers) + _processor_time(self._tests)

    def _newly_used(self) -> float:
        before = self._counted
        self._counted = _processor_time(self._answers, ended=True) + _processor_time(self._tests, ended=True)
        return self._counted - before

    def _last_words(self, at_once: bool) -> tuple[int, float]:
        """Returns how the student's program ended, if it sent no result; a program without its socket is ended."""
        deadline = time.monotonic() + (0 if at_once else _LINGER)
        look = os.WEXITED | os.WNOHANG | os.WNOWAIT
        while time.monotonic() < deadline and not os.waitid(os.P_PID, self._answers, look):
            time.sleep(0.005)
        self._running.discard(self._answers)
        return reap(self._answers)


def exit_code(status: bytes) -> int:
    """Returns the exit code, or minus the signal. The student's side may send an invalid status."""
    try:
        return os.waitstatus_to_exitcode(int(status))
    except (ValueError, OverflowError):
        return -signal.SIGKILL


def _take_core() -> int:
    """Takes the core with the fewest pairs, until it is given back."""
    with _counting:
        core = min(os.sched_getaffinity(0), key=lambda core: (_pairs_on[core], random.random()))
        _pairs_on[core] += 1
    return core


@contextlib.contextmanager
def _only_on(core: int):
    """Binds the processes to this core. One sends and waits, the other answers and waits. On two cores each call wakes
    a sleeping process, and 1e5 calls take 10 s in place of 2."""
    allowed = os.sched_getaffinity(0)  # of this thread
    os.sched_setaffinity(0, {core})
    try:
        yield
    finally:
        os.sched_setaffinity(0, allowed)


def _records(state: bytearray) -> list[tuple[bytes, ...]]:
    """Removes the whole records from the front: a length on a line, and fields that each end with a NUL."""
    found = []
    while (line_end := state.find(b"\n")) >= 0 and len(state) > line_end + int(state[:line_end]):
        body = bytes(state[line_end + 1: line_end + 1 + int(state[:line_end])])
        found.append(tuple(body.split(b"\0")[:-1]))
        del state[: line_end + 1 + len(body)]
    return found


def _processor_time(process: int, ended: bool = False) -> float:
    """Returns the processor time of the process and its descendants, running or `ended`."""
    parents, times = {}, {}
    for entry in os.listdir("/proc"):
        if entry.isdecimal():
            with contextlib.suppress(OSError):
                fields = Path("/proc", entry, "stat").read_text(errors="replace").rpartition(")")[2].split()
                parents[int(entry)], times[int(entry)] = int(fields[1]), sum(map(int, fields[11:15 if ended else 13]))
    family, grows = {process}, True
    while grows:
        found = {one for one, parent in parents.items() if parent in family} - family
        grows = bool(found)
        family |= found
    return sum(times.get(one, 0) for one in family) / os.sysconf("SC_CLK_TCK")
