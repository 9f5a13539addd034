"""The generated cases of one pair: a vertex and a face, or two edges."""

from sources import add, mix, mul, sub, thirds


def pair_case(kind, edges, s):
    """The start and end of a vertex and a face, or of two edges."""
    form = s.form
    if kind == "generic":
        if s.odds(0.5):
            return [s.any_point() for _ in range(4)], [s.any_point() for _ in range(4)]
        border = (s.random.uniform(0.1, 0.9), s.random.uniform(0.1, 0.9)) if edges else (0.25, 0.5, 0.25)
        return tuple([add(p, s.any_point(0.01)) for p in end] for end in s.motion(edges, s.time(), border))
    if kind == "decimal":
        start, end = s.motion(edges, s.time())
        return tuple([[round(10 * x) / 10 + 0.1 for x in p] for p in end] for end in (start, end))
    if kind == "grazing":
        return s.motion(edges, s.time(), s.border(edges))
    if kind == "gap":
        start, end = s.motion(edges, s.pick(0.0, 1.0), s.border(edges))
        n, step = (2 if edges else 1), s.gap()
        return start[:n] + [add(p, step) for p in start[n:]], end[:n] + [add(p, step) for p in end[n:]]
    if kind == "grazing-ulp":
        start, end = s.motion(edges, s.time(), s.border(edges))
        return (s.nudged(start), end) if s.odds(0.5) else (start, s.nudged(end))
    if kind == "rounded":
        start, end = s.motion(edges, s.time(), s.border(edges) if s.odds(0.3) else None)
        return [thirds(p) for p in start], [thirds(p) for p in end]
    if kind == "parallel":
        if edges:
            a, d = s.point(), s.point()
            b = add(a, mul(s.pick(-0.5, 0.25, 0.75, 1.0, 1.125), d))
            rest, step = [a, add(a, d)], s.point()
            move = [b, add(b, mul(s.pick(-1, 1, 2, 0.5), d))]
            t = s.time()
            return rest + [sub(p, mul(t, step)) for p in move], rest + [add(p, mul(1 - t, step)) for p in move]
        face = [[s.grid(), s.grid(), 0.0] for _ in range(3)]
        height = s.pick(0.0, form.tiny, form.eps, -(form.eps**1.5))
        return [[s.grid(), s.grid(), height]] + face, [[s.grid(), s.grid(), height]] + face
    if kind == "parallel-ulp":
        start, end = pair_case("parallel", edges, s)
        return (s.nudged(start), end) if s.odds(0.5) else (start, s.nudged(end))
    if kind in ("coplanar", "coplanar-ulp"):
        o, x, y = s.points(3)
        at = lambda: add(o, add(mul(s.grid(), x), mul(s.grid(), y)))
        start, end = [at() for _ in range(4)], [at() for _ in range(4)]
        return (s.nudged(start), end) if kind == "coplanar-ulp" else (start, end)
    if kind == "sliding":
        # One end travels beside the other's, a little way off.
        start = s.touching(edges, (0.0, 0.0) if edges else (1.0, 0.0, 0.0))
        step, off = mul(s.pick(0.03125, 1.0, 4.0), s.point()), s.pick(0.0, 2.0**-13, 2.0**-17, form.eps * 4)
        end = [add(p, step) for p in start]
        i, j = (s.pick(0, 1), 2) if edges else (0, 1 + s.random.randrange(3))
        start[i][s.random.randrange(3)] += off
        end[j][s.random.randrange(3)] -= off
        return start, end
    if kind == "zero-size":
        start, end = s.motion(edges, s.time())
        if edges:
            i = s.pick(0, 2)
            start[i + 1], end[i + 1] = start[i], end[i]
            if s.odds(0.2):
                start[3 - i], end[3 - i] = start[2 - i], end[2 - i]
        else:
            k = s.pick(0.0, 0.5, 2.0, 1.0)
            start[3], end[3] = (mix((1 - k, k), p[1:3]) for p in (start, end))
        # The second is moved so that they touch in the middle of the step.
        first, second = (start[:2], start[2:]) if edges else (start[:1], start[1:])
        middle = lambda p, q: mul(0.5, add(p, q))
        a = middle(start[0], end[0])
        b = middle(middle(start[2], start[3]), middle(end[2], end[3]))
        step = sub(a, b)
        n = len(first)
        start, end = ([list(p) for p in e[:n]] + [add(p, step) for p in e[n:]] for e in (start, end))
        return (s.nudged(start), end) if s.odds(0.3) else (start, end)
    if kind in ("duplicate", "duplicate-ulp"):
        start, end = s.points(4), s.points(4)
        i, j = (s.random.randrange(2), 2 + s.random.randrange(2)) if edges else (0, 1 + s.random.randrange(3))
        when = s.random.randrange(3)
        if when != 1:
            start[i] = list(start[j])
        if when != 0:
            end[i] = list(end[j])
        if kind == "duplicate-ulp":
            return (s.nudged(start), end) if when != 1 else (start, s.nudged(end))
        return start, end
    if kind in ("at-start", "at-end", "at-start-ulp", "at-end-ulp"):
        at_end = "end" in kind
        start, end = s.motion(edges, 1.0 if at_end else 0.0, s.border(edges) if s.odds(0.3) else None)
        if "ulp" in kind:
            return (start, s.nudged(end)) if at_end else (s.nudged(start), end)
        return start, end
    if kind == "sliver":
        # A direction is flattened.
        k, f = s.random.randrange(3), 2.0 ** -s.random.randint(10, 40)
        start, end = s.motion(edges, s.time(), s.border(edges) if s.odds(0.3) else None)
        flat = lambda p: [x * f if i == k else x for i, x in enumerate(p)]
        return [flat(p) for p in start], [flat(p) for p in end]
    if kind == "huge-over-tiny":
        start, end = s.motion(edges, s.time(), s.border(edges) if s.odds(0.3) else None)
        small = 2.0 ** -s.random.randint(20, 60)
        n = s.random.randint(1, 3)
        return tuple([mul(small, p) if i < n else p for i, p in enumerate(e)] for e in (start, end))
    if kind == "subnormal":
        start, end = s.motion(edges, s.pick(0.25, 0.5), s.border(edges) if s.odds(0.3) else None)
        return [mul(32 * form.tiny, p) for p in start], [mul(32 * form.tiny, p) for p in end]
    if kind == "half-turn":
        # Every point goes to its mirror image, so that all meet in one point half-way.
        start = s.touching(edges) if s.odds(0.5) else s.points(4)
        centre = s.point() if s.odds(0.5) else [0.0] * 3
        end = [sub(mul(2, centre), p) for p in start]
        if s.odds(0.5):
            i = s.random.randrange(4)
            end[i] = add(end[i], mul(s.pick(form.eps, 0.25, 1.0), s.point()))
        return start, end
    if kind == "quarter-turn":
        # One side turns about an axis by a right angle: the volume has double roots.
        start = s.touching(edges) if s.odds(0.5) else s.points(4)
        n, x = (2 if edges else 1), s.random.randrange(3)
        turn = lambda p: [p[x] if k == x else (-p[(x + 2) % 3] if k == (x + 1) % 3 else p[(x + 1) % 3]) for k in range(3)]
        return start, start[:n] + [turn(p) for p in start[n:]]
    if kind == "double-root":
        # The height over the other is a square in time, plus a gap of nothing or of little.
        gap, at, step = s.pick(0.0, form.eps, -form.eps, 2.0**-10, -(2.0**-10)), s.time(), s.pick(1.0, 0.5, 2.0)
        low, high = -at * step, (1 - at) * step
        if edges:
            here = lambda u: [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0 - u, gap - u], [0.0, 1.0 - u, gap + u]]
        else:
            here = lambda u: [[0.0, u, gap], [-1.0, -1.0, -u], [1.0, -1.0, -u], [0.0, 1.0, u]]
        return here(low), here(high)
    if kind == "fast":
        return s.motion(edges, s.time(), s.border(edges) if s.odds(0.3) else None, s.pick(2.0**8, 2.0**12))
    if kind == "still":
        start = s.touching(edges, s.border(edges) if s.odds(0.5) else None)
        start = s.nudged(start) if s.odds(0.5) else start
        return start, start
    raise KeyError(kind)


PAIR_KINDS = """generic decimal gap grazing grazing-ulp rounded parallel parallel-ulp coplanar coplanar-ulp sliding zero-size
duplicate duplicate-ulp at-start at-end at-start-ulp at-end-ulp sliver huge-over-tiny subnormal half-turn quarter-turn double-root
fast still""".split()
