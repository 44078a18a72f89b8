"""Chapter 11: patterns of S and of its factors, a bound that stiffens, the way from within, and a step along it."""

import math

import numpy as np

from pen import Drawing, Frame

_ROWS = 7


def patterns() -> Drawing:
    """Rows are links; two of them have an entry in S if they share a dynamic body. L by elimination in order."""
    d = Drawing(400, "A wire, a ring and a hub: how their links meet, the pattern of S, and that of its factor L")
    scenes = (("wire", [(k, k + 1) for k in range(_ROWS - 1)]),
              ("ring", [(k, (k + 1) % _ROWS) for k in range(_ROWS)]),
              ("hub", [(k, n) for k in range(_ROWS) for n in range(k)]))
    for column, (name, pairs) in enumerate(scenes):
        middle = 130 + 230 * column
        _scene(d, name, middle, 84)
        S = np.eye(_ROWS, dtype=bool)
        for k, n in pairs:
            S[k, n] = S[n, k] = True
        L = S.copy()
        for k in range(_ROWS):
            below = [n for n in range(k + 1, _ROWS) if L[n, k]]
            for a in below:
                for b in below:
                    L[a, b] = True
        _pattern(d, (middle - 100, 196), S, S, False)
        _pattern(d, (middle + 8, 196), L, S, True)
        d.text((middle - 54, 318), "$S$", "ink")
        d.text((middle + 54, 318), "$L$", "ink")
        d.text((middle, 178), name, "ink")
    d.bar((206, 352), 12, 12, "body")
    d.text((226, 363), "an entry of $S$", "soft", "start", "small")
    d.bar((380, 352), 12, 12, "impulse")
    d.text((400, 363), "filled in by elimination", "soft", "start", "small")
    return d


def _scene(d: Drawing, name: str, x: float, y: float) -> None:
    if name == "wire":
        places = [(x - 88 + 25 * k, y + 8 * math.sin(k)) for k in range(_ROWS + 1)]
        links = list(zip(places, places[1:]))
    else:
        places = [(x + 52 * math.cos(2 * math.pi * k / _ROWS), y - 52 * math.sin(2 * math.pi * k / _ROWS))
                  for k in range(_ROWS)]
        links = list(zip(places, places[1:] + places[:1])) if name == "ring" else [((x, y), p) for p in places]
    for a, b in links:
        d.line(a, b, "impulse")
    for p in places:
        d.dot(p, "body", 6)
    if name == "hub":
        d.dot((x, y), "body", 10)
    if name == "wire":
        d.line((places[0][0], y - 16), (places[0][0], y + 16), "soft bold")


def _pattern(d: Drawing, corner, filled, original, lower: bool) -> None:
    cell = 13
    d.box((corner[0] - 3, corner[1] - 3), cell * _ROWS + 4, cell * _ROWS + 4, "faint thin")
    for k in range(_ROWS):
        for n in range(k + 1 if lower else _ROWS):
            if filled[k, n]:
                d.bar((corner[0] + cell * n, corner[1] + cell * k), 11, 11, "body" if original[k, n] else "impulse")


def bound_that_stiffens() -> Drawing:
    """One row with a lower bound at 0: its residual and the bound's push, z = τ/s, for three τ."""
    d = Drawing(340, "A bound pushes more the nearer it is; as τ fades, it pushes only where it is touched")
    f = Frame((90, 290), 105, 82)
    d.box((20, 30), 70, 260, "faint fill")
    d.line(f(0, 0), f(0, 3.15), "ink bold")
    d.arrow(f(-2 / 3, 0), f(3.35, 0), "soft thin")
    d.text((f(3.35, 0)[0], 316), "$s = λ − lo$, the room to the bound", "soft", "end", "small")
    d.text((f(0, 3.15)[0] + 4, 24), "$z$, its push", "soft", "start", "small")
    for tau, colour in ((1.0, "impulse"), (0.3, "gold"), (0.05, "good")):
        d.curve(lambda s, tau=tau: f(s, tau / s), max(tau / 3.0, 0.01), 3.2, f"{colour} bold")
    d.text((f(1.75, 0.57)[0], f(0, 0.72)[1]), "$s z = τ$", "impulse", "start")
    d.text((f(0.78, 0.4)[0] + 2, f(0, 0.46)[1]), "smaller $τ$", "gold", "start", "small")
    d.text((f(0, 0)[0] - 8, f(0, 1.9)[1]), "$τ → 0$", "good", "end", "small")
    d.text((f(0, 0)[0], 316), "$lo$", "ink")
    d.spring((500, 92), (620, 92), "impulse", 7, 10)
    d.line((500, 70), (500, 114), "ink bold")
    d.dot((630, 92), "body", 11)
    d.text((470, 150),
           "A Newton step sees the bound as\na spring beside the row's own $Σ$,\n"
           "of $z/s$, which is added to $S_{kk}$:", "ink", "start", "small")
    d.text((470, 230), "the nearer the bound, the larger,\nand the less does $λ$ move.", "impulse", "start", "small")
    return d


