"""./course update: in every state of a student's folder, everything that the student wrote is kept."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from sandbox import ROOT, all_exercises, all_files
from reset import stub_of
from version import stated_in

KICK, DRIFT = "chapters/01_leapfrog/kick.cpp", "chapters/01_leapfrog/drift.cpp"
HEADER, HINTS = "chapters/01_leapfrog/leapfrog.hpp", "chapters/01_leapfrog/hints.md"
TESTS = "tests/01_leapfrog/kick_drift_start_test.cpp"
MINE = '#include "01_leapfrog/leapfrog.hpp"\n// mine\n'
# The small course that is released.
_TOP = ("course", "CMakeLists.txt", ".gitignore", ".gitattributes", "README.md", "CMakePresets.json")
_FOLDERS = ("tools/course/", "chapters/common/", "chapters/01_", "chapters/02_", "tests/01_", "tests/02_")
_IDENTITY = {"GIT_AUTHOR_NAME": "S", "GIT_AUTHOR_EMAIL": "s@localhost", "GIT_COMMITTER_NAME": "S",
             "GIT_COMMITTER_EMAIL": "s@localhost", "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}


def git(folder: Path, *words: str) -> str:
    done = subprocess.run(["git", "-C", str(folder), *words], capture_output=True, text=True,
                          env=os.environ | _IDENTITY)
    if done.returncode != 0:
        raise AssertionError(f"git {' '.join(words)}: {done.stderr}")
    return done.stdout.rstrip("\n")


def snapshot(folder: Path) -> dict[str, bytes]:
    """Returns all files but git's own, and but Python's bytecode, which every command may write."""
    def counts(name: Path) -> bool:
        return ".git" not in name.parts and not name.is_relative_to(".course/bytecode")

    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and counts(path.relative_to(folder))}


def write(folder: Path, name: str, text: str) -> None:
    (folder / name).parent.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(text, encoding="utf-8")


def edit(folder: Path, name: str, old: str, new: str) -> None:
    text = (folder / name).read_text(encoding="utf-8")
    assert old in text, (name, old)
    write(folder, name, text.replace(old, new))


def release(folder: Path, version: str) -> None:
    edit(folder, "CMakeLists.txt", f"VERSION {_stated(folder)}", f"VERSION {version}")
    git(folder, "add", "-A")
    git(folder, "commit", "-qm", f"Release {version}")
    git(folder, "tag", f"v{version}")


def _stated(folder: Path) -> str:
    return stated_in((folder / "CMakeLists.txt").read_text(encoding="utf-8"))


class Updating(unittest.TestCase):
    """An original with release 1.0.0, a small course: its command, two chapters, their tests."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="update-")
        cls.addClassCleanup(folder.cleanup)
        cls.first = Path(folder.name).resolve() / "first"
        stubs = {exercise.file.relative_to(ROOT): exercise for exercise in all_exercises()}
        for name in all_files():
            path = name.as_posix()
            if not (path in _TOP or path.startswith(_FOLDERS)) or path.endswith((".webp", ".svg")):
                continue
            (cls.first / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, cls.first / name)
            if name in stubs and stubs[name].started():
                (cls.first / name).write_bytes(stub_of(stubs[name]))
        git(cls.first, "init", "-q", "-b", "main")
        edit(cls.first, "CMakeLists.txt", f"VERSION {_stated(cls.first)}", "VERSION 0.9.0")
        release(cls.first, "1.0.0")

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="update-")
        self.addCleanup(folder.cleanup)
        self.here = Path(folder.name).resolve()
        self.original, self.mine = self.here / "original", self.here / "course"
        git(self.here, "clone", "-q", str(self.first), str(self.original))
        git(self.here, "clone", "-q", str(self.original), str(self.mine))

    def release(self, version: str = "1.1.0") -> None:
        """A release with another header, tests, lesson and stub of chapter 1, a new file, and one file less."""
        edit(self.original, HEADER, "#pragma once", "#pragma once\n// New.")
        edit(self.original, TESTS, "Kick", "Kick /* new */")
        edit(self.original, DRIFT, "// Eq.", "// New: Eq.")
        edit(self.original, "chapters/01_leapfrog/README.md", "# 01", "# 01 (new)")
        write(self.original, "chapters/01_leapfrog/new.txt", "new\n")
        (self.original / "chapters/02_quaternions/try.md").unlink()
        release(self.original, version)

    def course(self, *words: str, folder: Path | None = None, **env: str):
        return subprocess.run([str((folder or self.mine) / "course"), "update", *words], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, cwd=folder or self.mine, env=os.environ | _IDENTITY | env)

    def updated(self, *words: str, folder: Path | None = None, **env: str) -> str:
        done = self.course(*words, folder=folder, **env)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        for name, content in snapshot(folder or self.mine).items():
            if name.endswith((".cpp", ".hpp", ".md")):
                self.assertNotIn(b"<<<<<<<", content, name)
        return done.stdout

    def refused(self, *words: str, code: int = 1, folder: Path | None = None, lines: int = 1, **env: str) -> str:
        """Expects one line of refusal, and no change."""
        before = snapshot(folder or self.mine)
        done = self.course(*words, folder=folder, **env)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertEqual(sum(line.startswith("course: ") for line in done.stderr.splitlines()), 1, done.stderr)
        if lines:
            self.assertEqual(done.stderr.count("\n"), lines, done.stderr)
        self.assertEqual(snapshot(folder or self.mine), before)
        return done.stderr

    def text(self, name: str, folder: Path | None = None) -> str:
        return ((folder or self.mine) / name).read_text(encoding="utf-8")

    def write(self, name: str, text: str) -> None:
        write(self.mine, name, text)

    def commit(self, *names: str) -> None:
        git(self.mine, "add", "--", *names)
        git(self.mine, "commit", "-qm", "Mine")

    def assert_is_release(self, version: str = "1.1.0", but: tuple[str, ...] = (), more: tuple[str, ...] = ()) -> None:
        """Expects that every file is the release's, `but` for these, and there are `more`."""
        want = self.here / f"want-{version}"
        if not want.exists():
            git(self.original, "worktree", "add", "-q", "--detach", str(want), f"v{version}")
        wanted, found = snapshot(want), snapshot(self.mine)
        differing = {name for name in wanted.keys() | found.keys() if wanted.get(name) != found.get(name)}
        self.assertEqual(differing, {*but, *more})

    def undone(self, before: dict[str, bytes]) -> None:
        self.updated("--undo")
        self.assertEqual(snapshot(self.mine), before)


