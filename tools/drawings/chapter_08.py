"""Chapter 08, shapes: the single contact point, the nearest point of a box, shadows on an axis, and two edges."""

import math

from pen import Drawing, Frame, View, between


def one_point() -> Drawing:
    d = Drawing(296, "Opposite impulses at two points are a couple; at one point they are none")
    for middle, title in ((180, "two points: a couple"), (540, "one point: none")):
        x_i, x_j, radius = (middle - 66, 184), (middle + 66, 164), 88
        d.circle(x_i, radius, "body fill")
        d.circle(x_j, radius, "body")
        length = math.dist(x_i, x_j)
        n = ((x_j[0] - x_i[0]) / length, (x_j[1] - x_i[1]) / length)
        across = (-n[1], n[0])
        p_i = (x_i[0] + radius * n[0], x_i[1] + radius * n[1])
        p_j = (x_j[0] - radius * n[0], x_j[1] - radius * n[1])
        if middle == 540:
            p_i = p_j = between(p_i, p_j)
        for x, p in ((x_i, p_i), (x_j, p_j)):
            d.dot(x, "ink", 4)
            d.line(x, p, "ink thin")
        d.arrow(p_i, (p_i[0] + 66 * across[0], p_i[1] + 66 * across[1]), "impulse bold")
        d.arrow(p_j, (p_j[0] - 66 * across[0], p_j[1] - 66 * across[1]), "impulse bold")
        d.text((p_i[0] + 66 * across[0] + 16, p_i[1] + 66 * across[1] + 2), "$−J$", "impulse", "start")
        d.text((p_j[0] - 66 * across[0] - 8, p_j[1] - 66 * across[1] - 4), "$J$", "impulse", "end")
        if middle == 180:
            d.dot(p_i, "ink", 5)
            d.dot(p_j, "ink", 5)
            d.text((p_i[0] + 8, p_i[1] - 12), "$p_i$", "ink", "start")
            d.text((p_j[0] - 8, p_j[1] + 24), "$p_j$", "ink", "end")
        else:
            d.dot(p_i, "ink", 5)
            d.text((p_i[0] + 12, p_i[1] - 10), "$p$", "ink", "start")
        d.text((x_i[0] - 6, x_i[1] - 12), "$x_i$", "ink")
        d.text((x_j[0] + 10, x_j[1] - 12), "$x_j$", "ink")
        d.text((middle, 30), title, "ink")
    return d


def box_and_ball() -> Drawing:
    d = Drawing(362, "The point of a box that is nearest to a ball: on a face, at a corner, or the ball's own centre")
    left, top, right, low = 130, 128, 440, 268
    for x in (left, right):
        d.line((x, 26), (x, 284), "faint thin dash")
    for y in (top, low):
        d.line((24, y), (600, y), "faint thin dash")
    d.box((left, top), right - left, low - top, "body fill")
    for centre, c, name, at in (((240, 82), (240, top), "beside a face:\n$n$ is the face's", (30, 62)),
                                ((484, 88), (right, top), "beside a corner:\n$n$ is along $x_j − c$", (566, 62))):
        d.circle(centre, 64, "soft")
        d.dot(centre, "ink", 4)
        d.arrow(c, centre, "good bold")
        d.dot(c, "impulse", 6)
        d.text((c[0] - 10, c[1] + 22), "$c$", "impulse", "end")
        d.text(at, name, "good", "start", "small")
    inside = (250, 232)
    d.circle(inside, 64, "soft")
    d.dot(inside, "ink", 4)
    d.arrow(inside, (250, low + 34), "good bold")
    d.dot((250, low), "impulse", 6)
    d.text((330, 196), "its centre is\nin the box", "ink", "start", "small")
    d.text((330, 300), "out through the nearest face,\nand the distance is negative", "good", "start", "small")
    return d


def shadows_on_an_axis() -> Drawing:
    """Two boxes, and their shadows along an axis that separates them, and along one that does not."""
    d = Drawing(366, "The shadows of two boxes along an axis: apart along one, overlapping along another")
    f = Frame((228, 176), 52)
    boxes = (_corners((-1.35, -0.35), (1.25, 0.75), 12), _corners((1.35, 0.75), (0.95, 0.8), 50))
    for corners, centre, name in zip(boxes, ((-1.35, -0.35), (1.35, 0.75)), ("$i$", "$j$")):
        d.path([f(*p) for p in corners], "body fill", closed=True)
        d.dot(f(*centre), "ink", 4)
        d.text((f(*centre)[0], f(*centre)[1] + 24), name, "ink")
    apart = _axis(f, 12, -2.3)
    d.arrow(apart(-2.9), apart(3.3), "soft thin")
    (low, end), (begin, high) = (_shadow(corners, 12) for corners in boxes)
    d.line(apart(low), apart(end), "ink bold")
    d.line(apart(begin), apart(high), "velocity bold")
    for t in (end, begin):
        d.line(apart(t, -0.16), apart(t, 0.16), "good")
    middle = (begin + end) / 2
    d.line(apart(middle, 0.3), apart(middle, 4.4), "good dash")
    d.text((apart(middle, -0.45)[0] + 6, apart(middle, -0.45)[1] + 6), "$g(n) > 0$", "good")
    over = _axis(f, 102, 3.2)
    d.arrow(over(-2.1), over(2.6), "soft thin")
    for corners, beside, colour in zip(boxes, (-0.09, 0.09), ("ink", "velocity")):
        low, high = _shadow(corners, 102)
        d.line(over(low, beside), over(high, beside), f"{colour} bold")
    for tip in (apart(3.3), over(2.6)):
        d.text((tip[0] + 12, tip[1] + 2), "$n$", "soft")
    d.text((462, 96), "Along this $n$ a gap is left:\na plane fits between, the boxes\ndo not touch. "
           "One such axis is\nenough.", "good", "start", "small")
    d.text((462, 206), "Along the other axis, on the left,\nthe shadows overlap. That alone\nsays nothing.",
           "soft", "start", "small")
    return d


