"""The bodies of an MJCF model: geoms that move as one, their masses, and their joints.

A body without joints is part of its parent. A body with several joints hangs on its parent by as many: in the engine
there is a light link between two of them.
"""

from dataclasses import dataclass, field
from xml.etree.ElementTree import Element

import numpy as np

from errors import BadInput
from importing.defaults import Defaults
from importing.replicate import expand
from importing.report import Report
from importing.shapes import Geom, geom_of, surface_of
from importing.turning import IDENTITY, from_matrix, inverse, matrix, named, numbers, product, turn_of, unit


@dataclass
class ModelJoint:
    """A joint of MJCF, in its initial position."""

    kind: str  # hinge, slide or ball
    name: str
    point: np.ndarray  # in the world [m]
    axis: np.ndarray  # in the world
    limits: tuple[float, float] | None  # of angle or shift from where it begins [rad or m]
    damping: float  # [N m s/rad or N s/m]
    stiffness: float = 0.0  # [N m/rad or N/m]
    relaxed: float = 0.0  # angle or shift of the relaxed spring, from where it begins [rad or m]


@dataclass
class Part:
    """Geoms that move as one body."""

    name: str
    parent: "Part | None"  # None: it is free, or hangs on the world
    free: bool
    joints: list[ModelJoint]
    geoms: list[Geom] = field(default_factory=list)  # in the world
    # Mass, centre and inertia about it, in the world.
    inertial: list[tuple[float, np.ndarray, np.ndarray]] = field(default_factory=list)
    gravcomp: float = 0.0  # the part of its weight that is taken away
    element: Element | None = None

    def mass_and_inertia(self) -> tuple[float, np.ndarray, np.ndarray]:
        """Returns mass, centre [m] and inertia about it, in the world's axes [kg m²]. Raises BadInput for what no body
        has."""
        body = named(self.element) if self.element is not None and self.element.get("name") else f"body \"{self.name}\""
        masses = list(self.inertial)
        masses += [(geom.mass, geom.x, geom.R @ np.diag(geom.moments) @ geom.R.T) for geom in self.geoms]
        mass = sum(m for m, _, _ in masses)
        if not mass > 0:
            raise BadInput(f"{body} moves, but has no mass: give it an inertial, or a geom that is no mesh")
        centre = sum(m * x for m, x, _ in masses) / mass
        inertia = sum(I + m * ((x - centre) @ (x - centre) * np.eye(3) - np.outer(x - centre, x - centre))
                      for m, x, I in masses)
        moments = np.linalg.eigvalsh(inertia)  # in order; each is a sum over two of three squares
        if not (moments[0] > 0 and moments[2] <= (moments[0] + moments[1]) * (1 + 1e-9)):
            raise BadInput(f"inertia of {body} must have positive principal moments, none larger than the sum of the other "
                           f"two, but has {', '.join(f'{moment:g}' for moment in moments)} kg m²")
        return mass, centre, inertia


