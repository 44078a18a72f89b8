"""--slurm on a real Slurm of one node: the same marks and tables as without, and reports of failures."""

import filecmp
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from classroom import SECONDS_A_TEST, Classroom, right, run_course
from one_node import OneNode, lacking
from sandbox import ROOT

from errors import CourseError
from paths import BUILD
from slurm import run_array


@unittest.skipIf(lacking(), f"Slurm: {lacking()}")
class Slurm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="slurm-")).resolve()
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.folder.chmod(0o755)
        cls.slurm = OneNode(cls.folder / "node")
        cls.addClassCleanup(cls.slurm.close)
        os.environ["SLURM_CONF"] = cls.slurm.environment["SLURM_CONF"]
        cls.addClassCleanup(os.environ.pop, "SLURM_CONF")

    def test_a_class(self):
        room = Classroom()
        self.addCleanup(room.close)
        for k in range(5):
            room.hand_in(f"s{k}", {"kick.cpp": right("kick") + f"// {k}\n",
                                   "drift.cpp": right("drift") if k % 2 else f"wrong {k}"})
        here = room.grade(out="here")
        there = room.root / "there"
        run = room.run(room.handed_in, "--chapters", "1", "--time-limit", str(SECONDS_A_TEST), "--slurm", "3",
                       "--out", there)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("an array of 3. Its nodes must see ", run.stdout)
        for name in ("grades.csv", "tests.csv", "summary.md", *(f"submissions/s{k}/{file}" for k in range(5)
                                                               for file in ("results.json", "report.md"))):
            self.assertTrue(filecmp.cmp(here.folder / name, there / name, shallow=False), name)

    def test_an_experiment(self):
        folder, kept = BUILD / "plots" / "energy", self.folder / "kept"
        if folder.exists():
            shutil.move(folder, kept)  # of whoever runs the tests
        try:
            run = run_course("plot", "energy", "--quick", "--slurm", "4", cwd=ROOT)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            self.assertNotIn("failed:", run.stderr)
            logs = sorted((folder / "slurm").glob("*.log"))
            self.assertEqual([log.name for log in logs], ["1.log", "2.log", "3.log", "4.log"])
            for log in logs:
                self.assertIn("is done", log.read_text())
            self.assertTrue((folder / "table.csv").exists())
        finally:
            shutil.rmtree(folder, ignore_errors=True)
            if kept.exists():
                shutil.move(kept, folder)

    def test_a_part_that_fails_is_told(self):
        failed = run_array(["sh", "-c", "echo part @I@; test @I@ -ne 2"], 3, self.folder / "fails", "a test")
        self.assertEqual(list(failed), [2])
        self.assertIn("exit code 1", failed[2])
        self.assertIn("part 2", failed[2])

    def test_a_node_that_dies_costs_its_part_and_no_more(self):
        """The daemon and what it runs are killed, as by a power cut; the node comes back, and the other parts run."""
        marks = self.folder / "marks"
        marks.mkdir()
        code = f"touch {marks}/@I@; if [ @I@ = 1 ]; then echo $$ > {marks}/pid; sleep 300; fi; sleep 1"
        program = (f"import sys; sys.path.insert(0, {str(ROOT / 'tools' / 'course')!r}); from slurm import run_array; "
                   f"from pathlib import Path; print(run_array(['sh', '-c', {code!r}], 5, "
                   f"Path({str(self.folder / 'dies')!r}), 'a test'))")
        waiting = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while not (marks / "pid").exists() and time.monotonic() < deadline:
            time.sleep(0.1)
        self.slurm.cut_the_power(int((marks / "pid").read_text()))
        self.slurm.start_node()
        told, _ = waiting.communicate(timeout=180)
        self.assertEqual({mark.name for mark in marks.iterdir()}, {"pid", "1", "2", "3", "4", "5"}, self.slurm.log())
        failed = eval(told.strip().splitlines()[-1])
        self.assertIn(1, failed)
        self.assertLessEqual(set(failed), {1, 2})  # what ran beside it, too
        self.assertIn("before it ended", failed[1])

    def test_a_refusal_names_the_script(self):
        os.environ["SBATCH_PARTITION"] = "nowhere"
        try:
            with self.assertRaisesRegex(CourseError, f"sbatch refuses the job; its script is {self.folder}/no/part.sh"):
                run_array(["true"], 1, self.folder / "no", "a test")
        finally:
            del os.environ["SBATCH_PARTITION"]

    def test_without_slurm_it_is_said(self):
        path = os.environ["PATH"]
        os.environ["PATH"] = "/nowhere"
        try:
            with self.assertRaisesRegex(CourseError, "sbatch is missing"):
                run_array(["true"], 1, self.folder / "none", "a test")
        finally:
            os.environ["PATH"] = path


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # the node is stopped, whoever ends the test
    unittest.main()
