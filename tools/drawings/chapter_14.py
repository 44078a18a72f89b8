"""Chapter 14: the root on the cone, the colours of a wall, four lanes, and threads that meet."""

from pen import Drawing, Frame


def sliding_root() -> Drawing:
    """λ of (14.5) over α, for a block of one tangent: S_nn, S_nt, S_tt and q as below."""
    d = Drawing(356, "As α grows, the impulse moves from where the contact would stick towards the normal, "
                     "and enters the cone")
    nn, nt, tt, q_n, q_t, mu = 1.0, 0.25, 1.0, 1.3, 2.2, 0.5
    f = Frame((190, 306), 185)

    def impulse(alpha: float) -> tuple[float, float]:
        along = (q_t - nt * q_n / nn) / (tt - nt * nt / nn + alpha)
        return along, (q_n - nt * along) / nn

    low, high = 0.0, 100.0
    for _ in range(60):
        middle = (low + high) / 2
        along, press = impulse(middle)
        low, high = (middle, high) if along > mu * press else (low, middle)
    d.path([f(-mu * 1.36, 1.36), f(0, 0), f(mu * 1.36, 1.36)], "good fill")
    d.arrow(f(-0.9, 0), f(2.4, 0), "soft thin")
    d.arrow(f(0, 0), f(0, 1.5), "soft thin")
    d.text((f(2.4, 0)[0], f(0, 0)[1] + 24), "$λ_t$", "soft", "end")
    d.text((f(0, 1.5)[0] - 10, f(0, 1.5)[1] + 10), "$λ_n$", "soft", "end")
    d.text(f(-0.42, 0.66), "$|λ_t| ≤ μ λ_n$", "good", "end", "small")
    d.line(f(*impulse(0)), f(*impulse(1e6)), "impulse")
    root = f(*impulse(low))
    d.arrow(f(0, 0), root, "impulse bold")
    for alpha in (0.25, 0.5, 1.0, 4.0, 8.0):
        d.dot(f(*impulse(alpha)), "ink", 4)
        d.text((f(*impulse(alpha))[0] + 2, f(*impulse(alpha))[1] - 12), f"${alpha:g}$", "ink", "start", "small")
    stick = f(*impulse(0))
    d.dot(stick, "ink", 6)
    d.text((stick[0] + 6, stick[1] + 26), "$α = 0$: it would stick,\noutside the cone", "ink", "start", "small")
    d.dot(root, "impulse", 7)
    d.text((root[0] + 14, root[1] + 56), f"$α = {low:.2f}$: it slides", "impulse", "start", "small")
    far = f(*impulse(1e6))
    d.dot(far, "ink", 4)
    d.text((far[0] - 12, far[1] + 5), "$α → ∞$", "ink", "end", "small")
    d.text((530, 40), "numbers on the line: $α$ in (14.5)", "soft", size="small")
    return d


def colours_of_a_wall() -> Drawing:
    """Three layers of boxes, every other one shifted by half a box; colours by (14.7), computed."""
    d = Drawing(330, "The pairs of a small wall in four colours: no box has two pairs of one colour")
    width, height, left, floor = 132, 74, 96, 274
    boxes, pairs = [], []
    for layer in range(3):
        for k in range(4 - layer % 2):
            boxes.append((layer, k))
    index = {box: n for n, box in enumerate(boxes)}

    def centre(n: int) -> tuple[float, float]:
        layer, k = boxes[n]
        return left + width * (k + 0.5 + 0.5 * (layer % 2)), floor - height * (layer + 0.5)

    for (layer, k), n in index.items():
        if layer == 0:
            pairs.append((-1, n))
        else:
            below = (k, k + 1) if layer % 2 else (k - 1, k)
            pairs += [(index[layer - 1, other], n) for other in below if (layer - 1, other) in index]
    taken: dict[int, set[int]] = {}
    d.line((50, floor), (670, floor), "ink bold")
    for n in range(len(boxes)):
        x, y = centre(n)
        d.box((x - width / 2 + 2, y - height / 2 + 2), width - 4, height - 4, "body fill", 4)
    styles = ["impulse bold", "velocity bold", "good bold", "pair bold"]
    for i, j in pairs:
        colour = next(c for c in range(9) if c not in taken.get(j, set()) and (i < 0 or c not in taken.get(i, set())))
        for body in (i, j):
            if body >= 0:
                taken.setdefault(body, set()).add(colour)
        x, y = centre(j)
        start = (x, floor) if i < 0 else centre(i)
        d.line(start, (x, y), styles[colour])
        at = ((start[0] + x) / 2, (start[1] + y) / 2 + (0 if i < 0 else 6))
        d.text((at[0] + 11, at[1] + (10 if i < 0 else 2)), str(colour), styles[colour].split()[0], "start", "small")
    for n in range(len(boxes)):
        d.dot(centre(n), "ink", 5)
    d.text((360, 308), "the floor does not move: all that stand on it may have colour 0", "soft", size="small")
    return d


