"""./course grade: marks for a class of submissions."""

import time
from pathlib import Path

from errors import BadInput, CourseError
from exporting import gradescope
from grading.gradebook import statistics_line, write_gradebook
from grading.grader import Grader
from grading.isolation import Isolation
from grading.merge import merge
from grading.results import write_json
from grading.submission import Handed, find_submissions
from install import install
from needs import GRADE_NEEDS, NEEDS
from paths import shown
from terminal import fold


def grade(arguments) -> int:
    out = Path(arguments.out)
    if arguments.merge:
        results = merge([Path(folder) for folder in arguments.merge], out)
        write_gradebook(out, results)
        print(f"{statistics_line(results)}.\n{_where(out)}.")
        return 0
    if arguments.prepare:
        return _prepare(arguments)
    if arguments.gradescope:
        return _grade_on_gradescope(arguments, out)
    if not arguments.paths:
        raise BadInput("grade: a submission, or a folder of them, is needed; see ./course grade --help")
    handed = find_submissions([Path(path) for path in arguments.paths], out)
    if arguments.shard:
        first, count = arguments.shard
        handed = handed[first - 1::count]
        if not handed:
            print("This shard has no submissions.")
            return 0
    with Grader(arguments) as grader:
        _say_how(grader, len(handed))
        start = time.monotonic()
        results = grader.grade(handed, out)
        took = time.monotonic() - start
    if results:
        write_gradebook(out, results)
    if grader.failures:
        raise CourseError(f"{len(grader.failures)} of {len(handed)} submissions could not be graded; the others were, "
                          f"and grading again goes on from there", "\n".join(grader.failures))
    print(f"{statistics_line(results)}; {took / len(results):.2g} s each.")
    print(f"{_where(out)},\nand each student's report in {shown(out / 'submissions')}/NAME/report.md.")
    return 0


def _where(out: Path) -> str:
    return f"The marks are in {shown(out / 'grades.csv')}, the class in {shown(out / 'summary.md')}"


def _prepare(arguments) -> int:
    install(NEEDS + GRADE_NEEDS, arguments.yes)
    with Grader(arguments) as grader:
        print(f"Ready to grade {len(grader.exercises)} exercises; isolation: {grader.isolation.name}.")
        _say_what_is_open(grader.isolation)
    return 0


def _grade_on_gradescope(arguments, out: Path) -> int:
    """One submission, whatever its folders; the file is written at once, and again after each exercise."""
    if len(arguments.paths) != 1:
        raise BadInput(f"grade: --gradescope takes one submission, but {len(arguments.paths)} are named")
    path, file = Path(arguments.paths[0]), Path(arguments.gradescope)

    def write(result: dict, left: int) -> None:
        unfinished = f"Not finished: {left} exercises are still to be graded." if left else ""
        write_json(file, gradescope.converted(result, unfinished))

    with Grader(arguments) as grader:
        result = grader.grade_one(Handed("submission", path), out, write)
    print(f"{result['score']:g} of {result['max_score']:g} points")
    return 0


def _say_how(grader: Grader, count: int) -> None:
    print(f"{count} submission{'s' if count != 1 else ''}, {len(grader.exercises)} exercises, seed {grader.seed}; "
          f"isolation: {grader.isolation.name}.", flush=True)
    _say_what_is_open(grader.isolation)


def _say_what_is_open(isolation: Isolation) -> None:
    if isolation.does_not_deny:
        print(fold(f"This isolation does not deny {isolation.does_not_deny}."), flush=True)
