"""The course command without a build: the board, bad input, hints, reset."""

import json
import subprocess
import sys
import unittest

from sandbox import Sandbox, all_exercises

from arguments import _parsers

BAD_INPUT = (
    (["chek", "1.1"], "'chek'", "did you mean check"),
    (["frobnicate"], "'frobnicate'"),
    ([""], "''"),
    (["check", "99.1"], "chapter 99"),
    (["check", "0"], "chapter 0"),
    (["check", "1.99"], "'1.99'", "1.1 to"),
    (["check", "1.0"], "'1.0'"),
    (["check", "1."], "'1.'"),
    (["check", "-1"], "'-1'"),
    (["check", "1.1.1"], "'1.1.1'"),
    (["check", "kik"], "'kik'", "did you mean kick"),
    (["check", "abc\ndef"], r"'abc\ndef'"),
    (["check", "nan"], "'nan'"),
    (["check", "1.1", "1.2"], "'1.2'"),
    (["check", "--sed", "1"], "'--sed'", "did you mean --seed"),
    (["check", "--seed", "x"], "'x'"),
    (["check", "--seed", "-1"], "'-1'"),
    (["check", "--seed", "1e3"], "'1e3'"),
    (["check", "--seed", str(2**64)], str(2**64)),
    (["check", "--seed"], "--seed"),
    (["watch", "12.x"], "'12.x'"),
    (["hint"], "N.M"),
    (["hint", "4"], "'4'"),
    (["hint", "77.1"], "chapter 77"),
    (["hint", "1.1", "--agian"], "'--agian'", "did you mean --again"),
    (["solution", "x"], "'x'"),
    (["reset", "1"], "'1'", "1.1 to"),
    (["reset", "01_leapfrog"], "'01_leapfrog'", "1.1 to"),
    (["reset"], "N.M"),
    (["progress", "--jsn"], "'--jsn'", "did you mean --json"),
    (["progress", "now"], "'now'"),
    (["update", "one"], "'one'"),
    (["update", "--undo", "1.1.0"], "'1.1.0'"),
    (["--version", "now"], "'--version'"),
    (["--jsn"], "'--jsn'"),
    (["start", "--no"], "'--no'"),
    (["test", "quick"], "'quick'"),
    (["plot", "--shard", "1/2"], "--shard", "NAME"),
)


