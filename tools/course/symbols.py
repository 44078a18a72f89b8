"""Whether a student's object really holds the exercise's function.

The linker fills whatever is missing from the reference. Without this check an empty file, or a function with
another name or signature, would be tested as the reference, and pass.
"""

import subprocess
from pathlib import Path

from exercise_object import object_file
from manifest import Exercise
from tree import Tree


def missing_functions(tree: Tree, exercise: Exercise) -> list[str]:
    """The functions, readable, which the reference defines for the exercise and the student doesn't."""
    missing = sorted(reference_functions(tree, exercise)
                     - functions_in(object_file(tree, exercise), exercise.function))
    if not missing:
        return []
    return subprocess.run(["c++filt", *missing], capture_output=True, text=True).stdout.splitlines()


def reference_functions(tree: Tree, exercise: Exercise) -> set[str]:
    return functions_in(tree.path / "solutions" / "libspook_reference.a", exercise.function)


def functions_in(file: Path, name: str) -> set[str]:
    """The functions spook::`name` that other objects can call: overloads, and a template's instances, too."""
    mangled = f"_ZN5spook{len(name)}{name}"
    listing = subprocess.run(["nm", "-P", "--defined-only", str(file)], capture_output=True, text=True)
    lines = [line.split() for line in listing.stdout.splitlines() if line.startswith(mangled)]
    return {words[0] for words in lines if words[1].isupper()}
