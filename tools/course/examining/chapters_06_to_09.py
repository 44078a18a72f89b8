"""Questions of chapters 06 to 09."""

import math

from examining.question import Draw, asks, said, vector


@asks(6, 1, "6.1 6.2")
def gap_of_a_rod(draw: Draw):
    d, length = draw.of((3, 0, 4), (0, 6, 8), (5, 0, 12)), draw.tenth(4, 9)
    r, n = math.hypot(*d), [x / math.hypot(*d) for x in d]
    flipped = draw.of(True, False)
    sign = -1 if flipped else 1
    told = "Here a normal points from j to i. " if flipped else ""
    return (f"{told}A rod of {length} m ties a point of body i to one of body j, which lies {d} m from it. What are the "
            "row's gap and normal, and between which bounds is its impulse?",
            f"{said(r - length, 'm')}, {vector([sign * x for x in n])}, without bounds")


@asks(6, 2, "6.3 6.4")
def masses_of_a_cloth(draw: Draw):
    m, u, v = draw.of(1, 2, 6), draw.whole(2, 5), draw.whole(2, 5)
    place, corners = draw.of(("at a corner", 1), ("on a side", 2), ("inside", 4))
    return (f"A cloth of {m} kg has {u} by {v} cells. What is the mass of a point {place}? And a point in the middle of a "
            f"rope of {m} kg with {u} links?", f"{said(m * corners / 4 / u / v, 'kg')}, {said(m / u, 'kg')}")


@asks(6, 3, "6.1")
def hanging_wire(draw: Draw):
    N, m, M, k = draw.whole(3, 8), draw.of(0.1, 0.2, 0.5), draw.of(5, 10, 20), draw.of(1e4, 1e5)
    tensions = [(M + (N - i) * m) * 9.81 for i in range(1, N + 1)]
    return (f"A wire of {N} links has points of {m} kg, and a load of {M} kg for its last point. k = {k:g} N/m, g = 9.81 "
            "m/s². What is the tension of the top link, and by how much is the wire stretched? How does the number of "
            "sweeps grow with the load?", f"{said(tensions[0], 'N')}, {said(sum(tensions) / k, 'm')}; in proportion to it")


@asks(6, 4, "6.5")
def rod_and_wall(draw: Draw):
    m, h, degrees = draw.of(1, 2, 5), draw.of(0.01, 0.02), draw.of(30, 45, 60)
    towards = draw.of(True, False)
    sine, cosine = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    off = 9.81 * h * sine * sine * cosine
    return (f"A point mass of {m} kg hangs at rest on a rod, {degrees}° from the vertical, where a smooth vertical wall "
            f"holds it. Both rows are rigid: Σ = 0. h = {h} s and g = 9.81 m/s². Which impulses do the rod and the wall "
            "give in one solve? Now the rod is solved first, by itself, and then the wall. At which velocity does "
            f"the point {'approach' if towards else 'leave'} the pivot after the kick?",
            f"{said(m * 9.81 * h / cosine, 'N s')} and {said(m * 9.81 * h * sine / cosine, 'N s')}; "
            f"{said(-off if towards else off, 'm/s')}")


@asks(7, 1, "7.1 7.2 7.3 7.6 7.7 7.8")
def bounce_with_friction(draw: Draw):
    e, mu, down, along = draw.of(0.2, 0.5, 0.8), draw.of(0.1, 0.2, 0.4), draw.whole(1, 4), draw.whole(1, 8)
    jn = (1 + e) * down
    slides = along > mu * jn
    after = along - mu * jn if slides else 0
    return (f"A point mass of 1 kg hits the floor at {down} m/s, and moves along it at {along} m/s. e = {e}, μ = {mu}. "
            "What are its two velocities afterwards?", f"{said(e * down, 'm/s')} up, {said(after, 'm/s')} along"
            + ("" if slides else ": it sticks"))


@asks(7, 2, "7.4 7.5")
def work_of_an_impulse(draw: Draw):
    u, J, K = draw.whole(-5, -1), draw.whole(1, 12), draw.of(1, 2)
    work = J * (u + K * J / 2)
    return (f"At a contact u·n = {said(u)} m/s and nᵀKn = {K}/kg. A law gives J = {J} N s along n. How much "
            "energy does that add? May it?", f"{said(work, 'J')}; " + ("no" if work > 0 else "yes"))


@asks(7, 3, "7.8")
def bounces(draw: Draw):
    h, e, n = draw.of(1, 2, 3), draw.of(0.5, 0.7, 0.9), draw.whole(2, 4)
    total = math.sqrt(2 * h / 9.81) * (1 + e) / (1 - e)
    return (f"A ball falls from {h} m, with e = {e} and g = 9.81 m/s². How high is bounce {n}, and after which time has it "
            "come to rest? Which velocity must leapfrog use in the impact?",
            f"{said(h * e ** (2 * n), 'm')}, {said(total, 's')}; that at the time of the positions, W + W_f/2")


@asks(7, 4, "7.9")
def step_of_a_bounce(draw: Draw):
    v, e, h = draw.whole(2, 9), draw.of(0.5, 0.8, 1), draw.of(0.01, 0.02)
    down = draw.of(True, False)
    W = -v + (1 + e) * (v + 9.81 * h / 2)
    sign = -1 if down else 1
    return (f"Count velocities {'downwards' if down else 'upwards'}. A ball touches the floor at t_n, and its W, of t_n − "
            f"h/2, is {said(sign * -v)} m/s. e = {e}, h = {h} s, and g = 9.81 m/s². What is W after the impacts, and after "
            "the step? What would happen to the bounce if the rows came before the impacts?",
            f"{said(sign * W, 'm/s')} and {said(sign * (W - 9.81 * h), 'm/s')}; the rows would stop the ball, and it "
            "would not bounce")


