"""Measures the depth of a contact: a share of the size by which one side can be moved without ending it. Scores use it, labels do not."""

from itertools import product

from check import add, apart_by, contacts, read_case, sides_of, triangles_meet, trim

LEVELS = (40, 30, 20, 17, 10)


def moved(points, axis, step):
    return [[add(x, [step]) if i == axis else x for i, x in enumerate(p)] for p in points]


def finer(points, bits):
    return [[[a << bits for a in x] for x in p] for p in points]


def size(points):
    """The largest extent along an axis, of integers."""
    ends = [[v for p in points for v in (sum(p[x][:1]), sum(p[x]))] for x in range(3)]
    return max(max(e) - min(e) for e in ends)


def depth(case):
    """The largest 2^-k of LEVELS such that the contact remains if one side moves by that share of the size along any axis, either
    way; 0 if there is none."""
    pairs, triangles, _ = read_case(case)
    all_points = [p for _, points in pairs for p in points]
    extent = size(all_points)
    touching = [("pair", k, sides_of(k, p)) for k, p in pairs if not apart_by(sides_of(k, p), 0)]
    touching += [("triangles", None, sides) for sides in triangles if not apart_by(sides, 0)]
    found = 0.0
    for bits in LEVELS:
        kept = []
        for what, kind, sides in touching:
            one, other = (finer(side, bits) for side in sides)
            if all(meets(what, kind, one, moved(other, axis, way * extent)) for axis, way in product(range(3), (1, -1))):
                kept.append((what, kind, sides))
        if not kept:
            break
        touching, found = kept, 2.0**-bits
    return found


def meets(what, kind, one, other):
    if apart_by((one, other), 0):
        return False
    if what == "pair":
        return bool(contacts(kind, [*one, *other]))
    at_rest = [[[trim(x[:1]) for x in p] for p in side] for side in (one, other)]
    return triangles_meet(*at_rest)
