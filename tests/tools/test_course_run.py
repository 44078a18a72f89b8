"""The course command with the engine: run, scenes, --mine, start."""

import base64
import gzip
import json
import re
import unittest

from sandbox import STILL, Sandbox, all_exercises

from needs import NEEDS


class CourseRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox(built=True)
        cls.addClassCleanup(cls.box.close)
        cls.kick = next(exercise for exercise in all_exercises() if exercise.function == "kick")

    def tearDown(self):
        self.box.restore(self.kick)

    def run_free_fall(self, *words: str) -> tuple[float, str]:
        """Returns the error, and the output on stderr."""
        result = self.box.course("run", "free_fall", "--h", "1/60", "--json", *words)
        self.assertEqual(result.returncode, 0, result.stderr)
        run = json.loads(result.stdout)
        promised = {"scene", "parameters", "solver", "h", "steps", "us_per_step", "error", "residual"}
        self.assertEqual(promised - set(run), set())
        self.assertEqual(set(run["error"]), {"name", "value", "unit"})
        return run["error"]["value"], result.stderr

    def test_the_reference(self):
        error, _ = self.run_free_fall()
        self.assertLess(error, 1e-9)

    def test_mine_without_an_exercise_is_the_reference(self):
        error, said = self.run_free_fall("--mine")
        self.assertLess(error, 1e-9)
        self.assertIn("everything is the reference", said)

    def test_mine_takes_what_the_student_wrote(self):
        self.box.file(self.kick).write_text(STILL)
        error, said = self.run_free_fall("--mine")
        self.assertGreater(error, 0.1)  # a body that is never kicked doesn't fall
        self.assertIn("Yours, right or wrong: 1.1; the rest is the reference.", said)
        self.assertLess(self.run_free_fall()[0], 1e-9)
        # One compilation serves check and run.
        compiled = "chapters/CMakeFiles/exercise_kick.dir/01_leapfrog/kick.cpp.o"
        self.assertTrue((self.box.root / "build/check" / compiled).exists())
        self.assertFalse((self.box.root / "build/release" / compiled).exists())
        self.box.solve(self.kick)
        self.assertLess(self.run_free_fall("--mine")[0], 1e-9)

    def test_mine_tells_what_a_run_has_called(self):
        drift, rate = (next(exercise for exercise in all_exercises() if exercise.function == function)
                       for function in ("drift", "quaternion_rate"))
        for exercise in (drift, rate):
            self.addCleanup(self.box.restore, exercise)
            self.box.solve(exercise)
        said = " ".join(self.run_free_fall("--mine")[1].split())
        self.assertIn("Yours, right or wrong: 1.2; the rest is the reference. Yours, too, but not called: 2.1.", said)
        self.box.restore(drift)
        self.assertIn("This run calls no function of yours; you have begun 2.1.",
                      " ".join(self.run_free_fall("--mine")[1].split()))

    def test_an_engine_of_ones_own(self):
        """The step that the student wrote moves the bodies, and the reference's where there is none yet."""
        step = next(exercise for exercise in all_exercises() if exercise.function == "leapfrog_step")
        error, said = self.run_free_fall("--engine", "mine")
        self.assertLess(error, 1e-9)
        self.assertIn("everything is the reference", said)
        try:
            self.box.file(step).write_text(STILL.replace("Vec3 kick(const Vec3& v, const Vec3&, double, double) { return v; }",
                                                         "void leapfrog_step(Particles&, const ForceField&, double) {}"))
            error, said = self.run_free_fall("--engine=mine")
            self.assertGreater(error, 0.1)  # it hangs in the air
            self.assertIn("Yours, right or wrong: 1.4; the rest is the reference.", said)
            self.assertLess(self.run_free_fall("--mine")[0], 1e-9)  # the fast engine has a step of its own
            page = self.box.root / "fall.html"
            result = self.box.course("view", "free_fall", "--engine", "mine", "--out", str(page))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("Yours, right or wrong: 1.4", result.stderr)
            packed = re.search(r'data-recording="">([^<]+)', page.read_text(encoding="utf-8"))[1]
            header = json.loads(gzip.decompress(base64.b64decode(packed)).splitlines()[0])
            self.assertEqual((header["method"]["engine"], header["mine"]), ("plain", ["leapfrog_step"]))
        finally:
            self.box.restore(step)

    def test_mine_that_does_not_compile_or_define(self):
        for source, told in (("not C++", "does not compile: chapters/01_leapfrog/kick.cpp:1:"),
                             ("namespace spook {}", "is not defined"),
                             (STILL.replace("Vec3 kick", "Vec3 helper(Vec3);\nVec3 kick").replace("v;", "helper(v);"),
                              "undefined reference to `spook::helper")):
            self.box.file(self.kick).write_text(source)
            result = self.box.course("run", "free_fall", "--mine")
            self.assertEqual((result.returncode, result.stdout), (1, ""))
            self.assertIn(told, result.stderr)
            self.assertRegex(result.stderr, r"course: (1\.1 kick|your functions) [^\n]*\n\Z")
            self.assertNotIn("Traceback", result.stderr)

    def test_mine_that_crashes_is_told_to_be_mine(self):
        for crash in ("(void)v; __builtin_trap();", "std::vector<Vec3> all(1, v); return all[all.size()];"):
            self.box.file(self.kick).write_text(STILL.replace("return v;", crash))
            result = self.box.course("run", "free_fall", "--mine")
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, r"course: the run crashed \(SIG\w+\) at chapters/01_leapfrog/kick.cpp:3; "
                                            r"see ./course check 1.1\n\Z")
            self.assertNotIn("Traceback", result.stderr)

    def test_bad_input_is_the_engine_s_to_refuse(self):
        self.run_free_fall()
        for words, told in ((["free_fal"], "free_fal"), (["free_fall", "--h", "0"], "0"),
                            (["free_fall", "--h", "nan"], "nan"), (["free_fall", "--set", "mas=3"], "mas")):
            with self.subTest(words=words):
                result = self.box.course("run", *words)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
                self.assertIn(told, result.stderr)

    def test_an_error_with_mine_is_one_line_too(self):
        self.run_free_fall("--mine")
        for solved in (False, True):
            if solved:
                self.box.solve(self.kick)
                self.run_free_fall("--mine")
            for words in (["free_fal"], ["free_fall", "--h", "0"], ["free_fall", "-h"]):
                result = self.box.course("run", *words, "--mine")
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertRegex(result.stderr, r"\Aspook: [^\n]+\n\Z")

    def test_help_fits_a_terminal(self):
        for words in (["run", "--help"], ["scenes", "--help"]):
            result = self.box.course(*words)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80)

    def test_scenes(self):
        result = self.box.course("scenes")
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in ("free_fall", "oscillator", "orbit", "top", "resting_sphere", "stack"):
            self.assertRegex(result.stdout, rf"(?m)^{name} +[A-Z]")
        self.assertLess(len(result.stdout.splitlines()), 200)
        one = self.box.course("scenes", "stack").stdout
        for text in ("  answer", "  default", "    bodies="):
            self.assertIn(text, one)
            self.assertNotIn(text, result.stdout)

    def test_start(self):
        if not all(need.there() for need in NEEDS):
            self.skipTest("start would install packages")
        result = self.box.course("start", cwd="/")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        for text in ("free_fall", "10000 its", "µs/step", "Next: 1.1 kick"):
            self.assertIn(text, result.stdout)
        self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80)
        self.assertIn("build/start.png", result.stdout)
        self.assertEqual((self.box.root / "build/start.png").read_bytes()[:4], b"\x89PNG")


if __name__ == "__main__":
    unittest.main()
