"""Number formats, vectors, and random points that touch or nearly touch, for the generated cases."""

import random
import struct


class Format:
    """A number format: rounding, the next number, and exponents."""

    def __init__(self, name):
        self.name = name
        self.is_single = name == "f32"
        self.code = ("<f", "<i") if self.is_single else ("<d", "<q")
        self.tiny = 2.0**-149 if self.is_single else 2.0**-1074
        self.eps = 2.0**-23 if self.is_single else 2.0**-52
        self.far = 2.0**10 if self.is_single else 2.0**23

    def round(self, x):
        return struct.unpack("<f", struct.pack("<f", x))[0] if self.is_single else float(x)

    def next(self, x, up):
        x = self.round(x)
        if x == 0:
            return self.tiny if up else -self.tiny
        bits = struct.unpack(self.code[1], struct.pack(self.code[0], x))[0]
        bits += 1 if (x > 0) == up else -1
        return struct.unpack(self.code[0], struct.pack(self.code[1], bits))[0]


def add(a, b):
    return [x + y for x, y in zip(a, b)]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def mul(s, a):
    return [s * x for x in a]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def mix(weights, points):
    return [sum(w * p[k] for w, p in zip(weights, points)) for k in range(3)]


def thirds(p):
    """A rotation whose matrix has thirds, so that coordinates are rounded."""
    x, y, z = p
    return [(x + 2 * y + 2 * z) / 3, (2 * x + y - 2 * z) / 3, (2 * x - 2 * y + z) / 3]


class Source:
    """Random choices. Most shapes have coordinates of few bits, so that contacts are exact before they are disturbed."""

    def __init__(self, name, form):
        self.random = random.Random(f"{name}/{form.name}")
        self.form = form

    def pick(self, *options):
        return options[self.random.randrange(len(options))]

    def odds(self, share):
        return self.random.random() < share

    def grid(self):
        return self.random.randint(-8, 8) / 8

    def point(self):
        return [self.grid() for _ in range(3)]

    def points(self, n):
        return [self.point() for _ in range(n)]

    def any_point(self, size=1.0):
        return [self.random.uniform(-size, size) for _ in range(3)]

    def time(self):
        return self.pick(1, 2, 3, 5, 6, 7) / 8

    def weights(self):
        while True:
            a, b = self.random.randint(0, 8), self.random.randint(0, 8)
            if a + b <= 8:
                return [a / 8, b / 8, (8 - a - b) / 8]

    def nudged(self, points):
        """The points with one coordinate moved by one unit in the last place."""
        points = [list(p) for p in points]
        p = points[self.random.randrange(len(points))]
        k = self.random.randrange(3)
        p[k] = self.form.next(p[k], self.odds(0.5))
        return points

    def nudged_side(self, points):
        """One coordinate moved by one unit in the last place, or that of all points in the same direction."""
        if self.odds(0.4):
            return self.nudged(points)
        k, up = self.random.randrange(3), self.odds(0.5)
        return [[self.form.next(x, up) if i == k else x for i, x in enumerate(p)] for p in points]

    def gap(self):
        """A small step along an axis, of 2^-10 to 2^-18 (2^-40 in f64)."""
        size = 2.0 ** -self.random.randint(10, 18 if self.form.is_single else 40) * self.pick(-1, 1)
        axis = self.random.randrange(3)
        return [size if k == axis else 0.0 for k in range(3)]

    def touching(self, edges, border=None, between=None):
        """Points at rest that touch in one point: on the inside, or at the border of their features."""
        if edges:
            p = self.points(4)
            a, b = border or (self.random.randint(1, 7) / 8, self.random.randint(1, 7) / 8)
            step = sub(mix((1 - a, a), p[:2]), mix((1 - b, b), p[2:]))
            return p[:2] + [add(q, step) for q in p[2:]]
        face = between or self.points(3)
        return [mix(border or self.weights(), face)] + face

    def border(self, edges):
        if edges:
            return self.pick(0.0, 1.0), self.random.randint(0, 8) / 8
        return self.pick((0.5, 0.5, 0.0), (1.0, 0.0, 0.0), (0.0, 0.25, 0.75), (0.0, 0.0, 1.0))

    def motion(self, edges, time, border=None, speed=1):
        """A pair whose points move in directions of their own and that touches at the time."""
        at = self.touching(edges, border)
        steps = [mul(speed, v) for v in self.points(4)]
        return [sub(p, mul(time, v)) for p, v in zip(at, steps)], [add(p, mul(1 - time, v)) for p, v in zip(at, steps)]
