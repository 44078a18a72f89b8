"""Reads submissions in a process of its own: a delivery can cost time and memory, but not the whole class.

The process gets its request in a JSON file, and writes its answer into another.
"""

import base64
import json
import os
import resource
import signal
import sys
import tempfile
from pathlib import Path, PurePosixPath

from grading.archives import is_archive, names_in
from grading.choices import ATTEMPTS
from grading.confined import Limits, run
from grading.names import Student
from grading.submission import UNREAD, Handed, Place, Source, Submission, read_submission
from manifest import Exercise, all_exercises

_READING = Limits(cpu=30, wall=120, memory=2 << 30, files=128 << 20, processes=0, output=1 << 16)
_COURSE = Path(__file__).resolve().parent.parent
# Nothing is imported from the folder where the command was given: students' files may lie there.
_START = "import sys; sys.path.insert(0, sys.argv[1]); from grading.reading import answer; answer(*sys.argv[2:])"


class NotRead(Exception):
    """The submission was not read, for this reason."""


def read_apart(handed: Handed, exercises: list[Exercise], attempt: str = ATTEMPTS[0]) -> Submission:
    """Reads a submission as read_submission does. One beyond the limits has no files, and a note gives the reason.

    Folders without an archive are read here, since nothing in them is unpacked.
    """
    if all(place.path.is_dir() and not any(is_archive(name.name) for name in names_in(place.path, opened=False))
           for place in handed.places):
        return read_submission(handed, exercises, attempt)
    try:
        found, seconds = _asked({"places": [[str(place.path), place.inside] for place in handed.places],
                                 "late": handed.student.late, "attempt": attempt,
                                 "exercises": [exercise.function for exercise in exercises]})
    except NotRead as error:
        return Submission(handed.name, handed.student, {}, [*handed.notes, f"it {UNREAD}: {error}"])
    sources = {function: _unpacked(source) for function, source in found["sources"].items()}
    attempts = {function: [_unpacked(source) for source in some] for function, some in found["attempts"].items()}
    return Submission(handed.name, handed.student, sources, [*handed.notes, *found["notes"]], attempts, seconds)


def names_apart(path: Path) -> list[PurePosixPath]:
    """Returns the names in an archive and, if time allows, in archives inside it; none of damaged ones."""
    for opened in (True, False):
        try:
            return [PurePosixPath(name) for name in _asked({"names": str(path), "opened": opened})[0]]
        except NotRead:
            continue
    return []


def _asked(request: dict) -> tuple[dict | list, float]:
    """Returns the answer, and the seconds of processor time that it took."""
    with tempfile.TemporaryDirectory(prefix="reading-") as folder:
        asked, answered = Path(folder, "request"), Path(folder, "answer")
        limits = {"cpu": _READING.cpu, "memory": _READING.memory, "files": _READING.files}
        asked.write_text(json.dumps(request | {"limits": limits}), encoding="utf-8")
        command = [sys.executable, "-I", "-S", "-c", _START, str(_COURSE), str(asked), str(answered)]
        ended = run(command, _READING, dict(os.environ))
        if ended.code == 0 and not ended.timed_out and not ended.too_much:
            return json.loads(answered.read_text(encoding="utf-8")), ended.cpu
    if ended.timed_out or ended.code in (-signal.SIGXCPU, -signal.SIGKILL):
        raise NotRead("that takes too long")
    if "MemoryError" in ended.output:
        raise NotRead("that takes too much memory")
    raise NotRead((ended.output.strip().splitlines() or [f"exit code {ended.code}"])[-1][:200])


def answer(asked: str, answered: str) -> None:
    """Answers the request, in the separate process."""
    request = json.loads(Path(asked).read_text(encoding="utf-8"))
    for kind, limit in ((resource.RLIMIT_CPU, "cpu"), (resource.RLIMIT_AS, "memory"), (resource.RLIMIT_FSIZE, "files")):
        resource.setrlimit(kind, (request["limits"][limit], request["limits"][limit]))
    found = _names(request) if "names" in request else _submission(request)
    Path(answered).write_text(json.dumps(found), encoding="utf-8")


def _names(request: dict) -> list[str]:
    return [str(name) for name in names_in(Path(request["names"]), request["opened"])]


def _submission(request: dict) -> dict:
    exercises = [exercise for exercise in all_exercises() if exercise.function in request["exercises"]]
    places = tuple(Place(Path(path), inside) for path, inside in request["places"])
    submission = read_submission(Handed("", places, Student("", late=request["late"])), exercises, request["attempt"])
    attempts = {function: [_packed(source) for source in some] for function, some in submission.attempts.items()}
    return {"sources": {function: _packed(source) for function, source in submission.sources.items()},
            "attempts": attempts, "notes": submission.notes}


def _packed(source: Source) -> list:
    return [source.path, base64.b64encode(source.content).decode(), source.problem, source.is_link]


def _unpacked(packed: list) -> Source:
    path, content, problem, is_link = packed
    return Source(path, base64.b64decode(content), problem, is_link)
