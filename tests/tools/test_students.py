"""./course export students: the content of the repository, the omitted files, and how a change reaches students."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from classroom import run_course
from sandbox import ROOT

from exporting.students import _write, hints_of
from manifest import listed, read_chapters
from pick import pick_list

CHOSEN = range(1, 3)
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith(("COURSE_", "SPOOK_", "GIT_"))}


def git(folder: Path, *words: str) -> str:
    command = ["git", "-C", str(folder), "-c", "user.name=Student", "-c", "user.email=student@localhost", *words]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def course(folder: Path, *words: str, typed: str = "") -> subprocess.CompletedProcess:
    return subprocess.run([str(folder / "course"), *words], capture_output=True, text=True, cwd=folder,
                          env=ENVIRONMENT, input=typed)


def code_of(file: Path) -> list[str]:
    """Returns lines that contain code."""
    lines = (line.strip() for line in file.read_text(encoding="utf-8", errors="replace").splitlines())
    return [line for line in lines if line and not line.startswith(("//", "#", "template", "}", "namespace"))]


class Students(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="students-")
        cls.addClassCleanup(scratch.cleanup)
        cls.root = Path(scratch.name)
        cls.out = cls.root / "repository"
        cls.exported = cls.export()

    @classmethod
    def export(cls) -> subprocess.CompletedProcess:
        result = run_course("export", "students", "--chapters", "1-2", "--out", cls.out, cwd=cls.root)
        if result.returncode != 0:
            raise AssertionError(result.stderr)
        return result

    def test_no_answer_is_in_it(self):
        """Nor three of an answer's lines in a row, but where the page for instructors says so."""
        texts = {file: "\n".join(code_of(file)) for file in self.out.rglob("*")
                 if file.suffix in (".cpp", ".hpp", ".md", ".py") and ".git" not in file.parts}
        shown = set()
        for chapter in read_chapters():
            for exercise in chapter.exercises:
                lines = code_of(exercise.reference)
                for k in range(len(lines) - 2):
                    three = "\n".join(lines[k:k + 3])
                    shown |= {(exercise.id, file.name) for file, text in texts.items()
                              if len(three) >= 62 and three in text}
        self.assertEqual(shown, {(number, "primal_interior_point.cpp") for number in ("11.6", "11.9")})
        told = " ".join((ROOT / "INSTRUCTORS.md").read_text(encoding="utf-8").split())
        self.assertIn("`primal_interior_point.cpp` has most of 11.6 and 11.9", told)
        self.assertEqual(list(self.out.glob("solutions/[0-9][0-9]_*/*.cpp")), [])
        self.assertEqual(list(self.out.glob("tests/mutants/*/*")), [])
        self.assertEqual(list(self.out.glob("tests/hidden/*/*")), [])

    def test_chosen_chapters_are_stubs_and_others_are_lessons(self):
        for chapter in read_chapters():
            folder = self.out / "chapters" / chapter.folder
            self.assertTrue((folder / "README.md").exists())
            chosen = chapter.number in CHOSEN
            self.assertEqual((folder / "hints.md").exists(), chosen)
            for exercise in chapter.exercises:
                file = folder / exercise.file.name
                self.assertEqual(file.exists(), chosen)
                if chosen:
                    self.assertIn("not_implemented(", file.read_text(encoding="utf-8"))
        listed = (self.out / "solutions" / "compiled" / "exercises.txt").read_text(encoding="utf-8").split()
        self.assertEqual(len(listed), sum(len(chapter.exercises) for chapter in read_chapters() if chapter.number in CHOSEN))

    def test_the_reference_is_there_for_both_trees_without_paths(self):
        machine, = [path for path in (self.out / "solutions" / "compiled").iterdir() if path.is_dir()]
        functions = {exercise.function for chapter in read_chapters() for exercise in chapter.exercises}
        for preset in ("check", "release"):
            objects = list((machine / preset).glob("*.o"))
            self.assertLessEqual(functions, {file.name.partition(".")[0] for file in objects})
            for file in objects:
                self.assertNotIn(str(ROOT).encode(), file.read_bytes(), file.name)

    def test_what_needs_sources_is_refused_in_a_line(self):
        for words, what in ((("solution", "1.1"), "solution"), (("test",), "test"), (("grade", "x"), "grade"),
                            (("exam", "1"), "exam")):
            result = course(self.out, *words)
            self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (1, "", 1), result.stderr)
            self.assertIn("repository for students", result.stderr)
            self.assertIn(what, result.stderr)
        chosen = sum(len(chapter.exercises) for chapter in read_chapters() if int(chapter.folder[:2]) in CHOSEN)
        self.assertIn(f"of {chosen} done", course(self.out).stdout)

    def test_a_change_comes_to_students_as_a_release_and_their_answers_stay(self):
        clone = self.root / "clone"
        git(self.root, "clone", "-q", str(self.out), str(clone))
        answer = (ROOT / "solutions" / "01_leapfrog" / "kick.cpp").read_text(encoding="utf-8")
        (clone / "chapters" / "01_leapfrog" / "kick.cpp").write_text(answer, encoding="utf-8")
        first = re.search(r"Release (\d+\.\d+\.)(\d+)", self.exported.stdout)
        lesson = self.out / "chapters" / "01_leapfrog" / "README.md"
        kept = lesson.read_text(encoding="utf-8")
        self.assertIn(f"Release {first[1]}{first[2]} ", self.export().stdout)  # nothing has changed: no new release
        lesson.write_text(kept + "\nOf an older course.\n", encoding="utf-8")
        git(self.out, "commit", "-qam", "As if the course had been another")
        self.assertIn(f"Release {first[1]}{int(first[2]) + 1} ", self.export().stdout)
        self.assertEqual(lesson.read_text(encoding="utf-8"), kept)
        updated = course(clone, "update")
        self.assertEqual(updated.returncode, 0, updated.stderr)
        self.assertEqual((clone / "chapters" / "01_leapfrog" / "kick.cpp").read_text(encoding="utf-8"), answer)
        self.assertIn(f"VERSION {first[1]}{int(first[2]) + 1}", (clone / "CMakeLists.txt").read_text(encoding="utf-8"))

    def test_an_answer_is_checked_with_the_compiled_reference(self):
        if not shutil.which("ninja"):
            self.skipTest("ninja is not installed")
        clone = self.root / "checked"
        git(self.root, "clone", "-q", str(self.out), str(clone))
        shutil.copyfile(ROOT / "solutions" / "01_leapfrog" / "half_step_start.cpp",
                        clone / "chapters" / "01_leapfrog" / "half_step_start.cpp")
        for words, said in ((("check", "1.3"), "1.3 half_step_start"), (("try", "1.3", "--once"), "v")):
            result = course(clone, *words)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertIn(said, result.stdout)

    def test_what_needs_no_compiler_works(self):
        clone = self.root / "read"
        git(self.root, "clone", "-q", str(self.out), str(clone))
        for words, typed, said in ((("hint", "1.1"), "", "1.1 kick, hint 1 of"), (("predict", "1"), "\n" * 99, "Left for later")):
            result = course(clone, *words, typed=typed)
            self.assertEqual(result.returncode, 0, f"{words}: {result.stdout}{result.stderr}")
            self.assertIn(said, result.stdout)

    def test_nothing_is_missing_of_what_runs_and_draws(self):
        """The programs of run, view, play and plot, with a student's functions and without. They are not compiled here:
        the engine takes minutes."""
        if not shutil.which("ninja"):
            self.skipTest("ninja is not installed")
        clone = self.root / "planned"
        git(self.root, "clone", "-q", str(self.out), str(clone))
        programs = [f"plot_{file.stem}{end}" for file in (ROOT / "plots" / "01_leapfrog").glob("*.cpp") for end in ("", "_mine")]
        self.assertGreater(len(programs), 1)
        for command in (["cmake", "--preset", "release"], ["ninja", "-C", "build/release", "-n", "spook", "spook_mine", *programs]):
            result = subprocess.run(command, capture_output=True, text=True, cwd=clone, env=ENVIRONMENT)
            self.assertEqual(result.returncode, 0, result.stdout[-2000:] + result.stderr)

    def test_what_is_refused(self):
        (self.root / "full").mkdir(exist_ok=True)
        (self.root / "full" / "thesis.txt").write_text("mine")
        for words, told in (((), "--out DIR"), (("--out", "full"), "other than a repository for students"),
                            (("--out", str(ROOT)), "other than a repository for students"),
                            (("--out", str(ROOT / "new")), "in the course itself"),
                            (("--chapters", "99", "--out", "new"), "no chapter 99")):
            result = run_course("export", "students", *words, cwd=self.root)
            self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
            self.assertIn(told, result.stderr)
        self.assertEqual((self.root / "full" / "thesis.txt").read_text(), "mine")


