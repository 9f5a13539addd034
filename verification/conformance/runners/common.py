"""What runners in Python share: they read cases on standard input and write an answer for each on standard output.

A runner makes a dict from questions to functions. A function takes a Case and returns a function without arguments. That one is timed
and returns `True` (touches), `False` or `None` (undecided), or a pair of this and a time. `serve` does the rest.
"""

import os
import sys
import time

import numpy as np


class Refused(Exception):
    """The library does not take this input."""


class Case:
    """A case as numpy arrays. Numbers are float64, also those of the format f32."""

    def __init__(self, question, form, words):
        self.question, self.format = question, form
        vertices, faces, self.split = 8 if question in ("vertex-face", "edge-edge") else 0, 0, 0
        if question in ("meshes", "moving-mesh"):
            vertices, faces, self.split = map(int, words[:3])
            words = words[3:]
        index = [int(w) for w in words[len(words) - 3 * faces :]]
        x = np.array([float.fromhex(w) for w in words[: len(words) - 3 * faces]]).reshape(-1, 3)
        self.faces = np.array(index, dtype=np.int32).reshape(-1, 3)
        self.start = self.end = x
        self.move = None
        if question in ("vertex-face", "edge-edge", "moving-mesh"):
            self.start, self.end = x[: len(x) // 2].copy(), x[len(x) // 2 :].copy()
        elif question == "moving-triangle":
            self.start, self.move = x[:6].copy(), x[6].copy()
            self.end = self.start.copy()
            self.end[3:] += self.move
        if question in ("triangles", "moving-triangle"):
            self.faces, self.split = np.array([[0, 1, 2], [3, 4, 5]], dtype=np.int32), 1

    def two(self, dtype=np.float64):
        """The two meshes at the start: vertices and faces of each."""
        first, second = self.faces[: self.split], self.faces[self.split :]
        n = int(first.max()) + 1
        return (self.start[:n].astype(dtype), first), (self.start[n:].astype(dtype), second - n)


def answer(asked):
    """An answer and the least of up to three durations."""
    best = None
    for _ in range(3):
        begin = time.perf_counter_ns()
        said = asked()
        duration = time.perf_counter_ns() - begin
        best = duration if best is None else min(best, duration)
        if duration > 5_000_000:
            break
    touches, first = said if isinstance(said, tuple) else (said, None)
    verdict = "undecided" if touches is None else "touches" if touches else "none"
    return f"{verdict} {'-' if first is None or not touches else float(first).hex()} {best}"


def serve(version, questions):
    """Answers until the input ends. What libraries print goes to standard error."""
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    print("ready", version, file=out, flush=True)
    for line in sys.stdin:
        name, question, form, *words = line.split()
        try:
            said = answer(questions[question](Case(question, form, words)))
        except Refused:
            said = "refused - 0"
        except Exception as error:
            said = f"refused - 0 {type(error).__name__}: {' '.join(str(error).split())[:100]}"
        print(name, said, file=out, flush=True)
