"""The judge remembers certain verdicts, and runs the two processes of a test on one core."""

import os
import re
import resource
import shutil
import signal
import string
import subprocess
import tempfile
import unittest
import unittest.mock
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

from classroom import CORPUS
from sandbox import all_exercises

from errors import CourseError
from grading.complaints import compiler_says
from grading.confined import Ended, reap, spawn
from grading.grader import Grader
from grading.choices import ISOLATIONS, RULES
from grading.isolation import ENVIRONMENT, User, choose, take_user
from grading.judge import (CRASHED, DOES_NOT_COMPILE, FAILED, NOT_RUN, NOT_STARTED, PASSED, TIMED_OUT, WAITED,
                           ExerciseVerdict, Judge, TestVerdict)
from grading.names import Student
from grading.objects import Made, _not_compiled, _not_linked, _readable, make, options_of
from grading.pair import Ran, _only_on, _take_core, exit_code
from grading.results import score
from grading.submission import Handed, Source, Submission


class Judges(Judge):
    """A judge without tests to run: each new request gets the next given verdict."""

    def __init__(self, memory: Path, verdicts: list[str], forget: bool = False, seeds: dict[str, int] | None = None):
        workshop = SimpleNamespace(build="build", expected_tests=lambda exercise: ["Kick.IsRight"])
        super().__init__(workshop, SimpleNamespace(name="none"), seed=1, seconds=2, of_exercise=10, memory=memory,
                         forget=forget, seeds=seeds)
        self.verdicts = verdicts

    def _judge_anew(self, exercise, source, tests, user):
        return ExerciseVerdict([TestVerdict(tests[0], self.verdicts.pop(0))], []), True


class Remembers(unittest.TestCase):
    def judged(self, is_reference: bool, verdicts: list[str]) -> list[str]:
        exercise = next(iter(all_exercises()))
        with tempfile.TemporaryDirectory() as folder:
            judge = Judges(Path(folder), list(verdicts))
            source = Source("kick.cpp", b"Vec3 kick() {}", is_reference=is_reference)
            return [judge.judge(exercise, source, None).tests[0].verdict for _ in verdicts]

    def test_a_submission_keeps_its_verdict(self):
        self.assertEqual(self.judged(False, [TIMED_OUT, PASSED]), [TIMED_OUT, TIMED_OUT])

    def test_what_is_forgotten_stays_so_for_who_goes_on(self):
        """An interrupted --fresh is resumed without it: what it has judged is remembered, what was older is not."""
        exercise = next(iter(all_exercises()))
        old, new = Source("kick.cpp", b"Vec3 kick() {}"), Source("kick.cpp", b"Vec3 kick() { return {}; }")
        with tempfile.TemporaryDirectory() as folder:
            memory = Path(folder)
            before = Judges(memory, [TIMED_OUT, TIMED_OUT])
            for source in (old, new):
                before.judge(exercise, source, None)
            for file in memory.glob("*.json"):
                os.utime(file, (file.stat().st_mtime - 10,) * 2)
            fresh = Judges(memory, [PASSED], forget=True)
            self.assertEqual(fresh.judge(exercise, old, None).tests[0].verdict, PASSED)
            resumed = Judges(memory, [PASSED])
            self.assertEqual(resumed.judge(exercise, old, None).tests[0].verdict, PASSED)
            self.assertEqual(resumed.judge(exercise, new, None).tests[0].verdict, PASSED)
            self.assertEqual(resumed.verdicts, [])

    def test_another_seed_of_hidden_tests_is_another_verdict(self):
        exercise, source = next(iter(all_exercises())), Source("kick.cpp", b"Vec3 kick() {}")
        with tempfile.TemporaryDirectory() as folder:
            found = [Judges(Path(folder), [verdict], seeds=seeds).judge(exercise, source, None).tests[0].verdict
                     for verdict, seeds in ((PASSED, {}), (FAILED, {"Kick.IsRight": 2}), (CRASHED, {"Kick.IsRight": 1}),
                                            (CRASHED, {"Kick.IsRight": 2}), (FAILED, {"Kick.IsRight": 3}))]
        self.assertEqual(found, [PASSED, FAILED, PASSED, FAILED, FAILED])

    def test_an_empty_file_is_not_started(self):
        """And is not compiled: there are no verdicts to give."""
        exercise = next(iter(all_exercises()))
        with tempfile.TemporaryDirectory() as folder:
            judge = Judges(Path(folder), [])
            for content in (b"", b" \r\n", b"\xef\xbb\xbf// I did not have time.\n", b"/* Vec3 kick() {} */"):
                test, = judge.judge(exercise, Source("kick.cpp", content), None).tests
                self.assertEqual((test.verdict, test.reason), (NOT_STARTED, "file empty"))
                self.assertIn("kick.cpp has no code", test.message)
            self.assertEqual(list(Path(folder).glob("*.json")), [])

    def test_a_reference_that_was_stopped_has_another_try(self):
        self.assertEqual(self.judged(True, [TIMED_OUT, PASSED, TIMED_OUT]), [TIMED_OUT, PASSED, PASSED])


