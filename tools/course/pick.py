"""Finds the exercises that the user named.

A chapter is 4, 04_gauss_seidel or its folder; an exercise is 4.2, update_row or its file. Paths are those that Tab
completes in the shell's folder. A list, such as 1-5,6.1,8.1-8.4, has chapters, exercises, and ranges of them.
"""

import difflib
import os
import re
from collections.abc import Iterable
from pathlib import Path

from errors import BadInput
from manifest import Chapter, Exercise, all_exercises, read_chapters
from paths import CHAPTERS

_NUMBER = re.compile(r"([0-9]+)(?:\.([0-9]+))?")
_RANGE = re.compile(r"([\w.]+)-([\w.]+)")


def near(word: str, known: list[str], cutoff: float = 0.5) -> str:
    """', did you mean X?' if something known is spelled almost like the word."""
    matches = difflib.get_close_matches(word, known, n=1, cutoff=cutoff)
    return f"; did you mean {matches[0]}?" if matches else ""


def pick(text: str) -> list[Exercise]:
    """Returns the exercise, or all of the chapter."""
    found = _find(text)
    return list(found.exercises) if isinstance(found, Chapter) else [found]


def pick_list(text: str) -> tuple[Exercise, ...]:
    """Returns the exercises of a list, such as 1-5,6.1,8.1-8.4, in the course's order."""
    order = all_exercises()
    chosen: set[Exercise] = set()
    for part in text.split(","):
        ends = _RANGE.fullmatch(part.strip())
        first, last = (pick(ends[1])[0], pick(ends[2])[-1]) if ends else (None, None)
        if ends and order.index(first) > order.index(last):
            raise BadInput(f"{part.strip()!r} ends before it begins; write the earlier exercise first")
        chosen.update(order[order.index(first): order.index(last) + 1] if ends else pick(part.strip()))
    return tuple(exercise for exercise in order if exercise in chosen)


def as_list(exercises: Iterable[Exercise]) -> str:
    """Returns the shortest list of these exercises: 1-5,6.1,8.1-8.4."""
    chosen = set(exercises)
    runs: list[list[str]] = []
    before = (None, -2)
    for place, chapter in enumerate(read_chapters()):
        is_whole = chosen.issuperset(chapter.exercises)
        parts = [(str(chapter.number), (None, place))] if is_whole else [
            (one.id, (chapter, k)) for k, one in enumerate(chapter.exercises) if one in chosen]
        for name, at in parts:
            if (at[0], at[1] - 1) == before:
                runs[-1].append(name)
            else:
                runs.append([name])
            before = at
    return ",".join(run[0] if len(run) == 1 else f"{run[0]}-{run[-1]}" for run in runs)


def chapters_of(exercises: Iterable[Exercise]) -> list[Chapter]:
    """Returns the chapters, with all of their exercises, that have one of these."""
    numbers = {exercise.chapter for exercise in exercises}
    return [chapter for chapter in read_chapters() if chapter.number in numbers]


def pick_one(text: str) -> Exercise:
    found = _find(text)
    if isinstance(found, Chapter):
        first, last = found.exercises[0].id, found.exercises[-1].id
        raise BadInput(f"{text!r} is a chapter; name one exercise, {first} to {last}")
    return found


def pick_chapter(text: str) -> Chapter:
    """Finds a chapter by 4, 04_gauss_seidel or its folder."""
    chapters = read_chapters()
    found = _by_path(text, chapters)
    if isinstance(found, Chapter):
        return found
    if not (text.isascii() and text.isdecimal()):
        raise BadInput(f"{text!r} is not a chapter, such as 4{near(text, [chapter.folder for chapter in chapters])}")
    return _chapter(text, int(text), chapters)


def _find(text: str) -> Chapter | Exercise:
    chapters = read_chapters()
    for chapter in chapters:
        for exercise in chapter.exercises:
            if exercise.function == text:
                return exercise
    found = _NUMBER.fullmatch(text)
    if found:
        chapter = _chapter(text, int(found[1]), chapters)
        return chapter if found[2] is None else _exercise(text, int(found[2]), chapter)
    if meant := _by_path(text, chapters):
        return meant
    known = [exercise.function for chapter in chapters for exercise in chapter.exercises]
    known += [chapter.folder for chapter in chapters]
    raise BadInput(f"{text!r} is neither a chapter (4) nor an exercise (4.2){near(Path(text).stem or text, known)}")


def _by_path(text: str, chapters: list[Chapter]) -> Chapter | Exercise | None:
    """Finds what a path leads to: a chapter's folder, an exercise's file or its playground. Tries chapters/, too."""
    places = {CHAPTERS / chapter.folder: chapter for chapter in chapters}
    for chapter in chapters:
        for exercise in chapter.exercises:
            places[exercise.file] = exercise
            places[exercise.file.parent / "try" / f"try_{exercise.file.name}"] = exercise
    for folder in (Path.cwd(), CHAPTERS):
        path = Path(os.path.abspath(folder / text)) if text else None
        # The file itself may be a link to elsewhere, and so may the folder that the shell is in.
        for place in (path, path and path.parent.resolve() / path.name):
            if place in places:
                return places[place]
    return None


def _chapter(text: str, number: int, chapters: list[Chapter]) -> Chapter:
    for chapter in chapters:
        if chapter.number == number:
            return chapter
    raise BadInput(f"there is no chapter {number}, as in {text!r}; "
                   f"there are {chapters[0].number} to {chapters[-1].number}")


def _exercise(text: str, number: int, chapter: Chapter) -> Exercise:
    for exercise in chapter.exercises:
        if exercise.number == number:
            return exercise
    first, last = chapter.exercises[0].id, chapter.exercises[-1].id
    raise BadInput(f"there is no exercise {text!r}; chapter {chapter.number} has {first} to {last}")
