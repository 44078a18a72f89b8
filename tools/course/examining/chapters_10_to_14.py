"""Questions of chapters 10 to 14."""

import math

from examining.question import Draw, asks, said, vector


@asks(10, 1, "10.1 10.2")
def safe_warm_start(draw: Draw):
    rho, d = draw.of(0.95, 0.98, 0.99), draw.of(1, 3, 4)
    n = math.ceil(math.log(d / (1 + d)) / math.log(rho) + 1e-12)
    return (f"A sweep multiplies the slowest error by {rho}, and d = {d}. How many sweeps a step make a warm start safe? "
            "What must be set besides λ?", f"{n}; V = M⁻¹Gᵀλ")


@asks(10, 2, "10.3 10.4 10.5")
def lead_of_an_order(draw: Draw):
    k, s, rho = draw.whole(3, 15), draw.whole(2, 8), draw.of(0.9, 0.96, 0.81)
    return (f"Jacobi's iteration multiplies an error by {rho} a sweep in a stack. By which factor does a Gauss-Seidel sweep "
            f"multiply it, upwards and downwards? After how many sweeps down is λ of row {k} as after {s} sweeps up?",
            f"{said(rho * rho)}, in either order; {s + k}")


@asks(10, 3, "10.7 10.8")
def step_of_descent(draw: Draw):
    S, B = draw.of((2, 1, 2), (3, 1, 2), (4, 2, 3)), (draw.whole(1, 5), draw.whole(1, 5))
    Sp = (S[0] * B[0] + S[1] * B[1], S[1] * B[0] + S[2] * B[1])
    alpha = (B[0] ** 2 + B[1] ** 2) / (B[0] * Sp[0] + B[1] * Sp[1])
    energy = -alpha * (B[0] ** 2 + B[1] ** 2) / 2
    return (f"S has the rows ({S[0]}, {S[1]}) and ({S[1]}, {S[2]}), B = {B}, without bounds. From λ = 0 a step goes along "
            "p = B to the lowest energy. How long is it, and what is the energy afterwards? How many steps solve it?",
            f"α = {said(alpha)}, E = {said(energy)}; two")


@asks(10, 4, "10.6")
def observed(draw: Draw):
    rho, e = draw.of(0.5, 0.8, 0.9), draw.of(1.0, 2.0, 4.0)
    history = [e * rho**k for k in range(4)]
    n = math.ceil(math.log(1e-6) / math.log(rho))
    return (f"Errors after four sweeps are {', '.join(f'{x:.4g}' for x in history)}. What is the observed rate, and how "
            "many sweeps reduce the error to a millionth? When do you choose another solver?",
            f"{said(rho)}, {n}; if these cost more than a factorisation")


@asks(10, 5, "10.9")
def relaxed_ball(draw: Draw):
    m, deep, up = draw.of(1, 2, 4), draw.of(5, 10, 20), draw.of(0, 0.05)
    h, k, d = draw.of(0.001, 0.002), 1e6, draw.of(2, 3)
    a, b, s = 4 / h / (1 + 4 * d), 4 * d / (1 + 4 * d), 4 / h**2 / k / (1 + 4 * d)
    free = up - 9.81 * h  # W + W_f
    moved = free + (a * deep / 1000 - b * up + 9.81 * h) / (1 + m * s)
    return (f"A ball of {m} kg is {deep} mm deep in the floor, and its W is {up} m/s upwards. h = {h} s, k = {k:g} N/m, "
            f"d = {d}, and g = 9.81 m/s². By which velocity does a relaxed substep move the ball, and which velocity does "
            "it keep? For which scenes is this wrong?",
            f"{said(moved, 'm/s')} and {said(max(0.0, free), 'm/s')}; where a row stores energy, as in a bungee")


