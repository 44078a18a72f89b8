"""Questions of chapters 01 to 05."""

import math

from examining.question import Draw, asks, said, vector
from terminal import counted


@asks(1, 1, "1.1 1.2 1.3 1.4")
def falls(draw: Draw):
    h, n, a = draw.of(0.1, 0.2, 0.25), draw.whole(4, 9), draw.of(2, 4, 10)
    starts = draw.of(True, False)
    start = "after the half-step start" if starts else "without a half-step start"
    return (f"A body at rest at x = 0 has the acceleration {a} m/s². Leapfrog takes {n} steps of {h} s, {start}. "
            "Where is the body?", said(a * h * h * (n * n if starts else n * (n + 1)) / 2, "m"))


@asks(1, 2, "1.3 1.4")
def order_of_a_table(draw: Draw):
    order, error, digits = draw.of(1, 2, 4), draw.tenth(2, 8), draw.whole(2, 4)
    return (f"A method's errors at h and h/2 are {error}e-{digits} m and {error / 2**order:.3g}e-{digits} m. What is "
            "its order? If it is leapfrog, is there a half-step start?",
            f"{order}; " + {1: "without one, for it would have 2", 2: "with one", 4: "it is not leapfrog, but steps of "
                                                                                   "leapfrog composed"}[order])


@asks(1, 3, "1.1 1.2")
def largest_step(draw: Draw):
    m, k = draw.of(0.5, 1, 2, 4), draw.of(50, 200, 800, 5000)
    return (f"A body of {m} kg hangs on a spring of {k} N/m. Above which step is leapfrog unstable, and why does the "
            "energy not drift for shorter steps?", f"{said(2 * math.sqrt(m / k), 's')}; it conserves the energy of "
            "(1.9) exactly")


@asks(1, 4, "1.5")
def composed(draw: Draw):
    pairs, h = draw.of(1, 2), draw.of(0.1, 0.2, 0.5)
    w = 1 / (2 * pairs - (2 * pairs) ** (1 / 3))
    return (f"{2 * pairs + 1} leapfrog steps make one step of order four of {h} s. How long are the outer ones and the "
            "middle one? Name a scene for which it does not help.",
            f"{said(w * h, 's')} and {said((1 - 2 * pairs * w) * h, 's')}; any with contacts or damping")


@asks(2, 1, "2.1 2.2 2.3")
def turn_of_a_step(draw: Draw):
    omega, h = draw.of(10, 20, 30, 60), draw.of("1/30", "1/60")
    x = omega / float(h[2:])
    return (f"A body turns at {omega} rad/s. By which angle do the first-order update and the exponential update turn it "
            f"in a step of {h} s?", f"{said(2 * math.atan(x / 2), 'rad')} and {said(x, 'rad')}")


@asks(2, 2, "2.4")
def turned_inertia(draw: Draw):
    I, axis = [draw.whole(1, 3), draw.whole(4, 6), draw.whole(7, 9)], draw.whole(0, 2)
    angle = draw.of(90, 45)
    p, q = (k for k in range(3) if k != axis)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    M = [[0.0] * 3 for _ in range(3)]
    M[axis][axis] = I[axis]
    sign = 1 if axis != 1 else -1
    M[p][p], M[q][q] = c * c * I[p] + s * s * I[q], s * s * I[p] + c * c * I[q]
    M[p][q] = M[q][p] = sign * c * s * (I[p] - I[q])
    return (f"A body has the principal moments {I[0]}, {I[1]} and {I[2]} kg m² along its own x, y and z. It is turned by "
            f"{angle}° about the world's {'xyz'[axis]}. What is its inertia in world coordinates, and when must it be "
            "computed anew?", f"rows {', '.join(vector(row) for row in M)} kg m²; whenever the body has turned")


@asks(2, 3, "2.5 2.6")
def torque_of_a_spin(draw: Draw):
    I, w = [draw.whole(1, 3), draw.whole(4, 6), draw.whole(7, 9)], [draw.whole(-3, 3) or 1 for _ in range(3)]
    L = [i * x for i, x in zip(I, w)]
    cross = [w[1] * L[2] - w[2] * L[1], w[2] * L[0] - w[0] * L[2], w[0] * L[1] - w[1] * L[0]]
    return (f"A free body with the principal moments {I} kg m² turns at ω = {tuple(w)} rad/s, in its own axes. What is "
            "its gyroscopic torque? What is lost in a simulation without it?",
            f"{vector([-x for x in cross], 'N m')}; the direction of ω stays, and so L does not")


