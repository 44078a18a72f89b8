"""The version, stated once; the content of a release; and the notes about it."""

import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path

from sandbox import ROOT, our_files

from needs import BROWSER_NEEDS, LIVE_NEEDS, VIEW_NEEDS
from test_libcxx import PACKAGES
from version import stated_in, version

_IDENTITY = ("-c", "user.name=S", "-c", "user.email=s@localhost", "-c", "commit.gpgsign=false")


class Version(unittest.TestCase):
    def test_it_is_stated_once(self):
        """Everything else reads CMakeLists.txt. Only the list of changes and tests name releases."""
        stating = re.compile(rf"(?i)version\W{{1,4}}v?{re.escape(version())}\b")
        kinds = (".txt", ".py", ".toml", ".cff", ".json", ".yml", ".cmake")
        files = [name for name in our_files() if name.suffix in kinds and name.parts[0] != "tests"]
        found = [str(name) for name in files
                 if any(stating.search(line) and "such as" not in line
                        for line in (ROOT / name).read_text(encoding="utf-8").splitlines())]
        self.assertEqual(found, ["CMakeLists.txt"])

    def test_the_python_module_and_the_examples_have_it_too(self):
        sys.path.append(str(ROOT / "tools" / "python"))
        self.addCleanup(sys.path.pop)
        import backend
        self.assertEqual(backend.VERSION, version())
        for page in ("README.md", "solutions/engine/README.md"):
            asked = re.search(r"find_package\(spook (\d+\.\d+)", (ROOT / page).read_text(encoding="utf-8"))[1]
            self.assertEqual(asked.split(".")[0], version().split(".")[0], page)
            self.assertLessEqual(int(asked.split(".")[1]), int(version().split(".")[1]), page)

    def test_a_file_without_one(self):
        self.assertEqual(stated_in("cmake_minimum_required(VERSION 3.22)\nproject(x LANGUAGES CXX)\n"), "")


class Papers(unittest.TestCase):
    def text(self, name: str) -> str:
        return (ROOT / name).read_text(encoding="utf-8")

    def test_changes_have_an_unreleased_part_and_then_releases_newest_first(self):
        headings = re.findall(r"^## (.+)$", self.text("CHANGELOG.md"), re.MULTILINE)
        self.assertEqual(headings[0], "Unreleased")
        self.assertIn(version(), headings)
        numbers = [tuple(map(int, heading.split("."))) for heading in headings[1:]]
        self.assertEqual(numbers, sorted(numbers, reverse=True))

    def test_each_part_tells_all_three_kinds_of_users(self):
        for part in re.split(r"^## ", self.text("CHANGELOG.md"), flags=re.MULTILINE)[1:]:
            for whom in ("Students:", "Instructors:", "Users of the library:"):
                self.assertIn(f"\n{whom}", part)

    def test_licenses_are_named_alike(self):
        self.assertTrue(self.text("LICENSE").startswith("MIT License"))
        self.assertIn("CC BY 4.0", self.text("LICENSE-TEXT"))
        self.assertIn("MIT License", self.text("LICENSE-TEXT"))
        self.assertRegex(self.text("README.md"), r"\[MIT License\]\(LICENSE\).*CC BY 4\.0.*\(LICENSE-TEXT\)")
        self.assertRegex(self.text("CITATION.cff"), r"license:\n  - MIT\n  - CC-BY-4\.0\n")

    def test_the_workflows_call_what_there_is(self):
        workflow = self.text(".github/workflows/publish.yml")
        for command in re.findall(r"run: (?:python3 (\S+\.py)|\./(course))",
                                  workflow + self.text(".github/workflows/releases.yml")):
            self.assertTrue((ROOT / (command[0] or command[1])).exists(), command)
        self.assertIn("tools/release.py --out dist", workflow)
        self.assertIn("notes-file dist/notes.md", workflow)

    def test_the_job_of_live_figures_skips_no_test(self):
        job = self.text(".github/workflows/releases.yml").partition("\n  live:\n")[2].partition("\n  libcxx:\n")[0]
        for need in (*LIVE_NEEDS, *VIEW_NEEDS, *BROWSER_NEEDS):
            self.assertRegex(job, rf"[ \n]{re.escape(need.package)}[ \n]")
        called = re.search(r"for test in ([\w ]+);", job)[1].split()
        self.assertEqual(set(called), {file.stem.removeprefix("test_") for file in ROOT.glob("tests/tools/test_live_*.py")})
        self.assertIn("grep -qx OK log", job)  # unittest says "OK (skipped=1)" otherwise

    def test_the_job_of_libcxx_skips_no_test(self):
        job = self.text(".github/workflows/releases.yml").partition("\n  libcxx:\n")[2].partition("\n  mac:\n")[0]
        for package in re.split(", | and ", PACKAGES):
            self.assertRegex(job, rf"[ \n]{re.escape(package)}[ \n]")
        self.assertRegex(job, r"test_libcxx\.py .*\| tee log\n +grep -qx OK log\n")


class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="release-")
        self.addCleanup(folder.cleanup)
        self.here = Path(folder.name).resolve() / "course"
        # Without folders such as grading, which a release does not ask.
        shutil.copytree(ROOT / "tools" / "course", self.here / "tools" / "course",
                        ignore=shutil.ignore_patterns("__pycache__", "[a-z]*ing"))
        for name in ("tools/release.py", "CMakeLists.txt", "CHANGELOG.md"):
            shutil.copy2(ROOT / name, self.here / name)
        self.git("init", "-q")
        self.git("add", "-A")
        self.git("commit", "-qm", "Course")

    def git(self, *words: str) -> None:
        subprocess.run(["git", "-C", str(self.here), *_IDENTITY, *words], check=True, capture_output=True)

    def release(self, *words: str) -> subprocess.CompletedProcess:
        return subprocess.run([sys.executable, str(self.here / "tools" / "release.py"), *words], capture_output=True,
                              text=True, cwd=self.here)

    def refused(self, *told: str) -> None:
        done = self.release("--out", "dist")
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
        for text in told:
            self.assertIn(text, done.stderr)
        self.assertFalse((self.here / "dist").exists())

    def test_the_archive_holds_what_is_committed_and_the_notes_what_changes(self):
        self.git("tag", f"v{version()}")
        (self.here / "mine.txt").write_text("not committed\n")
        self.assertEqual(self.release().stdout, f"{version()} can be released\n")
        done = self.release("--out", "dist")
        self.assertEqual(done.returncode, 0, done.stderr)
        name = f"spook-course-{version()}"
        with tarfile.open(self.here / "dist" / f"{name}.tar.gz") as archive:
            names = archive.getnames()
        self.assertIn(f"{name}/CMakeLists.txt", names)
        self.assertNotIn(f"{name}/mine.txt", names)
        notes = (self.here / "dist" / "notes.md").read_text(encoding="utf-8")
        self.assertIn("Students:", notes)
        self.assertNotIn("## ", notes)

    def test_a_tag_that_is_not_the_version_is_refused(self):
        self.refused("no tag", f"tag it v{version()}")
        self.git("tag", "v9.9.9")
        self.refused("the tag v9.9.9", f"tag it v{version()}")

    def test_a_release_without_a_word_about_it_is_refused(self):
        self.git("tag", f"v{version()}")
        (self.here / "CHANGELOG.md").write_text(f"## Unreleased\n\n- x\n\n## {version()}\n\n## 0.1.0\n\n- y\n")
        self.refused("CHANGELOG.md", f"'## {version()}'")


if __name__ == "__main__":
    unittest.main()
