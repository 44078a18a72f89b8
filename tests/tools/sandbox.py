"""A copy of the course for experiments: all exercises are stubs, also in git's history."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("COURSE_SOURCE") or Path(__file__).resolve().parents[2]).resolve()
TOOLS = ROOT / "tools"
sys.dont_write_bytecode = sys.pycache_prefix is None
sys.path.insert(0, str(TOOLS / "course"))

from errors import CourseError  # noqa: E402
from files import course_files, new_files  # noqa: E402
from layer import Layer  # noqa: E402
from manifest import Exercise, all_exercises  # noqa: E402
from reset import stub_of  # noqa: E402
from watching import Watching  # noqa: E402

# An answer to exercise 1.1 under which nothing falls.
STILL = """#include "01_leapfrog/leapfrog.hpp"
namespace spook {
Vec3 kick(const Vec3& v, const Vec3&, double, double) { return v; }
}  // namespace spook
"""

_IDENTITY = ("-c", "user.name=Sandbox", "-c", "user.email=sandbox@localhost", "-c", "commit.gpgsign=false")


def all_files() -> list[Path]:
    """Returns the course's files, with those that are new and not yet committed."""
    return sorted([*course_files(), *new_files()])


def our_files() -> list[Path]:
    """Returns the course's files without exercises that a student has begun, whose style is free."""
    begun = {exercise.file.relative_to(ROOT) for exercise in all_exercises() if exercise.started()}
    return [name for name in all_files() if name not in begun]


def _clean_environment() -> dict[str, str]:
    return {name: value for name, value in os.environ.items() if not name.startswith(("COURSE_", "SPOOK_"))}


def _copy(root: Path) -> Path:
    for name in all_files():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, root / name)
    return root


def _layer(scratch: Path) -> Layer | None:
    """Makes a layer with the course's files and build trees, without its history and its memory of the student."""
    try:
        layer = Layer(ROOT, scratch)
    except OSError:
        return None
    ours = {"build", *(name.parts[0] for name in all_files())}
    for path in layer.root.iterdir():
        if path.name not in ours:
            shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()
    return layer


class Sandbox:
    """With `built`, the course's build trees are included, where a layer can be mounted; otherwise they are built on
    demand."""

    def __init__(self, built: bool = False):
        self._folder = tempfile.TemporaryDirectory(prefix="course-sandbox-")
        # Resolved, as the course finds its own folder.
        scratch = Path(self._folder.name).resolve()
        self._layer = _layer(scratch) if built else None
        self.root = self._layer.root if self._layer else _copy(scratch / "course")
        for exercise in all_exercises():
            if exercise.started():
                self._restore(exercise)
        for command in (["init", "-q"], ["add", "-A"], [*_IDENTITY, "commit", "-qm", "The course"]):
            self._git(*command)

    def close(self) -> None:
        if self._layer:
            self._layer.close()
        self._folder.cleanup()

    def course(self, *words: str, cwd: Path | None = None, command: Path | None = None,
               **env: str) -> subprocess.CompletedProcess:
        """Runs the course command; returns its output as text."""
        line, options = self._command(words, cwd, command)
        return subprocess.run(line, capture_output=True, text=True, stdin=subprocess.DEVNULL,
                              env=_clean_environment() | env, **options)

    def assert_refused(self, test: unittest.TestCase, words: list[str], told: list[str]) -> None:
        """Expects one line that names the error, and exit code 2."""
        with test.subTest(words=words):
            result = self.course(*words)
            test.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
            test.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            for text in told:
                test.assertIn(text, result.stderr)

    def watch(self, *words: str) -> Watching:
        return self.start("watch", *words)

    def start(self, *words: str) -> Watching:
        """Starts a command that runs until it is stopped."""
        line, options = self._command(words)
        return Watching(line, env=_clean_environment(), **options)

    def _git(self, *words: str) -> None:
        """Runs git inside: otherwise git would follow the layer's path to the folder below, and change that."""
        line, options = self._inside(["git", *words])
        subprocess.run(line, check=True, capture_output=True, **options)

    def _command(self, words: tuple[str, ...], cwd: Path | None = None,
                 command: Path | None = None) -> tuple[list[str], dict]:
        course = command or (ROOT if self._layer else self.root) / "course"
        return self._inside([str(course), *words], cwd)

    def _inside(self, line: list[str], cwd: Path | None = None) -> tuple[list[str], dict]:
        """Returns the command line, and the arguments to start it with."""
        if self._layer:
            return self._layer.inside(line, cwd), {}
        return line, {"cwd": cwd or self.root}

    def file(self, exercise: Exercise) -> Path:
        return self.root / exercise.file.relative_to(ROOT)

    def solve(self, exercise: Exercise) -> None:
        shutil.copyfile(exercise.reference, self.file(exercise))

    def restore(self, *exercises: Exercise) -> None:
        self._git("checkout", "-q", "--", *(str(exercise.file.relative_to(ROOT)) for exercise in exercises))

    def _restore(self, exercise: Exercise) -> None:
        """Restores stubs, since the student's copy may hold answers."""
        try:
            self.file(exercise).write_bytes(stub_of(exercise))
        except CourseError as error:
            raise SystemExit(f"a sandbox needs the stub of {exercise.label}: {error}") from None
