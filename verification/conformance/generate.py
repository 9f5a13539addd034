#!/usr/bin/env python3
"""Writes the generated cases: generate.py [--seed N] [--count N] [--labels COMMAND] FOLDER

The same seed and count give the same cases on every machine. COMMAND reads cases and writes their labels; without it, cases are
written without labels. `kinds.json` says why each kind is hard. With --relabel, it labels the cases of a file that was written by
hand.
"""

import argparse
import json
import math
import shlex
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

from depth import depth
from pair_cases import PAIR_KINDS, pair_case
from sources import Format, Source, add, cross, dot, mix, mul, sub, thirds

SEED = 20261128
ENDS = 2
LABELS = ("touches", "first", "exact", "distance", "depth")


def two_triangles(kind, s):
    """Two triangles that touch, or nearly."""
    form = s.form

    def meeting(a, b):
        """The second moved so that they touch; mostly in one point, on either side of a plane."""
        if s.odds(0.4):
            i = s.random.randrange(3)
            step = sub(mix(s.weights(), a), b[i])
            sides = [dot(cross(sub(a[1], a[0]), sub(a[2], a[0])), sub(p, b[i])) for p in (b[i - 1], b[i - 2])]
        else:
            i, j, k, m = s.random.randrange(3), s.random.randrange(3), s.random.randint(0, 8) / 8, s.random.randint(0, 8) / 8
            step = sub(mix((1 - k, k), (a[i], a[i - 1])), mix((1 - m, m), (b[j], b[j - 1])))
            normal = cross(sub(a[i], a[i - 1]), sub(b[j], b[j - 1]))
            sides = [dot(normal, sub(a[i - 2], a[i])), dot(normal, sub(b[j], b[j - 2]))]
        if kind not in ("crossing", "zero-size") and sides[0] * sides[1] <= 0 and s.odds(0.95):
            return meeting(a, s.points(3))
        return [add(p, step) for p in b]

    if kind == "generic":
        return [s.any_point() for _ in range(3)], [s.any_point() for _ in range(3)]
    a, b = s.points(3), s.points(3)
    if kind == "decimal":
        return ([[round(10 * x) / 10 + 0.1 for x in p] for p in t] for t in (a, meeting(a, b)))
    if kind in ("coplanar", "coplanar-ulp"):
        o, x, y = s.points(3)
        at = lambda: add(o, add(mul(s.grid(), x), mul(s.grid(), y)))
        a, b = [at() for _ in range(3)], [at() for _ in range(3)]
        return (a, s.nudged(b)) if "ulp" in kind else (a, b)
    if kind == "parallel":
        height = s.pick(1.0, form.next(1.0, True), form.next(1.0, False), 1 + 2.0**-20)
        return [[s.grid(), s.grid(), 1.0] for _ in range(3)], [[s.grid(), s.grid(), height] for _ in range(3)]
    if kind == "zero-size":
        b[2] = s.pick(b[0], b[1], mix((0.5, 0.5), b[:2]), mix((2, -1), b[:2]))
        b = meeting(a, [b[0]] * 3 if s.odds(0.2) else b)
        return (s.nudged(a), b) if s.odds(0.5) else (a, b)
    if kind in ("duplicate", "duplicate-ulp"):
        n = s.pick(1, 1, 2, 2, 3)
        b[:n] = [list(p) for p in a[:n]]
        return (a, s.nudged(b)) if "ulp" in kind else (a, b)
    b = meeting(a, b)
    if kind == "gap":
        step = s.gap()
        return a, [add(p, step) for p in b]
    if kind == "grazing-ulp":
        return (a, s.nudged_side(b)) if s.odds(0.5) else (s.nudged_side(a), b)
    if kind == "rounded":
        return [thirds(p) for p in a], [thirds(p) for p in b]
    if kind == "sliver":
        k, f = s.random.randrange(3), 2.0 ** -s.random.randint(10, 40)
        return ([[x * f if i == k else x for i, x in enumerate(p)] for p in t] for t in (a, b))
    if kind == "huge-over-tiny":
        # A small triangle with its corner on the face of a large one.
        corner = mix((0.25, 0.25, 0.5), a)
        small = 2.0 ** -s.random.randint(8, 20 if form.is_single else 40)
        return a, [corner, add(corner, mul(small, s.point())), add(corner, mul(small, s.point()))]
    if kind == "subnormal":
        return ([mul(64 * form.tiny, p) for p in t] for t in (a, b))
    return a, b