def _axis(f: Frame, lean: float, distance: float):
    """Returns places along an oblique line, so far from the origin, and perhaps a little beside it."""
    c, s = math.cos(math.radians(lean)), math.sin(math.radians(lean))
    return lambda t, beside=0.0: f(t * c - (distance + beside) * s, t * s + (distance + beside) * c)


def _shadow(corners, lean: float) -> tuple[float, float]:
    places = [x * math.cos(math.radians(lean)) + y * math.sin(math.radians(lean)) for x, y in corners]
    return min(places), max(places)


def _corners(centre, half, lean: float):
    c, s = math.cos(math.radians(lean)), math.sin(math.radians(lean))
    return [(centre[0] + a * half[0] * c - b * half[1] * s, centre[1] + a * half[0] * s + b * half[1] * c)
            for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))]


def edge_against_edge() -> Drawing:
    """Two long boxes that cross; s and t of (8.9) for their lowest and highest edges."""
    d = Drawing(330, "Two edges that cross: the nearest points, and the contact in the middle between them")
    view = View((265, 178), 74, 34, 34)
    q_i, a = (2.1, 0.3, -0.1), (-4.2, -0.9, 0.0)
    q_j, b = (0.5, -1.9, 0.32), (-0.8, 3.8, 0.0)
    edge_i, edge_j = ([view(*q), view(*(x + y for x, y in zip(q, e)))] for q, e in ((q_i, a), (q_j, b)))
    _ridge(d, view, q_i, a, -1)
    d.path(edge_i, "velocity bold")
    _ridge(d, view, q_j, b, 1)
    d.path(edge_i, "velocity thin dash")  # what the upper box hides of it
    d.path(edge_j, "pair bold")
    w = tuple(y - x for x, y in zip(q_i, q_j))
    ab = _cross(a, b)
    size = _dot(ab, ab)
    s, t = _dot(_cross(w, b), ab) / size, _dot(_cross(w, a), ab) / size
    near_i = tuple(q + s * e for q, e in zip(q_i, a))
    near_j = tuple(q + t * e for q, e in zip(q_j, b))
    d.line(view(*near_i), view(*near_j), "impulse")
    d.dot(view(*near_i), "velocity", 6)
    d.dot(view(*near_j), "pair", 6)
    p = view(*((x + y) / 2 for x, y in zip(near_i, near_j)))
    d.dot(p, "impulse", 6)
    d.text((p[0] + 14, p[1] + 6), "$p$", "impulse", "start")
    for q, e, name, colour in ((q_i, a, "i", "velocity"), (q_j, b, "j", "pair")):
        d.dot(view(*q), colour, 5)
        at = view(*q)
        d.text((at[0] - 10, at[1] - 10), f"$q_{name}$", colour, "end")
        end = view(*(x + y for x, y in zip(q, e)))
        d.text((end[0] + 10, end[1] + 2), "$a$" if name == "i" else "$b$", colour, "start")
    d.text((505, 92), "What joins the nearest points\nis at right angles to both edges:", "ink", "start", "small")
    d.text((505, 140), "$n$ is along $a × b$.", "good", "start")
    d.text((505, 186), "(drawn apart; when they touch\nthey have passed each other)", "soft", "start", "small")
    return d


def _ridge(d: Drawing, view: View, q, e, side: int) -> None:
    """The two faces of a box that meet at an edge, above it or below it."""
    length = math.hypot(e[0], e[1])
    across = (-e[1] / length * 0.55, e[0] / length * 0.55, 0.0)
    end = tuple(x + y for x, y in zip(q, e))
    for turn in (1, -1):
        off = (turn * across[0], turn * across[1], 0.45 * side)
        far = [view(*(x + y for x, y in zip(at, off))) for at in (end, q)]
        d.path([view(*q), view(*end), *far], "body fill", closed=True)


def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _dot(a, b) -> float:
    return sum(x * y for x, y in zip(a, b))
