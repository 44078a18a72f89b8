"""The table of weights with a row for each test, for instructors to change."""

import io
from collections.abc import Iterable

from grading.choices import TABLE
from grading.weights import as_table, defaults, read_rows
from manifest import Exercise, all_exercises


def table(exercises: Iterable[Exercise] | None) -> str:
    """Returns the weights of all tests, or of those of these exercises."""
    rows = read_rows(TABLE) if TABLE.exists() else {}
    text = io.StringIO()
    as_table([rows.get(test, default) for test, default in defaults(exercises or all_exercises()).items()], text)
    return text.getvalue()
