"""No earlier function is a later exercise's answer under another name: each that has the answer's type is tried."""

import itertools
import re
import unittest
from dataclasses import dataclass

from classroom import Classroom
from sandbox import all_exercises

from manifest import Exercise
from reset import stub_of

_CONSTANTS = {"double": ("1", "0"), "int": ("1",), "std::size_t": ("1",)}
# Calls of one function that are tried for one exercise: first those with few constants, and in order. Six of each, 196
# calls, gave no marks either.
_MOST = 2
# A call of these is the right answer, and they may not be called; see grading/reference.py.
_HIDDEN = {("drift", "kick")}


@dataclass(frozen=True)
class Function:
    """A function of the course as its stub declares it."""

    exercise: Exercise
    stub: str
    returns: str
    parameters: tuple[tuple[str, str], ...]  # type and name
    body: tuple[int, int]  # where it begins and ends in the stub


def functions() -> list[Function]:
    return [_read(exercise) for exercise in all_exercises()]


def _read(exercise: Exercise) -> Function:
    stub = stub_of(exercise).decode("utf-8")
    found = re.search(rf"^([\w:<>, ]+) {exercise.function}\((.*?)\) \{{(.*?)^\}}$", stub, re.MULTILINE | re.DOTALL)
    parts = (part.rsplit(" ", 1) for part in _split(" ".join(found[2].split())))
    return Function(exercise, stub, _plain(found[1]), tuple((type_, name) for type_, name in parts), found.span(3))


def _split(parameters: str) -> list[str]:
    """Splits at the commas that stand in no <>."""
    return re.split(r", (?![^<]*>)", parameters)


def _plain(type_: str) -> str:
    """Returns a type without const and reference, for point masses and rigid bodies alike."""
    return re.sub(r"<[36]>", "<Dof>", re.sub(r"\bconst |&", "", type_)).strip()


def calls(later: Function, earlier: Function) -> list[str]:
    """Returns the calls of the earlier function with the later one's parameters, each used once, and with constants."""
    if later.returns != earlier.returns:
        return []
    choices = []
    for wanted, _ in earlier.parameters:
        names = [name for has, name in later.parameters if _plain(has) == _plain(wanted)
                 and ("const" in wanted or "&" not in wanted or "const" not in has)]
        constants = () if "&" in wanted and "const" not in wanted else _CONSTANTS.get(_plain(wanted), ())
        choices.append([*names, *constants])
    every = {words for words in itertools.product(*choices)
             if len(named := [word for word in words if not word.isdecimal()]) == len(set(named)) > 0}
    order = [name for _, name in later.parameters]

    def how_far_fetched(words: tuple[str, ...]) -> tuple:
        places = [order.index(word) for word in words if word in order]
        return len(words) - len(places), places != sorted(places), words

    most = None if (later.exercise.function, earlier.exercise.function) in _HIDDEN else _MOST
    return [f"spook::{earlier.exercise.function}({', '.join(words)})"
            for words in sorted(every, key=how_far_fetched)[:most]]


def answer(later: Function, earlier: Function, call: str) -> str:
    """Returns a file that answers by the call alone."""
    begin, end = later.body
    header = re.search(r'^#include "\d\d_.*"$', earlier.stub, re.MULTILINE)[0]
    return f"{header}\n{later.stub[:begin]}\n  return {call};\n{later.stub[end:]}".replace(
        '#include "common/not_implemented.hpp"\n', "")


class GradeEarlier(unittest.TestCase):
    def test_no_call_of_an_earlier_function_is_an_answer(self):
        room = Classroom()
        self.addCleanup(room.close)
        tried, known = {}, functions()
        for k, later in enumerate(known):
            for earlier in known[:k]:
                for number, call in enumerate(calls(later, earlier)):
                    name = f"{later.exercise.function} by {earlier.exercise.function} {number}"
                    file = {later.exercise.file.name: answer(later, earlier, call)}
                    room.hand_in(name, file, later.exercise.folder)
                    tried[name] = later.exercise.function, earlier.exercise.function, call
        self.assertGreater(len(tried), 80)
        marks = room.grade(chapters="1-14", seconds=10)
        for name, (later, earlier, call) in tried.items():
            with self.subTest(f"{later} is {call}"):
                self.assertEqual(marks.result(name)["score"], 0)
                compiles = not any(said.startswith("does not compile") for said in marks.verdicts(name, later))
                self.assertEqual(compiles, (later, earlier) not in _HIDDEN, marks.report(name)[:2000])


if __name__ == "__main__":
    unittest.main()
