"""The page for instructors: its syllabi add up, and its chapters come after those that they need."""

import re
import unittest
from pathlib import Path

from sandbox import ROOT

from manifest import Exercise, all_exercises, read_chapters
from pick import as_list, pick_list
from syllabus import calls_of, closure, hours_of, needs_of

PAGE = ROOT / "INSTRUCTORS.md"
TESTS = ROOT / "tests"
_ROW = re.compile(r"^\| (\d+|hours) \|([^|]*)\|([^|]*)\|([^|]*)\|$", re.MULTILINE)


def _text_of(folder: Path) -> str:
    return "".join(file.read_text(encoding="utf-8") for file in sorted(folder.glob("*.cpp")))


def _tests_in(folder: Path) -> list[tuple[str, str]]:
    return re.findall(r"^EXERCISE_TEST\((\w+), (\w+)\)", _text_of(folder), re.MULTILINE)


def _calls(exercise: Exercise, other: Exercise) -> bool:
    """Tells whether the reference of an exercise calls the other's function."""
    code = re.sub(r"//.*", "", exercise.reference.read_text(encoding="utf-8"))
    return re.search(rf"(?<![.\w]){other.function}(?:<\w+>)?\(", code) is not None


class Instructors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.chapters = {chapter.number: chapter for chapter in read_chapters()}
        cls.needs = {number: needs_of(chapter) for number, chapter in cls.chapters.items()}
        cls.rows = _ROW.findall(PAGE.read_text(encoding="utf-8"))

    def test_a_chapter_needs_earlier_ones_and_no_reference_calls_a_later(self):
        for number, chapter in self.chapters.items():
            with self.subTest(chapter.folder):
                self.assertTrue(all(one < number for one in self.needs[number] | calls_of(chapter)))
                self.assertEqual(bool(self.needs[number]), number > 1)

    def test_what_the_references_call_is_among_what_the_lessons_need(self):
        """But for steps that go on from the last chapter."""
        beside = {(number, one) for number, chapter in self.chapters.items()
                  for one in calls_of(chapter) - closure(self.needs, number)}
        self.assertEqual(beside, {(9, 6), (9, 7), (8, 7), (7, 6), (6, 5)})

    def test_syllabi_have_their_weeks_in_an_order_that_the_needs_allow(self):
        weeks = [row for row in self.rows if row[0] != "hours"]
        self.assertEqual([row[0] for row in weeks], [str(k) for k in range(1, 15)])
        for column, count in ((1, 7), (2, 10), (3, 14)):
            with self.subTest(weeks=count):
                parts = [row[column].strip() for row in weeks if row[column].strip()]
                self.assertEqual(len(parts), count)
                met: set[int] = set()
                low = high = 0.0
                for part in parts:
                    number, half = int(part[:2]), "half" in part
                    self.assertLessEqual(self.needs[number], met)
                    met.add(number)
                    least, most = hours_of(self.chapters[number])
                    low, high = low + least / (1 + half), high + most / (1 + half)
                self.assertEqual(self.rows[-1][column].strip(), f"{low:g} to {high:g}")

    def test_the_lists_of_the_syllabi_are_their_weeks(self):
        """The halves of chapters, too, by the exercises that the page names for them."""
        text = " ".join(PAGE.read_text(encoding="utf-8").split())
        lists = re.search(r"It is `(\S+)` for seven weeks, `(\S+)` for ten, and `(\S+)` for fourteen", text).groups()
        halves = {"08, first half": "8.1-8.4,8.9-8.12", "08, second half": "8.5-8.8", "11, first half": "11.1-11.4",
                  "11, second half": "11.5-11.11"}
        for column, chosen in enumerate(lists, 1):
            weeks = [row[column].strip() for row in self.rows[:-1] if row[column].strip()]
            wanted = ",".join(halves.get(week, week.lstrip("0")) for week in weeks)
            self.assertEqual(pick_list(chosen), pick_list(wanted))
            self.assertEqual(as_list(pick_list(chosen)), chosen)
        self.assertEqual(len(lists), 3)

    def test_what_may_be_left_out_is_needed_by_no_other_chapter(self):
        """But by those that the page names, and by single exercises whose calls it lists."""
        text = " ".join(PAGE.read_text(encoding="utf-8").split())
        left_out = re.findall(r"leave out (\d\d), unless you teach ((?:\d\d(?: or )?)+)"
                              r"(?:\. Then explain inertia yourself, because (\d\d) needs it)?", text)
        self.assertEqual([number for number, *_ in left_out], ["06", "02"])
        for number, teach, explained in left_out:
            named = {int(one) for one in [*teach.split(" or "), explained] if one}
            self.assertEqual({one for one, needs in self.needs.items() if int(number) in needs}, named, number)
        told = re.search(r"comes from the reference: (.*?)\.(?: |$)", text)[1]
        pairs = set()
        for callers, called in re.findall(r"((?:\d+\.\d+(?:, | and )?)+) calls? ((?:\d+\.\d+(?: and )?)+)", told):
            pairs |= {(one, other) for one in re.findall(r"[\d.]+\d", callers) for other in re.findall(r"[\d.]+\d", called)}
        self.assertEqual(pairs, {(one.id, other.id) for one in all_exercises() for other in all_exercises()
                                 if other.chapter in (2, 6) and one.chapter != other.chapter and _calls(one, other)})

    def test_the_halves_are_all_exercises(self):
        text = " ".join(PAGE.read_text(encoding="utf-8").split())
        self.assertIn("8.1 to 8.4 with 8.9 to 8.12, and the second half is 8.5 to 8.8.", text)
        self.assertIn("11 is 11.1 to 11.4.", text)
        self.assertEqual(len(self.chapters[8].exercises), 12)

    def test_every_exercise_has_hidden_tests_to_start_from(self):
        """Their names differ from those of the chapter's own tests: a name of both would be shown."""
        for chapter in self.chapters.values():
            with self.subTest(chapter.folder):
                hidden, shown = (_tests_in(folder / chapter.folder) for folder in (TESTS / "hidden", TESTS))
                self.assertEqual({suite for suite, _ in hidden}, {exercise.suite for exercise in chapter.exercises})
                self.assertEqual(set(hidden) & set(shown), set())
                self.assertEqual(len(set(hidden)), len(hidden))

    def test_hidden_tests_draw_their_numbers_by_the_seed(self):
        for chapter in self.chapters.values():
            with self.subTest(chapter.folder):
                self.assertIn("Random random;", _text_of(TESTS / "hidden" / chapter.folder))

    def test_its_commands_are_those_of_the_course(self):
        from arguments import parse
        for line in re.findall(r"^\./course (.+?)(?: +#.*)?$", PAGE.read_text(encoding="utf-8"), re.MULTILINE):
            with self.subTest(line):
                parse(line.split())


if __name__ == "__main__":
    unittest.main()
