"""A class of 120, drawn from right and broken answers: each mark, also after an interruption, in shards, and
again."""

import random
import resource
import signal
import subprocess
import time
import unittest
from pathlib import Path

from classroom import SECONDS_A_TEST, Classroom, Marks, beginning_with, make_up, right, run_course
from sandbox import ROOT, all_exercises

from grading.merge import write_delivery

CLASS = 120
SEED = 20  # of the draw
FUNCTIONS = [exercise.function for exercise in all_exercises() if exercise.chapter == 1]


def answers(function: str) -> dict[str, tuple[str | None, str]]:
    """Returns sources (None: not handed in) and the verdict that every test of the exercise must get."""
    text = right(function)
    found = {
        "right": (text, "passed"),
        "right by components": (right(function, "components"), "passed"),
        "right in folds": (right(function, "folded"), "passed"),
        "right with Windows' line ends": (text.replace("\n", "\r\n"), "passed"),
        "right with a byte order mark": ("\ufeff" + text, "passed"),
        "missing": (None, "not started: file missing"),
        "stub": ('#include "common/not_implemented.hpp"\n' + beginning_with('not_implemented("");', function),
                 "not started"),
        "no semicolon": (beginning_with("int i = 0", function), "does not compile"),
        "throws": (beginning_with("throw 42;", function), "failed"),
        "exits": (beginning_with("std::exit(0);", function, "cstdlib"), "ended early: exit code 0"),
        "traps": (beginning_with("__builtin_trap();", function), "crashed: SIGILL"),
        "floods": (beginning_with('for (;;) std::puts("forever and ever");', function, "cstdio"), "too much output"),
        "hogs": (beginning_with("throw std::bad_alloc();", function, "new"), "out of memory"),
        "forks": (beginning_with("fork();", function, "unistd.h"), "tampered: calls fork()"),
    }
    if function != FUNCTIONS[0]:  # the other kinds end alike for every function
        return {kind: found[kind] for kind in ("right", "right in folds", "missing", "stub", "throws")}
    # Each of its tests takes the whole time limit.
    found["loops"] = (beginning_with("for (volatile int i = 0;; i = 1 - i) {}", function), "timed out: looped")
    return found


class GradeClass(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = Classroom()
        cls.addClassCleanup(cls.room.close)
        draw = random.Random(SEED)
        known = {function: answers(function) for function in FUNCTIONS}
        cls.expected: dict[str, dict[str, str]] = {}
        for number in range(CLASS):
            name = f"student {number:03d} Åsa Öberg" if number % 7 == 0 else f"s{number:03d}"
            sources, cls.expected[name] = {}, {}
            for function in FUNCTIONS:
                kinds = list(known[function])
                kind = kinds[0] if draw.random() < 0.5 else draw.choice(kinds)
                source, cls.expected[name][function] = known[function][kind]
                if source is not None:
                    sources[f"{function}.cpp"] = source
            cls.room.hand_in(name, sources)
        cls.marks = cls.room.grade()

    def test_each_has_the_right_mark(self):
        for name, functions in self.expected.items():
            result = self.marks.result(name)
            points = 0
            for exercise in result["exercises"]:
                expected = functions[exercise["function"]]
                for verdict in self.marks.verdicts(name, exercise["function"]):
                    self.assertEqual(verdict, expected, f"{name}: {exercise['function']} (drawn with seed {SEED})")
                points += exercise["max_score"] if expected == "passed" else 0
            self.assertEqual(result["score"], points, name)

    def test_the_grades_are_a_row_each(self):
        rows = (self.marks.folder / "grades.csv").read_text(encoding="utf-8").splitlines()[1:]
        self.assertEqual([row.split(",")[0] for row in rows], sorted(self.expected))
        for row in rows:
            name, score = row.split(",")[:2]
            self.assertEqual(float(score), self.marks.result(name)["score"])

    def test_once_more_gives_the_same_bytes(self):
        again = self.room.grade(out="again")
        self.assert_same(self.marks, again)

    def test_shards_merged_are_the_whole(self):
        for part in (1, 2, 3):
            self.room.grade(self.room.handed_in, "--shard", f"{part}/3", out=f"shard {part}")
        parts = [self.room.root / f"shard {part}" for part in (1, 2, 3)]
        merged = self.room.run("--merge", *parts, "--out", self.room.root / "merged")
        self.assertEqual(merged.returncode, 0, merged.stderr)
        self.assert_same(self.marks, Marks(self.room.root / "merged"))

    def test_interrupted_it_keeps_what_is_done_and_goes_on(self):
        folder = self.room.root / "interrupted"
        command = [str(ROOT / "course"), "grade", str(self.room.handed_in), "--chapters", "1", "--time-limit",
                   str(SECONDS_A_TEST), "--out", str(folder), "--seed", "5"]  # another seed: nothing is known yet
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True)
        while process.poll() is None and not list(folder.glob("submissions/*/report.md")):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=120)
        self.assertNotIn(b"Traceback", said)
        self.assertEqual(process.returncode, 130)
        done = list(folder.glob("submissions/*/results.json"))
        self.assertTrue(0 < len(done) < CLASS)
        self.assertEqual([], list(folder.glob("submissions/*/*.part")))

    def test_it_needs_little_memory(self):
        """The grader itself, for a class of 120; what it runs has limits of its own."""
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024, 512 << 20)

    def assert_same(self, first: Marks, second: Marks):
        files = sorted(path.relative_to(first.folder) for path in first.folder.rglob("*") if path.is_file())
        self.assertEqual(files, sorted(path.relative_to(second.folder) for path in second.folder.rglob("*")
                                       if path.is_file()))
        for file in files:
            self.assertEqual((first.folder / file).read_bytes(), (second.folder / file).read_bytes(), file)


