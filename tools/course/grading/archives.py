"""The files in a folder or an archive, and in archives inside it: never unpacked to disk, and read only when needed."""

import bz2
import contextlib
import gzip
import io
import lzma
import os
import shutil
import stat
import subprocess
import tarfile
import tempfile
import time
import zipfile
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath

LARGEST = 256 << 10  # bytes of a file; the reference's longest answer has a twentieth of that
_LARGEST_ARCHIVE = 64 << 20  # inside another
_DEEPEST = 4
_DEEPEST_FOLDER = 40
_LONGEST_FOLDER = 3800  # bytes of its path: a file's may have 4095, with a name of 255
_MOST = 20_000  # files
_MOST_ARCHIVES = 200  # of one submission, one in another
_UNPACKED = 1 << 30  # bytes that a submission's archives may give, those read twice counted twice
_OF_A_CLASS = 1 << 40  # bytes that the one archive of a whole class may give
_ARCHIVES_OF_A_NAME, _UNPACKED_OF_A_NAME = 20, 64 << 20  # what is opened to tell a class from a submission
_ZIP, _TAR, _SEVEN = (".zip",), (".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tbz2", ".tar.xz", ".txz"), (".7z",)
_NOT_READ = (".rar", ".gz", ".bz2", ".xz")
_COMPRESSED = {b"\x1f\x8b": gzip.open, b"BZh": bz2.open, b"\xfd7zXZ\0": lzma.open}
# What archives begin with, whatever their names.
_BEGINNINGS = {b"PK\3\4": ".zip", b"7z\xbc\xaf\x27\x1c": ".7z", b"Rar!": ".rar"} | dict.fromkeys(_COMPRESSED, ".tar")
_MADE = {".git", "build", "node_modules", ".venv", "__pycache__"}  # folders of thousands of files that nobody wrote
_LITTER = {"__MACOSX", ".DS_Store", "Thumbs.db", "desktop.ini"}


@dataclass(frozen=True)
class Entry:
    path: PurePosixPath
    kind: str  # file, link, other, or damaged: an archive that can't be read
    size: int
    read: Callable[[], bytes]
    problem: str = ""
    time: tuple[int, ...] = ()  # from the year to the second, if an archive tells it


class _Budget:
    """The cost limits for reading one submission."""

    def __init__(self, archives: int = _MOST_ARCHIVES, unpacked: int = _UNPACKED):
        self._archives, self._bytes = archives, unpacked
        self._most_archives, self._most_bytes = archives, unpacked

    def open_archive(self) -> None:
        self._archives -= 1
        if self._archives < 0:
            raise OverBudget(f"it holds more than {self._most_archives} archives")

    def take(self, count: int) -> None:
        self._bytes -= count
        if self._bytes < 0:
            raise OverBudget(f"its archives hold more than {self._most_bytes >> 20} MiB")


class OverBudget(Exception):
    """Ends the whole submission, not only the archive that exceeded the limit."""


class _Unpacking(io.RawIOBase):
    """Counts a decompressor's output: a file of a few bytes may unpack to a terabyte."""

    def __init__(self, source, budget: _Budget):
        self._source, self._budget = source, budget

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def tell(self) -> int:
        return self._source.tell()

    def read(self, count: int = -1) -> bytes:
        found = self._source.read(_UNPACKED + 1 if count < 0 else count)
        self._budget.take(len(found))
        return found

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """Seeks forwards in steps, by unpacking. Seeking backwards starts again."""
        if whence != io.SEEK_SET:
            raise ValueError("only from the start")
        if offset < self._source.tell():
            self._source.seek(0)
        while self._source.tell() < offset and self.read(min(1 << 20, offset - self._source.tell())):
            pass
        return self._source.tell()


def cause(error: Exception) -> str:
    """Returns the cause in a few words, without the path on the instructor's machine that the system adds."""
    return (isinstance(error, OSError) and error.strerror) or str(error) or type(error).__name__


def is_archive(name: str) -> bool:
    return name.lower().endswith(_ZIP + _TAR + _SEVEN + _NOT_READ[:1])


def without_suffix(name: str) -> str:
    """Returns an archive's name without its suffix."""
    for suffix in sorted(_ZIP + _TAR + _SEVEN + _NOT_READ[:1], key=len, reverse=True):
        if name.lower().endswith(suffix):
            return name[: -len(suffix)]
    return name


def is_litter(path: PurePosixPath) -> bool:
    """Tells whether a file was left by the system and not written by a person."""
    return bool(_LITTER & set(path.parts)) or path.name.startswith("._")


