"""Checks that git's repository here can be updated; gives a folder without one its history."""

import os
import shlex
import tempfile
from pathlib import Path

from errors import CourseError
from manifest import all_exercises
from paths import CHAPTERS, ROOT
from updating import releases
from updating.git import asked, call, git, holds, why
from updating.releases import Source
from version import version

# What git keeps while it waits for somebody to end a command. A pull begins a merge or a rebase.
_BEGUN = {"MERGE_HEAD": "merge", "rebase-merge": "rebase", "rebase-apply": "rebase", "CHERRY_PICK_HEAD": "cherry-pick",
          "REVERT_HEAD": "revert"}


def has_history() -> bool:
    """Returns True if the course has commits in a repository of its own; raises if it is part of a larger one."""
    asking = call("rev-parse", "--show-toplevel")
    if asking.returncode != 0 and os.path.lexists(ROOT / ".git"):
        raise CourseError(f"git does not read the history of this folder: {why(asking)} (nothing was changed)")
    top = os.fsdecode(asking.stdout).rstrip("\n")
    if top and not os.path.samefile(top, ROOT):
        if asked("ls-files"):
            raise CourseError(f"the course is a folder of a larger repository, {top}, which an update would change, "
                              "too; take the new release beside it, and bring your files over", _by_hand())
        return False  # a larger repository that does not know this folder
    return bool(top) and holds("rev-parse", "--verify", "HEAD^{commit}")


def refuse_without_history() -> CourseError:
    return CourseError("this folder has no git history, which an update needs; ./course update --from ADDRESS, with "
                       "the address of the course's repository and without --dry-run, adds it and keeps your files. "
                       "The commands above do it by hand",
                       _by_hand())


def refuse_what_is_begun() -> None:
    for name, what in _BEGUN.items():
        if os.path.exists(ROOT / git("rev-parse", "--git-path", name)):
            raise CourseError(f"git is in the middle of a {what}; finish it, then update; or take it back:  "
                              f"git {what} --abort")
    if asked("ls-files", "--unmerged"):
        raise CourseError("files have conflicts that git waits for; end them, then update (git status names them)")
    lock = ROOT / git("rev-parse", "--git-path", "index.lock")
    if lock.exists():
        raise CourseError(f"{lock} exists: another git is at work; wait for it, or delete that file if none is")


def adopt(place: Source) -> None:
    """Gives this folder the history of the release that it was unpacked from. No file is changed."""
    if not (ROOT / ".git").exists():
        with tempfile.TemporaryDirectory(prefix="course-", dir=ROOT.parent) as folder:
            for words in (["init", "-q"], ["remote", "add", "origin", place.place]):
                done = call(*words, folder=Path(folder))
                if done.returncode != 0:
                    raise CourseError(f"git {words[0]} failed: {why(done)}")
            os.rename(Path(folder, ".git"), ROOT / ".git")
    commit = releases.fetch(version(), place)
    git("update-ref", "HEAD", commit)
    if not asked("ls-files"):
        git("read-tree", "HEAD")
    print(f"This folder has git's history of {version()} now; your files are as they were.")


def _by_hand() -> str:
    """Writes the commands that bring a student's files into a new clone."""
    started = [exercise.file.relative_to(ROOT).as_posix() for exercise in all_exercises()
               if exercise.started() and exercise.file.exists()]
    more = [file.relative_to(ROOT).as_posix() for file in sorted(CHAPTERS.glob("*/try"))]
    more += [".course"] if (ROOT / ".course").exists() else []
    lines = [f"  git clone ADDRESS {shlex.quote(str(ROOT.parent / 'course-new'))}"]
    if started or more:
        names = " ".join(map(shlex.quote, [*started, *more]))
        lines.append(f"  cd {shlex.quote(str(ROOT))} && tar -cf - {names} | "
                     f"tar -xf - -C {shlex.quote(str(ROOT.parent / 'course-new'))}")
    return "\n".join(lines)
