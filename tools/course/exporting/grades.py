"""Marks for the import of Canvas and of Moodle: the platform's own table, with one column filled in.

Canvas:  Grades > Export; its first columns are returned, and a column with the assignment's name and the points.
Moodle:  the assignment > Download grading worksheet; its column Grade is filled in, scaled to Maximum grade. Moodle
         translates the titles, so in other languages the columns are found by what they hold.
"""

import csv
import io
import re

from errors import BadInput
from grading.roster import Roster

_GRADE = re.compile(r"|-|\d+(?:[.,]\d+)?")
_CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")


def for_canvas(results: list[dict], roster: Roster, assignment: str) -> str:
    """Returns Canvas' table. `assignment` is the title of its column, "Chapter 1 (4711)", which Canvas identifies by
    the number."""
    titles = [title for title in _CANVAS if title in roster.columns]
    if "Student" not in titles or "ID" not in titles:
        raise BadInput("export: for canvas, --roster must be the gradebook that Canvas exports, with columns Student and ID")
    by_row, claimed = _scores(results, roster), roster.claimed(results)
    possible = ["Points Possible", *([""] * (len(titles) - 1)), f"{results[0]['max_score']:g}"]
    # Who handed in nothing has no points; a mark in doubt is left to the instructor.
    lines = [[row[title] for title in titles] + ["" if id(row) in claimed and id(row) not in by_row else
                                                 f"{by_row.get(id(row), {'score': 0})['score']:g}"]
             for row in roster.rows]
    return _table([[*titles, assignment], possible, *lines])


def for_moodle(results: list[dict], roster: Roster) -> str:
    grade, largest = _moodles_columns(roster)
    by_row = _scores(results, roster)
    lines = []
    for row in roster.rows:
        result = by_row.get(id(row))
        row = dict(row)
        if result:
            score, most, written = result["score"], result["max_score"], row.get(largest, "")
            if maximum := _number(written):
                score, most = score * maximum / most if most else 0.0, maximum
            row[grade] = f"{score:.2f}".replace(".", "," if "," in written else ".")
        lines.append([row[title] for title in roster.columns])
    return _table([list(roster.columns), *lines])


def _moodles_columns(roster: Roster) -> tuple[str, str]:
    """Returns the titles of the grade and of the largest possible one, which is the next column, and the same number in
    each row."""
    columns, is_worksheet = roster.columns, "Identifier" in roster.columns or roster.participants
    if is_worksheet and "Grade" in columns:
        return "Grade", next((title for title in ("Maximum Grade", "Maximum grade") if title in columns), "")
    found = [(grade, largest) for grade, largest in zip(columns, columns[1:])
             if len({row[largest] for row in roster.rows}) == 1 and _number(roster.rows[0][largest]) > 0
             and all(_GRADE.fullmatch(row[grade].strip()) for row in roster.rows)]
    if not is_worksheet or len(found) != 1:
        raise BadInput("export: for moodle, --roster must be the assignment's grading worksheet: a column such as "
                       "'Participant 101' first, a column of grades, and then the maximum grade, equal in all rows")
    return found[0]


def not_on_it(results: list[dict], roster: Roster) -> dict[str, str]:
    """Returns the submissions without a row, whose marks are in no import, with the reason if they claim one."""
    strangers = roster.matched(results)[2]
    return {result["submission"]: roster.reason(result) for result in results if result["submission"] in strangers}


def _scores(results: list[dict], roster: Roster) -> dict[int, dict]:
    found, _, _ = roster.matched(results)
    by_name = {result["submission"]: result for result in results}
    return {id(row): by_name[name] for name, row in found.items()}


def _number(text: str) -> float:
    try:
        return float(text.replace(",", "."))
    except ValueError:
        return 0.0


def _table(rows: list[list[str]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()
