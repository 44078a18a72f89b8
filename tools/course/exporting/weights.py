"""The table of weights, with a first draft of a row for each new test."""

import io
from collections.abc import Iterable

from grading.choices import TABLE
from grading.weights import as_table, first_draft, read_rows
from grading.workshop import build_tests, idle_tests, listed_tests, test_program
from machine import require_linux
from manifest import Exercise, all_exercises
from pick import chapters_of


def table(exercises: Iterable[Exercise] | None) -> str:
    """Returns the table, or the part of these exercises. Rows changed by hand are kept; rows of removed tests are
    dropped."""
    require_linux("./course export weights")  # it runs the grader's programs
    rows = read_rows(TABLE) if TABLE.exists() else {}
    chosen = set(exercises or all_exercises())
    chapters = chapters_of(chosen)
    build_tests(chapters)
    weights = []
    for chapter in chapters:
        tests = listed_tests(chapter)
        idle = idle_tests(test_program(chapter), [test for test in tests if test not in rows])
        for exercise in [one for one in chapter.exercises if one in chosen]:
            own = [test for test in tests if test.partition(".")[0] == exercise.suite]
            weights += [rows.get(test) or first_draft(test, exercise, points=0.0 if test in idle else 1.0)
                        for test in own]
    text = io.StringIO()
    as_table(weights, text)
    return text.getvalue()
