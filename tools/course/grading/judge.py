"""The verdict of each test of one exercise of one submission. Every expected test gets one."""

import hashlib
import json
import os
import re
import shutil
import signal
import tempfile
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import crash
from grading.confined import Limits
from grading.isolation import Isolation, User
from grading.objects import STILL_A_STUB, Made, make
from grading.pair import SLOW, Pair, Ran
from grading.submission import Source
from grading.workshop import Workshop
from manifest import Exercise
from marker import is_empty, is_stub

PASSED, FAILED, NOT_STARTED, DOES_NOT_COMPILE = "passed", "failed", "not started", "does not compile"
TIMED_OUT, CRASHED, OUT_OF_MEMORY = "timed out", "crashed", "out of memory"
TOO_MUCH_OUTPUT, ENDED_EARLY, TAMPERED = "too much output", "ended early", "tampered"
VERDICTS = (PASSED, FAILED, NOT_STARTED, DOES_NOT_COMPILE, TIMED_OUT, CRASHED, OUT_OF_MEMORY, TOO_MUCH_OUTPUT,
            ENDED_EARLY, TAMPERED)

LOOPED, WAITED, NOT_RUN = "looped", "waited", "not run"  # reasons of TIMED_OUT
# The same, whether its processor time was up or, on a busy machine, that on the clock.
_DOES_IT_END = "It was stopped because its time was up. Does a loop never end?"
_THREADED = {"solve_in_colours"}  # they start threads
_THREADS = {"processes": 300, "stack": 1 << 20}  # they may start 256, whose stacks must have room in the memory allowed
_FORGOTTEN = "forgotten"  # written when --fresh was last given: what is older is not recalled
_PRINTED = 4000  # characters kept of what the student's code printed
_MESSAGE = 20_000
_LAST_WORDS = 4000  # characters of what it printed, in which an assertion is sought
# An answer may use three times the processor time of the reference for each exercise, and this many seconds; more counts.
_TIMES, _FREE = 3, 3.0
_WORKED = 0.5  # seconds of processor time, above which what the clock has stopped did more than wait
_BUSY = 8  # times as long as its processor time is what a test may take on the clock of a machine with much to do
_NOT_SENT = 97  # exit code of tests/remote/answering.cpp, most often where an answer is longer than a message may be
_PREFIX = re.compile(r"\AFailed\n")


@dataclass
class TestVerdict:
    test: str  # Suite.Name
    verdict: str
    reason: str = ""  # in a few words, such as a signal
    message: str = ""
    printed: str = ""
    waited: float = 0.0  # seconds that it waited although it was not stopped


@dataclass
class ExerciseVerdict:
    tests: list[TestVerdict]
    notes: list[str]
    used: float = 0.0  # seconds of processor time, of the compiler and of tests whose time was not up


