"""The class as a platform lists it: Canvas' gradebook, Moodle's grading worksheet, or a table of one's own.

A CSV with a line of titles, of which some are known: names, numbers, logins and addresses. A submission belongs to the
row whose number the platform wrote into its name, or else to the only row whose name, login or address is the same.
"""

import csv
import re
import unicodedata
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

from errors import BadInput

_NAMES = ("student", "full name", "name", "login", "sis login id", "username", "email address", "email",
          "github username")
_NUMBERS = ("id", "identifier", "number", "participant")


@dataclass(frozen=True)
class Roster:
    columns: tuple[str, ...]
    rows: tuple[dict[str, str], ...]

    def matched(self, results: list[dict]) -> tuple[dict[str, dict], list[dict], list[str]]:
        """Each submission's row, by the submission's name; the rows without one; the submissions without a row."""
        by_number = {_digits(row[title]): row for row in self.rows for title in row
                     if title.lower() in _NUMBERS and _digits(row[title])}
        by_name: dict[str, list[dict]] = defaultdict(list)
        for row in self.rows:
            for word in {word for title in row if title.lower() in _NAMES for word in _spellings(row[title])}:
                by_name[word].append(row)
        found, strangers = {}, []
        for result in results:
            row = by_number.get(result["identifier"]) if result["identifier"] else None
            if row is None:
                rows = [row for word in _spellings(result["student"]) for row in by_name.get(word, [])]
                row = rows[0] if rows and all(one is rows[0] for one in rows) else None
            if row is None or any(row is other for other in found.values()):
                strangers.append(result["submission"])
            else:
                found[result["submission"]] = row
        missing = [row for row in self.rows if not any(row is one for one in found.values())]
        return found, missing, strangers

    def name_of(self, row: dict[str, str]) -> str:
        return next((row[title] for wanted in _NAMES for title in self.columns
                     if title.lower() == wanted and row[title].strip()), "?")


def read_roster(file: Path) -> Roster:
    try:
        with open(file, encoding="utf-8-sig", newline="") as text:
            reader = csv.DictReader(text)
            columns = tuple(reader.fieldnames or ())
            rows = tuple({title: row[title] or "" for title in columns} for row in reader)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise BadInput(f"the roster {file} cannot be read: {error}") from None
    if not any(title.lower() in _NAMES for title in columns):
        raise BadInput(f"the roster {file} has no column of names; known are {', '.join(_NAMES)}")
    # Canvas' second line says how many points are possible, and there is a student who tests.
    rows = tuple(row for row in rows if any(row[title].strip() for title in columns if title.lower() in _NAMES)
                 and not _is_no_student(row))
    return Roster(columns, rows)


def _is_no_student(row: dict[str, str]) -> bool:
    first = next(iter(row.values())).strip()
    return first in ("Points Possible", "Student, Test")


def _digits(text: str) -> str:
    return "".join(re.findall(r"\d+", text))


def _spellings(name: str) -> set[str]:
    """`Lee, Ann`, `Ann Lee` and `leeann` are one; so are letters with and without their accents."""
    def plain(text: str) -> str:
        letters = unicodedata.normalize("NFKD", text).casefold()
        return "".join(letter for letter in letters if letter.isalnum())
    last, comma, first = name.partition(",")
    ways = {plain(name), plain(name.partition("@")[0])} | ({plain(first + last)} if comma else set())
    words = name.replace(",", " ").split()
    if len(words) > 1:
        ways |= {plain(words[-1] + "".join(words[:-1])), plain("".join(words[1:]) + words[0])}
    return ways - {""}
