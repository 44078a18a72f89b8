"""The answers to an exercise that are tried: the changes in its .diff, then the files with another algorithm each.

A file is named function.mistake.cpp, and begins with what a .diff says of a mutant:

    // Wrong: adds the force alone.
    // Killed by: Kick.AddsForceOverMass
    // Says: the force has not been divided by the mass

A right answer, of a style that a test might refuse, has `Right:` in place of `Wrong:`, and no more.
"""

import itertools
import re
from pathlib import Path

from answer import Answer, code_of, refused
from changes import lines_of, read_changes
from errors import CourseError
from manifest import Exercise, all_exercises
from paths import ROOT, shown

MUTANTS = ROOT / "tests" / "mutants"
_HEADER = re.compile(r"Wrong: (.+) Killed by: (\S+) Says: (.+)|Right: (.+)")


def files_of(exercise: Exercise) -> list[Path]:
    folder = MUTANTS / exercise.folder
    return [*folder.glob(f"{exercise.function}.diff"), *folder.glob(f"{exercise.function}.*.cpp")]


def exercise_of(file: Path) -> Exercise:
    """Returns the exercise that this file answers."""
    function = file.name.split(".")[0]
    for exercise in all_exercises():
        if (exercise.folder, exercise.function) == (file.parent.name, function):
            return exercise
    raise CourseError(f"{shown(file)}: {file.parent.name} has no exercise {function}")


def read_answers(files: list[Path]) -> list[Answer]:
    """Reads the answers to one exercise."""
    known: dict[str, Answer] = {}
    reference = exercise_of(files[0]).reference
    right = code_of(lines_of(reference))
    for file in sorted(files):
        for answer in read_changes(file, reference) if file.suffix == ".diff" else [_whole(file)]:
            if answer.name in known:
                raise refused(file, answer.line, f"this name is taken by {known[answer.name].place}", answer.name)
            if code_of(answer.lines) == right:
                raise refused(file, answer.line, "it changes nothing", answer.name)
            known[answer.name] = answer
    return list(known.values())


def reference_of(exercise: Exercise) -> Answer:
    """Returns the right answer, which the others change."""
    return Answer(exercise.reference, 1, "reference", "", "", "", tuple(lines_of(exercise.reference)))


def by_exercise(files: list[Path]) -> list[list[Path]]:
    """Returns the files of each exercise, in the order of their names."""
    found: dict[tuple[str, str], list[Path]] = {}
    for file in sorted(files):
        found.setdefault((file.parent.name, file.name.split(".")[0]), []).append(file)
    return list(found.values())


def _whole(file: Path) -> Answer:
    lines, name = lines_of(file), file.name.split(".")[1]
    comment = itertools.takewhile(lambda line: line.text.startswith("//"), lines)
    header = _HEADER.fullmatch(" ".join(line.text.lstrip("/").strip() for line in comment))
    if not header:
        raise refused(file, 1, "the comment at the top must have 'Wrong: ...', 'Killed by: ...', 'Says: ...'", name)
    wrong, test, says, right = header.groups(default="")
    return Answer(file, 1, name, right or wrong, test, says, tuple(lines))
