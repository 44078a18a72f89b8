"""The state of an exercise, and its reason."""

import re
import signal
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import crash
import diagnostics
from exercise_object import drop_if_stale
from manifest import Exercise
from marker import code_of, is_empty, marker_line, source_line
from paths import shown
from races import Races, races_of
from symbols import missing_functions
from text_encoding import complaint
from tree import Built, Tree, jobs
from trial import Test, Trial, clock_limit, run_tests, time_limit

CHECK = Tree("check")
_WHOLE_DIVISION = re.compile(r"(?<![\w.'])(\d+)\s*/\s*(\d+)(?![\w.'])")
_BOILERPLATE = re.compile(r"\A[^\n]*:\d+\n(?:Failed\n)?")


@dataclass
class Verdict:
    exercise: Exercise
    state: str  # done, wrong, not started
    reason: str = ""  # in a few words
    details: str = ""  # the first failure, or what the compiler said
    printed: str = ""  # by the student's code in that test
    others: list[str] = field(default_factory=list)  # further tests that fail
    tests: int = 0
    warnings: list[str] = field(default_factory=list)
    note: str = ""  # what could not be tested
    source: str | None = None  # the judged text; None if it was saved while it was built or tested


def judge(exercise: Exercise, seed: int | None = None) -> Verdict:
    """Builds and tests the student's file."""
    source = exercise.source()
    verdict = without_building(exercise) or _judge_built(exercise, _build([exercise]), seed)
    verdict.source = source if exercise.source() == source else None
    return verdict


def judge_all(exercises: list[Exercise], seed: int | None = None) -> list[Verdict]:
    """Judges several exercises: one build, and the tests side by side."""
    sources = [exercise.source() for exercise in exercises]
    to_build = [exercise for exercise in exercises if not without_building(exercise)]
    built = _build(to_build) if to_build else Built(True, "")

    def verdict(exercise: Exercise) -> Verdict:
        if exercise not in to_build:
            return without_building(exercise)
        if CHECK.failed(built, *_targets(exercise)):
            return judge(exercise, seed)  # alone, for its own errors only
        return _judge_built(exercise, Built(True, built.output), seed)

    pool = ThreadPoolExecutor(jobs())
    try:
        verdicts = list(pool.map(verdict, exercises))
    finally:
        # After Ctrl-C, which the running tests get, too, no others are begun.
        pool.shutdown(cancel_futures=True)
    for one, source in zip(verdicts, sources):
        one.source = source if one.exercise.source() == source else None
    return verdicts


def _targets(exercise: Exercise) -> tuple[str, str]:
    return f"check_{exercise.function}", f"exercise_{exercise.function}"


def _build(exercises: list[Exercise]) -> Built:
    what = f"building {exercises[0].label}" if len(exercises) == 1 else f"building {len(exercises)} exercises"
    if not all(_tests_are_built(exercise) for exercise in exercises):
        what += " and the tests of the chapter (half a minute, the first time)"
    for exercise in exercises:
        drop_if_stale(CHECK, exercise)
    built = CHECK.build([_targets(exercise)[0] for exercise in exercises], what, keep_going=True)
    if not built.ok and not any(CHECK.failed(built, *_targets(exercise)) for exercise in exercises):
        raise CHECK.own_failure(built)
    return built


def _tests_are_built(exercise: Exercise) -> bool:
    return any((CHECK.path / "tests" / "CMakeFiles" / f"tests_{exercise.folder}.dir").glob("**/*.o"))


def _judge_built(exercise: Exercise, built: Built, seed: int | None) -> Verdict:
    if not built.ok:
        details = "\n".join(diagnostics.first_error(built.output, exercise))
        return Verdict(exercise, "wrong", "does not compile", details)
    missing = missing_functions(CHECK, exercise)
    if missing:
        return _without_function(exercise, missing)
    program = CHECK.program(_targets(exercise)[0])
    trial = run_tests(program, f"{exercise.suite}.*", seed, exercise=exercise)
    verdict = _judge_trial(exercise, trial)
    races = Races() if trial.timed_out else races_of(CHECK, exercise)
    verdict.note = races.skipped
    # What a data race gives is another number in each run.
    if races.found:
        verdict = _with_race(verdict, races.found)
    elif verdict.details and "data race" not in verdict.details and _depends_on_calls_before(program, trial, seed):
        verdict.details = ("This test gives another result when it runs alone. Does your code keep a value between "
                           "calls, in a static or global variable? Or does it read a variable that was never "
                           "set?\n\n" + verdict.details)
    verdict.warnings = diagnostics.warnings(built.output, exercise)
    return verdict


def _with_race(verdict: Verdict, found: str) -> Verdict:
    """Returns the verdict on an answer with a data race, which explains whatever else fails."""
    failing = re.findall(r"^fails (\S+)", verdict.reason) + verdict.others
    return Verdict(verdict.exercise, "wrong", "has a data race", found, verdict.printed, failing,
                   verdict.tests + 1 if verdict.tests else 0)


