"""The contacts of some steps, to the last bit: those of Rust, whose test of the same steps reads the same digests
(``std-adapter/detector/tests/detector/python_has_the_same_bits.rs``)."""

from pathlib import Path

import numpy as np
import pytest

from selvedge import Detector

SIZE, STEPS = 12, 8
DIGESTS = (Path(__file__).parent / "contacts.digests").read_text().split("\n")


def faces() -> list[list[int]]:
    """Two sheets of triangles, one above the other."""
    found = []
    for first in (0, SIZE * SIZE):
        for row in range(SIZE - 1):
            for column in range(SIZE - 1):
                corner = first + row * SIZE + column
                found.append([corner, corner + SIZE, corner + 1])
                found.append([corner + 1, corner + SIZE, corner + SIZE + 1])
    return found


def frame(number: int) -> np.ndarray:
    state = number + 1
    positions = []
    for sheet in range(2):
        for row in range(SIZE):
            for column in range(SIZE):
                for at in (row * 6000, column * 6000, sheet * 3000):
                    state = (state * 1_664_525 + 1_013_904_223) % 2**32
                    positions.append((at + (state >> 16) % 4000) / 65536.0)
    return np.array(positions).reshape(-1, 3)


def digest(contacts) -> int:
    value = 0xCBF2_9CE4_8422_2325
    order = np.lexsort((contacts.pair[:, 1], contacts.pair[:, 0], contacts.kind))
    for row in order:
        rows = contacts.kind[row].tobytes() + contacts.pair[row].tobytes() + np.float64(contacts.time[row]).tobytes()
        for byte in rows:
            value = (value ^ byte) * 0x0000_0100_0000_01B3 % 2**64
    return value


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("name", ["f32", "f64"])
def test_contacts_have_rusts_bits(name, threads):
    dtype = {"f32": np.float32, "f64": np.float64}[name]
    detector = Detector(faces(), 2 * SIZE * SIZE, threads)
    found = []
    for step in range(STEPS):
        contacts = detector.contacts(frame(step).astype(dtype), frame(step + 1).astype(dtype))
        found.append(f"{name} {step} {len(contacts)} {digest(contacts):016x}")
    assert found == [line for line in DIGESTS if line.startswith(name)]
