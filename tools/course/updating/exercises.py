"""Pairs the exercises of two releases, and finds where each older file belongs in the newer release."""

import re
from dataclasses import dataclass

from manifest import Exercise, listed
from updating import trees
from updating.trees import Tree

_HINTS = re.compile(r"chapters/([0-9][0-9]_[^/]+)/hints\.md")


@dataclass(frozen=True)
class Pair:
    """An exercise of the older release, and the same function in the newer one; None if that has no such exercise."""
    old: Exercise
    new: Exercise | None


Homes = dict[str, str | None]  # an exercise's path in the older release: its path in the newer one


def pairs(base: Tree, target: Tree) -> dict[str, Pair]:
    """Finds the exercises of the older release by path. A function keeps its name when its chapter moves."""
    by_function = {exercise.function: exercise for exercise in _exercises(target).values()}
    return {path: Pair(exercise, by_function.get(exercise.function)) for path, exercise in _exercises(base).items()}


def homes(paired: dict[str, Pair]) -> Homes:
    return {path: path_of(pair.new) if pair.new else None for path, pair in paired.items()}


def path_of(exercise: Exercise) -> str:
    return f"chapters/{exercise.folder}/{exercise.function}.cpp"


def in_place_of(pair: Pair, target: Tree) -> Exercise | None:
    """Returns the exercise that has taken the number of a removed one."""
    return next((exercise for exercise in _exercises(target).values() if exercise.id == pair.old.id), None)


def _exercises(tree: Tree) -> dict[str, Exercise]:
    found = {}
    for path, entry in tree.items():
        if hints := _HINTS.fullmatch(path):
            found |= {path_of(exercise): exercise for exercise in listed(trees.text(entry), hints[1])}
    return {path: exercise for path, exercise in found.items() if path in tree}
