"""Explains arguments that no function accepts: the extension module's own errors list whole signatures only."""

from __future__ import annotations

import difflib
import functools
import inspect
import re
from typing import Any, Callable, Iterable, ParamSpec, TypeVar

import numpy as np

P = ParamSpec("P")
R = TypeVar("R")
_PARAMETER = re.compile(r"(\*)|(\w+): ((?:[^,\[(]|\[[^\]]*(?:\[[^\]]*\][^\]]*)*\]|\([^)]*\))+)")


def explained(kind: type) -> type:
    """Makes the functions of a class name the wrong argument, and the accepted kind, in their TypeError."""
    for name, member in list(vars(kind).items()):
        if callable(member) and name != "step" and (not name.startswith("_") or name == "__init__"):
            setattr(kind, name, _explained(member, kind.__name__ if name == "__init__" else name))
    return kind


def step_otherwise(world: Any, arguments: tuple, named: dict[str, Any]) -> None:
    """Takes steps with arguments that need a conversion, such as whole numbers. Raises TypeError that names a wrong
    one."""
    try:
        world._step(*arguments, **named)
    except TypeError as error:
        if "incompatible function arguments" not in str(error):
            raise
        raise TypeError(f"step: {_why(str(error), arguments, named)}") from None


def by_known_names(function: Callable[P, R]) -> Callable[P, R]:
    """Makes a function of Python say in its TypeError which name is unknown, and which may be meant."""
    wanted = [name for name in inspect.signature(function).parameters if name != "self"]

    @functools.wraps(function)
    def call(*arguments: P.args, **named: P.kwargs) -> R:
        for name in named:
            if name not in wanted:
                raise TypeError(f"{function.__name__}: {_unknown(name, wanted)}")
        return function(*arguments, **named)

    return call


def _unknown(name: str, wanted: Iterable[str]) -> str:
    near = difflib.get_close_matches(name, wanted, 1)
    return f"there is no {name}; " + (f"did you mean {near[0]}?" if near else f"there are: {', '.join(wanted)}")


def _explained(function: Callable, name: str) -> Callable:
    @functools.wraps(function)
    def call(*arguments: Any, **named: Any) -> Any:
        for value in (*arguments[1:], *named.values()):  # NumPy would convert texts in a list to numbers
            if isinstance(value, (tuple, list)) and any(isinstance(each, str) for each in value):
                raise TypeError(f"{name}: numbers, got {value!r}")
        try:
            return function(*arguments, **named)
        except TypeError as error:
            why = _why(str(error), arguments[1:], named)
            raise TypeError(f"{name}: {why}" if why else str(error)) from None

    return call


def _why(message: str, arguments: tuple, named: dict[str, Any]) -> str:
    """Returns what is wrong with the arguments, by the first signature in the message; empty if nothing is found."""
    signature = re.search(r"^ +1\. [\w.]*\((?:self: [^,)]*(?:, )?)?(.*)\)(?: -> .*)?$", message, re.MULTILINE)
    if not signature:
        return ""
    wanted, positional = {}, []
    by_name_only = False
    for star, name, kind in _PARAMETER.findall(signature[1]):
        by_name_only |= bool(star)
        if name:
            wanted[name] = kind.strip()
            positional += [name] if not by_name_only else []
    if len(arguments) > len(positional):
        if not positional:
            return f"takes arguments by name, such as {next(iter(wanted))}=..., but got {len(arguments)} without"
        return f"at most {len(positional)} arguments without a name, got {len(arguments)}"
    given = dict(zip(positional, arguments))
    for name, value in named.items():
        if name not in wanted:
            return _unknown(name, wanted)
        if name in given:
            return f"{name} is given twice"
    missing = [name for name, kind in wanted.items() if " = " not in kind and name not in given and name not in named]
    if missing:
        return f"{missing[0]} is missing"
    for name, value in {**given, **named}.items():
        if told := _misfit(wanted[name].split(" = ")[0], value):
            return f"{name}: {told}"
    return ""