class PartOfAChapter(unittest.TestCase):
    """The files of an export with some exercises of a chapter; the reference's objects are left out here."""

    def test_chosen_exercises_are_stubs_and_listed_and_others_are_not_there(self):
        scratch = tempfile.TemporaryDirectory(prefix="students-")
        self.addCleanup(scratch.cleanup)
        out, objects = Path(scratch.name, "repository"), Path(scratch.name, "objects")
        for folder in (out, objects):
            folder.mkdir()
        chosen = pick_list("1,8.1-8.4,8.9")
        _write(out, chosen, "Linux-x86_64", objects)
        files = {str(file.relative_to(out / "chapters")) for file in (out / "chapters").glob("[0-9][0-9]_*/*.cpp")}
        expected = {f"{one.folder}/{one.file.name}" for one in chosen}
        self.assertEqual(files, expected)
        self.assertEqual(set((out / "solutions" / "compiled" / "exercises.txt").read_text().split()), expected)
        for chapter in read_chapters():
            hints = out / "chapters" / chapter.folder / "hints.md"
            own = [one for one in chapter.exercises if one in chosen]
            found = listed(hints.read_text(encoding="utf-8"), chapter.folder) if hints.exists() else []
            self.assertEqual((found, hints.exists()), (own, bool(own)))
        board = course(out, "progress", "--json")
        self.assertEqual(board.returncode, 0, board.stderr)
        self.assertEqual([one["id"] for one in json.loads(board.stdout)["exercises"]], [one.id for one in chosen])
        refused = course(out, "check", "8.5")
        self.assertEqual((refused.returncode, refused.stderr.count("\n")), (2, 1), refused.stderr)

    def test_the_hints_of_a_whole_chapter_are_as_they_are(self):
        for chapter in read_chapters():
            text = chapter.exercises[0].file.with_name("hints.md").read_text(encoding="utf-8")
            self.assertEqual(hints_of(text, {one.id for one in chapter.exercises}), text)


if __name__ == "__main__":
    unittest.main()
