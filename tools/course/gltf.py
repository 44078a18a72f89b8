"""Converts a recording to glTF 2.0, which Blender and many viewers read: moving bodies and rods, without contacts and
answer."""

import base64
import json

import numpy as np

_FLOAT, _UINT32 = 5126, 5125  # glTF's numbers for them
_Z_UP_TO_Y_UP = [-0.5**0.5, 0, 0, 0.5**0.5]
_POINT = 0.01  # radius of a point mass, over the size of the scene
_ROD = 0.3  # radius of a rod, over that of a point


def gltf(recording: bytes) -> str:
    """Throws ValueError, KeyError, TypeError or IndexError for other input than a recording with frames."""
    header, *frames = (json.loads(line) for line in recording.splitlines())
    frames = [frame for frame in frames if "x" in frame]
    if not frames:
        raise ValueError("it has no frames")
    return json.dumps(_Scene(header, frames).document)


class _Scene:
    def __init__(self, header: dict, frames: list[dict]):
        self._data = bytearray()
        self.document: dict = {
            "asset": {"version": "2.0", "generator": f"spook, {header['scene']}"}, "scene": 0,
            "scenes": [{"nodes": [0]}], "nodes": [{"name": header["scene"], "rotation": _Z_UP_TO_Y_UP, "children": []}],
            "meshes": [], "accessors": [], "bufferViews": [], "buffers": [],
            "materials": [_material(0.45, 0.5, 0.56), _material(0.86, 0.86, 0.84), _material(0.7, 0.25, 0.3)],
            "animations": [{"samplers": [], "channels": []}]}
        self._x = np.stack([_crowd(frame["x"], 3) for frame in frames])
        self._q = np.stack([_crowd(frame["q"], 4) for frame in frames]) if "q" in frames[0] else None
        moving = [k for k, body in enumerate(header["bodies"]) if not body.get("fixed")]
        seen = self._x[:, moving] if moving else self._x
        self._size = float(np.linalg.norm(np.ptp(seen.reshape(-1, 3), axis=0))) or 1.0
        self._ball, self._box = self._mesh(*_sphere(), 0), self._mesh(*_cube(), 0)
        self._floor, self._rod = self._mesh(*_cube(), 1), self._mesh(*_cube(), 2)
        self._times = self._accessor(np.array([frame["time"] for frame in frames], "<f4"), "SCALAR", bounds=True)
        for k, body in enumerate(header["bodies"]):
            self._add_body(k, body)
        for joint in header.get("joints", ()):
            if joint["kind"] in ("distance", "rope"):
                self._add_rod(joint)
        self.document["buffers"] = [{"byteLength": len(self._data), "uri": "data:application/octet-stream;base64,"
                                     + base64.b64encode(self._data).decode()}]

    def _add_body(self, k: int, body: dict) -> None:
        shape, name = body["shape"], f"{body['shape']} {k}"
        if shape == "plane":
            # A flat box, its top in the plane.
            n, thick = np.array(body["n"]), 1e-3 * self._size
            self._node(name, self._floor, [self._size, self._size, thick], (body["offset"] - thick) * n,
                       _turn_z_to(n[None])[0])
        elif shape != "hand":
            mesh, scale = self._form(body)
            node = self._node(name, mesh, scale, self._x[0, k], self._turns(k)[0] if self._q is not None else None)
            # A kinematic body is fixed, and moves.
            if not body.get("fixed") or np.ptp(self._x[:, k], axis=0).any():
                self._animate(node, "translation", self._x[:, k])
            if self._q is not None and (not body.get("fixed") or np.ptp(self._q[:, k], axis=0).any()):
                self._animate(node, "rotation", self._turns(k))

    def _form(self, body: dict) -> tuple[int, list[float]]:
        if body["shape"] == "ball":
            return self._ball, [body["radius"]] * 3
        if body["shape"] == "capsule":
            return self._mesh(*_capsule(body["half_length"] / body["radius"]), 0), [body["radius"]] * 3
        if body["shape"] == "box":
            return self._box, body["half_sides"]
        if body["shape"] == "corners":  # what holds them all
            sides = np.abs(np.array(body["points"])).max(axis=0)
            return self._box, np.maximum(sides, 0.02 * sides.max()).tolist()
        return self._ball, [_POINT * self._size] * 3

    def _add_rod(self, joint: dict) -> None:
        ends = [self._x[:, joint[body]] + self._turned(joint[body], np.array(joint[point]))
                for body, point in (("i", "p_i"), ("j", "p_j"))]
        along = ends[1] - ends[0]
        lengths = np.linalg.norm(along, axis=1)
        thick = np.full_like(lengths, _ROD * _POINT * self._size)
        node = self._node(f"rod {joint['i']}-{joint['j']}", self._rod, None)
        self._animate(node, "translation", (ends[0] + ends[1]) / 2)
        self._animate(node, "rotation", _continuous(_turn_z_to(along / np.maximum(lengths, 1e-30)[:, None])))
        self._animate(node, "scale", np.stack([thick, thick, lengths / 2], axis=1))

    def _turns(self, k: int) -> np.ndarray:
        """Returns quaternions in glTF's order (x, y, z, w), each turned the shorter way from the one before."""
        return _continuous(self._q[:, k, [1, 2, 3, 0]])

    def _turned(self, body: int, point: np.ndarray) -> np.ndarray:
        if self._q is None:
            return point
        w, u = self._q[:, body, :1], self._q[:, body, 1:]
        return point + 2 * np.cross(u, np.cross(u, point) + w * point)

    def _node(self, name: str, mesh: int, scale, x=None, q=None) -> int:
        node = {"name": name, "mesh": mesh}
        for key, value in (("scale", scale), ("translation", x), ("rotation", q)):
            if value is not None:
                node[key] = [float(number) for number in value]
        nodes = self.document["nodes"]
        nodes.append(node)
        nodes[0]["children"].append(len(nodes) - 1)
        return len(nodes) - 1

    def _animate(self, node: int, path: str, values: np.ndarray) -> None:
        animation = self.document["animations"][0]
        kind = "VEC4" if path == "rotation" else "VEC3"
        animation["samplers"].append({"input": self._times, "output": self._accessor(values.astype("<f4"), kind)})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": {"node": node, "path": path}})

    def _mesh(self, points: np.ndarray, normals: np.ndarray, triangles: np.ndarray, material: int) -> int:
        attributes = {"POSITION": self._accessor(points.astype("<f4"), "VEC3", bounds=True),
                      "NORMAL": self._accessor(normals.astype("<f4"), "VEC3")}
        indices = self._accessor(triangles.astype("<u4").ravel(), "SCALAR")
        self.document["meshes"].append({"primitives": [{"attributes": attributes, "indices": indices,
                                                        "material": material}]})
        return len(self.document["meshes"]) - 1

    def _accessor(self, values: np.ndarray, kind: str, bounds: bool = False) -> int:
        views, accessors = self.document["bufferViews"], self.document["accessors"]
        views.append({"buffer": 0, "byteOffset": len(self._data), "byteLength": values.nbytes})
        self._data += values.tobytes()
        accessors.append({"bufferView": len(views) - 1, "componentType": _UINT32 if values.dtype.kind == "u" else _FLOAT,
                          "count": len(values), "type": kind})
        if bounds:
            accessors[-1] |= {"min": np.atleast_1d(values.min(axis=0)).tolist(),
                              "max": np.atleast_1d(values.max(axis=0)).tolist()}
        return len(accessors) - 1


