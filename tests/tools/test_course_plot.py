"""The command plot: what it draws and checks, on an engine of one's own too, in shards and after an interruption."""

import csv
import hashlib
import json
import shutil
import subprocess
import unittest
from pathlib import Path

from sandbox import ROOT, STILL, Sandbox, all_exercises


class CoursePlot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox(built=True)
        cls.addClassCleanup(cls.box.close)
        cls.kick = next(exercise for exercise in all_exercises() if exercise.function == "kick")

    def tearDown(self):
        self.box.restore(self.kick)

    def plot(self, *words: str, code: int = 0) -> str:
        """Returns the output on stdout."""
        result = self.box.course("plot", *words)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        self.assertLessEqual(max(map(len, result.stdout.splitlines()), default=0), 80)
        return result.stdout

    def test_it_lists_what_there_is(self):
        said = self.plot()
        for name in ("01_leapfrog", "energy", "work_precision"):
            self.assertIn(name, said)

    def test_it_refuses(self):
        for words, told in ((["enrgy"], "did you mean energy?"), (["energy", "--quick", "--shard", "3/2"], "3/2"),
                            (["energy", "--quick", "--shard", "x"], "shard"), (["energy", "--merge", "/nowhere"], "/nowhere"),
                            (["all", "--merge", "/nowhere"], "one experiment"),
                            (["work_precision", "--quick", "--", "--scene", "stak"], "stak"),
                            (["energy", "--", "--bogus"], "--bogus"), (["--shard", "1/2"], "--shard needs the NAME"),
                            (["--mine"], "--mine needs the NAME"), (["--quick"], "--quick needs the NAME"),
                            (["--merge", "energy"], "--merge needs the NAME"),
                            (["work_precision", "--", "--h", "1/60,1/60"], "h has the value 1/60 twice: leave one out"),
                            (["work_precision", "--", "--set", "ratio=1,1"], "ratio has the value 1 twice"),
                            (["work_precision", "--", "--sweep", "h=1/60,1/30", "--h", "1"], "h is swept"),
                            (["work_precision", "--", "--row-order", "up,random", "--seed", "1"],
                             "row-order=up is refused in every combination: seed has no effect"),
                            (["energy", "--", "--jobs", "0"], 'jobs must be a whole number from 1 to 9999, but is "0"'),
                            (["all", "--out", "o"], "one experiment"), (["--out", "o"], "--out needs the NAME"),
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

    def test_it_checks_and_draws(self):
        said = self.plot("energy", "--quick")
        self.assertIn("holds the energy error of leapfrog falls with the second power of the cost", said)
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
        self.assertIn("FALSE the energy error of leapfrog", self.plot("energy", "--quick", "--mine"))

    def test_it_takes_a_scene_from_a_file_that_has_an_answer(self):
        text = {"format": "spook scene", "version": 2, "model": "point", "h": "1/60", "time": 1, "half_step_start": True,
                "parameters": {"v": {"default": 1}}, "bodies": [{"x": [0, 0, 0], "v": ["$v", 0, 9.81], "mass": 1}]}
        options = ["work_precision", "--quick", "--", "--scene", str(self.box.root / "thrown.json"), "--h", "1/30,1/60"]
        Path(options[4]).write_text(json.dumps(text))
        refused = self.box.course("plot", *options)
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn('has no answer to compare with: add "expected"', refused.stderr.splitlines()[-1])
        expected = {"body": 0, "time": 1, "x": [1, 0, 9.81 / 2], "tolerance": 1e-3}
        folder = self.box.root / "build/plots/work_precision"
        Path(options[4]).write_text(json.dumps(text | {"expected": [expected]}))
        self.assertIn("holds every point has a finite error", self.plot(*options, "--set", "v=1,2"))
        with open(self.box.root / "build/plots/work_precision/table.csv", newline="") as table:
            rows = [(row["line"], float(row["error"])) for row in csv.DictReader(table)]
        for v, right in (("v=1", 0), ("v=2", 1000)):  # free fall is exact; 2 m/s leads 1 m farther, 1000 tolerances
            errors = [error for line, error in rows if v in line]
            self.assertGreaterEqual(len(errors), 2)
            for error in errors:
                self.assertAlmostEqual(error, right, delta=1e-6)
        manifest = json.loads((folder / "table.csv.manifest.json").read_text())
        self.assertEqual(manifest["sha256"][options[4]], hashlib.sha256(Path(options[4]).read_bytes()).hexdigest())
        self.assertEqual(manifest["folder"], str(ROOT))
        # A file that has changed in between is another experiment.
        self.plot(*options, "--shard", "1/2")
        plan = (folder / "parts/plan.txt").read_text()
        Path(options[4]).write_text(json.dumps(text | {"expected": [expected | {"tolerance": 1e-2}]}))
        self.plot(*options, "--shard", "1/2")
        self.assertNotEqual((folder / "parts/plan.txt").read_text(), plan)

    def test_its_axes_are_the_options_of_run(self):
        options = ["work_precision", "--quick", "--", "--scene", "sliding_block", "--time", "0.1"]
        for axes, lines in ((["--accuracy", "1e-3,1e-6", "--h", "1/60"], {"accuracy 1e-3", "accuracy 1e-6"}),
                            (["--soft-steps", "1,4", "--h", "1/60"], {"soft-steps 1", "soft-steps 4"}),
                            (["--accuracy", "1e-6", "--h", "1/60"], {"auto"}),
                            (["--sweep", "h=1/60", "iterations=10,20", "max-parts=1,4"], {"gauss_seidel max-parts 1", "gauss_seidel max-parts 4"})):
            self.plot(*options, *axes)
            with open(self.box.root / "build/plots/work_precision/table.csv", newline="") as table:
                self.assertEqual({row["line"] for row in csv.DictReader(table)}, lines)

    def test_it_refuses_a_scene_without_an_answer_for_such_runs(self):
        refused = self.box.course("plot", "work_precision", "--quick", "--", "--soft-steps", "1,4", "--h", "1/60")
        self.assertEqual(refused.returncode, 2, refused.stdout + refused.stderr)
        self.assertIn("stack has no error with soft-steps=1 h=1/60", refused.stderr.splitlines()[-1])

    def test_steps_of_order_four_have_no_solver_and_a_run_that_diverges_is_lost(self):
        out = self.box.root / "own"
        for more, rows in ((["double_pendulum", "--set", "d=0", "--time", "0.1", "--integrator-order", "2,4", "--h", "1/60"],
                            [("integrator-order 2 gauss_seidel", its, "sound") for its in ("10", "30", "100")]
                            + [("integrator-order 4", "50", "sound")]),
                           (["orbit", "--set", "m=1,1e308", "--time", "0.1", "--h", "1/60", "--iterations", "10"],
                            [("m=1 gauss_seidel", "10", "sound"), ("m=1e308 gauss_seidel", "10", "lost")]),
                           (["orbit", "--set", "m=1e308", "--h", "1/60"], [("gauss_seidel", "50", "lost")])):
            said = self.plot("work_precision", "--quick", "--out", str(out), "--", "--scene", *more)
            self.assertIn("has a finite error", said)
            with open(out / "table.csv", newline="") as table:
                self.assertEqual([(row["line"], row["iterations"], row["state"]) for row in csv.DictReader(table)], rows)
            self.assertTrue((out / "work_precision.png").exists())

    def test_help_of_an_experiment_leaves_its_results(self):
        folder = self.box.root / "build/plots/energy"
        self.plot("energy", "--quick")
        before = {path.name: path.read_bytes() for path in folder.iterdir()}
        said = self.box.course("plot", "energy", "--", "--help")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("--jobs", said.stdout)
        self.plot("energy", "--quick", "--", "--out", str(self.box.root / "other"))  # as that help lists it
        self.assertTrue((self.box.root / "other/table.csv").exists())
        self.assertEqual({path.name: path.read_bytes() for path in folder.iterdir()}, before)

    def test_it_draws_an_engine_of_ones_own_beside_the_other(self):
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

    def test_it_in_shards_gives_the_same_table(self):
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

    def test_it_goes_on_where_it_was_interrupted(self):
        parts = self.box.root / "build/plots/energy/parts"
        shutil.rmtree(parts.parent, ignore_errors=True)
        self.plot("energy", "--quick", "--shard", "1/2")  # leaves half of the points, as an interruption would
        marked = parts / "000000.csv"
        marked.write_text(marked.read_text().replace(",100,", ",100.5,", 1))
        self.plot("energy", "--quick")
        self.assertIn(",100.5,", (parts.parent / "table.csv").read_text())
        self.assertFalse(parts.exists())

    def test_it_says_when_a_claim_is_false(self):
        source = self.box.root / "plots/01_leapfrog/energy.cpp"
        text = source.read_text()
        self.assertIn('slope("RK4"), -4, 0.2', text)
        source.write_text(text.replace('slope("RK4"), -4, 0.2', 'slope("RK4"), -5, 0.2'))
        try:
            self.assertIn("FALSE that of RK4 falls with the fourth power", self.plot("energy", "--quick", code=1))
        finally:
            source.write_text(text)


if __name__ == "__main__":
    unittest.main()