class Merged(unittest.TestCase):
    """Folders of results that were not graded, but written as the grader does."""

    def setUp(self):
        self.room = Classroom()
        self.addCleanup(self.room.close)

    def shard(self, number: int, count: int, *names: str) -> Path:
        folder = self.room.root / f"sh{number}"
        write_delivery(folder, list(names), [], (number, count))
        for name in names[number - 1::count]:
            make_up(folder, name, 2)
        return folder

    def merge(self, *folders: Path, out: Path) -> subprocess.CompletedProcess:
        return self.room.run("--merge", *folders, "--out", out)

    def test_who_is_gone_leaves_the_merged_results(self):
        first, second, out = self.shard(1, 2, "ann", "bo"), self.shard(2, 2, "ann", "bo"), self.room.root / "M"
        make_up(out, "gone", 2)
        make_up(out, "ann", 0)
        (out / "submissions" / "ann" / "taken" / "old.cpp").write_text("old")
        run = self.merge(first, second, out=out)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("gone: graded before, and not among these results", run.stdout)
        self.assertEqual(sorted(path.name for path in (out / "submissions").iterdir()), ["ann", "bo"])
        self.assertTrue((out / "no longer handed in" / "gone" / "results.json").exists())
        self.assertEqual(list((out / "submissions" / "ann" / "taken").iterdir()), [])
        exported = run_course("export", "csv", out, cwd=self.room.root)
        self.assertEqual({line.split(",")[0] for line in exported.stdout.splitlines()[1:]}, {"ann", "bo"}, exported.stderr)

    def test_a_shard_stays_missing_until_it_is_merged(self):
        """Also if the others were merged before, into one of their own folders."""
        names = ("ann", "bo", "cy")
        first, out = self.shard(1, 3, *names), self.room.root / "M"
        for folders, target, said in (((first, first), first, "the shards 2/3, 3/3 of this grading are missing"),
                                      ((first,), out, "the shards 2/3, 3/3 of this grading are missing"),
                                      ((out, self.shard(3, 3, *names)), out, "shard 2/3 of this grading is missing")):
            run = self.merge(*folders, out=target)
            self.assertEqual(run.returncode, 1, run.stdout)
            self.assertIn(said, run.stderr)
            self.assertIn("bo: its shard is not done: 2/3", run.stdout)
        run = self.merge(out, self.shard(2, 3, *names), out=out)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(self.merge(out, out=out).returncode, 0)


if __name__ == "__main__":
    unittest.main()
