"""Measures what a call from Python costs, and compares ipctk, in one process and one thread.

    python benchmarks/border.py START.ply END.ply [--ipctk]

The cost of the border is the difference from the same step in Rust: run `selvedge cull START END --repeat 20 --threads 1` in turn with
this. It needs meshio; with --ipctk also ipctk.
"""

import argparse
import time
from collections.abc import Callable
from typing import Any

import meshio
import numpy as np

import selvedge
from selvedge import Detector, ipc


def least(action: Callable[[], object], times: int) -> float:
    seconds = []
    for _ in range(times):
        began = time.perf_counter()
        action()
        seconds.append(time.perf_counter() - began)
    return min(seconds)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("start")
    arguments.add_argument("end")
    arguments.add_argument("--ipctk", action="store_true", help="measure ipctk as well")
    arguments.add_argument("--candidates", action="store_true", help="with --ipctk: whether its candidates are ours")
    arguments.add_argument("--times", type=int, default=10, help="the least of so many is told")
    given = arguments.parse_args()
    meshes = [meshio.read(path) for path in (given.start, given.end)]
    faces = np.ascontiguousarray(meshes[0].cells_dict["triangle"], np.uint32)
    start, end = (np.ascontiguousarray(mesh.points, np.float64) for mesh in meshes)
    print(f"selvedge {selvedge.__version__}, {len(faces)} faces, {len(start)} vertices")

    detector = Detector(faces, len(start))
    found = detector.contacts(start, end)
    print(f"{len(found)} contacts")
    copied = [np.asfortranarray(frame) for frame in (start, end)]
    rows: list[tuple[str, Callable[[], object]]] = [
        ("contacts, times alone", lambda: detector.contacts(start, end, geometry=False)),
        ("contacts with geometry", lambda: detector.contacts(start, end)),
        ("contacts, arrays copied", lambda: detector.contacts(*copied, geometry=False)),
        ("earliest", lambda: detector.earliest(start, end)),
        ("a new mesh and its step size", lambda: ipc.compute_collision_free_stepsize(ipc.CollisionMesh(start, faces=faces), start, end)),
    ]
    # The rows take turns, so that a machine that is slow for a while slows all of them.
    times = {name: min(least(action, 1) for _ in range(given.times)) for name, action in rows}
    for name, seconds in times.items():
        print(f"{1e3 * seconds:10.2f} ms  {name}")
    if not given.ipctk:
        return

    import ipctk

    ipctk.set_num_threads(1)
    faces_i32 = faces.astype(np.int32)
    edges = ipctk.edges(faces_i32)
    mesh = ipctk.CollisionMesh(start, edges, faces_i32)
    cold, warm = times["a new mesh and its step size"], times["contacts, times alone"]
    for name, narrow in [("Tight-Inclusion", ipctk.TightInclusionCCD()), ("additive", ipctk.AdditiveCCD())]:

        def step_size(of: object, narrow: object = narrow) -> object:
            return ipctk.compute_collision_free_stepsize(of, start, end, 0.0, ipctk.LBVH(), narrow)

        seconds = least(lambda: step_size(ipctk.CollisionMesh(start, edges, faces_i32)), 2)
        print(f"{1e3 * seconds:10.2f} ms  ipctk, a new mesh and its step size, {name}: {seconds / cold:.0f} times ours")
        seconds = least(lambda: step_size(mesh), 2)
        # It ends at the first contact; ours finds all of them.
        print(f"{1e3 * seconds:10.2f} ms  ipctk, its step size again, {name}: {seconds / warm:.0f} times all our contacts")
    if given.candidates:
        compare_candidates(ipctk, mesh, ipc.CollisionMesh(start, edges, faces), start, end)


def compare_candidates(ipctk: Any, mesh: Any, ours: ipc.CollisionMesh, start: np.ndarray, end: np.ndarray) -> None:
    """Compares lists of candidates. Millions of them take gigabytes of Python's objects, and minutes."""
    candidates, theirs = ipc.Candidates(), ipctk.Candidates()
    candidates.build(ours, start, end)
    theirs.build(mesh, start, end, 0.0, ipctk.LBVH())
    print(f"candidates: {len(candidates)}, ipctk's {len(theirs)}")
    pairs = [
        (np.sort(candidates.ee_candidates, axis=1), [sorted((pair.edge0_id, pair.edge1_id)) for pair in theirs.ee_candidates]),
        (candidates.fv_candidates, [(pair.face_id, pair.vertex_id) for pair in theirs.fv_candidates]),
    ]
    for name, (of_ours, of_theirs) in zip(("edges", "faces and vertices"), pairs):
        keys = [np.unique(np.asarray(rows, np.uint64) @ np.array([2**32, 1], np.uint64)) for rows in (of_ours, of_theirs)]
        alone = [len(np.setdiff1d(*keys, assume_unique=True)), len(np.setdiff1d(*keys[::-1], assume_unique=True))]
        print(f"{name}: {len(keys[0])}, of them {alone[0]} not ipctk's; {alone[1]} ipctk's alone")


if __name__ == "__main__":
    main()
