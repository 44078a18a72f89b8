"""hidden.py PROGRAMS FILE...: passes if a chapter's hidden tests notice at least half of its wrong answers.

The FILEs are all wrong answers to one chapter's exercises, as in kill.py, which judges right answers by hidden tests,
too. An answer counts as noticed if a hidden test of its own exercise fails, whatever it says, or if the program ends
early: nobody reads the words of hidden tests. Half leaves room for mistakes that only the chapter's own tests look for,
such as absolute thresholds. With --list the answers that live are printed.
"""

import os
import re
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOOLS / "mutation"), str(TOOLS / "course")]
from answer import Answer  # noqa: E402
from answers import by_exercise, exercise_of, read_answers  # noqa: E402
from crowd import VARIABLE  # noqa: E402
from errors import CourseError  # noqa: E402
from manifest import Exercise  # noqa: E402
from paths import ROOT  # noqa: E402
from trial import run_tests  # noqa: E402

LEAST_SHARE = 0.5
_TEST = re.compile(r"^EXERCISE_TEST\((\w+), (\w+)\)", re.MULTILINE)


def tests_of(exercise: Exercise) -> list[str]:
    """The hidden tests of an exercise, as Suite.Name."""
    files = sorted((ROOT / "tests" / "hidden" / exercise.folder).glob("*.cpp"))
    found = [test for file in files for test in _TEST.findall(file.read_text(encoding="utf-8"))]
    return [f"{suite}.{name}" for suite, name in found if suite == exercise.suite]


def lives(program: Path, exercise: Exercise, answer: Answer) -> bool:
    tests = tests_of(exercise)
    if not tests:
        return True
    trial = run_tests(program, ":".join(tests), more={VARIABLE: answer.full_name})
    return trial.tests is not None and not any(test.failures for test in trial.tests)


def main(words: list[str]) -> int:
    listed = "--list" in words
    words = [word for word in words if word != "--list"]
    if len(words) < 2:
        print("usage: hidden.py [--list] PROGRAMS FILE...", file=sys.stderr)
        return 2
    programs, *paths = (Path(word).resolve() for word in words)
    try:
        wrong = [(exercise_of(files[0]), answer) for files in by_exercise(paths)
                 for answer in read_answers(files) if not answer.is_right]
    except CourseError as error:
        print(error, file=sys.stderr)
        return 1
    except OSError as error:
        print(f"{error.filename}: {error.strerror}", file=sys.stderr)
        return 1

    def judged(one: tuple[Exercise, Answer]) -> bool:
        return lives(programs / f"mutants_{one[0].folder}", *one)

    with ThreadPoolExecutor(os.cpu_count()) as workers:
        alive = list(workers.map(judged, wrong))
    noticed = alive.count(False)
    if listed:
        print("\n".join(f"{answer.place}: lives" for (_, answer), it_lives in zip(wrong, alive) if it_lives))
    print(f"hidden tests notice {noticed} of {len(wrong)} wrong answers")
    if noticed < LEAST_SHARE * len(wrong):
        print(f"they must notice {LEAST_SHARE:.0%}: add to tests/hidden/{wrong[0][0].folder}/; "
              "--list names those that live", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
