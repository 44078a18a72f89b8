"""The table of weights lists what differs from the default, and with it each test has points, a hint and a title."""

import io
import tempfile
import unittest
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from classroom import run_course
from sandbox import ROOT, all_exercises

from errors import BadInput
from grading.choices import TABLE
from grading.weights import Weight, Weights, as_table, default_weight, defaults, read_rows
from grading.workshop import build_tests, idle_tests, listed_tests, test_program
from manifest import read_chapters
from pick import pick_list


def _weights() -> dict[str, Weight]:
    """Returns the weights of all tests."""
    return defaults(all_exercises()) | read_rows(TABLE)


class TableOfWeights(unittest.TestCase):
    def test_the_table_has_the_rows_that_differ_from_the_default_and_no_other(self):
        rows, own = read_rows(TABLE), defaults(all_exercises())
        text = io.StringIO()
        as_table([rows[test] for test in own if rows.get(test, own[test]) != own[test]], text)
        present = TABLE.read_text(encoding="utf-8")
        surplus = sorted(set(present.splitlines()) - set(text.getvalue().splitlines()))
        if text.getvalue() != present:
            self.fail("\n".join(["rows that repeat the default, are of no test or written in another way; if none is "
                                 "named, their order is not that of the tests:", *surplus]))

    def test_a_table_of_some_exercises(self):
        """It has a row for each of their tests."""
        run = run_course("export", "weights", "--chapters", "1.2,3.1-3.2", cwd=ROOT)
        self.assertEqual(run.returncode, 0, run.stderr)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "points.csv")
            file.write_text(run.stdout, encoding="utf-8")
            rows = read_rows(file)
        self.assertEqual(list(rows), [test for exercise in pick_list("1.2,3.1,3.2") for test in exercise.tests()])
        self.assertLessEqual(rows.items(), _weights().items())

    def test_a_test_without_a_row_has_the_default(self):
        """A hidden one is hidden, and has no points if an idle function passes it."""
        kick = all_exercises()[0]
        own = Weight("Kick.AddsMore", 3.0, "visible", "1.1/2", "More")
        expected = dict.fromkeys((own.test, "Kick.KeepsANaN", "Kick.IsOurs", "Kick.IsIdle"), kick)
        weights = Weights({own.test: own})
        weights.check(expected, hidden={"Kick.IsOurs", "Kick.IsIdle"}, idle={"Kick.IsIdle", "Kick.KeepsANaN"})
        self.assertEqual([weights.of(test) for test in expected],
                         [own, Weight("Kick.KeepsANaN", 1.0, "visible", "1.1/1", "Keeps a NaN"),
                          Weight("Kick.IsOurs", 1.0, "hidden", "1.1/1", "Is ours"),
                          Weight("Kick.IsIdle", 0.0, "hidden", "1.1/1", "Is idle")])

    def test_a_row_of_no_test_is_refused(self):
        kick = all_exercises()[0]
        for test in ("Kick.AddsForceOverMas", "Kcik.AddsForceOverMass"):
            weights = Weights({test: default_weight(test, kick)})
            told = f"{test}, which is not a test; did you mean Kick.AddsForceOverMass\\?"
            with self.assertRaisesRegex(BadInput, told):
                weights.check({"Kick.AddsForceOverMass": kick}, set(), set())

    def test_every_exercise_has_points_and_every_hint_exists(self):
        rows = _weights().values()
        points = Counter()
        hints = {f"{exercise.id}/{number}" for exercise in all_exercises()
                 for number in range(1, len(exercise.hints) + 1)}
        suites = {exercise.suite: exercise for exercise in all_exercises()}
        for row in rows:
            exercise = suites[row.test.partition(".")[0]]
            points[exercise.id] += row.points
            self.assertIn(row.hint, hints, row.test)
            self.assertTrue(row.hint.startswith(f"{exercise.id}/"), row.test)
            self.assertTrue(row.title[0].isupper() or not row.title[0].isalpha(), row.title)
        self.assertEqual([exercise.id for exercise in all_exercises() if not points[exercise.id] > 0], [],
                         "no test of these has points")

    def test_what_an_idle_function_passes_has_no_points(self):
        """And all else has some: those who write nothing have nothing."""
        rows = _weights()
        chapters = read_chapters()
        build_tests(chapters)
        self.assertEqual(sorted(test for chapter in chapters for test in listed_tests(chapter)), sorted(rows))
        with ThreadPoolExecutor(2) as pool:
            idle = set().union(*pool.map(lambda one: idle_tests(test_program(one), listed_tests(one)), chapters))
        self.assertGreater(len(idle), 20)
        self.assertEqual({test for test, row in rows.items() if row.points == 0}, idle,
                         "tests/weights.csv needs rows for these, of 0 points for a test that an idle function passes")

    def test_a_table_that_a_spreadsheet_has_saved(self):
        """With a byte order mark before its first title."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "weights.csv")
            file.write_text(TABLE.read_text(encoding="utf-8"), encoding="utf-8-sig")
            self.assertEqual(file.read_bytes()[:3], b"\xef\xbb\xbf")
            self.assertEqual(read_rows(file), read_rows(TABLE))

    def test_the_default_title_is_the_words_of_the_name(self):
        kick = all_exercises()[0]
        for test, title in (("Kick.AddsForceOverMass", "Adds force over mass"),
                            ("Kick.KeepsEnergyFor1e5Steps", "Keeps energy for 1e5 steps"),
                            ("Kick.HasNoNaNInside", "Has no NaN inside"),
                            ("Kick.IsGMInvGT", "Is GM inv GT")):
            self.assertEqual(default_weight(test, kick).title, title)


if __name__ == "__main__":
    unittest.main()
