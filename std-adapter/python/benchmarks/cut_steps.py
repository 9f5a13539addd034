"""Cuts random steps of loose triangles at their `compute_collision_free_stepsize`, and tests exactly whether any pair then touches.

    python benchmarks/cut_steps.py [--steps 10000] [--seed 1]

Half of the steps are of triangles anywhere, half of stacks of nearly parallel ones that fall onto each other. A step is cut at its size,
rounded as numpy rounds it. Ends with 1 if a cut step touches.
"""

import argparse
import itertools
import sys

import numpy as np
from numpy.typing import NDArray

import selvedge
from selvedge import ipc

TRIANGLES = 6
FACES = np.arange(3 * TRIANGLES, dtype=np.uint32).reshape(-1, 3)
EDGES = np.concatenate([FACES[:, [0, 1]], FACES[:, [1, 2]], FACES[:, [2, 0]]])

Step = tuple[NDArray[np.float64], NDArray[np.float64]]


def anywhere(random: np.random.Generator) -> Step:
    start = np.repeat(random.random((TRIANGLES, 3)), 3, axis=0) + 0.15 * random.standard_normal((3 * TRIANGLES, 3))
    return start, start + 0.4 * random.standard_normal(start.shape)


def stacked(random: np.random.Generator) -> Step:
    layer = random.random((3 * TRIANGLES, 3)) * [1.0, 1.0, 0.01]
    height = np.repeat(np.arange(TRIANGLES), 3) * 0.05
    start = layer + np.outer(height, [0.0, 0.0, 1.0])
    return start, layer + np.outer(height * random.uniform(-0.5, 0.5), [0.0, 0.0, 1.0]) + 0.01 * random.standard_normal(start.shape)


def touches(start: NDArray[np.float64], end: NDArray[np.float64]) -> bool:
    """Decides exactly whether any two primitives of different triangles touch."""

    def pair(kind: selvedge.Kind, vertices: list[int]) -> bool:
        return selvedge.touches(kind, start[vertices], end[vertices])

    vertices_and_faces = ((v, face) for v in range(len(start)) for face in FACES if v // 3 != face[0] // 3)
    two_edges = ((a, b) for a, b in itertools.combinations(EDGES, 2) if a[0] // 3 != b[0] // 3)
    return any(pair(selvedge.Kind.VERTEX_FACE, [v, *face]) for v, face in vertices_and_faces) or any(
        pair(selvedge.Kind.EDGE_EDGE, [*a, *b]) for a, b in two_edges
    )


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--steps", type=int, default=10_000)
    arguments.add_argument("--seed", type=int, default=1)
    given = arguments.parse_args()
    random = np.random.default_rng(given.seed)
    mesh = ipc.CollisionMesh(np.zeros((3 * TRIANGLES, 3)), faces=FACES)
    made = cut = touching_uncut = touching = 0
    while made < given.steps:
        start, end = (anywhere, stacked)[made % 2](random)
        if ipc.has_intersections(mesh, start):
            continue
        made += 1
        size = ipc.compute_collision_free_stepsize(mesh, start, end)
        cut += size < 1.0
        touching_uncut += touches(start, end)
        reached = start + size * (end - start) if size < 1.0 else end
        if touches(start, reached):
            touching += 1
            print(f"step {made}: touches when cut at {size}")
    print(f"{made} steps, of which {touching_uncut} touch: {cut} cut, {touching} touch")
    sys.exit(touching > 0)


main()
