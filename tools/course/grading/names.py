"""Names that platforms give to delivered files: the student, and whether the work is late.

FIRST LAST_101_assignsubmission_file_/work.zip            Moodle, a folder each
FIRST LAST_101_assignsubmission_file_work.zip             Moodle, without folders
lastfirst_late_12345_678_kick.cpp                         Canvas: login or name, user, submission, file's name
Homework 1_leeann_attempt_2026-11-20-10-11-12_kick.cpp    Blackboard: login, time; a .txt each about the attempt
12345-678910 - FIRST LAST - Nov 20, 2026 1011 AM/         Brightspace, a folder each; or 20 November, 2026 1011
"""

import contextlib
import functools
import os
import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime

MOODLE = "moodle"
_MOODLE = re.compile(r"(?P<name>.+?)_(?P<id>\d+)_assignsubmission_(?:file|onlinetext)_?(?P<file>.*)")
_MOODLES_FOLDER = re.compile(r"(?P<name>.+)_(?P<id>\d+)_assignsubmission_(?:file|onlinetext)_?(?P<file>)")
_MOODLES_NUMBER = re.compile(r"_(\d+)_assignsubmission_")
_CANVAS = re.compile(r"(?P<name>[^_]+)_(?P<late>late_)?(?P<id>\d+)_(?P<try>\d+)_(?P<file>(?!attempt_\d{4}-).+)",
                     re.IGNORECASE)
_AGAIN = re.compile(r"-(\d+)(?=\.\w+$)")  # Canvas' name for a file that was handed in again
_BLACKBOARD = re.compile(r"(?P<head>.+?_(?P<name>[^_]+))_attempt_(?P<time>\d{4}(?:-\d\d){5})(?:_(?P<file>.+)|\.txt)")
_BRIGHTSPACE = re.compile(r"(?P<id>\d+)-\d+ - (?P<name>.+) - (?P<time>\D*\d{1,2}\D+\d{4}\D+\d{3,4}\D*)")  # in any language
_CLOCK = re.compile(r"(\D*)(\d+)(\D+)(\d{4})(\D+?)(\d{3,4})(\D*)")  # of Brightspace's time
_WORD = re.compile(r"[^\W\d_]+")
# How the months begin in English, German, French, Spanish, Italian, Portuguese, Dutch and Nordic languages, by number. Of four
# letters are those whose first three mean another month, as in Finnish.
_MONTHS = {beginning: number for number, beginnings in enumerate(
    ("jan ene gen", "feb fev", "mar maa mrt mrz", "apr avr abr", "may mai maj mei mag", "jun juin giu", "jul juil lug",
     "aug aou ago", "sep set", "oct okt ott out", "nov marr", "dec dez dic des"), 1) for beginning in beginnings.split()}


@dataclass(frozen=True)
class Student:
    name: str
    identifier: str = ""  # the platform's number of the student: Moodle's participant, Canvas' or Brightspace's user
    late: bool = False
    platform: str = ""  # MOODLE, or empty


def _moodle(name: str, is_folder: bool) -> tuple[Student, str] | None:
    """Students may choose their names, and those of their files. A folder ends with Moodle's own number. A file with
    several numbers has none that is certain."""
    found = (_MOODLES_FOLDER.fullmatch(name) if is_folder else None) or _MOODLE.fullmatch(name)
    if not found:
        return None
    is_certain = found.re is _MOODLES_FOLDER or len(set(_MOODLES_NUMBER.findall(name))) == 1
    return Student(found["name"].strip(), found["id"] if is_certain else "", platform=MOODLE), found["file"]


def _canvas(name: str, _: bool) -> tuple[Student, str] | None:
    found = _CANVAS.fullmatch(name)
    return (Student(found["name"], found["id"], bool(found["late"])), _AGAIN.sub("", found["file"])) if found else None


def _blackboard(name: str, _: bool, assignment: str = "") -> tuple[Student, str] | None:
    """A login may have the `_` that stands before it: the rest of the name after `assignment`, if that is known."""
    found = _BLACKBOARD.fullmatch(name)
    if not found:
        return None
    login = found["head"].removeprefix(assignment) if assignment else found["name"]
    return Student(login), found["file"] or ""


def _brightspace(name: str, _: bool) -> tuple[Student, str] | None:
    found = _BRIGHTSPACE.fullmatch(name)
    return (Student(found["name"].strip(), found["id"]), "") if found else None


_PLATFORMS = (_moodle, _canvas, _blackboard, _brightspace)


def student_of(name: str, platforms: tuple = _PLATFORMS, is_folder: bool = False) -> tuple[Student, str] | None:
    """Returns the student in a folder's or file's name, and the file's original name; None if no platform has written
    it."""
    return next((found for platform in platforms if (found := platform(name, is_folder))), None)