class Judge:
    """Judges with fixed limits and a fixed seed, and remembers verdicts: the same file always gets the same one."""

    def __init__(self, workshop: Workshop, isolation: Isolation, seed: int, seconds: int, of_exercise: int,
                 memory: Path, forget: bool = False, seeds: dict[str, int] | None = None):
        """Takes the seconds of a test, and the limit of time-outs of an exercise, after which no more of its tests run.
        With `forget`, verdicts of earlier runs are not used, by this one or a later. `seeds`: of tests with another
        seed."""
        self._seeds = {test: other for test, other in (seeds or {}).items() if other != seed}
        self._workshop, self._isolation, self._seed, self._of_exercise = workshop, isolation, seed, of_exercise
        self._limits = Limits(cpu=seconds, wall=3 * seconds + 2, memory=1 << 30, files=1 << 20, processes=16,
                              output=1 << 20)
        self._memory = memory
        self._usual: dict[str, float] = {}  # seconds of processor time that the reference uses, by exercise
        memory.mkdir(parents=True, exist_ok=True)
        if forget:
            (memory / _FORGOTTEN).touch()
        self._since = (memory / _FORGOTTEN).stat().st_mtime_ns if (memory / _FORGOTTEN).exists() else 0

    def unjudged(self, exercise: Exercise) -> ExerciseVerdict:
        return _all(self._workshop.expected_tests(exercise), NOT_STARTED, "not graded yet")

    def without_time(self, exercise: Exercise) -> ExerciseVerdict:
        return _all(self._workshop.expected_tests(exercise), TIMED_OUT, NOT_RUN,
                    "The submission's time was up: too many of its tests were slow, or had to be stopped before.")

    def not_judged(self, exercise: Exercise, error: Exception) -> ExerciseVerdict:
        return _all(self._workshop.expected_tests(exercise), NOT_STARTED, "could not be graded",
                    f"The grader itself has failed here ({type(error).__name__}): {error}"[:_MESSAGE])

    def lost(self, exercise: Exercise, verdict: ExerciseVerdict) -> float:
        """Returns the seconds lost to time-outs, by kind, to waiting, and to more work than an answer needs."""
        cost = {LOOPED: self._limits.cpu, WAITED: self._limits.wall}
        return self._excess(exercise, verdict.used) + sum(cost.get(test.reason, 0) if test.verdict == TIMED_OUT else
                                                          test.waited for test in verdict.tests)

    def _excess(self, exercise: Exercise, used: float) -> float:
        return max(0.0, used - max(_FREE, _TIMES * self._usual.get(exercise.function, 0.0)))

    def judge(self, exercise: Exercise, source: Source | None, user: User) -> ExerciseVerdict:
        tests = self._workshop.expected_tests(exercise)
        if source is None:
            missing = f"chapters/{exercise.folder}/{exercise.file.name} was not handed in."
            return _all(tests, NOT_STARTED, "file missing", missing)
        if source.problem:
            verdict = TAMPERED if source.is_link else DOES_NOT_COMPILE
            return _all(tests, verdict, "file not taken", source.problem)
        if is_empty(source.text):
            return _all(tests, NOT_STARTED, "file empty", f"{source.path} has no code.")
        key = self._key(exercise, source)
        known = self._recall(key)
        if known is None or [test.test for test in known.tests] != tests:
            known, certain = self._judge_anew(exercise, source, tests, user)
            right = all(test.verdict == PASSED for test in known.tests)
            if right or not source.is_reference:  # the reference has another try: a slow machine may have stopped it
                self._remember(key, known, 0.0 if certain else _load())
        if source.is_reference:
            self._usual[exercise.function] = known.used
        return known

    def _judge_anew(self, exercise: Exercise, source: Source, tests: list[str],
                    user: User) -> tuple[ExerciseVerdict, bool]:
        """Returns the verdict, and whether an idle machine would give the same."""
        folder = Path(tempfile.mkdtemp(dir=self._workshop.root))
        folder.chmod(0o755)
        try:
            made = make(exercise, source, self._workshop, self._isolation, user, folder)
            if made.verdict == DOES_NOT_COMPILE and is_stub(source.text):
                return _all(tests, NOT_STARTED, message=STILL_A_STUB), True
            if not made.program:
                verdict = replace(_all(tests, made.verdict, made.reason, made.message), used=made.used)
                return verdict, "stopped by a limit" not in made.message
            ran, used = self._run_all(exercise, tests, made, user)
            return (ExerciseVerdict([verdict for verdict, _ in ran], list(made.notes), round(used, 1)),
                    all(sure for _, sure in ran))
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def _run_all(self, exercise: Exercise, tests: list[str], made: Made,
                 user: User) -> tuple[list[tuple[TestVerdict, bool]], float]:
        """Runs all tests with one pair of processes, or with another after one that could not continue. Returns also
        the seconds of processor time, with those of the compiler."""
        ran: list[tuple[TestVerdict, bool]] = []
        pair, seed, was_stopped, used = None, self._seed, False, made.used
        try:
            for test in tests:
                if pair and not pair.alive and not pair.was_asked:
                    # It ends before it can be asked anything, and would for every test.
                    ran.append((replace(ran[-1][0], test=test), ran[-1][1]))
                    continue
                so_far = ExerciseVerdict([verdict for verdict, _ in ran], [], used)
                if self.lost(exercise, so_far) >= self._of_exercise:
                    verdict = TestVerdict(test, TIMED_OUT, NOT_RUN, "The exercise's time was up: too many of its tests "
                                          "were slow, or had to be stopped before.")
                    ran.append((verdict, not self._excess(exercise, used) and not any(one.waited for one in so_far.tests)))
                    continue
                if pair and pair.alive and self._seed_of(test) != seed:
                    used += pair.used_since()
                    pair.close()
                seed = self._seed_of(test)
                if not pair or not pair.alive:
                    pair = self._pair(exercise, made.program, user, seed)
                told = pair.run(test)
                if told.timed_out and not was_stopped:
                    # A machine that is busy or stands still looks the same. Once an exercise, so that it costs little.
                    was_stopped, pair = True, self._pair(exercise, made.program, user, seed)
                    told = pair.run(test)
                ran.append(self._verdict(test, told))
                if ran[-1][0].verdict != TIMED_OUT:  # which costs a fixed number of seconds
                    used += told.used
            used += pair.used_since() if pair else 0.0
        finally:
            if pair and pair.alive:
                pair.close()
        return ran, used

    def _seed_of(self, test: str) -> int:
        return self._seeds.get(test, self._seed)

    def _pair(self, exercise: Exercise, program: Path, user: User, seed: int) -> Pair:
        return Pair(self._isolation, user, self._workshop.test_program(exercise), exercise.function, program,
                    self._limits_of(exercise), {"SPOOK_SEED": str(seed)}, threads=exercise.function in _THREADED)

    def _limits_of(self, exercise: Exercise) -> Limits:
        return replace(self._limits, **_THREADS) if exercise.function in _THREADED else self._limits

    def _verdict(self, test: str, ran: Ran) -> tuple[TestVerdict, bool]:
        verdict, reason, failures = read_verdict(ran, self._limits.cpu)
        message = "\n\n".join(_PREFIX.sub("", failure).rstrip() for failure in failures)
        return (TestVerdict(test, verdict, reason, message[:_MESSAGE], ran.output[:_PRINTED].strip(),
                            _waited(ran)),
                not ran.timed_out or reason == WAITED)

    def _key(self, exercise: Exercise, source: Source) -> str:
        limits = repr((self._limits_of(exercise), self._of_exercise))
        seeds = repr([self._seed_of(test) for test in self._workshop.expected_tests(exercise)])
        parts = [self._workshop.build, exercise.label, seeds, limits, self._isolation.name]
        return hashlib.sha256("\0".join(parts).encode() + b"\0" + source.content).hexdigest()

    def _recall(self, key: str) -> ExerciseVerdict | None:
        file = self._memory / f"{key}.json"
        try:
            if file.stat().st_mtime_ns < self._since:
                return None
            found = json.loads(file.read_text(encoding="utf-8"))
            if found["load"] > 1 and _load() < found["load"] / 2:
                return None  # it was stopped by the clock, on a machine that was busy, and is less so now
            return ExerciseVerdict([TestVerdict(**test) for test in found["tests"]], found["notes"], found["used"])
        except (OSError, ValueError, TypeError, KeyError):
            return None  # never written, or cut off

    def _remember(self, key: str, verdict: ExerciseVerdict, load: float) -> None:
        """Stores the verdict, with the machine's load if the clock stopped one of the tests; else 0."""
        with tempfile.NamedTemporaryFile("w", dir=self._memory, delete=False, encoding="utf-8") as file:
            json.dump(asdict(verdict) | {"load": load}, file)
        os.replace(file.name, self._memory / f"{key}.json")


