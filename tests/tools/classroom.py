"""Submissions for the tests of the grader, and calls of the grader as an instructor makes them."""

import contextlib
import fcntl
import functools
import json
import os
import re
import stat
import subprocess
import sys
import tempfile
from pathlib import Path

from sandbox import ROOT

from grading.isolation import choose
from grading.results import SCHEMA, said, write_json
from manifest import all_exercises

CORPUS = ROOT / "tests" / "submissions"
SECONDS_OF_AN_EXERCISE = 60  # so that each test of an answer that loops is run
SECONDS_A_TEST = 4  # of processor time: loops are to end soon, memory to be filled before, on a busy machine, too
_CALL = re.compile(r"^(?:Vec3|void) \w+\(.*\) \{$", re.MULTILINE)


class Classroom:
    """A folder with submissions, which is deleted at the end."""

    def __init__(self):
        self._closed = closed_to_others() if isolation() == "uid" else contextlib.nullcontext()
        self._closed.__enter__()
        self._folder = tempfile.TemporaryDirectory(prefix="classroom-")
        self.root = Path(self._folder.name).resolve()
        self.handed_in = self.root / "handed in"
        self.handed_in.mkdir()

    def close(self) -> None:
        self._folder.cleanup()
        self._closed.__exit__(None, None, None)

    def hand_in(self, name: str, sources: dict[str, str | bytes], chapter: str = "01_leapfrog") -> Path:
        """Adds a submission; `sources` are by file name."""
        folder = self.handed_in / name / "chapters" / chapter
        folder.mkdir(parents=True, exist_ok=True)
        for file, content in sources.items():
            (folder / file).write_bytes(content.encode() if isinstance(content, str) else content)
        return self.handed_in / name

    def run(self, *words: str | Path, **env: str) -> subprocess.CompletedProcess:
        return run_course("grade", *words, cwd=self.root, **env)

    def grade(self, *words: str | Path, out: str = "marks", chapters: str = "1", seconds: int = SECONDS_A_TEST) -> "Marks":
        folder = self.root / out
        run = self.run(*(words or (self.handed_in,)), "--chapters", chapters, "--time-limit", str(seconds),
                       "--exercise-time", str(SECONDS_OF_AN_EXERCISE), "--out", folder)
        if run.returncode != 0:
            raise AssertionError(f"./course grade ends with {run.returncode}:\n{run.stdout}{run.stderr}")
        return Marks(folder, run.stdout)


def make_up(folder: Path, name: str, score: float, numbers: tuple[str, ...] = ("1.1",), **settings) -> None:
    """Writes results as a grading does, without one: of exercises with two tests of a point each, the first of which
    has `score` points."""
    exercises = []
    for one in (one for one in all_exercises() if one.id in numbers):
        passed = score == 2 or bool(exercises)
        tests = [{"name": test, "title": "A test", "verdict": "passed" if passed else "failed", "reason": "", "points": 1.0,
                  "score": float(passed), "max_score": 1.0, "visibility": "visible", "hint": f"{one.id}/1", "message": "",
                  "printed": ""} for test in one.tests()[:2]]
        exercises.append({"id": one.id, "function": one.function, "chapter": one.folder, "file": f"{one.function}.cpp",
                          "sha256": "", "state": "done" if passed else "wrong", "score": 2.0 * passed, "max_score": 2.0,
                          "tests": tests})
    most = sum(exercise["max_score"] for exercise in exercises)
    result = {"schema": SCHEMA, "submission": name, "student": name, "identifier": "", "late": False, "platform": "",
              "score": sum(exercise["score"] for exercise in exercises), "max_score": most, "points": "exercises",
              "attempt": "last", "seed": 1, "hidden_seed": 1, "seconds_a_test": 5, "isolation": "limits", "not_denied": "",
              "tests": "t", "notes": [], "exercises": exercises}
    (folder / "submissions" / name / "taken").mkdir(parents=True, exist_ok=True)
    write_json(folder / "submissions" / name / "results.json", result | settings)


class Marks:
    def __init__(self, folder: Path, said: str = ""):
        self.folder, self.said = folder, said

    def result(self, name: str) -> dict:
        return json.loads((self.folder / "submissions" / name / "results.json").read_text(encoding="utf-8"))

    def report(self, name: str) -> str:
        return (self.folder / "submissions" / name / "report.md").read_text(encoding="utf-8")

    def verdicts(self, name: str, function: str = "kick") -> set[str]:
        """Returns the verdicts of an exercise's tests with points, with their reasons."""
        for exercise in self.result(name)["exercises"]:
            if exercise["function"] == function:
                return {said(test) for test in exercise["tests"] if test["max_score"] > 0}
        raise AssertionError(f"{name} has no result for {function}")


def run_course(*words: str | Path, cwd: Path, **env: str) -> subprocess.CompletedProcess:
    clean = {name: value for name, value in os.environ.items()
             if name == "COURSE_BUILD" or not name.startswith(("COURSE_", "SPOOK_"))}
    return subprocess.run([str(ROOT / "course"), *map(str, words)], capture_output=True, text=True, cwd=cwd,
                          env=clean | env, stdin=subprocess.DEVNULL)


@functools.cache
def isolation() -> str:
    """Returns the isolation that the grader chooses here."""
    return choose().name


@contextlib.contextmanager
def closed_to_others():
    """Closes the course to other users, which isolation by user alone requires, from the first test that needs it to
    the last, which restores the permissions."""
    remembered = ROOT / ".course" / "mode"
    folder = os.open(ROOT, os.O_RDONLY)
    if _is_alone(folder):
        remembered.parent.mkdir(exist_ok=True)
        remembered.write_text(str(stat.S_IMODE(os.fstat(folder).st_mode)))
    fcntl.flock(folder, fcntl.LOCK_SH)
    os.chmod(ROOT, 0o700)
    try:
        yield
    finally:
        if _is_alone(folder):
            os.chmod(ROOT, int(remembered.read_text()))
            remembered.unlink()
        os.close(folder)


def _is_alone(folder: int) -> bool:
    try:
        fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return True
    except BlockingIOError:
        return False


def corpus() -> dict[str, tuple[Path, str]]:
    """Returns each answer to 1.1: its file, and how the verdict of each of its tests begins."""
    found = {}
    for file in sorted((CORPUS / "kick").glob("*.cpp")):
        fields = dict(re.findall(r"^// (Verdict.*?): (.+)$", file.read_text(encoding="utf-8"), re.MULTILINE))
        if "Verdict" not in fields:
            sys.exit(f"{file} does not say its verdict")
        elsewhere = fields.get("Verdict without namespaces", fields["Verdict"])
        found[file.stem] = (file, fields["Verdict"] if isolation().startswith("bubblewrap") else elsewhere)
    return found


def right(function: str, style: str = "reference") -> str:
    folder = ROOT / "solutions" if style == "reference" else CORPUS / "styles" / style
    return (folder / "01_leapfrog" / f"{function}.cpp").read_text(encoding="utf-8")


def beginning_with(statement: str, function: str, *includes: str) -> str:
    """Returns the right answer with another first statement."""
    source, count = _CALL.subn(lambda call: f"{call[0]}\n  {statement}", right(function), count=1)
    if count != 1:
        sys.exit(f"{function} begins in an unknown way")
    return "".join(f"#include <{header}>\n" for header in includes) + source
