"""Converts MJCF's rotations to the engine's: quaternions (w, x, y, z)."""

import math
from xml.etree.ElementTree import Element

import numpy as np

from errors import BadInput
from importing.report import where

_LARGEST = 1e30  # of which the fifth power, as in a moment of inertia, is still a number
IDENTITY = np.array([1.0, 0, 0, 0])


def product(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    return np.array([p[0] * q[0] - p[1:] @ q[1:], *(p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:]))])


def inverse(q: np.ndarray) -> np.ndarray:
    return q * (1, -1, -1, -1)


def matrix(q: np.ndarray) -> np.ndarray:
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def from_matrix(R: np.ndarray) -> np.ndarray:
    """Returns the eigenvector of the largest eigenvalue of Shepperd's matrix, which is accurate for every angle."""
    K = np.array([[R[0, 0] + R[1, 1] + R[2, 2], R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]],
                  [0, R[0, 0] - R[1, 1] - R[2, 2], R[1, 0] + R[0, 1], R[0, 2] + R[2, 0]],
                  [0, 0, R[1, 1] - R[0, 0] - R[2, 2], R[2, 1] + R[1, 2]],
                  [0, 0, 0, R[2, 2] - R[0, 0] - R[1, 1]]])
    q = np.linalg.eigh(K, UPLO="U")[1][:, -1]
    return q if q[0] >= 0 else -q


def about(axis: np.ndarray, angle: float) -> np.ndarray:
    return np.array([math.cos(angle / 2), *(math.sin(angle / 2) * unit(axis))])


def unit(v: np.ndarray, what: str = "a direction") -> np.ndarray:
    """Returns the vector over its length. Raises BadInput, naming it, if that is 0."""
    length = np.linalg.norm(v)
    if not 0 < length < math.inf:
        raise BadInput(f"{what} must have a length above 0, but has {length:g}")
    return v / length


def z_to(direction: np.ndarray) -> np.ndarray:
    """Returns the shortest rotation of the z axis to a direction."""
    z = unit(direction)
    axis = np.cross((0, 0, 1), z)
    if np.linalg.norm(axis) < 1e-10:
        return IDENTITY if z[2] > 0 else np.array([0.0, 1, 0, 0])
    return about(axis, math.atan2(np.linalg.norm(axis), z[2]))


def turn_of(element: Element, in_degrees: bool, euler_order: str) -> np.ndarray:
    """Returns the rotation from quat, axisangle, euler, xyaxes or zaxis; without these the identity."""
    per_unit = math.pi / 180 if in_degrees else 1
    if "quat" in element.attrib:
        return unit(numbers(element, "quat", 4), f"quat of {named(element)}")
    if "axisangle" in element.attrib:
        *axis, angle = numbers(element, "axisangle", 4)
        return about(unit(np.array(axis), f"axisangle of {named(element)}"), angle * per_unit)
    if "euler" in element.attrib:
        q = IDENTITY
        for axis, angle in zip(euler_order, numbers(element, "euler", 3) * per_unit):
            turn = about(np.eye(3)["xyz".index(axis.lower())], angle)
            q = product(q, turn) if axis.islower() else product(turn, q)  # about moving axes, or fixed ones
        return q
    if "xyaxes" in element.attrib:
        both = numbers(element, "xyaxes", 6)
        x = unit(both[:3], f"xyaxes of {named(element)}")
        y = unit(both[3:] - (both[3:] @ x) * x, f"xyaxes of {named(element)}")
        return from_matrix(np.column_stack([x, y, np.cross(x, y)]))
    if "zaxis" not in element.attrib:
        return IDENTITY
    return z_to(unit(numbers(element, "zaxis", 3), f"zaxis of {named(element)}"))


def numbers(element: Element, name: str, count: int | None = None, default: str | None = None) -> np.ndarray:
    """Returns an attribute as numbers. Raises BadInput with its name if it is missing, too large, or of another
    length."""
    text = element.get(name, default)
    if text is None:
        raise BadInput(f"{named(element)} has no {name}")
    try:
        values = np.array([float(word) for word in text.split()])
    except ValueError:
        values = np.array([math.nan])
    if not np.all(np.isfinite(values)) or (count is not None and len(values) != count):
        wanted = "a finite number" if count == 1 else f"{count or 'finite'} numbers"
        raise BadInput(f"{name} of {named(element)} must be {wanted}, but is \"{text}\"")
    if np.any(np.abs(values) > _LARGEST):
        raise BadInput(f"{name} of {named(element)} must be at most {_LARGEST:g}, but is \"{text}\"")
    return values


def named(element: Element) -> str:
    """Returns an element's name, or its kind, with its place."""
    place = f" ({where(element)})" if where(element) else ""
    one = {"option": "the option", "compiler": "the compiler"}.get(element.tag, f"a {element.tag}")
    return (f"{element.tag} \"{element.get('name')}\"" if element.get("name") else one) + place
