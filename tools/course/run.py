"""./course run and ./course scenes: the spook program, built when needed."""

import os
import signal
import subprocess
import sys

import diagnostics
from errors import CourseError
from exercise_object import drop_if_stale
from manifest import Exercise, all_exercises
from symbols import missing_functions
from terminal import fold
from tree import Tree

RELEASE = Tree("release")


def run(arguments: list[str]) -> int:
    mine = [exercise for exercise in all_exercises() if exercise.started() and exercise.file.exists()]
    if "--mine" not in arguments:
        return _become("spook", ["run", *arguments])
    forwarded = [argument for argument in arguments if argument != "--mine"]
    if not mine:
        print("No exercise of yours is written yet: all of it is the reference.", file=sys.stderr)
        return _become("spook", ["run", *forwarded])
    ids = ", ".join(exercise.id for exercise in mine)
    print(fold(f"Yours, right or wrong: {ids}; the rest is the reference."), file=sys.stderr)
    return _with_yours(["run", *forwarded], mine)


def _with_yours(arguments: list[str], mine: list[Exercise]) -> int:
    """A crash is told as what it is: an error in one of the student's functions."""
    sys.stdout.flush()
    code = subprocess.run([program("spook_mine", mine), *arguments]).returncode
    if code < 0:
        raise CourseError(f"the run crashed ({signal.Signals(-code).name}) in one of your functions; "
                          "./course check finds which")
    return code


def scenes(arguments: list[str]) -> int:
    return _become("spook", ["scenes", *arguments])


def program(target: str, mine: list[Exercise] = []) -> str:
    """The path of the program, up to date."""
    if mine:
        wanted = ";".join(exercise.function for exercise in mine)
        if RELEASE.setting("SPOOK_MINE") != wanted:
            RELEASE.configure(f"-DSPOOK_MINE={wanted}")
        for exercise in mine:
            drop_if_stale(RELEASE, exercise)
    first = "" if RELEASE.program("spook").exists() else " (a minute or so, the first time)"
    built = RELEASE.build([target], f"building the engine{first}", keep_going=True)
    if not built.ok:
        for exercise in mine:
            if RELEASE.failed(built, f"exercise_{exercise.function}"):
                raise CourseError(f"{exercise.label} does not compile: "
                                  f"{diagnostics.first_error(built.output, exercise)[0]}")
        raise RELEASE.own_failure(built)
    for exercise in mine:
        if missing_functions(RELEASE, exercise):
            raise CourseError(f"{exercise.label} is not defined in its file; "
                              f"see ./course check {exercise.id}")
    return str(RELEASE.program(target))


def _become(target: str, arguments: list[str]) -> int:
    """Exit code, signals and terminal are the program's own."""
    path = program(target)
    sys.stdout.flush()
    os.execv(path, [path, *arguments])
