"""Chapter 09: the shapes of three friction laws, a rod that jams or cycles, and five balls."""

import math

from pen import Drawing, Frame, View, between, turned


def box_disc_cone() -> Drawing:
    d = Drawing(330, "The box of chapter 05, whatever presses; the disc of one normal impulse; the cone of all of them")
    f = Frame((120, 150), 74)
    d.path([f(1, 1), f(1, -1), f(-1, -1), f(-1, 1)], "impulse fill", closed=True)
    _axes(d, f)
    d.text((120, 282), "box", "ink")
    d.text((120, 306), "its size: a guess", "soft", size="small")
    f = Frame((355, 150), 74)
    d.circle(f(0, 0), 74, "impulse fill")
    _axes(d, f)
    d.arrow(f(0, 0), f(1.05, 0.78), "soft thin")
    d.dot(f(1.05, 0.78), "soft", 5)
    scale = 1 / math.hypot(1.05, 0.78)
    d.arrow(f(1.05, 0.78), f(1.05 * scale, 0.78 * scale), "impulse")
    d.dot(f(1.05 * scale, 0.78 * scale), "impulse", 5)
    d.text((f(1.05, 0.78)[0] + 10, f(1.05, 0.78)[1] - 4), "too much:\nshortened", "soft", "start", "small")
    d.text((355, 282), "disc of radius $Λ = μλ_n$", "ink")
    d.text((355, 306), "for one $λ_n$", "soft", size="small")
    view = View((590, 240), 112, 40, 22)
    rim = [view(0.62 * math.cos(a / 30 * math.pi), 0.62 * math.sin(a / 30 * math.pi), 1.35) for a in range(60)]
    left, right = min(rim), max(rim)
    d.path([left, view(0, 0, 0), right], "impulse fill")
    d.path(rim, "impulse fill", closed=True)
    part = 0.55
    ring = [view(0.62 * part * math.cos(a / 30 * math.pi), 0.62 * part * math.sin(a / 30 * math.pi), 1.35 * part)
            for a in range(60)]
    d.path(ring, "impulse", closed=True)
    d.arrow(view(0, 0, 0), view(0, 0, 1.72), "good")
    d.text((view(0, 0, 1.72)[0] + 12, view(0, 0, 1.72)[1] + 14), "$λ_n$", "good", "start")
    d.arrow(view(0, 0, 0), view(0.8, 0, 0), "soft thin")
    d.arrow(view(0, 0, 0), view(0, 0.8, 0), "soft thin")
    d.text((view(0.8, 0, 0)[0] - 12, view(0.8, 0, 0)[1] + 6), "$λ_1$", "soft", "end")
    d.text((view(0, 0.8, 0)[0] + 8, view(0, 0.8, 0)[1] + 8), "$λ_2$", "soft", "start")
    d.text((590, 282), "cone", "ink")
    d.text((590, 306), "more presses, more rubs", "soft", size="small")
    return d


def _axes(d: Drawing, f: Frame) -> None:
    d.arrow(f(-1.3, 0), f(1.4, 0), "soft thin")
    d.arrow(f(0, -1.3), f(0, 1.4), "soft thin")
    d.text((f(1.4, 0)[0] + 2, f(0, 0)[1] + 22), "$λ_1$", "soft")
    d.text((f(0, 1.4)[0] - 8, f(0, 1.4)[1] + 10), "$λ_2$", "soft", "end")


def leaning_rod() -> Drawing:
    d = Drawing(340, "A rod whose end is pushed ahead of it is pressed down by friction; dragged behind, it is lifted")
    ground = 244
    for foot, lean, turn, title, told in (
            (190, 63.4, (-58, 28), "its end is pushed ahead", "friction presses it down: $ρ > 0$, it may jam"),
            (540, 116.6, (16, 98), "its end is dragged behind", "friction lifts it: $ρ < 0$, sweeps may cycle")):
        at, side = (foot, ground), 1 if lean < 90 else -1
        top = turned(at, 200, lean)
        middle = between(at, top)
        d.line((foot - 90, ground), (foot + 90, ground), "soft")
        d.line(at, top, "body bold")
        d.dot(middle, "body", 7)
        d.arrow(middle, (middle[0] - 66, middle[1]), "velocity")
        d.text((middle[0] - 74, middle[1] + 5), "$v$", "velocity", "end")
        d.arrow(at, (foot, ground - 84), "good bold")
        d.text((foot - 14 * side, ground - 68), "$n$", "good", "end" if side > 0 else "start")
        d.arrow(at, (foot + 62, ground), "impulse bold")
        d.text((foot + 34, ground + 24), "friction", "impulse", size="small")
        d.text((foot, 298), title, "ink")
        d.text((foot, 324), told, "soft", size="small")
        d.arc(at, 30, *((0, lean) if side > 0 else (lean, 180)), "ink")
        d.text((foot + 44 * side, ground - 20), "$θ$", "ink", "middle", "small")
        # Friction at the foot, towards the right, turns either rod counterclockwise.
        d.arc(middle, 56, *turn, "impulse", arrow=True)
    return d


def five_balls() -> Drawing:
    """A cut through two lower balls that face each other across the square, and the one on top."""
    d = Drawing(338, "Five balls in a pyramid: the line between a lower ball's contacts is 22.5° off the normal")
    f = Frame((235, 284), 72)
    half = math.sqrt(2)  # the lower balls' centres, from the middle, for a radius of 1
    for x, y in ((-half, 1), (half, 1), (0, 1 + half)):
        d.circle(f(x, y), 72, "body fill")
        d.dot(f(x, y), "body", 3)
    d.line((50, 284), (420, 284), "soft bold")
    upper = (half / 2, 1 + half / 2)
    d.line(f(half, 0), f(*upper), "impulse bold")
    d.line(f(half, 0), f(half, 1.5), "good dash")
    d.dot(f(half, 0), "impulse", 6)
    d.dot(f(*upper), "impulse", 6)
    d.arc(f(half, 0), 78, 90, 112.5, "ink")
    d.text((f(half, 0)[0] - 14, f(half, 0)[1] - 84), "$22.5°$", "ink", "end", "small")
    d.line(f(half, 1), f(0, 1 + half), "soft thin dash")
    d.text((f(half, 1.5)[0] + 12, f(half, 1.5)[1] + 6), "$n$", "good", "start")
    d.text((480, 92),
           "A lower ball is touched twice.\nNo torque turns it if the two\nimpulses are along the line\n"
           "between its contacts.", "ink", "start")
    d.text((480, 200), "This line must be in the cone\nof friction: $μ ≥ tan 22.5°$", "impulse", "start")
    d.text((240, 322), "a cut through opposite balls", "soft", size="small")
    return d
