"""Runs untrusted commands to their end, and leaves no process behind."""

import contextlib
import fcntl
import functools
import os
import select
import signal
import threading
import time
from dataclasses import dataclass

_KEPT = 64 << 10


class Interrupted(Exception):
    """The whole grading must end now."""


class Stop:
    """Ends every wait, in every thread, at once."""

    def __init__(self):
        self._event, self.descriptor = threading.Event(), os.eventfd(0)

    def set(self) -> None:
        self._event.set()
        os.eventfd_write(self.descriptor, 1)

    def check(self) -> None:
        if self._event.is_set():
            raise Interrupted


STOP = Stop()


@dataclass(frozen=True)
class Limits:
    cpu: int  # seconds of processor time, of each process
    wall: float  # seconds on the clock, for what sleeps
    memory: int  # bytes of address space
    files: int  # bytes of any one file
    processes: int  # and threads, together
    output: int  # bytes printed
    stack: int = 0  # bytes of each thread's; 0: the system's own limit


@dataclass(frozen=True)
class Ended:
    code: int  # exit code, or minus the signal
    output: str
    timed_out: bool  # on the clock
    too_much: bool
    cpu: float


def run(command: list[str], limits: Limits, env: dict[str, str]) -> Ended:
    """Runs a command. Processes that it leaves are killed if the command has its own namespace of processes."""
    with contextlib.ExitStack() as open_ends:
        printed, printed_in = pipe(open_ends)
        process = spawn(command, env, {1: printed_in.fileno(), 2: printed_in.fileno()})
        printed_in.close()
        timed_out, too_much, received = True, False, bytearray()
        ending = os.pidfd_open(process)
        try:
            deadline = time.monotonic() + limits.wall
            for ready in waits([ending, printed.fileno()], deadline):
                if ready == ending:
                    timed_out = False
                    break
                received += os.read(ready, 1 << 16)
                if len(received) > limits.output:
                    timed_out, too_much = False, True
                    break
            code, cpu = reap(process)
        finally:
            os.close(ending)
            kill(process)
        return Ended(code, text_of(received + rest_of(printed.fileno())), timed_out, too_much, cpu)


def pipe(stack: contextlib.ExitStack) -> list:
    """Returns two ends of a pipe, closed with the stack."""
    return [stack.enter_context(os.fdopen(high(end), "rb" if not k else "wb", buffering=0))
            for k, end in enumerate(os.pipe())]


def high(descriptor: int) -> int:
    """Moves a descriptor above those that a command uses, so that none is overwritten."""
    copy = fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, 16)
    os.close(descriptor)
    return copy


def spawn(command: list[str], env: dict[str, str], descriptors: dict[int, int]) -> int:
    """Starts a process in a session of its own, with these descriptors and no others; the rest lead to /dev/null."""
    _keep_to_ourselves()
    with open(os.devnull, "r+b", buffering=0) as null:
        given = {0: null.fileno(), 1: null.fileno(), 2: null.fileno()} | descriptors
        actions = [(os.POSIX_SPAWN_DUP2, source, target) for target, source in given.items()]
        return os.posix_spawn(command[0], command, env, file_actions=actions, setsid=True)


@functools.cache
def _keep_to_ourselves() -> None:
    """Keeps the descriptors that Python was started with from being inherited; its own never are."""
    for descriptor in map(int, os.listdir("/proc/self/fd")):
        with contextlib.suppress(OSError):
            if descriptor > 2:
                os.set_inheritable(descriptor, False)


def waits(descriptors: list[int], deadline: float):
    """Yields each descriptor with input, as it comes, until the deadline; one at its end only once."""
    poll = select.poll()
    for descriptor in descriptors:
        poll.register(descriptor, select.POLLIN)
    poll.register(STOP.descriptor, select.POLLIN)
    while (left := deadline - time.monotonic()) > 0:
        STOP.check()
        for descriptor, event in poll.poll(min(left, 1.0) * 1000):
            if descriptor == STOP.descriptor:
                continue
            if not event & select.POLLIN:
                poll.unregister(descriptor)
            yield descriptor


def kill(process: int) -> None:
    for group_or_process in (os.killpg, os.kill):
        with contextlib.suppress(ProcessLookupError, PermissionError):
            group_or_process(process, signal.SIGKILL)


def reap(process: int) -> tuple[int, float]:
    """Kills the process; returns its exit code, or minus the signal, and its processor time."""
    kill(process)
    _, status, usage = os.wait4(process, 0)
    return os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime


def rest_of(descriptor: int) -> bytes:
    """Reads the available rest: a surviving process may hold the other end open."""
    found = bytearray()
    os.set_blocking(descriptor, False)
    with contextlib.suppress(BlockingIOError):
        while len(found) < _KEPT and (more := os.read(descriptor, 1 << 16)):
            found += more
    os.set_blocking(descriptor, True)
    return bytes(found)


def text_of(printed: bytes) -> str:
    return bytes(printed[:_KEPT]).decode("utf-8", errors="replace")
