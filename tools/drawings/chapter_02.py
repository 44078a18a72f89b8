"""Chapter 02: the rotation by q, a step of it, and the rotations of the splitting."""

import math

import numpy as np

from pen import Drawing, View, between, turned

_NAMES = ("$e_1$", "$e_2$", "$e_3$")
_COLOURS = ("impulse", "good", "velocity")


def what_q_does() -> Drawing:
    d = Drawing(300, "The quaternion takes a point from the body's axes to the axes of the world")
    half = np.array([0.7, 1.0, 0.45])
    point = np.array([0.7, -1.0, 0.45])
    turn = _about((0, 0, 1), math.radians(-24)) @ _about((1, 0, 0), math.radians(-20))
    for left, low, orientation, title in ((165, 172, np.eye(3), "in the body's axes"),
                                          (540, 162, turn, "in the world's axes")):
        view = View((left, low), 72, 36, 26)
        world = orientation is turn
        if world:
            for axis, name in zip(np.eye(3), ("$x$", "$y$", "$z$")):
                d.arrow(view(0, 0, 0), view(*1.75 * axis), "soft thin dash")
                d.text(view(*1.95 * axis), name, "soft")
        _cuboid(d, view, orientation, half)
        for k in range(3):
            axis = orientation[:, k]
            d.arrow(view(0, 0, 0), view(*1.55 * axis), f"{_COLOURS[k]}")
            d.text(_beyond(view(0, 0, 0), view(*1.55 * axis), 15), _NAMES[k], _COLOURS[k])
        corner = orientation @ point
        d.line(view(0, 0, 0), view(*corner), "ink dots")
        d.dot(view(*corner), "ink", 6)
        at = _beyond(view(0, 0, 0), view(*corner), 18)
        d.text((at[0] - 2, at[1] - 4), "$x_{world}$" if world else "$x_{body}$", "ink", "end")
        d.text((left, 286), title, "soft")
    d.arrow((306, 118), (392, 118), "ink bold")
    d.text((349, 106), "$q$", "ink", size="large")
    d.text((349, 146), "$q x q^∗$", "ink")
    return d


