"""Copies of files that another process may be writing at the same time."""

import shutil
from pathlib import Path


class Copies:
    """Copies files, and remembers each one's state, so that a change during the copying is noticed."""

    def __init__(self):
        self._states: dict[Path, tuple[int, ...] | None] = {}

    def watch(self, file: Path) -> Path:
        """Remembers the state of a file that is read in its place."""
        self._states.setdefault(file, _state(file))
        return file

    def copy(self, file: Path, to: Path) -> None:
        """Copies the content."""
        shutil.copyfile(self.watch(file), to)

    def changed(self) -> Path | None:
        """Returns a file that is missing, or is not as it was when it was first read; None if all are."""
        return next((file for file, state in self._states.items() if state is None or _state(file) != state), None)


def _state(file: Path) -> tuple[int, ...] | None:
    try:
        found = file.stat()
    except FileNotFoundError:
        return None
    return found.st_ino, found.st_size, found.st_mtime_ns, found.st_ctime_ns
