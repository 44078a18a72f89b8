"""./course exam LIST: questions on a chapter's objectives, with numbers, signs and conventions drawn by a seed."""

import importlib
import re
import sys

from errors import BadInput, CourseError
from examining.question import QUESTIONS, Question
from manifest import Chapter, read_chapters
from pick import as_list
from terminal import fold

_FILES = ("chapters_01_to_05", "chapters_06_to_09", "chapters_10_to_14")
_HEADING = "## What you will be able to do"
_HEAD = """\
# Objectives

This page lists what a reader of each chapter is able to do. Each objective names the exercises that practise it, and
the exam question that asks for it. `./course exam 4 --seed 2027` draws the questions of a chapter, and `--answers` adds
the answers."""


def exam(arguments) -> int:
    questions = all_questions()
    if arguments.objectives:
        if arguments.chapters or arguments.answers or arguments.seed is not None:
            raise BadInput("exam: --objectives prints a page of all chapters, and goes with no other option")
        sys.stdout.write(objectives_page())
        return 0
    if not arguments.chapters:
        raise BadInput("exam: name the chapters, as in ./course exam 1-5 --seed 2027, or also exercises: 1-7,8.1-8.4")
    seed = arguments.seed if arguments.seed is not None else 1
    named, known = as_list(arguments.chapters), {one.id for one in arguments.chapters}
    chosen = [one for one in questions if known.issuperset(one.exercises)]
    partly = [one for one in questions if known.intersection(one.exercises) and one not in chosen]
    if partly:
        lacking = "; ".join(f"{one.id} lacks {', '.join(sorted(set(one.exercises) - known, key=_place))}" for one in partly)
        print(fold(f"Left out are questions whose exercises are not all in LIST: {lacking}."), file=sys.stderr)
    if not chosen:
        raise BadInput(f"exam: no question is about {named} alone")
    print(f"# Chapters {named.replace(',', ', ')}, seed {seed}" + (", with answers" if arguments.answers else ""))
    for one in chosen:
        text, answer = one.drawn(seed)
        print(f"\n**{one.id}** {text}" + (f"\n\n*{answer}*" if arguments.answers else ""))
    return 0


def all_questions() -> list[Question]:
    """Returns all questions in the order of chapters and objectives."""
    try:
        for name in _FILES:
            importlib.import_module(f"examining.{name}")
    except ModuleNotFoundError:
        raise CourseError("exam: this repository for students has no exam questions") from None
    return sorted(QUESTIONS, key=lambda one: (one.chapter, one.objective))


def objectives_of(chapter: Chapter) -> list[str]:
    """Returns the list in the lesson's section of objectives."""
    lesson = chapter.exercises[0].lesson.read_text(encoding="utf-8")
    section = lesson.partition(f"\n{_HEADING}\n")[2].partition("\n## ")[0]
    return [" ".join(item.split()) for item in re.findall(r"^- (.*?)(?=^- |\Z)", section, re.MULTILINE | re.DOTALL)]


def objectives_page() -> str:
    """Returns the text of chapters/OBJECTIVES.md."""
    questions = all_questions()
    parts = [_HEAD]
    for chapter in read_chapters():
        folder = f"{chapter.folder}/README.md"
        parts.append(f"\n## [{chapter.title}]({folder})\n")
        for number, objective in enumerate(objectives_of(chapter), 1):
            found = [one for one in questions if (one.chapter, one.objective) == (chapter.number, number)]
            exercises = sorted({name for one in found for name in one.exercises}, key=_place)
            named = ", ".join(one.id for one in found)
            parts.append(_item(f"{objective} *Exercise{'s'[:len(exercises) > 1]} {', '.join(exercises)}; question {named}.*"))
    return "\n".join(parts) + "\n"


def _place(name: str) -> int:
    """Returns the place of an exercise, such as 8.10, in its chapter."""
    return int(name.partition(".")[2])


def _item(text: str) -> str:
    """Formats an item of a list, in lines of at most 120 columns."""
    lines, line = [], "-"
    for word in text.split():
        if len(line) + 1 + len(word) > 120:
            lines.append(line)
            line = " "
        line += f" {word}"
    return "\n".join([*lines, line])
