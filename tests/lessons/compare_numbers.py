"""compare_numbers.py PROGRAM: what the lessons work out, and what they ask for, is what the reference computes.

A lesson marks what it works out with numbers by two comments:

    <!-- numbers: one_row -->  ...  <!-- end of numbers -->

Every number with a decimal point between them, in order, must be the program's next number of that group, to the digits
that the lesson shows. Numbers of equations, (3.10), do not count.
"""

import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("COURSE_SOURCE") or Path(__file__).resolve().parents[2])
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools" / "course"))

from predictions import predictions_of  # noqa: E402
from manifest import read_chapters  # noqa: E402

_MARKED = re.compile(r"<!-- numbers: (\w+) -->(.*?)<!-- end of numbers -->", re.DOTALL)
_EQUATION = re.compile(r"\(\d+\.\d+\)|\\tag\{[^}]*\}")
_NUMBER = re.compile(r"(?<![\w.])-?\d+\.\d+(?!\d|\.\d)")


def marked_numbers(lesson: str) -> list[tuple[str, list[str]]]:
    return [(group, _NUMBER.findall(_EQUATION.sub("", text))) for group, text in _MARKED.findall(lesson)]


def agrees(shown: str, value: float) -> bool:
    """To the digits that are shown."""
    digits = len(shown.partition(".")[2])
    return abs(float(shown) - value) <= 0.5 * 10**-digits * (1 + 1e-6)


class Numbers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([PROGRAM], capture_output=True, text=True, check=True)
        cls.computed: dict[str, list[tuple[str, float]]] = {}
        for line in done.stdout.splitlines():
            name, value = line.split()
            cls.computed.setdefault(name.partition(".")[0], []).append((name, float(value)))

    def test_what_lessons_work_out(self):
        seen = set()
        for lesson in sorted(ROOT.glob("chapters/*/README.md")):
            for group, shown in marked_numbers(lesson.read_text(encoding="utf-8")):
                seen.add(group)
                computed = self.computed.get(group, [])
                with self.subTest(f"{lesson.parent.name}, {group}"):
                    for k, (text, (name, value)) in enumerate(zip(shown, computed)):
                        self.assertTrue(agrees(text, value), f"number {k + 1}, {name}: the lesson has {text}, the code "
                                                             f"{value:.10g}")
                    self.assertEqual(len(shown), len(computed))
        self.assertEqual(seen, {group for group in self.computed if not group.isdecimal()})

    def test_what_lessons_ask_for(self):
        known = {name: value for group in self.computed.values() for name, value in group}
        asked = [each for chapter in read_chapters() for each in predictions_of(chapter)]
        for each in asked:
            if each.code:
                with self.subTest(each.id):
                    self.assertIn(each.code, known)
                    shown = each.answer if "." in each.answer else f"{each.answer}.0"
                    self.assertTrue(agrees(shown, known[each.code]), f"{each.answer}, but {known[each.code]:.10g}")
        unused = {name for name in known if name[0].isdecimal()} - {each.code for each in asked}
        # Two choices that the code answers, too.
        self.assertEqual(unused, {"3.early_3", "3.early_0"})
        self.assertEqual([known["3.early_3"], known["3.early_0"]], [1, 0])
        right = {each.id: each.right for each in asked}
        self.assertEqual([right["3.4"], right["3.5"]], ["a", "b"])


class Marks(unittest.TestCase):
    def test_numbers_are_found(self):
        lesson = ("0.1 <!-- numbers: x -->by (3.10), $a = 18.46$, u = -0.1; 12 \\tag{3.2}\n"
                  "| 0.50 | and 7.25.<!-- end of numbers --> 7.5")
        self.assertEqual(marked_numbers(lesson), [("x", ["18.46", "-0.1", "0.50", "7.25"])])

    def test_digits_that_are_shown_count(self):
        self.assertTrue(agrees("0.25", 0.2469))
        self.assertFalse(agrees("0.24", 0.2469))
        self.assertFalse(agrees("0.250", 0.2469))


if __name__ == "__main__":
    PROGRAM = Path(sys.argv.pop(1)).resolve()
    unittest.main()