def platforms_of(names: Iterable[str]) -> tuple:
    """Returns the platform that has written most names of a class; students may have written the others."""
    names = list(names)
    counts = {platform: sum(platform(name, False) is not None for name in names) for platform in _PLATFORMS}
    most = max(_PLATFORMS, key=counts.__getitem__)
    return (functools.partial(_blackboard, assignment=_assignment_of(names)) if most is _blackboard else most,)


def _assignment_of(names: list[str]) -> str:
    """Returns the beginning, up to a `_`, that all of Blackboard's names have in common; empty of one student."""
    heads = {found["head"] for name in names if (found := _BLACKBOARD.fullmatch(name))}
    common = os.path.commonprefix(sorted(heads)) if len(heads) > 1 else ""
    return common[: common.rfind("_") + 1]


def time_of(name: str) -> datetime | None:
    """Returns the time of an attempt, on the platform's clock, if the name has one that can be read."""
    with contextlib.suppress(ValueError):  # of another language's months, or no time at all
        if found := _BLACKBOARD.fullmatch(name):
            return datetime.strptime(found["time"], "%Y-%m-%d-%H-%M-%S")
        if found := _BRIGHTSPACE.fullmatch(name):
            return _brightspaces_time(found["time"])
    return None


def _brightspaces_time(text: str) -> datetime:
    """Reads a time with the month before or after the day, on a clock of 12 or 24 hours. Raises ValueError if it is
    in another form, or names two months, such as `mar` for Tuesday beside `nov`."""
    before, day, between, year, after, clock, end = _CLOCK.fullmatch(text).groups()
    months = {number for word in _WORD.findall(f"{before} {between} {after}") if (number := _month(word))}
    if len(months) != 1:
        raise ValueError(text)
    half = "".join(_WORD.findall(end)).upper()
    hours = "%I%M %p" if half else "%H%M"
    return datetime.strptime(f"{year} {months.pop()} {day} {clock:0>4} {half}".strip(), f"%Y %m %d {hours}")


def _month(word: str) -> int:
    """Returns the number of a month in any of the languages known, also of a short form; 0 of another word."""
    plain = "".join(one for one in unicodedata.normalize("NFKD", word).casefold() if one.isalpha())
    return _MONTHS.get(plain[:4]) or _MONTHS.get(plain[:3], 0)


def lacks_time(name: str, due: datetime | None) -> bool:
    """Tells whether nothing in a name says when the work was handed in, although its form or `due` asks for it.
    Canvas writes whether it is late."""
    return time_of(name) is None and bool(_BRIGHTSPACE.fullmatch(name) or (due and not _CANVAS.fullmatch(name)))


def is_late(name: str, due: datetime | None) -> bool:
    """Tells whether an attempt is late: the name says so, or has a time after `due`."""
    known, time = student_of(name), time_of(name)
    return bool(known and known[0].late) or bool(due and time and time > due)


def attempt_of(name: str) -> str:
    """Returns a key: of the attempts of one student on one platform the last has the greatest. Empty if the name has
    none."""
    if time := time_of(name):
        return time.isoformat()
    if (found := _CANVAS.fullmatch(name)) and (again := _AGAIN.search(found["file"])):
        return f"{int(again[1]):09d}"
    return ""


# Letters that are not seen, and those of other alphabets that look like Latin ones.
_UNSEEN = re.compile("[\u00ad\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200f\u202a-\u202e\u2060-\u206f"
                     "\u3164\ufe00-\ufe0f\ufeff\uffa0\U000e0000-\U000e0fff]")
_TWINS = str.maketrans("\u0430\u0435\u043e\u0440\u0441\u0443\u0445\u0456\u0458\u0455\u0501\u04bb\u03b1\u03bf\u03c1\u03bd\u0131",
                       "aeopcyxijsdhaopvi")


def unseen_removed(name: str) -> str:
    """Returns a name without letters that are not seen, and with the usual form of wide ones."""
    return _UNSEEN.sub("", unicodedata.normalize("NFKC", name))


def unseen_shown(name: str) -> str:
    """Returns a name with an escape, such as \\u200b, in place of each letter that is not seen."""
    return _UNSEEN.sub(lambda found: ascii(found[0])[1:-1], name)


def look(name: str) -> str:
    """Reduces a name so that names that look alike become equal."""
    return " ".join(unseen_removed(name).casefold().translate(_TWINS).split())


_LONGEST = 200  # bytes; a folder's name may have 255
_NAMELESS = "nameless"


def safe(name: str) -> str:
    """Makes a name safe for a folder, a file and a row: letters of any language, digits, and `-_. `; never empty, never
    dots."""
    letters = unicodedata.normalize("NFC", name.encode("utf-8", errors="replace").decode("utf-8"))
    plain = "".join(one if one in "-_. " or unicodedata.category(one)[0] in "LMN" else "_" for one in letters)
    plain = plain.encode("utf-8")[:_LONGEST].decode("utf-8", errors="ignore").strip(" ")
    return plain if plain.strip(". ") else _NAMELESS