class CourseInput(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox()
        cls.addClassCleanup(cls.box.close)
        cls.exercises = all_exercises()
        cls.first = cls.exercises[0]

    def tearDown(self):
        subprocess.run(["git", "-C", str(self.box.root), "clean", "-fdxq"], check=True)
        self.box.restore(self.first)

    def test_bad_input_is_one_line_that_names_it_and_exit_code_2(self):
        for words, *told in BAD_INPUT:
            self.box.assert_refused(self, words, told)

    def test_python_writes_what_it_compiles_beside_no_source(self):
        before = set((self.box.root / "tools").rglob("*.pyc"))
        self.assertEqual(self.box.course("--version", PYTHONDONTWRITEBYTECODE="1").returncode, 0)
        self.assertEqual(set((self.box.root / "tools").rglob("*.pyc")), before)
        self.assertTrue(list((self.box.root / ".course" / "bytecode").rglob("version.*.pyc")))

    def test_a_command_imports_no_other(self):
        done = subprocess.run([sys.executable, "-X", "importtime", str(self.box.root / "tools" / "course"), "--version"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        imported = {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}
        self.assertIn("arguments", imported)
        # Others would import these files.
        self.assertEqual(imported & {"binding.site", "grading.judge", "mutants", "runs", "verdict"}, set())

    def test_a_fresh_board_is_honest(self):
        result = self.box.course()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn(f"0 of {len(self.exercises)} done.", result.stdout)
        # The chapter to begin with lists its exercises; each of the others has a line.
        self.assertEqual(result.stdout.count("not started"),
                         sum(exercise.chapter == self.first.chapter for exercise in self.exercises))
        self.assertLess(len(result.stdout.splitlines()), 40)
        for chapter in {exercise.chapter for exercise in self.exercises}:
            self.assertRegex(result.stdout, rf"(?m)^{chapter:02} · .* 0 of [0-9]+ done$")
        self.assertIn(f"Next: {self.first.label}", result.stdout)
        self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80)
        self.assertNotIn("\033", result.stdout)

    def test_the_board_as_json(self):
        for words in (["progress", "--json"], ["--json"]):
            board = json.loads(self.box.course(*words).stdout)
            self.assertEqual((board["done"], board["total"]), (0, len(self.exercises)))
            self.assertEqual([(entry["id"], entry["name"], entry["state"]) for entry in board["exercises"]],
                             [(exercise.id, exercise.function, "not started") for exercise in self.exercises])

    def test_symbols_where_letters_are_few(self):
        result = self.box.course(PYTHONIOENCODING="ascii")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("-   1.1", result.stdout)

    def test_from_another_folder_and_through_a_symlink(self):
        link = self.box.root.parent / "link"
        link.symlink_to(self.box.root / "course")
        self.addCleanup(link.unlink)
        there = self.box.course()
        self.assertEqual(self.box.course(cwd="/").stdout, there.stdout)
        self.assertEqual(self.box.course(cwd="/", command=link).stdout, there.stdout)

    def test_a_stub_is_not_started(self):
        for words in (["check"], ["check", "1.1"], ["check", "01.01"], ["check", self.first.function],
                      ["check", self.first.folder]):
            result = self.box.course(*words)
            self.assertEqual((result.returncode, result.stderr), (1, ""))
            self.assertRegex(result.stdout, "not started|Nothing is started")

    def test_what_tab_completes_is_an_exercise_or_a_chapter(self):
        chapter = self.box.root / "chapters" / self.first.folder
        link = self.box.root.parent / "way"
        link.symlink_to(chapter)
        self.addCleanup(link.unlink)
        name, file = self.first.file.name, f"chapters/{self.first.folder}/{self.first.file.name}"
        one = self.box.course("check", "1.1").stdout
        for cwd, words in ((self.box.root, (file, f"./{file}", f"chapters/../{file}", str(self.box.root / file))),
                           (self.box.root / "chapters", (f"{self.first.folder}/{name}",)),
                           (chapter, (name, f"./{name}", f"../{self.first.folder}/{name}", f"try/try_{name}")),
                           (link, (name,))):
            for word in words:
                with self.subTest(cwd=cwd, word=word):
                    result = self.box.course("check", word, cwd=cwd)
                    self.assertEqual((result.stdout, result.stderr), (one, ""))
        whole = self.box.course("check", "1").stdout
        for cwd, word in ((self.box.root, f"chapters/{self.first.folder}/"), (chapter, "."), (chapter, "../01_leapfrog")):
            with self.subTest(cwd=cwd, word=word):
                self.assertEqual(self.box.course("check", word, cwd=cwd).stdout, whole)
        # Each command that takes an exercise takes its file, though it is a link or gone.
        (self.box.root / file).unlink()
        self.assertEqual(self.box.course("reset", name, cwd=chapter).returncode, 0)
        self.assertIn("hint 1", self.box.course("hint", name, cwd=chapter).stdout)
        self.assertEqual(self.box.course("solution", file, "--spoil").returncode, 0)

    def test_a_path_that_leads_to_no_exercise_is_refused(self):
        for words, *told in ((["check", "chapters/01_leapfrog/kik.cpp"], "kik.cpp'", "did you mean kick?"),
                             (["check", "chapters/01_leapfrg"], "01_leapfrg'", "did you mean 01_leapfrog?"),
                             (["check", "chapters/01_leapfrg/"], "01_leapfrg/'", "did you mean 01_leapfrog?"),
                             (["check", "chapters/01_leapfrog/leapfrog.hpp"], "leapfrog.hpp'"),
                             (["check", "/"], "'/'"), (["hint", "chapters/01_leapfrog/"], "is a chapter", "1.1 to"),
                             (["predict", "chapters/01_leapfrog/kick.cpp"], "is not a chapter")):
            self.box.assert_refused(self, words, told)

    def test_a_file_that_is_not_utf_8_is_told_in_one_line(self):
        text = self.first.reference.read_text(encoding="utf-8")
        for encoding, told in (("utf-16", "UTF-16"), ("utf-16-be", "UTF-16"), ("utf-16-le", "UTF-16"),
                               ("utf-32", "UTF-32"), ("utf-32-be", "UTF-32")):
            with self.subTest(encoding):
                self.box.file(self.first).write_text(text, encoding=encoding)
                result = self.box.course("check", "1.1")
                self.assertEqual((result.returncode, result.stderr), (1, ""))
                said = " ".join(result.stdout.split())
                self.assertIn(f"chapters/01_leapfrog/kick.cpp is saved as {told}, and the compiler reads UTF-8: save it",
                              said)
                self.assertIn("1.1 kick is wrong: not saved as UTF-8", said)

    def test_hints_come_one_at_a_time(self):
        count = len(self.first.hints)
        for asked in range(1, count + 2):
            result = self.box.course("hint", "1.1")
            self.assertIn(f"hint {min(asked, count)} of {count}", result.stdout)
            self.assertEqual("was the last" in result.stdout, asked >= count)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("hint 1 of", self.box.course("hint", "1.2").stdout)
        self.assertIn("hint 1 of", self.box.course("hint", "1.1", "--again").stdout)
        self.assertIn("hint 2 of", self.box.course("hint", "1.1").stdout)

    def test_a_broken_hint_memory_is_forgotten(self):
        (self.box.root / ".course").mkdir()
        for memory in ("", "[]", '{"hints": 3}', '{"hints": {"1.1": "x"}}', '{"hints": {"1.1": 99}}', "\0"):
            (self.box.root / ".course" / "state.json").write_text(memory)
            result = self.box.course("hint", "1.1")
            self.assertEqual((result.returncode, result.stderr), (0, ""), memory)

    def test_reset_keeps_every_answer_and_restores_the_stub(self):
        file = self.box.file(self.first)
        stub = file.read_bytes()
        for number, answer in enumerate(("one\n", "two\n"), 1):
            file.write_text(answer)
            result = self.box.course("reset", "1.1")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn(f"{file.name}.mine-{number}", result.stdout)
            self.assertEqual(file.read_bytes(), stub)
        kept = [file.with_name(f"{file.name}.mine-{k}").read_text() for k in (1, 2)]
        self.assertEqual(kept, ["one\n", "two\n"])
        self.assertIn("already", self.box.course("reset", "1.1").stdout)
        self.assertFalse(file.with_name(f"{file.name}.mine-3").exists())

    def test_reset_brings_back_a_deleted_file(self):
        file = self.box.file(self.first)
        stub = file.read_bytes()
        file.unlink()
        self.assertEqual(self.box.course("reset", "1.1").returncode, 0)
        self.assertEqual(file.read_bytes(), stub)

    def test_reset_finds_the_stub_behind_a_committed_answer(self):
        file = self.box.file(self.first)
        stub = file.read_bytes()
        file.write_text("// not_implemented(): no longer\n")
        git = ["git", "-C", str(self.box.root), "-c", "user.name=S", "-c", "user.email=s@localhost"]
        subprocess.run([*git, "commit", "-qam", "Mine"], check=True)
        self.addCleanup(subprocess.run, [*git, "reset", "-q", "--hard", "HEAD~1"], check=True)
        self.assertEqual(self.box.course("reset", "1.1").returncode, 0)
        self.assertEqual(file.read_bytes(), stub)

    def test_reset_without_history(self):
        (self.box.root / ".git").rename(self.box.root.parent / "history")
        try:
            self.box.file(self.first).write_text("mine\n")
            result = self.box.course("reset", "1.1", GIT_CEILING_DIRECTORIES=str(self.box.root.parent))
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
            self.assertEqual(self.box.file(self.first).read_text(), "mine\n")
        finally:
            (self.box.root.parent / "history").rename(self.box.root / ".git")

    def test_the_solution_is_kept_back_until_it_is_asked_for(self):
        refused = self.box.course("solution", "1.1")
        self.assertEqual((refused.returncode, refused.stderr), (1, ""))
        self.assertIn("--spoil", refused.stdout)
        shown = self.box.course("solution", "1.1", "--spoil")
        self.assertEqual(shown.returncode, 0)
        self.assertIn(self.first.reference.read_text(), shown.stdout)

    def test_help(self):
        commands = set(_parsers()[1]) - {"run", "scenes"}  # theirs is the engine's: see test_course_run.py
        for words in (["--help"], ["-h"], *([command, "--help"] for command in sorted(commands))):
            result = self.box.course(*words)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80)


if __name__ == "__main__":
    unittest.main()
