"""Pickles worlds: a copy is built by the same arguments and the same bodies and joints, and continues from the same
state."""

from __future__ import annotations

import copy
import functools
from typing import Any, Callable

import numpy as np


def picklable(kind: type) -> type:
    """Makes the worlds of a class picklable. Its constructor takes arguments by name only."""
    construct = kind.__init__

    @functools.wraps(construct)
    def __init__(self: Any, *arguments: Any, **named: Any) -> None:
        construct(self, *arguments, **named)
        self._given = copy.deepcopy(named)

    def __reduce__(self: Any) -> tuple[Callable, tuple, dict | None]:
        built = (kind, type(self), self._given, *self._content(), self.get_state())
        return rebuilt, built, getattr(self, "__dict__", None) or None

    kind.__init__, kind.__reduce__ = __init__, __reduce__
    return kind


def rebuilt(kind: type, own: type, given: dict[str, Any], content: str, loads: np.ndarray | None, state: bytes) -> Any:
    """Returns a world of the class `own`, which is `kind` or a subclass of it."""
    world = own.__new__(own)
    kind.__init__(world, **given)
    world._fill(content, loads)
    world.set_state(state)
    return world
