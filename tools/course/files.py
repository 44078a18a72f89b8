"""The files of the course: those that git tracks, and new ones."""

import os
import subprocess
from pathlib import Path

from errors import CourseError
from paths import ROOT
from terminal import counted

_NOT_OURS = {".git", "build", ".course"}
_NAMED = 3


def course_files() -> list[Path]:
    """Returns the files that git tracks, relative to the course's root; without a repository, all files there."""
    if is_tracked():
        names = _listed("--cached")
    else:  # an archive without history
        found = sorted(path.relative_to(ROOT) for path in ROOT.rglob("*"))
        names = [name for name in found if not _NOT_OURS & set(name.parts)]
    files = _course_s_own(names)
    if not files:
        raise CourseError(f"git tracks no file of the course in {ROOT}; add its files first:  git add -A")
    return files


def new_files() -> list[Path]:
    """Returns the files that git neither tracks nor ignores; none without a repository."""
    return _course_s_own(_listed("--others", "--exclude-standard")) if is_tracked() else []


def left_out(names: list[Path]) -> str:
    """Names untracked files that are not published, in a line; empty if there are none."""
    if not names:
        return ""
    named = ", ".join(map(str, names[:_NAMED])) + (", ..." if len(names) > _NAMED else "")
    verb = "was" if len(names) == 1 else "were"
    return f"{counted(len(names), 'untracked file')} {verb} left out: {named} (git add FILE takes one in)"


def is_tracked() -> bool:
    """Returns True if git tracks the course, in its own repository or in a larger one. Raises if it cannot be asked."""
    try:
        asked = _git("rev-parse", "--show-toplevel")
    except FileNotFoundError:
        if not os.path.lexists(ROOT / ".git"):
            return False
        raise CourseError("git is missing, and it says which files are the course's; "
                          "./course start installs it") from None
    if asked.returncode != 0:
        if not os.path.lexists(ROOT / ".git"):
            return False
        reason = (os.fsdecode(asked.stderr).strip() or "no reason given").splitlines()[0]
        raise CourseError(f"git does not read the repository of {ROOT}: {reason}")
    # A larger repository may ignore the course, which was unpacked in it.
    return os.path.samefile(asked.stdout.removesuffix(b"\n"), os.fsencode(ROOT)) or bool(_listed("--cached"))


def _listed(*options: str) -> list[Path]:
    asked = _git("ls-files", "-z", *options)
    if asked.returncode != 0:
        reason = (os.fsdecode(asked.stderr).strip() or "no reason given").splitlines()[0]
        raise CourseError(f"git cannot list the files of {ROOT}: {reason}")
    return sorted({Path(os.fsdecode(name)) for name in asked.stdout.split(b"\0") if name})


def _git(*words: str) -> subprocess.CompletedProcess:
    return subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True)


def _course_s_own(names: list[Path]) -> list[Path]:
    """Leaves out deleted files, and answers that a command has put aside."""
    return [name for name in names if (ROOT / name).is_file() and ".mine-" not in name.name]
