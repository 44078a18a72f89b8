"""Converts an MJCF model to a scene file: see solutions/spook/SCENES.md."""

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np

from errors import BadInput
from importing.known import name_unknown
from importing.report import Report
from importing.shapes import Geom, Surface, surface_of
from importing.touching import BODY, PLANE, POINTS, STATIC, Touching
from importing.tree import Model, ModelJoint, Part, in_axes, principal
from importing.turning import IDENTITY, from_matrix, inverse, matrix, numbers

# A link's part of the mass and inertia of what hangs on it, which has so much less. The lighter it is, the more a body
# moves as if it hung on all joints at once; and the wider S's entries differ.
_LINK = 0.01
# What matters to how things move, and has no place in a scene of ours.
_NOT_OURS = ("actuator", "tendon", "keyframe", "deformable", "extension", "contact/pair")
_SOLIDS = ("sphere", "capsule", "box")
_SAME = 1e-6  # of a size: the round-off of numbers in a model
_POINTS = "bodies with several geoms, a cylinder, an ellipsoid, or a centre of mass outside the geom's middle"


class SceneWriter:
    """`scene` is the file; the report gets the omitted and replaced parts."""

    def __init__(self, root: Element, name: str, report: Report):
        self._report = report
        name_unknown(root, report)
        option = {key: value for each in root.findall("option") for key, value in each.attrib.items()}
        self._option = Element("option", option)
        self._flags = {key: value for each in root.findall("option/flag") for key, value in each.attrib.items()}
        self._touches = self._has("contact") and self._has("constraint")
        self._model = Model(root, report, limits=self._has("limit") and self._has("constraint"),
                            damping=self._has("passive") and self._has("damper"),
                            springs=self._has("passive") and self._has("spring"))
        if not self._model.parts:
            raise BadInput("nothing is left to simulate: no body has a joint that the import knows")
        self._planes = [each for each in self._model.planes if self._touches and _can_touch(surface_of(each))]
        self._solids: list[Geom] = []  # static ones
        self._touching = Touching(report)
        self._bodies: list[dict] = []
        self._joints: list[dict] = []
        self._part_number: dict[int, int] = {}  # by id(part)
        self._placed: list[tuple[np.ndarray, np.ndarray]] = []  # of each body: centre and turn
        self._write_world()
        for part in self._model.parts:
            self._write_part(part)
        if self._has("equality") and self._has("constraint"):
            for equality in root.findall("equality/*"):
                self._write_equality(equality)
        for path in _NOT_OURS:
            if count := len(root.findall(f"{path}/*" if "/" not in path else path)):
                report.leave_out(f"{path}: {count}")
        self.scene = {
            "format": "spook scene", "version": 2,
            "summary": f"{root.get('model', name)}, a model in MJCF.",
            "model": "rigid", "h": float(numbers(self._option, "timestep", 1, "0.002")[0]), "time": 5, "solver": "auto",
            "half_step_start": True,
            "settings": {"gravity": self._gravity(), "friction": self._touching.friction()},
            "bodies": self._bodies}
        if self._joints:
            self.scene["joints"] = self._joints
        if materials := self._touching.materials():
            self.scene["materials"] = materials
        if apart := [*self._touching.apart(), *self._excluded(root), *self._parents()]:
            self.scene["no_contact"] = apart
        if any("corners" in body for body in self._bodies):
            self.scene["settings"]["points_pass"] = True  # it is named as left out

    def _has(self, flag: str) -> bool:
        return self._flags.get(flag, "enable") != "disable"

    def _gravity(self) -> list[float]:
        """Sets gravity. MJCF may reduce the weight of single bodies; our scenes have one gravity."""
        if not self._has("gravity"):
            return [0.0, 0.0, 0.0]
        parts = {part.gravcomp for part in self._model.parts} if self._has("passive") else {0.0}
        if len(parts) > 1:
            for part in self._model.parts:
                if part.gravcomp != 0:
                    self._report.leave_out("gravcomp of bodies, which is not the same for all", part.element)
        kept = 1 - parts.pop() if len(parts) == 1 else 1
        return [float(kept * each) for each in numbers(self._option, "gravity", 3, "0 0 -9.81")]

    def _excluded(self, root: Element) -> Iterator[list[str]]:
        """Returns the pairs of bodies, by name, whose contacts the model excludes."""
        for exclude in root.findall("contact/exclude"):
            names = [exclude.get(key, "") for key in ("body1", "body2")]
            for name in names:
                self._model.body(name, "a contact exclude")  # refuses an unknown one
            if names[0] != names[1]:
                yield from self._touching.between(*names, exclude)

    def _parents(self) -> Iterator[list[str]]:
        """Returns the pairs of a body and the one that it hangs on: they do not touch, unless a flag says otherwise."""
        if not self._has("filterparent"):
            return
        for part in self._model.parts:
            if part.parent is not None:
                pair = [self._name(self._part_number[id(each)]) for each in (part.parent, part)]
                if self._touching.may_meet(*pair):
                    yield pair

    def _add(self, body: dict, name: str, x: np.ndarray, q: np.ndarray) -> int:
        taken = {each["name"] for each in self._bodies}
        while name in taken:
            name += "'"
        self._bodies.append({"name": name} | body)
        self._placed.append((x, q))
        return len(self._bodies) - 1

    def _name(self, number: int) -> str:
        return self._bodies[number]["name"]

    def _write_world(self) -> None:
        if not self._touches:
            self._report.stand_in("no body has a shape: the model's option turns contacts off")
        for plane in self._planes:
            number = self._add({"plane": {"n": _list(numbers(plane, "n", 3)), "offset": float(plane.get("offset"))}},
                               plane.get("name", "plane"), np.zeros(3), IDENTITY)
            self._touching.add(self._name(number), PLANE, [(surface_of(plane), plane.get("owner"))])
            if any(numbers(plane, "size", None, "0 0")[:2] > 0):
                self._report.leave_out("edges of planes: planes are infinite here", plane)
        for geom in self._model.world.geoms if self._touches else []:
            if not _can_touch(geom.surface):
                continue
            if geom.kind not in _SOLIDS:
                self._report.leave_out(f"static {geom.kind}s", geom.element)
                continue
            q = from_matrix(geom.R)
            number = self._add({"fixed": True, "x": _list(geom.x), "q": _list(q)} | _shape_of(geom),
                               geom.element.get("name", f"static {geom.kind}"), geom.x, q)
            self._touching.add(self._name(number), STATIC, [(geom.surface, geom.owner)])
            self._solids.append(geom)
        if any(part.joints and part.parent is None for part in self._model.parts):
            self._number(self._model.world)

    def _write_part(self, part: Part) -> None:
        mass, x, inertia = part.mass_and_inertia()
        links = max(0, len(part.joints) - 1)
        of_link = _LINK * mass
        mass, inertia = mass * (1 - links * _LINK), inertia * (1 - links * _LINK)
        moments, q = principal(inertia)
        solid = self._solid(part, x, inertia)
        if solid is not None:
            moments, q = np.diag(solid.R.T @ inertia @ solid.R), from_matrix(solid.R)
        shape, geoms = self._shape(part, solid, x, q)
        body = {"x": _list(x), "q": _list(q), "mass": mass, "principal": _list(moments)} | shape
        number = self._part_number[id(part)] = self._add(body, part.name, x, q)
        if geoms:
            self._touching.add(self._name(number), BODY if solid else POINTS,
                               [(geom.surface, geom.owner) for geom in geoms])
        above = None if part.free else self._part_number[id(part.parent or self._model.world)]
        for k, joint in enumerate(part.joints):
            below = number
            if k < links:
                below = self._add({"x": _list(joint.point), "mass": of_link,
                                   "principal": [_LINK * float(moments.max())] * 3},
                                  f"{part.name}, link {k + 1}", joint.point, IDENTITY)
                self._report.stand_in(
                    f"bodies with several joints: a small body between the joints, of {_LINK:g} of the mass")
            self._join(above, below, joint.point, _held_by(joint, matrix(inverse(self._placed[above][1]))))
            above = below

    def _join(self, i: int, j: int, point: np.ndarray, held: dict) -> None:
        (x_i, q_i), (x_j, q_j) = self._placed[i], self._placed[j]
        self._joints.append({"i": self._bodies[i]["name"], "j": self._bodies[j]["name"],
                             "p_i": _list(in_axes(q_i, point - x_i)), "p_j": _list(in_axes(q_j, point - x_j))} | held)

    def _solid(self, part: Part, x: np.ndarray, inertia: np.ndarray) -> Geom | None:
        """Returns the sphere, capsule or box that is a part's whole shape; None if there is no such geom.

        A body of the engine has its centre of mass in the middle of its shape, and its principal axes along it.
        """
        geoms = [geom for geom in part.geoms if _can_touch(geom.surface)]
        if len(geoms) != 1 or geoms[0].kind not in _SOLIDS:
            return None
        geom, along = geoms[0], geoms[0].R.T @ inertia @ geoms[0].R
        off_axes = 0 if geom.kind == "sphere" else abs(along - np.diag(np.diag(along))).max()
        if np.linalg.norm(geom.x - x) > _SAME * geom.size.max() or off_axes > _SAME * along.max():
            return None
        return geom

    def _shape(self, part: Part, solid: Geom | None, x: np.ndarray, q: np.ndarray) -> tuple[dict, list[Geom]]:
        """Returns the shape of a part, and the geoms in it: the solid, or else points for contacts with planes."""
        if not self._touches:
            return {}, []
        planes = [surface_of(plane) for plane in self._planes]
        others = [geom.surface for other in self._model.parts if other is not part for geom in other.geoms]
        met = planes if solid is None else [*planes, *others, *(geom.surface for geom in self._solids)]
        geoms = [geom for geom in part.geoms if any(geom.surface.touches(each) for each in met)]
        if solid is None and any(geom.surface.touches(each.surface) for geom in part.geoms for each in self._solids):
            self._report.leave_out(f"contacts with static solids, of {_POINTS}", part.element)
        if not geoms:
            return {}, []
        if solid is not None:
            return _shape_of(solid), geoms
        self._report.leave_out(f"contacts with anything but planes, of {_POINTS}", part.element)
        for kind in sorted({geom.kind for geom in geoms} - {"box"}):
            count = len(_points(geoms, kind))
            self._report.stand_in(f"{kind}s in such bodies: {count} points on the surface of each, which planes stop")
        points = np.vstack([geom.points() for geom in geoms])
        return {"corners": [_list(in_axes(q, point - x)) for point in points]}, geoms

    def _write_equality(self, equality: Element) -> None:
        whole = self._model.defaults.applied(equality, None)
        name = f"equality {whole.tag}" + (f" \"{whole.get('name')}\"" if whole.get("name") else "")
        if whole.get("active", "true") == "false":
            return
        if whole.tag not in ("connect", "weld") or "body1" not in whole.attrib:
            self._report.leave_out(name, equality)
            return
        (one, x, q), (two, _, _) = (self._model.body(whole.get(key, "world"), name) for key in ("body1", "body2"))
        if one is two:
            return
        if "relpose" in whole.attrib and any(numbers(whole, "relpose", 7)[3:]):
            self._report.leave_out(f"relpose of {name}: the two bodies are held as they begin", equality)
        point = x + matrix(q) @ numbers(whole, "anchor", 3, "0 0 0")
        self._join(self._number(one), self._number(two), point, {} if whole.tag == "connect" else {"kind": "weld"})

    def _number(self, part: Part) -> int:
        if id(part) not in self._part_number:  # the world, on which nothing hung so far
            fixed = {"fixed": True, "x": [0.0, 0.0, 0.0]}
            self._part_number[id(part)] = self._add(fixed, "world", np.zeros(3), IDENTITY)
        return self._part_number[id(part)]


