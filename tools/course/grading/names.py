"""What platforms write into the names of what they deliver: who it is of, and whether it came late.

    FIRST LAST_101_assignsubmission_file_/work.zip       Moodle, a folder each
    FIRST LAST_101_assignsubmission_file_work.zip        Moodle, without folders
    lastfirst_late_12345_678_kick.cpp                    Canvas: login or name, user, submission, the file's own name
"""

import re
import unicodedata
from dataclasses import dataclass

_MOODLE = re.compile(r"(?P<name>.+?)_(?P<id>\d+)_assignsubmission_(?:file|onlinetext)_?(?P<file>.*)")
_CANVAS = re.compile(r"(?P<name>[^_]+)_(?P<late>late_)?(?P<id>\d+)_(?P<try>\d+)_(?P<file>.+)", re.IGNORECASE)
_AGAIN = re.compile(r"-\d+(?=\.\w+$)")  # Canvas' name for a file that was handed in again


@dataclass(frozen=True)
class Student:
    name: str
    identifier: str = ""  # the platform's number of the student: Moodle's participant, Canvas' user
    late: bool = False


def student_of(name: str) -> tuple[Student, str] | None:
    """Of a folder's or file's name, and what the file was called; None: no platform has written it."""
    if found := _MOODLE.fullmatch(name):
        return Student(found["name"].strip(), found["id"]), found["file"]
    if found := _CANVAS.fullmatch(name):
        return Student(found["name"], found["id"], bool(found["late"])), _AGAIN.sub("", found["file"])
    return None


_LONGEST = 200  # bytes; a folder's name may have 255
_NAMELESS = "nameless"


def safe(name: str) -> str:
    """As it names a folder, a file and a row: letters of any language, digits, and `-_. `; never empty, never dots."""
    letters = unicodedata.normalize("NFC", name.encode("utf-8", errors="replace").decode("utf-8"))
    plain = "".join(one if one in "-_. " or unicodedata.category(one)[0] in "LMN" else "_" for one in letters)
    plain = plain.encode("utf-8")[:_LONGEST].decode("utf-8", errors="ignore").strip(" ")
    return plain if plain.strip(". ") else _NAMELESS