def threads_that_meet() -> Drawing:
    """Two threads, four colours: packs of uneven time, and the barrier after each colour."""
    d = Drawing(306, "Two threads share the packs of each colour, and both wait before the next colour begins")
    colours = ("impulse", "velocity", "good", "pair")
    packs = (((29, 29, 29, 29), (29, 36, 29, 34)), ((29, 33, 29), (29, 44, 29)), ((29, 29, 58, 29), (29, 29, 29, 29)),
             ((29, 29), (29,)))
    x = 96
    for name, y in (("thread 0", 70), ("thread 1", 132)):
        d.text((84, y + 27), name, "ink", "end", "small")
    for number, (colour, shares) in enumerate(zip(colours, packs)):
        longest = max(sum(share) + 4 * len(share) for share in shares)
        for y, share in zip((70, 132), shares):
            at = x
            for wide in share:
                d.box((at, y), wide, 42, f"{colour} fill", 3)
                at += wide + 4
            if at < x + longest - 6:
                d.line((at + 4, y + 21), (x + longest - 4, y + 21), "soft dots")
        d.text((x + longest / 2, 46), f"colour {number}", colour, size="small")
        x += longest + 5
        d.line((x, 58), (x, 186), "ink bold")
        x += 13
    d.arrow((96, 212), (x + 10, 212), "soft thin")
    d.text((x + 10, 234), "time", "soft", "end", "small")
    d.text((96, 258), "a box: a pack of rows; no two packs of a colour share a body that moves", "soft", "start", "small")
    d.text((96, 284), "a bar: both have arrived; dots: a thread that waits, since the other's packs took longer", "ink",
           "start", "small")
    return d


def four_lanes() -> Drawing:
    d = Drawing(330, "Four rows one after the other, and the same numbers as four lanes")
    colours = ["impulse", "velocity", "good", "pair"]
    size, top = 26, 84
    d.text((165, 40), "four rows", "ink")
    for row in range(4):
        for k in range(6):
            d.box((60 + 35 * k, top + 48 * row), size, size, f"{colours[row]} fill", 3)
        d.text((44, top + 48 * row + 19), str(row), colours[row], "end", "small")
    for k in range(6):
        d.text((60 + 35 * k + size / 2, top - 10), str(k + 1), "soft", size="small")
    d.text((165, 296), "one scalar product: 6 products,\nthen a sum across", "soft", size="small")

    d.text((545, 40), "a pack", "ink")
    for k in range(6):
        for lane in range(4):
            d.box((480 + 35 * lane, top - 6 + 32 * k), size, size, f"{colours[lane]} fill", 3)
        d.text((464, top - 6 + 32 * k + 19), str(k + 1), "soft", "end", "small")
    for lane in range(4):
        d.text((480 + 35 * lane + size / 2, top - 14), str(lane), colours[lane], size="small")
    d.text((545, 296), "four scalar products: 6 times four products,\nsums go down", "soft", size="small")
    d.arrow((310, 172), (420, 172), "ink")
    return d