class Model:
    def __init__(self, root: Element, report: Report, limits: bool = True, damping: bool = True, springs: bool = True):
        """`limits`, `damping` and `springs` say if joints have any: the options of a model may turn them off."""
        self.report, self._has_limits = report, limits
        self._has_damping, self._has_springs = damping, springs
        self.defaults = Defaults(root)
        compiler = {key: value for each in root.findall("compiler") for key, value in each.attrib.items()}
        self.in_degrees = compiler.get("angle", "degree") == "degree"
        self.euler_order = compiler.get("eulerseq", "xyz")
        self._from_geoms = compiler.get("inertiafromgeom", "auto")
        self._autolimits = compiler.get("autolimits", "true") == "true"
        if compiler.get("coordinate", "local") != "local":
            raise BadInput("coordinate=\"global\" is no longer part of MJCF: load and save the model with MuJoCo "
                           "2.3.3 or older first")
        whole = Element("compiler", compiler)
        for name in ("settotalmass", "boundmass", "boundinertia"):
            if numbers(whole, name, 1, "-1")[0] > 0:
                report.leave_out(f"compiler {name}", whole)
        expand(root, self.in_degrees, self.euler_order)
        self.world = Part("world", None, False, [])
        self._owner = "world"  # the body whose geoms are read
        self.planes: list[Element] = []  # each with its place, and its body as "owner"
        self.parts: list[Part] = []
        # Of each body the part that it belongs to, and its own place and turn.
        self.bodies: dict[str, tuple[Part, np.ndarray, np.ndarray]] = {"world": (self.world, np.zeros(3), IDENTITY)}
        for world in root.findall("worldbody"):
            self._read(world, self.world, np.zeros(3), IDENTITY, None)

    def _read(self, body: Element, part: Part, x: np.ndarray, q: np.ndarray, childclass: str | None) -> None:
        """Reads the content of a body at x, turned by q. Geoms join the part; bodies are parts of their own or join
        this one."""
        R = matrix(q)
        self._take_masses(body, part, x, q, childclass)
        for child in body:
            if child.tag == "frame":
                self._read(child, part, x + R @ numbers(child, "pos", 3, "0 0 0"),
                           product(q, turn_of(child, self.in_degrees, self.euler_order)),
                           child.get("childclass", childclass))
            elif child.tag == "body":
                at = x + R @ numbers(child, "pos", 3, "0 0 0")
                turned = product(q, turn_of(child, self.in_degrees, self.euler_order))
                self._read_body(child, part, at, turned, child.get("childclass", childclass))
            elif child.tag in ("composite", "flexcomp", "attach"):
                self.report.leave_out(f"{child.tag} \"{child.get('name', child.get('prefix', ''))}\"", child)

    def _read_body(self, body: Element, parent: Part, x: np.ndarray, q: np.ndarray, childclass: str | None) -> None:
        joints = [self.defaults.applied(joint, childclass) for joint in body.findall("joint")]
        if body.get("mocap", "false") == "true":
            self.report.stand_in("a mocap body is static, as nothing moves it", body)
        free = body.find("freejoint") is not None or any(joint.get("type") == "free" for joint in joints)
        name = body.get("name") or f"body {len(self.parts) + 1}"
        part = parent
        if joints or free:
            above = None if free or parent is self.world else parent
            part = Part(name, above, free, [] if free else [self._joint(each, x, q) for each in joints],
                        gravcomp=float(numbers(body, "gravcomp", 1, "0")[0]), element=body)
            self.parts.append(part)
        elif parent is not self.world and numbers(body, "gravcomp", 1, "0")[0] != 0:
            self.report.leave_out("gravcomp of a body that moves with its parent", body)
        self.bodies[name] = part, x, q
        outer, self._owner = self._owner, name
        self._read(body, part, x, q, childclass)
        self._owner = outer

    def _joint(self, joint: Element, x: np.ndarray, q: np.ndarray) -> ModelJoint:
        kind, name = joint.get("type", "hinge"), joint.get("name", "without a name")
        if kind not in ("hinge", "slide", "ball"):
            raise BadInput(f"joint \"{name}\" must be a hinge, slide, ball or free joint, but is \"{kind}\"")
        for key in ("frictionloss", "armature"):
            if numbers(joint, key, None, "0")[0] != 0:
                self.report.leave_out(f"{key} of joints", joint)
        damping = numbers(joint, "damping", None, "0")[0] if self._has_damping else 0.0
        stiffness = numbers(joint, "stiffness", None, "0")[0] if self._has_springs else 0.0
        if kind == "ball":
            for name_of, value in (("damping", damping), ("stiffness", stiffness)):
                if value != 0:
                    self.report.leave_out(f"{name_of} of ball joints", joint)
        elif stiffness < 0:
            self.report.leave_out("stiffness below 0", joint)
        return ModelJoint(kind, name, x + matrix(q) @ numbers(joint, "pos", 3, "0 0 0"),
                          matrix(q) @ unit(numbers(joint, "axis", 3, "0 0 1"), f"axis of {named(joint)}"),
                          self._limits(joint, kind), float(damping),
                          float(stiffness), 0.0 if kind == "ball" else self._from_start(joint, kind, "springref", 1)[0])

    def _limits(self, joint: Element, kind: str) -> tuple[float, float] | None:
        limited = joint.get("limited", "auto")
        if limited == "auto":
            limited = "true" if self._autolimits and "range" in joint.attrib else "false"
        if limited != "true" or not self._has_limits:
            return None
        if kind == "ball":
            self.report.leave_out("limits of ball joints", joint)
            return None
        lower, upper = self._from_start(joint, kind, "range", 2)
        if not lower < upper:
            raise BadInput(f"range of {named(joint)} must have the lower bound first, but is \"{joint.get('range')}\"")
        if not lower <= 0 <= upper:
            self.report.stand_in("a joint begins outside its limits: the first steps push it back", joint)
        return float(lower), float(upper)

    def _from_start(self, joint: Element, kind: str, key: str, count: int) -> np.ndarray:
        """Angles or shifts of the joint, from where it begins, which MJCF calls `ref` [rad or m]."""
        per_unit = np.pi / 180 if kind == "hinge" and self.in_degrees else 1
        return (numbers(joint, key, count, "0" if count == 1 else None) - numbers(joint, "ref", 1, "0")) * per_unit

    def _take_masses(self, body: Element, part: Part, x: np.ndarray, q: np.ndarray, childclass: str | None) -> None:
        R = matrix(q)
        inertial = body.find("inertial")
        given = inertial is not None and self._from_geoms != "true"
        if given:
            part.inertial.append(self._inertial(inertial, x, q))
        for element in body.findall("geom"):
            whole = self.defaults.applied(element, childclass)
            kind = whole.get("type", "sphere")
            geom = geom_of(whole, self.in_degrees, self.euler_order)
            if geom is not None:
                if given:
                    geom.mass, geom.moments = 0.0, np.zeros(3)
                geom.owner = self._owner
                part.geoms.append(geom.moved(x, R))
            elif kind == "plane" and part is self.world:
                self.planes.append(self._placed(whole, x, q))
            else:
                self.report.leave_out(f"geom \"{whole.get('name', '')}\" of type {kind}: its shape and its mass",
                                      whole)

    def _inertial(self, inertial: Element, x: np.ndarray, q: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
        R = matrix(product(q, turn_of(inertial, self.in_degrees, self.euler_order)))
        if "fullinertia" in inertial.attrib:
            xx, yy, zz, xy, xz, yz = numbers(inertial, "fullinertia", 6)
            own = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        else:
            own = np.diag(numbers(inertial, "diaginertia", 3))
        mass = numbers(inertial, "mass", 1)[0]
        if mass < 0:
            raise BadInput(f"mass of {named(inertial)} must be at least 0, but is \"{inertial.get('mass')}\"")
        return mass, x + matrix(q) @ numbers(inertial, "pos", 3), R @ own @ R.T

    def _placed(self, plane: Element, x: np.ndarray, q: np.ndarray) -> Element:
        """A plane with its place in the world."""
        R = matrix(product(q, turn_of(plane, self.in_degrees, self.euler_order)))
        at = x + matrix(q) @ numbers(plane, "pos", 3, "0 0 0")
        placed = Element("plane", plane.attrib)
        placed.set("n", " ".join(map(repr, map(float, R[:, 2]))))
        placed.set("offset", repr(float(R[:, 2] @ at)))
        placed.set("owner", self._owner)
        return placed

    def body(self, name: str, who: str) -> tuple[Part, np.ndarray, np.ndarray]:
        """Returns a body's part, position and orientation."""
        if name not in self.bodies:
            raise BadInput(f"{who} names a body that there is not: \"{name}\"")
        return self.bodies[name]


def principal(inertia: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the principal moments, and the rotation from their axes to the world's."""
    moments, axes = np.linalg.eigh(inertia)
    if np.linalg.det(axes) < 0:
        axes[:, 0] *= -1
    return moments, from_matrix(axes)


def in_axes(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Returns a world vector in the axes of a body that is turned by q."""
    return matrix(inverse(q)) @ v
