"""Runs a command that is not trusted to its end, whatever it does: limits in time and output, and one private answer.

The command's standard output and error come back together, cut at a limit. A second pipe, on descriptor 4, carries
what a graded program has to say, and a nonce waits for it on descriptor 3: see tests/support/grade_main.cpp.
"""

import contextlib
import fcntl
import functools
import os
import select
import signal
import time
from dataclasses import dataclass

_NONCE_DESCRIPTOR, _VERDICT_DESCRIPTOR = 3, 4
_LARGEST_VERDICT = 1 << 20
_KEPT = 64 << 10


@dataclass(frozen=True)
class Limits:
    cpu: int  # seconds of processor time, of each process
    wall: float  # seconds on the clock, for what sleeps
    memory: int  # bytes of address space
    files: int  # bytes of any one file
    processes: int  # and threads, together
    output: int  # bytes printed


@dataclass(frozen=True)
class Ended:
    code: int  # exit code, or minus the signal
    output: str
    answer: bytes
    timed_out: bool  # on the clock
    too_much: bool
    cpu: float


def run(command: list[str], limits: Limits, env: dict[str, str], nonce: bytes = b"") -> Ended:
    """What the command leaves behind is killed, if the command brings its own namespace of processes."""
    _keep_to_ourselves()
    with contextlib.ExitStack() as open_ends:
        def pipe():
            # Numbers well above those that the command will see them at, so that none is overwritten by another.
            ends = []
            for end in os.pipe():
                high = fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 16)
                os.close(end)
                ends.append(os.fdopen(high, "rb" if not ends else "wb", buffering=0))
                open_ends.enter_context(ends[-1])
            return ends

        printed, printed_in = pipe()
        answer, answer_in = pipe()
        secret, secret_in = pipe()
        null = open_ends.enter_context(open(os.devnull, "rb"))
        actions = [(os.POSIX_SPAWN_DUP2, null.fileno(), 0), (os.POSIX_SPAWN_DUP2, printed_in.fileno(), 1),
                   (os.POSIX_SPAWN_DUP2, printed_in.fileno(), 2),
                   (os.POSIX_SPAWN_DUP2, secret.fileno(), _NONCE_DESCRIPTOR),
                   (os.POSIX_SPAWN_DUP2, answer_in.fileno(), _VERDICT_DESCRIPTOR)]
        process = os.posix_spawn(command[0], command, env, file_actions=actions, setsid=True)
        for end in (printed_in, answer_in, secret):
            end.close()
        with contextlib.suppress(BrokenPipeError):
            secret_in.write(nonce)
        secret_in.close()
        return _watch(process, printed.fileno(), answer.fileno(), limits)


@functools.cache
def _keep_to_ourselves() -> None:
    """Python hands on no descriptor that it opens, but might those that it was started with."""
    for descriptor in map(int, os.listdir("/proc/self/fd")):
        with contextlib.suppress(OSError):
            if descriptor > 2:
                os.set_inheritable(descriptor, False)


def _watch(process: int, printed: int, answer: int, limits: Limits) -> Ended:
    ending = os.pidfd_open(process)
    try:
        received = {printed: bytearray(), answer: bytearray()}
        timed_out, too_much = _read_until_end(ending, received, printed, answer, limits)
        for group_or_process in (os.killpg, os.kill):
            with contextlib.suppress(ProcessLookupError, PermissionError):
                group_or_process(process, signal.SIGKILL)
        _, status, usage = os.wait4(process, 0)
    finally:
        os.close(ending)
    for pipe, content in received.items():
        # Whatever lived on may hold the other end open: what is there now is all that counts.
        os.set_blocking(pipe, False)
        with contextlib.suppress(BlockingIOError):
            while len(content) < _LARGEST_VERDICT and (more := os.read(pipe, 1 << 16)):
                content += more
    text = bytes(received[printed][:_KEPT]).decode("utf-8", errors="replace")
    return Ended(os.waitstatus_to_exitcode(status), text, bytes(received[answer]), timed_out, too_much,
                 usage.ru_utime + usage.ru_stime)


def _read_until_end(ending: int, received: dict[int, bytearray], printed: int, answer: int,
                    limits: Limits) -> tuple[bool, bool]:
    """Whether the time was up, and whether the command printed or answered too much."""
    poll = select.poll()
    for descriptor in (ending, printed, answer):
        poll.register(descriptor, select.POLLIN)
    deadline = time.monotonic() + limits.wall
    count = 0
    while (left := deadline - time.monotonic()) > 0:
        for descriptor, _ in poll.poll(left * 1000):
            if descriptor == ending:
                return False, False
            more = os.read(descriptor, 1 << 16)
            if not more:
                poll.unregister(descriptor)
            count += len(more) if descriptor == printed else 0
            received[descriptor] += more
            if count > limits.output or len(received[answer]) > _LARGEST_VERDICT:
                return False, True
    return True, False
