"""The folder of a book, with a list of the files that the book has written there. All other files in it stay."""

import os
from pathlib import Path

from errors import CourseError

_LIST = Path("assets/files.txt")
_INDEX = Path("assets/index.js")  # which a book has that was made before there was a list


def has_book(folder: Path) -> bool:
    """Returns True if there is a book, or what is left of one whose making was interrupted."""
    return (folder / _LIST).exists() or (folder / _INDEX).exists()


class Folder:
    """Writes files, each of which is put on the list first, so that an interrupted book is replaced by the next one."""

    def __init__(self, path: Path):
        self._path = path
        self._is_old = (path / _INDEX).exists() and not (path / _LIST).exists()
        self._before = {Path(line) for line in _lines(path / _LIST)}
        self._now: set[Path] = set()

    def place(self, name: Path) -> Path:
        """Returns where to write a file; raises if somebody else has a file there."""
        whole = self._path / name
        if name not in self._before | self._now and not self._is_old and os.path.lexists(whole):
            raise CourseError(f"book: {whole} is no file of the last book, and would be lost; move it elsewhere")
        if name not in self._now:
            (self._path / _LIST).parent.mkdir(parents=True, exist_ok=True)
            with open(self._path / _LIST, "a", encoding="utf-8") as out:
                out.write(f"{name.as_posix()}\n")
            self._now.add(name)
        whole.parent.mkdir(parents=True, exist_ok=True)
        return whole

    def finish(self) -> None:
        """Removes the files of the last book that this one does not have."""
        for name in self._before - self._now:
            (self._path / name).unlink(missing_ok=True)
            _drop_empty(self._path / name, self._path)
        names = sorted(name.as_posix() for name in self._now)
        (self._path / _LIST).write_text("".join(f"{name}\n" for name in names), encoding="utf-8")


def _lines(file: Path) -> list[str]:
    return file.read_text(encoding="utf-8").splitlines() if file.exists() else []


def _drop_empty(file: Path, root: Path) -> None:
    for folder in file.relative_to(root).parents:
        try:
            if folder != Path("."):
                (root / folder).rmdir()
        except OSError:
            return
