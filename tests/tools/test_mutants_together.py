"""The mutants of an exercise are those of its .diff and its files, each with its own name."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from sandbox import ROOT, TOOLS, CourseError

sys.path.insert(0, str(TOOLS / "mutants"))

from answers import read_answers  # noqa: E402


class Answers(unittest.TestCase):
    DIFF = '@@ half @@ kicks half. Killed by Kick.Adds, which says "half"\n'
    CHANGE = "-  return v + h * inverse_mass * f;\n+  return v;\n"
    HEADER = "// Wrong: kicks half.\n// Killed by: Kick.Adds\n// Says: half\n//   of it\n"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name, "01_leapfrog")
        self.folder.mkdir()

    def written(self, **texts: str) -> list[Path]:
        files = {self.folder / name.replace("__", "."): text for name, text in texts.items()}
        for file, text in files.items():
            file.write_text(text)
        return list(files)

    def assert_refused(self, reason: str, **texts: str):
        with self.assertRaises(CourseError) as caught:
            read_answers(self.written(**texts))
        self.assertIn(reason, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def test_changes_and_files(self):
        files = self.written(kick__third__cpp=self.HEADER + "int x;\n", kick__diff=self.DIFF + self.CHANGE)
        found = read_answers(files)
        self.assertEqual([(answer.name, answer.line, answer.says) for answer in found],
                         [("half", 1, "half"), ("third", 1, "half of it")])

    def test_a_name_that_is_taken(self):
        self.assert_refused("kick.half.cpp:1: half: this name is taken by", kick__diff=self.DIFF + self.CHANGE,
                            kick__half__cpp=self.HEADER + "int x;\n")
        self.assert_refused("kick.diff:5: half: this name is taken by",
                            kick__diff=f"{self.DIFF}{self.CHANGE}\n{self.DIFF}{self.CHANGE}")

    def test_what_changes_nothing(self):
        same = self.CHANGE.splitlines()[0] + self.CHANGE.splitlines()[0].replace("-", "\n+", 1) + "\n"
        self.assert_refused("kick.diff:1: half: it changes nothing", kick__diff=self.DIFF + same)
        reference = (ROOT / "solutions/01_leapfrog/kick.cpp").read_text()
        self.assert_refused("kick.same.cpp:1: same: it changes nothing", kick__same__cpp=self.HEADER + reference)

    def test_a_file_without_its_promise(self):
        self.assert_refused("kick.half.cpp:1: half: the comment at the top must have",
                            kick__half__cpp="// Wrong: a\n// Killed by: Kick.Adds\nint x;\n")

    def test_an_exercise_that_does_not_exist(self):
        self.assert_refused("01_leapfrog has no exercise punch", punch__diff=self.DIFF + self.CHANGE)

    def test_the_build_stops_with_one_line(self):
        files = self.written(kick__diff=self.DIFF + "-  return w;\n")
        tool = TOOLS / "mutants" / "together.py"
        result = subprocess.run([sys.executable, str(tool), "source", str(self.folder / "all.cpp"), *map(str, files)],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"\A.*kick\.diff:2: half: this is not in solutions/\S+/kick\.cpp: return w;\n\Z")


if __name__ == "__main__":
    unittest.main()
