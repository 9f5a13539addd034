#!/usr/bin/env python3
"""Checks that the proofs notice mutations of core's kernels: of a sign, a constant, an order of operations, a comparison.

    mutations.py [FOLDER [FIRST LAST]]    takes half an hour; needs cargo and the tools of check.sh

With numbers, tries only these mutations. A folder that an earlier run filled has the compiled proofs, as long as these are the same.

Makes each mutation in a copy of core and traces its terms. Fails if these are the accepted ones, since then nothing notices the mutation.
Otherwise Coq tries to prove the new terms, up to the first file that it refuses. Those that it proves are as sound as the code, and only the
comparison of terms (a test) refuses them. Writes the rows of docs/proof-mutations.md.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PAGE = ROOT / "docs/proof-mutations.md"
SECONDS = 300
# The proofs that build on each file of terms, and those that build on both.
ABOVE = {name: line.split() for name, line in re.findall(r"^# above (\w+): (.*)$", (HERE / "check.sh").read_text(), re.M)}

HEAD = (
    "# Mutations that the proofs notice\n\n`verification/proofs/mutations.py` writes this page. It makes each mutation in a copy of core and traces the new terms. It "
    "compares\nthem with the accepted ones, and has Coq try to prove them. See [proof.md](proof.md).\n\n"
    "| | in `core/src` | mutation | refused by |\n|---|---|---|---|\n"
)

# A file of core/src, the code, its replacement, and the occurrence to replace (the first is 0).
MUTATIONS = [
    ("kernels/coplanarity.rs", "b: [b0 - a0, b1 - a1]", "b: [a0 - b0, b1 - a1]", 0),
    ("kernels/coplanarity.rs", "c: [c0 - a0, c1 - a1]", "c: [c0 - a0, c1 - a0]", 0),
    ("kernels/coplanarity.rs", "p0.dot(h) + p1.dot(n0)", "p0.dot(h) - p1.dot(n0)", 0),
    ("kernels/coplanarity.rs", "p0.dot(h) + p1.dot(n0)", "p1.dot(n0) + p0.dot(h)", 0),
    ("kernels/coplanarity.rs", "p1.dot(h) + p0.dot(n1)", "p1.dot(h) + p0.dot(n0)", 0),
    ("kernels/coplanarity.rs", "b0.cross(c1) + b1.cross(c0)", "b0.cross(c1) - b1.cross(c0)", 0),
    ("kernels/coplanarity.rs", "L::Scalar::small(16)", "L::Scalar::small(15)", 0),
    ("kernels/coplanarity.rs", "L::Scalar::small(20)", "L::Scalar::small(19)", 0),
    ("kernels/coplanarity.rs", "L::Scalar::small(96)", "L::Scalar::small(48)", 0),
    ("kernels/coplanarity.rs", "p1.dot(h) + p0.dot(n1)", "p1.dot(h)", 1),
    ("kernels/coplanarity.rs", "more * more * more", "more * more", 0),
    ("kernels/coplanarity.rs", "largest.x * largest.y * largest.z", "largest.x * largest.y * largest.y", 0),
    ("kernels/coplanarity.rs", "LARGEST_EDGE).greater(largest)", "LARGEST_EDGE).greater(-largest)", 0),
    ("kernels/coplanarity.rs", "(-e2).greater(k2)", "e2.greater(k2)", 0),
    ("kernels/coplanarity.rs", "k1.greater(e1)", "k1.greater(e0)", 0),
    ("kernels/coplanarity.rs", "k0.greater(e0) & k1.greater(e1)", "k0.greater(e0) | k1.greater(e1)", 0),
    ("kernels/coplanarity.rs", "let zero = sum - sum;", "let zero = sum + sum;", 0),
    ("kernels/coplanarity.rs", "c0.abs().larger(c1.abs())", "c0.abs().smaller(c1.abs())", 0),
    ("filter/certified.rs", "largest.x.splat(L::Scalar::small(4))", "largest.x.splat(L::Scalar::small(3))", 0),
    ("filter/certified.rs", "least.larger(-greatest)", "least.larger(greatest)", 0),
    ("filter/certified.rs", "k0.smaller(k1).smaller(k2.smaller(k3))", "k0.smaller(k1).smaller(k2.larger(k3))", 0),
    ("filter/certified.rs", "of_one_sign.greater(bound) & in_range", "of_one_sign.greater(bound)", 0),
    ("filter/certified.rs", "(values.one_sign_beyond(bounds) & in_range)", "values.one_sign_beyond(bounds)", 0),
    ("kernels/vector.rs", "(self.x * other.x + self.y * other.y) + self.z * other.z", "(self.x * other.x + self.y * other.y) - self.z * other.z", 0),
    ("kernels/vector.rs", "(self.x * other.x + self.y * other.y) + self.z * other.z", "self.x * other.x + (self.y * other.y + self.z * other.z)", 0),
    ("kernels/vector.rs", "self.z * other.x - self.x * other.z", "self.x * other.z - self.z * other.x", 0),
    ("kernels/vector.rs", "self.z * other.x + self.x * other.z", "self.z * other.x - self.x * other.z", 0),
    ("kernels/vector.rs", "self.x.larger(self.y).larger(self.z)", "self.x.larger(self.y)", 0),
    ("kernels/vector.rs", "Self::new(self.x.abs(), self.y.abs(), self.z.abs())", "Self::new(self.x.abs(), self.y.abs(), self.z)", 0),
    ("kernels/points.rs", "[a, b, c, vertex]", "[a, c, b, vertex]", 0),
    ("kernels/points.rs", "[k, u, v, l]", "[u, k, v, l]", 0),
    ("kernels/lanes.rs", "underflow: -117", "underflow: -120", 0),
    ("kernels/lanes.rs", "largest_edge: 30", "largest_edge: 33", 0),
    ("kernels/points.rs", "a.smaller(b).smaller(c)", "a.smaller(b)", 0),
    ("kernels/points.rs", "u.larger(v)", "u.smaller(v)", 0),
    ("boxes/mod.rs", "low_0.smaller(low_1)", "low_0.larger(low_1)", 0),
    ("boxes/mod.rs", "other_high_0.larger(other_high_1)", "other_high_0", 0),
    ("boxes/relative.rs", "low_1.greater(other_high_1)", "low_1.greater(other_high_0)", 0),
    ("boxes/relative.rs", "(low_0.greater(other_high_0) & low_1", "(low_0.greater(other_high_0) | low_1", 0),
    ("boxes/relative.rs", "other_low_1.greater(high_1)", "other_low_1.greater(high_0)", 0),
    ("kernels/advance/corners.rs", "start.scaled(rest) + end.scaled(time)", "start.scaled(time) + end.scaled(rest)", 0),
    ("kernels/advance/corners.rs", "start.scaled(rest) + end.scaled(time)", "start.scaled(rest) - end.scaled(time)", 0),
    ("kernels/advance/corners.rs", "time.splat(L::Scalar::ONE) - time", "time.splat(L::Scalar::ONE) + time", 0),
    ("kernels/advance/corners.rs", "roundoffs(w.x, 20)", "roundoffs(w.x, 10)", 0),
    ("kernels/advance/corners.rs", "* w.abs().dot(self.extent)", "* w.dot(self.extent)", 0),
    ("kernels/advance/corners.rs", " + w.x.splat(L::Scalar::UNDERFLOW)", "", 0),
    ("kernels/advance/corners.rs", "extent + all(like.splat(L::Scalar::EXTENT_UNDERFLOW))", "extent", 0),
    ("kernels/advance/corners.rs", "start.abs().larger(end.abs()).larger(extent)", "start.abs().larger(extent)", 0),
    ("kernels/advance/corners.rs", "!largest.greater(largest.splat(L::Scalar::LARGEST_EXTENT))", "largest.greater(largest.splat(L::Scalar::LARGEST_EXTENT))", 0),
    ("kernels/lanes.rs", "largest_extent: 29", "largest_extent: 31", 0),
    ("kernels/lanes.rs", "extent_underflow: -100", "extent_underflow: -110", 0),
    ("kernels/points.rs", "[u - k, u - l, v - k, v - l]", "[u - k, u - l, k - v, v - l]", 0),
    ("kernels/advance/directions.rs", "w.dot(position).greater(bar)", "bar.greater(w.dot(position))", 0),
    ("kernels/advance/directions.rs", "is_apart & w.dot(position).greater(bar)", "is_apart | w.dot(position).greater(bar)", 0),
    ("kernels/advance/directions.rs", "let stays = at_end.greater(bar);", "let stays = at_end.greater(zero);", 0),
    ("kernels/advance/directions.rs", "(at_start - bar) / (at_start - at_end)", "at_start / (at_start - at_end)", 0),
    ("kernels/advance/directions.rs", "* less_roundoffs(bar, 32)", "* less_roundoffs(bar, 2)", 0),
    ("kernels/advance/directions.rs", "stays | at_start.greater(at_end) & quotient.greater(zero)", "stays | quotient.greater(zero)", 0),
    ("kernels/advance/directions.rs", "quotient.smaller(until)", "quotient.larger(until)", 0),
    ("kernels/advance/directions.rs", "L::select(stays, until, quotient.smaller(until))", "L::select(stays, quotient.smaller(until), until)", 0),
    ("kernels/advance/directions.rs", "let middle_bar = before.bar + after.bar;", "let middle_bar = before.bar - after.bar;", 0),
    ("kernels/advance/directions.rs", "(before.w.dot(*to) + after.w.dot(*from)).greater(middle_bar)", "(before.w.dot(*from) + after.w.dot(*to)).greater(middle_bar)", 0),
    ("kernels/advance/directions.rs", "(middle.w.dot(*to) + after.w.dot(*from)).greater(second_bar)", "(middle.w.dot(*to) + after.w.dot(*from)).greater(first_bar)", 0),
    ("kernels/advance/volume.rs", "roundoffs(m.x, 64)", "roundoffs(m.x, 32)", 0),
    ("kernels/advance/volume.rs", "values: [k0, k1 * third, k2 * third, k3]", "values: [k0, k2 * third, k1 * third, k3]", 0),
    ("kernels/advance/volume.rs", "L::select(is_negative, -b1, b1) - e1", "L::select(is_negative, -b1, b1) + e1", 0),
    ("kernels/advance/volume.rs", "m0.greater(zero) & m1.greater(zero) & m2.greater(zero) & m3.greater(zero)", "m0.greater(zero) & m1.greater(zero) & m3.greater(zero)", 0),
    ("kernels/advance/volume.rs", "* less_roundoffs(time, 8)", "", 0),
    ("kernels/advance/volume.rs", "line!(p1 & !p2, (one + b1 / (b1 - b2)) * third);", "", 0),
    ("kernels/advance/volume.rs", "line!(p1 & p2 & !p3, (two + b2 / (b2 - b3)) * third);", "line!(p1 & p2 & !p3, (two + b3 / (b2 - b3)) * third);", 0),
    ("kernels/advance/volume.rs", "is_inside & a0.greater(zero) & c0.greater(zero)", "is_inside & a0.greater(zero)", 0),
    ("kernels/advance/volume.rs", "L::select(is_apart & next.greater(time), next, time)", "L::select(next.greater(time), next, time)", 0),
    ("narrowing.rs", "S::truncated(time)", "S::from_f64(time)", 0),
    ("narrowing.rs", "S::truncated(time)", "S::truncated(time).next_up()", 0),
    ("narrowing.rs", "let value = value.raised_to_normal();", "", 0),
    ("narrowing.rs", "let below = S::truncated(value);", "let below = S::from_f64(value);", 0),
    ("narrowing.rs", "below.to_f64() < value", "below.to_f64() > value", 0),
    ("narrowing.rs", "below.to_f64() < value", "below.to_f64() <= value", 0),
    ("narrowing.rs", "below.next_up().raised_to_normal()", "below.next_up()", 0),
    ("narrowing.rs", "below.next_up().raised_to_normal()", "below.raised_to_normal()", 0),
    ("narrowing.rs", "limits.separation.raised_to_normal().to_f64()", "limits.separation.to_f64()", 0),
    ("scalar.rs", "(f64::MAX_EXP - f32::MAX_EXP) as u64", "(f64::MAX_EXP - f32::MAX_EXP - 1) as u64", 0),
    ("scalar.rs", "magnitude < f64::INFINITY.to_bits()", "magnitude > f64::INFINITY.to_bits()", 0),
    ("scalar.rs", "power_of_two_f64(-149)", "power_of_two_f64(-148)", 0),
]


def prepare(folder):
    """A workspace of core and the program that writes the terms."""
    for source, name in [(ROOT / "core", "core"), (HERE.parent / "traced", "traced")]:
        shutil.copytree(source, folder / name, copy_function=shutil.copy, ignore=shutil.ignore_patterns("tests", "target"))
    manifest = (ROOT / "Cargo.toml").read_text()
    manifest = re.sub(r"members = \[.*?\]", 'members = ["core", "traced"]', manifest, count=1, flags=re.S)
    manifest = re.sub(r"default-members = \[.*?\]\n", "", manifest, flags=re.S)
    (folder / "Cargo.toml").write_text(manifest)
    shutil.copy(ROOT / "Cargo.lock", folder)


def trace(folder):
    """The traced files and whether they are the accepted ones, or what went wrong."""
    out = folder / "terms"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir()
    run = ["cargo", "run", "--quiet", "--package", "selvedge-traced", "--", "coq", str(out)]
    ran = subprocess.run(run, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    texts = {path.name: path.read_text() for path in sorted(out.iterdir())}
    if ran.returncode != 0 and not texts:
        errors = [line for line in ran.stderr.splitlines() if "error" in line or "panicked" in line or "known" in line]
        return None, False, (errors or ran.stderr.splitlines())[-1]
    return texts, ran.returncode == 0, None


def accepts(proofs, name):
    """Whether Coq accepts a file within minutes. Terms that differ can take very long to compare."""
    try:
        return subprocess.run(["coqc", "-q", "-Q", ".", "Selvedge", f"{name}.v"], cwd=proofs, capture_output=True, timeout=SECONDS).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def compiled(folder, kept):
    """The folder of the proofs with the code's own terms, which Coq accepts."""
    proofs = folder / "proofs"
    sources = kept | {path.name: path.read_text() for path in HERE.glob("*.v")}
    stamp = proofs / "accepted"
    if stamp.exists() and all((proofs / name).read_text() == text for name, text in sources.items() if (proofs / name).exists()):
        if len(list(proofs.glob("*.v"))) == len(sources):
            return proofs
    shutil.rmtree(proofs, ignore_errors=True)
    proofs.mkdir()
    for name, text in sources.items():
        (proofs / name).write_text(text)
    for file in ORDER:
        if not accepts(proofs, file):
            sys.exit(f"mutations: Coq does not accept {file}.v without a mutation")
    stamp.touch()
    return proofs


