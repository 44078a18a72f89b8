"""Every stub compiles, where the course is held to it without a warning, and passes no test: all are skipped."""

import concurrent.futures
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
    """Exercises that someone has begun to write are none of this test's business."""
    exercises = all_exercises()
    begun = [exercise.label for exercise in exercises if exercise.started()]
    if begun:
        print(f"left out, since they are stubs no more: {', '.join(begun)}")
    return [exercise for exercise in exercises if not exercise.started()]


def strict_command(exercise: Exercise, database: list[dict]) -> tuple[list[str], str] | None:
    """How CMake compiles the stub, with warnings as errors, without an object as result."""
    for entry in database:
        if Path(entry["file"]) == exercise.file:
            words = shlex.split(entry["command"])
            output = words.index("-o")
            del words[output:output + 2]
            return [*words, "-Werror", "-fsyntax-only"], entry["directory"]
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
        database = json.loads((CHECK.path / "compile_commands.json").read_text())
        with concurrent.futures.ThreadPoolExecutor(jobs()) as pool:
            outcomes = list(pool.map(lambda exercise: self._compile(exercise, database), self.stubs))
        for exercise, said in zip(self.stubs, outcomes):
            with self.subTest(exercise.label):
                self.assertEqual(said, "")

    def _compile(self, exercise: Exercise, database: list[dict]) -> str:
        found = strict_command(exercise, database)
        if not found:
            return "is not compiled by CMake"
        command, folder = found
        compiled = subprocess.run(command, cwd=folder, capture_output=True, text=True,
                                  env=os.environ | {"LC_ALL": "C"})
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
