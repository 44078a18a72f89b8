"""./course reset: restores the stub, and keeps the old file."""

import functools
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

from errors import CourseError
from manifest import Exercise
from marker import code_of, is_stub, is_untouched
from paths import ROOT, shown
from pick import pick_one
from version import stated_in

_RELEASE = re.compile(r"refs/(?:tags|course/releases)/v(\d+)\.(\d+)\.(\d+)")


def reset(arguments) -> int:
    exercise = pick_one(arguments.which)
    stub = stub_of(exercise)
    source = exercise.file.read_bytes() if exercise.file.exists() else None
    if source == stub:
        print(f"{shown(exercise.file)} is the stub already.")
        return 0
    if source is not None:
        print(f"Your file is kept as {shown(_keep(exercise.file, source))}.")
    exercise.file.write_bytes(stub)
    print(f"{shown(exercise.file)} is the stub again.")
    return 0


def stub_of(exercise: Exercise) -> bytes:
    """Returns the stub of the newest release in git's history. A student may have committed half an answer since, which
    holds the marker, too."""
    path = exercise.file.relative_to(ROOT).as_posix()
    for release in _releases():
        if is_stub(_text(stub := _version(release, path))):
            return stub
    left = _git("merge-base", "HEAD", "@{upstream}", must_work=False).decode().strip()
    # To its own upstream, a student's repository has pushed its answers.
    if left and is_untouched(_text(stub := _version(left, path))):
        return stub
    return _oldest(path)


def newest_stub_of(exercise: Exercise) -> bytes:
    """Returns the newest version with the marker: an instructor may have committed another stub."""
    path = exercise.file.relative_to(ROOT).as_posix()
    for version in _versions(path):
        if is_stub(_text(version)):
            return version
    raise _no_stub(path)


@functools.cache
def _releases() -> list[str]:
    """Lists the releases that HEAD comes from, newest first. A tag of the student's own is none: the course states its
    version."""
    names = _git("for-each-ref", "--merged", "HEAD", "--format=%(refname)", "refs/tags", "refs/course/releases")
    numbers = {name: tuple(map(int, found.groups())) for name in names.decode(errors="replace").split()
               if (found := _RELEASE.fullmatch(name))}
    return [name for name in sorted(numbers, key=numbers.get, reverse=True)
            if stated_in(_text(_version(name, "CMakeLists.txt"))) == ".".join(map(str, numbers[name]))]


def _oldest(path: str) -> bytes:
    """Returns the newest stub that is nothing but a stub, as it was before the student wrote comments into it; without
    one, the oldest version that holds the marker."""
    stubs = [version for version in _versions(path) if is_stub(_text(version))]
    whole = [version for version in stubs if is_untouched(_text(version))]
    if whole:
        code = code_of(_text(whole[0])).split()
        return next(version for version in reversed(whole) if code_of(_text(version)).split() == code)
    if not stubs or _is_shallow():
        raise _no_stub(path)
    return stubs[-1]


def _no_stub(path: str) -> CourseError:
    more = "; only the newest part of it is here, so fetch the rest:  git fetch --unshallow" if _is_shallow() else ""
    return CourseError(f"git's history holds no stub of {path}{more}")


def _is_shallow() -> bool:
    return _git("rev-parse", "--is-shallow-repository").strip() == b"true"


def _versions(path: str) -> Iterator[bytes]:
    """Yields the versions of a file of the course in git's history, newest first."""
    # With --full-history git also follows a release that was merged while the student's answer stayed.
    for revision in _git("rev-list", "--full-history", "HEAD", "--", path).decode().split():
        yield _version(revision, path)


def _version(revision: str, path: str) -> bytes:
    """Returns a file of the course in a revision; empty if it had none."""
    # "./" is the course's root, which may be a folder of a larger repository.
    return _git("show", f"{revision}:./{path}", must_work=False)


def _text(source: bytes) -> str:
    return source.decode(errors="replace")


def _git(*arguments: str, must_work: bool = True) -> bytes:
    try:
        result = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True)
    except FileNotFoundError:
        raise CourseError("git is missing, and the stubs are in its history; "
                          "./course start installs it") from None
    if result.returncode != 0 and must_work:
        reason = (result.stderr.decode(errors="replace").strip() or "git failed").splitlines()[0]
        raise CourseError(f"git's history cannot be read for the stub: {reason}")
    return result.stdout if result.returncode == 0 else b""


def _keep(file: Path, source: bytes) -> Path:
    """Keeps the file beside the stub, under an unused name that no build looks for."""
    number = 1
    while True:
        kept = file.with_name(f"{file.name}.mine-{number}")
        try:
            with open(kept, "xb") as out:
                out.write(source)
            return kept
        except FileExistsError:
            number += 1
