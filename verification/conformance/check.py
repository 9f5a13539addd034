#!/usr/bin/env python3
"""Checks the labels of cases with Python's integers alone: check.py FILE.jsonl...

This program shares no code and no number type with the one that wrote the labels. It decides each question from definitions:

* A vertex and a face, or two edges, touch if the four points are coplanar and their projections along all three axes touch. In a
  projection, closed sets touch if boxes overlap and no line through two points of one strictly separates the others.
* The earliest time of a contact is 0 or a root of one of the polynomials whose signs the definition needs. Roots are isolated by
  Descartes' rule of signs. Signs at a root come from intervals, and zeros from greatest common divisors.
* A pair comes within a distance if a vertex does of a vertex, of the inside of an edge or of the inside of a face, or the insides
  of two edges do of each other. These are polynomial inequalities, too.

Coordinates of a case are scaled to integers, so nothing is rounded.
"""

import json
import sys
from fractions import Fraction
from itertools import product
from math import gcd

# Polynomials are lists of integers, lowest power first; the zero polynomial is the empty list.


def trim(p):
    while p and p[-1] == 0:
        p.pop()
    return p


def add(p, q, sign=1):
    n = max(len(p), len(q))
    return trim([(p[i] if i < len(p) else 0) + sign * (q[i] if i < len(q) else 0) for i in range(n)])


def sub(p, q):
    return add(p, q, -1)


def mul(p, q):
    if not p or not q:
        return []
    out = [0] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        if a:
            for j, b in enumerate(q):
                out[i + j] += a * b
    return trim(out)


def scaled(p, factor):
    return trim([factor * a for a in p])


def minus(a, b):
    return [sub(x, y) for x, y in zip(a, b)]


def dot(a, b):
    return add(add(mul(a[0], b[0]), mul(a[1], b[1])), mul(a[2], b[2]))


def cross(a, b):
    return [sub(mul(a[i - 2], b[i - 1]), mul(a[i - 1], b[i - 2])) for i in range(3)]


def sign(x):
    return (x > 0) - (x < 0)


def value_sign(p, n, d):
    """The sign of p(n / d), for d > 0."""
    total, power = 0, 1
    for a in reversed(p):
        total = total * n + a * power
        power *= d
    return sign(total)


