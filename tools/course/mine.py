"""--mine: programs of the engine with the student's finished functions in place of the reference's."""

import itertools
import json
import re
from pathlib import Path

import diagnostics
from engine import RELEASE, WEB, program, program_of_pages
from errors import CourseError
from exercise_object import drop_if_stale, object_file
from manifest import Exercise, all_exercises
from symbols import missing_functions
from text_encoding import refuse_odd
from tree import Tree
from verdict import CHECK

CALLS = "SPOOK_CALLS"  # names the file to which a program writes what it has called; see tools/noting.py


def own_engine(words: list[str]) -> tuple[bool, list[str]]:
    """Tells whether the words ask for --engine mine, which is the plain engine on the student's functions; and the words
    that the program takes for it."""
    text = "\n".join(words)
    plain = re.sub(r"^--engine[=\n]mine$", "--engine\nplain", text, flags=re.MULTILINE)
    return plain != text, plain.split("\n") if words else words


def begun() -> list[Exercise]:
    return [exercise for exercise in all_exercises() if exercise.started() and exercise.file.exists()]


def told(mine: list[Exercise], called: set[str] | None = None) -> str:
    """Tells which functions are the student's: only those that were `called`, if that is known."""
    used = [exercise for exercise in mine if called is None or exercise.function in called]
    if not used:
        return f"This run calls no function of yours; you have begun {_listed(mine)}. Everything is the reference."
    idle = [exercise for exercise in mine if exercise not in used]
    not_called = f" Yours, too, but not called: {_listed(idle)}." if idle else ""
    return f"Yours, right or wrong: {_listed(used)}; the rest is the reference.{not_called}"


def _listed(exercises: list[Exercise]) -> str:
    """Names exercises, in their order; three or more in a row as "1.1 to 2.7"."""
    order = {exercise.id: place for place, exercise in enumerate(all_exercises())}
    places = sorted((order[exercise.id], exercise.id) for exercise in exercises)
    said = []
    for _, run in itertools.groupby(enumerate(places), lambda item: item[1][0] - item[0]):
        ids = [exercise_id for _, (_, exercise_id) in run]
        said += [f"{ids[0]} to {ids[-1]}"] if len(ids) > 2 else ids
    return ", ".join(said)


def signed(line: str, mine: list[Exercise]) -> str:
    """Adds the names of the student's functions to the header of a recording."""
    return json.dumps(json.loads(line) | {"mine": [exercise.function for exercise in mine]})


def checked_program(mine: list[Exercise]) -> Path:
    """Builds the program spook_mine from the objects that `check` tests. After a check it only needs linking.

    All chapters' functions have their checks on, and are slower for that.
    """
    _compile(CHECK, mine)
    _compile_the_rest()
    _set(RELEASE, "SPOOK_MINE_OBJECTS", [str(object_file(CHECK, exercise)) for exercise in mine])
    return _complete(program("spook_mine"), CHECK, mine)


def fast_program(target: str, mine: list[Exercise]) -> Path:
    """Builds the target with the student's functions at full speed. All other chapters' functions have their checks on."""
    _set(RELEASE, "SPOOK_MINE", [exercise.function for exercise in mine])
    _compile(RELEASE, mine)
    _compile_the_rest()
    return _complete(program(target), RELEASE, mine)


def program_of_own_pages(mine: list[Exercise]) -> Path:
    """The engine of live figures with the student's functions.

    They are compiled for this machine first: what does not compile, or is not there, is told as everywhere.
    """
    _compile(RELEASE, mine)
    _complete(program("spook"), RELEASE, mine)
    _set(WEB, "SPOOK_MINE", [exercise.function for exercise in mine])
    return program_of_pages("spook_live_mine")


def _compile_the_rest() -> None:
    """Builds the archive from which a linker takes the functions that the student lacks."""
    built = CHECK.build(["spook_reference"], "building the other functions")
    if not built.ok:
        raise CHECK.own_failure(built)


def _compile(tree: Tree, mine: list[Exercise]) -> None:
    for exercise in mine:
        refuse_odd(exercise.file)
        drop_if_stale(tree, exercise)
    built = tree.build([f"exercise_{exercise.function}" for exercise in mine], "building your functions", keep_going=True)
    for exercise in mine:
        if tree.failed(built, f"exercise_{exercise.function}"):
            raise CourseError(f"{exercise.label} does not compile: "
                              f"{diagnostics.first_error(built.output, exercise)[0]}")
    if not built.ok:
        raise tree.own_failure(built)


def _complete(path: Path, compiled: Tree, mine: list[Exercise]) -> Path:
    """Returns the program if none of these exercises' functions is the reference's."""
    for exercise in mine:
        if missing_functions(compiled, exercise, RELEASE):
            raise CourseError(f"{exercise.label} is not defined in its file; see ./course check {exercise.id}")
    return path


def _set(tree: Tree, name: str, values: list[str]) -> None:
    wanted = ";".join(values)
    if tree.setting(name) != wanted:
        tree.configure(f"-D{name}={wanted}")