@asks(10, 6, "10.10 10.11 10.12")
def depth_of_a_tower(draw: Draw):
    x, zeta, h = draw.of(0.5, 1, 2), draw.of(1, 2, 5), draw.of(0.005, 0.01)
    n, f = draw.whole(5, 20), draw.of(20, 40, 60)
    stiffness = x * (2 * zeta + x)
    omega = 2 * math.pi * f
    return (f"A soft row has hω = {x}, ζ = {zeta} and h = {h} s. What are its bias rate, its mass scale and its impulse "
            f"scale? Another one, with {f} Hz, is the lowest contact of a tower of {n} equal balls at rest, with "
            "g = 9.81 m/s². How deep is it, and why does the mass of the balls not matter?",
            f"{said(x / h / (2 * zeta + x), '/s')}, {said(stiffness / (1 + stiffness))} and "
            f"{said(1 / (1 + stiffness))}; {said(n * 9.81 / omega**2, 'm')}, since S is 1/m and F is n m g")


@asks(11, 1, "11.1 11.2")
def entries_of_a_hub(draw: Draw):
    n, kind = draw.whole(20, 60), draw.of("hub", "wire")  # a small hub has fewer entries in S
    entries = n * (n + 1) // 2 if kind == "hub" else 2 * n - 1
    what = "rods from one moving hub to as many fixed points" if kind == "hub" else "links in a row, the first one fixed"
    return (f"{n} {what}, one row each. How many entries does the lower triangle of S have, including its "
            "diagonal? Which of S and the saddle point is the sparser?",
            f"{entries}; {'the saddle point' if kind == 'hub' else 'S'}")


@asks(11, 2, "11.3 11.4 11.11")
def second_pivot(draw: Draw):
    a, s = draw.of(1, 2, 4), draw.of(0.1, 0.5, 0.01)
    return (f"A system has the same row twice, with GM⁻¹Gᵀ = {a}/kg and Σ = {s}/kg. What are its two pivots? How does the "
            "cost of a wire's factors grow with its length?",
            f"{said(a + s, '/kg')} and {said(a + s - a * a / (a + s), '/kg')}; in proportion")


@asks(11, 3, "11.5 11.6 11.7 11.8 11.9 11.10")
def step_within(draw: Draw):
    s, z, S, B = draw.of(0.5, 1, 2), draw.of(1, 2, 4), draw.of(1, 2), draw.of(-3, -1, 2)
    tau = draw.of(0, 0.5)
    delta = (B - S * s + tau / s) / (S + z / s)
    dz = (tau - z * delta) / s - z
    parts = [-x / dx for x, dx in ((s, delta), (z, dz)) if dx < 0]
    return (f"One row has S = {S}/kg, B = {said(B)} m/s, the bounds 0 and ∞, and stands at λ = {s} N s with z = {z} m/s. "
            f"What is Newton's Δλ for τ = {tau} J, and the longest part α of that step?",
            f"{said(delta, 'N s')}, α = {said(min([1.0, *parts]))}")


@asks(11, 4, "11.3 11.11")
def contradiction(draw: Draw):
    b1, b2, s1, s2 = draw.whole(1, 4), draw.whole(5, 9), draw.of(0.1, 0.2), draw.of(0.4, 0.8)
    # (1 + s1) x + y = b1, x + (1 + s2) y = b2
    det = (1 + s1) * (1 + s2) - 1
    x, y = ((1 + s2) * b1 - b2) / det, ((1 + s1) * b2 - b1) / det
    return (f"Two rows of a body of 1 kg are equal except for B, {b1} and {b2} m/s. Σ is {s1} and {s2}/kg. What is the "
            "direct solver's result? And with Σ = 0?",
            f"λ = {vector((x, y), 'N s')}, which makes the velocity {said(x + y, 'm/s')}; "
            "there is none, and a pivot shows it")


@asks(12, 1, "12.1")
def step_of_a_wire(draw: Draw):
    T, m, length = draw.of(100, 1000, 10000), draw.of(0.01, 0.1), draw.of(0.1, 0.2)
    return (f"A wire of points of {m} kg, {length} m apart, is under {T} N. From which step on is plain leapfrog unstable?",
            said(2 / math.sqrt(4 * T / m / length), "s"))


