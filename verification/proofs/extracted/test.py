#!/usr/bin/env python3
"""Tests the extracted checker on the witnesses of a small step: it accepts them, and refuses altered ones.

    test.py CHECKER SELVEDGE...    the checker, and the command line of selvedge, whose subcommand cull writes the witnesses
"""

import math
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

CHECKER, COMMAND = sys.argv[1], sys.argv[2:]
SIZE = 7


def grid(path, height_of_second):
    """Two waved grids. The second falls, tilts and moves aside; some of it passes through the first."""
    lines = []
    for height in [lambda x, y: 0.1 * math.sin(9 * x + 4 * y), height_of_second]:
        for i in range(SIZE):
            for j in range(SIZE):
                x, y = i / (SIZE - 1), j / (SIZE - 1)
                lines.append(f"v {x!r} {y + 0.05 * x!r} {height(x, y)!r}")
    for first in [1, 1 + SIZE * SIZE]:
        for i in range(SIZE - 1):
            for j in range(SIZE - 1):
                a = first + i * SIZE + j
                lines += [f"f {a} {a + SIZE} {a + 1}", f"f {a + 1} {a + SIZE} {a + SIZE + 1}"]
    path.write_text("\n".join(lines) + "\n")


def read(data):
    """The header and the records: kind, vertices, answer, time, parts of a time and directions."""
    vertices = struct.unpack_from("<I", data, 16)[0]
    at = 20 + 48 * vertices
    at += 4 + 12 * struct.unpack_from("<I", data, at)[0]
    header, records = data[:at], []
    while at < len(data):
        kind, *pair, answer, until, count = struct.unpack_from("<B4IBdB", data, at)
        at += 27
        parts = []
        for _ in range(count):
            proof, end = struct.unpack_from("<Bd", data, at)
            parts.append((end, struct.unpack_from(f"<{3 * proof}d", data, at + 9)))
            at += 9 + 24 * proof
        records.append((kind, pair, answer, until, parts))
    return header, records


def write(records):
    data = b""
    for kind, pair, answer, until, parts in records:
        data += struct.pack("<B4IBdB", kind, *pair, answer, until, len(parts))
        for end, numbers in parts:
            data += struct.pack(f"<Bd{len(numbers)}d", len(numbers) // 3, end, *numbers)
    return data


def check(path, data):
    """The exit status and the number of refused records, or none for an invalid file."""
    path.write_bytes(data)
    ran = subprocess.run([CHECKER, str(path)], capture_output=True, text=True)
    words = ran.stdout.split()
    return ran.returncode, int(words[-2]) if words else None


def altered(records):
    """Claims that are false, or whose proof is."""
    for kind, pair, answer, until, parts in records:
        if not parts:
            continue
        *before, (end, numbers) = parts
        yield kind, pair, answer, until, before
        if numbers:
            yield kind, pair, answer, until, [*before, (end, [-x for x in numbers[:3]] + list(numbers[3:]))]
            yield kind, pair, answer, until, [*before, (end, numbers[:-3] + (0.0, 0.0, 0.0))]
        if answer == 1:
            # It touches.
            yield kind, pair, 0, 1.0, [*before, (1.0, numbers)]
            yield kind, pair, 0, 1.0, [(1.0, ())]


def main():
    with tempfile.TemporaryDirectory() as folder:
        test(Path(folder))


def test(folder):
    frames, path = [folder / "before.obj", folder / "after.obj"], folder / "witnesses"
    grid(frames[0], lambda x, y: 0.5 + 0.1 * math.cos(7 * x - 3 * y))
    grid(frames[1], lambda x, y: 0.3 * x - 0.05 + 0.1 * math.cos(7 * x - 3 * y))
    subprocess.run([*COMMAND, "cull", *map(str, frames), "--witnesses", str(path)], check=True, capture_output=True)
    data = path.read_bytes()
    header, records = read(data)
    assert header + write(records) == data
    touching = sum(record[2] for record in records)
    proofs = {len(numbers) for record in records for _, numbers in record[4]}
    assert len(records) > 500 and touching > 20 and {0, 3} <= proofs, (len(records), touching, proofs)
    assert check(path, data) == (0, 0), "a witness is refused"
    changed = list(altered(records))
    assert check(path, header + write(changed)) == (1, len(changed)), "an altered witness is accepted"
    nan = struct.pack("<d", math.nan)
    for invalid in [data[:-1], b"x" + data[1:], data[:8] + struct.pack("<d", 1.0) + data[16:], header[:20] + nan + data[28:]]:
        assert check(path, invalid) == (1, None), "an invalid file is accepted"
    print(f"extracted checker: {len(records)} witnesses accepted, {touching} of pairs that touch; {len(changed)} altered ones refused")


main()
