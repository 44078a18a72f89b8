"""Chapter 10: impulses in a stack after sweeps up and down, and steps along conjugate directions."""

import math

import numpy as np

from pen import Drawing, Frame


def sweeps_up_and_down() -> Drawing:
    """Five equal spheres on the ground, from λ = 0: rows k = 0 ... 4 from the ground, each sweep's impulses."""
    d = Drawing(396, "Impulses in a stack: the first sweep up reaches the top, sweeps down climb one contact each")
    count, floor, size, wide = 5, 316, 52, 42  # pixels for an impulse of hmg
    for k in range(count):
        d.circle((74, floor - size * (k + 0.5)), size / 2, "body fill")
        d.dot((74, floor - size * k), "impulse", 4)
        d.text((22, floor - size * k + 5), str(k), "impulse", size="small")
    d.line((38, floor), (112, floor), "ink bold")
    for left, upwards in ((160, True), (450, False)):
        d.text((left + 110, 30), "sweeps up" if upwards else "sweeps down", "ink")
        d.arrow((left - 16, floor if upwards else 84), (left - 16, 84 if upwards else floor), "soft")
        d.path([(left + wide * (count - k), floor - size * k) for k in range(count)], "good bold")
        d.line((left, floor + 14), (left, 84), "soft thin")
        d.arrow((left, floor + 14), (left + 5.4 * wide, floor + 14), "soft thin")
        for n, state in enumerate(_sweeps(count, upwards, 8)):
            if n + 1 not in (1, 2, 3, 8):
                continue
            points = [(left + wide * value, floor - size * k) for k, value in enumerate(state)]
            d.path(points, "impulse" if n else "impulse bold")
            for point in points:
                d.dot(point, "impulse", 4)
            d.text((points[0][0], floor + 32), str(n + 1), "impulse", size="small")
        d.text((left + 5.4 * wide, floor + 34), "$λ$", "soft", "end")
        d.text((left + wide * 2.6 + 16, floor - size * 2.4 - 8), "the answer", "good", "start", "small")
    d.text((360, 380), "orange: the impulse of each contact after 1, 2, 3 and 8 sweeps from nothing", "soft", size="small")
    return d


def _sweeps(count: int, upwards: bool, sweeps: int) -> list[list[float]]:
    """Returns λ in units of hmg, after each sweep; row k is below body k."""
    impulses, states = np.zeros(count), []
    for _ in range(sweeps):
        for k in range(count) if upwards else reversed(range(count)):
            above = impulses[k + 1] if k + 1 < count else 0.0
            below = impulses[k - 1] if k else 0.0
            # On the ground S_kk = 1 and B = 1; above, S_kk = 2, B = 0; neighbours have S_kl = -1.
            impulses[k] = 1 + above if k == 0 else (above + below) / 2
        states.append(list(impulses))
    return states


def conjugate_directions() -> Drawing:
    """One system of two rows, solved by sweeps, and by conjugate gradients without a preconditioner."""
    d = Drawing(318, "Sweeps go to and fro in a long valley; conjugate directions reach its bottom in two steps")
    S, best = np.array([[1.0, 0.86], [0.86, 1.0]]), np.array([0.0, 0.0])
    start = np.array([-1.12, 0.68])
    for middle, title in ((185, "sweeps"), (540, "conjugate gradients")):
        f = Frame((middle, 165), 88)
        for level in (0.02, 0.07, 0.15, 0.26):
            d.curve(lambda a, f=f, level=level: f(*_level(S, level, a)), 0, 2 * math.pi, "faint thin")
        way = [start]
        if title == "sweeps":
            for k in range(16):
                at = way[-1].copy()
                row = k % 2
                at[row] = -S[row][1 - row] * at[1 - row] / S[row][row]
                way.append(at)
        else:
            lacks = -S @ start
            along = lacks
            for _ in range(2):
                step = lacks @ along / (along @ S @ along)
                way.append(way[-1] + step * along)
                fresh = lacks - step * S @ along
                along = fresh + (fresh @ fresh) / (lacks @ lacks) * along
                lacks = fresh
        for a, b in zip(way, way[1:]):
            style = "impulse" if title == "sweeps" else "velocity bold"
            (d.arrow if np.linalg.norm(a - b) > 0.12 else d.line)(f(*a), f(*b), style)
        d.dot(f(*start), "ink", 5)
        d.dot(f(*best), "good", 7)
        d.text((middle, 28), title, "ink")
    d.text((185, 306), "each step along an axis spoils the last", "soft", size="small")
    d.text((540, 306), "$p·Sp′ = 0$: the second spoils nothing", "soft", size="small")
    return d


def _level(S: np.ndarray, level: float, angle: float) -> tuple[float, float]:
    """Draws ½ λ·Sλ = level, along the eigenvectors (1, 1) and (1, -1)."""
    u = math.sqrt(2 * level / (S[0, 0] + S[0, 1])) * math.cos(angle)
    v = math.sqrt(2 * level / (S[0, 0] - S[0, 1])) * math.sin(angle)
    return (u + v) / math.sqrt(2), (u - v) / math.sqrt(2)
