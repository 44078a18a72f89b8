"""Chapter 07: the impulses of an impact, in the plane of normal and slip."""

from pen import Drawing, Frame


def stick_and_slide() -> Drawing:
    """A solid sphere on a plane, where K is 7/2 along the slip and 1 along n; e = 0.5, μ = 0.5, approach 1."""
    d = Drawing(356, "The impulse that sticks is taken if it is in the cone; else the impulse on the cone's edge")
    K_t, friction, e = 3.5, 0.5, 0.5
    for middle, slip, title in ((178, 1.3, "a slow slip: it sticks"), (548, 3.6, "a fast slip: it slides")):
        f = Frame((middle, 322), 140)
        _cone(d, f, friction, 1.78)
        J_n = 1 + e
        d.line(f(-1.16, J_n), f(0.95, J_n), "velocity dash")
        d.text((f(0.95, J_n)[0] + 4, f(0.95, J_n)[1] - 9), "restitution $e$", "velocity", "end", "small")
        stick = -slip / K_t
        d.line(f(stick, 0.35), f(stick, 1.72), "pair dash")
        inside = abs(stick) <= friction * J_n
        chosen = stick if inside else -friction * J_n
        d.arrow(f(0, 0), f(chosen, J_n), "impulse bold")
        d.dot(f(stick, J_n), "pair", 6)
        d.dot(f(chosen, J_n), "impulse", 6)
        d.text((f(chosen, J_n)[0] - 8, f(chosen, J_n)[1] - 14), "$J$", "impulse", "end")
        d.text((f(stick, 0.35)[0] - 4, f(stick, 0.35)[1] + 20), "no slip", "pair", "end" if inside else "middle",
               "small")
        d.text((middle, 28), title, "ink")
    return d


def _cone(d: Drawing, f: Frame, friction: float, height: float) -> None:
    d.path([f(-friction * height, height), f(0, 0), f(friction * height, height)], "good fill")
    d.arrow(f(-1.2, 0), f(1.2, 0), "soft thin")
    d.arrow(f(0, 0), f(0, height + 0.12), "soft thin")
    d.text((f(1.2, 0)[0], f(0, 0)[1] + 22), "$J_t$", "soft", "end")
    d.text((f(0, height)[0] + 12, f(0, height)[1] + 4), "$J_n$", "soft", "start")
    d.text(f(0.62 * friction * height + 0.26, 0.62 * height - 0.25), "$|J_t| = μJ_n$", "good", "start", "small")


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
