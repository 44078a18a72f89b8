"""./course try: a small program of the student's own around one function, built and run at each save."""

import os
import re
import signal
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import crash
import diagnostics
from errors import CourseError
from exercise_object import drop_if_stale
from manifest import Exercise, all_exercises
from mine import begun, told
from paths import CHAPTERS, shown
from pick import pick_one
from symbols import missing_functions
from text_encoding import refuse_odd
from terminal import fold
from trial import clock_limit, run_limited, time_limit
from verdict import CHECK
from watch import saved

_PERIOD = 0.3
_SETTING = "SPOOK_TRY"
_FRAME = """\
// A playground for {label}: change anything. ./course try {id} builds and runs it at each save.
// What the function promises is in {header}. Delete this file, and a new one is made.
#include "{header}"

#include "common/show.hpp"

using namespace spook;

int main() {{
{body}}}
"""


@dataclass(frozen=True)
class Playground:
    exercise: Exercise

    @property
    def file(self) -> Path:
        return CHAPTERS / self.exercise.folder / "try" / f"{self.target}.cpp"

    @property
    def target(self) -> str:
        return f"try_{self.exercise.function}"

    def source(self) -> str:
        return self.file.read_text(encoding="utf-8", errors="replace")

    def make(self) -> bool:
        """Writes the playground. Returns True if there was none before."""
        self.file.parent.mkdir(exist_ok=True)
        try:
            with self.file.open("x", encoding="utf-8") as out:
                out.write(first_text(self.exercise))
        except FileExistsError:
            return False
        return True


def first_text(exercise: Exercise) -> str:
    """Returns the whole file: the code in chapters/NN_topic/try.md for the exercise, in a program."""
    body = examples(exercise.folder).get(exercise.label)
    if body is None:
        raise CourseError(f"chapters/{exercise.folder}/try.md has no example for {exercise.label}")
    header = next((CHAPTERS / exercise.folder).glob("*.hpp"))
    indented = "".join(f"  {line}".rstrip() + "\n" for line in body.splitlines())
    return _FRAME.format(label=exercise.label, id=exercise.id, body=indented, header=f"{exercise.folder}/{header.name}")


def examples(folder: str) -> dict[str, str]:
    """Returns the code below each heading of try.md, by the heading."""
    page = CHAPTERS / folder / "try.md"
    text = page.read_text(encoding="utf-8") if page.exists() else ""
    return dict(re.findall(r"^## +(.+?)\s*$\n+```cpp\n(.*?)^```$", text, re.MULTILINE | re.DOTALL))


def playground(arguments) -> int:
    ours = Playground(pick_one(arguments.which))
    made = ours.make()
    if arguments.once:
        return _run(ours)
    files = [ours.file, *(exercise.file for exercise in all_exercises())]
    seen = None
    while True:
        now = [saved(file) for file in files]
        if now != seen:
            seen = now
            if sys.stdout.isatty():
                print("\033[2J\033[3J\033[H", end="")
            _run_and_tell(ours)
            what = "Yours to change" if made else "Your playground"
            print(f"\n{what}: {shown(ours.file)}\nWatching; Ctrl-C ends.", flush=True)
        time.sleep(_PERIOD)


def _run_and_tell(ours: Playground) -> None:
    try:
        _run(ours)
    except CourseError as error:
        print(f"{error.details}\n" if error.details else "", f"course: {error}", sep="", flush=True)


def _run(ours: Playground) -> int:
    mine = begun()
    program = _build(ours, mine)
    whose = fold(told(mine)) if mine else "You have written no exercise yet: everything is the reference."
    print(f"{whose}\n", flush=True)
    with tempfile.TemporaryDirectory(prefix="course-") as folder:
        trace, printed = Path(folder, "trace"), Path(folder, "output")
        with open(printed, "wb") as out:
            code, timed_out = run_limited([str(program)], out, os.environ | {crash.VARIABLE: str(trace)}, folder)
        output = printed.read_text(encoding="utf-8", errors="replace")
        print(crash.without_assertion(output).rstrip(), flush=True)
        if timed_out:
            raise CourseError(f"the program did not end within {time_limit():g} s of processor time, or "
                              f"{clock_limit():g} s on the clock; does a loop never end?")
        if code < 0:
            where = crash.place(program, trace, [ours, *mine])
            name = signal.Signals(-code).name
            raise CourseError(f"it {crash.ending(name, output)}", crash.explained(name, output, where))
    return code


def _build(ours: Playground, mine: list[Exercise]) -> Path:
    wanted = ";".join(exercise.function for exercise in mine)
    for file in (ours.file, *(exercise.file for exercise in mine)):
        refuse_odd(file)
    for exercise in mine:
        drop_if_stale(CHECK, exercise)
    if CHECK.setting(_SETTING) != wanted:
        CHECK.configure(f"-D{_SETTING}={wanted}")
    built = CHECK.build([ours.target], f"building {shown(ours.file)}", keep_going=True)
    for exercise in mine:
        if CHECK.failed(built, f"exercise_{exercise.function}"):
            raise CourseError(f"{exercise.label} does not compile",
                              "\n".join(diagnostics.first_error(built.output, exercise)))
    if CHECK.failed(built, ours.target):
        raise CourseError(f"{shown(ours.file)} does not compile",
                          "\n".join(diagnostics.first_error(built.output, ours)))
    if not built.ok:
        raise CHECK.own_failure(built)
    for exercise in mine:
        if missing_functions(CHECK, exercise):
            raise CourseError(f"{exercise.label} is not defined in its file; see ./course check {exercise.id}")
    return CHECK.program(ours.target)