class Waits(unittest.TestCase):
    """A process that the clock has stopped may have waited for a busy machine."""

    def run_all(self, rans: list[Ran], tests: list[str], compiling: float = 0.0, usual: float = 0.0) -> list[str]:
        pairs = []

        class OnePair:
            alive, was_asked = False, True

            def __init__(self, *_, **__):
                pairs.append(self)

            def run(self, test):
                return rans.pop(0)

            def used_since(self):
                return 0.0

        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch("grading.judge.Pair", OnePair):
            judge = Judges(Path(folder), [])
            judge._workshop.test_program = lambda exercise: None
            judge._usual["kick"] = usual
            ran, _ = judge._run_all(next(iter(all_exercises())), tests, Made(Path(), used=compiling), None)
        self.assertEqual((rans, [verdict.test for verdict, _ in ran]), ([], tests))
        return [verdict.reason or verdict.verdict for verdict, _ in ran]

    def test_it_has_a_second_try_once(self):
        passed, waited = Ran((b"0", b"1", b"")), Ran(timed_out=True)
        self.assertEqual(self.run_all([waited, passed, passed], ["a", "b"]), [PASSED, PASSED])
        self.assertEqual(self.run_all([waited, waited], ["a"]), [WAITED])
        self.assertEqual(self.run_all([waited, passed, waited], ["a", "b"]), [PASSED, WAITED])

    def test_a_slow_pass_counts(self):
        """The judge allows 2 s of a test, and 10 s of an exercise; of work 3 s are free, or three times the reference's."""
        def passed(clock: float, used: float) -> Ran:
            return Ran((b"0", b"1", b""), clock=clock, used=used)
        tests = list("abcdef")
        for ran, usual, count in ((passed(7, 0), 0, 2), (passed(2, 1.9), 0, 6), (passed(5, 1.9), 0, 6),
                                  (passed(2, 0.5), 0, 6), (passed(0.9, 0), 0, 6), (passed(4, 0), 0, 4),
                                  (passed(3, 2.7), 0, 5), (passed(3, 2.7), 2, 6), (passed(5, 4.5), 2, 4)):
            self.assertEqual(self.run_all([ran] * count, tests, usual=usual),
                             [PASSED] * count + [NOT_RUN] * (len(tests) - count),
                             f"{ran.clock} s, of which {ran.used} s of processor time; usual {usual} s")

    def test_compiling_slowly_counts(self):
        """The judge allows 10 s of an exercise."""
        passed = Ran((b"0", b"1", b""), clock=7)
        for compiling, usual, count in ((14, 0, 0), (13, 0, 0), (10, 0, 1), (3, 0, 2), (14, 4, 2)):
            self.assertEqual(self.run_all([passed] * count, list("abc"), compiling, usual),
                             [PASSED] * count + [NOT_RUN] * (3 - count), f"{compiling} s; usual {usual} s")

    def test_what_does_not_compile_slowly_counts(self):
        exercise = next(iter(all_exercises()))
        with tempfile.TemporaryDirectory() as folder:
            judge = Judges(Path(folder), [])
            judge._workshop.root = folder
            made = Made(None, DOES_NOT_COMPILE, used=29.5)
            with unittest.mock.patch("grading.judge.make", lambda *_: made):
                verdict, _ = Judge._judge_anew(judge, exercise, Source("kick.cpp", b"x"), ["Kick.IsRight"], None)
        self.assertEqual(judge.lost(exercise, verdict), 26.5)

    def test_the_reference_tells_what_is_usual(self):
        exercise = next(iter(all_exercises()))
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(2):  # the second time it is remembered
                judge = Judges(Path(folder), [PASSED])
                judge._judge_anew = lambda *_: (ExerciseVerdict([TestVerdict("Kick.IsRight", PASSED)], [], 4.0), True)
                judge.judge(exercise, Source("kick.cpp", b"x", is_reference=True), None)
                self.assertEqual(judge.lost(exercise, ExerciseVerdict([], [], 15.0)), 3.0)


