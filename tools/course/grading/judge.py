"""The verdict of each test of one exercise of one submission. Every test that is expected gets one."""

import hashlib
import json
import os
import re
import secrets
import shutil
import signal
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

from grading.confined import Ended, Limits
from grading.isolation import Isolation, User
from grading.objects import make
from grading.submission import Source
from grading.workshop import Workshop
from manifest import Exercise
from marker import is_stub

PASSED, FAILED, NOT_STARTED, DOES_NOT_COMPILE = "passed", "failed", "not started", "does not compile"
TIMED_OUT, CRASHED, OUT_OF_MEMORY = "timed out", "crashed", "out of memory"
TOO_MUCH_OUTPUT, ENDED_EARLY, TAMPERED = "too much output", "ended early", "tampered"
VERDICTS = (PASSED, FAILED, NOT_STARTED, DOES_NOT_COMPILE, TIMED_OUT, CRASHED, OUT_OF_MEMORY, TOO_MUCH_OUTPUT,
            ENDED_EARLY, TAMPERED)

_PRINTED = 4000  # characters kept of what the student's code printed
_MESSAGE = 20_000
_PREFIX = re.compile(r"\AFailed\n")
_NONCE_BYTES = 16  # twice as many hexadecimal digits


@dataclass
class TestVerdict:
    test: str  # Suite.Name
    verdict: str
    reason: str = ""  # in a few words, such as a signal
    message: str = ""
    printed: str = ""


@dataclass
class ExerciseVerdict:
    tests: list[TestVerdict]
    notes: list[str]


class Judge:
    """Judges with fixed limits and a fixed seed, and remembers: the same file always gets the same verdict."""

    def __init__(self, workshop: Workshop, isolation: Isolation, seed: int, seconds: int, memory: Path | None):
        self._workshop, self._isolation, self._seed = workshop, isolation, seed
        self._limits = Limits(cpu=seconds, wall=3 * seconds + 2, memory=1 << 30, files=1 << 20, processes=16,
                              output=1 << 20)
        self._memory = memory

    def unjudged(self, exercise: Exercise) -> ExerciseVerdict:
        return _all(self._workshop.expected_tests(exercise), NOT_STARTED, "not graded yet")

    def judge(self, exercise: Exercise, source: Source | None, user: User) -> ExerciseVerdict:
        tests = self._workshop.expected_tests(exercise)
        if source is None:
            missing = f"chapters/{exercise.folder}/{exercise.file.name} was not handed in."
            return _all(tests, NOT_STARTED, "file missing", missing)
        if source.problem:
            verdict = TAMPERED if source.is_link else DOES_NOT_COMPILE
            return _all(tests, verdict, "file not taken", source.problem)
        if is_stub(source.content.decode("utf-8", errors="replace")):
            return _all(tests, NOT_STARTED, message="The file still calls not_implemented().")
        key = self._key(exercise, source)
        known = self._recall(key)
        if known is None or [test.test for test in known.tests] != tests:
            known, certain = self._judge_anew(exercise, source, tests, user)
            if certain:
                self._remember(key, known)
        return known

    def _judge_anew(self, exercise: Exercise, source: Source, tests: list[str],
                    user: User) -> tuple[ExerciseVerdict, bool]:
        """The verdict, and whether it would be the same on any machine: running out of time on the clock would not."""
        folder = Path(tempfile.mkdtemp(dir=self._workshop.root))
        folder.chmod(0o755)
        try:
            made = make(exercise, source, self._workshop, self._isolation, user, folder)
            if not made.program:
                return _all(tests, made.verdict, made.reason, made.message), "stopped by a limit" not in made.message
            ran = [self._run(test, made.program, user) for test in tests]
            return ExerciseVerdict([verdict for verdict, _ in ran], list(made.notes)), all(sure for _, sure in ran)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def _run(self, test: str, program: Path, user: User) -> tuple[TestVerdict, bool]:
        nonce = secrets.token_hex(_NONCE_BYTES).encode()
        ended = self._isolation.run([str(program), test], self._limits, user, (program,), nonce=nonce,
                                    env={"SPOOK_SEED": str(self._seed)})
        verdict, reason, failures = read_verdict(ended, nonce, self._limits.cpu)
        message = "\n\n".join(_PREFIX.sub("", failure).rstrip() for failure in failures)
        return (TestVerdict(test, verdict, reason, message[:_MESSAGE], ended.output[:_PRINTED].strip()),
                not ended.timed_out)

    def _key(self, exercise: Exercise, source: Source) -> str:
        parts = [self._workshop.build, exercise.label, str(self._seed), repr(self._limits), self._isolation.name]
        return hashlib.sha256("\0".join(parts).encode() + b"\0" + source.content).hexdigest()

    def _recall(self, key: str) -> ExerciseVerdict | None:
        if not self._memory:
            return None
        try:
            found = json.loads((self._memory / f"{key}.json").read_text(encoding="utf-8"))
            return ExerciseVerdict([TestVerdict(**test) for test in found["tests"]], found["notes"])
        except (OSError, ValueError, TypeError, KeyError):
            return None  # never written, or cut off

    def _remember(self, key: str, verdict: ExerciseVerdict) -> None:
        if self._memory:
            self._memory.mkdir(parents=True, exist_ok=True)
            with tempfile.NamedTemporaryFile("w", dir=self._memory, delete=False, encoding="utf-8") as file:
                json.dump(asdict(verdict), file)
            os.replace(file.name, self._memory / f"{key}.json")


