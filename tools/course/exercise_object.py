"""The object file compiled from a student's file."""

import hashlib
from pathlib import Path

from manifest import Exercise
from tree import Tree


def object_file(tree: Tree, exercise: Exercise) -> Path:
    folder = tree.path / "chapters" / "CMakeFiles" / f"exercise_{exercise.function}.dir"
    return folder / exercise.folder / f"{exercise.function}.cpp.o"


def drop_if_stale(tree: Tree, exercise: Exercise) -> None:
    """Removes the object of another answer.

    Ninja compares times only. It would take a file that is unpacked or copied with its old time for the one that was
    compiled last, which would then get its marks.
    """
    compiled = object_file(tree, exercise)
    record = compiled.with_suffix(".source")
    source = hashlib.sha256(exercise.file.read_bytes()).hexdigest()
    if record.exists() and record.read_text() == source:
        return
    compiled.unlink(missing_ok=True)
    record.parent.mkdir(parents=True, exist_ok=True)
    record.write_text(source)
