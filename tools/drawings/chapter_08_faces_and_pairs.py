"""Chapter 08, continued: a face that is clipped, a load within its contacts, sorted intervals, and grids."""

import math

from pen import Drawing, Frame, View, between


def face_that_is_met() -> Drawing:
    d = Drawing(340, "The face of i that is met, the four planes around it, and the incident face of j")
    view = View((205, 222), 92, 62, 26)
    low, high = -0.62, 0.0
    _faces(d, view, 0.0, (1.0, 1.0), low, high, (0.0, 0.0))
    top = [view(x, y, high) for x, y in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
    d.path(top, "velocity fill", closed=True)
    for x, y in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
        d.line(view(x, y, high), view(x, y, high + 1.35), "velocity thin dash")
    incident = _polygon((0.55, 0.35), (0.85, 0.85), 33)
    d.path([view(x, y, 0.42) for x, y in incident], "pair fill", closed=True)
    for x, y in incident:
        d.line(view(x, y, 0.42), view(x, y, 1.1), "pair thin")
    d.path([view(x, y, 1.1) for x, y in incident], "pair thin", closed=True)
    d.arrow(view(-0.55, -0.55, 0), view(-0.55, -0.55, 0.62), "good bold")
    at = view(-0.55, -0.55, 0.72)
    d.text((at[0], at[1] - 2), "$n$", "good")
    d.text((440, 64), "box $j$, drawn above its place", "pair", "start")
    d.text((440, 100), "its incident face: the one that\nlooks against $n$ most", "pair", "start")
    d.text((440, 166), "four planes, around", "velocity", "start")
    d.text((440, 202), "the face of $i$ that is met", "velocity", "start")
    d.text((440, 252), "What of the incident face lies\nbetween the four planes is where\nthe two boxes touch.",
           "soft", "start", "small")
    return d


def _faces(d: Drawing, view: View, lean: float, half, low: float, high: float, centre) -> None:
    base = _polygon(centre, half, lean)
    for a, b in zip(base, base[1:] + base[:1]):
        outward = (a[0] + b[0] - 2 * centre[0], a[1] + b[1] - 2 * centre[1])
        if view.depth(outward[0], outward[1], 0) > 0:
            d.path([view(*a, low), view(*b, low), view(*b, high), view(*a, high)], "body fill", closed=True)


def _polygon(centre, half, lean: float) -> list[tuple[float, float]]:
    c, s = math.cos(math.radians(lean)), math.sin(math.radians(lean))
    return [(centre[0] + a * half[0] * c - b * half[1] * s, centre[1] + a * half[0] * s + b * half[1] * c)
            for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]


def clipping() -> Drawing:
    """The incident face of `face_that_is_met`, from above, cut by (8.8) by one plane after the other."""
    d = Drawing(262, "The incident face is cut by one plane after the other, until it lies over the face that is met")
    polygon = _polygon((0.55, 0.35), (0.85, 0.85), 33)
    planes = (((1, 0), 1, "cut at the right"), ((0, 1), 1, "cut at the top"), ((-1, 0), 1, "nothing more to cut"))
    for k in range(4):
        f = Frame((100 + 175 * k, 132), 50)
        d.path([f(x, y) for x, y in ((1, 1), (1, -1), (-1, -1), (-1, 1))], "velocity", closed=True)
        if k:
            n, offset, _ = planes[k - 1]
            before = polygon
            polygon = _cut(polygon, n, offset)
            if k == 3:
                polygon = _cut(polygon, (0, -1), 1)
            d.path([f(*p) for p in before], "pair thin dash", closed=True)
            if k < 3:
                m = (-n[1], n[0])
                d.line(f(n[0] + 1.45 * m[0], n[1] + 1.45 * m[1]), f(n[0] - 1.45 * m[0], n[1] - 1.45 * m[1]), "impulse")
        d.path([f(*p) for p in polygon], "pair fill", closed=True)
        for p in polygon:
            fresh = k and p not in before
            d.dot(f(*p), "impulse" if fresh else "pair", 5)
        d.text((100 + 175 * k, 242), "the incident face" if not k else planes[k - 1][2], "soft", size="small")
    d.text((362, 26), "orange: corners that (8.8) has made", "impulse", size="small")
    return d


def _cut(polygon, n, offset: float):
    """Clips a polygon by Eq. (8.8)."""
    result = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        a, b = n[0] * p[0] + n[1] * p[1] - offset, n[0] * q[0] + n[1] * q[1] - offset
        if a <= 0:
            result.append(p)
        if a * b < 0:
            result.append(between(p, q, a / (a - b)))
    return result


def load_within() -> Drawing:
    d = Drawing(318, "A load over one of eight corners: within the hull of all eight, outside of that of four")
    outline = [(1.0, 0.35), (0.55, 0.92), (-0.2, 1.0), (-0.92, 0.62), (-1.0, -0.2), (-0.5, -0.9), (0.25, -1.0),
               (0.95, -0.55)]
    load = (-0.14, 0.88)
    for middle, kept, title, colour in ((185, range(8), "eight contacts: the box stands", "good"),
                                        (535, (1, 3, 5, 7), "four of them: it tips", "impulse")):
        f = Frame((middle, 150), 108)
        d.path([f(*p) for p in outline], "faint fill", closed=True)
        d.path([f(*outline[k]) for k in kept], f"{colour} fill", closed=True)
        for k, p in enumerate(outline):
            d.dot(f(*p), colour if k in kept else "soft", 6 if k in kept else 5)
        at = f(*load)
        d.dot(at, "ink", 6)
        d.text((at[0] + 4, at[1] - 26), "load", "ink")
        d.text((middle, 304), title, "soft", size="small")
    return d


def sorted_intervals() -> Drawing:
    d = Drawing(358, "Bodies sorted along an axis: each is compared with those that begin before it ends")
    bodies = ((76, 92, 40), (152, 70, 32), (196, 118, 42), (330, 78, 34), (420, 112, 46), (470, 62, 28), (610, 92, 44))
    for x, y, r in bodies:
        d.circle((x, y), r, "body fill")
    d.arrow((24, 176), (700, 176), "soft thin")
    order = sorted(range(len(bodies)), key=lambda k: bodies[k][0] - bodies[k][2])
    for place, k in enumerate(order):
        x, y, r = bodies[k]
        level = 196 + 15 * place
        d.line((x - r, level), (x + r, level), "velocity bold")
        d.text((x, y + 6), "abcdefg"[place], "ink")
        d.text((x - r - 8, level + 5), "abcdefg"[place], "velocity", "end", "small")
    x, y, r = bodies[order[1]]
    d.line((x + r, 150), (x + r, 330), "impulse dash")
    d.text((x + r + 8, 318),
           "b ends here. c begins before it: compare b with c.\nd begins behind it: nothing more for b.",
           "impulse", "start", "small")
    return d


def cells_and_levels() -> Drawing:
    d = Drawing(356, "Grids of two levels, and the one cell that speaks for a pair: that of its common lower corner")
    left, low, cell = 40, 316, 62
    for k in range(6):
        d.line((left + cell * k, low), (left + cell * k, low - 4.5 * cell), "faint thin")
    for k in range(5):
        d.line((left, low - cell * k), (left + 5 * cell, low - cell * k), "faint thin")
    d.box((left + 2 * cell, low - 2 * cell), cell, cell, "good fill")
    a = (left + 1.55 * cell, low - 2.5 * cell, 0.9 * cell, 0.85 * cell)
    b = (left + 2.2 * cell, low - 2.15 * cell, 0.85 * cell, 0.9 * cell)
    for (x, y, w, h), colour, name in ((a, "velocity", "i"), (b, "pair", "j")):
        d.box((x, y), w, h, f"{colour}")
    d.text((a[0] + 14, a[1] + 22), "$i$", "velocity")
    d.text((b[0] + b[2] - 14, b[1] + b[3] - 14), "$j$", "pair")
    m = (b[0], min(a[1] + a[3], b[1] + b[3]))
    d.dot(m, "impulse", 6)
    d.text((m[0] - 10, m[1] + 20), "$m$", "impulse", "end")
    d.box((left + 3.3 * cell, low - 4.2 * cell), 1.6 * cell, 1.5 * cell, "gold")
    d.text((left + 4.1 * cell, low - 3.4 * cell), "large", "gold", size="small")
    d.text((400, 66),
           "Both $i$ and $j$ are in several cells, and\nshare four of them. One cell speaks:", "ink", "start", "small")
    d.text((400, 110), "the green one, that holds $m$,\nthe lower corner of what they share.", "good", "start", "small")
    d.text((400, 176), "The large one enters a coarser grid:", "gold", "start", "small")
    for k in range(3):
        d.line((420 + 100 * k, 196), (420 + 100 * k, 316), "gold thin")
    for k in range(2):
        d.line((404, 210 + 100 * k), (640, 210 + 100 * k), "gold thin")
    d.box((452, 222), 80, 74, "gold")
    d.box((558, 256), 32, 30, "velocity")
    d.text((524, 342), "small ones look here, too", "soft", size="small")
    return d
