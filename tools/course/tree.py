"""A build tree for a CMake preset: configured when needed, built with ninja."""

import contextlib
import fcntl
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from errors import CourseError
from machine import processors
from paths import BUILD, ROOT, shown
from process import from_failure, stream, tail
from terminal import Live

_STATUS = re.compile(r"^\[(\d+/\d+)\] ")


@dataclass(frozen=True)
class Built:
    ok: bool
    output: str


def jobs() -> int:
    given = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", "")
    return int(given) if given.isdecimal() and int(given) > 0 else processors()


# Trees that link what others have compiled, and those others. CMake needs them configured first.
_LINKS = {"check": ["release"], "sanitize": ["release", "check"]}


class Tree:
    def __init__(self, preset: str, wrapper: tuple[str, ...] = ()):
        """`wrapper` precedes cmake and sets its compiler, as emcmake does."""
        self.preset = preset
        self._wrapper = wrapper
        self.path = BUILD / preset

    def build(self, targets: list[str], what: str, keep_going: bool = False) -> Built:
        """Brings the targets up to date; the caller explains a failure."""
        going = ["-k", "0"] if keep_going else []
        command = ["ninja", "-C", str(self.path), "-j", str(jobs()), *going, *targets]
        env = os.environ | {"NINJA_STATUS": "[%f/%t] ", "LC_ALL": "C"}
        live, log = Live(what), self.path / "course-build.log"
        with self.alone():
            self._configure()
            code, output = stream(command, lambda line: self._show(live, line), log, env)
        live.done()
        return Built(code == 0, output)

    def configure(self, *settings: str) -> None:
        """Runs CMake if it never ran here, if the course was moved, or if there are new settings or presets."""
        with self.alone():
            self._configure(*settings)

    def _configure(self, *settings: str) -> None:
        if not settings and (self.path / "build.ninja").exists() and self._is_of_this_course() and self._is_current():
            return
        if not self._is_of_this_course():
            self._say_that_it_was_moved()
            (self.path / "CMakeCache.txt").unlink(missing_ok=True)
        for other in _LINKS.get(self.preset, []):
            Tree(other).configure()
        live = Live(f"configuring {shown(self.path)}")
        log = self.path / "course-configure.log"
        self._configured.unlink(missing_ok=True)
        command = [*self._wrapper, "cmake", "--preset", self.preset, "-B", str(self.path),
                   f"-DPython3_EXECUTABLE={sys.executable}", *settings]
        code, output = stream(command, lambda line: live.update(), log, cwd=ROOT)
        live.done()
        if code != 0:
            raise CourseError(f"CMake failed; the whole log is in {shown(log)} "
                              "(is something missing? ./course start)", tail(output))
        self._configured.touch()

    def setting(self, name: str) -> str:
        """Returns a value in CMake's cache; empty if there is none."""
        try:
            cache = (self.path / "CMakeCache.txt").read_text(encoding="utf-8", errors="replace")
        except FileNotFoundError:
            return ""
        found = re.search(rf"^{name}:\w+=(.*)$", cache, re.MULTILINE)
        return found[1] if found else ""

    def program(self, target: str) -> Path:
        """Returns the path of a target's program."""
        query = subprocess.run(["ninja", "-C", str(self.path), "-t", "query", target],
                               capture_output=True, text=True)
        alias = re.search(r"^  input: phony\n    (\S+)$", query.stdout, re.MULTILINE)
        return self.path / (alias[1] if alias else target)

    def failed(self, built: Built, *names: str) -> bool:
        """Tells whether one of these targets has failed, and not the course's own code."""
        lines = [line for line in built.output.splitlines() if line.startswith("FAILED:")]
        return any(re.search(rf"\b{name}\b", line) for line in lines for name in names)

    def own_failure(self, built: Built) -> CourseError:
        return CourseError(f"the course's own code did not build; the whole log is in "
                           f"{shown(self.path / 'course-build.log')}",
                           from_failure(built.output))

    @property
    def _configured(self) -> Path:
        """The file that is there if CMake succeeded."""
        return self.path / "course-configured"

    def _is_of_this_course(self) -> bool:
        return self.setting("CMAKE_HOME_DIRECTORY") in ("", str(ROOT))

    def _say_that_it_was_moved(self) -> None:
        """Explains the wait to a student who moved the folder: built files hold paths of the old place."""
        old = self.setting("CMAKE_HOME_DIRECTORY")
        print(f"{shown(self.path)} was built for {old}, and the course is in {ROOT} now: it is built anew.",
              file=sys.stderr, flush=True)

    def _is_current(self) -> bool:
        """Tells whether CMake has read the present presets, and this Python, to its end. Ninja checks the rest."""
        return (self._configured.exists()
                and self._configured.stat().st_mtime >= (ROOT / "CMakePresets.json").stat().st_mtime
                and self.setting("Python3_EXECUTABLE") == sys.executable)

    def _show(self, live: Live, line: str) -> None:
        status = _STATUS.match(line)
        live.update(f"[{status[1]}]" if status else "")

    @contextlib.contextmanager
    def alone(self):
        """Locks the tree, since two ninjas in one tree conflict: `watch` in one window, `check` in another. Within it
        this process builds nothing there."""
        self.path.mkdir(parents=True, exist_ok=True)
        with open(self.path / "course.lock", "w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                print(f"waiting for another ./course command that builds in {shown(self.path)} ...", file=sys.stderr,
                      flush=True)
                fcntl.flock(lock, fcntl.LOCK_EX)
            yield
