"""kill.py PROGRAMS FILE...: passes if each wrong answer in the files fails the test that it names.

And if each right answer in them passes all tests of its exercise.

The test must fail by one of its checks, and its message must contain the mutant's words, since students will read
them. A crash, a skip or a time-out does not count. Each answer has a process of its own. The folder PROGRAMS holds a
chapter's wrong answers in one program, mutants_04_gauss_seidel: see together.py.
"""

import os
import signal
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOOLS / "mutation"), str(TOOLS / "course")]
from answer import Answer  # noqa: E402
from answers import by_exercise, exercise_of, read_answers  # noqa: E402
from crowd import VARIABLE  # noqa: E402
from errors import CourseError  # noqa: E402
from trial import Trial, run_tests, time_limit  # noqa: E402


def judged(program: Path, files: list[Path]) -> dict[Answer, str]:
    """Returns for each answer why it is not killed by its test, or, if right, why it does not pass; empty if all is
    well."""
    exercise = exercise_of(files[0])
    reasons: dict[Answer, str] = {}
    for answer in read_answers(files):
        if answer.is_right:
            reason = _not_passed(run_tests(program, f"{exercise.suite}.*", more={VARIABLE: answer.full_name}))
        # `./course check` runs no other suite: if only another noticed, the student would be told "done".
        elif answer.test.split(".")[0] != exercise.suite:
            reason = f"{answer.test} is not a test of {exercise.label}; its suite is {exercise.suite}"
        else:
            trial = run_tests(program, answer.test, more={VARIABLE: answer.full_name})
            reason = _not_failed(answer.test, trial) or _not_said(answer.says, trial)
        reasons[answer] = reason
    return reasons


def _not_passed(trial: Trial) -> str:
    if not trial.tests:
        return f"a right answer, but the program ended early (exit code {trial.exit_code}): {trial.output[-500:]}"
    for test in trial.tests:
        if test.skipped or test.failures:
            return f"a right answer, but {test.name} refuses it: {' '.join(' '.join(test.failures).split())}"
    return "" if trial.exit_code == 0 else f"a right answer, but the exit code is {trial.exit_code}"


def _not_failed(test: str, trial: Trial) -> str:
    if trial.timed_out:
        return f"{test} was not done after {time_limit():g} s"
    if trial.exit_code < 0:
        return f"{test} crashed ({signal.Signals(-trial.exit_code).name}), which does not count"
    if trial.tests is None:
        return f"{test} ended the program (exit code {trial.exit_code}), which does not count"
    if [found.name for found in trial.tests] != [test]:
        return f"there is no test {test}"
    if trial.tests[0].skipped:
        return f"{test} was skipped"
    return "" if trial.tests[0].failures else f"{test} passes: the mutant lives"


def _not_said(text: str, trial: Trial) -> str:
    said = " ".join(" ".join(trial.tests[0].failures).split())
    return "" if " ".join(text.split()) in said else f"the failure does not say '{text}', but: {said}"


def main(words: list[str]) -> int:
    if len(words) < 2:
        print("usage: kill.py PROGRAMS FILE...", file=sys.stderr)
        return 2
    programs, *paths = (Path(word).resolve() for word in words)
    exercises = by_exercise(paths)
    try:
        with ThreadPoolExecutor(os.cpu_count()) as workers:
            chapters = [programs / f"mutants_{files[0].parent.name}" for files in exercises]
            found = workers.map(judged, chapters, exercises)
            reasons = {answer: reason for some in found for answer, reason in some.items()}
    except CourseError as error:
        print(error, file=sys.stderr)
        return 1
    except OSError as error:
        print(f"{error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    for answer, reason in reasons.items():
        if reason:
            print(f"{answer.place}: {reason}", file=sys.stderr)
    wrong = [not reason for answer, reason in reasons.items() if not answer.is_right]
    right = [not reason for answer, reason in reasons.items() if answer.is_right]
    passed = f", {sum(right)} of {len(right)} right answers passed" if right else ""
    print(f"{sum(wrong)} of {len(wrong)} mutants killed{passed}")
    return 0 if all(wrong + right) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