@asks(8, 1, "8.1 8.2 8.3 8.4 8.5 8.6 8.7 8.8")
def nearest_of_a_box(draw: Draw):
    half, R = [1, 2, 3], draw.of(0.5, 1, 2)
    x = draw.of((4, 0.5, 1), (1.5, 2.2, 0), (2, 4, 3), (0.5, 1, 4.5))
    c = [min(b, max(-b, a)) for a, b in zip(x, half)]
    d = [a - b for a, b in zip(x, c)]
    r = math.hypot(*d)
    return (f"The centre of a ball of {R} m is at {x} in the axes of a box with half sides {tuple(half)} m. What is the "
            "gap, and the normal from box to ball?", f"{said(r - R, 'm')}, {vector([a / r for a in d])}")


@asks(8, 2, "8.2 8.4 8.8")
def couple_of_two_points(draw: Draw):
    g, J = draw.of(1, 2, 5), draw.of(3, 4, 10)
    return (f"Two balls overlap by {g} mm. Friction of {J} N s acts at the nearest point of each surface. How much "
            "spurious angular momentum appears? Why may the gap of a single point be negative?",
            f"{said(g * J / 1000, 'N m s')}; the gap is a number of its own, and both arms end at the one point")


@asks(8, 3, "8.9 8.10 8.11")
def level_of_a_body(draw: Draw):
    n, size = draw.of(1000, 4000, 20000), draw.of(0.3, 0.7, 1.5, 3, 6)
    return (f"How many pairs do {n} bodies form? On which level of the spatial hash, with cells of 2^l m, lies a body whose "
            f"longest side is {size} m?", f"{n * (n - 1) // 2}; {math.ceil(math.log2(size))}")


@asks(8, 4, "8.5 8.8")
def margin_of_a_face(draw: Draw):
    g, more = draw.of(2, 4, 10), draw.of(4, 8, 20, 40)
    other = g * (1 - more / 100)
    return (f"Two boxes of 1 m overlap by {g} mm along a face of i, and by {other:.4g} mm along a face of j. The margin is "
            "5 per cent of the gap and a thousandth of the smallest half side. Which face is the axis, and what is the "
            "margin for?", f"{'that of i' if g - other <= 0.05 * g + 0.5 else 'that of j'}; round-off and sag must not "
            "choose between descriptions of one contact")


@asks(8, 5, "8.12")
def step_of_a_tower(draw: Draw):
    n, mu, v, h = draw.whole(3, 20), draw.of(0, 0.5), draw.of(0.5, 2, 5), draw.of(0.01, 0.02)
    return (f"A tower of {n} equal boxes stands on a plane. Each box overlaps the one below a little. μ = {mu}. How many "
            "pairs does the broad phase return? How many contacts does the search find, and how many rows does the step "
            f"build? Bodies approach at {v} m/s, and h = {h} s. How wrong are the gaps in the rows if the bodies move "
            "between the search and the rows?",
            f"{n - 1}, since planes have no bounds; {4 * n}; {4 * n * (3 if mu else 1)}; {said(h * v, 'm')}")


@asks(9, 1, "9.2 9.3")
def bound_of_a_stack(draw: Draw):
    n, k, mu, m = draw.whole(3, 9), draw.whole(1, 2), draw.of(0.3, 0.5, 0.6), draw.of(1, 2, 5)
    return (f"{n} equal bodies of {m} kg rest on each other, and μ = {mu}. Count the contacts from the floor, which is 1. "
            f"Which friction force may contact {k + 1} give, by the normal impulses of the step? g = 9.81 m/s².",
            said(mu * (n - k) * m * 9.81, "N"))


@asks(9, 2, "9.1 9.4 9.5 9.6 9.8")
def onto_the_disc(draw: Draw):
    lt, ln, mu = draw.of((3, 4), (6, 8), (5, 12)), draw.whole(4, 20), draw.of(0.25, 0.5)
    size, bound = math.hypot(*lt), mu * ln
    part = min(1, bound / size)
    box = [min(bound, max(-bound, x)) for x in lt]
    return (f"A contact has λ_n = {ln} N s, μ = {mu}, and without a bound λ_t would be {lt} N s. What is λ_t with the "
            "cone, and with a box of the same bound?", f"{vector([part * x for x in lt], 'N s')}, {vector(box, 'N s')}")


@asks(9, 3, "9.7 9.8")
def rate_of_a_rod(draw: Draw):
    mu, ahead = draw.of(0.5, 1, 1.6, 2), draw.of(True, False)
    rho = (1 if ahead else -1) * 0.75 * mu
    does = ("the rod jams" if rho >= 1 else "they oscillate for ever" if rho <= -1 else "they converge")
    return (f"A thin rod leans with tan θ = 2, and its end is {'pushed ahead' if ahead else 'dragged behind'}. nᵀKt is "
            f"{'+' if ahead else '−'}0.75 nᵀKn, and μ = {mu}. What happens to sweeps on the cone?",
            f"ρ = {said(rho)}: {does}")


@asks(9, 4, "9.9")
def rows_for_any_solver(draw: Draw):
    balls, joints, mu = draw.whole(3, 12), draw.whole(2, 3), draw.of(0, 0.4)
    rows = 3 * joints + balls * (3 if mu else 1)
    return (f"{balls} balls touch a floor and nothing else, and {joints} pairs of them hang together by ball joints. "
            f"μ = {mu}. How many rows does step_rows return, and for how many contacts does it list friction? May a "
            "solver change the velocities of the bodies?",
            f"{rows} rows; {balls if mu else 0}; no: it changes λ and V, and finish_step adds V")
