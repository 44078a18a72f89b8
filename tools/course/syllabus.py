"""The requirements in a lesson's head: earlier chapters, and hours; and the reference's calls of other chapters."""

import re

from errors import CourseError
from manifest import Chapter, all_exercises
from paths import SOLUTIONS

_HEAD = re.compile(r"\*\*What it takes\.\*\* (.*?)\n\n", re.DOTALL)
_HOURS = re.compile(r"\b(\w+)\s+to\s+(\w+)\s+hours\b")
_CHAPTER = re.compile(r"(?<![.\d(])\b(\d\d)\b(?!\.\d)")
_WORDS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")


def needs_of(chapter: Chapter) -> set[int]:
    """Returns the chapters that a reader must know before."""
    head = _head(chapter)
    return {int(number) for number in _CHAPTER.findall(head[:_HOURS.search(head).start()])}


def hours_of(chapter: Chapter) -> tuple[int, int]:
    low, high = _HOURS.search(_head(chapter)).groups()
    return _WORDS.index(low.lower()), _WORDS.index(high.lower())


def calls_of(chapter: Chapter) -> set[int]:
    """Returns the other chapters with an exercise whose function the reference calls."""
    text = "\n".join(re.sub(r"//.*", "", file.read_text(encoding="utf-8"))
                     for file in sorted((SOLUTIONS / chapter.folder).glob("*.cpp")))
    return {one.chapter for one in all_exercises()
            if one.chapter != chapter.number and re.search(rf"(?<![.\w]){one.function}(?:<\w+>)?\(", text)}


def closure(needs: dict[int, set[int]], number: int) -> set[int]:
    """Returns all chapters that a chapter needs, directly or indirectly."""
    found: set[int] = set()
    waiting = set(needs[number])
    while waiting:
        one = waiting.pop()
        if one not in found:
            found.add(one)
            waiting |= needs[one]
    return found


def _head(chapter: Chapter) -> str:
    lesson = chapter.exercises[0].lesson.read_text(encoding="utf-8")
    found = _HEAD.search(lesson)
    if not found or not _HOURS.search(found[1]):
        raise CourseError(f"{chapter.folder}: the lesson does not state its requirements")
    return found[1]
