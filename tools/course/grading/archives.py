"""The files in a folder or an archive, and in archives inside it: never unpacked, read only when they are wanted."""

import bz2
import gzip
import io
import lzma
import os
import shutil
import stat
import subprocess
import tarfile
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

LARGEST = 256 << 10  # bytes of a file; the reference's longest answer has a twentieth of that
_LARGEST_ARCHIVE = 64 << 20  # inside another
_DEEPEST = 4
_MOST = 20_000  # files
_MOST_ARCHIVES = 200  # of one submission, one in another
_UNPACKED = 1 << 30  # bytes that a submission's archives may give, those read twice counted twice
_ZIP, _TAR, _SEVEN = (".zip",), (".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tbz2", ".tar.xz", ".txz"), (".7z",)
_NOT_READ = (".rar", ".gz", ".bz2", ".xz")
_LITTER = {"__MACOSX", ".DS_Store", "Thumbs.db", "desktop.ini"}


@dataclass(frozen=True)
class Entry:
    path: PurePosixPath
    kind: str  # file, link, other, or damaged: an archive that can't be read
    size: int
    read: Callable[[], bytes]
    problem: str = ""


class _Budget:
    """What one submission may cost to look through."""

    def __init__(self):
        self._archives, self._bytes = _MOST_ARCHIVES, _UNPACKED

    def open_archive(self) -> None:
        self._archives -= 1
        if self._archives < 0:
            raise OverBudget(f"it holds more than {_MOST_ARCHIVES} archives")

    def take(self, count: int) -> None:
        self._bytes -= count
        if self._bytes < 0:
            raise OverBudget(f"its archives hold more than {_UNPACKED >> 20} MiB")


class OverBudget(Exception):
    """Ends the whole submission, and not only the archive that was one too many."""


class _Unpacking(io.RawIOBase):
    """What a decompressor gives, counted: a file of a few bytes may unpack to a terabyte."""

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
        """Forwards in steps: a decompressor gets there by unpacking, and begins anew for one that is behind it."""
        if whence != io.SEEK_SET:
            raise ValueError("only from the start")
        if offset < self._source.tell():
            self._source.seek(0)
        while self._source.tell() < offset and self.read(min(1 << 20, offset - self._source.tell())):
            pass
        return self._source.tell()


def is_archive(name: str) -> bool:
    return name.lower().endswith(_ZIP + _TAR + _SEVEN + _NOT_READ[:1])


def without_suffix(name: str) -> str:
    """Of an archive."""
    for suffix in sorted(_ZIP + _TAR + _SEVEN + _NOT_READ[:1], key=len, reverse=True):
        if name.lower().endswith(suffix):
            return name[: -len(suffix)]
    return name


def is_litter(path: PurePosixPath) -> bool:
    """What systems leave in folders, and nobody has written."""
    return bool(_LITTER & set(path.parts)) or path.name.startswith("._")


def entries_of(path: Path) -> Iterator[Entry]:
    """All files, those in archives below the archive's name. Litter is left out."""
    count, budget = 0, _Budget()
    for entry in _expanded(_entries(path, budget), 0, budget):
        if not is_litter(entry.path):
            count += 1
            if count > _MOST:
                raise ValueError(f"it holds more than {_MOST} files")
            yield entry


def text(name: str) -> str:
    """A file's name may hold bytes that are no letters."""
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
                yield Entry(entry.path / inner.path, inner.kind, inner.size, inner.read, inner.problem)
        except OverBudget:
            raise
        except Exception as error:  # a damaged archive has the library raise whatever its decoders do
            yield Entry(entry.path, "damaged", 0, lambda: b"", f"{entry.path} cannot be read: {error}")


def _of_folder(root: Path) -> Iterator[Entry]:
    for folder, folders, files in os.walk(root):
        # A link to a folder is listed among the folders, and never followed.
        folders.sort()
        for name in sorted(files + [name for name in folders if Path(folder, name).is_symlink()]):
            path = Path(folder, name)
            found = path.lstat()
            largest = _LARGEST_ARCHIVE if is_archive(name) else LARGEST
            yield Entry(PurePosixPath(text(path.relative_to(root).as_posix())), _kind(found.st_mode), found.st_size,
                        lambda path=path, largest=largest: _read_regular(path, largest))


def _kind(mode: int) -> str:
    return "link" if stat.S_ISLNK(mode) else "file" if stat.S_ISREG(mode) or not stat.S_IFMT(mode) else "other"


def _read_regular(path: Path, largest: int = LARGEST) -> bytes:
    with _open_regular(path, os.O_NOFOLLOW) as file:
        return file.read(largest + 1)


def _open_regular(path: Path, flags: int = 0):
    """What is a link or a pipe by the time that it is opened is an error, and does not block."""
    file = open(os.open(path, os.O_RDONLY | os.O_NONBLOCK | flags), "rb")
    if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
        file.close()
        raise OSError("not a regular file")
    return file


def _of_archive(name: str, file, budget: _Budget) -> Iterator[Entry]:
    """`file` is open, and can be sought in."""
    name = name.lower()
    if name.endswith(_ZIP):
        yield from _of_zip(zipfile.ZipFile(file))
    elif name.endswith(_TAR):
        yield from _of_tar(tarfile.open(fileobj=_Unpacking(_decompressed(file), budget), mode="r:"))
    elif name.endswith(_SEVEN):
        yield from _of_seven(file)
    else:
        raise ValueError("this kind of archive is not read; zip, tar.gz and 7z are")


def _decompressed(file):
    """By what it begins with: a tar.gz may be named .tar."""
    start = file.read(6)
    file.seek(0)
    for begins, opened in ((b"\x1f\x8b", gzip.open), (b"BZh", bz2.open), (b"\xfd7zXZ\0", lzma.open)):
        if start.startswith(begins):
            return opened(file)
    return file


def _of_zip(archive: zipfile.ZipFile) -> Iterator[Entry]:
    for info in archive.infolist():
        if not info.is_dir():
            yield Entry(_path(info.filename.replace("\\", "/")), _kind(info.external_attr >> 16),
                        info.file_size, lambda info=info: _read_up_to(archive.open(info), info.filename))


def _of_tar(archive: tarfile.TarFile) -> Iterator[Entry]:
    for member in archive:
        if not member.isdir():
            kind = "file" if member.isreg() else "link" if member.issym() or member.islnk() else "other"
            yield Entry(_path(member.name), kind, member.size,
                        lambda member=member: _read_up_to(archive.extractfile(member), member.name))


def _path(name: str) -> PurePosixPath:
    """Of a member; one without a name, or with bytes that are no letters, has a name that can be shown."""
    path = PurePosixPath(name.encode("utf-8", errors="replace").decode("utf-8").replace("\0", "?"))
    return path if path.parts else PurePosixPath("nameless")


def _read_up_to(file, name: str) -> bytes:
    with file:
        return file.read((_LARGEST_ARCHIVE if is_archive(name) else LARGEST) + 1)


def _of_seven(file) -> Iterator[Entry]:
    """By libarchive's bsdtar, which makes a tar of it: Python's own library has no 7z."""
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
    if made.returncode != 0 or len(made.stdout) > 4 * _LARGEST_ARCHIVE:
        raise ValueError(made.stderr.decode(errors="replace").strip() or "bsdtar cannot read it")
    yield from _of_tar(tarfile.open(fileobj=io.BytesIO(made.stdout)))