@asks(2, 4, "2.7")
def step_of_a_ball(draw: Draw):
    v, omega, h = draw.whole(2, 9), draw.of(3, 5, 20), draw.of(0.01, 0.02, 0.1)
    down = draw.of(True, False)
    sign = -1 if down else 1
    told = "Count heights downwards. " if down else ""
    return (f"{told}A ball flies up at {v} m/s when a step of {h} s begins, and turns at {omega} rad/s. g = 9.81 m/s². "
            "By how much does the step change its height, and by which angle does the ball turn? What would the change "
            "of the height be if the drift came before the kick? Why may one body finish the step before the next one "
            "begins it?", f"{said(sign * h * (v - 9.81 * h), 'm')} and {said(h * omega, 'rad')}; "
            f"{said(sign * h * v, 'm')}; the bodies do not influence each other yet")


@asks(3, 1, "3.2 3.4")
def impulse_of_a_contact(draw: Draw):
    m, deep, v, k, d = draw.of(1, 2, 4), draw.of(1, 2, 5), draw.tenth(0, 1), draw.of(1e4, 1e5), draw.of(2, 3, 4)
    h, overlap = 0.01, draw.of(True, False)
    a, b, s = 4 / h / (1 + 4 * d), 4 * d / (1 + 4 * d), 4 / h**2 / k / (1 + 4 * d)
    rate = draw.of(-1, 1) * v
    impulse = max(0.0, (a * deep / 1000 - b * rate + h * 9.81) / (1 / m + s))
    gap = f"the overlap is {deep} mm, counted positive," if overlap else f"the gap is −{deep} mm"
    return (f"A ball of {m} kg touches the floor: {gap} and its centre moves {'up' if rate >= 0 else 'down'} at {v} m/s. "
            f"g = 9.81 m/s², h = {h} s, k = {k:g} N/m, d = {d}. Which impulse does the contact give? What is the purpose "
            "of each term?",
            f"{said(impulse, 'N s')}. a g moves the overlap out, b u damps the approach, h g₀ carries the weight, and Σ "
            "makes the contact a spring of stiffness k.")


@asks(3, 2, "3.1")
def stiffness_of_a_depth(draw: Draw):
    m, deep = draw.of(2, 5, 50, 400), draw.of(0.1, 0.5, 2)
    return (f"A body of {m} kg has to rest {deep} mm deep in the floor, on one contact, with g = 9.81 m/s². Which k is "
            "that? How does the depth change with half the step, and with twice the d?",
            f"{said(m * 9.81 / deep * 1000, 'N/m')}; it stays the same in both cases")


@asks(3, 3, "3.3")
def mass_of_a_point(draw: Draw):
    m, length, part = draw.of(1, 2, 3), draw.of(1, 2, 3), draw.of(0.25, 0.4, 0.5)
    s = part * length
    return (f"A thin rod of {m} kg and {length} m is struck across at {s:g} m from its middle. What is its effective "
            "mass there?", said(1 / (1 / m + s * s / (m * length**2 / 12)), "kg"))


@asks(3, 4, "3.5")
def kick_before_the_impulse(draw: Draw):
    m, k, h, d = draw.of(1, 2, 4), draw.of(1e4, 1e5), draw.of(0.01, 0.02), draw.of(2, 3, 4)
    down = draw.of(True, False)
    b, s = 4 * d / (1 + 4 * d), 4 / h**2 / k / (1 + 4 * d)
    twice = b * h * 9.81 / (1 + m * s)
    return (f"A ball of {m} kg rests on the floor, at the depth mg/k. h = {h} s, k = {k:g} N/m, d = {d}, and g = 9.81 m/s². "
            f"Count velocities {'downwards' if down else 'upwards'}. What is the ball's velocity after a step that "
            "computes λ by (3.10) and then kicks? And after a step that kicks first, and then computes λ by (3.10)? Why "
            "does the drift come last?", f"0; {said(-twice if down else twice, 'm/s')}, since gravity counts twice; the "
            "position must advance with a velocity that has the impulse in it")


@asks(4, 1, "4.1 4.2 4.4")
def diagonal_of_a_row(draw: Draw):
    i, j, s = draw.of(1, 2, 4), draw.of(5, 8, 10), draw.of(0.1, 0.2, 0.05)
    fixed = draw.of(True, False)
    other = "a static body" if fixed else f"a point mass of {j} kg"
    return (f"A row lies between a point mass of {i} kg and {other}, with Σ = {s}/kg and |n| = 1. What is its S_kk? What "
            "does the solver store in place of the rest of S?",
            f"{said(1 / i + (0 if fixed else 1 / j) + s, '/kg')}; V, the change of each body's velocity")