def _crowd(text: str, width: int) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), "<f4").reshape(-1, width)


def _material(*colour: float) -> dict:
    return {"pbrMetallicRoughness": {"baseColorFactor": [*colour, 1], "metallicFactor": 0, "roughnessFactor": 0.7}}


def _continuous(q: np.ndarray) -> np.ndarray:
    signs = np.where((q[1:] * q[:-1]).sum(axis=1) < 0, -1.0, 1.0)
    return q * np.concatenate([[1.0], np.cumprod(signs)])[:, None]


def _turn_z_to(directions: np.ndarray) -> np.ndarray:
    """Returns the shortest rotation as (x, y, z, w)."""
    x, y, z = directions.T
    q = np.stack([-y, x, np.zeros_like(x), 1 + z], axis=1)
    q[q[:, 3] < 1e-9] = [1, 0, 0, 0]  # half a turn, about any axis across
    return q / np.linalg.norm(q, axis=1)[:, None]


def _sphere(across: int = 24, up: int = 12) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    theta, phi = np.meshgrid(np.linspace(0, np.pi, up + 1), np.linspace(0, 2 * np.pi, across + 1), indexing="ij")
    points = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1).reshape(-1, 3)
    row = across + 1
    first = (np.arange(up)[:, None] * row + np.arange(across)).ravel()
    triangles = np.concatenate([np.stack([first, first + row, first + 1], axis=1),
                                np.stack([first + 1, first + row, first + row + 1], axis=1)])
    return points, points, triangles


def _capsule(half_length: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns a capsule of radius 1 about the z axis: a sphere in two halves, and a cylinder between them."""
    points, normals, triangles = _sphere(up=13)  # an odd number of bands, so that no ring lies on the equator
    return points + np.sign(points[:, 2:]) * [0, 0, half_length], normals, triangles


def _cube() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    points, normals, triangles = [], [], []
    for axis in range(3):
        for side in (-1, 1):
            corners = np.array([[a, b] for a in (-1, 1) for b in (-1, 1)])
            face = np.insert(corners, axis, side, axis=1)
            first = len(points)
            points += face.tolist()
            normals += [np.eye(3)[axis] * side] * 4
            # Counterclockwise, seen from outside.
            order = [0, 2, 1, 1, 2, 3] if (side > 0) == (axis != 1) else [0, 1, 2, 1, 3, 2]
            triangles += [first + k for k in order]
    return np.array(points, float), np.array(normals, float), np.array(triangles).reshape(-1, 3)
