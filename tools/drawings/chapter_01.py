"""Chapter 01: velocities between positions, and their effect on a mass on a spring."""

import math

from pen import Drawing, Frame, turned


def half_steps() -> Drawing:
    d = Drawing(300, "Positions at whole steps, velocities at half steps; each leaps over the other")
    f = Frame((170, 0), 150)
    up, down = 120, 200

    def x(t: float, y: float = up):
        return f(t, 0)[0], y

    d.arrow((40, 262), (690, 262), "soft thin")
    d.text((690, 286), "$t$", "soft", "end")
    for n in range(4):
        d.line(x(n, 256), x(n, 268), "soft thin")
        d.text(x(n, 286), ("$0$", "$h$", "$2h$", "$3h$")[n], "soft")
        d.line(x(n, up + 8), x(n, 250), "faint thin dash")
        d.dot(x(n), "ink", 7)
        d.text((x(n)[0] - 4, up + 33), f"$x_{n}$", "ink", "end")
    for n in range(4):
        d.line(x(n - 0.5, down + 8), x(n - 0.5, 256), "faint thin dash")
        d.dot(x(n - 0.5, down), "velocity", 7)
    for n in range(3):
        middle, _ = x(n + 0.5)
        d.path([(middle + 62 * math.cos(a), up - 10 - 46 * math.sin(a)) for a in _arc(math.pi, 0.2)], "ink")
        d.arrow((middle + 60, up - 22), (middle + 65, up - 9), "ink")
        d.text((middle, up - 64), f"drift with $v_{{{_half(n)}}}$", "ink", size="small")
    for n in range(3):
        middle, _ = x(n)
        d.path([(middle + 62 * math.cos(a), down + 10 + 30 * math.sin(a)) for a in _arc(math.pi, 0.25)], "velocity")
        d.arrow((middle + 59, down + 20), (middle + 65, down + 9), "velocity")
        d.text((middle + 6, down - 4), f"kick, $f(x_{n})$", "velocity", size="small")
    for n in range(4):
        left = n == 0
        d.text((x(n - 0.5)[0] + (-13 if left else 0), down + (6 if left else -15)), f"$v_{{{_half(n - 1)}}}$",
               "velocity", "end" if left else "middle")
    d.arrow((x(0)[0] - 22, up - 14), (x(-0.5)[0] + 3, down - 12), "good dash")
    d.text((22, up - 18), "the start (1.5):\nhalf a kick back", "good", "start", "small")
    return d


def _arc(start: float, end: float, count: int = 24) -> list[float]:
    return [start + (end - start) * k / count for k in range(count + 1)]


def _half(n: int) -> str:
    return ("−1/2", "1/2", "3/2", "5/2")[n + 1]


def middle_velocity() -> Drawing:
    """The area below v is the distance; each method has a rectangle for it."""
    d = Drawing(262, "The way in a step as an area: with the velocity at its start, and with that in its middle")

    def v(t: float) -> float:
        return 0.45 + 0.95 * t - 0.28 * t * t

    for left, at, title in ((50, 0.0, "explicit Euler: $v$ at the start"), (400, 0.5, "leapfrog: $v$ in the middle")):
        f = Frame((left, 222), 230, 130)
        height = v(at)
        d.path([f(0, 0), f(0, height), f(1, height), f(1, 0)], "velocity fill", closed=True)
        corner = round(20 * at)
        below = [f(t / 20, v(t / 20)) for t in range(21)]
        for piece, end in ((below[:corner + 1], 0), (below[corner:], 1)):
            d.path([*piece, f(end, height)], "impulse fill thin", closed=True)
        d.curve(lambda t, f=f: f(t, v(t)), -0.1, 1.12, "ink bold")
        d.dot(f(at, height), "velocity", 6)
        if at:
            d.text((f(1, 0)[0] + 6, f(0, 0.42)[1]), "the two\npieces\ncancel", "soft", "start", "small")
        else:
            d.text(f(0.69, 0.56), "missing", "impulse", size="small")
        d.text(f(0.5, height / 2 - 0.06), "$h v$", "velocity")
        d.arrow(f(-0.1, 0), f(1.22, 0), "soft thin")
        d.text((f(0, 0)[0], f(0, 0)[1] + 23), "$t_n$", "soft")
        d.text((f(1, 0)[0], f(0, 0)[1] + 23), "$t_n+h$", "soft")
        d.text((f(0.42, 0)[0], 30), title, "ink")
        d.text((f(1.12, 0)[0] + 4, f(0, v(1.12))[1] - 6), "$v(t)$", "ink")
    return d


def phase_plane() -> Drawing:
    """A mass on a spring with hω = 0.7: (1.2), and (1.3) and (1.4) with v read by (1.6)."""
    d = Drawing(372, "A mass on a spring, step by step: explicit Euler spirals out, leapfrog stays on an ellipse")
    step = 0.7
    f = Frame((250, 158), 98)
    d.arrow((50, 158), (450, 158), "soft thin")
    d.arrow((250, 358), (250, 20), "soft thin")
    d.text((450, 180), "$x$", "soft", "end")
    d.text((262, 34), "$v/ω$", "soft", "start")
    d.circle(f(0, 0), 98, "faint bold")
    euler = [(1.0, 0.0)]
    while len(euler) < 5:
        x, v = euler[-1]
        euler.append((x + step * v, v - step * x))
    d.path([f(x, v) for x, v in euler], "impulse dash")
    for n, (x, v) in enumerate(euler):
        d.dot(f(x, v), "impulse", 5)
        if n:
            d.text((f(x, v)[0] + 14, f(x, v)[1] + 14), f"{n}", "impulse", size="small")
    theta = math.acos(1 - step**2 / 2)
    height = math.sqrt(1 - step**2 / 4)
    d.curve(lambda a: f(math.cos(a), height * math.sin(a)), 0, 2 * math.pi, "good thin")
    for n in range(9):
        d.dot(f(math.cos(n * theta), -height * math.sin(n * theta)), "good", 5)
    d.line(f(0, 0), f(1, 0), "good thin")
    d.line(f(0, 0), f(math.cos(theta), -height * math.sin(theta)), "good thin")
    d.arc(f(0, 0), 48, 0, -math.degrees(theta) + 2, "good", arrow=True)
    d.text(turned(f(0, 0), 66, -20), "$θ$", "good")
    d.text((500, 90), "explicit Euler", "impulse", "start")
    d.text((500, 114), "energy times $1 + (hω)^2$\nin each step", "impulse", "start", "small")
    d.text((500, 190), "leapfrog", "good", "start")
    d.text((500, 214),
           "on one ellipse, for ever;\neach step turns by $θ$:\n$cos θ = 1 − (hω)^2/2$", "good", "start", "small")
    d.text((500, 314), "the grey circle: what is true\ndrawn for $hω = 0.7$", "soft", "start", "small")
    return d