TRIANGLE_KINDS = """generic crossing decimal gap grazing grazing-ulp rounded parallel coplanar coplanar-ulp zero-size
duplicate duplicate-ulp sliver huge-over-tiny subnormal""".split()


def moving_triangle(kind, s):
    """A triangle at rest, the start of another, and its translation."""
    if kind == "generic":
        a, b = two_triangles(kind, s)
        step = s.any_point(2.0)
        return a, [sub(p, mul(0.5, step)) for p in b], step
    shape = {
        "at-start": "grazing",
        "short": "grazing",
        "at-end": "grazing",
        "at-end-ulp": "grazing-ulp",
        "sliding": "coplanar",
        "fast": "grazing",
    }
    a, b = two_triangles(shape.get(kind, kind), s)
    size = max(abs(x) for p in a for x in p) or 1.0
    unit = 64 * s.form.tiny if kind == "subnormal" else 2.0 ** math.floor(math.log2(size))
    step = mul(unit * (2.0**8 if kind == "fast" else 1), s.point())
    if kind == "sliding":
        step = sub(a[0], a[1])
    if not any(step):
        step = [unit, 0.0, 0.0]
    time = {"at-start": 0.0, "at-end": 1.0, "at-end-ulp": 1.0, "gap": s.pick(0.0, 1.0)}.get(kind, s.time())
    if kind == "short":
        # The step ends a little before the contact.
        time = 1 + 2.0 ** -s.random.randint(4, 18 if s.form.is_single else 40)
    return a, [sub(p, mul(time, step)) for p in b], step


MOVING_KINDS = TRIANGLE_KINDS + ["at-start", "at-end", "at-end-ulp", "short", "sliding", "fast"]


def sheet(s, width, depth, height=lambda x, y: 0.0):
    """A sheet of 2 * width * depth triangles over a grid of eighths."""
    points = [[x / 4, y / 4, height(x, y)] for y in range(depth + 1) for x in range(width + 1)]
    at = lambda x, y: y * (width + 1) + x
    faces = []
    for y in range(depth):
        for x in range(width):
            corners = at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)
            faces += [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]
    return points, faces


def joined(one, other):
    return one[0] + other[0], one[1] + [[v + len(one[0]) for v in f] for f in other[1]], len(one[1])


def fan(s, height, around):
    """Five triangles around a vertex."""
    ring = [(4, 0), (1, 4), (-4, 2), (-3, -3), (2, -4)]
    points = [[0.0, 0.0, height]] + [[x / 8, y / 8, around()] for x, y in ring]
    return points, [[0, 1 + i, 1 + (i + 1) % 5] for i in range(5)]


def patch(s):
    if s.odds(0.5):
        return sheet(s, 2, s.pick(1, 2), lambda x, y: s.pick(0.0, 0.125, -0.125))
    return fan(s, s.grid() / 4, lambda: s.grid() / 4)


def turned(points, axis):
    return [[p[axis], p[axis - 2], p[axis - 1]] for p in points]