class WithoutAnythingWritten(Updating):
    def test_it_becomes_the_release(self):
        self.release()
        said = self.updated()
        self.assertIn("from 1.0.0 to 1.1.0, by origin", said)
        self.assertIn("1 new, 1 removed", said)
        self.assert_is_release()
        self.assertEqual(git(self.mine, "status", "--porcelain"), "")
        self.assertEqual(git(self.mine, "rev-parse", "HEAD"), git(self.original, "rev-parse", "v1.1.0"))
        self.assertEqual(git(self.mine, "symbolic-ref", "HEAD"), "refs/heads/main")
        self.assertIn("The course is 1.1.0 already.", self.updated())

    def test_a_release_that_is_asked_for(self):
        self.release("1.1.0")
        write(self.original, "more.txt", "more\n")
        release(self.original, "1.2.0")
        git(self.original, "tag", "v1.3.0-rc.1")
        self.updated("1.1.0")
        self.assert_is_release("1.1.0")
        self.updated("v1.2.0")
        self.assert_is_release("1.2.0")
        self.assertIn("1.0.0 is no newer", self.updated("1.0.0"))
        self.assert_is_release("1.2.0")

    def test_the_newest_is_by_number_and_no_trial_version(self):
        for version in ("1.9.0", "1.10.0"):
            write(self.original, "more.txt", version)
            release(self.original, version)
        for tag in ("v2.0.0-rc.1", "vnext", "v1.99"):
            git(self.original, "tag", tag)
        self.assertIn("to 1.10.0", self.updated())

    def test_what_is_asked_for_badly(self):
        self.release()
        for words, *told in ((["1.x"], "'1.x'", "such as"), (["9.9.9"], "'9.9.9'", "the newest is 1.1.0"),
                             (["1.1.0", "--undo"], "--undo", "'1.1.0'"), (["--from"], "--from"),
                             (["1.1.0", "1.2.0"], "'1.2.0'"), (["--dry"], "'--dry'", "--dry-run")):
            with self.subTest(words):
                said = self.refused(*words, code=2)
                for text in told:
                    self.assertIn(text, said)

    def test_a_detached_head(self):
        self.release()
        git(self.mine, "checkout", "-q", "v1.0.0")
        self.updated()
        self.assert_is_release()
        self.assertEqual(git(self.mine, "rev-parse", "HEAD"), git(self.original, "rev-parse", "v1.1.0"))
        self.assertEqual(git(self.mine, "rev-parse", "main"), git(self.original, "rev-parse", "v1.0.0"))
        self.updated("--undo")
        self.assertEqual(git(self.mine, "rev-parse", "HEAD"), git(self.original, "rev-parse", "v1.0.0"))

    def test_a_shallow_clone(self):
        self.release()
        shallow = self.here / "shallow"
        git(self.here, "clone", "-q", "--depth", "1", "--branch", "v1.0.0", f"file://{self.original}", str(shallow))
        write(shallow, KICK, MINE)
        git(shallow, "commit", "-qam", "Mine")
        self.updated(folder=shallow)
        self.assertEqual(self.text(KICK, shallow), MINE)
        self.assertEqual(self.text("chapters/01_leapfrog/new.txt", shallow), "new\n")

    def test_a_deleted_file_of_the_course_stays_deleted_unless_it_is_new(self):
        self.release()
        (self.mine / "chapters/02_quaternions/README.md").unlink()
        (self.mine / HEADER).unlink()
        self.updated()
        self.assert_is_release(but=("chapters/02_quaternions/README.md",))


