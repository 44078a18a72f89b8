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


def momentum_and_spin() -> Drawing:
    """A free top, moments 1, 2, 3, at four times: L = (0, 0, 1) stays, and ω = I⁻¹L turns, with ω·L constant."""
    d = Drawing(342, "The angular momentum L stays where it is, while the angular velocity turns around it")
    moments, L = np.array([1.0, 2.0, 3.0]), np.array([0.0, 0.0, 1.0])
    q = _about((1, 0.3, 0), math.radians(52))
    path, frames, h = [], [], 0.01
    for k in range(1001):
        spin = q @ ((q.T @ L) / moments)
        path.append(spin)
        if k in (0, 250, 500, 750):
            frames.append((q.copy(), spin))
        half = _about(spin, h / 2 * np.linalg.norm(spin)) @ q  # the midpoint rule
        spin = half @ ((half.T @ L) / moments)
        q = _about(spin, h * np.linalg.norm(spin)) @ q
    half = 0.34 * np.array([1.25, 1.0, 0.5])  # longest along the axis of the least moment
    for k, (orientation, spin) in enumerate(frames):
        view = View((95 + 176 * k, 228), 92, 24, 20)
        _cuboid(d, view, orientation, half)
        d.path([view(*(2.0 * p)) for p in path[::8]], "velocity thin")
        d.arrow(view(0, 0, 0), view(0, 0, 1.55), "impulse bold")
        d.arrow(view(0, 0, 0), view(*(2.0 * spin)), "velocity bold")
        d.text((view(0, 0, 1.55)[0] - 12, view(0, 0, 1.55)[1] + 8), "$L$", "impulse", "end")
        tip = view(*(2.0 * spin))
        side = 1 if tip[0] > view(0, 0, 0)[0] else -1
        d.text((tip[0] + 14 * side, tip[1] - 6), "$ω$", "velocity", "start" if side > 0 else "end")
        d.text((95 + 176 * k, 318), f"$t = {2.5 * k:g}$ s" if k else "$t = 0$", "soft", size="small")
    d.text((360, 30), "no torque: $L$ is constant, and $ω = I^{−1}L$ turns with the body", "ink")
    return d


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
    """One long step of (2.11) for moments 1, 2, 3, as L moves in the body's axes; on the right the patch, enlarged."""
    d = Drawing(400, "Five turns about body axes carry L along circles, and end near the true path's end")
    moments, step = np.array([1.0, 2.0, 3.0]), 2.6
    L = np.array([0.52, 0.30, 0.80])
    L /= np.linalg.norm(L)
    truth = _truth(L, moments, step)
    globe = View((130, 150), 92, 42, 30)
    d.circle(globe(0, 0, 0), 92, "faint fill")
    for axis, name in zip(np.eye(3), _NAMES):
        d.line(globe(0, 0, 0), globe(*axis), "faint thin")
        d.arrow(globe(*axis), globe(*1.28 * axis), "soft")
        d.text(_beyond(globe(0, 0, 0), globe(*1.28 * axis), 14), name, "soft")
    d.path([globe(*p) for p in truth], "ink bold")

    shown = View((0, 0), 510, 42, 30)
    arcs, at = [], L
    order = ((0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5))
    for axis, part in order:
        angle = -part * step * at[axis] / moments[axis]
        arcs.append([shown(*(_about(np.eye(3)[axis], angle * k / 20) @ at)) for k in range(21)])
        at = _about(np.eye(3)[axis], angle) @ at
    xs, ys = zip(*(p for arc in arcs for p in arc))
    shift = 486 - (min(xs) + max(xs)) / 2, 178 - (min(ys) + max(ys)) / 2

    def moved(p):
        return p[0] + shift[0], p[1] + shift[1]

    d.circle((486, 178), 168, "faint")
    middle = globe(*truth[len(truth) // 2])
    d.circle(middle, 34, "soft thin")
    d.line((middle[0] + 14, middle[1] - 31), (434, 18), "faint thin")
    d.line((middle[0] + 14, middle[1] + 31), (434, 338), "faint thin")
    d.path([moved(shown(*p)) for p in truth], "ink bold")
    for k, ((axis, _), arc) in enumerate(zip(order, arcs)):
        d.path([moved(p) for p in arc], _COLOURS[axis])
        d.dot(moved(arc[-1]), _COLOURS[axis], 5)
        (x, y), (left, top) = moved(arc[10]), moved(arc[9])
        length = math.hypot(x - left, y - top)
        side = 15 if k in (0, 1, 3) else -15
        d.text((x - side * (y - top) / length, y + side * (x - left) / length + 5), str(k + 1), _COLOURS[axis])
    start, end = moved(shown(*L)), moved(shown(*truth[-1]))
    d.dot(start, "ink", 6)
    d.text((start[0] - 12, start[1] - 8), "$L$ now", "ink", "end", "small")
    d.dot(end, "ink", 5)
    d.text((end[0] + 10, end[1] + 20), "$L$ after $h$", "ink", "start", "small")
    x = 40
    for k, (axis, part) in enumerate(order):
        wide = 76 * part
        d.box((x, 296), wide, 40, f"{_COLOURS[axis]} fill")
        d.text((x + wide / 2, 322), f"${k + 1}$", _COLOURS[axis])
        d.text((x + wide / 2, 354), "$h$" if part == 1 else "$h/2$", "soft", size="small")
        d.text((x + wide / 2, 376), f"$e_{axis + 1}$", _COLOURS[axis], size="small")
        x += wide
    d.text((486, 376), "bold: the true path; a turn about $e_c$ moves $L$ on a circle around $e_c$", "soft",
           size="small")
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
