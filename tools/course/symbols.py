"""Tells whether a student's object defines the exercise's function.

The linker fills missing functions from the reference. Without this check an empty file, or a function with another
name or signature, would be tested as the reference, and pass.
"""

import functools
import subprocess
from pathlib import Path

from errors import CourseError
from exercise_object import object_file
from manifest import Exercise
from tree import Tree


def missing_functions(tree: Tree, exercise: Exercise, built: Tree | None = None) -> list[str]:
    """Returns the functions, readable, that the reference defines for the exercise and the student does not.

    The student's object is in `tree`; the reference is there, too, or in `built`.
    """
    wanted = reference_functions(built or tree, exercise)
    if not wanted:  # else any file would have all of them
        raise CourseError(f"the names of functions cannot be read: nm finds no {exercise.function} in the reference")
    missing = sorted(wanted - functions_in(object_file(tree, exercise), exercise.function))
    if not missing:
        return []
    return subprocess.run(["c++filt", "-n", *missing], capture_output=True, text=True).stdout.splitlines()


def reference_functions(tree: Tree, exercise: Exercise) -> set[str]:
    return functions_in(tree.path / "solutions" / "libspook_reference.a", exercise.function)


def functions_in(file: Path, name: str) -> set[str]:
    """Returns the functions spook::`name` that other objects can call, including overloads and a template's
    instances."""
    mangled = f"_ZN5spook{len(name)}{name}"
    written = file.stat().st_mtime_ns if file.exists() else 0
    return {symbol for symbol in _defined_in(file, written) if symbol.startswith(mangled)}


@functools.cache
def _defined_in(file: Path, _written: int) -> frozenset[str]:
    """Returns all functions that others can call. The archive of the reference is read once for all exercises."""
    listing = subprocess.run(["nm", "-P", "--defined-only", str(file)], capture_output=True, text=True)
    # macOS puts one more _ before each name.
    lines = [line.removeprefix("_").split() if line.startswith("__Z") else line.split()
             for line in listing.stdout.splitlines()]
    return frozenset(words[0] for words in lines if words and words[0].startswith("_ZN5spook") and words[1].isupper())