class WithAnswers(Updating):
    def test_what_was_not_committed_stays(self):
        self.release()
        self.write(KICK, MINE)
        self.write(DRIFT, MINE)
        before = snapshot(self.mine)
        said = " ".join(self.updated().split())
        self.assert_is_release(but=(KICK, DRIFT))
        self.assertEqual((self.text(KICK), self.text(DRIFT)), (MINE, MINE))
        self.assertIn("Your files stay as they are: 1.1 kick, 1.2 drift.", said)
        self.assertIn("1.1 kick: header leapfrog.hpp; tests kick_drift_start_test.cpp", said)
        self.assertIn("1.2 drift: header leapfrog.hpp; tests kick_drift_start_test.cpp; stub", said)
        self.assertIn("./course reset 1.2", said)
        self.assertEqual(git(self.mine, "diff", "--name-only").split(), [DRIFT, KICK])
        self.undone(before)
        self.assertEqual(git(self.mine, "diff", "--name-only").split(), [DRIFT, KICK])
        self.assertEqual(git(self.mine, "rev-parse", "HEAD"), git(self.original, "rev-parse", "v1.0.0"))

    def test_what_was_committed_stays_and_so_does_its_history(self):
        self.release()
        self.write(KICK, MINE)
        self.commit(KICK)
        own = git(self.mine, "rev-parse", "HEAD")
        before = snapshot(self.mine)
        self.updated()
        self.assert_is_release(but=(KICK,))
        self.assertEqual(git(self.mine, "status", "--porcelain"), "")
        parents = git(self.mine, "show", "-s", "--format=%P", "HEAD").split()
        self.assertEqual(parents, [own, git(self.original, "rev-parse", "v1.1.0")])
        self.assertEqual(git(self.mine, "show", f"HEAD:{KICK}"), MINE.rstrip())
        self.undone(before)
        self.assertEqual((git(self.mine, "rev-parse", "HEAD"), git(self.mine, "status", "--porcelain")), (own, ""))
        self.updated()
        self.assert_is_release(but=(KICK,))
        write(self.original, "more.txt", "more\n")
        release(self.original, "1.2.0")
        self.updated()
        self.assert_is_release("1.2.0", but=(KICK,))

    def test_reset_finds_the_new_stub(self):
        self.release()
        self.write(DRIFT, MINE)
        self.commit(DRIFT)
        self.updated()
        done = subprocess.run([str(self.mine / "course"), "reset", "1.2"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_is_release(more=(f"{DRIFT}.mine-1",))
        self.assertEqual(self.text(f"{DRIFT}.mine-1"), MINE)
        self.assertEqual(git(self.mine, "status", "--porcelain").split(), ["M", DRIFT])  # .mine-1 is ignored

    def reset(self, folder: Path | None = None):
        return subprocess.run([str((folder or self.mine) / "course"), "reset", "1.1"], capture_output=True, text=True,
                              env=os.environ | _IDENTITY)

    def half_done(self, folder: Path) -> bytes:
        """Commits half an answer, which has the marker, too; returns the stub."""
        stub = (folder / KICK).read_bytes()
        edit(folder, KICK, "  not_implemented(", "  Vec3 half = v;\n  not_implemented(")
        git(folder, "commit", "-qam", "Half done")
        return stub

    def assert_reset(self, stub: bytes, folder: Path | None = None) -> None:
        done = self.reset(folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(((folder or self.mine) / KICK).read_bytes(), stub)

    def test_reset_restores_the_stub_and_not_half_an_answer(self):
        stub = self.half_done(self.mine)
        git(self.mine, "tag", "v7.0.0")  # no release, since the course is of another version
        self.assert_reset(stub)
        git(self.mine, "tag", "-d", "v1.0.0")  # as in a copy without tags, whose upstream is known
        git(self.mine, "checkout", "-q", "--", KICK)
        self.assert_reset(stub)
        git(self.mine, "checkout", "-q", "--", KICK)
        git(self.original, "checkout", "-q", "--detach")
        git(self.mine, "push", "-q", "origin", "HEAD")  # a repository of the student's own has the half answer, too
        self.assert_reset(stub)

    def test_reset_takes_the_stub_of_the_newest_release(self):
        for version in ("1.1.0", "1.10.0", "1.9.0"):
            edit(self.original, KICK, "Eq. (", f"{version}: Eq. (")
            release(self.original, version)
        git(self.mine, "pull", "-q")
        edit(self.mine, KICK, "1.9.0", "mine")
        self.half_done(self.mine)
        self.assert_reset((git(self.original, "show", f"v1.10.0:{KICK}") + "\n").encode())

    def test_reset_in_a_repository_without_releases(self):
        """Made from a template, with one commit that is not the student's."""
        shutil.rmtree(self.mine / ".git")
        git(self.mine, "init", "-q")
        git(self.mine, "add", "-A")
        git(self.mine, "commit", "-qm", "The course")
        stub = (self.mine / KICK).read_bytes()
        edit(self.mine, KICK, "// Eq.", "// Mine: Eq.")
        git(self.mine, "commit", "-qam", "A note")
        self.half_done(self.mine)
        self.assert_reset(stub)

    def test_reset_in_a_shallow_clone_names_the_command_that_fetches_the_rest(self):
        self.half_done(self.mine)
        shallow = self.here / "shallow"
        git(self.here, "clone", "-q", "--depth", "1", f"file://{self.mine}", str(shallow))
        edit(shallow, KICK, "half", "mine")
        before = snapshot(shallow)
        done = self.reset(shallow)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
        self.assertIn("git fetch --unshallow", done.stderr)
        self.assertEqual(snapshot(shallow), before)

    def test_committed_staged_and_edited_once_more(self):
        self.release()
        for text in ("committed", "staged", "edited"):
            self.write(KICK, MINE + text)
            if text == "committed":
                self.commit(KICK)
            if text == "staged":
                git(self.mine, "add", KICK)
        before = snapshot(self.mine)
        for back in (False, True):
            if back:
                self.undone(before)
            else:
                self.updated()
            self.assertEqual(self.text(KICK), MINE + "edited")
            self.assertEqual(git(self.mine, "show", f":{KICK}"), MINE + "staged")
            self.assertEqual(git(self.mine, "show", f"HEAD:{KICK}"), MINE + "committed")

    def test_a_stub_with_notes_is_the_students_too(self):
        self.release()
        edit(self.mine, DRIFT, "// Eq.", "// I think that this adds v: Eq.")
        mine = self.text(DRIFT)
        self.updated()
        self.assertEqual(self.text(DRIFT), mine)

    def test_a_branch_of_a_copy_with_the_original_as_upstream(self):
        self.release()
        fork = self.here / "fork"
        git(self.here, "clone", "-q", "--bare", str(self.first), str(fork))
        git(self.mine, "remote", "set-url", "origin", str(fork))
        git(self.mine, "checkout", "-qb", "answers")
        self.write(KICK, MINE)
        self.commit(KICK)
        self.assertIn("1.0.0 already", self.updated())
        self.assert_is_release("1.0.0", but=(KICK,))
        git(self.mine, "remote", "add", "upstream", str(self.original))
        self.updated()
        self.assert_is_release(but=(KICK,))
        self.assertEqual(git(self.mine, "symbolic-ref", "--short", "HEAD"), "answers")
        git(self.mine, "push", "-q", "origin", "answers")

    def test_a_copy_that_began_from_a_template_with_a_commit_of_its_own(self):
        self.release()
        shutil.rmtree(self.mine / ".git")
        git(self.mine, "init", "-q")
        git(self.mine, "add", "-A")
        git(self.mine, "commit", "-qm", "Initial commit")
        self.write(KICK, MINE)
        before = snapshot(self.mine)
        self.updated("--from", str(self.original))
        self.assert_is_release(but=(KICK,))
        self.assertEqual(git(self.mine, "status", "--porcelain").split(), ["M", KICK])
        self.undone(before)
        self.updated("--from", str(self.original))
        self.assertIn("1.1.0 already", self.updated("--from", str(self.original)))

    def test_a_template_of_a_version_that_the_original_has_not(self):
        edit(self.mine, "CMakeLists.txt", "VERSION 1.0.0", "VERSION 0.7.0")
        self.release()
        shutil.rmtree(self.mine / ".git")
        git(self.mine, "init", "-q")
        git(self.mine, "add", "-A")
        git(self.mine, "commit", "-qm", "Initial commit")
        self.assertIn("no release 0.7.0", self.refused("--from", str(self.original)))

    def test_an_answer_that_is_a_link_to_elsewhere(self):
        self.release()
        elsewhere = self.here / "drift.cpp"
        elsewhere.write_text(MINE)
        (self.mine / DRIFT).unlink()
        (self.mine / DRIFT).symlink_to(elsewhere)
        self.updated()
        self.assertTrue((self.mine / DRIFT).is_symlink())
        self.assertEqual(elsewhere.read_text(), MINE)

    def test_without_a_name_known_to_git(self):
        self.release()
        self.write(KICK, MINE)
        self.commit(KICK)
        nobody = {"GIT_AUTHOR_NAME": "", "GIT_AUTHOR_EMAIL": "", "GIT_COMMITTER_NAME": "", "GIT_COMMITTER_EMAIL": "",
                  "EMAIL": "", "HOME": str(self.here)}
        self.updated(**nobody)
        self.assert_is_release(but=(KICK,))

    def test_ends_of_lines_are_no_change(self):
        self.release()
        self.write(KICK, MINE)
        path = self.mine / HEADER
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
        self.updated()
        self.assert_is_release(but=(KICK,))


class WithOtherFiles(Updating):
    def test_a_changed_file_of_the_course_is_kept_aside_and_named(self):
        self.release()
        edit(self.mine, HEADER, "#pragma once", "#pragma once\n// My own.")
        self.write("CMakePresets.json", "{}\n")
        mine, before = self.text(HEADER), snapshot(self.mine)
        said = self.updated()
        self.assertIn(f"{HEADER}: you and the release have changed it; yours is kept as {HEADER}.mine-1", said)
        self.assertEqual(self.text(f"{HEADER}.mine-1"), mine)
        # The release has not touched the presets.
        self.assert_is_release(but=("CMakePresets.json",), more=(f"{HEADER}.mine-1",))
        self.assertEqual(git(self.mine, "status", "--porcelain").split(), ["M", "CMakePresets.json"])
        self.undone(before)

    def test_a_committed_one_too(self):
        self.release()
        edit(self.mine, HEADER, "#pragma once", "#pragma once\n// My own.")
        self.commit(HEADER)
        self.write(f"{HEADER}.mine-1", "taken\n")
        before = snapshot(self.mine)
        self.updated()
        self.assertIn("My own.", self.text(f"{HEADER}.mine-2"))
        self.assert_is_release(more=(f"{HEADER}.mine-1", f"{HEADER}.mine-2"))
        self.assertEqual(git(self.mine, "status", "--porcelain"), "")
        self.undone(before)

    def test_one_that_the_release_deletes(self):
        self.release()
        edit(self.mine, "chapters/02_quaternions/try.md", "#", "# Mine")
        self.updated()
        self.assert_is_release(more=("chapters/02_quaternions/try.md.mine-1",))

    def test_extra_files_stay(self):
        self.release()
        extra = ("notes.md", "chapters/01_leapfrog/helpers.cpp", "chapters/01_leapfrog/try/try_kick.cpp", "build/x")
        for name in extra:
            self.write(name, "mine\n")
        self.commit("notes.md")
        self.updated()
        self.assert_is_release(more=extra)

    def test_an_extra_file_where_the_release_has_one_now(self):
        self.release()
        self.write("chapters/01_leapfrog/new.txt", "mine\n")
        before = snapshot(self.mine)
        self.updated()
        self.assert_is_release(more=("chapters/01_leapfrog/new.txt.mine-1",))
        self.undone(before)

    def test_a_folder_where_the_release_has_a_file_now(self):
        self.release()
        self.write("chapters/01_leapfrog/new.txt/deep/notes.md", "mine\n")
        self.assertIn("chapters/01_leapfrog/new.txt is a folder", self.refused())
        git(self.mine, "add", "-A")
        git(self.mine, "commit", "-qm", "Mine")
        self.assertIn("chapters/01_leapfrog/new.txt is a folder", self.refused())

    def test_a_file_or_a_link_where_the_release_has_a_folder_now(self):
        write(self.original, "docs/page.md", "page\n")
        release(self.original, "1.1.0")
        self.write("docs", "mine\n")
        self.assertIn("docs must be a folder", self.refused())
        (self.mine / "docs").unlink()
        (self.mine / "docs").symlink_to(self.here)
        self.assertIn("docs must be a folder", self.refused())
        self.assertFalse((self.here / "page.md").exists())

    def test_a_file_that_becomes_a_folder_and_back(self):
        (self.original / "README.md").unlink()
        write(self.original, "README.md/page.md", "page\n")
        release(self.original, "1.1.0")
        before = snapshot(self.mine)
        self.updated()
        self.assert_is_release()
        self.undone(before)

    def test_bytes_that_are_kept_are_the_same_bytes(self):
        self.release()
        (self.mine / HEADER).write_bytes(b"\xff\xfe mine\r\n \0 \xe9")
        before = snapshot(self.mine)
        self.updated()
        self.assertEqual((self.mine / f"{HEADER}.mine-1").read_bytes(), b"\xff\xfe mine\r\n \0 \xe9")
        self.undone(before)


class WhenExercisesMove(Updating):
    def renumbered(self) -> None:
        for top in ("chapters", "tests"):
            git(self.original, "mv", f"{top}/01_leapfrog", f"{top}/03_leapfrog")
        for path in (self.original / "chapters/03_leapfrog").glob("*"):
            if path.suffix in (".cpp", ".hpp", ".md"):
                path.write_text(path.read_text().replace("01_leapfrog", "03_leapfrog").replace("## 1.", "## 3."))
        release(self.original, "1.1.0")

    def test_a_chapter_with_another_number_takes_the_answers_along(self):
        self.renumbered()
        self.write(KICK, MINE)
        self.commit(KICK)
        self.write(DRIFT, MINE + "// drift\n")
        self.write("chapters/01_leapfrog/try/try_kick.cpp", "play\n")
        self.write(f"{KICK}.mine-1", "old\n")
        self.write("chapters/01_leapfrog/notes.md", "notes\n")
        before = snapshot(self.mine)
        said = self.updated()
        new = "chapters/03_leapfrog/"
        self.assertIn(f"{KICK} has moved to {new}kick.cpp", said)
        self.assertIn(f"{new}kick.cpp includes 01_leapfrog/, which is 03_leapfrog now", said)
        self.assertEqual((self.text(f"{new}kick.cpp"), self.text(f"{new}drift.cpp")), (MINE, MINE + "// drift\n"))
        self.assert_is_release(but=(f"{new}kick.cpp", f"{new}drift.cpp"), more=(
            f"{new}try/try_kick.cpp", f"{new}kick.cpp.mine-1", "chapters/01_leapfrog/notes.md"))
        self.assertEqual(git(self.mine, "show", f"HEAD:{new}kick.cpp"), MINE.rstrip())
        self.assertEqual(git(self.mine, "diff", "--name-only"), f"{new}drift.cpp")
        self.undone(before)

    def test_what_was_changed_after_it_is_kept_when_it_is_undone(self):
        self.renumbered()
        self.write(KICK, MINE)
        self.updated()
        self.write("chapters/03_leapfrog/kick.cpp", MINE + "// better\n")
        self.write("chapters/03_leapfrog/drift.cpp", MINE + "// begun since\n")
        self.write("chapters/03_leapfrog/README.md", "my lesson\n")
        self.updated("--undo")
        self.assertEqual(self.text(KICK), MINE + "// better\n")
        self.assertEqual(self.text(DRIFT), MINE + "// begun since\n")
        self.assertEqual(self.text("chapters/03_leapfrog/README.md.mine-1"), "my lesson\n")
        self.assert_is_release("1.0.0", but=(KICK, DRIFT), more=("chapters/03_leapfrog/README.md.mine-1",))

    def test_an_exercise_that_is_gone_or_has_another_name(self):
        edit(self.original, HINTS, "## 1.1 kick", "## 1.1 push")
        git(self.original, "mv", KICK, "chapters/01_leapfrog/push.cpp")
        release(self.original, "1.1.0")
        for commits in (False, True):
            self.write(KICK, MINE)
            if commits:
                self.commit(KICK)
            before = snapshot(self.mine)
            said = self.updated()
            self.assertIn(f"1.1 kick is no longer an exercise; 1.1 is push now. Your file stays: {KICK}", said)
            self.assertEqual(self.text(KICK), MINE)
            self.assert_is_release(more=(KICK,))
            self.undone(before)

    def test_a_file_of_the_students_where_an_exercise_arrives(self):
        self.renumbered()
        self.write(KICK, MINE)
        self.write("chapters/03_leapfrog/kick.cpp", "something else\n")
        before = snapshot(self.mine)
        self.updated()
        self.assertEqual(self.text("chapters/03_leapfrog/kick.cpp"), MINE)
        self.assertEqual(self.text("chapters/03_leapfrog/kick.cpp.mine-1"), "something else\n")
        self.undone(before)


class DryRunAndUndo(Updating):
    def test_a_dry_run_changes_nothing_and_says_the_same(self):
        self.release()
        self.write(KICK, MINE)
        edit(self.mine, HEADER, "#pragma once", "#pragma once\n// My own.")
        before, head = snapshot(self.mine), git(self.mine, "rev-parse", "HEAD")
        status = git(self.mine, "status", "--porcelain")
        said = self.updated("--dry-run")
        for text in ("would go from 1.0.0 to 1.1.0", "1.1 kick", f"would be kept as {HEADER}.mine-1",
                     "Nothing was changed"):
            self.assertIn(text, said)
        self.assertEqual((snapshot(self.mine), git(self.mine, "rev-parse", "HEAD")), (before, head))
        self.assertEqual(git(self.mine, "status", "--porcelain"), status)
        self.assertIn("no update to undo", self.refused("--undo"))
        self.updated()
        after = snapshot(self.mine)
        self.assertIn("would go back from 1.1.0 to 1.0.0", self.updated("--undo", "--dry-run"))
        self.assertEqual(snapshot(self.mine), after)
        self.undone(before)
        self.assertIn("no update to undo", self.refused("--undo"))

    def test_an_exercise_begun_after_the_update_is_kept(self):
        self.release()
        self.updated()
        self.write(DRIFT, MINE)
        edit(self.mine, HEADER, "// New.", "// New, and mine.")
        self.updated("--undo")
        self.assertEqual(self.text(DRIFT), MINE)
        self.assertIn("and mine", self.text(f"{HEADER}.mine-1"))
        self.assert_is_release("1.0.0", but=(DRIFT,), more=(f"{HEADER}.mine-1",))

    def test_after_commits_or_on_another_branch_it_is_refused(self):
        self.release()
        before = git(self.mine, "rev-parse", "HEAD")
        self.updated()
        self.write(KICK, MINE)
        self.commit(KICK)
        self.assertIn(before[:12], self.refused("--undo"))
        git(self.mine, "checkout", "-qb", "other", "HEAD~1")
        self.assertIn("another branch", self.refused("--undo"))

    def interrupted(self, command: str, by: str) -> dict[str, str]:
        """Returns an environment in which a function is called at one of git's commands."""
        (self.here / "bin").mkdir()
        fake = self.here / "bin" / "git"
        fake.write_text(f'#!/bin/sh\ncase "$*" in *{command}*) {by};; esac\nexec {shutil.which("git")} "$@"\n')
        fake.chmod(0o755)
        return {"PATH": f"{self.here}/bin:{os.environ['PATH']}"}

    def test_what_is_saved_meanwhile_is_not_written_over(self):
        self.release()
        said = self.course(**self.interrupted("mktree", f"echo saved >{self.mine / DRIFT}"))
        self.assertEqual((said.returncode, said.stderr.count("\n")), (1, 1), said.stderr)
        self.assertIn(f"{DRIFT} was saved during the update", said.stderr)
        self.assertEqual(self.text(DRIFT), "saved\n")
        self.assert_is_release("1.0.0", but=(DRIFT,))
        self.updated()
        self.assert_is_release(but=(DRIFT,))

    def test_one_that_stopped_half_way_is_undone(self):
        self.release()
        self.write(KICK, MINE)
        edit(self.mine, HEADER, "#pragma once", "#pragma once\n// My own.")
        before = snapshot(self.mine)
        locked = self.mine / "chapters/01_leapfrog"
        # git cannot write here, and what was written before it noticed stays.
        full = f"echo new >{locked}/new.txt; echo disk full >&2; exit 1"
        done = self.course(**self.interrupted("checkout-index", full))
        self.assertEqual(done.returncode, 1)
        self.assertIn("stopped half-way. It is undone by  ./course update --undo", done.stderr)
        self.assertIn("disk full", done.stderr)
        self.assertNotEqual(snapshot(self.mine), before)
        self.assertIn("half-way", self.refused())
        self.undone(before)
        self.updated()
        self.assert_is_release(but=(KICK,), more=(f"{HEADER}.mine-1",))


class WhereItCanNotBe(Updating):
    def test_no_network(self):
        self.release()
        git(self.mine, "remote", "set-url", "origin", str(self.here / "nowhere"))
        self.write(KICK, MINE)
        said = self.refused()
        for text in ("origin", "nowhere", "could not be reached", "nothing was changed"):
            self.assertIn(text, said)

    def test_no_password_is_printed(self):
        git(self.mine, "remote", "set-url", "origin", "file://me:secret@/nowhere")
        self.assertNotIn("secret@", self.refused().split("could not be reached")[0])

    def test_no_remote_and_none_to_be_chosen(self):
        git(self.mine, "remote", "rename", "origin", "a")
        git(self.mine, "remote", "add", "b", str(self.original))
        self.assertIn("none of a, b", self.refused())
        for name in "ab":
            git(self.mine, "remote", "remove", name)
        self.assertIn("no remote", self.refused())

    def test_an_original_without_releases(self):
        git(self.original, "tag", "-d", "v1.0.0")
        self.assertIn("has no release", self.refused())

    def test_after_a_pull_that_stopped(self):
        """As git pull leaves a folder: with markers in a committed answer whose stub the release has changed."""
        self.release()
        self.write(DRIFT, MINE)
        self.commit(DRIFT)
        for how in ("merge", "rebase"):
            with self.subTest(how):
                subprocess.run(["git", "-C", str(self.mine), "pull", f"--rebase={str(how == 'rebase').lower()}"],
                               capture_output=True, env=os.environ | _IDENTITY)
                self.assertIn("<<<<<<<", self.text(DRIFT))
                said = self.refused()
                self.assertIn(f"in the middle of a {how}", said)
                self.assertTrue(said.endswith(f"  git {how} --abort\n"), said)
                git(self.mine, how, "--abort")
                self.assertEqual(self.text(DRIFT), MINE)
        self.updated()
        self.assert_is_release(but=(DRIFT,))

    def test_while_another_git_is_at_work(self):
        self.release()
        (self.mine / ".git/index.lock").touch()
        self.assertIn("index.lock", self.refused())

    def test_an_archive_without_history(self):
        self.release()
        shutil.rmtree(self.mine / ".git")
        self.write(KICK, MINE)
        outside = {"GIT_CEILING_DIRECTORIES": str(self.here)}
        said = self.refused(lines=0, **outside)
        for text in ("no git history", "--from ADDRESS", "git clone ADDRESS", KICK):
            self.assertIn(text, said)
        self.updated("--from", str(self.original), **outside)
        self.assert_is_release(but=(KICK,))
        self.assertEqual(git(self.mine, "status", "--porcelain").split(), ["M", KICK])
        self.assertIn("1.1.0 already", self.updated())  # its origin is known now

    def test_an_archive_and_no_network(self):
        shutil.rmtree(self.mine / ".git")
        outside = {"GIT_CEILING_DIRECTORIES": str(self.here)}
        self.assertIn("could not be fetched", self.refused("--from", str(self.here / "nowhere"), **outside))

    def test_a_history_that_git_does_not_read(self):
        (self.mine / ".git" / "HEAD").write_text("broken\n")
        self.assertIn("git does not read the history", self.refused(GIT_CEILING_DIRECTORIES=str(self.here)))

    def test_a_folder_of_a_larger_repository(self):
        self.release()
        shutil.rmtree(self.mine / ".git")
        git(self.here, "init", "-q")
        self.write(KICK, MINE)
        git(self.here, "add", "course")
        said = self.refused("--from", str(self.original), lines=0)
        for text in ("a larger repository", str(self.here), "git clone ADDRESS", KICK):
            self.assertIn(text, said)


class Version(Updating):
    def test_it_is_that_of_cmake(self):
        done = subprocess.run([str(self.mine / "course"), "--version"], capture_output=True, text=True)
        self.assertRegex(done.stdout, r"^course 1\.0\.0 \([0-9a-f]+\)\n$")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        shutil.rmtree(self.mine / ".git")
        done = subprocess.run([str(self.mine / "course"), "--version"], capture_output=True, text=True,
                              env=os.environ | {"GIT_CEILING_DIRECTORIES": str(self.here)})
        self.assertEqual(done.stdout, "course 1.0.0\n")


if __name__ == "__main__":
    unittest.main()
