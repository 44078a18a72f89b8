"""The class as a platform lists it: Canvas' gradebook, Moodle's grading worksheet, or your own table.

A CSV with a line of titles, of which some are known: names, numbers, logins and addresses. Moodle translates the titles
of its worksheet, so its columns are also found by what they hold, and so are addresses. A submission belongs to the
row whose number the platform wrote into its name, or else to the only row whose name, login or address is the same.
"""

import csv
import functools
import io
import re
import unicodedata
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from errors import BadInput
from text_encoding import decoded

_NAMES = ("student", "full name", "name", "login", "sis login id", "username", "email address", "email",
          "github username")
# In the languages of most tables that instructors make themselves.
_FIRST = ("first name", "firstname", "given name", "vorname", "prénom", "prenom", "nombre", "nome", "voornaam")
_LAST = ("last name", "lastname", "surname", "family name", "nachname", "familienname", "nom", "nom de famille",
         "apellido", "apellidos", "apellido(s)", "cognome", "apelido", "sobrenome", "achternaam")
_NAME, _GITHUB = "name", "github username"
_BRANCH = re.compile(r"-(?:main|master)$")  # at the end of an archive that GitHub makes
_ADDRESSES = ("email address", "email")
_NUMBERS = ("id", "identifier", "number", "participant", "sid", "student id", "studentid", "student number",
            "orgdefinedid", "org defined id", "matriculation number", "matrikelnummer", "matrikelnr", "matrikelnr.",
            "matrikel-nr.", "numéro étudiant", "numéro d'étudiant", "matricola", "studentnummer")
_PARTICIPANT = re.compile(r"(\D*[^\W\d_]\D*?)\s*(\d+)")  # "Participant 101", "Teilnehmer/in 101"

# A number that a program has written as a fraction, and one that it has rounded.
_WHOLE = re.compile(r"\s*(\d+)(?:\.0+|,00?)\s*")
_ROUNDED = re.compile(r"\s*\d+(?:[.,]\d+)?[eE]\+\d+\s*")
_MOST_NAMED = 5  # cells in an error

_ABOVE_TITLES = re.compile(r"\A(?:\s*\n|sep=.\r?\n)+")  # as spreadsheets write them


