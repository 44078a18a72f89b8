"""Calls git in the folder of the course."""

import os
import subprocess
import sys
from pathlib import Path

from errors import CourseError
from paths import ROOT

_SOMEBODY = {"GIT_AUTHOR_NAME": "Course", "GIT_AUTHOR_EMAIL": "course@localhost",
             "GIT_COMMITTER_NAME": "Course", "GIT_COMMITTER_EMAIL": "course@localhost"}


def call(*words: str, given: bytes = b"", folder: Path = ROOT, more: dict[str, str] | None = None):
    """Runs git to its end, and returns the process whatever its exit code."""
    env = os.environ | {"LC_ALL": "C"} | (more or {})
    if not sys.stdin.isatty():
        env["GIT_TERMINAL_PROMPT"] = "0"  # nobody could answer
    try:
        return subprocess.run(["git", "-C", str(folder), *words], input=given, capture_output=True, env=env)
    except FileNotFoundError:
        raise CourseError("git is missing, and an update needs it; ./course start installs it") from None


def git(*words: str, **options) -> str:
    """Returns git's output without the last line's end. Raises if git fails."""
    done = call(*words, **options)
    if done.returncode != 0:
        raise CourseError(f"git {words[0]} failed: {why(done)}")
    return os.fsdecode(done.stdout).rstrip("\n")


def asked(*words: str, **options) -> str:
    """Returns git's output; empty if git fails."""
    done = call(*words, **options)
    return os.fsdecode(done.stdout).rstrip("\n") if done.returncode == 0 else ""


def holds(*words: str, **options) -> bool:
    """Returns True if git exits with 0."""
    return call(*words, **options).returncode == 0


def why(done: subprocess.CompletedProcess) -> str:
    """Returns the first line of git's complaint."""
    lines = [line.strip() for line in os.fsdecode(done.stderr).splitlines() if line.strip()]
    blaming = [line for line in lines if line.startswith(("fatal:", "error:"))] or lines or ["no reason given"]
    return blaming[0].removeprefix("fatal: ").removeprefix("error: ")


def somebody() -> dict[str, str]:
    """Names a committer on machines where git knows none."""
    return {} if holds("var", "GIT_COMMITTER_IDENT") and asked("config", "user.email") else _SOMEBODY