def entries_of(path: Path, inside: str = "") -> Iterator[Entry]:
    """Returns all files of a submission, those in archives below the archive's name, without litter and tools' products.

    `inside`: the submission is the file or folder of this path in the archive; nothing else is opened or counted.
    """
    count, budget = 0, _Budget()
    entries = _entries(path, _Budget(unpacked=_OF_A_CLASS) if inside else budget)
    if inside:
        within = PurePosixPath(inside).parts
        entries = (entry for entry in entries if entry.path.parts[: len(within)] == within)
    for entry in _expanded(entries, 0, budget):
        if not is_litter(entry.path) and not _MADE & set(entry.path.parts[:-1]):
            count += 1
            if count > _MOST:
                raise ValueError(f"it holds more than {_MOST} files")
            yield entry


def names_in(path: Path, opened: bool) -> Iterator[PurePosixPath]:
    """Returns the files' names, to tell a class from a submission. `opened`: includes those in archives inside it.

    Each name at the top has a budget of its own, and beyond it no further names; in an archive with a folder that holds
    everything, each name in that folder.
    """
    levels = 1 if path.is_dir() else 1 + _levels_above(path)
    counts, budgets = Counter(), defaultdict(lambda: _Budget(_ARCHIVES_OF_A_NAME, _UNPACKED_OF_A_NAME))
    for entry in _entries(path, _Budget(unpacked=_OF_A_CLASS)):
        top = entry.path.parts[:levels]
        yield from [entry.path] if opened and is_archive(entry.path.name) else []
        with contextlib.suppress(OverBudget):
            for inner in _expanded(iter([entry]), 0, budgets[top]) if opened else [entry]:
                counts[top] += 1
                if counts[top] > _MOST:
                    break
                yield inner.path


def _levels_above(path: Path) -> int:
    """Returns the number of folders, one in another, that hold everything in an archive."""
    common = None
    for entry in _entries(path, _Budget(unpacked=_OF_A_CLASS)):
        if not is_litter(entry.path):
            folders = entry.path.parts[:-1]
            common = folders if common is None else os.path.commonprefix([common, folders])
        if common == ():
            break
    return len(common or ())


def text(name: str) -> str:
    """Returns a file's name, of which some bytes may not be letters."""
    return os.fsencode(name).decode("utf-8", errors="replace")


def _entries(path: Path, budget: _Budget) -> Iterator[Entry]:
    if path.is_dir():
        return _of_folder(path)
    if is_archive(path.name):
        return _of_archive(path.name, _open_regular(path), budget)
    found = path.lstat()
    return iter([Entry(PurePosixPath(text(path.name)), _kind(found.st_mode), found.st_size,
                       lambda: _read_regular(path))])


def _expanded(entries: Iterator[Entry], depth: int, budget: _Budget) -> Iterator[Entry]:
    for entry in entries:
        if entry.kind != "file" or not is_archive(entry.path.name) or is_litter(entry.path):
            yield entry
            continue
        try:
            if depth >= _DEEPEST or entry.size > _LARGEST_ARCHIVE:
                raise ValueError("archives too deep in one another, or too large")
            budget.open_archive()
            budget.take(entry.size)
            content = io.BytesIO(entry.read())
            for inner in _expanded(_of_archive(entry.path.name, content, budget), depth + 1, budget):
                yield replace(inner, path=entry.path / inner.path)
        except OverBudget:
            raise
        except Exception as error:  # a damaged archive has the library raise whatever its decoders do
            yield Entry(entry.path, "damaged", 0, lambda: b"", f"{entry.path} cannot be read: "
                        f"{cause(error)}")


def _of_folder(root: Path) -> Iterator[Entry]:
    unread: list[OSError] = []
    for folder, folders, files in os.walk(root, onerror=unread.append):
        if len(os.fsencode(folder)) > _LONGEST_FOLDER:
            folders.clear()
            yield Entry(_below(root, Path(folder)), "damaged", 0, lambda: b"", "folders with names so long cannot be read")
            continue
        # A link to a folder is listed among the folders, and never followed.
        folders.sort()
        for name in sorted(files + [name for name in folders if Path(folder, name).is_symlink()]):
            path = Path(folder, name)
            try:
                found = path.lstat()
            except OSError as error:  # removed in the meantime, or its folder may be listed only
                unread.append(error)
                continue
            largest = _LARGEST_ARCHIVE if is_archive(name) else LARGEST
            yield Entry(_below(root, path), _kind(found.st_mode), found.st_size,
                        lambda path=path, largest=largest: _read_regular(path, largest))
        place = _below(root, Path(folder))
        if folders and len(place.parts) >= _DEEPEST_FOLDER:
            folders.clear()  # os.walk calls itself for each level
            yield Entry(place, "damaged", 0, lambda: b"", f"folders more than {_DEEPEST_FOLDER} deep cannot be read")
    for error in unread:
        place = _below(root, Path(error.filename))
        place = place if place.parts else PurePosixPath(text(root.name))
        yield Entry(place, "damaged", 0, lambda: b"", f"{place} cannot be read: {error.strerror}")


