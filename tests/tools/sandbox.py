"""A copy of the course to try things in: all exercises are stubs, and git's history knows them."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(os.environ.get("COURSE_SOURCE") or Path(__file__).resolve().parents[2]).resolve()
TOOLS = ROOT / "tools"
sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOLS / "course"))

from errors import CourseError  # noqa: E402
from files import course_files  # noqa: E402
from manifest import Exercise, all_exercises  # noqa: E402
from reset import stub_of  # noqa: E402
from watching import Watching  # noqa: E402

_IDENTITY = ("-c", "user.name=Sandbox", "-c", "user.email=sandbox@localhost", "-c", "commit.gpgsign=false")


def our_files() -> list[Path]:
    """Without the exercises that a student has begun: how those look is the student's business."""
    begun = {exercise.file.relative_to(ROOT) for exercise in all_exercises() if exercise.started()}
    return [name for name in course_files() if name not in begun]


def _clean_environment() -> dict[str, str]:
    return {name: value for name, value in os.environ.items() if not name.startswith(("COURSE_", "SPOOK_"))}


class Sandbox:
    def __init__(self):
        self._folder = tempfile.TemporaryDirectory(prefix="course-sandbox-")
        # Resolved, as the course finds its own folder.
        self.root = Path(self._folder.name).resolve() / "course"
        for name in course_files():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, self.root / name)
        for exercise in all_exercises():
            if exercise.started():
                self._restore(exercise)
        for command in (["init", "-q"], ["add", "-A"], [*_IDENTITY, "commit", "-qm", "The course"]):
            subprocess.run(["git", "-C", str(self.root), *command], check=True, capture_output=True)

    def close(self) -> None:
        self._folder.cleanup()

    def course(self, *words: str, cwd: Path | None = None, command: Path | None = None,
               **env: str) -> subprocess.CompletedProcess:
        """Runs the course command; the output as text."""
        return subprocess.run([str(command or self.root / "course"), *words], capture_output=True, text=True,
                              cwd=cwd or self.root, env=_clean_environment() | env, stdin=subprocess.DEVNULL)

    def watch(self, *words: str) -> Watching:
        return Watching([str(self.root / "course"), "watch", *words], cwd=self.root, env=_clean_environment())

    def file(self, exercise: Exercise) -> Path:
        return self.root / exercise.file.relative_to(ROOT)

    def solve(self, exercise: Exercise) -> None:
        shutil.copyfile(exercise.reference, self.file(exercise))

    def restore(self, exercise: Exercise) -> None:
        path = self.file(exercise).relative_to(self.root)
        subprocess.run(["git", "-C", str(self.root), "checkout", "-q", "--", str(path)], check=True)

    def _restore(self, exercise: Exercise) -> None:
        """The student's copy may hold answers; the sandbox starts from the stub."""
        try:
            self.file(exercise).write_bytes(stub_of(exercise))
        except CourseError as error:
            raise SystemExit(f"a sandbox needs the stub of {exercise.label}: {error}") from None