def without_building(exercise: Exercise) -> Verdict | None:
    """Returns the verdict if the file alone determines it."""
    source = exercise.source()
    if source is None:
        return Verdict(exercise, "wrong", "file missing", f"{shown(exercise.file)} is not there; "
                                                          f"./course reset {exercise.id} puts the stub back.")
    if odd := complaint(exercise.file):
        return Verdict(exercise, "wrong", "not saved as UTF-8", odd)
    if is_empty(source):
        return Verdict(exercise, "not started", details=f"{shown(exercise.file)} has no code; "
                                                        f"./course reset {exercise.id} puts the stub back.")
    line = marker_line(source)
    if line is None:
        return None
    return Verdict(exercise, "not started", details=f"{shown(exercise.file)}:{line} still calls "
                                                    "not_implemented(); write the function in its place.")


def _without_function(exercise: Exercise, missing: list[str]) -> Verdict:
    details = "\n".join([f"{shown(exercise.file)} compiles, but does not define",
                         *(f"  {name}" for name in missing),
                         "Name, parameters and namespace must be as the chapter's header declares them."])
    return Verdict(exercise, "wrong", "function not defined", details)


def _judge_trial(exercise: Exercise, trial: Trial) -> Verdict:
    if trial.timed_out and trial.exit_code == -signal.SIGKILL:
        return _broken_off(exercise, trial, f"timed out after {clock_limit():g} s on the clock",
                           "Does it wait for something, such as another thread? Or is this machine busy with "
                           "other work?")
    if trial.timed_out:
        return _broken_off(exercise, trial, f"timed out after {time_limit():g} s", "Does a loop never end?")
    if trial.exit_code < 0:
        name = signal.Signals(-trial.exit_code).name
        return _broken_off(exercise, trial, crash.ending(name, trial.output),
                           crash.explained(name, trial.output, trial.crashed_at))
    if trial.tests is None:
        return _broken_off(exercise, trial, f"ended early (exit code {trial.exit_code})", "Does it call exit?")
    skipped = [test.name for test in trial.tests if test.skipped]
    failed = [test for test in trial.tests if test.failures]
    if failed:
        return _failing(exercise, trial, failed)
    if skipped or not trial.tests or trial.exit_code != 0:
        reason = (f"{skipped[0]} was skipped" if skipped else "no test ran" if not trial.tests
                  else f"exit code {trial.exit_code} after all tests passed")
        return Verdict(exercise, "wrong", reason, tests=len(trial.tests))
    return Verdict(exercise, "done", tests=len(trial.tests))


def _first(failed: list[Test]) -> Test:
    """Returns the failure to show: that with the highest rank, and the first of equal ones."""
    return max(failed, key=lambda test: test.rank)


def _depends_on_calls_before(program: Path, trial: Trial, seed: int | None) -> bool:
    """Tells whether the shown failure changes or vanishes when its test runs alone."""
    failed = [test for test in trial.tests or [] if test.failures]
    if not failed:
        return False
    first = _first(failed)
    alone = run_tests(program, first.name, seed)
    return bool(alone.tests) and _what(alone.tests[0]) != _what(first)


def _what(test: Test) -> list[str]:
    """Returns the subject of each failure without numbers, since times differ."""
    return [re.sub(r"[\d.e+-]+", "", _BOILERPLATE.sub("", failure).partition("\n")[0]) for failure in test.failures]


def _failing(exercise: Exercise, trial: Trial, failed: list[Test]) -> Verdict:
    first = _first(failed)
    printed = trial.printed_by(first.name)
    for failure in first.failures:
        place, _, text = failure.partition("\n")
        printed = printed.replace(f"{place}: Failure\n{text}".rstrip(), "")
    details = _BOILERPLATE.sub("", first.failures[0]).rstrip()
    if len(first.failures) > 1:
        details += f"\n(and {len(first.failures) - 1} more in this test)"
    if lost := whole_division(exercise.source() or ""):
        details += f"\n\n{lost}"
    return Verdict(exercise, "wrong", f"fails {first.name}", details, printed.strip(),
                   [test.name for test in failed if test is not first], len(trial.tests))


def whole_division(source: str) -> str:
    """Names the first division of two whole numbers that drops a fraction; empty if there is none. In h * 1 / 3 there is
    none, as h * 1 comes first."""
    for found in _WHOLE_DIVISION.finditer(code_of(source)):
        left, right = int(found[1]), int(found[2])
        if right and left % right and not found.string[:found.start()].rstrip().endswith(("*", "/")):
            line = source_line(found.string, found.start())
            return (f"Line {line} has {found[0]}. C++ divides whole numbers without the fraction, so this is {left // right}: "
                    f"write {left}.0 / {right}.")
    return ""


def _broken_off(exercise: Exercise, trial: Trial, what: str, question: str) -> Verdict:
    where = f" in {trial.unfinished}" if trial.unfinished else ""
    return Verdict(exercise, "wrong", what + where, question,
                   printed=crash.without_assertion(trial.printed_by(trial.unfinished)).strip())
