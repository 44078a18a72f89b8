"""Looks for data races: ThreadSanitizer watches a student's function in the program that tests/races has for it."""

import os
import re
import shutil
import tempfile
from dataclasses import dataclass
from pathlib import Path

from manifest import Exercise
from paths import ROOT, shown
from tree import Tree
from trial import run_limited

_RACE = "WARNING: ThreadSanitizer: data race"
_DOES_NOT_START = "FATAL: ThreadSanitizer"  # on Linux where addresses are chosen more freely than it expects
_ACCESS = re.compile(r"^ *(?:Previous )?(?:atomic )?(read|write) of size ", re.IGNORECASE)
_INSIDE_AN_UPDATE = re.compile(r"\bupdate_pack\b")
_SHARED_PACK = "Is a pack given to two threads? Does a colour begin before all threads have finished the colour before it?"
_SHARED_NUMBER = ("Do all threads write the largest change into one variable? Give each thread its own, and combine "
                  "them in `next`, which runs while no thread works.")


@dataclass(frozen=True)
class Races:
    found: str = ""  # the first data race, explained
    skipped: str = ""  # why none was looked for


def races_of(tree: Tree, exercise: Exercise) -> Races:
    """Builds and runs the exercise's program under ThreadSanitizer; does nothing for exercises without threads."""
    if not (ROOT / "tests" / "races" / f"{exercise.function}.cpp").exists():
        return Races()
    target = f"race_{exercise.function}"
    built = tree.build([target], f"looking for data races in {exercise.label}")
    program = tree.program(target)
    if not built.ok or not program.is_file():
        return Races(skipped="No look for data races: ThreadSanitizer does not link here.")
    said = watched(program)
    if _RACE in said:
        return Races(found=explained(said, exercise))
    if _DOES_NOT_START in said:
        return Races(skipped="No look for data races: ThreadSanitizer does not start here.")
    return Races()


def watched(program: Path) -> str:
    """Returns the program's output, with the sanitizer's first report."""
    said = _run([str(program)])
    if _DOES_NOT_START in said and shutil.which("setarch"):
        said = _run(["setarch", "-R", str(program)])
    return said


def _run(command: list[str]) -> str:
    with tempfile.TemporaryDirectory(prefix="course-") as folder:
        output = Path(folder, "output")
        with open(output, "wb") as out:
            # It reserves more addresses than any machine has memory.
            run_limited(command, out, os.environ | {"TSAN_OPTIONS": "halt_on_error=1"}, folder, memory=None)
        return output.read_text(encoding="utf-8", errors="replace")


def explained(said: str, exercise: Exercise) -> str:
    """Returns the student's lines of the two accesses, and the likely cause."""
    report = said[said.index(_RACE):]
    stacks = [block for block in report.split("\n\n") if any(map(_ACCESS.match, block.splitlines()))][:2]
    lines = ["This is a data race: two threads use one number at the same time, and one of them writes it. "
             "ThreadSanitizer reports these lines:"]
    for stack in stacks:
        if told := _told(stack, exercise):
            lines += told
    lines.append(_SHARED_PACK if any(map(_INSIDE_AN_UPDATE.search, stacks)) else _SHARED_NUMBER)
    return "\n".join(lines)


def _told(stack: str, exercise: Exercise) -> list[str]:
    """Returns the student's innermost line in a stack, and what happens there."""
    found = re.search(rf"{exercise.folder}/{exercise.file.name}:(\d+)", stack)
    if not found:
        return []
    access = next(match for match in map(_ACCESS.match, stack.splitlines()) if match)
    number = int(found[1])
    source = (exercise.source() or "").splitlines()
    text = source[number - 1].strip() if number <= len(source) else ""
    return [f"{shown(exercise.file)}:{number} {access[1].lower()}s it", f"    {text}"]
