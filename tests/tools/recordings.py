"""Invented recordings for tests of the viewer: solutions/recording/README.md has their format."""

import array
import base64
import json
import math
import sys

H = 1 / 60
_G = 9.81


def floats(*numbers: float) -> str:
    return _packed("f", numbers)


def integers(*numbers: int) -> str:
    return _packed("i", numbers)


def text(*lines: dict) -> str:
    return "".join(json.dumps(line) + "\n" for line in lines)


def header(scene: str, bodies: list[dict], **more) -> dict:
    return {"format": "spook recording", "version": 1, "scene": scene, "summary": f"A {scene} that is made up.",
            "answer": "Known, as it was made up.", "parameters": {"g": _G},
            "method": {"h": H, "substeps": 1, "solver": "gauss_seidel", "iterations": 50, "tolerance": 0,
                       "friction_model": "box", "tangents": "fixed", "row_order": "given", "warm_start": False,
                       "contact_margin": 0},
            "frame_time": H, "time": 1, "error": {"name": "largest position error", "unit": "m"},
            "columns": ["time [s]", "height [m]"], "stages": ["pairs", "rows", "solve"], "bodies": bodies} | more


def frame(step: int, x: list[float], **more) -> dict:
    time = step * H
    numbers = {"time": time, "step": step, "x": floats(*x), "v": floats(*(0 for _ in x)),
               "sample": [time, x[-1] if x else 0], "error": 1e-3 * time, "energy": {"motion": 1 - math.cos(time), "weight": math.cos(time)},
               "residual": 10 ** (-3 - time), "iterations": 50, "pairs": 1, "us": [1, 2, 10 + 5 * math.sin(9 * time)]}
    return numbers | more


def rolling_ball(frames: int = 61, speed: float = 1, side: float = 0) -> str:
    """A ball that rolls along x over a floor, with its contact, and its ghost beside it."""
    bodies = [{"shape": "plane", "n": [0, 0, 1], "offset": 0, "fixed": True}, {"shape": "ball", "radius": 0.2}]
    lines = [header("rolling_ball", bodies, parameters={"g": _G, "mu": 0.5},
                    curves=[{"name": "its height", "points": [[-0.5, 0, 0.2], [1.5, 0, 0.2]]}])]
    for step in range(frames):
        x = speed * step * H
        angle = x / 0.2
        contacts = {"between": integers(0, 1), "contacts": floats(x, side, 0, 0, 0, 1, -1e-4, 0.03, 0.01, _G * H)}
        lines.append(frame(step, [0, 0, 0, x, side, 0.2], q=floats(1, 0, 0, 0, *_about(1, angle)),
                           v=floats(0, 0, 0, speed, 0, 0), omega=floats(0, 0, 0, 0, speed / 0.2, 0),
                           ghost_bodies=[1], ghost=floats(x, 0.3, 0.2, *_about(1, angle)),
                           **(contacts if step else {"between": "", "contacts": ""})))
    return text(*lines, {"end": "done"})


def lying_capsule(radius: float, half_length: float, frames: int = 3) -> str:
    """A capsule on a floor, along x."""
    bodies = [{"shape": "plane", "n": [0, 0, 1], "offset": 0, "fixed": True},
              {"shape": "capsule", "radius": radius, "half_length": half_length}]
    lines = [header("capsule", bodies)]
    for step in range(frames):
        lines.append(frame(step, [0, 0, 0, 0, 0, radius], q=floats(1, 0, 0, 0, *_about(1, math.pi / 2)),
                           v=floats(0, 0, 0, 0, 0, 0), omega=floats(0, 0, 0, 0, 0, 0)))
    return text(*lines, {"end": "done"})


def lift(frames: int = 3) -> str:
    """A kinematic ball that rises by a metre in a frame, beside one that stands still."""
    bodies = [{"shape": "ball", "radius": 0.1, "fixed": True}, {"shape": "ball", "radius": 0.1, "fixed": True}]
    lines = [header("lift", bodies)]
    for step in range(frames):
        lines.append(frame(step, [0, 0, step, 1, 0, 0], q=floats(1, 0, 0, 0, 1, 0, 0, 0), v=floats(0, 0, 0, 0, 0, 0),
                           omega=floats(0, 0, 0, 0, 0, 0)))
    return text(*lines, {"end": "done"})


