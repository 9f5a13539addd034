"""ipc-toolkit. Argument: tight-inclusion or additive."""

import sys

import ipctk
import numpy as np
from common import serve

METHOD = {"tight-inclusion": ipctk.TightInclusionCCD, "additive": ipctk.AdditiveCCD}[sys.argv[1]]()


def pair(method):
    return lambda case: lambda: method(*case.start, *case.end)


def mesh(case):
    edges = ipctk.edges(case.faces)
    return ipctk.CollisionMesh(np.asfortranarray(case.start), edges, np.asfortranarray(case.faces))


def at_rest(case):
    shape, positions = mesh(case), np.asfortranarray(case.start)
    return lambda: ipctk.has_intersections(shape, positions)


def in_motion(case):
    shape, start, end = mesh(case), np.asfortranarray(case.start), np.asfortranarray(case.end)

    def ask():
        if ipctk.has_intersections(shape, start):
            return True, 0.0
        step = ipctk.compute_collision_free_stepsize(shape, start, end, narrow_phase_ccd=METHOD)
        return step < 1, step

    return ask


QUESTIONS = {
    "vertex-face": pair(METHOD.point_triangle_ccd),
    "edge-edge": pair(METHOD.edge_edge_ccd),
    "moving-triangle": in_motion,
    "moving-mesh": in_motion,
    "triangles": at_rest,
    "meshes": at_rest,
}
serve(ipctk.__version__, QUESTIONS)
