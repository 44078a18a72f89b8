"""./course try: the first file compiles, runs and prints; a save runs it again, on the student's functions."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from sandbox import ROOT, Sandbox, all_exercises

from playground import examples, first_text

BUILD = Path(os.environ.get("COURSE_BUILD") or ROOT / "build")
TWICE = """#include "01_leapfrog/leapfrog.hpp"
namespace spook {
Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) { return v + 2 * h * inverse_mass * f; }
}  // namespace spook
"""


class Examples(unittest.TestCase):
    def test_there_is_one_for_each_exercise_and_no_other(self):
        for folder in sorted({exercise.folder for exercise in all_exercises()}):
            wanted = [exercise.label for exercise in all_exercises() if exercise.folder == folder]
            self.assertEqual(list(examples(folder)), wanted, f"chapters/{folder}/try.md")
        for exercise in all_exercises():
            self.assertRegex(examples(exercise.folder)[exercise.label], rf"\b{exercise.function}[<(]", exercise.label)

    def test_all_of_them_run_on_the_reference(self):
        """In one program, which a compiler does faster than eighty."""
        archive = BUILD / "check" / "solutions" / "libspook_reference.a"
        if not archive.exists():
            self.skipTest(f"{archive} is not built")
        parts, calls = [], []
        for exercise in all_exercises():
            text = first_text(exercise)
            self.assertTrue(text.endswith("}\n"))
            parts.append(text.replace("int main() {", f"static void example_{exercise.function}() {{"))
            calls.append(f'std::cout << "## {exercise.label}\\n"; example_{exercise.function}();')
        with tempfile.TemporaryDirectory() as folder:
            source, program = Path(folder, "all.cpp"), Path(folder, "all")
            source.write_text("\n".join([*parts, "int main() {", *calls, "}"]), encoding="utf-8")
            built = subprocess.run([os.environ.get("CXX") or "c++", "-std=c++20", "-Wall", "-Wextra", "-Werror",
                                    f"-I{ROOT}/chapters", "-isystem", "/usr/include/eigen3", "-isystem",
                                    "/usr/local/include/eigen3", str(source), str(archive), "-o", str(program)],
                                   capture_output=True, text=True)
            self.assertEqual(built.returncode, 0, built.stderr[:3000])
            done = subprocess.run([str(program)], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        printed = dict(re.findall(r"^## (.*)\n((?:(?!## ).*\n)*)", done.stdout, re.MULTILINE))
        for exercise in all_exercises():
            with self.subTest(exercise.label):
                self.assertRegex(printed[exercise.label], r"\A.* =(.|\n)*([0-9]|true|false)")
                self.assertNotRegex(printed[exercise.label], r"\bnan\b")


class Playgrounds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox(built=True)
        cls.addClassCleanup(cls.box.close)
        cls.kick = next(exercise for exercise in all_exercises() if exercise.function == "kick")
        cls.file = cls.box.root / "chapters/01_leapfrog/try/try_kick.cpp"

    def tearDown(self):
        self.box.restore(self.kick)
        self.file.unlink(missing_ok=True)

    def tried(self, *words: str, code: int = 0):
        result = self.box.course("try", *(words or ("1.1",)), "--once")
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        return result

    def test_it_runs_the_reference_and_then_what_the_student_writes(self):
        said = self.tried().stdout
        self.assertIn("everything is the reference", said)
        self.assertIn("v after 0.1 s = (1, 0, -0.981) m/s", said)
        self.box.file(self.kick).write_text(TWICE)
        said = self.tried("kick").stdout
        self.assertIn("Yours, right or wrong: 1.1", said)
        self.assertIn("v after 0.1 s = (1, 0, -1.962) m/s", said)

    def test_it_is_the_students(self):
        self.tried()
        self.file.write_text(self.file.read_text().replace("v after 0.1 s", "mine"))
        self.assertIn("mine = ", self.tried().stdout)
        self.file.unlink()
        self.assertIn("v after 0.1 s", self.tried().stdout)

    def test_git_does_not_see_it(self):
        name = str(self.file.relative_to(self.box.root))
        seen = subprocess.run(["git", "-C", str(ROOT), "check-ignore", "-q", name], capture_output=True)
        if seen.returncode == 128:
            self.skipTest("the course is no repository")
        self.assertEqual(seen.returncode, 0)

    def test_a_save_runs_it_again(self):
        with self.box.start("try", "1.1") as watching:
            watching.wait_for("v after 0.1 s = (1, 0, -0.981) m/s")
            watching.wait_for("Yours to change: chapters/01_leapfrog/try/try_kick.cpp")
            self.file.write_text(self.file.read_text().replace("9.81", "1"))
            watching.wait_for("(1, 0, -0.1) m/s")
            self.file.write_text(self.file.read_text().replace("show(", "shwo(", 1))
            watching.wait_for("try_kick.cpp does not compile")
            self.file.write_text(self.file.read_text().replace("shwo(", "show("))
            watching.wait_for("(1, 0, -0.1) m/s")
            self.box.file(self.kick).write_text(TWICE)
            watching.wait_for("(1, 0, -0.2) m/s")
            code, said = watching.interrupt()
        self.assertEqual(code, 130)
        self.assertNotIn("Traceback", said)

    def test_errors_are_told_by_where_they_are(self):
        self.tried()
        first = self.file.read_text()
        for change, told, last in (
                (first.replace("show(", "shwo(", 1), "01_leapfrog/try/try_kick.cpp:11:", "does not compile"),
                (first.replace("int main() {", "int main() { std::vector<int> none; return none[3];"),
                 "try_kick.cpp:9: an index is past the end of a std::vector",
                 "it fails an assertion of the C++ library"),
                (first.replace("int main() {", "int helper(); int main() { helper();"),
                 "undefined reference to `helper()", "does not compile")):
            self.file.write_text(change)
            said = self.tried(code=1).stderr
            self.assertIn(told, said)
            self.assertIn(last, said.splitlines()[-1])
        self.file.write_text(first)
        for source, told in (("not C++", "1.1 kick does not compile"),
                             ("namespace spook {}", "1.1 kick is not defined in its file")):
            self.box.file(self.kick).write_text(source)
            self.assertIn(told, self.tried(code=1).stderr.splitlines()[-1])

    def test_what_it_says_itself_is_its_exit_code(self):
        self.tried()
        self.file.write_text(self.file.read_text().replace("int main() {", "int main() { return 3;"))
        self.tried(code=3)

    def test_what_makes_no_sense(self):
        self.box.assert_refused(self, ["try", "1"], ["chapter"])
        self.box.assert_refused(self, ["try", "1.9", "--once"], ["1.9"])
        self.box.assert_refused(self, ["try", "kik"], ["kick"])
        self.box.assert_refused(self, ["try"], ["N.M"])


if __name__ == "__main__":
    unittest.main()