class Seeds(unittest.TestCase):
    def test_each_test_has_its_seed_and_a_pair_is_kept_while_that_is_the_same(self):
        asked: list[tuple[str, str]] = []
        pairs = []

        class OnePair:
            was_asked = True

            def __init__(self, *words, **_):
                self.alive, self.seed = True, words[-1]["SPOOK_SEED"]
                pairs.append(self)

            def run(self, test):
                asked.append((test, self.seed))
                return Ran((b"0", b"1", b""))

            def used_since(self):
                return 0.25

            def close(self):
                self.alive = False

        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch("grading.judge.Pair", OnePair):
            judge = Judges(Path(folder), [], seeds={"c": 7, "d": 7, "e": 1})
            judge._workshop.test_program = lambda exercise: None
            ran, used = judge._run_all(next(iter(all_exercises())), list("abcde"), Made(Path(), used=1.0), None)
        self.assertEqual([verdict.verdict for verdict, _ in ran], [PASSED] * 5)
        self.assertEqual(asked, [("a", "1"), ("b", "1"), ("c", "7"), ("d", "7"), ("e", "1")])
        self.assertEqual((len(pairs), [pair.alive for pair in pairs]), (3, [False] * 3))
        self.assertEqual(used, 1.75)  # each pair's own time counts once


class Points(unittest.TestCase):
    """An exercise of 3 tests with 1, 2 and 0 points."""

    def points(self, rule: str, *verdicts: str, weights: tuple[float, ...] = (1, 2, 0)) -> tuple[float, float, list[float]]:
        exercise = {"tests": [{"verdict": verdict, "points": weight} for verdict, weight in zip(verdicts, weights)]}
        score(exercise, rule)
        return exercise["score"], exercise["max_score"], [test["score"] for test in exercise["tests"]]

    def test_by_the_rule(self):
        right, wrong = (PASSED,) * 3, (PASSED, FAILED, PASSED)
        self.assertEqual(self.points("exercises", *right), (3, 3, [1, 2, 0]))
        self.assertEqual(self.points("exercises", *wrong), (0, 3, [0, 0, 0]))
        self.assertEqual(self.points("tests", *wrong), (1, 3, [1, 0, 0]))
        self.assertEqual(self.points("equal", *right), (1, 1, [1 / 3, 2 / 3, 0]))
        self.assertEqual(self.points("equal", *wrong), (0, 1, [0, 0, 0]))

    def test_with_equal_points_no_number_of_tests_counts_more(self):
        for count in range(1, 50):
            self.assertEqual(self.points("equal", *[PASSED] * count, weights=(0.7,) * count)[:2], (1, 1))

    def test_an_exercise_without_points_has_none_by_any_rule(self):
        for rule in RULES:
            self.assertEqual(self.points(rule, PASSED, weights=(0,)), (0, 0, [0]), rule)