@asks(12, 2, "12.2 12.3")
def stiffness_of_a_link(draw: Draw):
    T, length, n = draw.of(50, 100, 400), draw.of(0.5, 1, 2), draw.of((0.6, 0, 0.8), (0, 0.6, 0.8), (0.8, 0.6, 0))
    K = [[T / length * ((a == b) - n[a] * n[b]) for b in range(3)] for a in range(3)]
    pushes = draw.of(True, False)
    row = draw.whole(0, 2)
    told = f"pushes with {T} N" if pushes else f"is under {T} N"
    return (f"A link of {length} m along {n} {told}. What is the row of its K for {'xyz'[row]}, as the method uses it? "
            "With which signs does it enter the mass matrix?",
            f"{vector([0, 0, 0] if pushes else K[row], 'N/m')}; + on the diagonal blocks, − between them, times h²")


@asks(12, 3, "12.4")
def frequency_in_a_step(draw: Draw):
    q, alpha = draw.of(1, 4, 20), draw.of(0.25, 1)
    value = q / (1 + alpha * q)
    return (f"A spring has h²k/m = {q}. The mass in the step is m + αh²k, with α = {alpha}. What is (hω̃)², and is it "
            "stable? Which of (12.6) and (12.8) damps a swing, and why?",
            f"{said(value)}, stable; (12.8), which is implicit Euler; (12.6) is the same forwards and backwards in time")


@asks(12, 4, "12.4")
def loaded_swing(draw: Draw):
    N, M, degrees = draw.of(20, 50, 100), draw.of(100, 1000), draw.of(60, 90)
    T = (3 - 2 * math.cos(math.radians(degrees))) * M * 9.81
    omega = math.sqrt(4 * T / (1 / N) / (10 / N))
    return (f"A wire of 10 m and 1 kg in {N} links swings {M} kg from {degrees}°. What is the largest tension, and the "
            "step that plain leapfrog needs? Which step does the geometric stiffness allow? g = 9.81 m/s².",
            f"{said(T, 'N')} and {said(2 / omega, 's')}; one that follows the swing, such as 1/60 s")


@asks(13, 1, "13.1 13.2")
def gap_of_a_weld(draw: Draw):
    angle, axis, flipped = draw.of(0.1, 0.2, 0.4), draw.whole(0, 2), draw.of(True, False)
    sign = -1 if flipped else 1
    g = [0.0, 0.0, 0.0]
    g[axis] = sign * 2 * math.sin(angle / 2)
    who = "i against j" if flipped else "j against i"
    return (f"The two bodies of a weld have turned by {angle} rad about {'xyz'[axis]}, {who}. What are the weld's three "
            "angular gaps?", vector(g))


@asks(13, 2, "13.3 13.4")
def turns_of_a_hinge(draw: Draw):
    turns, last, now = draw.whole(1, 6), draw.tenth(2.5, 3), draw.of(-3.1, -2.9, 3.1)
    before = last + 2 * math.pi * turns
    found = now - 2 * math.pi * round((now - before) / (2 * math.pi))
    h, d, gap = 0.02, draw.of(1, 2), draw.of(0.04, -0.05)
    fastest = gap / h if gap > 0 else 4 * gap / h / (1 + 4 * d)
    return (f"A hinge stood at {before:.4f} rad, and atan2 now gives {now} rad. What is its angle? A limit is {said(gap)} "
            f"rad away, h = {h} s, d = {d}. With which speed may the joint move towards it at most?",
            f"{said(found, 'rad')}; {said(fastest, 'rad/s')}")


@asks(13, 3, "13.5")
def motor_of_a_joint(draw: Draw):
    I, w, T, h = draw.of(1, 2, 4), draw.of(2, 5, 10), draw.of(4, 10, 20), 0.01
    return (f"A motor of {T} N m takes a wheel of {I} kg m² from rest to {w} rad/s. How long does it take, and what are "
            f"the bounds of its row at h = {h} s? What are its a and b?",
            f"{said(I * w / T, 's')}, ±{said(h * T, 'N m s')}; 0 and 1")