def primitive(p):
    g = gcd(*p) if p else 1
    return [a // g for a in p] if g > 1 else p


def remainder(p, q):
    """A positive or negative multiple of the remainder of p by q."""
    p = list(p)
    while len(p) >= len(q):
        lead, shift = p[-1], len(p) - len(q)
        p = [a * q[-1] for a in p]
        for i, b in enumerate(q):
            p[i + shift] -= lead * b
        trim(p)
        p = primitive(p)
    return p


def common_divisor(p, q):
    p, q = primitive(p), primitive(q)
    while q:
        p, q = q, remainder(p, q)
    return p


def quotient(p, q):
    """p / q for q that divides p, up to a constant."""
    p, out = list(p), [0] * (len(p) - len(q) + 1)
    while len(p) >= len(q):
        lead, shift = p[-1], len(p) - len(q)
        p = [a * q[-1] for a in p]
        out = [a * q[-1] for a in out]
        out[shift] += lead
        for i, b in enumerate(q):
            p[i + shift] -= lead * b
        p.pop()
        trim(p)
    return primitive(out)


def on_interval(p, n, k):
    """2^(k degree) p((n + x) / 2^k): the polynomial with [n, n + 1] / 2^k stretched to [0, 1]."""
    degree = len(p) - 1
    p = [a << (k * (degree - i)) for i, a in enumerate(p)]
    for i in range(degree):
        for j in range(degree - 1, i - 1, -1):
            p[j] += n * p[j + 1]
    return p


def variations(p):
    """Descartes' bound on the number of roots in the open interval (0, 1); exact if it is 0 or 1."""
    p = list(reversed(p))
    for i in range(len(p)):
        for j in range(len(p) - 2, i - 1, -1):
            p[j] += p[j + 1]
    signs = [sign(a) for a in p if a]
    return sum(a != b for a, b in zip(signs, signs[1:]))


class Root:
    """A root in [0, 1]: n / d, or the only root of the squarefree `p` in the open interval (n, n + 1) / 2^k."""

    def __init__(self, p, n, k, rational):
        self.p, self.n, self.k, self.rational = p, n, k, rational
        self.left = 0 if rational is not None else value_sign(p, n, 1 << k)

    def halve(self):
        self.n, self.k = 2 * self.n, self.k + 1
        middle = value_sign(self.p, self.n + 1, 1 << self.k)
        if middle == 0:
            self.rational, self.n, self.k = Fraction(self.n + 1, 1 << self.k), 0, 0
        elif middle == self.left:
            self.n += 1

    def compare(self, x):
        """The sign of root - x."""
        if self.rational is not None:
            return sign(self.rational - x)
        if x <= Fraction(self.n, 1 << self.k):
            return 1
        if x >= Fraction(self.n + 1, 1 << self.k):
            return -1
        at = value_sign(self.p, x.numerator, x.denominator)
        return 0 if at == 0 else 1 if at == self.left else -1

    def sign_of(self, q):
        if not q:
            return 0
        for step in range(1 << 16):
            if self.rational is not None:
                return value_sign(q, self.rational.numerator, self.rational.denominator)
            if step == 12:
                shared = common_divisor(self.p, q)
                ends = [value_sign(shared, self.n + i, 1 << self.k) for i in (0, 1)]
                if ends[0] != ends[1]:
                    return 0
            if variations(on_interval(q, self.n, self.k)) == 0:
                at = value_sign(q, 2 * self.n + 1, 2 << self.k)
                if at:
                    return at
            self.halve()
        raise ArithmeticError("a sign stays undecided")


def roots(p):
    """The roots of p in [0, 1], each once, in no order."""
    p = primitive(list(p))
    found = []
    if len(p) > 2:
        p = quotient(p, common_divisor(p, [i * a for i, a in enumerate(p)][1:]))
    todo = [(0, 0)]
    for end in (0, 1):
        if len(p) > 1 and value_sign(p, end, 1) == 0:
            found.append(Root(None, 0, 0, Fraction(end)))
            p = quotient(p, [-end, 1])
    if len(p) == 2:
        at = Fraction(-p[0], p[1])
        return found + ([Root(None, 0, 0, at)] if 0 < at < 1 else [])
    while todo and len(p) > 1:
        n, k = todo.pop()
        count = variations(on_interval(p, n, k))
        if count == 1:
            found.append(Root(p, n, k, None))
        elif count > 1:
            n, k = 2 * n, k + 1
            if value_sign(p, n + 1, 1 << k) == 0:
                # A root at the cut: without it, from the beginning.
                kept = [r for r in found if r.p is None] + [Root(None, 0, 0, Fraction(n + 1, 1 << k))]
                return kept + roots(quotient(p, [-(n + 1), 1 << k]))
            todo += [(n, k), (n + 1, k)]
    return found


START = Root(None, 0, 0, Fraction(0))

# Pairs: four points, each three polynomials in the time. A vertex and a face, or two edges.


def volume(a, b, c, d):
    return dot(minus(b, a), cross(minus(c, a), minus(d, a)))


def turn(a, b, c, axis):
    i, j = axis - 2, axis - 1
    u, v = minus(b, a), minus(c, a)
    return sub(mul(u[i], v[j]), mul(u[j], v[i]))


def pair_polynomials(kind, points):
    """Groups of polynomials. The pair touches when coplanar if in no group all signs are (strictly) alike, or, for turns of a
    face, in no group two signs are opposite."""
    a, b, c, d = points
    alike, opposite = [], []
    if kind == "vertex-face":
        for x in range(3):
            alike.append([sub(a[x], q[x]) for q in (b, c, d)])
            opposite.append([turn(p, q, a, x) for p, q in ((b, c), (c, d), (d, b))])
    else:
        for x in range(3):
            alike.append([sub(q[x], p[x]) for p in (a, b) for q in (c, d)])
            alike += [[turn(a, b, q, x) for q in (c, d)], [turn(c, d, q, x) for q in (a, b)]]
    return alike, opposite


def touches(root, groups):
    alike, opposite = groups
    for group in opposite:
        signs = {root.sign_of(p) for p in group}
        if 1 in signs and -1 in signs:
            return False
    for group in alike:
        first = root.sign_of(group[0])
        if first and all(root.sign_of(p) == first for p in group[1:]):
            return False
    return True


def contacts(kind, points):
    """Times at which the pair touches. The first contact is among them, if there is one."""
    groups = pair_polynomials(kind, points)
    v = volume(*points)
    if v:
        return [r for r in roots(v) if touches(r, groups)]
    polynomials = [p for side in groups for group in side for p in group if len(p) > 1]
    times = [START] + [r for p in polynomials for r in roots(p)]
    return [r for r in times if touches(r, groups)]


def inequalities(kind, points):
    """For each pair of features: numerator and denominator of the squared distance of their lines and planes, and
    polynomials that are at most zero where the closest points lie on the features."""
    one = [1]
    sides = [(points[0],), points[1:]] if kind == "vertex-face" else [points[:2], points[2:]]
    for p, q in product(*sides):
        d = minus(p, q)
        yield dot(d, d), one, []

    def on_edge(p, a, b):
        e, d = minus(b, a), minus(p, a)
        n, along, length = cross(d, e), dot(d, e), dot(e, e)
        return dot(n, n), length, [scaled(along, -1), sub(along, length)]

    if kind == "vertex-face":
        p, a, b, c = points
        yield from (on_edge(p, *edge) for edge in ((a, b), (b, c), (c, a)))
        n = cross(minus(b, a), minus(c, a))
        v = dot(minus(p, a), n)
        yield mul(v, v), dot(n, n), [scaled(dot(cross(minus(r, q), minus(p, q)), n), -1) for q, r in ((a, b), (b, c), (c, a))]
    else:
        a, b, c, d = points
        yield from (on_edge(p, a, b) for p in (c, d))
        yield from (on_edge(p, c, d) for p in (a, b))
        e, f, w = minus(b, a), minus(d, c), minus(c, a)
        m = cross(e, f)
        v, mm = dot(w, m), dot(m, m)
        s, t = dot(cross(w, f), m), dot(cross(w, e), m)
        yield mul(v, v), mm, [scaled(s, -1), sub(s, mm), scaled(t, -1), sub(t, mm)]


def comes_within(kind, points, squared):
    """Returns whether the pair comes within a distance, given its square."""
    for over, under, inside in inequalities(kind, points):
        near = sub(scaled(over, squared.denominator), scaled(under, squared.numerator))
        conditions = [near] + inside
        times = [START] + [r for p in conditions if len(p) > 1 for r in roots(p)]
        if any(r.sign_of(under) > 0 and all(r.sign_of(p) <= 0 for p in conditions) for r in times):
            return True
    return False


def apart_by(sides, distance):
    """Returns whether an axis keeps the two sides farther apart than the distance throughout."""
    for x in range(3):
        bounds = [[(min(v), max(v)) for v in zip(*((sum(p[x][:1]), sum(p[x])) for p in side))] for side in sides]
        for one, other in (bounds, bounds[::-1]):
            if all(high[1] + distance < low[0] for high, low in zip(one, other)):
                return True
    return False


def sides_of(kind, points):
    return (points[:1], points[1:]) if kind == "vertex-face" else (points[:2], points[2:])


# Cases.


def triangle_pairs(a, b):
    for p in a:
        yield "vertex-face", [p, *b]
    for p in b:
        yield "vertex-face", [p, *a]
    for i, j in product(range(3), range(3)):
        yield "edge-edge", [a[i], a[i - 1], b[j], b[j - 1]]


def triangles_meet(a, b):
    """Returns whether two closed triangles at rest meet. Their points are constant."""
    if any(contacts(*pair) for pair in triangle_pairs(a, b)):
        return True
    for one, other in ((a, b), (b, a)):
        for i in range(3):
            p, q = one[i], one[i - 1]
            height = [sum(volume(x, *other)) for x in (p, q)]
            if height[0] * height[1] < 0:
                # The point where the edge meets the plane, times the difference of the heights.
                scale = height[1] - height[0]
                x = [sub(scaled(u, height[1]), scaled(v, height[0])) for u, v in zip(p, q)]
                if contacts("vertex-face", [x] + [[scaled(u, scale) for u in r] for r in other]):
                    return True
    return False


def numbers(points):
    return [[float.fromhex(x) for x in point] for point in points]


def read_case(case):
    """The pairs of a case whose contacts and distances matter, triangles at rest that may meet at the start, and the scale."""
    question, start = case["question"], numbers(case["start"])
    move = numbers([case["move"]])[0] if "move" in case else None
    end = numbers(case["end"]) if "end" in case else start
    ratios = [x.as_integer_ratio() for p in [*start, *end, *([move] if move else [])] for x in p]
    scale = max(d for _, d in ratios)
    whole = lambda x: x.as_integer_ratio()[0] * (scale // x.as_integer_ratio()[1])
    line = lambda s, e: [trim([whole(a), whole(b) - whole(a)]) for a, b in zip(s, e)]
    points = [line(s, e) for s, e in zip(start, end)]
    if question in ("vertex-face", "edge-edge"):
        return [(question, points)], [], scale
    if question in ("triangles", "moving-triangle"):
        if move:
            points[3:] = [[trim([whole(x), whole(v)]) for x, v in zip(p, move)] for p in start[3:]]
        return list(triangle_pairs(points[:3], points[3:])), [(points[:3], points[3:])], scale
    faces = case["faces"]
    if question == "meshes":
        first = case["split"]
        pairs = [([points[v] for v in f], [points[v] for v in g]) for f in faces[:first] for g in faces[first:]]
        return [p for a, b in pairs for p in triangle_pairs(a, b)], pairs, scale
    edges = sorted({tuple(sorted((f[i], f[i - 1]))) for f in faces for i in range(3)})
    pairs = [("vertex-face", [v, *f]) for v in range(len(points)) for f in faces if v not in f]
    pairs += [("edge-edge", [*e, *f]) for i, e in enumerate(edges) for f in edges[:i] if not set(e) & set(f)]
    return [(kind, [points[v] for v in pair]) for kind, pair in pairs], [], scale


def fault(case):
    """Returns the error in the label of a case, or None."""
    if case["touches"] is None:
        finite = all(abs(x) < float("inf") for p in numbers(case["start"] + case.get("end", [])) for x in p)
        return "all numbers are finite" if finite else None
    pairs, triangles, scale = read_case(case)
    initial = [[[[trim(x[:1]) for x in p] for p in side] for side in pair] for pair in triangles]
    meets_at_start = any(not apart_by(pair, 0) and triangles_meet(*pair) for pair in initial)
    near = [(k, p) for k, p in pairs if not apart_by(sides_of(k, p), 0)]
    if case["touches"]:
        low, high = (Fraction(float.fromhex(x)) for x in case.get("first", ["0x0p+0", "0x0p+0"]))
        if meets_at_start:
            return None if low == 0 == high else "it touches at the start"
        times = [r for k, p in near for r in contacts(k, p)]
        if not any(r.compare(low) >= 0 >= r.compare(high) for r in times):
            return "no contact in the interval"
        if any(r.compare(low) < (0 if low == high else 1) for r in times):
            return "a contact before the interval"
        if "exact" in case and not any(r.compare(Fraction(case["exact"])) == 0 for r in times):
            return "no contact at the exact time"
        return None
    if meets_at_start or any(contacts(k, p) for k, p in near):
        return "it touches"
    low, high = (Fraction(float.fromhex(x)) * scale for x in case["distance"])
    for bound, expected in ((low, False), (high, True)):
        close = [(k, p) for k, p in pairs if not apart_by(sides_of(k, p), bound)]
        if any(comes_within(k, p, bound * bound) for k, p in close) != expected:
            return "it comes nearer" if bound == low else "it stays farther away"
    return None


def main():
    checked, wrong = {}, 0
    for name in sys.argv[1:]:
        with open(name, encoding="ascii") as lines:
            for line in lines:
                case = json.loads(line)
                problem = fault(case)
                checked[case["question"]] = checked.get(case["question"], 0) + 1
                if problem:
                    wrong += 1
                    print(f"{case['id']}: {problem}")
    print(", ".join(f"{count} {question}" for question, count in checked.items()) + f": {wrong} wrong")
    sys.exit(1 if wrong or not checked else 0)


if __name__ == "__main__":
    main()
