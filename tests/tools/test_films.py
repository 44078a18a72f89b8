"""The films at the head of the lessons: they exist, are small, move, and show the command below."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from sandbox import ROOT, all_exercises

from films import command, films, milestones, not_shown, own_step

MOST_BYTES = 400_000


class Films(unittest.TestCase):
    def setUp(self):
        self.lessons = {folder: (ROOT / "chapters" / folder / "README.md").read_text(encoding="utf-8")
                        for folder in films() if folder != "README"}

    def test_every_chapter_begins_with_one(self):
        folders = sorted(path.name for path in (ROOT / "chapters").glob("[0-9][0-9]_*"))
        self.assertEqual(sorted(self.lessons), folders)
        for folder, text in self.lessons.items():
            with self.subTest(folder):
                head = text.partition("\n## ")[0]
                self.assertRegex(head, r"!\[[A-Z][^\]]{10,}\]\(film\.webp\)\n\n\*")
                self.assertIn(f"```\n{command(films()[folder])}\n```", head)
        self.assertIn("](plots/film.webp)", (ROOT / "README.md").read_text(encoding="utf-8").partition("\n## ")[0])

    def test_they_move_and_are_small(self):
        for folder in films():
            with self.subTest(folder):
                file = ROOT / ("plots" if folder == "README" else f"chapters/{folder}") / "film.webp"
                data = file.read_bytes()
                self.assertLess(len(data), MOST_BYTES)
                # An animated WebP is a RIFF file with a chunk for the animation, and one for each picture.
                self.assertEqual((data[:4], data[8:12]), (b"RIFF", b"WEBP"))
                self.assertEqual(data.count(b"ANIM"), 1)
                self.assertGreater(data.count(b"ANMF"), 10)  # equal ones are one

    def test_what_is_filmed_runs(self):
        spook = Path(os.environ["COURSE_BUILD"], "release", "solutions", "spook")
        for folder, film in films().items():
            with self.subTest(folder):
                options = list(film["options"])
                options[options.index("--time") + 1] = "0.02"
                done = subprocess.run([spook, "run", film["scene"], *options], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_milestones_are_short_enough_for_the_board(self):
        for folder in self.lessons:
            self.assertTrue(milestones(folder), folder)
            for milestone in milestones(folder):
                self.assertRegex(milestone, r"^\./course view \w+ .*--mine$|^\./course view \w+ --mine$")
                self.assertLessEqual(len(f"  {milestone}"), 80)
        self.assertEqual((milestones("99_nothing"), not_shown("99_nothing")), ([], []))

    def test_milestones_call_every_exercise_of_their_chapter(self):
        """A function that is called and throws ends the run. So each change of it that matters can be seen."""
        spook = Path(os.environ["COURSE_BUILD"], "check", "solutions", "spook_mine")
        for folder in self.lessons:
            exercises = {exercise.function for exercise in all_exercises() if exercise.folder == folder}
            called: set[str] = set()
            own = [own_step(folder).replace("--engine mine", "--engine plain")]
            for milestone in milestones(folder) + own:
                words = milestone.removeprefix("./course view ").removesuffix(" --mine").split()
                with self.subTest(folder, words=words), tempfile.TemporaryDirectory() as scratch:
                    calls, record = Path(scratch, "calls"), Path(scratch, "record")
                    done = subprocess.run([spook, "run", *words, "--record", record, "--fps", "1", "--json"],
                                          capture_output=True, text=True, env=os.environ | {"SPOOK_CALLS": str(calls)})
                    self.assertEqual(done.returncode, 0, done.stderr)
                    if not calls.exists():
                        self.skipTest("this program cannot tell what it calls; see tools/noting.py")
                    called |= set(calls.read_text().split())
            with self.subTest(folder):
                self.assertEqual(exercises - called, set(not_shown(folder)))

    def test_the_wires_of_chapter_11_call_its_solver(self):
        spook = Path(os.environ["COURSE_BUILD"], "check", "solutions", "spook_mine")
        found = re.findall(r"^\./course run (wire .*--solver direct.*)$", self.lessons["11_direct"], re.MULTILINE)
        commands = [line for line in found if "--mine" in line]
        self.assertEqual(len(commands), 2)
        for line in commands:
            words = [*re.sub(r" --time \S+| --mine", "", line).split(), "--time", "0.05"]
            with self.subTest(words=words), tempfile.TemporaryDirectory() as scratch:
                calls = Path(scratch, "calls")
                done = subprocess.run([spook, "run", *words, "--json"], capture_output=True, text=True,
                                      env=os.environ | {"SPOOK_CALLS": str(calls)})
                self.assertEqual(done.returncode, 0, done.stderr)
                if not calls.exists():
                    self.skipTest("this program cannot tell what it calls; see tools/noting.py")
                self.assertLessEqual({"direct_solve", "factorise", "schur_complement"}, set(calls.read_text().split()))

    def test_a_chapter_with_a_step_says_how_to_run_it(self):
        spook = Path(os.environ["COURSE_BUILD"], "release", "solutions", "spook")
        shown = {folder: own_step(folder) for folder in self.lessons if own_step(folder)}
        self.assertEqual(list(shown), list(self.lessons))
        for folder, command in shown.items():
            with self.subTest(folder):
                scene, options = re.fullmatch(r"\./course view (\w+) --engine mine(.*)", command).groups()
                self.assertIn(f"{scene} --engine mine{options}", self.lessons[folder].partition("## Exercises")[2])
                self.assertLessEqual(len(f"  {command}"), 100)
                done = subprocess.run([spook, "run", scene, "--engine", "plain", *options.split(), "--time", "0.05"],
                                      capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                # From chapter 09 on any solver, and any joint, follows step_rows.
                exercise = rf"{int(folder[:2])}\.\d+" if folder < "09" else r"9\.9"
                self.assertRegex(" ".join(done.stdout.split()), rf"plain engine, exercise {exercise} ")


if __name__ == "__main__":
    unittest.main()
