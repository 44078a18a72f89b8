"""Chapter 13: the rows of joints, the axes of a hinge's rows, the second term, and the arrival at a limit."""

import math

from pen import Drawing, Frame, between, turned


def hinge_and_slider() -> Drawing:
    d = Drawing(330, "A hinge holds three shifts and two turns and leaves one turn; a slider leaves one shift")
    # A hinge: two leaves on a pin.
    axis = 182
    d.path([(axis, 90), (70, 118), (70, 226), (axis, 198)], "body fill", closed=True)
    d.path([(axis, 90), (302, 106), (302, 214), (axis, 198)], "body fill", closed=True)
    d.line((axis, 62), (axis, 232), "ink bold")
    d.arrow((axis, 232), (axis, 46), "good")
    d.text((axis + 12, 56), "3", "good", "start")
    d.arc((axis, 150), 56, 200, 350, "good", arrow=True)
    d.text((96, 174), "$i$", "ink")
    d.text((272, 164), "$j$", "ink")
    d.text((axis, 282), "hinge: five rows", "ink")
    d.text((axis, 306), "held: three shifts, turns about 1 and 2", "soft", size="small")
    d.text((axis + 44, 226), "free: $θ$", "good", "start", "small")

    # A slider: a block on a rail.
    d.path([(400, 214), (664, 134), (664, 152), (400, 232)], "body fill", closed=True)
    d.path([(506, 130), (572, 110), (572, 172), (506, 192)], "body fill", closed=True)
    d.arrow((440, 106), (650, 42), "good")
    d.text((660, 50), "3", "good", "start")
    d.text((430, 128), "free: $s$", "good", "end", "small")
    d.text((424, 254), "$i$", "ink")
    d.text((540, 158), "$j$", "ink")
    d.text((545, 282), "slider: five rows", "ink")
    d.text((545, 306), "held: shifts along 1 and 2, three turns", "soft", size="small")
    d.line((362, 30), (362, 312), "faint thin")
    return d


def halfway_axes() -> Drawing:
    """A hinge seen along its axis, turned by 100 degrees."""
    d = Drawing(330, "The axes of a hinge's rows are turned by half the angle of the hinge")
    theta, tilt = 100, 10
    centre, length = (250, 214), 150
    for angle, style, label in ((tilt, "ink", "i: $e_1$"), (tilt + theta, "ink", "j: $e_1$")):
        tip = turned(centre, length, angle)
        d.arrow(centre, tip, style)
        out = turned(centre, length + 22, angle)
        d.text((out[0] + (10 if angle < 90 else -8), out[1] + 5), label, style, "start" if angle < 90 else "end")
    tip = turned(centre, length, tilt + theta / 2)
    d.arrow(centre, tip, "impulse bold")
    d.text((tip[0] + 14, tip[1] - 4), "$a_1$, halfway", "impulse", "start")
    tip = turned(centre, length, tilt + theta / 2 + 90)
    d.arrow(centre, tip, "impulse bold")
    d.text((tip[0] - 12, tip[1] - 4), "$a_2$", "impulse", "end")
    d.arc(centre, 62, tilt, tilt + theta, "good", arrow=True)
    at = turned(centre, 84, tilt + 26)
    d.text((at[0] + 4, at[1] + 4), "$θ$", "good", "start")
    d.arc(centre, 104, tilt, tilt + theta / 2, "impulse thin", arrow=True)
    at = turned(centre, 122, tilt + 20)
    d.text((at[0] + 4, at[1] + 4), "$θ/2$", "impulse", "start", "small")
    d.circle(centre, 9, "ink")
    d.dot(centre, "ink", 3)
    d.text((centre[0] + 2, centre[1] + 34), "the hinge's axis points at you", "soft", size="small")
    d.text((470, 236), "$a_k = w e_k + v × e_k$\nin i's frame, with\n$w = $cos$ θ/2$, $v = ($0, 0, sin$ θ/2)$", "ink", "start")
    d.text((40, 310), "One row for each of the two axes: about them $j$ must not turn from $i$.", "soft", "start", "small")
    return d


