"""Finds which bodies of a scene touch each other, and with what friction."""

from collections import Counter
from collections.abc import Iterator
from itertools import combinations, combinations_with_replacement, product
from xml.etree.ElementTree import Element

from importing.report import Report
from importing.shapes import Surface

PLANE, STATIC, BODY, POINTS = "plane", "static", "body", "points"
_NEVER = [{PLANE}, {PLANE, STATIC}, {STATIC}, {STATIC, POINTS}, {BODY, POINTS}, {POINTS}]

Kind = tuple[str, tuple[Surface, ...]]


class Touching:
    """The surfaces of all bodies that have a shape, by the bodies' names."""

    def __init__(self, report: Report):
        self._report = report
        self._kinds: dict[Kind, list[str]] = {}  # the bodies that touch alike
        self._roles: dict[str, str] = {}
        self._owners: dict[str, set[str]] = {}  # the bodies of the model that a body's geoms belong to

    def add(self, name: str, role: str, geoms: list[tuple[Surface, str]]) -> None:
        """Adds a body with the surface of each geom, and the name of the geom's body in the model."""
        surfaces = sorted({surface for surface, _ in geoms}, key=repr)
        self._kinds.setdefault((role, tuple(surfaces)), []).append(name)
        self._roles[name] = role
        self._owners[name] = {owner for _, owner in geoms}

    def may_meet(self, one: str, other: str) -> bool:
        """Tells whether the engine finds contacts of two bodies: points meet planes only."""
        roles = [self._roles.get(name) for name in (one, other)]
        return None not in roles and set(roles) not in _NEVER

    def friction(self) -> float:
        """Returns the friction of most pairs, or the largest of those; 0 if no two bodies touch."""
        counts: Counter[float] = Counter()
        for one, other in self._meeting():
            if found := self._frictions(one, other):
                n, m = len(self._kinds[one]), len(self._kinds[other])
                counts[_largest(found)[0]] += n * (n - 1) // 2 if one == other else n * m
        return max(counts, key=lambda friction: (counts[friction], friction), default=0.0)

    def materials(self) -> list[dict]:
        """Returns the pairs with another friction than most, and those that resist torsion or rolling."""
        usual, found = self.friction(), []
        for one, other in self._meeting():
            frictions = self._frictions(one, other)
            if len(frictions) > 1:
                self._report.leave_out("frictions of single geoms of a body, all but the largest for each pair")
            sliding, torsion, rolling = _largest(frictions) if frictions else (usual, 0.0, 0.0)
            material = {"friction": sliding} if sliding != usual else {}
            material |= {"torsional_resistance": torsion} if torsion else {}
            material |= {"rolling_resistance": rolling} if rolling else {}
            if material:
                found += [{"i": i, "j": j, **material} for i, j in self._pairs(one, other)]
        return found

    def apart(self) -> Iterator[list[str]]:
        """Returns lists of bodies whose masks keep them from touching each other."""
        for one, other in self._meeting():
            touch = [a.touches(b) for a, b in product(one[1], other[1])]
            if any(touch):
                if not all(touch):
                    self._report.leave_out("masks of single geoms of a body: contype and conaffinity")
            elif one == other:
                yield list(self._kinds[one])
            else:
                yield from map(list, self._pairs(one, other))

    def between(self, one: str, other: str, element: Element) -> Iterator[list[str]]:
        """Returns the pairs of bodies that have the geoms of two bodies of the model."""
        of_one, of_other = ([name for name, owners in self._owners.items() if owner in owners]
                            for owner in (one, other))
        for i, j in product(of_one, of_other):
            if i == j or not self.may_meet(i, j):
                continue
            if self._owners[i] == {one} and self._owners[j] == {other}:
                yield [i, j]
            else:
                self._report.leave_out("excluded contacts of single geoms of a body", element)

    def _meeting(self) -> Iterator[tuple[Kind, Kind]]:
        for one, other in combinations_with_replacement(self._kinds, 2):
            if {one[0], other[0]} not in _NEVER and (one != other or len(self._kinds[one]) > 1):
                yield one, other

    def _frictions(self, one: Kind, other: Kind) -> set[tuple[float, float, float]]:
        return {a.friction_with(b) for a, b in product(one[1], other[1]) if a.touches(b)}

    def _pairs(self, one: Kind, other: Kind) -> Iterator[tuple[str, str]]:
        bodies = self._kinds[one]
        return combinations(bodies, 2) if one == other else product(bodies, self._kinds[other])


def _largest(frictions: set[tuple[float, float, float]]) -> tuple[float, float, float]:
    sliding, torsion, rolling = (max(each) for each in zip(*frictions))
    return sliding, torsion, rolling
