"""The table of weights is complete, and has a title for each test."""

import tempfile
import unittest
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from classroom import run_course
from sandbox import ROOT, all_exercises

from grading.choices import TABLE
from grading.weights import first_draft, read_rows
from grading.workshop import build_tests, idle_tests, listed_tests, test_program
from manifest import read_chapters
from pick import pick_list


class Weights(unittest.TestCase):
    def test_the_table_has_a_row_for_every_test_and_no_other(self):
        """If not: ./course export weights --out tests/weights.csv, and look at what is new."""
        run = run_course("export", "weights", cwd=ROOT)
        self.assertEqual(run.returncode, 0, run.stderr)
        present = TABLE.read_text(encoding="utf-8")
        changed = sorted(set(run.stdout.splitlines()) ^ set(present.splitlines()))
        if run.stdout != present:
            self.fail("\n".join(["rows that are new, gone or elsewhere:", *changed]))

    def test_the_rows_of_some_exercises(self):
        """In the same words, and without another exercise's."""
        run = run_course("export", "weights", "--chapters", "1.2,3.1-3.2", cwd=ROOT)
        self.assertEqual(run.returncode, 0, run.stderr)
        header, *rows = TABLE.read_text(encoding="utf-8").splitlines()
        suites = {exercise.suite for exercise in pick_list("1.2,3.1,3.2")}
        self.assertEqual(run.stdout.splitlines(), [header, *(row for row in rows if row.partition(".")[0] in suites)])

    def test_every_exercise_has_points_and_every_hint_exists(self):
        rows = read_rows(TABLE).values()
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
                         "no row of tests/weights.csv gives these any points")

    def test_what_an_idle_function_passes_has_no_points(self):
        """And all else has some: those who write nothing have nothing."""
        rows = read_rows(TABLE)
        chapters = read_chapters()
        build_tests(chapters)
        with ThreadPoolExecutor(2) as pool:
            idle = set().union(*pool.map(lambda one: idle_tests(test_program(one), listed_tests(one)), chapters))
        self.assertGreater(len(idle), 20)
        self.assertEqual({test for test, row in rows.items() if row.points == 0}, idle)

    def test_a_table_that_a_spreadsheet_has_saved(self):
        """With a byte order mark before its first title."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "weights.csv")
            file.write_text(TABLE.read_text(encoding="utf-8"), encoding="utf-8-sig")
            self.assertEqual(file.read_bytes()[:3], b"\xef\xbb\xbf")
            self.assertEqual(read_rows(file), read_rows(TABLE))

    def test_a_first_draft_takes_the_words_of_the_name(self):
        kick = next(exercise for exercise in all_exercises() if exercise.function == "kick")
        for test, title in (("Kick.AddsForceOverMass", "Adds force over mass"),
                            ("Kick.KeepsEnergyFor1e5Steps", "Keeps energy for 1e5 steps"),
                            ("Kick.IsGMInvGT", "Is GM inv GT")):
            self.assertEqual(first_draft(test, kick).title, title)


if __name__ == "__main__":
    unittest.main()
