"""Mutants are changes whose lines occur exactly once in the reference; others are refused."""

import sys
import tempfile
import unittest
from pathlib import Path

from sandbox import TOOLS, CourseError

sys.path.insert(0, str(TOOLS / "mutants"))

from changes import read_changes  # noqa: E402

REFERENCE = """\
#include "f.hpp"

namespace spook {

double f(double x) {
  // The half first.
  x = x / 2;  // Eq. (1.1)
  if (x < 0) {
    x = -x;
  }

  x += 1;
  if (x > 9) {
    x = 9;
  }
  return x;
}

}  // namespace spook
"""
HALF = '@@ half @@ halves\ntwice. Killed by F.Halves, which says "half of it"\n'


class Changes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.reference, self.file = self.folder / "f.cpp", self.folder / "f.diff"
        self.reference.write_text(REFERENCE)

    def read(self, text: str):
        self.file.write_text(text)
        return read_changes(self.file, self.reference)

    def mutated(self, *changes: str) -> str:
        return "".join(f"{line.text}\n" for line in self.read(HALF + "\n".join(changes))[0].lines)

    def assert_refused(self, text: str, line: int, reason: str):
        with self.assertRaises(CourseError) as caught:
            self.read(text)
        self.assertIn(f"f.diff:{line}: {reason}", str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def test_what_a_mutant_says_of_itself(self):
        half, third = self.read(f"# 1.1 f\n\n{HALF}-x += 1;\n\n"
                                '@@ third @@ Killed by it? Killed by F.Adds, which says "a "third""\n-x += 1;\n')
        self.assertEqual((half.name, half.about, half.test, half.says, half.line),
                         ("half", "halves twice.", "F.Halves", "half of it", 3))
        self.assertEqual((third.name, third.about, third.says), ("third", "Killed by it?", 'a "third"'))

    def test_lines_go_and_come(self):
        self.assertEqual(self.mutated("-  x = x / 2;", "+  x = x / 4;"),
                         REFERENCE.replace("x / 2;  // Eq. (1.1)", "x / 4;"))
        self.assertEqual(self.mutated("-  return x;"), REFERENCE.replace("  return x;\n", ""))

    def test_indentation_comments_and_empty_lines_do_not_count(self):
        self.assertEqual(self.mutated("-}", " x += 1;  // one more"),
                         REFERENCE.replace("  }\n\n  x += 1", "\n  x += 1"))

    def test_new_lines_stand_beside_those_that_stay(self):
        self.assertEqual(self.mutated("   x += 1;", "+  x += 2;"),
                         REFERENCE.replace("  x += 1;\n", "  x += 1;\n  x += 2;\n"))
        self.assertEqual(self.mutated("+  x += 2;", "   x += 1;"),
                         REFERENCE.replace("  x += 1;\n", "  x += 2;\n  x += 1;\n"))

    def test_several_changes(self):
        self.assertEqual(self.mutated("-x = 9;", "+x = 8;", "", "-x += 1;", "+x += 3;"),
                         REFERENCE.replace("    x = 9;", "x = 8;").replace("  x += 1;", "x += 3;"))

    def test_what_it_includes_stands_at_the_top(self):
        expected = "#include <cmath>\n" + REFERENCE.replace("  x += 1;\n", "")
        self.assertEqual(self.mutated("+#include <cmath>", "-x += 1;"), expected)
        self.assertEqual(self.mutated("+#include <cmath>", "", "-x += 1;"), expected)

    def test_lines_that_are_not_in_the_reference(self):
        self.assert_refused(HALF + " return x;\n-x += 2;\n", 4, f"half: this is not in {self.reference}: x += 2;")
        self.assert_refused(HALF + "-x = x / 2;\n x += 1;\n", 3,
                            f"half: in {self.reference} these lines do not follow one another")

    def test_lines_that_are_there_more_than_once(self):
        self.assert_refused(HALF + "-x += 1;\n\n+x += 2;\n-}\n", 6, f"half: this is 4 times in {self.reference}, "
                            "at lines 10, 15, 17, 19: say what stays beside it")

    def test_a_change_without_a_place(self):
        self.assert_refused(HALF + "+x = 0;\n\n-x += 1;\n", 3, "half: a change needs a line of the reference")

    def test_a_right_answer_promises_no_failure(self):
        half, odd = self.read(HALF + "-x += 1;\n\n@@ odd @@ adds twice.\nPasses every test.\n-x += 1;\n+x += 0.5 + 0.5;\n")
        self.assertEqual((half.is_right, odd.is_right, odd.about, odd.test), (False, True, "adds twice.", ""))

    def test_a_line_that_goes_twice(self):
        self.assert_refused(HALF + "-x += 1;\n+x += 2;\n\n-x += 1;\n", 6, "half: this line is gone already")

    def test_a_comment_in_the_lines_of_before(self):
        self.assert_refused(HALF + "-  // The half first.\n", 3, "half: comments do not count")

    def test_what_is_missing_or_is_no_part_of_the_form(self):
        self.assert_refused("x\n" + HALF, 1, "'@@ name @@ what is wrong' must come first")
        self.assert_refused("\n@@ half @@\n", 2, "'@@ name @@ what is wrong' is needed")
        self.assert_refused("@@ half @@ halves.\n-x += 1;\n", 1, "half: 'Killed by Suite.Test, which says")
        self.assert_refused(HALF.replace(", which", ". Says"), 1, "half: 'Killed by Suite.Test, which says")
        self.assert_refused(HALF.replace("half of it", ""), 1, "half: 'Killed by Suite.Test, which says")
        self.assert_refused(HALF, 1, "half: it has no change")
        self.assert_refused(HALF + "-x += 1;\nx += 2;\n", 4, "half: a line of a change begins with")

    def test_a_changed_line_of_the_reference_breaks_the_mutants_of_that_line_only(self):
        mutants = {7: "-x = x / 2;", 9: "-x = -x;", 12: " x += 1;\n+x += 2;", 14: "-x = 9;\n+x = 8;"}
        lines = REFERENCE.splitlines()
        for k, line in enumerate(lines, 1):
            self.reference.write_text("\n".join([*lines[:k - 1], line and f"g();  {line}", *lines[k:]]))
            broken = []
            for number, change in mutants.items():
                try:
                    self.read(HALF + change)
                except CourseError:
                    broken.append(number)
            self.assertEqual(broken, [k] if k in mutants else [], line)

    def test_the_compiler_is_told_where_the_lines_are(self):
        lines = self.read(HALF + "-x += 1;\n+x += 2;\n")[0].source().splitlines()
        self.assertEqual(lines[3:5], [f'#line 4 "{self.reference}"', ""])
        place = lines.index(f'#line 4 "{self.file}"')
        self.assertEqual(lines[place + 1:place + 3], ["x += 2;", f'#line 13 "{self.reference}"'])


if __name__ == "__main__":
    unittest.main()
