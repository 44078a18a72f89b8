"""Chapter 03: a contact's parts, the spring and damper in SPOOK, and the decay of a violation."""

import cmath
import math

from pen import Drawing, Frame, between, turned


def contact() -> Drawing:
    d = Drawing(340, "Bodies i and j with the normal n, the arms r_i and r_j, and the gap g between their surfaces")
    lean = 62  # degrees, of the normal
    p_i = (290, 176)
    p_j = turned(p_i, 46, lean)
    x_i, x_j = turned(p_i, 104, lean + 180 + 28), turned(p_j, 92, lean - 24)
    _bean(d, p_i, lean, 116)
    _bean(d, p_j, lean + 180, 100)
    d.arrow(x_i, p_i, "ink")
    d.arrow(x_j, p_j, "ink")
    d.dot(x_i, "ink", 5)
    d.dot(x_j, "ink", 5)
    d.text((x_i[0] - 6, x_i[1] + 24), "$x_i$", "ink")
    d.text((x_j[0] + 14, x_j[1] - 8), "$x_j$", "ink")
    at = between(x_i, p_i)
    d.text((at[0] - 16, at[1] - 10), "$r_i$", "ink")
    at = between(x_j, p_j)
    d.text((at[0] - 2, at[1] - 14), "$r_j$", "ink")
    beside = turned(p_i, 96, lean + 90)
    d.arrow(beside, turned(beside, 76, lean), "good bold")
    at = turned(beside, 94, lean)
    d.text((at[0], at[1] + 4), "$n$", "good", size="large")
    side_i, side_j = turned(p_i, 20, lean - 90), turned(p_j, 20, lean - 90)
    d.line(turned(p_i, 4, lean - 90), turned(p_i, 34, lean - 90), "impulse thin")
    d.line(turned(p_j, 4, lean - 90), turned(p_j, 34, lean - 90), "impulse thin")
    d.arrow(side_i, side_j, "impulse", both=True)
    at = turned(between(side_i, side_j), 24, lean - 90)
    d.text((at[0] + 4, at[1] + 6), "$g$", "impulse", "start", "large")
    d.text((128, 262), "body $i$", "soft")
    d.text((486, 52), "body $j$", "soft")
    d.text((500, 214), "$n$ points from $i$ to $j$.", "good", "start")
    d.text((500, 248),
           "$g > 0$: apart, as here\n$g = 0$: they touch\n$g < 0$: they overlap", "impulse", "start", "small")
    return d


def _bean(d: Drawing, touch, lean: float, size: float) -> None:
    """Draws an oval whose boundary passes through `touch`, at right angles to the direction `lean`."""
    a, b = size, 0.62 * size
    middle = turned(touch, b, lean + 180)
    along = math.radians(lean + 90)
    points = []
    for k in range(72):
        s, c = math.sin(2 * math.pi * k / 72), math.cos(2 * math.pi * k / 72)
        up = math.radians(lean)
        points.append((middle[0] + a * 0.8 * c * math.cos(along) + b * s * math.cos(up),
                       middle[1] - a * 0.8 * c * math.sin(along) - b * s * math.sin(up)))
    d.path(points, "body fill", closed=True)


