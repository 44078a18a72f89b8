"""A model of MJCF as one of our scene files: see solutions/spook/SCENES.md."""

from xml.etree.ElementTree import Element

import numpy as np

from importing.shapes import Geom, friction_of, masks_of
from importing.tree import Model, ModelJoint, Part, in_axes, principal
from importing.turning import IDENTITY, from_matrix, inverse, matrix, numbers

# A link's part of the mass and inertia of what hangs on it, which has so much less. The lighter it is, the more a body
# moves as if it hung on all joints at once; and the wider S's entries differ.
_LINK = 0.01
# What matters to how things move, and has no place in a scene of ours.
_NOT_OURS = ("actuator", "tendon", "keyframe", "deformable", "extension", "contact/pair")


class SceneWriter:
    """`scene` is the file, and `left_out` what did not come into it; `instead` says what stands for what."""

    def __init__(self, root: Element, name: str):
        self.left_out: list[str] = []
        self.instead: list[str] = []
        self._model = Model(root, self.left_out)
        self._option = {key: value for each in root.findall("option") for key, value in each.attrib.items()}
        self._flags = {key: value for each in root.findall("option/flag") for key, value in each.attrib.items()}
        self._touches = self._flags.get("contact") != "disable"
        self._planes = [each for each in self._model.planes if any(masks_of(each))] if self._touches else []
        self._bodies: list[dict] = []
        self._joints: list[dict] = []
        self._part_number: dict[int, int] = {}  # by id(part)
        self._placed: list[tuple[np.ndarray, np.ndarray]] = []  # of each body: centre and turn
        self._write_world()
        for part in self._model.parts:
            self._write_part(part)
        for equality in root.findall("equality/*"):
            self._write_equality(equality)
        for path in _NOT_OURS:
            if count := len(root.findall(f"{path}/*" if "/" not in path else path)):
                self.left_out.append(f"{path}: {count}")
        self.scene = {
            "format": "spook scene", "version": 1,
            "summary": f"{root.get('model', name)}, a model in MJCF.",
            "model": "rigid", "h": float(self._of_option("timestep", 1, "0.002")[0]), "time": 5, "solver": "auto",
            "half_step_start": True,
            "settings": {"gravity": self._gravity(), "friction": self._friction()},
            "bodies": self._bodies}
        if self._joints:
            self.scene["joints"] = self._joints

    def _gravity(self) -> list[float]:
        if self._flags.get("gravity") == "disable":
            return [0.0, 0.0, 0.0]
        return _list(self._of_option("gravity", 3, "0 0 -9.81"))

    def _of_option(self, name: str, count: int, default: str):
        return numbers(Element("option", self._option), name, count, default)

    def _friction(self) -> float:
        """MJCF's is the larger of two geoms'; a scene of ours has one."""
        pairs = {max(friction_of(plane), geom.friction) for plane in self._planes
                 for part in self._model.parts for geom in part.geoms if geom.touches(masks_of(plane))}
        if len(pairs) > 1:
            self.left_out.append(f"all frictions but the largest, {max(pairs):g}")
        return max(pairs, default=0.0)

    def _add(self, body: dict, name: str, x: np.ndarray, q: np.ndarray) -> int:
        taken = {each["name"] for each in self._bodies}
        while name in taken:
            name += "'"
        self._bodies.append({"name": name} | body)
        self._placed.append((x, q))
        return len(self._bodies) - 1

    def _write_world(self) -> None:
        if not self._touches:
            self.left_out.append("all contacts: the model's option turns them off")
        for plane in self._planes:
            self._add({"plane": {"n": _list(numbers(plane, "n", 3)), "offset": float(plane.get("offset"))}},
                      plane.get("name", "plane"), np.zeros(3), IDENTITY)
            if any(numbers(plane, "size", None, "0 0")[:2] > 0):
                self._model.leave_out("edges of planes, which here have none")
        if self._touches and any(any(geom.masks) for geom in self._model.world.geoms):
            self._model.leave_out("what stands still and is no plane")
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
                self._stand_in(f"of several joints at a body all but the last lead to a link, of {_LINK:g} of its mass")
            self._join(above, below, joint.point, _held_by(joint, matrix(inverse(self._placed[above][1]))))
            above = below

    def _join(self, i: int, j: int, point: np.ndarray, held: dict) -> None:
        (x_i, q_i), (x_j, q_j) = self._placed[i], self._placed[j]
        self._joints.append({"i": self._bodies[i]["name"], "j": self._bodies[j]["name"],
                             "p_i": _list(in_axes(q_i, point - x_i)), "p_j": _list(in_axes(q_j, point - x_j))} | held)

    def _shape(self, part: Part, x: np.ndarray, q: np.ndarray) -> dict:
        """A sphere, a capsule or a box where a free body is one; else points that planes stop."""
        geoms = [geom for geom in part.geoms if any(geom.touches(masks_of(plane)) for plane in self._planes)]
        if not geoms:
            return {}
        alone = part.free and len(part.geoms) == 1 and not part.inertial
        alone = alone and not any(each.parent is part for each in self._model.parts)
        if alone and geoms[0].kind == "sphere":
            return {"radius": float(geoms[0].size[0])}
        if alone and geoms[0].kind == "capsule":
            return {"radius": float(geoms[0].size[0]), "half_length": float(geoms[0].size[1])}
        if alone and geoms[0].kind == "box":
            return {"half_sides": _list(geoms[0].size)}
        self._model.leave_out("contacts of bodies with joints, or of several geoms, with anything but planes")
        for kind in sorted({geom.kind for geom in geoms} - {"box"}):
            count = len(_points(geoms, kind))
            self._stand_in(f"{kind}s there are points on their surface, {count} each, which planes stop")
        points = np.vstack([geom.points() for geom in geoms])
        return {"corners": [_list(in_axes(q, point - x)) for point in points]}

    def _write_equality(self, equality: Element) -> None:
        whole = self._model.defaults.applied(equality, None)
        name = f"equality {whole.tag} \"{whole.get('name', '')}\""
        if whole.get("active", "true") == "false":
            return
        if whole.tag not in ("connect", "weld") or "body1" not in whole.attrib:
            self.left_out.append(name)
            return
        (one, x, q), (two, _, _) = (self._model.body(whole.get(key, "world"), name) for key in ("body1", "body2"))
        if one is two:
            return
        if "relpose" in whole.attrib and any(numbers(whole, "relpose", 7)[3:]):
            self.left_out.append(f"relpose of {name}: it holds them as they begin")
        point = x + matrix(q) @ numbers(whole, "anchor", 3, "0 0 0")
        self._join(self._number(one), self._number(two), point, {} if whole.tag == "connect" else {"kind": "weld"})

    def _number(self, part: Part) -> int:
        if id(part) not in self._part_number:  # the world, on which nothing hung so far
            fixed = {"fixed": True, "x": [0.0, 0.0, 0.0]}
            self._part_number[id(part)] = self._add(fixed, "world", np.zeros(3), IDENTITY)
        return self._part_number[id(part)]

    def _stand_in(self, what: str) -> None:
        if what not in self.instead:
            self.instead.append(what)


def _held_by(joint: ModelJoint, to_axes: np.ndarray) -> dict:
    """What a joint has beside its point. Damping is a motor that wants to stand still, with a torque for each speed."""
    if joint.kind == "ball":
        return {}
    held: dict = {"kind": "hinge" if joint.kind == "hinge" else "slider", "axis": _list(to_axes @ joint.axis)}
    if joint.limits:
        held["limits"] = {"lower": joint.limits[0], "upper": joint.limits[1]}
    if joint.damping > 0:
        held["motor"] = {"speed": 0, "viscosity": joint.damping}
    return held


def _points(geoms: list[Geom], kind: str) -> np.ndarray:
    return next(geom for geom in geoms if geom.kind == kind).points()


def _list(values: np.ndarray) -> list[float]:
    return [float(value) for value in values]
