"""The course command with the engine: run, scenes, --mine, plot, start."""

import base64
import csv
import gzip
import json
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from sandbox import Sandbox, all_exercises

from needs import NEEDS

STILL = """#include "01_leapfrog/leapfrog.hpp"
namespace spook {
Vec3 kick(const Vec3& v, const Vec3&, double, double) { return v; }
}  // namespace spook
"""


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
                             ("", "is not defined"),
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

    def plot(self, *words: str, code: int = 0) -> str:
        """Returns the output on stdout."""
        result = self.box.course("plot", *words)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        self.assertLessEqual(max(map(len, result.stdout.splitlines()), default=0), 80)
        return result.stdout

    def test_plot_lists_what_there_is(self):
        said = self.plot()
        for name in ("01_leapfrog", "energy", "work_precision"):
            self.assertIn(name, said)

    def test_plot_refuses(self):
        for words, told in ((["enrgy"], "did you mean energy?"), (["energy", "--quick", "--shard", "3/2"], "3/2"),
                            (["energy", "--quick", "--shard", "x"], "shard"), (["energy", "--merge", "/nowhere"], "/nowhere"),
                            (["all", "--merge", "/nowhere"], "one experiment"),
                            (["work_precision", "--quick", "--", "--scene", "stak"], "stak"),
                            (["energy", "--", "--bogus"], "--bogus"), (["--shard", "1/2"], "--shard needs the NAME"),
                            (["--mine"], "--mine needs the NAME"), (["--quick"], "--quick needs the NAME"),
                            (["--merge", "energy"], "--merge needs the NAME"),
                            (["--publish"], "--publish needs the NAME"), (["--", "--h", "1"], "need the NAME")):
            with self.subTest(words=words):
                result = self.box.course("plot", *words)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn(told, result.stderr.splitlines()[-1])
                self.assertNotIn("Traceback", result.stderr)
        result = self.box.course("plot", "energy", "--quick", "--publish", "--format", "png")
        self.assertEqual((result.returncode, "--format is png" in result.stderr), (2, True), result.stderr)
        result = self.box.course("plot", "energy", "--quick", "--publish")
        self.assertEqual(result.returncode, 1)
        self.assertIn("in full size", result.stderr)

    def test_plot_checks_and_draws(self):
        said = self.plot("energy", "--quick")
        self.assertIn("holds leapfrog's energy error falls with the square of the cost", said)
        self.assertIn("figure: build/plots/energy/energy.png", said)
        self.assertEqual((self.box.root / "build/plots/energy/energy.png").read_bytes()[:4], b"\x89PNG")
        self.assertIn("figure: build/plots/energy/energy.pdf", self.plot("energy", "--quick", "--format", "pdf"))
        self.assertEqual((self.box.root / "build/plots/energy/energy.pdf").read_bytes()[:4], b"%PDF")
        self.plot("energy", "--quick", "--format", "svg")
        alone = (self.box.root / "build/plots/energy/energy.svg").read_text()
        self.box.solve(self.kick)
        with_mine = self.plot("energy", "--quick", "--mine", "--format", "svg")
        self.assertIn("Yours, right or wrong: 1.1; the rest is the reference.", with_mine)
        self.assertNotEqual((self.box.root / "build/plots/energy/energy.svg").read_text(), alone)
        self.box.file(self.kick).write_text(STILL)
        self.assertIn("FALSE leapfrog's energy error", self.plot("energy", "--quick", "--mine"))

    def test_plot_takes_a_scene_from_a_file_that_has_an_answer(self):
        text = {"format": "spook scene", "version": 2, "model": "point", "h": "1/60", "time": 1, "half_step_start": True,
                "parameters": {"v": {"default": 1}}, "bodies": [{"x": [0, 0, 0], "v": ["$v", 0, 9.81], "mass": 1}]}
        options = ["work_precision", "--quick", "--", "--scene", str(self.box.root / "thrown.json"), "--h", "1/30,1/60"]
        Path(options[4]).write_text(json.dumps(text))
        refused = self.box.course("plot", *options)
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn('has no answer to compare with: add "expected"', refused.stderr.splitlines()[-1])
        expected = {"body": 0, "time": 1, "x": [1, 0, 9.81 / 2], "tolerance": 1e-3}
        Path(options[4]).write_text(json.dumps(text | {"expected": [expected]}))
        self.assertIn("holds every point has a finite error", self.plot(*options, "--set", "v=1,2"))
        with open(self.box.root / "build/plots/work_precision/table.csv", newline="") as table:
            rows = [(row["line"], float(row["error"])) for row in csv.DictReader(table)]
        for v, right in (("v=1", 0), ("v=2", 1000)):  # free fall is exact; 2 m/s leads 1 m farther, 1000 tolerances
            errors = [error for line, error in rows if v in line]
            self.assertGreaterEqual(len(errors), 2)
            for error in errors:
                self.assertAlmostEqual(error, right, delta=1e-6)

    def test_plot_draws_an_engine_of_ones_own_beside_the_other(self):
        step = next(exercise for exercise in all_exercises() if exercise.function == "leapfrog_step")
        self.addCleanup(self.box.restore, step)
        self.box.solve(step)
        said = self.plot("work_precision", "--quick", "--engine", "mine", "--", "--scene", "oscillator", "--h", "1/30,1/60")
        self.assertIn("Yours, right or wrong: 1.4", said)
        rows = []
        for folder in ("work_precision", "work_precision-mine"):
            with open(self.box.root / "build/plots" / folder / "table.csv", newline="") as table:
                rows.append(list(csv.DictReader(table)))
        self.assertEqual(len(rows[0]), 2)
        for fast, own in zip(*rows, strict=True):
            self.assertAlmostEqual(float(fast["error"]), float(own["error"]), delta=1e-9)  # roundings: both are leapfrog
            self.assertEqual(float(own["row updates a second"]), 0)  # which the plain engine does not count

    def test_plot_in_shards_gives_the_same_table(self):
        folder = self.box.root / "build/plots/energy"
        shutil.rmtree(folder, ignore_errors=True)
        self.plot("energy", "--quick")
        whole = (folder / "table.csv").read_bytes()
        shutil.rmtree(folder)
        elsewhere = []
        for shard in ("1/3", "2/3", "3/3"):
            self.assertIn(f"shard {shard} is done", self.plot("energy", "--quick", "--shard", shard))
            elsewhere.append(str(self.box.root / f"shard-{shard[0]}"))
            folder.rename(elsewhere[-1])
        self.assertIn("holds", self.plot("energy", "--quick", "--merge", *elsewhere))
        self.assertEqual((folder / "table.csv").read_bytes(), whole)

    def test_shards_that_begin_together_keep_what_the_others_write(self):
        self.plot("energy", "--quick")
        program, folder = self.box.root / "build/release/plots/plot_energy", self.box.root / "shards"
        for attempt in range(5):
            # Parts of another plan, which the first of them is to remove; so many, that it takes a while.
            (folder / "parts").mkdir(parents=True)
            (folder / "parts/plan.txt").write_text("another plan")
            for point in range(1000):
                (folder / f"parts/{point:06}.csv").touch()
            shards = [subprocess.Popen([program, "--quick", "--out", folder, "--shard", f"{part}/8"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                      for part in range(1, 9)]
            for shard in shards:
                said = shard.communicate()[1]
                self.assertEqual(shard.returncode, 0, said)
            points = len(list((folder / "parts").glob("[0-9]*.csv")))
            again = subprocess.run([program, "--quick", "--out", folder], capture_output=True, text=True)
            self.assertEqual((again.returncode, again.stderr), (0, ""), f"{points} points were left of attempt {attempt}")
            shutil.rmtree(folder)

    def test_plot_goes_on_where_it_was_interrupted(self):
        parts = self.box.root / "build/plots/energy/parts"
        shutil.rmtree(parts.parent, ignore_errors=True)
        self.plot("energy", "--quick", "--shard", "1/2")  # leaves half of the points, as an interruption would
        marked = parts / "000000.csv"
        marked.write_text(marked.read_text().replace(",100,", ",100.5,", 1))
        self.plot("energy", "--quick")
        self.assertIn(",100.5,", (parts.parent / "table.csv").read_text())
        self.assertFalse(parts.exists())

    def test_plot_says_when_a_claim_is_false(self):
        source = self.box.root / "plots/01_leapfrog/energy.cpp"
        text = source.read_text()
        self.assertIn('slope("RK4"), -4, 0.2', text)
        source.write_text(text.replace('slope("RK4"), -4, 0.2', 'slope("RK4"), -5, 0.2'))
        try:
            self.assertIn("FALSE RK4's with the fourth power", self.plot("energy", "--quick", code=1))
        finally:
            source.write_text(text)

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