def second_term() -> Drawing:
    d = Drawing(330, "With the second term push and push back are on one line; without it they turn the pair")
    for left, with_it in ((40, True), (390, False)):
        angle = 20
        centre = (left + 60, 226)
        tip, bead = turned(centre, 250, angle), turned(centre, 190, angle)
        a = math.radians(angle)
        across = (-math.sin(a), -math.cos(a))
        side = [(8 * across[0], 8 * across[1]), (-8 * across[0], -8 * across[1])]
        d.path([(centre[0] + side[0][0], centre[1] + side[0][1]), (tip[0] + side[0][0], tip[1] + side[0][1]),
                (tip[0] + side[1][0], tip[1] + side[1][1]), (centre[0] + side[1][0], centre[1] + side[1][1])],
               "body fill", closed=True)
        d.circle(bead, 17, "body fill")
        d.dot(centre, "ink", 5)
        d.dot(bead, "ink", 4)
        at = bead if with_it else centre
        d.arrow(bead, (bead[0] + 78 * across[0], bead[1] + 78 * across[1]), "impulse bold")
        d.arrow(at, (at[0] - 78 * across[0], at[1] - 78 * across[1]), "impulse bold")
        d.text((bead[0] + 84 * across[0] + 10, bead[1] + 84 * across[1] + 6), "$λ n$, on the bead", "impulse", "end")
        label = (at[0] - 78 * across[0], at[1] - 78 * across[1])
        d.text((label[0] + (-14 if with_it else 12), label[1] + 12), "$−λ n$, on the rod", "impulse",
               "end" if with_it else "start")
        middle = between(centre, bead)
        d.text((middle[0] - 10, middle[1] - 18), "$d$", "ink", "end")
        d.text((left + 150, 40), "arm $r_i + d$" if with_it else "arm $r_i$", "ink")
        d.text((left + 150, 62), "the rod slows, $L$ is kept" if with_it else "a torque from nothing, $d × λ n$",
               "good" if with_it else "soft", size="small")
    d.line((362, 30), (362, 312), "faint thin")
    return d


def arriving_at_a_limit() -> Drawing:
    """A wheel at 1 rad/s, ten steps before its limit: one row, by SPOOK's a and b with d = 3, and by (13.11)."""
    d = Drawing(330, "A limit with SPOOK's a and b slows what is still on its way; with (13.11) it stops at the limit")
    f = Frame((84, 270), 27, 27)
    d.arrow(f(0, 0), f(21, 0), "soft thin")
    d.arrow(f(0, 0), f(0, 8.6), "soft thin")
    d.text((f(21, 0)[0] + 6, 275), "steps", "soft", "start", "small")
    d.text((f(0, 8.6)[0] - 8, 46), "$s$", "soft", "end")
    limit = 6.6
    d.line(f(0, limit), f(20, limit), "impulse dash")
    d.text((f(20, limit)[0], f(0, limit)[1] - 10), "the limit", "impulse", "end", "small")
    for name, style in (("spook", "velocity"), ("limit", "good")):
        points = [f(*point) for point in _arrivals(limit, name)]
        d.path(points, f"{style} thin")
        for point in points:
            d.dot(point, style, 4)
    d.text((f(11, 4.2)[0], f(0, 4.2)[1]), "with $a$ and $b$ of a contact, $d = 3$: slowed from\nthree steps before",
           "velocity", "start", "small")
    d.text((f(1, 7.5)[0], f(0, 7.5)[1]), "by (13.11): in the step in which it arrives", "good", "start", "small")
    return d


def _arrivals(limit: float, name: str) -> list[tuple[float, float]]:
    """Simulates steps of length 1 at speed 1; Σ = 0."""
    relaxed, s, speed = 3, 0.0, 1.0
    points = [(0.0, 0.0)]
    for step in range(1, 20):
        gap = limit - s
        a, b = 4 / (1 + 4 * relaxed), 4 * relaxed / (1 + 4 * relaxed)
        if name == "limit":
            a, b = (1.0 if gap > 0 else a), 1.0
        push = max(0.0, -a * gap + b * speed)  # λ of a unit mass: B with G = -1
        speed -= push
        s += speed
        points.append((float(step), s))
    return points
