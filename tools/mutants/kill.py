"""kill.py SOURCE PROGRAM NUMBER: passes if the wrong answer in SOURCE fails the test that its header
names.

    // Wrong: adds the force alone.
    // Killed by: Kick.AddsForceOverMass
    // Says: the force has not been divided by the mass

The test must fail by one of its checks, and the failure must say what the header promises: that is what the
student will read. A crash, a skip or running out of time doesn't count. PROGRAM holds it as mutant NUMBER: see
together.py.
"""

import re
import signal
import sys
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOOLS / "mutation"), str(TOOLS / "course")]
from crowd import VARIABLE  # noqa: E402
from errors import CourseError  # noqa: E402
from manifest import Exercise, all_exercises  # noqa: E402
from trial import Trial, run_tests, time_limit  # noqa: E402

_FIELD = re.compile(r"^(Wrong|Killed by|Says): *")


def header(source: Path) -> dict[str, str]:
    """The fields of the comment at the top; a field may go on over several lines."""
    fields: dict[str, str] = {}
    name = ""
    for line in source.read_text(encoding="utf-8").splitlines():
        if not line.startswith("//"):
            break
        text = line.lstrip("/").strip()
        found = _FIELD.match(text)
        if found:
            name = found[1]
            text = text[found.end():]
        if name:
            fields[name] = f"{fields.get(name, '')} {text}".strip()
    return fields


def mutated(source: Path) -> Exercise:
    """The exercise to which this is a wrong answer: 04_gauss_seidel/update_row.clamps_change.cpp."""
    function = source.name.split(".")[0]
    for exercise in all_exercises():
        if (exercise.folder, exercise.function) == (source.parent.name, function):
            return exercise
    raise CourseError(f"{source.parent.name} has no exercise {function}")


def judge(source: Path, program: Path, number: str) -> str:
    """Why the mutant is not killed as promised; empty if it is."""
    fields = header(source)
    absent = [name for name in ("Wrong", "Killed by", "Says") if not fields.get(name)]
    if absent:
        return f"the header lacks '{absent[0]}: ...'"
    test, exercise = fields["Killed by"], mutated(source)
    # `./course check` runs no other suite: if only another noticed, the student would be told "done".
    if test.split(".")[0] != exercise.suite:
        return f"'Killed by: {test}' is not a test of {exercise.label}; its suite is {exercise.suite}"
    trial = run_tests(program, test, more={VARIABLE: number})
    return _not_failed(test, trial) or _not_said(fields["Says"], trial)


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


def main(arguments: list[str]) -> int:
    if len(arguments) != 3:
        print("usage: kill.py SOURCE PROGRAM NUMBER", file=sys.stderr)
        return 2
    source = Path(arguments[0]).resolve()
    try:
        reason = judge(source, Path(arguments[1]).resolve(), arguments[2])
    except CourseError as error:
        reason = str(error)
    except OSError as error:
        reason = f"{error.strerror}: {error.filename}"
    if reason:
        print(f"{source.parent.name}/{source.name}: {reason}", file=sys.stderr)
    return 1 if reason else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
