"""What was handed in: the files with an exercise's name, out of a folder or a zip, and nothing else.

Taken are regular files chapters/NN_topic/FUNCTION.cpp, at the top or below folders of any name, and FUNCTION.cpp at the
top, where an upload has dropped the folders. Nothing is ever unpacked.
"""

import os
import stat
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from errors import BadInput
from manifest import Exercise
from paths import CHAPTERS

LARGEST = 256 << 10  # bytes; the reference's longest answer has a twentieth of that
_MOST_ENTRIES = 20_000
_NAMES_IN_A_NOTE = 5


@dataclass(frozen=True)
class Source:
    """An exercise's file: what it holds, or why it can't be taken."""

    path: str
    content: bytes = b""
    problem: str = ""
    is_link: bool = False
    is_reference: bool = False


@dataclass
class Submission:
    name: str
    sources: dict[str, Source]  # by the exercise's function
    notes: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Handed:
    """A submission that is not read yet."""

    name: str
    path: Path


@dataclass(frozen=True)
class _Entry:
    path: PurePosixPath
    kind: str  # file, link, other
    size: int
    read: object  # () -> bytes


def find_submissions(paths: list[Path], out: Path) -> list[Handed]:
    """Each path is a submission or a folder of them; in the order of their names, which are made different.

    `out`, where marks are written, may lie among them and is none.
    """
    handed: list[Handed] = []
    for path in paths:
        if not path.exists():
            raise BadInput(f"grade: there is no {path}")
        handed += [Handed(_name(path), path)] if _is_submission(path) else _in_folder(path, out)
    handed.sort(key=lambda one: (one.name, str(one.path)))
    return _named_apart(handed)


def read_submission(handed: Handed, exercises: list[Exercise]) -> Submission:
    """Never raises for what is in it: a damaged zip is a submission without files, and its notes say why."""
    submission = Submission(handed.name, {})
    try:
        if handed.path.is_dir():
            _take(submission, _entries_of_folder(handed.path), exercises)
        else:
            with zipfile.ZipFile(handed.path) as archive:
                _take(submission, _entries_of_zip(archive), exercises)
    except Exception as error:  # a damaged archive has the library raise whatever its decoders do
        submission.notes.append(f"{handed.path.name} can not be read: {error}")
    return submission


def _is_submission(path: Path) -> bool:
    if not path.is_dir():
        if path.suffix.lower() != ".zip":
            raise BadInput(f"grade: {path} is neither a folder nor a .zip")
        return True
    return (path / "chapters").is_dir() or any(path.glob("*.cpp"))


def _in_folder(folder: Path, out: Path) -> list[Handed]:
    found = [Handed(_name(child), child) for child in sorted(folder.iterdir())
             if not child.is_symlink() and not child.name.startswith((".", "__MACOSX"))
             and (child.is_dir() or child.suffix.lower() == ".zip") and child.resolve() != out.resolve()]
    if not found:
        raise BadInput(f"grade: {folder} holds no submission: no chapters/, no folders, no .zip")
    return found


def _name(path: Path) -> str:
    resolved = path.resolve()
    return _text(resolved.stem if resolved.suffix.lower() == ".zip" else resolved.name)


def _text(name: str) -> str:
    """A file's name may hold bytes that are no letters."""
    return os.fsencode(name).decode("utf-8", errors="replace")


def _named_apart(handed: list[Handed]) -> list[Handed]:
    taken: set[str] = set()
    apart = []
    for one in handed:
        name, count = one.name, 1
        while name.casefold() in taken:
            count += 1
            name = f"{one.name} ({count})"
        taken.add(name.casefold())
        apart.append(Handed(name, one.path))
    return apart