def coq(proofs, kept, traced):
    """The first file that Coq refuses with these terms, or none."""
    changed = [name for name in kept if kept[name] != traced[name]]
    again = [name.removesuffix(".v") for name in changed]
    files = [file for file in ORDER if file in again or any(file in ABOVE[name] for name in again)]
    tried = proofs.with_name("tried")
    shutil.rmtree(tried, ignore_errors=True)
    shutil.copytree(proofs, tried)
    for name in changed:
        (tried / name).write_text(traced[name])
    return next((file for file in files if not accepts(tried, file)), None)


ORDER = re.search(r"^files=\(([^)]*)\)$", (HERE / "check.sh").read_text(), re.M)[1].split()


def known():
    """The rows of the page, by their numbers."""
    return {int(number): row for row, number in re.findall(r"^(\| (\d+) \|.*)$", PAGE.read_text(), re.M)}


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    for name in ["core", "traced", "terms", "tried"]:
        shutil.rmtree(folder / name, ignore_errors=True)
    prepare(folder)
    kept, accepted, wrong = trace(folder)
    if not accepted:
        sys.exit(f"mutations: the code's terms are not the accepted ones {wrong or ''}")
    proofs = compiled(folder, kept)

    rows, alive = known(), 0
    first, last = (int(number) for number in sys.argv[2:4] or (1, len(MUTATIONS)))
    for number, (name, old, new, place) in enumerate(MUTATIONS, 1):
        if not first <= number <= last:
            continue
        path = folder / "core/src" / name
        source = path.read_text()
        parts = source.split(old)
        if len(parts) < place + 2:
            sys.exit(f"mutations: {name} does not have {old}")
        path.write_text(old.join(parts[: place + 1]) + new + old.join(parts[place + 1 :]))
        try:
            traced, accepted, wrong = trace(folder)
        finally:
            path.write_text(source)
        if wrong and "known to the proof" not in wrong:
            sys.exit(f"mutations: {new} cannot be tried: {wrong}")
        if wrong:
            said = "the tracer: the proofs have no such term"
        elif accepted:
            said, alive = "**nothing**", alive + 1
        else:
            refused = coq(proofs, kept, traced)
            said = f"the comparison, and Coq in `{refused}.v`" if refused else "the comparison; Coq proves the new terms too"
        change = f"`{old}` → `{new}`".replace("|", "\\|")
        rows[number] = f"| {number} | `{name}` | {change}{f' (place {place + 1})' if place else ''} | {said} |"
        print(rows[number], flush=True)
        PAGE.write_text(HEAD + "".join(row + "\n" for number, row in sorted(rows.items()) if number <= len(MUTATIONS)))
    if alive:
        sys.exit(f"mutations: {alive} of {last - first + 1} are not noticed")
    print(f"mutations: all {last - first + 1} are refused")


main()
