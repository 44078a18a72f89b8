"""Questions that a chapter asks before the code, from its lesson; answers from chapters/predictions.ini."""

import configparser
import functools
import re
from dataclasses import dataclass, field

from errors import CourseError
from manifest import Chapter, numbered_items
from paths import CHAPTERS

ANSWERS = CHAPTERS / "predictions.ini"
HEADING = "## Predict before you code"
_NUMBER = re.compile(r"([+-]?\d+(?:\.\d*)?(?:[eE][+-]?\d+)?|[+-]?\.\d+)(?:/(\d+(?:\.\d*)?))?(\s*%)?", re.ASCII)


@dataclass(frozen=True)
class Prediction:
    id: str  # 4.2, the second of chapter 4
    question: str
    why: str
    answer: str = ""  # a number, as it is written; or else there are choices
    unit: str = ""
    within: float = 2  # per cent
    code: str = ""
    choices: dict[str, str] = field(default_factory=dict)
    right: str = ""
    remarks: dict[str, str] = field(default_factory=dict)

    def read(self, text: str) -> str | None:
        """Returns the guess in its stored form; None if it is neither a number nor one of the letters."""
        if self.choices:
            letter = text.strip().lower().rstrip(").")
            return letter if letter in self.choices else None
        value = number(text, self.unit)
        return None if value is None else f"{value:.10g}"

    def is_right(self, guess: str) -> bool:
        if self.choices:
            return guess == self.right
        return _near(float(guess), float(self.answer), self.within)

    def remark(self, guess: str) -> str:
        """Returns the remark for this answer."""
        return next((said for answer, said in self.remarks.items()
                     if (guess == answer if self.choices else _near(float(guess), float(answer), self.within))), "")

    def wanted(self) -> str:
        return f"{self.right}) {self.choices[self.right]}" if self.choices else f"{self.answer} {self.unit}".strip()

    def asks_for(self) -> str:
        letters = list(self.choices)
        if letters:
            return f"one of {', '.join(letters[:-1])} or {letters[-1]}"
        return f"a number, in {self.unit}" if self.unit else "a number"


def number(text: str, unit: str = "") -> float | None:
    """Reads a number such as 0.2, 2e-3, 1/60 or 5 %, perhaps with its unit."""
    text = text.strip().replace("\u2212", "-")
    if unit and text.lower().endswith(unit.lower()):
        text = text[: -len(unit)].strip()
    found = _NUMBER.fullmatch(text)
    if not found or found[2] is not None and float(found[2]) == 0:
        return None
    value = float(found[1]) / float(found[2] or 1) / (100 if found[3] else 1)
    return value if abs(value) < 1e300 else None


def _near(guess: float, answer: float, within: float) -> bool:
    return abs(guess - answer) <= within / 100 * abs(answer) + 1e-9


def predictions_of(chapter: Chapter) -> list[Prediction]:
    """Returns the predictions in the lesson's order."""
    lesson = (CHAPTERS / chapter.folder / "README.md").read_text(encoding="utf-8")
    questions = numbered_items(lesson.partition(f"\n{HEADING}\n")[2].partition("\n## ")[0].splitlines())
    return [_prediction(f"{chapter.number}.{k}", question) for k, question in enumerate(questions, 1)]


def _prediction(key: str, question: str) -> Prediction:
    answers = _answers()
    if key not in answers:
        raise CourseError(f"chapters/predictions.ini has no answer [{key}]")
    given = answers[key]
    choices = dict(line.split(maxsplit=1) for line in given.get("choices", "").strip().splitlines())
    return Prediction(key, question.split("\n\n")[0], _joined(given["why"]), given.get("number", ""),
                      given.get("unit", ""), float(given.get("within", 2)), given.get("code", ""), choices,
                      given.get("right", ""),
                      {name[3:]: _joined(said) for name, said in given.items() if name.startswith("if ")})


def _joined(text: str) -> str:
    return " ".join(text.split())


@functools.cache
def _answers() -> configparser.ConfigParser:
    answers = configparser.ConfigParser(delimiters="=", comment_prefixes="#", interpolation=None)
    try:
        answers.read_string(ANSWERS.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise CourseError("chapters/predictions.ini, which has the answers, is missing") from None
    except configparser.Error as error:
        raise CourseError(f"chapters/predictions.ini: {' '.join(str(error).split())}") from None
    return answers
