"""Chapter 05: two tangents, and the box of their two bounds."""

import math

from pen import Drawing, Frame, View, turned


def tangents_and_box() -> Drawing:
    d = Drawing(330, "Tangents beside the normal, and the square of friction impulses that their bounds allow")
    view = View((185, 200), 92, 40, 26)
    ground = [view(x, y, 0) for x, y in ((1.25, 1.25), (1.25, -1.25), (-1.25, -1.25), (-1.25, 1.25))]
    d.path(ground, "body fill", closed=True)
    for end, name, colour in (((0, 0, 1.35), "$n$", "good"), ((1.05, 0, 0), "$t_1$", "ink"),
                              ((0, 1.05, 0), "$t_2$", "ink")):
        d.arrow(view(0, 0, 0), view(*end), f"{colour} bold")
        at = view(*(1.2 * c for c in end))
        d.text((at[0], at[1] + 5), name, colour)
    d.arrow(view(0, 0, 0), view(0.1, -0.95, 0), "velocity")
    d.text((view(0.1, -0.95, 0)[0] - 4, view(0.1, -0.95, 0)[1] - 12), "$u_t$", "velocity")
    d.text((185, 310), "three rows: $n$, $t_1$, $t_2$", "soft")

    f = Frame((520, 160), 92)
    d.path([f(1, 1), f(1, -1), f(-1, -1), f(-1, 1)], "impulse fill", closed=True)
    d.circle(f(0, 0), 92, "soft dash")
    d.arrow(f(-1.35, 0), f(1.45, 0), "soft thin")
    d.arrow(f(0, -1.35), f(0, 1.45), "soft thin")
    d.text((f(1.45, 0)[0] + 6, 165), "$λ_1$", "soft", "start")
    d.text((f(0, 1.45)[0] - 8, f(0, 1.45)[1] + 12), "$λ_2$", "soft", "end")
    d.text((f(1, 0)[0] + 6, 180), "$Λ$", "impulse", "start")
    d.text((f(0, 1)[0] - 6, f(0, 1)[1] - 7), "$Λ$", "impulse", "end")
    phi = math.radians(33)
    tip = (1, math.tan(phi))
    d.arrow(f(0, 0), f(*tip), "impulse bold")
    d.arc(f(0, 0), 44, 0, 33, "ink", arrow=True)
    d.text(turned(f(0, 0), 60, 17), "$φ$", "ink")
    d.text((f(*tip)[0] + 10, f(*tip)[1] - 2), "$Λ/cos φ$", "impulse", "start")
    d.arrow(f(0, 0), f(-1, 1), "impulse thin")
    d.text((f(-1, 1)[0] - 8, f(-1, 1)[1] - 4), "$√2 Λ$", "impulse", "end")
    d.text((520, 310), "the box, and Coulomb's circle (dashed)", "soft")
    return d


def paths_that_bend() -> Drawing:
    """Blocks that start at equal speed; by (5.13) each velocity component is braked by itself."""
    d = Drawing(330, "Blocks sent off at one speed in several directions: they bend towards a tangent and stop early")
    f = Frame((70, 285), 225)
    d.arrow((70, 285), (345, 285), "soft thin")
    d.arrow((70, 285), (70, 25), "soft thin")
    d.text((345, 308), "along $t_1$", "soft", "end", "small")
    d.text((82, 32), "along $t_2$", "soft", "start", "small")
    d.curve(lambda a: f(math.cos(a), math.sin(a)), 0, math.pi / 2, "soft dash")
    for degrees in (0, 15, 30, 45, 60, 75, 90):
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        points = []
        for k in range(41):  # time over v0/(μg); each component is braked alike until it is gone
            t = k / 40
            points.append(f(*(2 * (v * min(t, v) - min(t, v) ** 2 / 2) for v in (c, s))))
        d.path(points, "velocity")
        d.dot(points[-1], "velocity", 5)
    d.text((268, 92), "Coulomb: all\nstop on this\ncircle", "soft", "start", "small")
    d.text((400, 92), "Each tangent brakes its own part\nof the velocity by $μg$.", "ink", "start")
    d.text((400, 156), "The smaller part is gone first,\nand the path bends.", "ink", "start")
    d.text((400, 220), "At 45° both end together: no bend,\nand 0.71 of the way.", "ink", "start")
    return d