def spring_and_damper() -> Drawing:
    """SPOOK as a spring that acts on three gaps, and a damper that acts on the new velocity."""
    d = Drawing(330, "A spring and a damper hold the gap; the spring sees a mean of three gaps, the damper a new slope")
    d.circle((130, 84), 44, "body fill")
    d.text((130, 90), "$m$", "ink")
    d.line((30, 258), (230, 258), "ink bold")
    for k in range(9):
        d.line((40 + 22 * k, 258), (30 + 22 * k, 270), "soft thin")
    d.line((88, 142), (172, 142), "ink")
    d.line((130, 128), (130, 142), "ink")
    d.spring((98, 142), (98, 258), "good", 5, 11)
    d.text((76, 206), "$k$", "good", "end")
    d.line((162, 142), (162, 190), "velocity")
    d.line((150, 190), (174, 190), "velocity bold")
    d.path([(146, 172), (146, 222), (178, 222), (178, 172)], "velocity")
    d.line((162, 222), (162, 258), "velocity")
    d.text((190, 206), "$c = d h k$", "velocity", "start")
    d.text((130, 304), "between the two surfaces", "soft", size="small")

    gaps = (-1.0, -0.78, -0.32)
    f = Frame((400, 66), 120, 150)
    d.line((340, 66), (690, 66), "faint")
    d.text((345, 58), "$g = 0$", "soft", "start", "small")
    names = ("$g_{n−1}$", "$g_n$", "$g_{n+1}$")
    d.path([f(k, g) for k, g in enumerate(gaps)], "ink thin dash")
    d.line(f(1, gaps[1]), f(2, gaps[2]), "velocity bold")
    for k, g in enumerate(gaps):
        d.line(f(k, 0), f(k, g), "good dots")
        d.dot(f(k, g), "ink", 7)
        d.text((f(k, g)[0] + (4 if k < 2 else 12), f(k, g)[1] + 28), names[k], "ink")
        d.text((f(k, 0)[0], 48), ("¼", "½", "¼")[k], "good")
    at = between(f(1, gaps[1]), f(2, gaps[2]))
    d.text((at[0] + 16, at[1] + 14), "slope $u′$", "velocity", "start")
    d.text((330, 274), "The spring sees $(g_{n−1} + 2g_n + g_{n+1})/4$,", "good", "start")
    d.text((330, 302), "the damper the new velocity $u′ = (g_{n+1} − g_n)/h$.", "velocity", "start")
    d.text((524, 24), "gaps of three steps, and their weights", "soft", size="small")
    return d


def decay() -> Drawing:
    """The roots of (3.14) for a stiff contact, and the gap that they give from -1, at rest before the first step."""
    d = Drawing(330, "How a violation dies out for several d: as a curve over steps, and as roots in the unit circle")
    choices = ((0.5, "impulse"), (2, "good"), (5, "velocity"), (20, "gold"))
    f = Frame((60, 130), 19.5, 100)
    d.arrow((60, 130), (420, 130), "soft thin")
    d.line((60, 250), (60, 38), "soft thin")
    d.text((420, 152), "steps", "soft", "end", "small")
    d.text((52, 236), "−1", "soft", "end", "small")
    d.text((52, 135), "0", "soft", "end", "small")
    d.text((70, 44), "gap", "soft", "start", "small")
    for value, colour in choices:
        gaps = [-1.0, -1.0]
        while len(gaps) < 19:  # (1+4d) g'' + (2-4d) g' + g = 0, the spring's mean and the damper's slope
            gaps.append(-((2 - 4 * value) * gaps[-1] + gaps[-2]) / (1 + 4 * value))
        points = [f(k, g) for k, g in enumerate(gaps[1:])]
        d.path(points, f"{colour} thin")
        for point in points:
            d.dot(point, colour, 3.2)
    for k, (value, colour) in enumerate(choices):
        d.dot((84 + 84 * k, 286), colour, 5)
        d.text((94 + 84 * k, 292), f"$d = {value:g}$", colour, "start")
    centre, radius = (575, 150), 105
    d.circle(centre, radius, "faint bold")
    d.line((centre[0] - 118, centre[1]), (centre[0] + 118, centre[1]), "faint thin")
    d.line((centre[0], centre[1] - 118), (centre[0], centre[1] + 118), "faint thin")
    for value, colour in choices:
        beta, alpha = 1 - 2 * (value + 1) / (1 + 4 * value), 1 - 4 * value / (1 + 4 * value)
        for sign in (1, -1):
            root = beta + sign * cmath.sqrt(beta * beta - alpha)
            d.dot((centre[0] + radius * root.real, centre[1] - radius * root.imag), colour, 6)
    d.text((centre[0], 292), "the two roots $z$ of each", "soft")
    d.text((centre[0] + 84, centre[1] - 88), "$|z| = 1$", "soft", "start", "small")
    d.text((250, 318), "the linear equation; a contact lets go where its gap is above 0", "soft", size="small")
    return d
