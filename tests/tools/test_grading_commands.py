"""The commands in pages that grade and export, as printed: they grade a class and export its marks."""

import contextlib
import csv
import shutil
import tempfile
import unittest
from pathlib import Path

from classroom import closed_to_others, isolation, run_course
from page_commands import commands, words_of
from sandbox import ROOT

from manifest import all_exercises

_EXAM = """
#include "01_leapfrog/leapfrog.hpp"
#include "exercise_test.hpp"
namespace spook::testing {
EXERCISE(Kick, "1.1 kick");
EXERCISE_TEST(Kick, HoldsForSevens) {
  expect_near("sevens", "Eq. (1.3)", kick(Vec3::Zero(), Vec3::Constant(7), 1, 1).x(), 7, {1e-14, "2 roundings"});
}
}
"""
_GRADING = ROOT / "tools" / "course" / "grading" / "README.md"


class Grading(unittest.TestCase):
    """README's commands for an instructor, and all others that grade or export, each in this order."""

    @classmethod
    def setUpClass(cls):
        if isolation() == "uid":
            closed = contextlib.ExitStack()
            cls.addClassCleanup(closed.close)
            closed.enter_context(closed_to_others())
        folder = tempfile.TemporaryDirectory(prefix="readme-")
        cls.addClassCleanup(folder.cleanup)
        cls.here = Path(folder.name).resolve() / "course"  # some write beside it
        cls.here.mkdir()
        for name, chapters in (("ada", range(1, 6)), ("bob", range(1, 3))):
            for exercise in all_exercises():
                if exercise.chapter in chapters:
                    file = cls.here / "submissions" / name / "chapters" / exercise.folder / exercise.file.name
                    file.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copyfile(exercise.reference, file)
        # Right, but for its cost: it copies all velocities for each row.
        residual = cls.here / "submissions" / "ada" / "chapters" / "04_gauss_seidel" / "residual.cpp"
        slow = cls.here / "submissions" / "eve" / "residual.cpp"
        slow.parent.mkdir()
        body = "for (const Row<Dof>& row : rows) {"
        text = residual.read_text(encoding="utf-8")
        slow.write_text(text.replace(body, body + "\n    const std::vector<Twist<Dof>> copy = V;")
                        .replace("V[row.", "copy[row."), encoding="utf-8")
        for hidden in ("exam", "DIR"):
            test = cls.here / hidden / "01_leapfrog" / "exam_test.cpp"
            test.parent.mkdir(parents=True)
            test.write_text(_EXAM)
        (cls.here / "gradebook.csv").write_text(
            "Student,ID,SIS Login ID,Section,Chapter 5 (4711)\nPoints Possible,,,,100\nAda,1,ada,A,\nBob,2,bob,A,\n")
        (cls.here / "worksheet.csv").write_text(
            "Identifier,Full name,Email address,Status,Grade,Maximum Grade\n"
            "Participant 1,ada,ada@x.org,Submitted,,100\nParticipant 2,bob,bob@x.org,Submitted,,100\n")

    def test_what_the_pages_print(self):
        lines = [line for page in (ROOT / "README.md", _GRADING) for line in commands(page)
                 if words_of(line)[:1] in (["grade"], ["export"])]
        self.assertGreater(len(lines), 8)
        for line in lines:
            with self.subTest(line=line):
                run = run_course(*words_of(line), cwd=self.here)
                self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        with (self.here / "marks" / "grades.csv").open(encoding="utf-8", newline="") as file:
            marks = {row["submission"]: float(row["score"]) / float(row["max_score"]) for row in csv.DictReader(file)}
        self.assertEqual(marks["ada"], 1)
        self.assertEqual(marks["eve"], 0)
        report = (self.here / "marks" / "submissions" / "eve" / "report.md").read_text(encoding="utf-8")
        self.assertIn("quadratic", report)
        self.assertTrue(0 < marks["bob"] < 1, marks)
        self.assertIn("ada", (self.here / "import.csv").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
