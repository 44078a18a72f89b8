"""kill.py accepts a failed check with the mutant's words, and nothing else."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from sandbox import TOOLS

KILL = TOOLS / "mutants" / "kill.py"
HEADER = "// Wrong: half a kick.\n// Killed by: Kick.Adds\n// Says: this is half\n//   a kick\nint x;\n"
PROGRAM = """#!{python}
import json, os, sys, time
print("[ RUN      ] Kick.Adds", flush=True)
{body}
report = next(word.split("json:")[1] for word in sys.argv if word.startswith("--gtest_output="))
tests = {tests}
json.dump({{"testsuites": [{{"name": "Kick", "testsuite": tests}}] if tests else []}}, open(report, "w"))
sys.exit({code})
"""
FAILED = {"name": "Adds", "status": "RUN", "result": "COMPLETED",
          "failures": [{"failure": "f.cpp:1\nFailed\n  This text: this is\n  half a kick.", "type": ""}]}


class KillMutant(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name, "01_leapfrog")
        self.folder.mkdir()

    def kill(self, *, header=HEADER, name="kick.half.cpp", body="", tests=(FAILED,), code=1):
        """Returns the exit code and the output; for several mutants if the folder has several."""
        (self.folder / name).write_text(header)
        program = self.folder / "mutants_01_leapfrog"
        program.write_text(PROGRAM.format(python=sys.executable, body=body, tests=list(tests), code=code))
        program.chmod(0o755)
        files = sorted(str(file) for file in self.folder.glob("*.*"))
        result = subprocess.run([sys.executable, str(KILL), str(self.folder), *files],
                                capture_output=True, text=True, env=os.environ | {"COURSE_TIME_LIMIT": "1"})
        return result.returncode, result.stderr, result.stdout

    def assert_refused(self, reason: str, **mutant):
        code, said, count = self.kill(**mutant)
        self.assertEqual(code, 1, said)
        self.assertIn(reason, said)
        self.assertEqual(said.count("\n"), 1, said)
        self.assertIn(count, ("0 of 1 mutants killed\n", ""))

    def test_a_failure_that_says_the_promised_text(self):
        self.assertEqual(self.kill(), (0, "", "1 of 1 mutants killed\n"))

    def test_the_program_is_told_which_mutant(self):
        (self.folder / "kick.diff").write_text(
            '@@ third @@ a third. Killed by Kick.Adds, which says "half a kick"\n'
            "-  return v + h * inverse_mass * f;\n+  return v;\n\n"
            '@@ whole @@ a whole. Killed by Kick.Adds, which says "half a kick"\n'
            "-  return v + h * inverse_mass * f;\n+  return f;\n")
        code, said, count = self.kill(body="if os.environ['SPOOK_MUTANT'] != 'half_of_kick': sys.exit(0)")
        self.assertEqual((code, count), (1, "1 of 3 mutants killed\n"))
        self.assertRegex(said, r"\A.*kick\.diff:1: third: .*\n.*kick\.diff:5: whole: .*\n\Z")
        self.assertEqual(self.kill(), (0, "", "3 of 3 mutants killed\n"))

    def test_a_mutant_that_passes(self):
        self.assert_refused("the mutant lives", tests=[FAILED | {"failures": []}], code=0)

    def test_a_right_answer_passes_all_tests_of_its_exercise(self):
        right = {"header": "// Right: in another order.\nint x;\n", "tests": [FAILED | {"failures": []}]}
        self.assertEqual(self.kill(**right, code=0), (0, "", "0 of 0 mutants killed, 1 of 1 right answers passed\n"))
        for reason, other in (("Kick.Adds refuses it: f.cpp:1 Failed This text", {"tests": [FAILED], "code": 1}),
                              ("Kick.Adds refuses it", {"tests": [FAILED | {"result": "SKIPPED", "failures": []}]}),
                              ("the exit code is 3", {"code": 3}), ("ended early", {"tests": [], "code": 0})):
            with self.subTest(reason):
                code, said, count = self.kill(**right | {"code": 0} | other)
                self.assertEqual((code, count), (1, "0 of 0 mutants killed, 0 of 1 right answers passed\n"))
                self.assertIn(reason, said)

    def test_a_failure_that_says_something_else(self):
        other = FAILED | {"failures": [{"failure": "f.cpp:1\nFailed\nwrong", "type": ""}]}
        self.assert_refused("does not say 'this is half a kick'", tests=[other])

    def test_a_crash(self):
        self.assert_refused("crashed (SIGSEGV)", body="os.kill(os.getpid(), 11)")

    def test_a_loop(self):
        self.assert_refused("not done after 1 s", body="time.sleep(30)")

    def test_an_early_exit(self):
        self.assert_refused("ended the program", body="os._exit(0)")

    def test_a_skip(self):
        self.assert_refused("was skipped", tests=[FAILED | {"result": "SKIPPED", "failures": []}], code=0)

    def test_a_test_that_does_not_exist(self):
        self.assert_refused("there is no test Kick.Adds", tests=[], code=0)

    def test_a_header_without_its_promise(self):
        self.assert_refused("must have 'Wrong: ...', 'Killed by: ...', 'Says: ...'",
                            header="// Wrong: a\n// Killed by: Kick.Adds\n")

    def test_a_test_of_another_exercise(self):
        self.assert_refused("is not a test of 1.2 drift", name="drift.half.cpp")

    def test_an_exercise_that_does_not_exist(self):
        self.assert_refused("has no exercise punch", name="punch.half.cpp")

    def test_files_that_do_not_exist(self):
        result = subprocess.run([sys.executable, str(KILL), str(self.folder), str(self.folder / "kick.diff")],
                                capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)


if __name__ == "__main__":
    unittest.main()