def two_meshes(kind, s):
    """Two patches at rest: positions, faces, and the number of faces of the first."""
    form = s.form
    (p, f), (q, g) = patch(s), patch(s)
    q = turned(q, s.random.randrange(3))
    if kind in ("parallel", "parallel-ulp", "coplanar", "corner-on-face", "corner-on-face-ulp", "gap"):
        p, f = sheet(s, 2, 2)
        height = {"parallel": s.pick(2.0**-20, -(2.0**-10), 0.0), "parallel-ulp": s.pick(form.eps, -form.eps, form.tiny)}.get(
            kind, 0.0
        )
        q, g = sheet(s, 2, 1) if kind[0] in "pc" and "corner" not in kind else fan(s, 0.0, lambda: s.random.randint(1, 8) / 32)
        step = [s.random.randint(-5, 5) / 8, s.random.randint(-5, 5) / 8, height]
        if "corner" in kind or kind == "gap":
            step = sub(mix(s.weights(), [p[v] for v in s.pick(*f)]), q[0])
    elif kind in ("edge-on-edge", "edge-on-edge-ulp"):
        # Two roofs, one upside down, whose ridges cross.
        p, f = sheet(s, 2, 2, lambda x, y: -abs(x - 1) / 8)
        q, g = sheet(s, 2, 2, lambda x, y: abs(y - 1) / 8)
        step = [s.random.randint(-2, 2) / 8, s.random.randint(-2, 2) / 8, 0.0]
    elif kind == "duplicate":
        step = sub(s.pick(*p), s.pick(*q))
    elif kind == "generic":
        p, q = [add(x, s.any_point(0.05)) for x in p], [add(x, s.any_point(0.05)) for x in q]
        step = s.any_point(0.5)
    else:
        step = sub(mix((0.25, 0.25, 0.5), [p[v] for v in s.pick(*f)]), s.pick(*q))
    q = [add(x, step) for x in q]
    if kind.endswith("ulp"):
        # At height 1, where a unit in the last place is that of the other coordinates.
        p, q, up = [add(x, [0.0, 0.0, 1.0]) for x in p], [add(x, [0.0, 0.0, 1.0]) for x in q], s.odds(0.6)
        q = [[x, y, form.next(z, up)] for x, y, z in q]
    if kind == "gap":
        gap = abs(sum(s.gap()))
        q = [add(x, [0.0, 0.0, gap]) for x in q]
    if kind == "zero-size":
        g = [*g, [g[0][0], g[0][1], g[0][1]], [g[0][2]] * 3]
    if kind == "rounded":
        p, q = [thirds(x) for x in p], [thirds(x) for x in q]
    return joined((p, f), (q, g))


MESH_KINDS = """generic crossing gap corner-on-face corner-on-face-ulp edge-on-edge edge-on-edge-ulp parallel parallel-ulp
coplanar duplicate zero-size rounded""".split()


