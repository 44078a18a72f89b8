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
_FIRST, _LAST = ("first name", "firstname", "given name"), ("last name", "lastname", "surname", "family name")
_NUMBERS = ("id", "identifier", "number", "participant")


@dataclass(frozen=True)
class Roster:
    columns: tuple[str, ...]
    rows: tuple[dict[str, str], ...]

    def matched(self, results: list[dict]) -> tuple[dict[str, dict], list[dict], list[str]]:
        """Each submission's row, by the submission's name; the rows without one; the submissions without a row.

        A number of one row with the name of another is nobody's, and an error: else two students would change places.
        """
        by_number = {_digits(row[title]): row for row in self.rows for title in row
                     if title.lower() in _NUMBERS and _digits(row[title])}
        by_name: dict[str, list[dict]] = defaultdict(list)
        for row in self.rows:
            for word in {word for name in self._names_in(row) for word in _spellings(name)}:
                by_name[word].append(row)
        found, strangers = {}, []
        for result in results:
            row = by_number.get(result["identifier"]) if result["identifier"] else None
            named = [row for word in _spellings(result["student"]) for row in by_name.get(word, [])]
            other = named[0] if named and all(one is named[0] for one in named) else None
            if row is not None and named and not any(one is row for one in named):
                raise BadInput(f"the roster gives the number {result['identifier']} to {self.name_of(row)}, but the "
                               f"submission {result['submission']!r} has this number and the name of "
                               f"{self.name_of(named[0])}; correct the roster")
            row = other if row is None else row
            if row is None or any(row is one for one in found.values()):
                strangers.append(result["submission"])
            else:
                found[result["submission"]] = row
        missing = [row for row in self.rows if not any(row is one for one in found.values())]
        return found, missing, strangers

    def _names_in(self, row: dict[str, str]) -> list[str]:
        """All that the row calls the student: also first and last name, where they stand apart."""
        by_title = {title.lower(): row[title] for title in row}
        whole = [by_title[title] for title in _NAMES if title in by_title]
        first, last = (next((by_title[title] for title in titles if title in by_title), "")
                       for titles in (_FIRST, _LAST))
        return whole + ([f"{first} {last}"] if first.strip() and last.strip() else [])

    def name_of(self, row: dict[str, str]) -> str:
        names = [name for name in self._names_in(row) if name.strip()]
        return names[0] if names else "?"


def read_roster(file: Path) -> Roster:
    """A CSV with commas, semicolons or tabs, in UTF-8, UTF-16 or Latin-1, as spreadsheets write it."""
    try:
        lines = decoded(file.read_bytes()).splitlines(keepends=True)
        separator = max(",;\t", key=lines[0].count) if lines else ","
        reader = csv.DictReader(lines, delimiter=separator)
        columns = tuple(reader.fieldnames or ())
        rows = tuple({title: row[title] or "" for title in columns} for row in reader)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise BadInput(f"the roster {file} cannot be read: {error}") from None
    titles = {title.lower() for title in columns}
    if not titles & set(_NAMES) and not (titles & set(_FIRST) and titles & set(_LAST)):
        raise BadInput(f"the roster {file} has no column of names; known are {', '.join(_NAMES)}, "
                       f"{' with '.join((_FIRST[0], _LAST[0]))}")
    roster = Roster(columns, rows)
    # Canvas' second line says how many points are possible, and there is a student who tests.
    return Roster(columns, tuple(row for row in rows if any(name.strip() for name in roster._names_in(row))
                                 and not _is_no_student(row)))


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