def read_verdict(ended: Ended, nonce: bytes, cpu_limit: int) -> tuple[str, str, list[str]]:
    """The verdict, its reason in a few words, and the failures."""
    if ended.too_much:
        return TOO_MUCH_OUTPUT, "", ["It printed more than the limit, and was stopped."]
    if ended.timed_out:
        return TIMED_OUT, "", ["It was stopped: it waited for something that never came."]
    fields = ended.answer.split(b"\0")
    if ended.answer and not (len(fields) >= 6 and fields[0] == nonce and fields[-2] == nonce and not fields[-1]):
        return TAMPERED, "a forged verdict", ["Something else than the tests wrote to the grader."]
    if not ended.answer:
        return _without_verdict(ended, cpu_limit)
    result, ran, skipped = (field.decode() for field in fields[1:4])
    failures = [field.decode("utf-8", errors="replace") for field in fields[4:-2]]
    if any("std::bad_alloc" in failure for failure in failures):
        return OUT_OF_MEMORY, "", failures
    if failures:
        return FAILED, "", failures
    if ran != "1" or skipped or result != "0":
        return FAILED, "skipped" if skipped else "no test ran", ["The test was not run to its end."]
    return PASSED, "", []


def _without_verdict(ended: Ended, cpu_limit: int) -> tuple[str, str, list[str]]:
    # A program inside bubblewrap that a signal ends is reported with 128 and the signal.
    number = -ended.code if ended.code < 0 else ended.code - 128 if 128 < ended.code < 128 + signal.NSIG else 0
    if number == signal.SIGXCPU or (number == signal.SIGKILL and ended.cpu >= cpu_limit):
        return TIMED_OUT, "", [f"It was stopped after {cpu_limit} s of processor time. Does a loop never end?"]
    if number == signal.SIGABRT and "std::bad_alloc" in ended.output:
        return OUT_OF_MEMORY, "", ["It asked for more memory than there is."]
    if number:
        name = signal.Signals(number).name if number in set(signal.Signals) else f"signal {number}"
        return CRASHED, name, ["That is most often an index past the end, or a function that calls itself without end."]
    return ENDED_EARLY, f"exit code {ended.code}", ["The program ended before the test did. Does it call exit?"]


def _all(tests: list[str], verdict: str, reason: str = "", message: str = "") -> ExerciseVerdict:
    return ExerciseVerdict([TestVerdict(test, verdict, reason, message) for test in tests], [])
