"""Chapter 06: a rod and a ball joint, and the distribution of the mass of a rope and of a cloth."""

import math

from pen import Drawing, between, turned


def rod_and_ball_joint() -> Drawing:
    d = Drawing(352, "A rod holds two points at a distance along n; a ball joint holds them together in x, y and z")
    x_i, x_j = (96, 230), (286, 120)
    p_i, p_j = (146, 190), (238, 156)
    _block(d, x_i, 104, 62, 24)
    _block(d, x_j, 104, 62, 58)
    d.line(p_i, p_j, "impulse bold")
    for x, p, name in ((x_i, p_i, "i"), (x_j, p_j, "j")):
        d.arrow(x, p, "ink")
        d.dot(x, "ink", 4)
        d.dot(p, "impulse", 6)
    d.text((x_i[0] - 6, x_i[1] + 24), "$x_i$", "ink")
    d.text((x_j[0] + 20, x_j[1] + 2), "$x_j$", "ink")
    d.text((between(x_i, p_i)[0] - 14, between(x_i, p_i)[1] - 6), "$r_i$", "ink")
    d.text((between(x_j, p_j)[0] - 2, between(x_j, p_j)[1] - 10), "$r_j$", "ink", "end")
    d.text((p_i[0] - 4, p_i[1] - 16), "$p_i$", "impulse")
    d.text((p_j[0] + 6, p_j[1] + 28), "$p_j$", "impulse")
    lower = [turned(between(p_i, p_j, t), 30, -110) for t in (0.0, 1.0)]
    d.arrow(*lower, "good")
    d.text((between(*lower)[0] + 12, between(*lower)[1] + 26), "$n$", "good")
    d.text((190, 304), "rod: one row, along $n$", "soft")
    d.text((190, 331), "$g = |p_j − p_i| − l$", "ink")

    x_i, x_j = (452, 226), (640, 128)
    p_i, p_j = (520, 188), (556, 168)
    _block(d, x_i, 122, 66, 24)
    _block(d, x_j, 122, 66, 20)
    for x, p in ((x_i, p_i), (x_j, p_j)):
        d.arrow(x, p, "ink")
        d.dot(x, "ink", 4)
        d.dot(p, "impulse", 6)
    corner = (p_j[0], p_i[1])
    d.arrow(p_i, corner, "impulse")
    d.arrow(corner, p_j, "impulse")
    d.text((x_i[0] - 8, x_i[1] + 22), "$x_i$", "ink")
    d.text((x_j[0] + 10, x_j[1] - 10), "$x_j$", "ink")
    d.text((p_i[0] - 6, p_i[1] - 14), "$p_i$", "impulse", "end")
    d.text((p_j[0] + 2, p_j[1] - 14), "$p_j$", "impulse")
    d.text((between(p_i, corner)[0] + 2, corner[1] + 24), "$g_x$", "impulse")
    d.text((corner[0] + 10, between(corner, p_j)[1] + 8), "$g_y$", "impulse", "start")
    d.text((545, 304), "ball joint: three rows, along $x$, $y$, $z$", "soft")
    d.text((545, 331), "$g = p_j − p_i$", "ink")
    d.line((366, 30), (366, 334), "faint thin")
    d.text((190, 36), "the distance is held;\nthe direction is free", "ink", size="small")
    d.text((545, 36), "the points are held together;\nthe bodies turn freely", "ink", size="small")
    return d


def _block(d: Drawing, centre, width: float, height: float, lean: float) -> None:
    a = math.radians(lean)
    corners = [(s * width / 2, t * height / 2) for s, t in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
    d.path([(centre[0] + x * math.cos(a) + y * math.sin(a), centre[1] - x * math.sin(a) + y * math.cos(a))
            for x, y in corners], "body fill", closed=True)


def shares_of_mass() -> Drawing:
    d = Drawing(270, "Each link gives half of its mass to each end; each cell of a cloth a quarter to each corner")
    for k in range(5):
        x = 60 + 68 * k
        if k < 4:
            d.line((x, 110), (x + 68, 110), "ink")
            d.line((x + 34, 96), (x + 34, 124), "impulse")
            d.arrow((x + 31, 90), (x + 10, 90), "impulse thin")
            d.arrow((x + 37, 90), (x + 58, 90), "impulse thin")
        d.dot((x, 110), "body", 7 if k in (0, 4) else 10)
        d.text((x, 150), ("$½$", "$1$", "$1$", "$1$", "$½$")[k], "ink")
    d.text((196, 62), "½ of a link to each end", "impulse", size="small")
    d.text((196, 190), "times $m/N$", "soft")
    left, top, cell = 412, 46, 52
    for k in range(4):
        d.line((left, top + cell * k), (left + 3 * cell, top + cell * k), "soft thin")
        d.line((left + cell * k, top), (left + cell * k, top + 3 * cell), "soft thin")
    d.box((left + cell, top + cell), cell, cell, "impulse fill")
    for s in (0, 1):
        for t in (0, 1):
            middle = (left + 1.5 * cell, top + 1.5 * cell)
            corner = (left + (1 + s) * cell, top + (1 + t) * cell)
            d.arrow(between(middle, corner, 0.25), between(middle, corner, 0.78), "impulse thin")
    for k in range(4):
        for n in range(4):
            cells = (1 if k in (0, 3) else 2) * (1 if n in (0, 3) else 2)
            at = (left + cell * k, top + cell * n)
            d.dot(at, "body", {1: 6, 2: 8, 4: 11}[cells])
    d.text((left - 16, top + 5), "$1$", "ink", "end")
    d.text((left - 16, top + cell + 5), "$2$", "ink", "end")
    d.text((left + 3 * cell + 28, top + 1.5 * cell), "$4$: in the middle", "ink", "start", "small")
    d.text((left + 3 * cell + 28, top + 1.5 * cell + 24), "$2$: on the hem", "ink", "start", "small")
    d.text((left + 3 * cell + 28, top + 1.5 * cell + 48), "$1$: at a corner", "ink", "start", "small")
    d.text((left + 1.5 * cell, top + 3 * cell + 44), "times $m/(4 n_u n_v)$", "soft")
    return d