def _misfit(kind: str, value: Any) -> str:
    """Returns 'three numbers, got 2'; empty if the value is of this kind, or the kind is not known."""
    if value is None:
        return "" if "None" in kind or "Optional" in kind else f"{_shape(kind) or 'a value'}, got None"
    for pattern, words, fits in _PLAIN:
        if re.search(pattern, kind):
            return "" if fits(value) else f"{words}, got {value!r}"
    wanted = _shape(kind)
    if not wanted:
        return ""
    if isinstance(value, str):  # NumPy would read a number
        return f"{wanted}, got {value!r}"
    try:
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        return f"{wanted}, got {value!r}"
    if not _fits(kind, array, value):
        return f"{wanted}, got {_counted(kind, array, value)}"
    if wanted == "a whole number" and not -2**31 <= value < 2**31:
        return f"a whole number that is not so large, got {value!r}"
    return ""


def _is_a_list(value: Any, of: type | tuple) -> bool:
    return np.iterable(value) and not isinstance(value, str) and all(isinstance(each, of) for each in value)


# Kinds in a signature of pybind11 that are no arrays: a pattern, the kind in words, and a test of a value.
_PLAIN: tuple[tuple[str, str, Callable[[Any], bool]], ...] = (
    (r"\bPointWorld\b", "a PointWorld", lambda value: type(value).__name__ == "PointWorld"),
    (r"\bWorld\b", "a World", lambda value: type(value).__name__ == "World"),
    (r"\bstr\b", "a text", lambda value: isinstance(value, str)),
    (r"\bbytes\b", "bytes", lambda value: isinstance(value, bytes)),
    (r"\bbool\b", "True or False", lambda value: isinstance(value, (bool, np.bool_))),
    (r"\bfunction\b|\bCallable\b", "a function", callable),
    (r"\b[Ll]ist\[int\]", "a list of whole numbers", lambda value: _is_a_list(value, (int, np.integer))),
    (r"\b[Ll]ist\[float\]", "a list of numbers", lambda value: _is_a_list(value, (int, float, np.number))))


_WORDS = {2: "two", 3: "three", 4: "four"}


def _sizes(kind: str) -> tuple[int | None, ...] | None:
    """Returns (3,) for a vector, (None, 3) for rows, () for a number, and None for anything else."""
    if re.search(r"\bList\[numpy", kind):
        return (None, 3)
    if rows := re.search(r"\[(m|\d+), (n|\d+)", kind):
        sizes = tuple(None if size in "mn" else int(size) for size in rows.groups())
        return (sizes[0],) if sizes[1] == 1 and sizes[0] else sizes
    if fixed := re.search(r"FixedSize\((\d+)\)|float\[(\d+)\]", kind):
        return (int(fixed[1] or fixed[2]),)
    return () if re.search(r"\b(float|int|SupportsFloat|SupportsInt)\b", kind) and "ist" not in kind else None


def _shape(kind: str) -> str:
    if plain := next((words for pattern, words, _ in _PLAIN if re.search(pattern, kind)), ""):
        return plain
    sizes = _sizes(kind)
    if sizes is None:
        return ""
    if sizes == ():
        return "a whole number" if re.search(r"\bint\b", kind) else "a number"
    if len(sizes) == 1:
        return f"{_WORDS.get(sizes[0], sizes[0])} numbers"
    return f"rows of {_WORDS.get(sizes[1], sizes[1])} numbers"


def _fits(kind: str, array: np.ndarray, value: Any) -> bool:
    sizes = _sizes(kind)
    if sizes == () and re.search(r"\bint\b", kind) and not isinstance(value, (int, np.integer)):
        return False
    return array.ndim == len(sizes) and all(size in (None, count) for size, count in zip(sizes, array.shape))


def _counted(kind: str, array: np.ndarray, value: Any) -> str:
    if array.ndim == 0:
        return f"the number {value!r}" if _sizes(kind) else repr(value)
    return str(array.size) if array.ndim == 1 else " x ".join(map(str, array.shape))
