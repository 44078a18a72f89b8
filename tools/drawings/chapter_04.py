"""Chapter 04: a row's two bodies, an impulse that climbs a stack, and sweeps in the plane of two impulses."""

import math

from pen import Drawing, Frame, between


def gather_and_scatter() -> Drawing:
    d = Drawing(318, "A row gathers the velocities of its two bodies, finds its new impulse, and scatters the change")
    d.text((700, 40), "one $V$ a body", "soft", "end", "small")
    bodies = ("0", "1", "2", "3", "4", "5")
    i, j = 1, 4
    for k, name in enumerate(bodies):
        mine = k in (i, j)
        d.box((40 + 110 * k, 48), 90, 46, "velocity fill" if mine else "faint fill", 6)
        d.text((85 + 110 * k, 77), f"$V_{name}$", "velocity" if mine else "soft")
    d.box((190, 190), 340, 56, "body fill", 8)
    d.text((360, 224), "row $k$:  $G_i, G_j, B, Σ, S_{kk}, λ$", "ink")
    for k, side in ((i, -1), (j, 1)):
        x = 85 + 110 * k
        d.arrow((x - 14, 98), (x - 14 - 22 * side, 184), "velocity")
        d.arrow((x + 14 - 22 * side, 186), (x + 14, 98), "impulse")
    d.text((148, 148), "gather", "velocity", "end")
    d.text((250, 148), "scatter", "impulse", "start")
    d.text((440, 148), "gather", "velocity", "end")
    d.text((566, 148), "scatter", "impulse", "start")
    d.text((195, 40), "body $i$", "velocity")
    d.text((525, 40), "body $j$", "velocity")
    for x, number, label, colour in ((40, "1", "$r = B − G_i V_i − G_j V_j − Σλ$", "velocity"),
                                     (314, "2", "$λ ← clamp(λ + r/S_{kk})$", "ink"),
                                     (524, "3", "$V_i$ += $M_i^{−1}G_i^T Δλ$", "impulse")):
        d.circle((x, 284), 11, colour)
        d.text((x, 289), number, colour, size="small")
        d.text((x + 20, 290), label, colour, "start", "small")
    return d


def impulse_climbs() -> Drawing:
    """Five equal spheres at rest, from λ = 0, rows in the order from the top down; each sweep's impulses."""
    d = Drawing(340, "In the order from the top down the ground's impulse climbs one contact in a sweep")
    count, floor, size = 5, 276, 46
    impulses = [0.0] * count
    for sweep in range(count + 1):
        x = 70 + 116 * sweep
        for k in reversed(range(count)) if sweep else ():
            above = impulses[k + 1] if k + 1 < count else 0.0
            below = impulses[k - 1] if k else 0.0
            # On the ground S_kk = 1 and B = 1; above, S_kk = 2 and B = 0; neighbours have S_kl = -1.
            impulses[k] = 1 + above if k == 0 else (above + below) / 2
        for k in range(count):
            pushed = impulses[k] > 0
            d.circle((x, floor - size * (k + 0.5)), size / 2, "impulse fill" if pushed else "body fill")
        for k, value in enumerate(impulses):
            if value > 0:
                d.bar((x + 26, floor - size * k - 5), max(3, 14 * value), 10, "impulse")
        d.line((x - 30, floor), (x + 30, floor), "ink bold")
        d.text((x, floor + 24), f"after {sweep}" if sweep else "at first", "soft", size="small")
    d.text((360, 328), "bars: the impulse of each contact so far; orange: spheres that are held at all", "soft",
           size="small")
    return d


def plane_of_impulses() -> Drawing:
    """Two rows, S = (1 0.6; 0.6 1): each update ends in the valley of its own row, along its own axis."""
    d = Drawing(368, "Sweeps in the plane of two impulses: to where both rows are satisfied, or along a bound")
    S = ((1.0, 0.6), (0.6, 1.0))
    for left, B, title in ((50, (1.25, 1.15), "both contacts push"), (410, (1.25, 0.6), "one of them lets go")):
        f = Frame((left, 272), 178)
        det = S[0][0] * S[1][1] - S[0][1] ** 2
        best = ((B[0] * S[1][1] - B[1] * S[0][1]) / det, (B[1] * S[0][0] - B[0] * S[1][0]) / det)
        d.box(f(0, 1.2), 178 * 1.52, 178 * 1.2, "faint fill")
        _levels(d, f, S, best)
        d.arrow(f(0, 0), f(1.6, 0), "soft thin")
        d.arrow(f(0, 0), f(0, 1.3), "soft thin")
        d.text((f(1.6, 0)[0] + 2, 296), "$λ_1$", "soft", "end")
        d.text((f(0, 1.3)[0] - 8, f(0, 1.3)[1] + 10), "$λ_2$", "soft", "end")
        for row, colour in ((0, "velocity"), (1, "pair")):
            _valley(d, f, S[row], B[row], f"row {row + 1}", colour)
        way = [(0.0, 0.0)]
        for k in range(6):
            row, at = k % 2, way[-1]
            new = max(0.0, (B[row] - S[row][1 - row] * at[1 - row]) / S[row][row])
            way.append((new, at[1]) if row == 0 else (at[0], new))
        for k, (start, end) in enumerate(zip(way, way[1:])):
            if abs(start[0] - end[0]) + abs(start[1] - end[1]) > 0.06:
                d.arrow(f(*start), f(*end), "impulse bold" if k < 2 else "impulse")
        d.dot(f(0, 0), "ink", 5)
        if best[1] > 0:
            d.dot(f(*best), "good", 7)
            d.text((f(*best)[0] - 12, f(*best)[1] + 20), "solution", "good", "end", "small")
        else:
            d.dot(f(B[0], 0), "good", 7)
            d.dot(f(*best), "soft", 5)
            d.text((f(B[0], 0)[0] + 2, f(B[0], 0)[1] - 14), "solution", "good", "start", "small")
            d.text((f(*best)[0] - 12, f(*best)[1] + 20), "the lines meet at $λ_2 < 0$: a pull", "soft", "end", "small")
        d.text((f(0.76, 0)[0], 26), title, "ink")
    return d


def _levels(d: Drawing, f: Frame, S, best) -> None:
    """Draws lines of equal E of Eq. (10.9), inside the bounds and the card."""
    for size in (0.25, 0.5, 0.8, 1.15, 1.55):
        piece = []
        for k in range(181):
            # Along the eigenvectors of S, (1, 1) and (1, -1).
            u = size * math.cos(2 * math.pi * k / 180) / math.sqrt(S[0][0] + S[0][1])
            v = size * math.sin(2 * math.pi * k / 180) / math.sqrt(S[0][0] - S[0][1])
            x, y = best[0] + (u + v) / math.sqrt(2), best[1] + (u - v) / math.sqrt(2)
            if 0 <= x <= 1.52 and 0 <= y <= 1.2:
                piece.append(f(x, y))
            elif piece:
                d.path(piece, "faint thin")
                piece = []
        if piece:
            d.path(piece, "faint thin")


def _valley(d: Drawing, f: Frame, row, B: float, name: str, colour: str) -> None:
    """Returns the line on which a row is satisfied, inside the card."""
    inside = [(x, y) for x, y in ((k / 200, (B - row[0] * k / 200) / row[1]) for k in range(305)) if -0.32 <= y <= 1.2]
    d.path([f(*inside[0]), f(*inside[-1])], colour)
    at = f(*between(inside[0], inside[-1], 0.08))
    d.text((at[0] + 12, at[1] + 4), name, colour, "start", "small")