def _held_by(joint: ModelJoint, to_axes: np.ndarray) -> dict:
    """Returns the numbers of a joint without its point. Damping without a spring is a motor at rest, with a torque for
    each speed."""
    if joint.kind == "ball":
        return {}
    held: dict = {"kind": "hinge" if joint.kind == "hinge" else "slider", "axis": _list(to_axes @ joint.axis)}
    if joint.limits:
        held["limits"] = {"lower": joint.limits[0], "upper": joint.limits[1]}
    if joint.stiffness > 0:
        held["spring"] = {"stiffness": joint.stiffness, "damping": joint.damping, "rest": joint.relaxed}
    elif joint.damping > 0:
        held["motor"] = {"speed": 0, "viscosity": joint.damping}
    return held


def _can_touch(surface: Surface) -> bool:
    return bool(surface.contype or surface.conaffinity)


def _shape_of(geom: Geom) -> dict:
    """Writes the shape of a sphere, a capsule or a box, along its own axes."""
    if geom.kind == "box":
        return {"half_sides": _list(geom.size)}
    return {"radius": float(geom.size[0])} | ({"half_length": float(geom.size[1])} if geom.kind == "capsule" else {})


def _points(geoms: list[Geom], kind: str) -> np.ndarray:
    return next(geom for geom in geoms if geom.kind == kind).points()


def _list(values: np.ndarray) -> list[float]:
    return [float(value) for value in values]