class Compiled(unittest.TestCase):
    def test_its_time_is_told(self):
        """By the shell that runs it, in each isolation that works here: a namespace hides it from outside."""
        exercise = next(iter(all_exercises()))
        spin = "i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done; exit 1"
        for name in ISOLATIONS:
            try:
                isolation = choose(name)
            except CourseError:
                continue
            user = take_user(isolation)
            with self.subTest(name), tempfile.TemporaryDirectory(dir="/tmp") as folder:
                Path(folder).chmod(0o755)
                workshop = SimpleNamespace(headers=Path("/usr/include"), compile_command=lambda *_: [
                    "/bin/sh", "-c", spin, "sh"])
                made = make(exercise, Source("kick.cpp", b"x"), workshop, isolation, user, Path(folder))
                self.assertEqual(made.verdict, DOES_NOT_COMPILE)
                self.assertGreater(made.used, 0)
            user.release()

    def test_one_that_is_stopped_has_used_all(self):
        """Stopped by the clock, it counts as 600 s, and by its output as 20 s."""
        exercise = next(iter(all_exercises()))
        workshop = SimpleNamespace(headers=Path("headers"), compile_command=lambda *_: ["g++"])
        for ended, used in ((Ended(-9, "", False, True, 0.1), 20), (Ended(-9, "", True, False, 0.1), 600)):
            isolation = SimpleNamespace(run=lambda *_, ended=ended: ended)
            with tempfile.TemporaryDirectory() as folder:
                made = make(exercise, Source("kick.cpp", b"x"), workshop, isolation, User(None), Path(folder))
            self.assertEqual((made.verdict, made.used), (DOES_NOT_COMPILE, used))

    def test_the_date_is_the_same_for_all(self):
        """With each compiler that is here; the lines are those of a file of the corpus."""
        asking = (CORPUS / "kick" / "asks_when_it_was_compiled.cpp").read_text(encoding="utf-8")
        lines = ["#include <string_view>", *re.findall(r"^ *static_assert.*$", asking, re.MULTILINE)]
        self.assertEqual(len(lines), 4)
        for compiler in filter(None, map(shutil.which, ("g++", "clang++"))):
            with self.subTest(compiler), tempfile.TemporaryDirectory() as folder:
                file = Path(folder, "kick.cpp")
                file.write_text("\n".join(lines) + "\n")
                os.utime(file, (0, 0))
                command = [compiler, *options_of(os.path.realpath(compiler)), "-std=c++20", "-fsyntax-only", str(file)]
                told = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True)
                self.assertEqual((told.returncode, told.stderr), (0, ""))


class Grades(Grader):
    """Grades without exercises, tests or the reference; the submission eve makes the grader itself fail."""

    def __init__(self):
        self.seed, self.hidden_seed, self.exercises, self.failures = 1, 1, [], []
        self._jobs, self._seconds, self._points, self._attempt, self._due = 2, 2, "tests", "last", ""
        self._weights = self._judge = None
        self._workshop, self.isolation = SimpleNamespace(sources=""), SimpleNamespace(name="", does_not_deny="")

    def grade_one(self, handed, out, on_exercise=None):
        if handed.name == "eve":
            raise OSError("x" * 9000)
        return {"submission": handed.name}


class OneRow(unittest.TestCase):
    def test_a_mistake_of_the_graders_costs_one_row(self):
        handed = [Handed(name, (), Student(name)) for name in ("ann", "eve", "zoe")]
        with tempfile.TemporaryDirectory() as folder:
            grader = Grades()
            results = grader.grade(handed, Path(folder))
            self.assertTrue((Path(folder) / "submissions" / "eve" / "results.json").exists())
        self.assertEqual([result["submission"] for result in results], ["ann", "eve", "zoe"])
        self.assertRegex(results[1]["notes"][0], "could not be graded: OSError: x{1000}")
        self.assertLess(len(results[1]["notes"][0]), 3000)
        self.assertEqual(len(grader.failures), 1)


class Reading(unittest.TestCase):
    def test_its_time_counts(self):
        """Beyond 3 s, as other work: of 120 s that a submission has, 30 may be lost by then, and 117 by the exercises."""
        exercises = list(all_exercises())[:4]
        for seconds, judged in ((0.0, 4), (3.0, 4), (30.0, 3), (122.9, 1), (123.0, 0)):
            grader = Grades()
            grader.exercises, grader._of_submission = exercises, 120
            grader._users = SimpleNamespace(get=lambda: None, put=lambda user: None)
            grader._judge = SimpleNamespace(
                unjudged=lambda exercise: ExerciseVerdict([], []), lost=lambda exercise, one: one.used,
                judge=lambda exercise, source, user: ExerciseVerdict([TestVerdict("0", PASSED)], [], 39.0),
                without_time=lambda exercise: ExerciseVerdict([TestVerdict("0", TIMED_OUT, NOT_RUN)], []))
            grader._weights = SimpleNamespace(of=lambda test: SimpleNamespace(points=1))
            grader._result = lambda submission, found: found
            grader._write = lambda *_: None
            sources = {exercise.function: Source("x.cpp", b"x") for exercise in exercises}
            submission = Submission("ann", Student("ann"), sources, seconds=seconds)
            with unittest.mock.patch("grading.grader.read_apart", lambda *_: submission):
                found = Grader.grade_one(grader, Handed("ann", (), Student("ann")), Path())
            self.assertEqual([one.tests[0].verdict for one in found.values()],
                             [PASSED] * judged + [TIMED_OUT] * (4 - judged), seconds)


