"""./course predict N: a chapter's questions, one at a time, before the code is written."""

import sys

import remembered
from errors import CourseError
from manifest import Chapter
from pick import pick_chapter
from predictions import Prediction, predictions_of
from terminal import counted, fold, paint, symbol

_FILE, _TABLE = "predictions.json", "predictions"


def predict(arguments) -> int:
    chapter = pick_chapter(arguments.which)
    if sys.stdin:
        sys.stdin.reconfigure(errors="replace")
    asked = predictions_of(chapter)
    made = {} if arguments.again else guesses(asked)
    left = [each for each in asked if each.id not in made]
    print(f"{paint(chapter.title, 'bold')}: {counted(len(asked), 'prediction')}, {len(left)} left\n")
    if left:
        print(fold("Guess before you know. Type a letter, or a number such as 0.2, 2e-3 or 1/60; Enter leaves a "
                   "question for later.") + "\n")
    for each in left:
        _ask(each, f"{asked.index(each) + 1} of {len(asked)}")
    _sum_up(chapter, asked)
    return 0


def guesses(asked: list[Prediction]) -> dict[str, str]:
    """Returns the stored guesses by question number, without those that cannot be read any more."""
    kept = remembered.read(_FILE, _TABLE)
    return {each.id: kept[each.id] for each in asked
            if isinstance(kept.get(each.id), str) and each.read(kept[each.id]) is not None}


def count_right(asked: list[Prediction]) -> int:
    made = guesses(asked)
    return sum(each.is_right(made[each.id]) for each in asked if each.id in made)


def _ask(each: Prediction, place: str) -> None:
    print(f"{paint(place, 'bold')}\n{fold(_plain(each.question), '  ')}\n")
    for letter, text in each.choices.items():
        print(fold(f"{letter}) {text}", "    "))
    if each.choices:
        print()
    while (text := _line(f"  {each.asks_for()}: ", place)).strip():
        guess = each.read(text)
        if guess is not None:
            remembered.write(_FILE, _TABLE, remembered.read(_FILE, _TABLE) | {each.id: guess})
            _judge(each, guess)
            return
        print(f"  {text.strip()!r} is not {each.asks_for()}.")
    print("  Left for later.\n")


def _line(prompt: str, place: str) -> str:
    print(prompt, end="", flush=True)
    text = sys.stdin.readline() if sys.stdin else ""  # there is none where it was closed
    if not text:
        print()
        raise CourseError(f"the input ended at question {place}; earlier answers are kept")
    if not sys.stdin.isatty():  # then nobody has seen what was written
        print(text.rstrip("\n"))
    return text


def _judge(each: Prediction, guess: str) -> None:
    right = each.is_right(guess)
    remark = "" if right else each.remark(guess)
    print(f"\n  {symbol('done' if right else 'wrong')} "
          + (paint("Right", "green") + f": {each.wanted()}." if right else f"No: it is {each.wanted()}."))
    print(fold(f"{remark} {each.why}".strip(), "    ") + "\n")


def _sum_up(chapter: Chapter, asked: list[Prediction]) -> None:
    made = guesses(asked)
    print(f"{len(made)} of {len(asked)} made, {count_right(asked)} right.")
    if len(made) < len(asked):
        print(f"The others: ./course predict {chapter.number}")
    else:
        print(f"From the first: ./course predict {chapter.number} --again")


def _plain(text: str) -> str:
    """Removes Markdown's marks."""
    return text.replace("`", "").replace("*", "")
