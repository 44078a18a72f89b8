"""Chapter 07: the impulses of an impact, in the plane of normal and slip, and an impact on two balls."""

from pen import Drawing, Frame


def stick_and_slide() -> Drawing:
    """A solid sphere on a plane, where K is 7/2 along the slip and 1 along n; e = 0.5, μ = 0.5, approach 1."""
    d = Drawing(372, "The impulse that sticks is taken if it is in the cone; else the impulse on the cone's edge")
    K_t, friction, e = 3.5, 0.5, 0.5
    J_n = 1 + e
    for middle, slip, title in ((196, 1.3, "a slow slip: it sticks"), (556, 3.6, "a fast slip: it slides")):
        f = Frame((middle, 316), 128)
        _cone(d, f, friction, 1.78)
        d.line(f(-1.4, J_n), f(0.85, J_n), "velocity dash")
        stick = -slip / K_t
        d.line(f(stick, 0.12), f(stick, 1.72), "pair dash")
        inside = abs(stick) <= friction * J_n
        chosen = stick if inside else -friction * J_n
        if not inside:
            d.arrow(f(stick, J_n), f(chosen - 0.03, J_n), "pair bold")
        d.arrow(f(0, 0), f(chosen, J_n), "impulse bold")
        d.dot(f(stick, J_n), "pair", 6)
        d.dot(f(chosen, J_n), "impulse", 6)
        d.text((f(chosen, J_n)[0] + 12, f(chosen, J_n)[1] - 10), "$J$", "impulse", "start")
        d.text((f(stick, 0)[0] + (4 if inside else 0), f(stick, 0)[1] + 20), "slip ends", "pair", "middle", "small")
        d.text((middle, 28), title, "ink")
        if inside:
            d.text((f(-1.4, J_n)[0], f(-1.4, J_n)[1] + 22), "restitution $e$", "velocity", "start", "small")
    return d


def _cone(d: Drawing, f: Frame, friction: float, height: float) -> None:
    d.path([f(-friction * height, height), f(0, 0), f(friction * height, height)], "good fill")
    d.arrow(f(-1.2, 0), f(1.2, 0), "soft thin")
    d.arrow(f(0, 0), f(0, height + 0.12), "soft thin")
    d.text((f(1.2, 0)[0], f(0, 0)[1] + 22), "$J_t$", "soft", "end")
    d.text((f(0, height)[0] + 12, f(0, height)[1] + 4), "$J_n$", "soft", "start")
    d.text((f(0.5 * friction * height, 0)[0] + 12, f(0, 0.5 * height)[1] + 14), "$|J_t| = μJ_n$", "good", "start",
           "small")


def one_after_the_other() -> Drawing:
    """Three equal balls in a row, e = 1: (7.13), and what all contacts at once would give."""
    d = Drawing(330, "A ball hits two that touch: pair by pair the last one flies off, at once all three move")
    rows = ((66, "before", (1.0, 0.0, 0.0), "ink"), (172, "pair by pair", (0.0, 0.0, 1.0), "good"),
            (270, "all at once", (-1 / 3, 2 / 3, 2 / 3), "impulse"))
    for y, title, speeds, colour in rows:
        for k, speed in enumerate(speeds):
            x = 200 + 58 * k - (62 if title == "before" and k == 0 else 0)
            d.circle((x, y), 28, "body fill")
            if speed:
                d.arrow((x, y), (x + 88 * speed, y), "velocity bold")
            value = {1.0: "$v$", 0.0: "$0$"}.get(speed, "$−v/3$" if speed < 0 else "$2v/3$")
            d.text((x, y - 36), value, "velocity", size="small")
        d.text((98, y + 5), title, colour, "end")
    d.text((478, 166), "the toy does this: an impact of\n1 and 2, then one of 2 and 3", "good", "start", "small")
    d.text((478, 254), "both contacts with $e = 1$ in one\nsystem: as much momentum,\nas much energy", "impulse",
           "start", "small")
    return d


def no_energy_gained() -> Drawing:
    """(7.7) for a body whose K couples: e = 0.5, μ = 0.5, slip 1, approach 1."""
    d = Drawing(352, "An impulse without friction, P, and one that stops everything, Q, make one that adds no energy")
    K = ((2.2, 1.0), (1.0, 1.6))
    friction, e = 0.5, 0.5
    det = K[0][0] * K[1][1] - K[0][1] ** 2
    P = (0.0, 1 / K[1][1])
    Q = (-(K[1][1] + K[0][1]) / det, (K[0][1] + K[0][0]) / det)
    D = (Q[0] - P[0], Q[1] - P[1])
    base = (1 + e) * P[1]
    kappa = friction * base / (abs(D[0]) - friction * D[1])
    J = (kappa * D[0], base + kappa * D[1])
    f = Frame((255, 312), 165)
    _cone(d, f, friction, 1.6)
    d.line(f(0.35, base - 0.35 * D[1] / -D[0]), f(1.22 * D[0], base + 1.22 * D[1]), "velocity dash")
    d.line(f(0.35, P[1] - 0.35 * D[1] / -D[0]), f(1.25 * D[0], P[1] + 1.25 * D[1]), "soft thin dash")
    d.arrow(f(0, 0), f(*P), "ink bold")
    d.arrow(f(*P), f(*Q), "pair")
    d.arrow(f(0, base), f(*J), "pair bold")
    d.arrow(f(0, 0), f(*J), "impulse bold")
    d.dot(f(*Q), "pair", 6)
    d.dot(f(0, base), "ink", 5)
    d.dot(f(*J), "impulse", 6)
    d.text((f(*P)[0] + 10, f(*P)[1] + 14), "$P$", "ink", "start")
    d.text((f(0, base)[0] + 10, f(0, base)[1] + 10), "$(1+e)P$", "ink", "start")
    d.text((f(*Q)[0] - 10, f(*Q)[1] + 20), "$Q$", "pair", "end")
    d.text((f(*J)[0] - 6, f(*J)[1] - 12), "$J$", "impulse", "end")
    d.text((450, 66), "$P$ stops the approach, without friction.", "ink", "start", "small")
    d.text((450, 94), "$Q$ stops everything.", "pair", "start", "small")
    d.text((450, 130),
           "From $(1+e)P$ go along $Q − P$,\nas far as the cone lets you: $κ(Q − P)$.", "impulse", "start", "small")
    d.text((450, 188),
           "All the way the restitution is $e$:\nblue is the line $n·KJ = −(1+e)u·n$.", "velocity", "start", "small")
    d.text((450, 246), "It leans, for here $K$ couples:\nwhat stops the slip lifts, too.", "soft", "start", "small")
    return d
