"""The course command on answers that are wrong in every way, and then on the right ones."""

import json
import os
import time
import unittest

from sandbox import Sandbox, all_exercises

KICK = """#include "01_leapfrog/leapfrog.hpp"
#include "common/not_implemented.hpp"
#include <cstdlib>
#include <iostream>
namespace spook {
%s
Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  %s
}
}  // namespace spook
"""
RIGHT = "return v + h * inverse_mass * f;"
WRONG = "return v + h * f;"


class CourseCheck(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox(built=True)
        cls.addClassCleanup(cls.box.close)
        cls.exercises = all_exercises()
        cls.kick = next(exercise for exercise in cls.exercises if exercise.function == "kick")
        cls.drift = next(exercise for exercise in cls.exercises if exercise.function == "drift")

    def tearDown(self):
        self.box.restore(*self.exercises)

    def write(self, body: str, before: str = ""):
        self.box.file(self.kick).write_text(KICK % (before, body))

    def check(self, *words: str, code: int, **env: str) -> str:
        result = self.box.course("check", *words, **env)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        return result.stdout

    def assert_wrong(self, reason: str, **env: str) -> str:
        said = self.check("1.1", code=1, **env)
        self.assertIn("1.1 kick is wrong: " + reason, " ".join(said.split()))  # it may be folded
        board = json.loads(self.box.course("progress", "--json", **env).stdout)
        self.assertEqual((board["done"], board["exercises"][0]["state"]), (0, "wrong"))
        return said

    def test_a_right_answer(self):
        self.write(RIGHT)
        said = self.check("1.1", code=0)
        for text in ("1.1 kick is done: ", "What was tested: adds force over mass times step;", "Next: 1.2 drift",
                     "read    chapters/01_leapfrog/README.md"):
            self.assertIn(text, said)
        self.assertIn("All exercises that you have started are right.", self.check(code=0))
        self.assertIn("Chapter 1: 1 of ", self.check("1", code=1))
        self.assertIn("1 of ", self.box.course().stdout)
        self.assertIn(self.kick.reference.read_text(), self.box.course("solution", "1.1").stdout)

    def test_a_wrong_answer_is_explained(self):
        self.write(WRONG)
        said = self.assert_wrong("fails Kick.")
        self.assertIn("1.1 kick: ", said)
        self.assertIn("expected", said)
        self.assertIn("./course hint 1.1", said)
        self.assertNotIn("_test.cpp", said)
        self.assertIn("fails Kick.", self.check(code=1))

    def test_what_explains_the_others_is_shown_first(self):
        self.write("return const_cast<Vec3&>(v) += h * inverse_mass * f;")
        self.assertIn("An input was changed.", self.assert_wrong("fails Kick.IsTheSameInAnyUnits"))

    def test_what_lives_on_is_seen_when_a_test_is_run_alone(self):
        self.write("static const double first = inverse_mass; return v + h * first * f;")
        self.assertIn("This test gives another result when it runs alone.",
                      " ".join(self.assert_wrong("fails Kick.LeavesAFixedBodyAlone").split()))
        self.write("return v + h * f;")
        self.assertNotIn("runs alone", self.assert_wrong("fails Kick.AddsForceOverMassTimesStep"))

    def test_the_seed_is_handed_on(self):
        self.write(WRONG)
        self.assertIn("seed 77", self.check("1.1", "--seed", "77", code=1))

    def test_what_the_answer_prints_is_shown(self):
        self.write('std::cout << "h is " << h << std::endl; ' + WRONG)
        self.assertIn("h is ", self.assert_wrong("fails Kick.").partition("Your code printed:")[2])

    def test_one_that_does_not_compile(self):
        self.write("return v + oops;")
        said = self.assert_wrong("does not compile")
        self.assertIn("chapters/01_leapfrog/kick.cpp:8:14: error: ", said)
        self.assertIn("oops", said)

    def test_one_that_does_not_link(self):
        self.write("return helper(v);", before="Vec3 helper(const Vec3& v);")
        self.assertIn("undefined reference to `spook::helper", self.assert_wrong("does not compile"))

    def test_one_that_crashes(self):
        self.write("(void)f; (void)h; (void)inverse_mass; *(volatile int*)8 = 1; return v;")
        said = self.assert_wrong("crashed (SIGSEGV) in Kick.")
        self.assertIn("chapters/01_leapfrog/kick.cpp:8: ", said)

    def test_a_crash_inside_a_library_names_the_student_s_line(self):
        for body, ending, told in (
                ("std::vector<double> m(1, inverse_mass); return v + h * m[m.size() + (h > 0)] * f;",
                 "fails an assertion of the C++ library in Kick.", "an index is past the end of a std::vector"),
                ("Eigen::VectorXd all(3); all << f; return v + h * inverse_mass * all[all.size()] * f;",
                 "fails an assertion of Eigen in Kick.", "an index or a block is outside its vector or matrix"),
                ("return h > -1 ? kick(v, f, inverse_mass, h) + v : v;", "crashed (SIGSEGV) in Kick.",
                 "a function that calls itself without end")):
            with self.subTest(told=told):
                self.write(body)
                said = " ".join(self.assert_wrong(ending).split())
                # Which of the function's lines the stack ends in is chance.
                self.assertRegex(said, r"chapters/01_leapfrog/kick\.cpp:[78]: ")
                self.assertIn(told, said)
                self.assertNotIn("Assertion", said)

    def test_one_that_never_ends(self):
        self.write("for (volatile bool on = true; on;) {} " + RIGHT)
        self.assert_wrong("timed out after 0.5 s in Kick.", COURSE_TIME_LIMIT="0.5")
        self.write("sleep(60); " + RIGHT, before='extern "C" unsigned sleep(unsigned);')
        self.assert_wrong("timed out after 5 s on the clock in Kick.", COURSE_TIME_LIMIT="0.5")

    def test_one_that_ends_the_program(self):
        self.write("(void)v; (void)f; (void)h; (void)inverse_mass; std::exit(0);")
        self.assert_wrong("ended early (exit code 0) in Kick.")

    def test_one_that_ends_it_before_the_tests(self):
        self.write(RIGHT, before="static const int ended = (std::exit(0), 0);")
        self.assert_wrong("ended early (exit code 0)")

    def test_an_empty_file_is_not_started(self):
        self.box.file(self.kick).write_text("// later\n")
        self.assertIn("is not started", self.check("1.1", code=1))

    def test_another_signature_is_not_filled_from_the_reference(self):
        self.write(RIGHT, before="}\nnamespace mine { using namespace spook;")
        self.assertIn("spook::kick(", self.assert_wrong("function not defined"))

    def test_an_answer_with_an_old_date_is_tested_all_the_same(self):
        self.write(WRONG)
        self.check("1.1", code=1)
        self.write(RIGHT)
        os.utime(self.box.file(self.kick), (1e9, 1e9))
        self.assertIn("is done", self.check("1.1", code=0))

    def test_a_missing_file(self):
        self.box.file(self.kick).unlink()
        self.box.solve(self.drift)
        self.assertIn("./course reset 1.1", self.check("1.1", code=1))
        self.assertIn("1.2 drift is done", self.check("1.2", code=0))

    def test_the_marker_in_comments_and_strings_only(self):
        self.write(f'// not_implemented("1.1 kick");\n  /* not_implemented( */ {RIGHT}')
        self.assertIn("is done", self.check("1.1", code=0))
        self.write(f'not_implemented("1.1 kick", v, f); {RIGHT}')
        self.assertIn("is not started", self.check("1.1", code=1))

    def test_a_broken_exercise_breaks_no_other(self):
        self.write("(void)v; (void)f; (void)h; (void)inverse_mass; std::abort();")
        others = [exercise for exercise in self.exercises if exercise.chapter == 1 and exercise != self.kick]
        for exercise in others:
            self.box.solve(exercise)
        for exercise in others:
            self.assertIn("is done", self.check(exercise.id, code=0))
        self.write("not C++")
        self.assertIn(f"Chapter 1: {len(others)} of {len(others) + 1} done.", self.check("1", code=1))

    def test_files_of_the_student_s_own_do_no_harm(self):
        self.write(RIGHT)
        for name in ("kick copy.cpp", "helpers.cpp", "kick.old.cpp"):
            extra = self.box.file(self.kick).with_name(name)
            extra.write_text("this is not C++\n")
            self.addCleanup(extra.unlink)
        self.assertIn("is done", self.check("1.1", code=0))

    def test_right_answers_make_the_board_say_done(self):
        # Two chapters: tools.grade_class has right answers to all.
        solved = [exercise for exercise in self.exercises if exercise.chapter <= 2]
        for exercise in solved:
            self.box.solve(exercise)
        board = json.loads(self.box.course("progress", "--json").stdout)
        done = [entry["id"] for entry in board["exercises"] if entry["state"] == "done"]
        self.assertEqual(done, [exercise.id for exercise in solved])
        self.assertEqual((board["done"], board["total"]), (len(solved), len(self.exercises)))
        said = self.check(code=0)
        self.assertIn("All exercises that you have started are right.", said)
        self.assertIn("Next: 3.1", said)

    def test_from_save_to_verdict(self):
        self.write(RIGHT)
        self.check("1.1", code=0)
        last = max(self.exercises, key=lambda exercise: (exercise.chapter, exercise.number))
        for exercise in (self.kick, last):
            self.box.solve(exercise)
            self.check(exercise.id, code=0)
            self.box.file(exercise).write_text(exercise.reference.read_text() + "// saved again\n")
            begin = time.monotonic()
            self.check(exercise.id, code=0)
            print(f"from save to verdict, {exercise.label}: {time.monotonic() - begin:.1f} s", flush=True)

    def test_watch_checks_at_every_save_until_ctrl_c(self):
        self.write(RIGHT)
        self.check("1.1", code=0)
        with self.box.watch("1.1") as watching:
            watching.wait_for("1.1 kick is done")
            watching.wait_for("Next: 1.2 drift")
            self.write(WRONG)
            watching.wait_for("1.1 kick is wrong")
            code, said = watching.interrupt()
            self.assertEqual(code, 130)
            # Where the machine is slow, it has said what it was building.
            self.assertEqual(said.replace("building 1.1 kick ...\n", ""), "")


if __name__ == "__main__":
    unittest.main()
