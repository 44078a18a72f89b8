"""From what the user typed, 4 or 4.2 or update_row, to exercises; 04_gauss_seidel will do, too, as editors fill it in."""

import difflib
import re

from errors import BadInput
from manifest import Chapter, Exercise, read_chapters

_NUMBER = re.compile(r"([0-9]+)(?:\.([0-9]+))?")


def near(word: str, known: list[str]) -> str:
    """', did you mean X?' if something known is spelled almost like the word."""
    matches = difflib.get_close_matches(word, known, n=1, cutoff=0.5)
    return f"; did you mean {matches[0]}?" if matches else ""


def pick(text: str) -> list[Exercise]:
    """The exercise, or all of the chapter."""
    chapters = read_chapters()
    for chapter in chapters:
        if chapter.folder == text:
            return list(chapter.exercises)
        for exercise in chapter.exercises:
            if exercise.function == text:
                return [exercise]
    found = _NUMBER.fullmatch(text)
    if not found:
        known = [exercise.function for chapter in chapters for exercise in chapter.exercises]
        raise BadInput(f"{text!r} is neither a chapter (4) nor an exercise (4.2){near(text, known)}")
    chapter = _chapter(text, int(found[1]), chapters)
    if found[2] is None:
        return list(chapter.exercises)
    return [_exercise(text, int(found[2]), chapter)]


def pick_one(text: str) -> Exercise:
    exercises = pick(text)
    if text == exercises[0].folder or _NUMBER.fullmatch(text) and "." not in text:
        raise BadInput(f"{text!r} is a chapter; name one exercise, {exercises[0].id} to {exercises[-1].id}")
    return exercises[0]


def pick_chapter(text: str) -> Chapter:
    """4, or 04_gauss_seidel."""
    chapters = read_chapters()
    found = next((chapter for chapter in chapters if chapter.folder == text), None)
    if found:
        return found
    if not (text.isascii() and text.isdecimal()):
        raise BadInput(f"{text!r} is not a chapter, such as 4{near(text, [chapter.folder for chapter in chapters])}")
    return _chapter(text, int(text), chapters)


def _chapter(text: str, number: int, chapters: list[Chapter]) -> Chapter:
    for chapter in chapters:
        if chapter.number == number:
            return chapter
    raise BadInput(f"there is no chapter {number} for {text!r}; "
                   f"there are {chapters[0].number} to {chapters[-1].number}")


def _exercise(text: str, number: int, chapter: Chapter) -> Exercise:
    for exercise in chapter.exercises:
        if exercise.number == number:
            return exercise
    first, last = chapter.exercises[0].id, chapter.exercises[-1].id
    raise BadInput(f"there is no exercise {text!r}; chapter {chapter.number} has {first} to {last}")
