"""Messages of ./course check about answers with a data race, and about a machine without ThreadSanitizer."""

import tempfile
import unittest
from pathlib import Path
from unittest import mock

from sandbox import Sandbox, all_exercises

import races
from tree import Built

REPORT = """\
==================
WARNING: ThreadSanitizer: data race (pid=7)
  Write of size 8 at 0x7ffc by thread T1:
    #0 operator() /course/chapters/14_fast_rows/solve_in_colours.cpp:{first} (race_solve_in_colours+0x1)
    #1 operator() /course/tests/races/solve_in_colours.cpp:30 (race_solve_in_colours+0x2)

  Previous read of size 8 at 0x7ffc by main thread:
    #0 {inside}operator() /course/chapters/14_fast_rows/solve_in_colours.cpp:{second} (race_solve_in_colours+0x3)
    #1 main /course/tests/races/solve_in_colours.cpp:50 (race_solve_in_colours+0x4)

  Location is stack of main thread.
"""
UPDATE = "update_pack<6> /course/tests/races/solve_in_colours.cpp:18 (race_solve_in_colours+0x5)\n    #1 "


class Races(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.exercise = next(one for one in all_exercises() if one.function == "solve_in_colours")

    def explained(self, inside: str = "") -> list[str]:
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder, "solve_in_colours.cpp")
            source.write_text("one;\n  two = 2;\nthree;\n")
            with mock.patch("races.shown", return_value="solve_in_colours.cpp"), \
                 mock.patch.object(type(self.exercise), "source", return_value=source.read_text()):
                said = REPORT.format(first=2, second=3, inside=inside)
                return races.explained("printed\n" + said, self.exercise).splitlines()

    def test_both_lines_are_shown(self):
        self.assertEqual(self.explained()[1:5], ["solve_in_colours.cpp:2 writes it", "    two = 2;",
                                                 "solve_in_colours.cpp:3 reads it", "    three;"])

    def test_a_shared_number_is_told_from_a_shared_pack(self):
        self.assertIn("the largest change into one variable", self.explained()[5])
        self.assertIn("Is a pack given to two threads?", self.explained(inside=UPDATE)[5])

    def test_where_it_does_not_link(self):
        class Without:
            def build(self, targets, what):
                return Built(True, "")

            def program(self, target):
                return Path("/nowhere", target)

        found = races.races_of(Without(), self.exercise)
        self.assertEqual((found.found, found.skipped),
                         ("", "No look for data races: ThreadSanitizer does not link here."))
        self.assertEqual(races.races_of(Without(), all_exercises()[0]), races.Races())

    def test_where_addresses_are_chosen_too_freely(self):
        """Then the sanitizer runs where setarch turns that off, which is not allowed everywhere."""
        fatal = "echo 'FATAL: ThreadSanitizer: unexpected memory mapping'; exit 66"
        for line, begins in ((f"grep -q '4....$' /proc/self/personality || {{ {fatal}; }}; echo looked", "looked"),
                             (fatal, "FATAL: "), ("echo 'looked at once'", "looked at once")):
            with self.subTest(begins), tempfile.TemporaryDirectory() as folder:
                program = Path(folder, "program")
                program.write_text(f"#!/bin/sh\n{line}\n")
                program.chmod(0o755)
                said = races.watched(program)
                if "Operation not permitted" in said:
                    self.skipTest("setarch -R is not allowed here")
                self.assertTrue(said.startswith(begins), said)


class Checked(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox(built=True)
        cls.addClassCleanup(cls.box.close)
        cls.exercise = next(one for one in all_exercises() if one.function == "solve_in_colours")
        cls.right = cls.exercise.reference.read_text(encoding="utf-8")

    def check(self, *changes: tuple[str, str], code: int) -> str:
        text = self.right
        for old, new in changes:
            self.assertEqual(text.count(old), 1, old)
            text = text.replace(old, new)
        self.box.file(self.exercise).write_text(text, encoding="utf-8")
        result = self.box.course("check", "14.5")
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        if "ThreadSanitizer does not" in result.stdout:
            self.skipTest("ThreadSanitizer does not work here")
        return " ".join(result.stdout.split())

    def test_a_right_answer_has_none(self):
        said = self.check(code=0)
        self.assertIn("14.5 solve_in_colours is done", said)
        self.assertNotIn("ThreadSanitizer", said)

    def test_a_number_that_threads_share(self):
        # It is written once more, and never read: no test can see it.
        said = self.check(("  std::size_t now = 0;", "  double last = 0;\n  std::size_t now = 0;"),
                          ("    largest[thread] = most;", "    largest[thread] = most;\n    last = most;"),
                          ("  in_rounds(threads, share, next);", "  in_rounds(threads, share, next);\n  (void)last;"),
                          code=1)
        self.assertIn("14.5 solve_in_colours is wrong: has a data race (1 of ", said)
        self.assertRegex(said, r"chapters/14_fast_rows/solve_in_colours\.cpp:\d+ writes it last = most;")
        self.assertIn("Do all threads write the largest change into one variable?", said)

    def test_a_pack_in_two_shares(self):
        said = self.check(("end = n * (thread + 1) / threads;", "end = std::min(n, n * (thread + 1) / threads + 1);"),
                          code=1)
        self.assertIn("has a data race", said)
        self.assertIn("Is a pack given to two threads?", said)
        self.assertIn("SolveInColours.IsTheSameOnAnyNumberOfThreads fails, too", said)


if __name__ == "__main__":
    unittest.main()
