"""The grader on a collection of right, broken and cheating answers."""

import platform
import unittest
from pathlib import Path

from classroom import Classroom, beginning_with, corpus, right
from sandbox import all_exercises


class GradeCorpus(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = Classroom()
        cls.addClassCleanup(cls.room.close)
        for name, (file, _) in corpus().items():
            cls.room.hand_in(name, {"kick.cpp": file.read_bytes()})
        cls.functions = [exercise.function for exercise in all_exercises() if exercise.chapter == 1]
        for style in ("reference", "components", "folded"):
            cls.room.hand_in(f"style {style}", {f"{name}.cpp": right(name, style) for name in cls.functions})
        cls.room.hand_in("forces from threads", {"leapfrog_step.cpp": "#include <thread>\n" + beginning_with(
            "static bool again = false;\n"
            "  auto ask = [&] { for (int k = 0; k < 99; ++k) force(0, bodies.x); };\n"
            "  if (!again) { std::thread one(ask), other(ask); one.join(); other.join(); }\n"
            "  again = true;", "leapfrog_step")})
        cls.marks = cls.room.grade()

    def test_every_answer_gets_its_verdict(self):
        for name, (_, expected) in corpus().items():
            if name.endswith("_by_hand") and platform.machine() != "x86_64":
                continue  # it calls the kernel in that machine's way
            with self.subTest(name):
                for verdict in self.marks.verdicts(name):
                    self.assertTrue(verdict.startswith(expected), f"{verdict}, and not {expected}")

    def test_right_answers_have_all_points_in_any_style(self):
        for style in ("reference", "components", "folded"):
            result = self.marks.result(f"style {style}")
            self.assertEqual(result["score"], result["max_score"], style)
            self.assertEqual({exercise["state"] for exercise in result["exercises"]}, {"done"})

    def test_threads_may_ask_for_forces_at_once(self):
        self.assertEqual(self.marks.verdicts("forces from threads", "leapfrog_step"), {"passed"})

    def test_an_exercise_counts_when_it_is_right(self):
        for name in corpus():
            for exercise in self.marks.result(name)["exercises"]:
                right = all(test["verdict"] == "passed" for test in exercise["tests"])
                self.assertEqual(exercise["score"], exercise["max_score"] if right else 0, name)
                for test in exercise["tests"]:
                    self.assertEqual(test["score"], test["max_score"] if right else 0)

    def test_what_is_removed_is_said(self):
        for name in ("system_pause", "runs_a_shell"):
            self.assertEqual(self.marks.result(name)["notes"], ["1.1 kick: its call of system() is removed"])

    def test_every_test_that_does_not_pass_says_why(self):
        for name in corpus():
            for exercise in self.marks.result(name)["exercises"]:
                for test in exercise["tests"]:
                    self.assertTrue(test["verdict"] == "passed" or test["message"], f"{name}: {test['name']}")

    def test_the_report_leads_with_the_first_failure(self):
        report = self.marks.report("wrong")
        start = report.partition("## Start here")[2]
        for text in ("### 1.1 kick: failed", "expected", "got       (7, 7, 7)", "tolerance", "Hint: ",
                     "./course check 1.1 --seed 1"):
            self.assertIn(text, start)
        self.assertIn("| · | 1.2 drift | not started |", report)

    def test_what_was_printed_and_what_the_compiler_said_is_in_the_report(self):
        self.assertIn("v is ", self.marks.report("floods"))
        self.assertIn("chapters/01_leapfrog/kick.cpp:", self.marks.report("does_not_compile"))
        self.assertNotIn("/tmp", self.marks.report("does_not_compile"))

    def test_no_file_but_the_submission_is_quoted(self):
        users = [line for line in Path("/etc/passwd").read_text().splitlines() if ":" in line]
        for name in ("claims_to_be_passwd", "has_passwd_assembled", "includes_passwd", "assembles_passwd"):
            for line in users:
                self.assertNotIn(line.partition(":")[2], self.marks.report(name), name)
            self.assertNotIn("root", self.marks.report(name), name)

    def test_the_class_is_counted(self):
        rows = (self.marks.folder / "grades.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(rows), 1 + len(corpus()) + 4)
        counts = (self.marks.folder / "tests.csv").read_text(encoding="utf-8").splitlines()
        header, first = counts[0].split(","), counts[1].split(",")
        self.assertEqual(sum(map(int, first[1:])), len(rows) - 1)
        expected = sum(verdict.startswith("timed out") for _, verdict in corpus().values())
        self.assertEqual(int(first[header.index("timed out")]), expected)
        self.assertTrue((self.marks.folder / "histogram.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("forks: **tampered**", (self.marks.folder / "summary.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
