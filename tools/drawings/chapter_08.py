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
    """Two bars that cross, drawn apart; s and t of (8.9) for the highest edge of i and the lowest of j."""
    d = Drawing(372, "Two edges that cross: the nearest points, and the contact in the middle between them")
    view = View((262, 218), 78, 30, 26)
    low = _bar(d, view, 160, -0.62)
    high = _bar(d, view, 96, 0.62 + 0.75)
    q_i, q_j = (tuple(-1.9 * x + y for x, y in zip(along, middle)) for along, middle in (low, high))
    a, b = (tuple(3.8 * x for x in along) for along, _ in (low, high))
    for q, e, name, colour in ((q_i, a, "i", "velocity"), (q_j, b, "j", "pair")):
        end = view(*(x + y for x, y in zip(q, e)))
        d.arrow(view(*q), end, f"{colour} bold")
        d.dot(view(*q), colour, 5)
        d.text((view(*q)[0] - 10, view(*q)[1] + (-8 if name == "i" else 20)), f"$q_{name}$", colour, "end")
        d.text((end[0] + (-8 if name == "i" else 12), end[1] + (28 if name == "i" else 4)),
               "$a$" if name == "i" else "$b$", colour, "start")
    w = tuple(y - x for x, y in zip(q_i, q_j))
    ab = _cross(a, b)
    size = _dot(ab, ab)
    s, t = _dot(_cross(w, b), ab) / size, _dot(_cross(w, a), ab) / size
    near_i, near_j = (tuple(q + part * x for q, x in zip(start, e)) for start, part, e in ((q_i, s, a), (q_j, t, b)))
    d.line(view(*near_i), view(*near_j), "good bold")
    d.dot(view(*near_i), "velocity", 6)
    d.dot(view(*near_j), "pair", 6)
    p = view(*((x + y) / 2 for x, y in zip(near_i, near_j)))
    d.dot(p, "impulse", 7)
    d.text((p[0] + 14, p[1] + 6), "$p$", "impulse", "start")
    d.text((p[0] - 14, p[1] - 10), "$n$", "good", "end")
    d.text((482, 96), "The green line joins the nearest\npoints, at right angles to both\nedges: $n$ is along $a × b$.",
           "good", "start", "small")
    d.text((482, 180), "The one contact, $p$, is in its\nmiddle.", "impulse", "start", "small")
    d.text((482, 244), "The bars are drawn apart. When\nthey touch, the edges have passed\neach other a little.",
           "soft", "start", "small")
    return d


def _bar(d: Drawing, view: View, heading: float, height: float):
    """A bar that stands on an edge; returns the direction, and the middle, of the edge that faces the other bar."""
    c, s, side = math.cos(math.radians(heading)), math.sin(math.radians(heading)), math.sqrt(0.5)
    along, across = (c, s, 0.0), (-s, c, 0.0)
    normals = [tuple(side * (u * x + v * z) for x, z in zip(across, (0, 0, 1))) for u, v in
               ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    half, long = 0.42, 1.9

    def corner(u: float, p, q):
        return view(*(u * long * x + half * (y + z) + (0, 0, height)[k]
                      for k, (x, y, z) in enumerate(zip(along, p, q))))

    for k, normal in enumerate(normals):
        if view.depth(*normal) > 0:
            before, after = normals[k - 1], normals[(k + 1) % 4]
            d.path([corner(-1, before, normal), corner(1, before, normal), corner(1, normal, after),
                    corner(-1, normal, after)], "body fill", closed=True)
    end = 1 if view.depth(*along) > 0 else -1
    d.path([corner(end, normals[k - 1], normals[k]) for k in range(4)], "body fill", closed=True)
    reach = half * math.sqrt(2)
    return along, (0.0, 0.0, height + (reach if height < 0 else -reach))


def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _dot(a, b) -> float:
    return sum(x * y for x, y in zip(a, b))