@dataclass(frozen=True)
class Roster:
    columns: tuple[str, ...]
    rows: tuple[dict[str, str], ...]

    def matched(self, results: list[dict]) -> tuple[dict[str, dict], list[dict], list[str]]:
        """Returns each submission's row, by the submission's name; the rows without one; the submissions without a
        row.

        Of two that claim one row, the one with its number has it, or else none: names can be chosen.
        """
        claims: dict[int, list[tuple[dict, bool]]] = defaultdict(list)
        for result in results:
            row, is_by_number = self._claimed_by(result)
            if row is not None and not self.contradiction(result):
                claims[id(row)].append((result, is_by_number))
        found = {}
        for row in self.rows:
            claimed = claims[id(row)]
            best = [result for result, is_by_number in claimed if is_by_number] or [result for result, _ in claimed]
            if len(best) == 1:
                found[best[0]["submission"]] = row
        missing = [row for row in self.rows if not any(row is one for one in found.values())]
        return found, missing, [result["submission"] for result in results if result["submission"] not in found]

    def claimed(self, results: list[dict]) -> set[int]:
        """Returns the identities of rows that some submission names, by number or by name."""
        named = [self._rows_of(result) for result in results]
        return {id(row) for by_number, by_name in named for row in [*by_name, by_number] if row is not None}

    def reason(self, result: dict) -> str:
        """Says why a submission does not have the row that it claims; empty if it claims none."""
        row, _ = self._claimed_by(result)
        of_two = f"another submission also claims {self.name_of(row)} on the roster; decide whose it is" if row else ""
        return self.contradiction(result) or of_two

    def _claimed_by(self, result: dict) -> tuple[dict[str, str] | None, bool]:
        """Returns the row that a submission claims, and whether by its number."""
        by_number, by_name = self._rows_of(result)
        return (by_number, True) if by_number is not None else (by_name[0] if _are_one(by_name) else None, False)

    def contradiction(self, result: dict) -> str:
        """Describes a submission with the number of one row and the name of another, which would exchange two students;
        else empty."""
        by_number, by_name = self._rows_of(result)
        if by_number is None or not by_name or any(row is by_number for row in by_name):
            return ""
        return (f"its number {result['identifier']} is that of {self.name_of(by_number)} on the roster, and its name "
                f"is that of {self.name_of(by_name[0])}, so that it is given to neither")

    def _rows_of(self, result: dict) -> tuple[dict[str, str] | None, list[dict[str, str]]]:
        """Returns the row with the platform's number, or address if that is what it tells, and all rows with the
        name."""
        told = result["identifier"]
        by_number = self._by_address.get(told.casefold()) if "@" in told else self._by_number.get(_digits(told))
        by_name = [row for word in _spellings(result["student"]) for row in self._by_name.get(word, [])]
        return by_number, by_name or self._rows_of_repository(result["student"])

    def _rows_of_repository(self, name: str) -> list[dict[str, str]]:
        """Returns the rows of the longest name on GitHub that ends a repository's name, ASSIGNMENT-NAME."""
        name = _BRANCH.sub("", name.casefold())
        logins = {row[title].strip().casefold() for row in self.rows for title in row if _plain(title) == _GITHUB} - {""}
        ending = max((login for login in logins if name.endswith(f"-{login}")), key=len, default=None)
        return [row for row in self.rows for title in row
                if _plain(title) == _GITHUB and row[title].strip().casefold() == ending]

    @functools.cached_property
    def participants(self) -> str:
        """Returns the title of Moodle's participants, the first column, with one word before a number in each row;
        empty if it is not so."""
        first = self.columns[0] if self.columns else ""
        cells = [row[first].strip() for row in self.rows if row[first].strip()]
        found = [_PARTICIPANT.fullmatch(text) for text in cells]
        if not found or not all(found) or len({one[1] for one in found}) > 1:
            return ""
        return first if len({one[2] for one in found}) == len(found) else ""

    @functools.cached_property
    def number_columns(self) -> tuple[str, ...]:
        """Returns the titles of columns with a platform's number: Moodle's under any title that means nothing else."""
        moodles = self.participants if _plain(self.participants) not in (*_NAMES, *_FIRST, *_LAST) else ""
        return tuple(title for title in self.columns if _plain(title) in _NUMBERS or title == moodles != "")

    @functools.cached_property
    def _address_columns(self) -> tuple[str, ...]:
        def has_addresses(title: str) -> bool:
            cells = [row[title] for row in self.rows if row[title].strip()]
            return bool(cells) and all("@" in text for text in cells)
        return tuple(title for title in self.columns if _plain(title) in _ADDRESSES or has_addresses(title))

    @functools.cached_property
    def first_and_last(self) -> tuple[str, str] | None:
        """Returns the titles of first and last names in separate columns. `Name` beside first names has last names, unless
        most of them contain the first name."""
        titles = {_plain(title): title for title in self.columns}
        first, last = (next((titles[name] for name in names if name in titles), "") for names in (_FIRST, _LAST))
        if first and not last and _NAME in titles:
            whole = sum(set(_words(row[first])) <= set(_words(row[titles[_NAME]])) for row in self.rows)
            last = titles[_NAME] if 2 * whole < len(self.rows) else ""
        return (first, last) if first and last else None

    @functools.cached_property
    def name_columns(self) -> tuple[str, ...]:
        """Returns the titles of columns with whole names, logins or addresses, the most telling first. In Moodle's
        worksheet the name follows the participant, unless names are hidden: then the state does, equal for many."""
        known = [title for name in _NAMES for title in self.columns
                 if _plain(title) == name and title not in (self.first_and_last or ())]
        second = [title for title in self.columns[1:2] if self.participants and self._are_names(title)]
        return tuple(dict.fromkeys([*second, *known, *self._address_columns]))

    def _are_names(self, title: str) -> bool:
        cells = [row[title] for row in self.rows]
        return 2 * len(set(cells)) > len(cells) and all(any(map(str.isalpha, text)) and "@" not in text for text in cells)

    @functools.cached_property
    def _by_number(self) -> dict[str, dict[str, str]]:
        return self._by_one_of(self.number_columns, _digits)

    @functools.cached_property
    def _by_address(self) -> dict[str, dict[str, str]]:
        return self._by_one_of(self._address_columns, lambda text: text.strip().casefold())

    def _by_one_of(self, titles: tuple[str, ...], key: Callable[[str], str]) -> dict[str, dict[str, str]]:
        """Returns the row of each key in these columns that only one row has."""
        found: dict[str, list[dict]] = defaultdict(list)
        for row in self.rows:
            for known in {key(row[title]) for title in titles} - {""}:
                found[known].append(row)
        return {known: rows[0] for known, rows in found.items() if len(rows) == 1}

    @functools.cached_property
    def _by_name(self) -> dict[str, list[dict[str, str]]]:
        found: dict[str, list[dict]] = defaultdict(list)
        for row in self.rows:
            for word in {word for name in self._names_in(row) for word in _spellings(name)}:
                found[word].append(row)
        return found

    def _names_in(self, row: dict[str, str]) -> list[str]:
        """Returns all names of the student in a row, also first and last name in separate columns."""
        whole = [row[title] for title in self.name_columns]
        parts = [row[title] for title in self.first_and_last or ()]
        return ([" ".join(parts)] if parts and all(part.strip() for part in parts) else []) + whole

    def name_of(self, row: dict[str, str]) -> str:
        """Returns the name, or the number of a student whose name the platform hides."""
        numbers = [row[title] for title in self.number_columns]
        return next((told for told in [*self._names_in(row), *numbers] if told.strip()), "?")

    def number_of(self, row: dict[str, str]) -> str:
        """Returns the student's number as a platform writes it into the name of a submission; else the address, or
        nothing."""
        cells = [*(_without_fraction(row[title]).strip() for title in self.number_columns),
                 *(row[title].strip() for title in self._address_columns)]
        told = next((text for text in cells if text), "")
        found = _PARTICIPANT.fullmatch(told) if self.participants else None
        return found[2] if found else told