def _below(root: Path, path: Path) -> PurePosixPath:
    return PurePosixPath(text(path.relative_to(root).as_posix()))


def _kind(mode: int) -> str:
    return "link" if stat.S_ISLNK(mode) else "file" if stat.S_ISREG(mode) or not stat.S_IFMT(mode) else "other"


def _read_regular(path: Path, largest: int = LARGEST) -> bytes:
    with _open_regular(path, os.O_NOFOLLOW) as file:
        return file.read(largest + 1)


def _open_regular(path: Path, flags: int = 0):
    """Opens a regular file. If it has become a link or a pipe in the meantime, this is an error and does not block."""
    file = open(os.open(path, os.O_RDONLY | os.O_NONBLOCK | flags), "rb")
    if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
        file.close()
        raise OSError("not a regular file")
    return file


def _of_archive(name: str, file, budget: _Budget) -> Iterator[Entry]:
    """Yields the members of an archive; `file` is open and seekable. Its first bytes tell its kind, or else its name."""
    start = file.read(6)
    file.seek(0)
    name = next((ending for begins, ending in _BEGINNINGS.items() if start.startswith(begins)), name.lower())
    if name.endswith(_ZIP):
        yield from _of_zip(zipfile.ZipFile(file))
    elif name.endswith(_TAR):
        yield from _of_tar(tarfile.open(fileobj=_Unpacking(_decompressed(file), budget), mode="r:"))
    elif name.endswith(_SEVEN):
        yield from _of_seven(file)
    else:
        raise ValueError("this kind of archive is not read; zip, tar.gz and 7z are")


def _decompressed(file):
    """Detects the compression from the first bytes: a tar.gz may be named .tar."""
    start = file.read(6)
    file.seek(0)
    for begins, opened in _COMPRESSED.items():
        if start.startswith(begins):
            return opened(file)
    return file


def _of_zip(archive: zipfile.ZipFile) -> Iterator[Entry]:
    for info in archive.infolist():
        if not info.filename.endswith("/"):
            yield Entry(_path(info.filename.replace("\\", "/")), _kind(info.external_attr >> 16),
                        info.file_size, lambda info=info: _read_member(archive, info), time=info.date_time)


def _read_member(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> bytes:
    if info.flag_bits & 1:
        raise ValueError("it is encrypted")
    return _read_up_to(archive.open(info), info.filename)


def _of_tar(archive: tarfile.TarFile) -> Iterator[Entry]:
    for member in archive:
        if not member.isdir():
            kind = "file" if member.isreg() else "link" if member.issym() or member.islnk() else "other"
            yield Entry(_path(member.name), kind, member.size,
                        lambda member=member: _read_up_to(archive.extractfile(member), member.name),
                        time=_time(member.mtime))


def _time(seconds: float) -> tuple[int, ...]:
    with contextlib.suppress(OSError, OverflowError, ValueError):  # of a member that claims an impossible one
        return time.gmtime(seconds)[:6]
    return ()


def _path(name: str) -> PurePosixPath:
    """Returns a member's path; a printable one if it has no name or invalid bytes."""
    path = PurePosixPath(name.encode("utf-8", errors="replace").decode("utf-8").replace("\0", "?"))
    return path if path.parts else PurePosixPath("nameless")


def _read_up_to(file, name: str) -> bytes:
    with file:
        return file.read((_LARGEST_ARCHIVE if is_archive(name) else LARGEST) + 1)


def _of_seven(file) -> Iterator[Entry]:
    """Reads a 7z archive by libarchive's bsdtar, which converts it to tar, since Python's library has no 7z."""
    bsdtar = shutil.which("bsdtar")
    if not bsdtar:
        raise ValueError("7z needs bsdtar, of the package libarchive-tools")
    with tempfile.NamedTemporaryFile() as copy:
        content = file.read(_LARGEST_ARCHIVE + 1)
        if len(content) > _LARGEST_ARCHIVE:
            raise ValueError(f"a 7z of more than {_LARGEST_ARCHIVE >> 20} MiB is not read")
        copy.write(content)
        copy.flush()
        made = subprocess.run(["prlimit", "--cpu=20", f"--as={1 << 30}", "--", "/bin/sh", "-c",
                               f'"$0" "$@" | head -c {4 * _LARGEST_ARCHIVE + 1}', bsdtar, "--format=gnutar", "-cf", "-",
                               f"@{copy.name}"], capture_output=True)
    if len(made.stdout) > 4 * _LARGEST_ARCHIVE:
        raise ValueError(f"a 7z that holds more than {4 * _LARGEST_ARCHIVE >> 20} MiB is not read")
    if made.returncode != 0:
        raise ValueError(made.stderr.decode(errors="replace").strip() or "bsdtar cannot read it")
    yield from _of_tar(tarfile.open(fileobj=io.BytesIO(made.stdout)))