def way_from_within() -> Drawing:
    """Two rows, 0 <= λ <= 1; the points at which all s z are τ, as τ goes to 0."""
    d = Drawing(350, "The central path leads through the inside of the bounds to the solution at one of them")
    S, B = np.array([[1.0, 0.6], [0.6, 1.0]]), np.array([1.45, 0.85])
    f = Frame((70, 290), 235)
    d.box(f(0, 1), 235, 235, "faint fill")
    d.text((f(0, 0)[0], 314), "$lo$", "soft")
    d.text((f(1, 0)[0], 314), "$hi$", "soft")
    d.text((f(0.5, 0)[0], 318), "$λ_1$", "ink")
    d.text((44, f(0, 0.5)[1]), "$λ_2$", "ink", "end")
    at, path = np.array([0.5, 0.5]), []
    for k in range(61):
        tau = 3.0 * 10 ** (-5 * k / 60)
        for _ in range(60):
            low, high = at, 1 - at
            slope = B - S @ at + tau / low - tau / high
            step = np.linalg.solve(S + np.diag(tau / low**2 + tau / high**2), slope)
            reach = min([1.0, *(0.99 * (-at[n] / step[n] if step[n] < 0 else (1 - at[n]) / step[n])
                                for n in range(2) if step[n])])
            at = at + reach * step
        path.append(f(*at))
    d.path(path, "good bold")
    for k, name in ((0, "large $τ$: the middle"), (24, ""), (36, ""), (60, "$τ → 0$: the solution")):
        d.dot(path[k], "good", 6)
        if name:
            d.text((path[k][0] - (0 if k == 0 else 12), path[k][1] + (-14 if k == 0 else 24)), name, "good",
                   "middle" if k == 0 else "end", "small")
    d.text((370, 92),
           "Guessing which rows are at a bound means\nwalking from corner to corner of this box:\n"
           "$3^n$ cases for $n$ rows.", "ink", "start", "small")
    d.text((370, 176),
           "The way from within is smooth. Each Newton\nstep aims at a point farther along it; ten to\n"
           "thirty steps do for twelve rows or for twelve\nhundred.", "good", "start", "small")
    return d


def predictor_and_corrector() -> Drawing:
    """The products s z of two rows with the bound 0 during a step; both steps by (11.11), computed."""
    d = Drawing(372, "The trial step shows how far the products s z would bend away; the real step allows for that")
    S, B = np.array([[1.0, -0.36], [-0.36, 1.0]]), np.array([0.13, 1.43])
    s, z = np.array([1.03, 1.12]), np.array([0.71, 0.39])

    def step(target) -> tuple[np.ndarray, np.ndarray]:
        """Δs and Δz for products that change by `target`, to first order."""
        ds = np.linalg.solve(S + np.diag(z / s), B + z - S @ s + target / s)
        return ds, (target - z * ds) / s

    trial = step(-s * z)
    reach = min(1.0, *(-value / change for now, changes in ((s, trial[0]), (z, trial[1]))
                       for value, change in zip(now, changes) if change < 0))
    mean = (s * z).mean()
    after = ((s + reach * trial[0]) * (z + reach * trial[1])).mean()
    tau = mean * (after / mean) ** 3
    real = step(tau - s * z - trial[0] * trial[1])
    f = Frame((76, 262), 300)
    d.arrow(f(-0.12, 0), f(1.02, 0), "soft thin")
    d.arrow(f(0, -0.3), f(0, 0.76), "soft thin")
    d.text((f(1.02, 0)[0], f(0, 0)[1] + 24), "$s_1 z_1$", "soft", "end")
    d.text((f(0, 0.76)[0] + 12, f(0, 0.76)[1] + 6), "$s_2 z_2$", "soft", "start")
    d.line(f(0, 0), f(0.72, 0.72), "good dash")
    d.text((f(0.5, 0.5)[0] - 8, f(0.5, 0.54)[1]), "all products equal", "good", "end", "small")
    start = f(*(s * z))
    d.line(start, f(0, 0), "velocity dash")
    for change, style in ((trial, "velocity bold"), (real, "impulse bold")):
        d.curve(lambda a, change=change: f(*((s + a * change[0]) * (z + a * change[1]))), 0, 1, style)
        end = f(*((s + change[0]) * (z + change[1])))
        d.dot(end, style.split()[0], 6)
    d.dot(start, "ink", 6)
    d.text((start[0] + 12, start[1] + 4), "now", "ink", "start", "small")
    d.text((436, 70), "The trial step aims at products of 0\nalong the dashed line. It ends off by\n$Δs Δz$, "
                      "which Newton's step neglects.", "velocity", "start", "small")
    d.text((436, 166), "The real step aims at $τ$ for all, and\nsubtracts this $Δs Δz$ beforehand. It\n"
                       "ends near the line of equal products.", "impulse", "start", "small")
    d.text((436, 262), "Both solve with the same factors.", "ink", "start", "small")
    return d
