"""MJCF's replicate: copies of its content, each placed relative to the one before."""

import copy
from xml.etree.ElementTree import Element

import numpy as np

from errors import BadInput
from importing.turning import IDENTITY, matrix, numbers, product, turn_of

_MOST = 10_000  # copies of one replicate
_MOST_COPIED = 200_000  # elements in all copies: of replicates in one another the counts multiply
_SHOWN = 10**9  # the largest number of them that is told
_NAMES = ("name", "joint", "body1", "body2")


def expand(element: Element, in_degrees: bool, euler_order: str) -> None:
    """Replaces every replicate by a frame for each copy. Names inside get the copy's number at their end."""
    copied = _size(element) - sum(1 for _ in element.iter())
    if copied > _MOST_COPIED:
        raise BadInput(f"the copies of all replicates must add at most {_MOST_COPIED} elements, but add "
                       f"{min(copied, _SHOWN)} or more; lower the count of a replicate")
    _expand(element, in_degrees, euler_order)


def _size(element: Element) -> int:
    """Returns the number of elements that an element will be."""
    return (_count(element) if element.tag == "replicate" else 1) * (1 + sum(map(_size, element)))


def _expand(element: Element, in_degrees: bool, euler_order: str) -> None:
    for child in list(element):
        _expand(child, in_degrees, euler_order)
        if child.tag == "replicate":
            place = list(element).index(child)
            element.remove(child)
            element[place:place] = _copies(child, in_degrees, euler_order)


def _count(replicate: Element) -> int:
    count = numbers(replicate, "count", 1)[0]
    if not (count == int(count) and 0 < count <= _MOST):
        raise BadInput(f"count of a replicate must be a whole number from 1 to {_MOST}, "
                       f"but is {replicate.get('count')}")
    return int(count)


def _copies(replicate: Element, in_degrees: bool, euler_order: str) -> list[Element]:
    count, offset = _count(replicate), numbers(replicate, "offset", 3, "0 0 0")
    euler = numbers(replicate, "euler", 3, "0 0 0")
    x, turned, frames = np.zeros(3), IDENTITY, []
    turn = _turn(euler, in_degrees, euler_order)
    for k in range(count):
        q = _turn(k * euler, in_degrees, euler_order)
        frame = Element("frame", {"pos": _text(x), "quat": _text(q)})
        suffix = replicate.get("sep", "") + str(k).zfill(len(str(count - 1)))
        for child in replicate:
            frame.append(_renamed(copy.deepcopy(child), suffix))
        frames.append(frame)
        x, turned = x + matrix(turned) @ offset, product(turned, turn)
    return frames


def _turn(euler: np.ndarray, in_degrees: bool, euler_order: str) -> np.ndarray:
    return turn_of(Element("frame", {"euler": _text(euler)}), in_degrees, euler_order)


def _renamed(element: Element, suffix: str) -> Element:
    for each in element.iter():
        for name in _NAMES:
            if name in each.attrib:
                each.set(name, each.get(name) + suffix)
    return element


def _text(values: np.ndarray) -> str:
    return " ".join(repr(float(value)) for value in values)
