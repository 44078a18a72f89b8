"""The exercises, read from the one place that lists them: chapters/NN_topic/hints.md."""

import re
from dataclasses import dataclass
from pathlib import Path

from errors import CourseError
from marker import is_empty, is_stub
from paths import CHAPTERS, ROOT, SOLUTIONS

_HEADING = re.compile(r"^## +([0-9]+)\.([0-9]+) +([a-z][a-z0-9_]*)\s*$")
_ITEM = re.compile(r"^[0-9]+\. +")
_TEST = re.compile(r"^[ \t]*EXERCISE_TEST\((\w+), (\w+)\)", re.MULTILINE)


@dataclass(frozen=True)
class Exercise:
    chapter: int
    number: int
    function: str
    folder: str  # of the chapter: 04_gauss_seidel
    hints: tuple[str, ...]

    @property
    def id(self) -> str:
        return f"{self.chapter}.{self.number}"

    @property
    def label(self) -> str:
        return f"{self.id} {self.function}"

    @property
    def suite(self) -> str:
        """Returns its GoogleTest suite: update_row is tested by UpdateRow."""
        return "".join(word.capitalize() for word in self.function.split("_"))

    @property
    def file(self) -> Path:
        return CHAPTERS / self.folder / f"{self.function}.cpp"

    @property
    def reference(self) -> Path:
        return SOLUTIONS / self.folder / f"{self.function}.cpp"

    @property
    def lesson(self) -> Path:
        return CHAPTERS / self.folder / "README.md"

    def source(self) -> str | None:
        """Returns the current text of the student's file; None if it is missing."""
        try:
            return self.file.read_text(encoding="utf-8", errors="replace")
        except FileNotFoundError:
            return None

    def tests(self) -> list[str]:
        """Returns the course's tests of it, such as Kick.AddsForceOverMass, in the order in which they run."""
        return [test for test in tests_in(ROOT / "tests" / self.folder) if test.partition(".")[0] == self.suite]

    def started(self) -> bool:
        source = self.source()
        return source is None or not (is_stub(source) or is_empty(source))


@dataclass(frozen=True)
class Chapter:
    number: int
    folder: str
    title: str
    exercises: tuple[Exercise, ...]


def tests_in(folder: Path) -> list[str]:
    """Returns the tests in the sources of a folder, such as Kick.AddsForceOverMass."""
    return [f"{suite}.{test}" for file in sorted(folder.glob("*.cpp"))
            for suite, test in _TEST.findall(file.read_text(encoding="utf-8", errors="replace"))]


def read_chapters() -> list[Chapter]:
    """Returns all chapters with exercises, in order."""
    files = sorted(CHAPTERS.glob("[0-9][0-9]_*/hints.md"))
    if not files:
        raise CourseError("no exercises: chapters/NN_topic/hints.md, which lists them, is missing")
    return [_read_chapter(file) for file in files]


def all_exercises() -> list[Exercise]:
    return [exercise for chapter in read_chapters() for exercise in chapter.exercises]


def _read_chapter(file: Path) -> Chapter:
    folder = file.parent.name
    exercises = listed(file.read_text(encoding="utf-8"), folder)
    return Chapter(int(folder[:2]), folder, _title(file.with_name("README.md")), tuple(exercises))


def listed(hints: str, folder: str) -> list[Exercise]:
    """Returns the exercises listed in the text of a hints.md, in order."""
    exercises = []
    for heading, body in _sections(hints):
        chapter, number, function = heading.groups()
        exercises.append(Exercise(int(chapter), int(number), function, folder, tuple(numbered_items(body))))
    return sorted(exercises, key=lambda exercise: exercise.number)


def _title(readme: Path) -> str:
    """Returns the first line of the lesson, "# 01 · Leapfrog", without its #."""
    lines = readme.read_text(encoding="utf-8").splitlines() if readme.exists() else []
    return lines[0].lstrip("# ").strip() if lines else readme.parent.name


def _sections(text: str):
    """Returns each exercise's heading with the lines below it."""
    heading, body = None, []
    for line in text.splitlines():
        found = _HEADING.match(line)
        if found or line.startswith("## "):
            if heading:
                yield heading, body
            heading, body = found, []
        else:
            body.append(line)
    if heading:
        yield heading, body


def numbered_items(lines: list[str]) -> list[str]:
    """Returns the items of a numbered Markdown list, with their paragraphs and code."""
    items: list[list[str]] = []
    in_code = False
    for line in lines:
        in_code ^= line.lstrip().startswith("```")
        marker = None if in_code else _ITEM.match(line)
        if marker:
            items.append([line[marker.end():]])
        elif items:
            indent = len(line) - len(line.lstrip())
            items[-1].append(line[min(indent, 3):])
    return ["\n".join(item).strip() for item in items]