def moving_mesh(kind, s):
    """A mesh in motion: start, end and faces."""
    form = s.form
    if kind == "folding":
        # A strip folds onto itself; its last row falls on the first or beside it.
        p, f = sheet(s, 1, 4)
        gap = s.pick(0.0, form.eps, -form.eps, 2.0**-6, -(2.0**-6))
        rows = [(0, 0), (1, 0), (1.5, 0.5), (1, 1), (0, gap)]
        end = [[x, rows[i // 2][0] / 4, rows[i // 2][1] / 4] for i, (x, _, _) in enumerate(p)]
        return p, end, f
    if kind in ("sheets-pass", "sheets-near", "sheets-meet", "sheets-meet-ulp", "sheets-slide"):
        p, f, _ = joined(sheet(s, 2, 1), sheet(s, 1, 2))
        step = [s.random.randint(-3, 3) / 16, s.random.randint(-3, 3) / 16, 0.25]
        start = p[:6] + [add(x, step) for x in p[6:]]
        down = {"sheets-pass": s.pick(-0.5, -0.375), "sheets-slide": -s.pick(0.0, 0.125)}.get(kind, -0.25)
        if kind == "sheets-near":
            down += abs(sum(s.gap()))
        move = [s.random.randint(-8, 8) / 16, s.random.randint(-8, 8) / 16, down]
        end = [add(x, mul(0.25, s.point()) if kind == "sheets-pass" else [0.0] * 3) for x in start[:6]]
        end += [add(x, move) for x in start[6:]]
        return (start, s.nudged(end), f) if kind.endswith("ulp") else (start, end, f)
    (p, f), (q, g) = patch(s), patch(s)
    q = [add(x, [s.grid() / 4, s.grid() / 4, 1.0]) for x in q]
    if kind == "zero-size":
        g = [*g, [g[0][0], g[0][1], g[0][1]], [g[0][2]] * 3]
    p, f, _ = joined((p, f), (q, g))
    if kind == "generic":
        p = [add(x, s.any_point(0.05)) for x in p]
        return p, [add(x, s.any_point(0.7)) for x in p], f
    n = len(p) - len(q)
    move = [s.grid(), s.grid(), -s.pick(0.5, 1.0, 2.0)]
    end = [add(x, mul(0.25, s.point())) for x in p[:n]] + [add(x, move) for x in p[n:]]
    if kind == "rounded":
        return [thirds(x) for x in p], [thirds(x) for x in end], f
    return p, end, f


MOVING_MESH_KINDS = (
    "generic patches folding sheets-pass sheets-near sheets-meet sheets-meet-ulp sheets-slide zero-size rounded".split()
)

QUESTIONS = {
    "vertex-face": (PAIR_KINDS, 40),
    "edge-edge": (PAIR_KINDS, 40),
    "triangles": (TRIANGLE_KINDS, 50),
    "moving-triangle": (MOVING_KINDS, 40),
    "meshes": (MESH_KINDS, 50),
    "moving-mesh": (MOVING_MESH_KINDS, 60),
}
UNPLACED = {"subnormal", "generic", "decimal"}
SCALES = [-30, -20, -10, 0, 0, 0, 0, 10, 20, 30]


def made(question, kind, source):
    """The points of a case, all in one list of ends, and what else belongs to it."""
    if question in ("vertex-face", "edge-edge"):
        start, end = pair_case(kind, question == "edge-edge", source)
        return [start, end], {}
    if question == "triangles":
        a, b = two_triangles(kind, source)
        return [a + b], {}
    if question == "moving-triangle":
        a, b, step = moving_triangle(kind, source)
        return [a + b], {"move": step}
    if question == "meshes":
        points, faces, split = two_meshes(kind, source)
        return [points], {"faces": faces, "split": split}
    start, end, faces = moving_mesh(kind, source)
    return [start, end], {"faces": faces}


def placed(ends, more, kind, source):
    """The case at one of several sizes and places, with all coordinates rounded to the format."""
    place = "centre"
    if kind not in UNPLACED:
        scale = source.pick(*SCALES)
        if scale:
            place = f"times 2^{scale}"
            factor = 2.0**scale
            ends = [[mul(factor, p) for p in e] for e in ends]
            if "move" in more:
                more = {**more, "move": mul(factor, more["move"])}
        elif source.odds(0.3):
            place = "far"
            offset = [source.form.far, -source.form.far, source.form.far]
            if kind.endswith("ulp"):
                # Rounded first, then nudged, so that a unit in the last place is that of the place.
                ends = [[[source.form.round(x) for x in add(p, offset)] for p in e] for e in ends]
                ends[-1] = source.nudged(ends[-1])
            else:
                ends = [[add(p, offset) for p in e] for e in ends]
    elif kind in ("generic", "decimal"):
        power = source.pick(0, 0, 0, -9, -6, -3, 3, 6, 9)
        if power:
            place = f"times 1e{power}"
            factor = 10.0**power
            ends = [[mul(factor, p) for p in e] for e in ends]
            if "move" in more:
                more = {**more, "move": mul(factor, more["move"])}
    return [[[source.form.round(x) for x in p] for p in e] for e in ends], more, place


def with_exact_move(points, move, form):
    """Rounds a translation and the triangle that moves, until their sums are numbers of the format; None if they cannot be."""
    move = [form.round(x) for x in move]
    for attempt in range(4):
        exact = True
        for p in points[3:]:
            for k in range(3):
                end = form.round(p[k] + move[k])
                if Fraction(p[k]) + Fraction(move[k]) != Fraction(end):
                    p[k] = form.round(end - move[k])
                    exact = False
        if exact:
            return points, move
        # Fewer bits for the translation.
        size = max(abs(x) for p in points for x in p) or 1.0
        unit = 2.0 ** (math.floor(math.log2(size)) - (20 if form.is_single else 46) + 2 * attempt)
        move = [form.round(round(x / unit) * unit) for x in move]
        if not any(move):
            return None
    return None


def hexadecimal(x):
    text = (x + 0.0).hex()
    if "p" not in text:
        return text
    mantissa, exponent = text.split("p")
    return (mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa) + "p" + exponent


def rows(points):
    return [[hexadecimal(x) for x in p] for p in points]


def generated(question, count):
    kinds, own_count = QUESTIONS[question]
    for name in ("f64", "f32"):
        form = Format(name)
        for kind in kinds:
            source = Source(f"{SEED}/{question}/{kind}", form)
            number = 0
            while number < (count or own_count):
                ends, more = made(question, kind, source)
                ends, more, place = placed(ends, more, kind, source)
                if "move" in more:
                    moved = with_exact_move(ends[0], more["move"], form)
                    if moved is None:
                        continue
                    ends[0], move = moved
                    more = {"move": [hexadecimal(x) for x in move]}
                number += 1
                case = {
                    "id": f"{question}/{name}/{kind}/{number:03}",
                    "question": question,
                    "format": name,
                    "kind": kind,
                    "place": place,
                }
                case["start"] = rows(ends[0])
                if len(ends) == ENDS:
                    case["end"] = rows(ends[1])
                yield {**case, **more}


def text(case):
    return json.dumps(case, separators=(",", ":"))


def labelled(cases, command):
    """The cases with the labels that a command writes."""
    run = subprocess.run(
        shlex.split(command), input="".join(text(c) + "\n" for c in cases), stdout=subprocess.PIPE, text=True, check=True
    )
    for case, line in zip(cases, run.stdout.splitlines(), strict=True):
        label = json.loads(line)
        if label.pop("id") != case["id"]:
            sys.exit(f"the labels of {case['id']} are missing")
        for key in ("first", "distance"):
            if key in label:
                label[key] = [hexadecimal(float(x)) for x in label[key]]
        if not label.get("exact") or len(label["exact"]) > 40:
            label.pop("exact", None)
        if case["question"] in ("triangles", "meshes"):
            label.pop("first", None), label.pop("exact", None)
        if label["touches"]:
            label["depth"] = hexadecimal(depth({**case, **label}))
        yield {**case, **label}


def main():
    global SEED
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--count", type=int, help="cases of each kind and format")
    parser.add_argument("--labels", help="a command that labels cases")
    parser.add_argument("--question", choices=QUESTIONS, action="append", help="only this question")
    parser.add_argument("--relabel", action="store_true", help="label the file that stands in place of the folder")
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    SEED = arguments.seed
    if arguments.relabel:
        cases = map(json.loads, arguments.folder.read_text(encoding="ascii").splitlines())
        cases = [{k: v for k, v in case.items() if k not in LABELS} for case in cases]
        written = "".join(text(case) + "\n" for case in labelled(cases, arguments.labels))
        arguments.folder.write_text(written, encoding="ascii")
        return
    for question in arguments.question or QUESTIONS:
        cases = list(generated(question, arguments.count))
        if arguments.labels:
            cases = list(labelled(cases, arguments.labels))
        path = arguments.folder / f"{question}.jsonl"
        path.write_text("".join(text(case) + "\n" for case in cases), encoding="ascii")
        print(f"{path}: {len(cases)} cases, {path.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
