"""The reference for linking with a submission: without the exercise's own answer, and without later ones.

Each exercise has an archive of its own. It holds the earlier functions of the course, which the answer may call, and no
other answers.
"""

import subprocess
import threading
from pathlib import Path

from errors import CourseError
from manifest import Exercise, all_exercises
from symbols import functions_in

# Earlier functions that are the answer under another name.
_ANSWERS_BY_ITSELF = {"drift": {"kick"}}


def callable_from(exercise: Exercise) -> list[str]:
    """Returns the exercises whose functions an answer may call, by function."""
    order = [one.function for one in all_exercises()]
    hidden = _ANSWERS_BY_ITSELF.get(exercise.function, set())
    return [function for function in order[: order.index(exercise.function)] if function not in hidden]


class Reference:
    """Extracts `archive` into `folder`, and makes archives on demand, from any thread."""

    def __init__(self, archive: Path, folder: Path):
        self._folder, self._members, self._making = folder, folder / "members", threading.Lock()
        self.symbols = {one.function: functions_in(archive, one.function) for one in all_exercises()}
        self._members.mkdir(parents=True)
        names = _ran(["ar", "t", str(archive)], folder).split()
        if len(set(names)) != len(names):
            raise CourseError(f"{archive.name} has two objects of one name; nothing is graded")
        _ran(["ar", "x", str(archive.resolve())], self._members)
        self._asked = _asked_by(self._members)
        # Instances of templates, which a compiler defines as weak.
        self.weak = frozenset(line.split()[0] for line in _ran(["nm", "-P", "--defined-only", str(archive)], folder)
                              .splitlines() if line.split()[1:2] == ["W"])

    def callable_symbols(self, exercise: Exercise) -> frozenset[str]:
        return frozenset().union(*(self.symbols[function] for function in callable_from(exercise)))

    def archive_for(self, exercise: Exercise) -> Path:
        """Makes an archive of the objects' names and symbols; the objects stay in place."""
        made = self._folder / f"{exercise.function}.a"
        allowed, exercises = set(callable_from(exercise)), {one.function for one in all_exercises()}
        members = [file for file in sorted(self._members.iterdir())
                   if (name := file.name.partition(".")[0]) in allowed or name not in exercises]
        with self._making:
            if not made.exists():
                members = [self._without_later(exercise, file) for file in members]
                _ran(["ar", "rcsT", str(made), *(str(file) for file in members)], self._folder)
        return made

    def _without_later(self, exercise: Exercise, member: Path) -> Path:
        """Allows a member that is not an exercise to leave later exercises undefined. Otherwise it would not link."""
        known = {exercise.function, *callable_from(exercise)}
        later = frozenset().union(*(symbols for function, symbols in self.symbols.items() if function not in known))
        called = later & self._asked.get(member.name, set())
        if not called:
            return member
        made = self._folder / f"{exercise.function}-{member.name}"
        _ran(["objcopy", *(f"--weaken-symbol={symbol}" for symbol in sorted(called)), str(member), str(made)],
             self._folder)
        return made

    def asks_only_for(self, exercise: Exercise, asking: Path) -> Path:
        """Returns a copy of an object that may leave the functions of all other exercises undefined.

        Otherwise each of them would be linked, and a submission could read its code without a call.
        """
        made = self._folder / f"{exercise.function}-{asking.name}"
        others = [f"--weaken-symbol={symbol}" for function, symbols in self.symbols.items()
                  for symbol in sorted(symbols) if function != exercise.function]
        with self._making:
            if not made.exists():
                _ran(["objcopy", *others, str(asking), str(made)], self._folder)
        return made


def _asked_by(folder: Path) -> dict[str, set[str]]:
    """Returns the symbols that each object leaves undefined, by its name. nm is called once: to start it takes longer
    than to read an object."""
    asked: dict[str, set[str]] = {}
    names = sorted(file.name for file in folder.iterdir())
    for line in _ran(["nm", "-A", "-P", "--undefined-only", *names], folder).splitlines():
        name, _, symbol = line.partition(": ")
        asked.setdefault(name, set()).add(symbol.split()[0])
    return asked


def _ran(command: list[str], folder: Path) -> str:
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if result.returncode != 0:
        raise CourseError(f"{command[0]} cannot take the reference apart", result.stderr)
    return result.stdout
