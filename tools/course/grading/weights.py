"""Points, title and visibility of each test: by tests/weights.csv, or by a table of the instructor's, or by default.

    test,points,visibility,hint,title
    Kick.AddsForceOverMass,1,visible,1.1/1,Adds the force over the mass

A test without a row has the default. Hidden tests may have a table of their own, weights.csv in their folder; without a
row they are worth a point, hidden.
"""

import csv
import math
import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from errors import BadInput, CourseError
from manifest import Exercise, all_exercises
from paths import shown
from pick import near

COLUMNS = ("test", "points", "visibility", "hint", "title")
VISIBILITIES = ("visible", "after_due_date", "after_published", "hidden")
_HUMP = re.compile(r"(?<=[a-z0-9])(?=[A-Z])(?<!Na(?=N))|(?<=[A-Z])(?=[A-Z][a-z])|(?<=[a-z])(?=[0-9])(?<![0-9]e)")
_IN_ANY_UNITS = "IsTheSameInAnyUnits"  # most functions that do nothing pass it


@dataclass(frozen=True)
class Weight:
    test: str
    points: float
    visibility: str
    hint: str  # the hint that a failing student is shown: exercise/number
    title: str


class Weights:
    def __init__(self, rows: dict[str, Weight]):
        self._rows = rows

    def check_names(self, tests: list[str], suites: set[str]) -> None:
        """Checks that each row of one of the `suites` is of one of the `tests`, and each other row of an exercise."""
        known = {exercise.suite for exercise in all_exercises()}
        for test in self._rows:
            suite = test.partition(".")[0]
            if suite not in known or (suite in suites and test not in tests):
                raise BadInput(f"the table of weights has a row for {test}, which is not a test{near(test, tests)}")

    def of(self, test: str) -> Weight:
        return self._rows[test]

    def rows(self) -> dict[str, Weight]:
        return self._rows

    def check(self, expected: dict[str, Exercise], hidden: set[str], idle: set[str]) -> None:
        """Checks that each row is of an existing test, and that the hint of each expected test exists.

        An expected test without a row gets the default. If it is hidden, it has no points if it is one of the `idle`.
        """
        self.check_names(list(expected), {exercise.suite for exercise in expected.values()})
        for test, exercise in expected.items():
            if test not in self._rows:
                default = default_weight(test, exercise)
                self._rows[test] = (replace(default, visibility="hidden", points=0.0 if test in idle else 1.0)
                                    if test in hidden else default)
            _check_hint(self._rows[test], exercise)


def read_weights(table: Path, hidden: Path | None) -> Weights:
    rows = read_rows(table)
    if hidden and (hidden / "weights.csv").exists():
        rows |= read_rows(hidden / "weights.csv")
    return Weights(rows)


def default_weight(test: str, exercise: Exercise) -> Weight:
    """Returns the weight of a test without a row: a point, visible, the first hint, and the words of its name."""
    name = test.partition(".")[2]
    words = _HUMP.sub(" ", name).split()
    title = " ".join(word if word == "NaN" or len(word) > 1 and word.isupper() else word.lower() for word in words)
    return Weight(test, 0.0 if name == _IN_ANY_UNITS else 1.0, "visible", f"{exercise.id}/1",
                  title[:1].upper() + title[1:])


def defaults(exercises: Iterable[Exercise]) -> dict[str, Weight]:
    """Returns the default weight of each of the course's tests of these exercises, in their order."""
    return {test: default_weight(test, exercise) for exercise in exercises for test in exercise.tests()}


def as_table(weights: list[Weight], out) -> None:
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for weight in weights:
        writer.writerow([weight.test, f"{weight.points:g}", weight.visibility, weight.hint, weight.title])


def read_rows(table: Path) -> dict[str, Weight]:
    """Returns the rows by test, in the table's order."""
    try:
        with open(table, encoding="utf-8-sig", newline="") as file:
            reader = csv.DictReader(file)
            if tuple(reader.fieldnames or ()) != COLUMNS:
                raise BadInput(f"{shown(table)}: its first line must be {','.join(COLUMNS)}")
            rows: dict[str, Weight] = {}
            for row in reader:
                weight = _row(row, f"{shown(table)}:{reader.line_num}")
                if weight.test in rows:
                    raise BadInput(f"{shown(table)}:{reader.line_num}: {weight.test} has a row already")
                rows[weight.test] = weight
            return rows
    except FileNotFoundError:
        raise BadInput(f"there is no table of weights {shown(table)}") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise BadInput(f"{shown(table)} cannot be read: {error}") from None


def _row(row: dict[str, str], where: str) -> Weight:
    if None in row or None in row.values():
        raise BadInput(f"{where}: it must have {len(COLUMNS)} values")
    try:
        points = float(row["points"])
    except ValueError:
        points = math.nan
    if not 0 <= points < math.inf:
        raise BadInput(f"{where}: points must be a number from 0, but is {row['points']!r}")
    if row["visibility"] not in VISIBILITIES:
        raise BadInput(f"{where}: visibility must be one of {', '.join(VISIBILITIES)}, but is {row['visibility']!r}")
    if not row["test"] or not row["title"]:
        raise BadInput(f"{where}: the test and its title must not be empty")
    return Weight(row["test"], points, row["visibility"], row["hint"], row["title"])


def _check_hint(weight: Weight, exercise: Exercise) -> None:
    number = weight.hint.removeprefix(f"{exercise.id}/")
    if not (number.isdecimal() and 1 <= int(number) <= len(exercise.hints)):
        raise CourseError(f"{weight.test}: the hint must be one of {exercise.id}/1 to "
                          f"{exercise.id}/{len(exercise.hints)}")
