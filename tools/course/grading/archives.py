"""The files in a folder or an archive, and in archives inside it: never unpacked, read only when they are wanted."""

import io
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
    count = 0
    for entry in _expanded(_entries(path), 0):
        if not is_litter(entry.path):
            count += 1
            if count > _MOST:
                raise ValueError(f"it holds more than {_MOST} files")
            yield entry


def text(name: str) -> str:
    """A file's name may hold bytes that are no letters."""
    return os.fsencode(name).decode("utf-8", errors="replace")


def _entries(path: Path) -> Iterator[Entry]:
    if path.is_dir():
        return _of_folder(path)
    if is_archive(path.name):
        return _of_archive(path.name, path)
    found = path.lstat()
    return iter([Entry(PurePosixPath(text(path.name)), _kind(found.st_mode), found.st_size,
                       lambda: _read_regular(path))])


def _expanded(entries: Iterator[Entry], depth: int) -> Iterator[Entry]:
    for entry in entries:
        if entry.kind != "file" or not is_archive(entry.path.name) or is_litter(entry.path):
            yield entry
            continue
        try:
            if depth >= _DEEPEST or entry.size > _LARGEST_ARCHIVE:
                raise ValueError("archives too deep in one another, or too large")
            content = io.BytesIO(entry.read())
            for inner in _expanded(_of_archive(entry.path.name, content), depth + 1):
                yield Entry(entry.path / inner.path, inner.kind, inner.size, inner.read, inner.problem)
        except Exception as error:  # a damaged archive has the library raise whatever its decoders do
            yield Entry(entry.path, "damaged", 0, lambda: b"", f"{entry.path} can not be read: {error}")


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
    """What is a link or a pipe by the time that it is opened is an error, and does not block."""
    with open(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise OSError("not a regular file")
        return file.read(largest + 1)


def _of_archive(name: str, file) -> Iterator[Entry]:
    """`file` is a path, or the archive's content."""
    name = name.lower()
    if name.endswith(_ZIP):
        yield from _of_zip(zipfile.ZipFile(file))
    elif name.endswith(_TAR):
        yield from _of_tar(tarfile.open(file) if isinstance(file, Path) else tarfile.open(fileobj=file))
    elif name.endswith(_SEVEN):
        yield from _of_seven(file)
    else:
        raise ValueError("this kind of archive is not read; zip, tar.gz and 7z are")


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
        copy.write(file.read_bytes() if isinstance(file, Path) else file.read())
        copy.flush()
        made = subprocess.run(["prlimit", "--cpu=20", f"--as={1 << 30}", "--", bsdtar, "--format=gnutar", "-cf", "-",
                               f"@{copy.name}"], capture_output=True)
    if made.returncode != 0 or len(made.stdout) > 4 * _LARGEST_ARCHIVE:
        raise ValueError(made.stderr.decode(errors="replace").strip() or "bsdtar can not read it")
    yield from _of_tar(tarfile.open(fileobj=io.BytesIO(made.stdout)))