def _waited(ran: Ran) -> float:
    """Returns the seconds of waiting. On a busy machine a test waits, too, but not for much longer than it computes."""
    return round(max(ran.clock - SLOW - _BUSY * ran.used, 0.0), 1) if ran.clock > SLOW else 0.0


def read_verdict(ran: Ran, cpu_limit: int) -> tuple[str, str, list[str]]:
    """Returns the verdict, its reason in a few words, and the failures."""
    if ran.too_much:
        return TOO_MUCH_OUTPUT, "", ["It printed more than the limit, and was stopped."]
    if ran.timed_out and ran.cpu < _WORKED:
        return TIMED_OUT, WAITED, ["It was stopped while waiting. Does it wait for input, or for a thread?"]
    if ran.timed_out:
        return TIMED_OUT, LOOPED, [_DOES_IT_END]
    if ran.nonsense:
        return TAMPERED, "a forged answer", ["The tests received something other than the function's answer."]
    if ran.verdict is None:
        return _without_verdict(ran, cpu_limit)
    result, ran_count, skipped = (field.decode() for field in ran.verdict[:3])
    failures = [field.decode("utf-8", errors="replace") for field in ran.verdict[3:]]
    if any("std::bad_alloc" in failure for failure in failures):
        return OUT_OF_MEMORY, "", failures
    if failures:
        return FAILED, "", failures
    if ran_count != "1" or skipped or result != "0":
        return FAILED, "skipped" if skipped else "no test ran", ["The test was not run to its end."]
    return PASSED, "", []


def _without_verdict(ran: Ran, cpu_limit: int) -> tuple[str, str, list[str]]:
    number = _signal(ran.code)
    if number == signal.SIGXCPU or (number == signal.SIGKILL and ran.cpu >= cpu_limit):
        return TIMED_OUT, LOOPED, [_DOES_IT_END]
    if number == signal.SIGABRT and "std::bad_alloc" in ran.output:
        return OUT_OF_MEMORY, "", ["It requested more memory than available."]
    if number:
        return CRASHED, _name(number), [crash.explained(_name(number), ran.output[-_LAST_WORDS:], None)]
    if ran.tests_code:  # the test, and not the function: it could not work with what it got
        of_test = _signal(ran.tests_code)
        if of_test in (signal.SIGXCPU, signal.SIGKILL):
            return TIMED_OUT, LOOPED, ["The test's time was up while it was computing with the answer."]
        return CRASHED, _name(of_test) if of_test else f"exit code {ran.tests_code}", [
            "The test could not use the answer: it has an invalid size or index."]
    asked = "Is its answer far too large?" if ran.code == _NOT_SENT else "Does it call exit?"
    return ENDED_EARLY, f"exit code {ran.code}", [f"The program ended before the test did. {asked}"]


def _load() -> float:
    """Returns the number of processes per processor."""
    return os.getloadavg()[0] / (os.cpu_count() or 1)


def _signal(code: int) -> int:
    """Returns the signal. Bubblewrap reports a program ended by a signal as 128 plus the signal."""
    return -code if code < 0 else code - 128 if 128 < code < 128 + signal.NSIG else 0


def _name(number: int) -> str:
    return signal.Signals(number).name if number in set(signal.Signals) else f"signal {number}"


def _all(tests: list[str], verdict: str, reason: str = "", message: str = "") -> ExerciseVerdict:
    return ExerciseVerdict([TestVerdict(test, verdict, reason, message[:_MESSAGE]) for test in tests], [])
