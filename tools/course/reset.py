"""./course reset: restores the stub, and keeps the old file."""

import subprocess
from pathlib import Path

from errors import CourseError
from manifest import Exercise
from marker import is_stub
from paths import ROOT, shown
from pick import pick_one


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
    """Returns the newest version in git's history that still held the marker."""
    path = exercise.file.relative_to(ROOT).as_posix()
    # With --full-history git also follows a release that was merged while the student's answer stayed.
    for revision in _git("rev-list", "--full-history", "HEAD", "--", path).decode().split():
        # "./" is the course's root, which may be a folder of a larger repository.
        version = _git("show", f"{revision}:./{path}", must_work=False)
        if is_stub(version.decode(errors="replace")):
            return version
    raise CourseError(f"git's history holds no stub of {path}")


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
