"""Selvedge for Python. Argument: default or exact."""

import sys
from importlib.metadata import version

import numpy as np
import selvedge
from common import serve

EXACT = sys.argv[1] == "exact"


def pair(kind):
    def prepared(case):
        dtype = np.float32 if case.format == "f32" else np.float64
        start, end = case.start.astype(dtype), case.end.astype(dtype)
        if EXACT:
            return lambda: selvedge.touches(kind, start, end)

        def ask():
            time = selvedge.time_of_impact(kind, start, end)
            return time is not None, time

        return ask

    return prepared


def detector(case):
    dtype = np.float32 if case.format == "f32" else np.float64
    made = selvedge.Detector(case.faces, len(case.start))
    made.set_limits(touching=EXACT)
    return made, case.start.astype(dtype), case.end.astype(dtype)


def at_rest(case):
    made, start, _ = detector(case)
    return lambda: made.has_intersections(start)


def in_motion(case):
    made, start, end = detector(case)

    def ask():
        if case.question == "moving-triangle" and made.has_intersections(start):
            return True, 0.0
        first = made.earliest(start, end)
        return first is not None, first and first.time

    return ask


QUESTIONS = {
    "vertex-face": pair(selvedge.Kind.VERTEX_FACE),
    "edge-edge": pair(selvedge.Kind.EDGE_EDGE),
    "triangles": at_rest,
    "meshes": at_rest,
    "moving-triangle": in_motion,
    "moving-mesh": in_motion,
}
serve(version("selvedge"), QUESTIONS)
