"""Chapter 10: impulses in a stack after sweeps up and down, and steps along conjugate directions."""

import math

import numpy as np

from pen import Drawing, Frame


def sweeps_up_and_down() -> Drawing:
    """Five equal spheres on the ground, from λ = 0: rows k = 0 ... 4 from the ground, each sweep's impulses."""
    d = Drawing(396, "What each contact of a stack pushes after sweeps up and after sweeps down, from nothing")
    count = 5
    floor, size = 318, 50
    for k in range(count):
        d.circle((84, floor - size * (k + 0.5)), size / 2, "body fill")
    d.line((30, floor), (138, floor), "ink bold")
    d.text((84, 350), "five equal\nspheres", "soft", size="small")
    for left, upwards in ((190, True), (462, False)):
        d.text((left + 105, 34), "sweeps up" if upwards else "sweeps down", "ink")
        d.arrow((left - 16, floor - 40 if upwards else 84), (left - 16, 84 if upwards else floor - 10), "impulse")
        states = _sweeps(count, upwards, 3)
        for n, state in enumerate(states):
            x = left + 76 * n
            for k, value in enumerate(state):
                y = floor - size * k - 9
                if value > 1e-9:
                    d.bar((x, y), 62 * value / 5, 16, "impulse")
                d.box((x, y), 62 * (count - k) / 5, 16, "good")
            d.text((x + 31, 350), f"after {n + 1}", "soft", size="small")
    d.text((437, 384), "bars: impulses so far; frames: what each contact must carry in the end", "soft", size="small")
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
