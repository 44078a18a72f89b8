"""Every stub compiles, in the course's own checks without a warning, and passes no test: all are skipped."""

import concurrent.futures
import itertools
import json
import os
import shlex
import subprocess
import unittest
from pathlib import Path

from sandbox import Exercise, all_exercises

from exercise_object import drop_if_stale
from symbols import reference_functions
from tree import Tree, jobs
from trial import run_tests

CHECK = Tree("check")


def pristine() -> list[Exercise]:
    """Returns the exercises that nobody has begun: others are not tested here."""
    exercises = all_exercises()
    begun = [exercise.label for exercise in exercises if exercise.started()]
    if begun:
        print(f"left out, since they are stubs no more: {', '.join(begun)}")
    return [exercise for exercise in exercises if not exercise.started()]


def strict_command(exercise: Exercise, database: list[dict]) -> tuple[list[str], str] | None:
    """Returns CMake's command for the stub, with warnings as errors, source from stdin, and no object."""
    for entry in database:
        if Path(entry["file"]) == exercise.file:
            words = shlex.split(entry["command"])
            output = words.index("-o")
            del words[output:output + 2]
            words.remove(str(exercise.file))
            return [*words, "-Werror", "-fsyntax-only", "-x", "c++", "-"], entry["directory"]
    return None


class Stubs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stubs = pristine()
        programs = [f"check_{exercise.function}" for exercise in cls.stubs]
        for exercise in cls.stubs:
            drop_if_stale(CHECK, exercise)
        built = CHECK.build(programs or ["spook_reference"], "building the stubs")
        if not built.ok:
            raise AssertionError(built.output)

    @unittest.skipUnless(CHECK.setting("SPOOK_WERROR") == "ON", "stubs compile; warnings count with --strict")
    def test_they_compile_without_a_warning(self):
        """Those of a chapter as one file: what they include takes the compiler longer than they do."""
        database = json.loads((CHECK.path / "compile_commands.json").read_text())
        for stub in self.stubs:
            self.assertIsNotNone(strict_command(stub, database), f"{stub.label} is not compiled by CMake")
        chapters = [list(stubs) for _, stubs in itertools.groupby(self.stubs, key=lambda stub: stub.chapter)]
        with concurrent.futures.ThreadPoolExecutor(jobs()) as pool:
            outcomes = list(pool.map(lambda stubs: self._compile(stubs, database), chapters))
        for stubs, said in zip(chapters, outcomes):
            with self.subTest(stubs[0].folder):
                self.assertEqual(said, "")

    def _compile(self, stubs: list[Exercise], database: list[dict]) -> str:
        command, folder = strict_command(stubs[0], database)
        compiled = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=os.environ | {"LC_ALL": "C"},
                                  input="".join(f'#line 1 "{stub.file}"\n{stub.source()}\n' for stub in stubs))
        return compiled.stderr if compiled.returncode != 0 else ""

    def test_they_pass_nothing(self):
        for exercise in self.stubs:
            with self.subTest(exercise.label):
                trial = run_tests(CHECK.program(f"check_{exercise.function}"), f"{exercise.suite}.*")
                self.assertEqual(trial.exit_code, 0, trial.output)
                self.assertGreater(len(trial.tests or []), 0, f"there are no tests {exercise.suite}.*")
                self.assertEqual([test.name for test in trial.tests if not test.skipped], [])

    def test_the_reference_defines_what_they_stand_for(self):
        for exercise in all_exercises():
            with self.subTest(exercise.label):
                self.assertNotEqual(reference_functions(CHECK, exercise), set())


if __name__ == "__main__":
    unittest.main()
