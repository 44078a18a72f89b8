"""Converts an MJCF model to a scene file: see solutions/spook/SCENES.md."""

from collections import Counter
from xml.etree.ElementTree import Element

import numpy as np

from errors import BadInput
from importing.known import name_unknown
from importing.report import Report
from importing.shapes import Geom, condim_of, friction_of, masks_of
from importing.tree import Model, ModelJoint, Part, in_axes, principal
from importing.turning import IDENTITY, from_matrix, inverse, matrix, numbers

# A link's part of the mass and inertia of what hangs on it, which has so much less. The lighter it is, the more a body
# moves as if it hung on all joints at once; and the wider S's entries differ.
_LINK = 0.01
# What matters to how things move, and has no place in a scene of ours.
_NOT_OURS = ("actuator", "tendon", "keyframe", "deformable", "extension", "contact/pair")


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
        self._planes = [each for each in self._model.planes if any(masks_of(each))] if self._touches else []
        self._solids: list[Geom] = []  # static ones
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
            "settings": {"gravity": self._gravity(), "friction": self._friction()},
            "bodies": self._bodies}
        if self._joints:
            self.scene["joints"] = self._joints
        if excluded := self._excluded(root):
            self.scene["no_contact"] = excluded
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

    def _friction(self) -> float:
        """Sets friction. MJCF's is the larger of two geoms', and none where both have condim 1; our scenes have one
        value."""
        below = [(masks_of(plane), friction_of(plane), condim_of(plane)) for plane in self._planes]
        below += [(solid.masks, solid.friction, solid.condim) for solid in self._solids]
        pairs = {max(friction, geom.friction) if max(condim, geom.condim) > 1 else 0.0
                 for masks, friction, condim in below
                 for part in self._model.parts for geom in part.geoms if geom.touches(masks)}
        pairs |= self._frictions_between_bodies()
        if len(pairs) > 1:
            self._report.leave_out(f"all frictions but the largest, {max(pairs):g}")
        return max(pairs, default=0.0)

    def _frictions_between_bodies(self) -> set[float]:
        """Returns the frictions of pairs of free bodies that may touch."""
        solids = [part.geoms[0] for part in self._model.parts if self._touches and self._is_solid(part)]
        kinds = Counter((geom.masks, geom.friction, geom.condim) for geom in solids)
        return {max(one[1], other[1]) if max(one[2], other[2]) > 1 else 0.0
                for one in kinds for other in kinds if one != other or kinds[one] > 1
                if one[0][0] & other[0][1] or other[0][0] & one[0][1]}

    def _excluded(self, root: Element) -> list[list[str]]:
        """Pairs of free bodies, by name, whose contacts are excluded; others meet no other body here."""
        pairs = []
        for exclude in root.findall("contact/exclude"):
            parts = [self._model.body(exclude.get(key, ""), "a contact exclude")[0] for key in ("body1", "body2")]
            if parts[0] is parts[1]:
                continue
            if all(self._is_solid(part) for part in parts):
                pairs.append([self._bodies[self._part_number[id(part)]]["name"] for part in parts])
            elif self._model.world in parts and any(self._is_solid(part) for part in parts):
                self._report.leave_out("excluded contacts with static bodies", exclude)
        return pairs

    def _add(self, body: dict, name: str, x: np.ndarray, q: np.ndarray) -> int:
        taken = {each["name"] for each in self._bodies}
        while name in taken:
            name += "'"
        self._bodies.append({"name": name} | body)
        self._placed.append((x, q))
        return len(self._bodies) - 1

    def _write_world(self) -> None:
        if not self._touches:
            self._report.stand_in("no body has a shape: the model's option turns contacts off")
        for plane in self._planes:
            self._add({"plane": {"n": _list(numbers(plane, "n", 3)), "offset": float(plane.get("offset"))}},
                      plane.get("name", "plane"), np.zeros(3), IDENTITY)
            if any(numbers(plane, "size", None, "0 0")[:2] > 0):
                self._report.leave_out("edges of planes: planes are infinite here", plane)
        for geom in self._model.world.geoms if self._touches else []:
            if not any(geom.masks):
                continue
            if geom.kind not in ("sphere", "capsule", "box"):
                self._report.leave_out(f"static {geom.kind}s", geom.element)
                continue
            q = from_matrix(geom.R)
            self._add({"fixed": True, "x": _list(geom.x), "q": _list(q)} | _shape_of(geom),
                      geom.element.get("name", f"static {geom.kind}"), geom.x, q)
            self._solids.append(geom)
        if any(part.joints and part.parent is None for part in self._model.parts):
            self._number(self._model.world)

    def _write_part(self, part: Part) -> None:
        mass, x, inertia = part.mass_and_inertia()
        links = max(0, len(part.joints) - 1)
        of_link = _LINK * mass
        mass, inertia = mass * (1 - links * _LINK), inertia * (1 - links * _LINK)
        moments, q = principal(inertia)
        shape = self._shape(part, x, q)
        if "half_sides" in shape or "half_length" in shape:  # along the geom's own axes
            moments, q = part.geoms[0].moments, from_matrix(part.geoms[0].R)
        body = {"x": _list(x), "q": _list(q), "mass": mass, "principal": _list(moments)} | shape
        number = self._part_number[id(part)] = self._add(body, part.name, x, q)
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

    def _is_solid(self, part: Part) -> bool:
        """Tells whether a part is a free body of one sphere, capsule or box."""
        alone = part.free and len(part.geoms) == 1 and not part.inertial
        return alone and part.geoms[0].kind in ("sphere", "capsule", "box") and not any(
            each.parent is part for each in self._model.parts)

    def _shape(self, part: Part, x: np.ndarray, q: np.ndarray) -> dict:
        """Writes a sphere, a capsule or a box for such a free body; else points for contacts with planes."""
        if not self._touches:
            return {}
        masks = [masks_of(plane) for plane in self._planes]
        solid = self._is_solid(part)
        if solid:
            masks += [geom.masks for geom in self._solids]
            masks += [geom.masks for other in self._model.parts if other is not part for geom in other.geoms]
        geoms = [geom for geom in part.geoms if any(geom.touches(each) for each in masks)]
        if not solid and any(geom.touches(each.masks) for geom in part.geoms for each in self._solids):
            self._report.leave_out("contacts of bodies with joints, or of several geoms, with static solids",
                                   part.element)
        if not geoms:
            return {}
        if solid:
            return _shape_of(geoms[0])
        self._report.leave_out("contacts of bodies with joints, or of several geoms, with anything but planes")
        for kind in sorted({geom.kind for geom in geoms} - {"box"}):
            count = len(_points(geoms, kind))
            self._report.stand_in(f"{kind}s in such bodies: {count} points on the surface of each, which planes stop")
        points = np.vstack([geom.points() for geom in geoms])
        return {"corners": [_list(in_axes(q, point - x)) for point in points]}

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
    """What a joint has beside its point. Damping without a spring is a motor at rest, with a torque for each speed."""
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


def _shape_of(geom: Geom) -> dict:
    """Writes the shape of a sphere, a capsule or a box, along its own axes."""
    if geom.kind == "box":
        return {"half_sides": _list(geom.size)}
    return {"radius": float(geom.size[0])} | ({"half_length": float(geom.size[1])} if geom.kind == "capsule" else {})


def _points(geoms: list[Geom], kind: str) -> np.ndarray:
    return next(geom for geom in geoms if geom.kind == kind).points()


def _list(values: np.ndarray) -> list[float]:
    return [float(value) for value in values]