def hanging_wire(links: int = 12, frames: int = 61, amplitude: float = 0.5) -> str:
    """Point masses on rods that swing together; the tension decreases from the top to the end."""
    bodies = [{"shape": "point", "fixed": True}, *({"shape": "point"} for _ in range(links))]
    joints = [{"kind": "distance", "i": k, "j": k + 1, "p_i": [0, 0, 0], "p_j": [0, 0, 0], "length": 1 / links}
              for k in range(links)]
    lines = [header("wire", bodies, joints=joints, frame_time=H)]
    for step in range(frames):
        angle = amplitude * math.cos(3 * step * H)
        x = [c for k in range(links + 1) for c in (k / links * math.sin(angle), 0, 1 - k / links * math.cos(angle))]
        tension = floats(*(-(links - k) * _G * H for k in range(links)))
        lines.append(frame(step, x, **({"joint_impulses": tension} if step else {})))
    return text(*lines, {"end": "done"})


def tower(boxes: int = 5, frames: int = 61, lean: float = 0.2) -> str:
    """Cubes on top of each other between two walls; the top slides away."""
    bodies = [{"shape": "plane", "n": [0, 0, 1], "offset": 0, "fixed": True},
              {"shape": "plane", "n": [1, 0, 0], "offset": -1, "fixed": True},
              *({"shape": "box", "half_sides": [0.2, 0.2, 0.2]} for _ in range(boxes))]
    lines = [header("tower", bodies, parameters={"mu": 0.5})]
    for step in range(frames):
        moved = lean * (step * H) ** 2
        x, q, between, contacts = [0] * 6, [1, 0, 0, 0] * 2, [], []
        for k in range(boxes):
            centre = moved * k / boxes
            x += [centre, 0, 0.2 + 0.4 * k]
            q += _about(2, moved * k)
            for dx, dy in ((-0.2, -0.2), (0.2, -0.2), (-0.2, 0.2), (0.2, 0.2)):
                between += [k + 1 if k else 0, k + 2]
                contacts += [centre + dx, dy, 0.4 * k, 0, 0, 1, -1e-4, 0.01, 0.005, 0.04 * (boxes - k)]
        lines.append(frame(step, x, q=floats(*q), between=integers(*between), contacts=floats(*contacts)))
    return text(*lines, {"end": "done"})


def crowd(count: int = 1000, frames: int = 31) -> str:
    """Balls on a grid that move up and down."""
    side = round(count ** (1 / 3))
    bodies = [{"shape": "plane", "n": [0, 0, 1], "offset": 0, "fixed": True},
              *({"shape": "ball", "radius": 0.05} for _ in range(count))]
    lines = [header("crowd", bodies)]
    for step in range(frames):
        x, q = [0.0] * 3, [1.0, 0, 0, 0]
        for k in range(count):
            x += [0.12 * (k % side), 0.12 * (k // side % side), 0.1 + 0.13 * (k // side**2)]
            x[-1] += 0.02 * math.sin(step * H * 6 + k)
            q += _about(k % 3, step * H * 3)
        lines.append(frame(step, x, q=floats(*q)))
    return text(*lines, {"end": "done"})


def empty_scene() -> str:
    return text(header("nothing", []), *(frame(step, []) for step in range(5)), {"end": "done"})


def _about(axis: int, angle: float) -> list[float]:
    """The unit quaternion of a rotation about an axis of the world."""
    return [math.cos(angle / 2), *(math.sin(angle / 2) if axis == k else 0 for k in range(3))]


def _packed(kind: str, numbers) -> str:
    values = array.array(kind, numbers)
    if sys.byteorder == "big":
        values.byteswap()
    return base64.b64encode(values.tobytes()).decode()
