"""MJCF's geoms: their masses, and their contact points with planes."""

import itertools
import math
from dataclasses import dataclass, replace
from xml.etree.ElementTree import Element

import numpy as np

from errors import BadInput
from importing.turning import matrix, named, numbers, turn_of, z_to

DENSITY = 1000.0  # [kg/m³], unless given
_NO_GEOM = ("plane", "mesh", "hfield", "sdf")
_FRICTION = (1.0, 0.005, 0.0001)  # of sliding; of torsion and of rolling [m]
_AROUND = 8  # points on a circle: on two of them a lying cylinder of radius r is r (1 - cos(π/8)) = 0.08 r too low


@dataclass(frozen=True)
class Surface:
    """Which geoms a geom touches, and with what friction."""

    contype: int
    conaffinity: int
    friction: tuple[float, float, float]  # of sliding; of torsion and of rolling [m]
    condim: int  # 1: without friction; 4: with torsion; 6: with rolling, too
    priority: int

    def touches(self, other: "Surface") -> bool:
        return bool(self.contype & other.conaffinity or other.contype & self.conaffinity)

    def friction_with(self, other: "Surface") -> tuple[float, float, float]:
        """Returns the frictions of a contact: those of the higher priority, or else the larger ones."""
        top = max(self.priority, other.priority)
        chosen = [each for each in (self, other) if each.priority == top]
        condim = max(each.condim for each in chosen)
        sliding, torsion, rolling = map(max, *(each.friction for each in chosen), (0.0, 0.0, 0.0))
        return sliding if condim > 1 else 0.0, torsion if condim > 3 else 0.0, rolling if condim > 4 else 0.0


@dataclass
class Geom:
    kind: str
    x: np.ndarray  # centre [m]
    R: np.ndarray  # its axes
    size: np.ndarray  # radius, and half length without the caps; or half sides [m]
    mass: float  # [kg]
    moments: np.ndarray  # about its centre, along its axes [kg m²]
    surface: Surface
    element: Element | None = None
    owner: str = ""  # name of its body in the model

    def moved(self, x: np.ndarray, R: np.ndarray) -> "Geom":
        return replace(self, x=x + R @ self.x, R=R @ self.R)

    def points(self) -> np.ndarray:
        """Returns the contact points with planes, a row each."""
        return self.x + _surface(self.kind, self.size) @ self.R.T


def surface_of(element: Element) -> Surface:
    whole = {name: int(numbers(element, name, 1, default)[0])
             for name, default in (("contype", "1"), ("conaffinity", "1"), ("condim", "3"), ("priority", "0"))}
    given = [float(number) for number in numbers(element, "friction", None, "1")]
    return Surface(friction=(*given, *_FRICTION[len(given):])[:3], **whole)


def geom_of(element: Element, in_degrees: bool, euler_order: str) -> Geom | None:
    """Returns a geom; None for planes, and for meshes and height fields, which the engine does not read. Raises BadInput
    for a type that MJCF does not have."""
    kind = element.get("type", "sphere")
    if kind not in _VOLUME:
        if kind not in _NO_GEOM:
            raise BadInput(f"type of {named(element)} must be {', '.join([*_VOLUME, *_NO_GEOM])}, but is \"{kind}\"")
        return None
    size = numbers(element, "size") if "size" in element.attrib else np.zeros(3)
    x, R = numbers(element, "pos", 3, "0 0 0"), matrix(turn_of(element, in_degrees, euler_order))
    if "fromto" in element.attrib:
        ends = numbers(element, "fromto", 6).reshape(2, 3)
        x, R = ends.mean(axis=0), matrix(z_to(ends[0] - ends[1]))
        half = np.linalg.norm(ends[1] - ends[0]) / 2
        size = np.array([size[0], half] if kind in ("capsule", "cylinder") else [size[0], size[0], half])
    wanted = {"sphere": 1, "capsule": 2, "cylinder": 2}.get(kind, 3)
    if len(size) < wanted or not np.all(size[:wanted] > 0):
        raise BadInput(f"{named(element)} of type {kind} must have {wanted} positive size{'s' if wanted > 1 else ''}, "
                       f"but has \"{element.get('size', '')}\"")
    size = size[:wanted]
    volume, moments = _VOLUME[kind](size)
    mass = numbers(element, "mass", 1)[0] if "mass" in element.attrib else (
        numbers(element, "density", 1, str(DENSITY))[0] * volume)
    return Geom(kind, x, R, size, float(mass), mass * moments, surface_of(element), element)


# Volume [m³], and moments for each kilogram [m²].


def _ellipsoid(s):
    return 4 / 3 * math.pi * s.prod(), (s @ s - s * s) / 5


def _sphere(s):
    return _ellipsoid(np.repeat(s, 3))


def _box(s):
    return 8 * s.prod(), (s @ s - s * s) / 3


def _cylinder(s):
    r, half = s
    across = r * r / 4 + half * half / 3
    return 2 * math.pi * r * r * half, np.array([across, across, r * r / 2])


def _capsule(s):
    """Returns mass and moments of a cylinder and two half spheres, whose centres of mass are 3/8 r beyond its ends."""
    r, half = s
    cylinder, ball = 2 * math.pi * r * r * half, 4 / 3 * math.pi * r**3
    (_, of_cylinder), (_, of_ball) = _cylinder(s), _sphere(s[:1])
    shifted = half * half + 3 / 4 * r * half
    moments = cylinder * of_cylinder + ball * (of_ball + np.array([shifted, shifted, 0]))
    return cylinder + ball, moments / (cylinder + ball)


_VOLUME = {"sphere": _sphere, "box": _box, "cylinder": _cylinder, "capsule": _capsule, "ellipsoid": _ellipsoid}


def _surface(kind: str, size: np.ndarray) -> np.ndarray:
    if kind == "box":
        return np.array(list(itertools.product((-1, 1), repeat=3))) * size
    circle = [(math.cos(a), math.sin(a)) for a in 2 * math.pi / _AROUND * np.arange(_AROUND)]
    if kind == "cylinder":
        return np.array([(size[0] * x, size[0] * y, z) for x, y in circle for z in (-size[1], size[1])])
    # A ball, or its halves: a circle around, one halfway up, and the top.
    half = [(x, y, 0) for x, y in circle]
    half += [(x * math.sqrt(0.5), y * math.sqrt(0.5), math.sqrt(0.5)) for x, y in circle] + [(0, 0, 1)]
    up = np.array(half)
    down = up * (1, 1, -1)
    if kind == "capsule":
        end = np.array([0, 0, size[1]])
        return np.vstack([size[0] * up + end, size[0] * down - end])
    return np.vstack([up, down[_AROUND:]]) * size  # a sphere or an ellipsoid
