"""The book's additions to an exercise of a lesson: its declaration, the comment above, its hints, and its tests."""

import html
import re
from pathlib import Path

from manifest import Exercise, read_chapters
from paths import CHAPTERS, ROOT

_ITEM = re.compile(r" {3}(\S+) {2,}(\S.*)")
_CODE = re.compile(r"(`[^`]*`)")


def exercises_of(lesson: Path) -> dict[str, tuple[str, str]]:
    """Returns Markdown for each exercise by its heading: the part below the heading and the part at the end. Empty for
    a page that is not a lesson."""
    chapter = next((chapter for chapter in read_chapters() if CHAPTERS / chapter.folder / "README.md" == ROOT / lesson),
                   None)
    if chapter is None:
        return {}
    headers = "\n".join(header.read_text(encoding="utf-8") for header in (CHAPTERS / chapter.folder).glob("*.hpp"))
    return {exercise.label: (_promise(exercise, headers), _hints(exercise) + _tests(exercise))
            for exercise in chapter.exercises}


def _promise(exercise: Exercise, headers: str) -> str:
    comment, declared = declaration(exercise, headers)
    return f"{_prose(comment)}\n\n```cpp\n{declared}\n```\n"


def _prose(comment: list[str]) -> str:
    """Converts a comment to Markdown. A line such as `   gap    signed [m]` is an item of a list, and continues in
    lines that are indented further."""
    parts: list[str] = []
    in_list = False
    for line in comment:
        item = _ITEM.fullmatch(line)
        in_list = bool(item) or in_list and line.startswith("    ")
        text = f"- `{item[1]}`: {item[2]}" if item else line.strip()
        begins = item or not parts or not in_list and parts[-1].startswith("- ")
        if begins:
            parts.append(text)
        else:
            parts[-1] += " " + text
    whole = "\n\n".join(parts)
    return "".join(part if k % 2 else _escaped(part) for k, part in enumerate(_CODE.split(whole)))


def _escaped(text: str) -> str:
    return html.escape(text.replace("<=", "≤").replace(">=", "≥"), quote=False)


def declaration(exercise: Exercise, header: str) -> tuple[list[str], str]:
    """Returns the lines of an exercise's comment without its number, and the declaration, up to the semicolon."""
    lines = header.splitlines()
    for begin, line in enumerate(lines):
        if line.startswith(f"/// Exercise {exercise.id}. "):
            end = next(k for k in range(begin, len(lines)) if not lines[k].startswith("//") and lines[k].endswith(";"))
            comment = [line.removeprefix("///") for line in lines[begin:end] if line.startswith("///")]
            comment[0] = comment[0].removeprefix(f" Exercise {exercise.id}. ")
            return comment, "\n".join(line for line in lines[begin:end + 1] if not line.startswith("//"))
    return [], ""


def _hints(exercise: Exercise) -> str:
    """Nests each hint in the one before, so that they are read one at a time."""
    text = ""
    for number, hint in reversed(list(enumerate(exercise.hints, 1))):
        text = _folded(f"Hint {number} of {len(exercise.hints)}", f"{hint}\n\n{text}")
    return text


def _folded(title: str, text: str) -> str:
    return f'<details class="more">\n<summary>{title}</summary>\n\n{text.rstrip()}\n\n</details>\n\n'


def _tests(exercise: Exercise) -> str:
    names = [f"`{test.partition('.')[2]}`" for test in exercise.tests()]
    return _folded("Tests", ", ".join(names)) if names else ""
