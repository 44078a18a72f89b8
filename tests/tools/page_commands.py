"""The commands that pages print."""

import shlex
import subprocess
from pathlib import Path

from sandbox import ROOT


def pages() -> list[Path]:
    told = subprocess.run(["git", "ls-files", "-z", "--", "*.md"], cwd=ROOT, capture_output=True, text=True).stdout
    return [ROOT / name for name in told.split("\0") if name]


def commands(page: Path) -> list[str]:
    """Returns the commands at the beginnings of lines, as typed."""
    return [line for line in page.read_text(encoding="utf-8").splitlines() if line.startswith("./course")]


def words_of(line: str) -> list[str]:
    """Returns the words without a comment and without redirections."""
    words = shlex.split(line, comments=True)[1:]
    return words[:words.index(">")] if ">" in words else words