class Best(unittest.TestCase):
    """The attempt with most points counts, and the last one of equals. All attempts cost time."""

    def judged(self, *of_attempts: list[str], limit: float = 120) -> tuple[Submission, list[str], float]:
        exercise = next(iter(all_exercises()))
        sources = [Source(f"{k}.cpp", b"") for k in range(len(of_attempts))]
        submission = Submission("ann", Student("ann"), {"kick": sources[0]}, attempts={"kick": sources})
        verdicts = {source: ExerciseVerdict([TestVerdict(str(k), verdict) for k, verdict in enumerate(some)], [], 1.0)
                    for source, some in zip(sources, of_attempts)}
        grader = Grades()
        grader._of_submission = limit
        grader._judge = SimpleNamespace(
            judge=lambda exercise, source, user: verdicts[source], lost=lambda _, one: one.used,
            without_time=lambda exercise: ExerciseVerdict([TestVerdict("0", TIMED_OUT, "not run")], []))
        grader._weights = SimpleNamespace(of=lambda test: SimpleNamespace(points=int(test)))
        verdict, seconds = grader._best_judged(submission, exercise, None, 0.0)
        return submission, [test.verdict for test in verdict.tests], seconds

    def test_the_best_counts(self):
        passed, failed = PASSED, TIMED_OUT
        for of_attempts, best in (([[failed, passed, failed], [passed, passed, failed], [failed, failed, passed]], 2),
                                  ([[failed, passed], [passed, passed]], 1), ([[failed, failed], [failed, failed]], 0),
                                  ([[passed, passed], [passed, passed]], 0)):
            submission, verdicts, seconds = self.judged(*of_attempts)
            self.assertEqual(verdicts, of_attempts[best])
            self.assertEqual(submission.sources["kick"].path, f"{best}.cpp")
            self.assertEqual(submission.notes, [f"taken for kick: {best}.cpp, the best of {len(of_attempts)} attempts"])
            self.assertEqual(seconds, len(of_attempts))

    def test_attempts_beyond_the_submissions_time_are_not_run(self):
        failed, passed = [TIMED_OUT], [PASSED]
        submission, verdicts, seconds = self.judged(*[failed] * 5, passed, limit=3)
        self.assertEqual((verdicts, seconds), (failed, 3))
        submission, verdicts, seconds = self.judged(failed, passed, *[failed] * 5, limit=3)
        self.assertEqual((verdicts, seconds), (passed, 3))


class Status(unittest.TestCase):
    def test_one_that_is_none_stops_nobody(self):
        self.assertEqual([exit_code(status) for status in (b"0", b"256", b"11")], [0, 1, -11])
        for status in (b"4991", b"-1", b"", b"x", b"127", b"99999999999999999999"):
            self.assertEqual(exit_code(status), -signal.SIGKILL, status)


