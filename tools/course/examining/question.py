"""Exam questions drawn by a seed: numbers, signs and conventions vary, and each has its answer."""

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass


class Draw:
    """The random choices of one question; the same seed gives the same ones."""

    def __init__(self, seed: int, key: str):
        self._random = random.Random(f"{seed}/{key}")

    def of(self, *values):
        return self._random.choice(values)

    def whole(self, low: int, high: int) -> int:
        return self._random.randint(low, high)

    def tenth(self, low: float, high: float) -> float:
        """Draws a number with one digit after the point."""
        return self._random.randint(round(10 * low), round(10 * high)) / 10


@dataclass(frozen=True)
class Question:
    chapter: int
    objective: int  # which line of the lesson's "What you will be able to do"
    exercises: tuple[str, ...]  # that practise the objective
    ask: Callable[[Draw], tuple[str, str]]

    @property
    def id(self) -> str:
        return f"{self.chapter}.{'abcdefgh'[self.objective - 1]}"

    def drawn(self, seed: int) -> tuple[str, str]:
        """Returns the text and its answer."""
        text, answer = self.ask(Draw(seed, self.id))
        return " ".join(text.split()), answer


QUESTIONS: list[Question] = []


def asks(chapter: int, objective: int, exercises: str):
    """Registers a function that draws a question."""
    def add(ask: Callable[[Draw], tuple[str, str]]):
        QUESTIONS.append(Question(chapter, objective, tuple(exercises.split()), ask))
        return ask
    return add


def said(value: float, unit: str = "") -> str:
    """Formats a number with four digits and a true minus sign."""
    return f"{round(value, 12) + 0.0:.4g} {unit}".strip().replace("-", "−")


def vector(values: Sequence[float], unit: str = "") -> str:
    return f"({', '.join(said(value) for value in values)}) {unit}".strip()