@asks(13, 4, "13.2")
def torque_of_a_shift(draw: Draw):
    d, J = draw.of(0.2, 0.5, 2), draw.of(1, 3, 8)
    return (f"A drawer is {d} m open, and its guide exerts on it {J} N s across. How much spurious angular momentum "
            "appears without the second term of the row? Does a smaller step help?", f"{said(d * J, 'N m s')}; no")


@asks(14, 1, "14.1 14.2")
def block_of_a_contact(draw: Draw):
    s, qn, qt, mu = draw.of(1, 2), draw.whole(-2, 6), draw.whole(1, 6), draw.of(0.3, 0.5, 0.8)
    if qn <= 0:
        case, answer = "it opens", (0.0, 0.0)
    elif qt <= mu * qn:
        case, answer = "it sticks", (qn / s, qt / s)
    else:
        case, answer = "it slides", (qn / s, mu * qn / s)
    return (f"A contact's block is {s} times the identity, μ = {mu}, and q = ({said(qn)}, {qt}, 0) m/s, the normal first. "
            "Which impulse solves it at once?", f"{case}: {vector((*answer, 0), 'N s')}")


@asks(14, 2, "14.3")
def colours_of_a_scene(draw: Draw):
    n, kind = draw.whole(4, 12), draw.of("ring", "tower", "hub")
    count = {"ring": 2 if n % 2 == 0 else 3, "tower": 2, "hub": n}[kind]
    what = {"ring": f"{n} bodies in a ring, each tied to the next", "tower": f"a tower of {n} boxes on a static floor",
            "hub": f"{n} bodies, each tied to one dynamic hub"}[kind]
    return f"What is the least number of colours for {what}?", str(count)


@asks(14, 3, "14.4")
def empty_lanes(draw: Draw):
    lanes, pairs = draw.of(2, 4, 8), draw.whole(5, 40)
    packs = -(-pairs // lanes)
    return (f"A colour has {pairs} pairs, and a pack {lanes} lanes. How many packs are that, and how many lanes are "
            "empty? What is Δλ in an empty one?", f"{packs}, {packs * lanes - pairs}; 0")


@asks(14, 4, "14.6")
def discs_in_lanes(draw: Draw):
    sizes = [draw.of((3, 4), (6, 8)), (0, 0), draw.of((5, 12), (8, 15)), draw.of((0.3, 0.4), (0.6, 0.8))]
    radii = [draw.of(2, 4), 0, draw.of(5, 20), draw.of(0.5, 1)]
    scales = [1.0 if math.hypot(*size) <= radius else radius / math.hypot(*size) for size, radius in zip(sizes, radii)]
    return (f"Four lanes hold λ_t = {sizes[0]}, {sizes[1]}, {sizes[2]} and {sizes[3]} N s. Their discs have the radii "
            f"{radii[0]}, {radii[1]}, {radii[2]} and {radii[3]} N s. What is the factor m of each lane? The second "
            "lane is empty. Which value is computed there and not used?",
            f"{vector(scales)}; 0/0, in the case that is not selected")


@asks(14, 5, "14.5")
def share_of_a_thread(draw: Draw):
    n, T = draw.whole(7, 40), draw.of(2, 3, 4)
    t = draw.whole(0, T - 1)
    return (f"{n} packs of a colour are shared among {T} threads, counted from 0. Which packs has thread {t}? Why are the "
            "bits the same on any number of threads?", f"{n * t // T} to {n * (t + 1) // T - 1}; no two packs of a colour "
            "share a body, and all wait before the next colour")


@asks(14, 6, "14.4 14.5")
def roofline(draw: Draw):
    phi, beta = draw.of(5, 10, 40), draw.of(5, 10, 50)
    compute, move = 55 / phi, 240 / beta
    return (f"A core does {phi} operations and moves {beta} bytes a nanosecond. An update has 55 operations and 240 bytes. "
            "How long does it take at least, and would lanes help?",
            f"{said(max(compute, move), 'ns')}; {'yes' if compute > move else 'no: it waits for memory'}")