def _entries_of_folder(root: Path) -> Iterator[_Entry]:
    count = 0
    for folder, folders, files in os.walk(root):
        # A link to a folder is listed among the folders, and never followed.
        folders.sort()
        for name in sorted(files + [name for name in folders if Path(folder, name).is_symlink()]):
            count += 1
            if count > _MOST_ENTRIES:
                raise ValueError(f"it holds more than {_MOST_ENTRIES} files")
            path = Path(folder, name)
            found = path.lstat()
            kind = ("link" if stat.S_ISLNK(found.st_mode) else "file" if stat.S_ISREG(found.st_mode) else "other")
            yield _Entry(PurePosixPath(_text(path.relative_to(root).as_posix())), kind, found.st_size,
                         lambda path=path: _read_regular(path))


def _read_regular(path: Path) -> bytes:
    """What is a link or a pipe by the time that it is opened is an error, and does not block."""
    with open(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise OSError("not a regular file")
        return file.read(LARGEST + 1)


def _entries_of_zip(archive: zipfile.ZipFile) -> Iterator[_Entry]:
    if len(archive.infolist()) > _MOST_ENTRIES:
        raise ValueError(f"it holds more than {_MOST_ENTRIES} files")
    for info in archive.infolist():
        if info.is_dir():
            continue
        mode = info.external_attr >> 16
        kind = "link" if stat.S_ISLNK(mode) else "file" if not stat.S_IFMT(mode) or stat.S_ISREG(mode) else "other"
        yield _Entry(PurePosixPath(info.filename.replace("\\", "/")), kind, info.file_size,
                     lambda info=info: _read_member(archive, info))


def _read_member(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> bytes:
    with archive.open(info) as file:
        return file.read(LARGEST + 1)


def _take(submission: Submission, entries: Iterator[_Entry], exercises: list[Exercise]) -> None:
    wanted = {f"{exercise.folder}/{exercise.function}.cpp": exercise for exercise in exercises}
    alone = {f"{exercise.function}.cpp": exercise for exercise in exercises}
    others: list[str] = []
    found: dict[str, list[_Entry]] = {}
    for entry in entries:
        parts = entry.path.parts
        exercise = None
        if ".." not in parts and not entry.path.is_absolute():
            if len(parts) >= 3 and parts[-3] == "chapters":
                exercise = wanted.get("/".join(parts[-2:]))
            elif len(parts) == 1:
                exercise = alone.get(parts[0])
        if exercise:
            found.setdefault(exercise.function, []).append(entry)
        elif "chapters" in parts[:-1] and parts[-1].endswith((".cpp", ".hpp", ".h")) or ".." in parts:
            others.append(str(entry.path))
    for function, candidates in found.items():
        candidates.sort(key=lambda entry: ("chapters" not in entry.path.parts, len(entry.path.parts), str(entry.path)))
        submission.sources[function] = _read(candidates[0])
        if len(candidates) > 1:
            ignored = ", ".join(str(entry.path) for entry in candidates[1:])
            submission.notes.append(f"taken is {candidates[0].path}; there is also {ignored}")
    if not found:
        submission.notes.append("no file chapters/NN_topic/FUNCTION.cpp was found")
    _note_others(submission, [name for name in others if not _is_ours(name)])


def _is_ours(name: str) -> bool:
    """The course's own files come along with every fork; the instructor's are used."""
    return ".." not in name and (CHAPTERS / "/".join(PurePosixPath(name).parts[-2:])).exists()


def _note_others(submission: Submission, others: list[str]) -> None:
    if others:
        more = len(others) - _NAMES_IN_A_NOTE
        listed = ", ".join(sorted(others)[:_NAMES_IN_A_NOTE]) + (f" and {more} more" if more > 0 else "")
        submission.notes.append(f"not an exercise's file, so not taken: {listed}")


def _read(entry: _Entry) -> Source:
    path = str(entry.path)
    if entry.kind == "link":
        return Source(path, problem=f"{path} is a symbolic link, and those are not followed", is_link=True)
    if entry.kind != "file":
        return Source(path, problem=f"{path} is no regular file")
    try:
        content = entry.read() if entry.size <= LARGEST else b"x" * (LARGEST + 1)
    except Exception as error:  # as above
        return Source(path, problem=f"{path} can not be read: {error}")
    if len(content) > LARGEST:
        return Source(path, problem=f"{path} is larger than {LARGEST >> 10} KiB")
    return Source(path, content)
