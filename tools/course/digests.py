"""Digests of files, and those of a tree's last green run, by name."""

import hashlib
import json
import os
from pathlib import Path

from tree import Tree


def digest(root: Path, files: list[Path]) -> str:
    """Returns a digest of the names and contents of files below root; what is no file does not count."""
    parts = hashlib.sha256()
    for file in sorted(file for file in files if file.is_file()):
        parts.update(f"{file.relative_to(root)}\0{hashlib.sha256(file.read_bytes()).hexdigest()}\n".encode())
    return parts.hexdigest()


def of_last_run(tree: Tree, file: str) -> dict | None:
    """Returns the digests that keep() wrote; None if there are none."""
    try:
        found = json.loads((tree.path / file).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) else None


def keep(tree: Tree, file: str, now: dict[str, str]) -> None:
    """Keeps the digests of a green run. They are older than its build, so that a change during the run counts."""
    new = (tree.path / file).with_suffix(".new")
    new.write_text(json.dumps(now, indent=2) + "\n", encoding="utf-8")
    os.replace(new, tree.path / file)