@asks(4, 2, "4.3")
def projected(draw: Draw):
    old, r, s = draw.tenth(0.5, 2), draw.of(-1, 1) * draw.tenth(2, 9), draw.of(1, 2, 4)
    flipped = draw.of(True, False)
    low, high = (-math.inf, 0.0) if flipped else (0.0, math.inf)
    start = -old if flipped else old
    new = min(high, max(low, start + r / s))
    told = ("Here a normal points from j to i, so that a contact's λ lies between −∞ and 0. " if flipped else "")
    return (f"{told}A contact's row has λ = {said(start)} N s, S_kk = {s}/kg and the residual {said(r)} m/s. What is its "
            "next λ, and its Δλ?", f"{said(new, 'N s')} and {said(new - start, 'N s')}")


@asks(4, 3, "4.5 4.6")
def sweeps_of_a_stack(draw: Draw):
    M, digits = draw.of(10, 40, 100, 500), draw.of(2, 3, 6)
    top = draw.of(True, False)
    ratio = M if top else 1 / M
    rate = 1 / (1 + 1 / ratio)
    upper, lower = (M, 1) if top else (1, M)
    return (f"A body of {upper} kg lies on one of {lower} kg, and that on the floor. Σ = 0. By which factor does "
            f"a sweep reduce the error, and how many sweeps reduce it to 10^-{digits}?",
            f"{said(rate)}, {counted(math.ceil(digits * math.log(10) / -math.log(rate)), 'sweep')}")


@asks(4, 4, "4.7")
def rest_of_a_stack(draw: Draw):
    n, m, h = draw.whole(3, 6), draw.of(1, 2, 5), draw.of(0.01, 0.02)
    row, from_top = draw.whole(1, 3), draw.of(True, False)
    carried = row if from_top else n + 1 - row
    return (f"A stack of {n} balls of {m} kg rests on the floor, and a step of {h} s begins. g = 9.81 m/s². Contacts are "
            f"counted from the {'top' if from_top else 'floor'}, from 1. Which λ has contact {row} after the solve, and "
            "which V does each ball have? Why must V not be added to W after each sweep?",
            f"{said(carried * m * 9.81 * h, 'N s')}, and {said(9.81 * h, 'm/s')} upwards, which the kick cancels; B is "
            "computed from W, and the residual already contains V")


@asks(5, 1, "5.1 5.4 5.5 5.6 5.7")
def block_on_a_slope(draw: Draw):
    angle, mu = draw.of(10, 20, 25, 30, 35), draw.of(0.2, 0.3, 0.5, 0.6)
    t = math.radians(angle)
    a = max(0.0, 9.81 * (math.sin(t) - mu * math.cos(t)))
    return (f"A block lies at rest on a slope of {angle}°, with μ = {mu} and g = 9.81 m/s². Does it stick? If not, how does "
            "it accelerate? Which velocity does it have after a step of 0.02 s? Why may the step solve friction and normals "
            "together?", ("it sticks" if a == 0 else f"no: {said(a, 'm/s²')}")
            + f"; {said(0.02 * a, 'm/s')}; the friction box has bounds that are known before the solve")


@asks(5, 2, "5.2")
def creep(draw: Draw):
    F, k, d = draw.of(5, 10, 20), draw.of(1e5, 1e6), draw.of(2, 3)
    return (f"A block that sticks is pulled by {F} N along the floor, at h = 1/60 s. How fast does it creep if its "
            f"friction row has the contact's b and Σ, with k = {k:g} N/m and d = {d}? And with a damper of c = 1e6 N s/m?",
            f"{said(F * 60 / k / d, 'm/s')} and {said(F / 1e6, 'm/s')}")


@asks(5, 3, "5.3")
def stack_of_the_box(draw: Draw):
    n, mu, phi = draw.whole(3, 12), draw.of(0.3, 0.4, 0.6), draw.of(0, 30, 45)
    strength = mu / max(math.cos(math.radians(phi)), math.sin(math.radians(phi)))
    return (f"{n} equal bodies are stacked on the floor, and μ = {mu}. Which μ does the friction box have at the floor, "
            f"for a pull at {phi}° from its first tangent, counted with the true normal force?", said(strength / n))
