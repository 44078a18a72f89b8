"""./course export students: the content of the repository, the omitted files, and how a change reaches students."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from classroom import run_course
from sandbox import ROOT, Sandbox

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


# Runs the command without a compiler: its objects are none.
_UNCOMPILED = """
import runpy, sys
sys.path.insert(0, "tools/course")
from exporting import students
students._compile = lambda preset, folder: folder.mkdir()
runpy.run_path("tools/course", run_name="__main__")
"""


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
        git(self.out, "tag", "-f", f"v{first[1]}{first[2]}")
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


class Again(unittest.TestCase):
    """A second export, after the instructor has added or changed files; without objects."""

    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox()
        cls.addClassCleanup(cls.box.close)

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="students-")
        self.addCleanup(scratch.cleanup)
        self.addCleanup(git, self.box.root, "clean", "-qfdx")
        self.addCleanup(git, self.box.root, "reset", "-q", "--hard")
        self.out = Path(scratch.name, "repository")
        self.exported()

    def run_export(self) -> subprocess.CompletedProcess:
        return subprocess.run([sys.executable, "-c", _UNCOMPILED, "export", "students", "--chapters", "1", "--out",
                               str(self.out)], capture_output=True, text=True, cwd=self.box.root, env=ENVIRONMENT)

    def exported(self) -> subprocess.CompletedProcess:
        done = self.run_export()
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def refused(self, *told: str) -> None:
        before = git(self.out, "status", "--porcelain"), git(self.out, "tag")
        done = self.run_export()
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
        for text in told:
            self.assertIn(text, done.stderr)
        self.assertEqual((git(self.out, "status", "--porcelain"), git(self.out, "tag")), before)

    def add(self, **files: str) -> None:
        """Commits files in the repository; `__` in a name stands for a dot."""
        for name, text in files.items():
            place = self.out / name.replace("__", ".")
            place.write_text(text, encoding="utf-8")
            git(self.out, "add", str(place))
        git(self.out, "commit", "-qm", "By hand")

    def change_course(self, line: str) -> None:
        with open(self.box.root / "README.md", "a", encoding="utf-8") as page:
            page.write(f"\n{line}\n")

    def test_untracked_files_are_left_out_and_named(self):
        for name in ("submissions/ann/kick.cpp", "marks/grades.csv", "marks-2/grades.csv", "exam/exam.md", "class.csv",
                     "points.csv", "solutions/01_leapfrog/kick.cpp~", "solutions/01_leapfrog/kick.cpp.orig",
                     "solutions/01_leapfrog/.kick.cpp.swp", "zoo.txt"):
            (self.box.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.box.root / name).write_text("secret")
        told = self.exported().stderr
        self.assertEqual(told, "4 untracked files were left out: class.csv, exam/exam.md, points.csv, ... "
                               "(git add FILE takes one in)\n")
        self.assertEqual([file for file in self.out.rglob("*") if file.is_file() and file.read_bytes() == b"secret"], [])

    def test_what_was_added_there_stays_in_each_further_export(self):
        (self.out / ".github" / "workflows").mkdir(parents=True)
        (self.out / ".github" / "workflows" / "classroom.yml").write_text("on: push\n")
        git(self.out, "add", ".github")
        self.add(LAB__md="Room 3\n")
        (self.out / "draft.txt").write_text("not committed")
        gone = self.box.root / "chapters" / "02_quaternions" / "README.md"
        gone.unlink()
        for line in ("One.", "Two."):
            self.change_course(line)
            self.exported()
            self.assertIn(line, git(self.out, "show", "HEAD:README.md"))
            self.assertEqual(git(self.out, "show", "HEAD:LAB.md"), "Room 3\n")
            self.assertEqual(git(self.out, "show", "HEAD:.github/workflows/classroom.yml"), "on: push\n")
            self.assertFalse((self.out / gone.relative_to(self.box.root)).exists())
            self.assertEqual(git(self.out, "status", "--porcelain"), "?? draft.txt\n")
        self.assertEqual(len(git(self.out, "tag").split()), 3)
        self.assertIn("Release " + git(self.out, "tag").split()[-1][1:], self.exported().stdout)  # nothing new

    def test_what_was_changed_there_is_named_and_stays(self):
        self.add(README__md="Another course\n")
        self.change_course("One.")
        tag = git(self.out, "tag").strip()
        self.refused("1 file in ", f"has changed since {tag} and", ": README.md;")
        self.assertEqual((self.out / "README.md").read_text(), "Another course\n")
        (self.out / "CHANGELOG.md").write_text("not committed\n")
        self.refused("2 files in ", "CHANGELOG.md, README.md;")
        git(self.out, "checkout", "-q", tag, "--", "README.md", "CHANGELOG.md")
        self.exported()

    def test_a_file_of_theirs_whose_name_the_course_takes_is_named(self):
        self.add(LAB__md="Room 3\n")
        (self.box.root / "LAB.md").write_text("The course's\n")
        git(self.box.root, "add", "LAB.md")
        self.refused("LAB.md")

    def test_an_interrupted_export_does_not_block_the_next(self):
        self.change_course("One.")
        (self.out / "README.md").write_bytes((self.box.root / "README.md").read_bytes())
        lists = self.out / "CMakeLists.txt"
        lists.write_text(re.sub(r"(project\(\w+ VERSION \d+)\.\d+", r"\1.77", lists.read_text()))
        self.exported()
        self.assertIn("One.", git(self.out, "show", "HEAD:README.md"))

    def test_an_export_without_a_list_of_its_files_is_taken_as_a_whole(self):
        tag = git(self.out, "tag").strip()
        (self.out / "old.txt").write_text("of an older course\n")
        git(self.out, "rm", "-q", "solutions/compiled/files.txt")
        git(self.out, "add", "old.txt")
        git(self.out, "commit", "-qm", "As if an older course had made it")
        git(self.out, "tag", "-f", tag)
        self.exported()
        self.assertFalse((self.out / "old.txt").exists())


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
