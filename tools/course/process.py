"""Runs a tool, keeps all of its output, and shows its progress."""

import subprocess
from collections.abc import Callable
from pathlib import Path

from errors import CourseError


def stream(command: list[str], on_line: Callable[[str], None], log: Path | None = None,
           env: dict[str, str] | None = None, cwd: Path | None = None) -> tuple[int, str]:
    """Runs it to the end; returns the exit code and the output."""
    lines: list[str] = []
    try:
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   stdin=subprocess.DEVNULL, text=True, errors="replace", env=env, cwd=cwd)
    except FileNotFoundError:
        raise CourseError(f"{command[0]} is missing; ./course start installs what is needed") from None
    try:
        for line in process.stdout:
            lines.append(line)
            on_line(line)
    except BaseException:
        process.terminate()  # ninja then ends its compilers, and removes what they have half written
        raise
    finally:
        process.stdout.close()
        process.wait()
        if log:
            log.parent.mkdir(parents=True, exist_ok=True)
            log.write_text("".join(lines), encoding="utf-8")
    return process.returncode, "".join(lines)


def tail(text: str, count: int = 15) -> str:
    return "\n".join(text.rstrip().splitlines()[-count:])


def from_failure(text: str, count: int = 15) -> str:
    """Returns ninja's first failure, without the compiler's command line."""
    lines = text.rstrip().splitlines()
    first = next((k for k, line in enumerate(lines) if line.startswith("FAILED:")), None)
    if first is None or "build.ninja" in lines[first]:  # CMake, run again by ninja, says why before it fails
        return tail(text, count)
    return "\n".join([lines[first], *lines[first + 2:first + 1 + count]])