def _about(axis, angle: float) -> np.ndarray:
    e = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -e[2], e[1]], [e[2], 0, -e[0]], [-e[1], e[0], 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def _beyond(start, end, by: float):
    length = math.dist(start, end)
    return end[0] + by * (end[0] - start[0]) / length, end[1] + by * (end[1] - start[1]) / length + 5


def _cuboid(d: Drawing, view: View, orientation: np.ndarray, half: np.ndarray) -> None:
    """Draws the three visible faces."""
    for k in range(3):
        side = 1 if view.depth(*orientation[:, k]) > 0 else -1
        a, b = (k + 1) % 3, (k + 2) % 3
        corners = []
        for s, t in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
            local = np.zeros(3)
            local[k], local[a], local[b] = side * half[k], s * half[a], t * half[b]
            corners.append(view(*(orientation @ local)))
        d.path(corners, "body fill", closed=True)


def back_to_length_one() -> Drawing:
    """A step of (2.4) with h|ω|/2 = 0.62."""
    d = Drawing(300, "The first-order step leaves the sphere of unit quaternions along its tangent and comes back")
    centre, radius, step = (110, 268), 225, 0.62
    d.arc(centre, radius, -2, 84, "faint bold")
    start = 6
    q = turned(centre, radius, start)
    direction = start + 90
    tip = turned(q, radius * step, direction)
    angle = math.degrees(math.atan(step))
    back = turned(centre, radius, start + angle)
    d.line(centre, tip, "soft thin dash")
    d.line(centre, q, "ink")
    d.arrow(q, tip, "velocity bold")
    d.arrow(between(tip, back, 0.06), back, "impulse")
    d.arc(centre, 78, start, start + angle, "ink", arrow=True)
    d.dot(centre, "ink")
    d.dot(q, "ink", 6)
    d.dot(back, "good", 6)
    d.dot(tip, "velocity", 5)
    d.text((q[0] + 14, q[1] + 8), "$q_k$", "ink", "start")
    d.text((back[0] - 16, back[1] - 8), "$q_{k+1}$", "good", "end")
    d.text((tip[0] + 12, tip[1] + 2), "$q_k + (h/2) ω q_k$", "velocity", "start")
    d.text((between(q, tip)[0] + 12, between(q, tip)[1] + 8), "length $h|ω|/2$", "velocity", "start", "small")
    d.text(between(centre, q, 0.55)[:1] + (between(centre, q, 0.55)[1] + 24,), "length 1", "ink", size="small")
    d.text(turned(centre, 104, start + angle / 2 - 1), "$α$", "ink")
    d.text((470, 120), "A right triangle:", "ink", "start")
    d.text((470, 148), "$tan α = h|ω|/2$", "ink", "start")
    d.text((470, 194), "The body turns by twice $α$,\nfor $q$ acts from both sides:", "ink", "start")
    d.text((470, 246), "$2 arctan(h|ω|/2)$", "ink", "start")
    return d


def splitting() -> Drawing:
    """One long step of (2.11) for moments 1, 2, 3, as L moves in the body's axes."""
    d = Drawing(372, "Five turns about body axes carry L along circles, near the path that it takes in truth")
    moments, step = np.array([1.0, 2.0, 3.0]), 2.6
    view = View((205, 205), 140, 42, 30)
    L = np.array([0.52, 0.30, 0.80])
    L /= np.linalg.norm(L)
    d.circle(view(0, 0, 0), 140, "faint fill")
    for axis, name in zip(np.eye(3), _NAMES):
        d.line(view(0, 0, 0), view(*axis), "faint thin")
        d.arrow(view(*axis), view(*1.28 * axis), "soft")
        d.text(_beyond(view(0, 0, 0), view(*1.28 * axis), 14), name, "soft")
    d.path([view(*p) for p in _truth(L, moments, step)], "ink bold")
    order = ((0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5))
    at = L
    for axis, part in order:
        angle = -part * step * at[axis] / moments[axis]
        d.path([view(*(_about(np.eye(3)[axis], angle * k / 20) @ at)) for k in range(21)], f"{_COLOURS[axis]}")
        at = _about(np.eye(3)[axis], angle) @ at
        d.dot(view(*at), _COLOURS[axis], 4)
    d.dot(view(*L), "ink", 6)
    first = view(*L)
    d.text((first[0] - 10, first[1] + 22), "$L$ now", "ink", "end")
    left, top, width = 425, 92, 66
    d.text((left, 40), "A step of $h$ is five turns,", "ink", "start")
    d.text((left, 62), "each about one body axis:", "ink", "start")
    x = left
    for axis, part in order:
        wide = width * part
        d.box((x, top), wide * 1.2, 44, f"{_COLOURS[axis]} fill")
        d.text((x + wide * 0.6, top + 28), f"${axis + 1}$", _COLOURS[axis])
        d.text((x + wide * 0.6, top + 66), "$h$" if part == 1 else "$h/2$", "soft", size="small")
        x += wide * 1.2
    d.text((left, 200), "A turn about $e_c$ moves $L$, as the\nbody sees it, on a circle around $e_c$.", "ink", "start",
           "small")
    d.text((left, 258), "the bold line: the path in truth", "ink", "start", "small")
    d.text((left, 280), "The same way there and back: what\nthe first half leaves out, the second\nputs in again.",
           "soft", "start", "small")
    return d


def _truth(L: np.ndarray, moments: np.ndarray, time: float) -> list[np.ndarray]:
    """Integrates dL/dt = L × ω in body axes, by small Runge-Kutta steps."""
    def rate(at):
        return np.cross(at, at / moments)

    path, h = [L], time / 60
    for _ in range(60):
        at = path[-1]
        a = rate(at)
        b = rate(at + h / 2 * a)
        c = rate(at + h / 2 * b)
        path.append(at + h / 6 * (a + 2 * b + 2 * c + rate(at + h * c)))
    return path