def read_roster(file: Path) -> Roster:
    """Reads a CSV with commas, semicolons or tabs, in UTF-8, UTF-16 or Latin-1, as spreadsheets write it."""
    try:
        content = file.read_bytes()
        if content.startswith(b"PK"):
            raise BadInput(f"the roster {file} is a spreadsheet; save it as CSV")
        content = _ABOVE_TITLES.sub("", decoded(content))
        separator = max(",;\t", key=content.partition("\n")[0].count)
        reader = csv.DictReader(io.StringIO(content, newline=""), delimiter=separator)
        columns = tuple(reader.fieldnames or ())
        rows = tuple({title: row[title] or "" for title in columns} for row in reader)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise BadInput(f"the roster {file} cannot be read: {error}") from None
    roster = Roster(columns, rows)
    if not (roster.name_columns or roster.number_columns or roster.first_and_last):
        raise BadInput(f"the roster {file} has no column of names; known are {', '.join(_NAMES)}, "
                       f"{' with '.join((_FIRST[0], _LAST[0]))}")
    # Canvas' second line says how many points are possible, and there is a student who tests.
    roster = Roster(columns, tuple(row for row in rows if roster.name_of(row) != "?" and not _is_no_student(row)))
    _refuse_rounded(roster, file)
    return roster


def _refuse_rounded(roster: Roster, file: Path) -> None:
    cells = [f"{row[title].strip()} of {roster.name_of(row)}" for row in roster.rows for title in roster.number_columns
             if _ROUNDED.fullmatch(row[title])]
    if cells:
        more = f", and {len(cells) - _MOST_NAMED} more" if len(cells) > _MOST_NAMED else ""
        raise BadInput(f"the roster {file} has numbers that a program has rounded: {', '.join(cells[:_MOST_NAMED])}{more}; "
                       "write the whole numbers, and save their column as text")


def _plain(title: str) -> str:
    return title.strip().lower().replace("_", " ").replace("e-mail", "email")


def _are_one(rows: list[dict]) -> bool:
    return bool(rows) and all(row is rows[0] for row in rows)


def _is_no_student(row: dict[str, str]) -> bool:
    first = next(iter(row.values())).strip()
    return first in ("Points Possible", "Student, Test")


def _digits(text: str) -> str:
    return "".join(re.findall(r"\d+", _without_fraction(text)))


def _without_fraction(text: str) -> str:
    """Returns `101` for `101.0`, as pandas writes whole numbers, and any other cell as it is."""
    found = _WHOLE.fullmatch(text)
    return found[1] if found else text


def _words(name: str) -> list[str]:
    return name.replace(",", " ").split()


def _spellings(name: str) -> set[str]:
    """Returns equal spellings: `Lee, Ann`, `Ann Lee` and `leeann`, and letters with and without accents."""
    def plain(text: str) -> str:
        letters = unicodedata.normalize("NFKD", text).casefold()
        return "".join(letter for letter in letters if letter.isalnum())
    last, comma, first = name.partition(",")
    ways = {plain(name), plain(name.partition("@")[0])} | ({plain(first + last)} if comma else set())
    words = _words(name)
    if len(words) > 1:
        ways |= {plain(words[-1] + "".join(words[:-1])), plain("".join(words[1:]) + words[0])}
    return ways - {""}