class Complaints(unittest.TestCase):
    def test_a_compiler_without_words_is_told(self):
        """As of a macro that doubles itself forty times: it ends without naming a line."""
        exercise = next(iter(all_exercises()))
        ended = Ended(1, "virtual memory exhausted: Cannot allocate memory\n", False, False, 3.0)
        made = _not_compiled(exercise, Source("kick.cpp", b"A40"), Path("kick.cpp"), ended)
        self.assertIn("gave up", made.message)

    def test_a_compiler_that_is_stopped_refuses_no_asm_statement(self):
        exercise = next(iter(all_exercises()))
        told = "/x.s: Assembler messages:\n/x.s: Error: unknown opcode\n"
        for ended in (Ended(-9, told, False, False, 20.0), Ended(1, told, True, False, 3.0), Ended(1, told, False, True, 3.0),
                      Ended(1, f"{told}g++: fatal error: Killed signal terminated program as\n", False, False, 3.0)):
            made = _not_compiled(exercise, Source("kick.cpp", b"x"), Path("kick.cpp"), ended)
            self.assertEqual(made.message, "the compiler was stopped by a limit on its time, memory or output")
        made = _not_compiled(exercise, Source("kick.cpp", b"x"), Path("kick.cpp"), Ended(1, told, False, False, 3.0))
        self.assertEqual(made.message, "The assembler refuses an asm statement.")

    def test_a_large_array_is_no_asm_statement(self):
        exercise = next(iter(all_exercises()))
        for told in ("/x.s: Assembler messages:\n/x.s: Fatal error: can't write 65534 bytes to section .data of kick.o: "
                     "'File too large'\n", "g++: internal compiler error: File size limit exceeded signal terminated program as\n"):
            self.assertIn("more than 256 MiB", compiler_says(told, exercise, "kick.cpp", "int x;"))

    def test_a_linker_is_not_quoted_on_what_is_ours(self):
        place = "/tmp/grade-x/answers/reference/members/operations.cpp.o: in function `count': "
        for told, reason in (("(.text+0x2): relocation truncated to fit: R_X86_64_PC32", "too large"),
                             ("undefined reference to `mine'", "does not link"), ("final link failed", "does not link")):
            made = _not_linked(f"{place}\n{place}{told}\n")
            self.assertEqual((made.verdict, made.reason), ("does not compile", reason))
            self.assertNotIn("/", made.message)
        self.assertEqual(_not_linked(f"{place}undefined reference to `mine'").message, "undefined reference to `mine'")

    def test_a_long_line_is_looked_through_once(self):
        """A name of megabytes: our own paths are sought at its beginning only."""
        exercise = next(iter(all_exercises()))
        file = f"chapters/{exercise.folder}/{exercise.file.name}"
        told = f"/x/headers/{file}:1:1: error: '{'a' * (4 << 20)}' was not declared\n"
        said = compiler_says(told, exercise, file, "int x;")
        self.assertTrue(said.startswith(f"{file}:1:1: error: 'aaa"))
        self.assertLess(len(said), 1000)


class Demangled(unittest.TestCase):
    """A short symbol may have a long name: here each parameter is a pair of two of the one before it."""

    @staticmethod
    def symbol(pairs: int) -> str:
        return "_Z1fSt6vectorIiESt4pairIS0_S0_E" + "".join(f"S1_IS{k}_S{k}_E" for k in string.digits[2:] +
                                                           string.ascii_uppercase[:pairs - 8])

    def test_a_long_name_is_cut(self):
        """It has 31 MB."""
        told = _readable("_Z1gi", self.symbol(18))
        self.assertTrue(told.startswith("g(int)\nf(std::vector<int>, "), told[:80])
        self.assertLess(len(told), 1000)

    def test_one_without_end_costs_little(self):
        """It would have 130 GB."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        self.assertEqual(_readable(self.symbol(30)), self.symbol(30))
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 7)

    def test_of_many_some_are_shown(self):
        self.assertEqual(_readable(*["_Z1gi"] * 5000).splitlines(), ["g(int)"] * 20)
        self.assertLessEqual(len(_readable("x" * (1 << 20))), 500)


class Messages(unittest.TestCase):
    def test_one_for_all_tests_of_an_exercise_is_cut(self):
        exercise = next(iter(all_exercises()))
        with tempfile.TemporaryDirectory() as folder:
            judged = Judges(Path(folder), []).judge(exercise, Source("kick.cpp", problem="x" * 999_999), None)
        self.assertLess(len(judged.tests[0].message), 99_999)


class OneCore(unittest.TestCase):
    def test_what_is_started_there_stays_there(self):
        allowed = os.sched_getaffinity(0)
        core = _take_core()
        with _only_on(core):
            process = spawn(["/bin/sleep", "60"], ENVIRONMENT, {})
        try:
            self.assertEqual(os.sched_getaffinity(process), {core})
            self.assertEqual(os.sched_getaffinity(0), allowed)
        finally:
            os.kill(process, signal.SIGKILL)
            reap(process)

    def test_each_core_has_a_pair_before_one_has_two(self):
        cores = sorted(os.sched_getaffinity(0))
        with unittest.mock.patch("grading.pair._pairs_on", Counter()):
            taken = [_take_core() for _ in range(2 * len(cores))]
        self.assertEqual(sorted(taken[:len(cores)]), cores)
        self.assertEqual(sorted(taken[len(cores):]), cores)


if __name__ == "__main__":
    unittest.main()
