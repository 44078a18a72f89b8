"""Chapter 12: a string pulled apart at two points, and the effect of h²K on the fastest motion."""

import math

from pen import Drawing, Frame, between


def string_pulled_apart() -> Drawing:
    d = Drawing(330, "A tight string, pulled apart at two points, pulls each back: twice T times the sine of its slope")
    xs = [40 + 128 * k for k in range(6)]
    base = 78
    d.line((xs[0], base), (xs[5], base), "ink")
    for x in xs:
        d.dot((x, base), "body", 9)
    d.text((40, 46), "at rest: tension $T$ along it, and no force across", "soft", "start", "small")
    base, y = 216, 46
    places = [(x, base + (y if k == 2 else -y if k == 3 else 0)) for k, x in enumerate(xs)]
    d.line((xs[0], base), (xs[5], base), "faint thin dash")
    for a, b in zip(places, places[1:]):
        d.line(a, b, "ink")
    for k in (2, 3):
        x, at = places[k]
        for other in (k - 1, k + 1):
            d.arrow((x, at), between((x, at), places[other], 0.42), "impulse")
        d.arrow((x, at), (x, at + (-62 if k == 2 else 62)), "velocity bold")
    for k, (x, at) in enumerate(places):
        d.dot((x, at), "body", 9)
    d.text((places[2][0] - 74, places[2][1] - 2), "$T$", "impulse", "end")
    d.text((places[3][0] + 76, places[3][1] + 12), "$T$", "impulse", "start")
    d.text((places[2][0] - 10, places[2][1] - 66), "pulled back", "velocity", "end", "small")
    d.text((places[3][0] + 12, places[3][1] + 68), "pulled back", "velocity", "start", "small")
    d.line((places[2][0] + 22, base), (places[2][0] + 22, base + y), "good thin")
    d.text((places[2][0] + 30, base + 34), "$y$", "good", "start")
    d.text((40, 310), "pulled apart by two fingers (drawn too large: the links hardly get longer), and pulled back",
           "soft", "start", "small")
    return d


def heavier_in_a_step() -> Drawing:
    """(12.7): leapfrog's motion of a spring, by the mass that it uses."""
    d = Drawing(330, "With the mass m + αh²k a step stays below leapfrog's bound for every stiffness, from α = 1/4 on")
    f = Frame((80, 282), 46, 82)
    d.arrow(f(0, 0), f(8.4, 0), "soft thin")
    d.arrow(f(0, 0), f(0, 3.1), "soft thin")
    d.text((f(8.4, 0)[0] + 8, 287), "$h (k/m)^{1/2}$", "soft", "start", "small")
    d.text((f(0, 3.1)[0] + 12, 36), "$h ω$ in the step", "soft", "start", "small")
    for k in (2, 4, 6, 8):
        d.line(f(k, 0), f(k, -0.06), "soft thin")
        d.text((f(k, 0)[0], 304), f"{k}", "soft", size="small")
    d.line(f(0, 2), f(8.2, 2), "impulse dash")
    d.text((f(8.2, 2)[0], f(0, 2)[1] - 9), "2: beyond it leapfrog blows up", "impulse", "end", "small")
    d.text((70, f(0, 2)[1] + 5), "2", "impulse", "end", "small")
    for alpha, colour, label in ((0, "ink", "$α = 0$: leapfrog"), (0.25, "velocity", "$α = ¼$: up to 2, never over"),
                                 (1, "good", "$α = 1$: never over 1")):
        end = 2.95 if alpha == 0 else 8.2
        d.curve(lambda x, a=alpha: f(x, x / math.sqrt(1 + a * x * x)), 0, end, f"{colour} bold")
        at = f(2.5, 2.72) if alpha == 0 else f(8.2, 8.2 / math.sqrt(1 + alpha * 8.2**2))
        d.text((at[0] + 24, at[1]) if alpha == 0 else (at[0], at[1] + 24), label, colour,
               "start" if alpha == 0 else "end", "small")
    d.text((500, 92), "Slow motion, on the left, is\nthe same for all three.\nWhat is fast is slowed down.",
           "soft", "start", "small")
    return d
