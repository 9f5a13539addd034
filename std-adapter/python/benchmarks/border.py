"""What Python's border costs, and ipctk beside it: in one process, one thread.

    python benchmarks/border.py START.ply END.ply [--ipctk]

The share outside of the detector is that of a step asked through the package over one that the native part times for itself: the same
question asked twice as a whole, with arrays as they are and with arrays that must be copied. Needs meshio; with --ipctk also ipctk.
"""

import argparse
import time
from collections.abc import Callable

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
    # In turn: a machine that is slow for a while is so for all.
    times = {name: min(least(action, 1) for _ in range(given.times)) for name, action in rows}
    for name, seconds in times.items():
        print(f"{1e3 * seconds:10.2f} ms  {name}")
    if not given.ipctk:
        return

    import ipctk

    ipctk.set_num_threads(1)
    edges = ipctk.edges(faces.astype(np.int32))
    mesh = ipctk.CollisionMesh(start, edges, faces.astype(np.int32))
    ours, theirs = ipc.CollisionMesh(start, edges, faces), ipctk.Candidates()
    candidates = ipc.Candidates()
    candidates.build(ours, start, end)
    theirs.build(mesh, start, end, 0.0, ipctk.LBVH())
    sets = [
        {tuple(sorted((a, b))) for a, b in candidates.ee_candidates.tolist()},
        {tuple(sorted((pair.edge0_id, pair.edge1_id))) for pair in theirs.ee_candidates},
        {tuple(pair) for pair in candidates.fv_candidates.tolist()},
        {(pair.face_id, pair.vertex_id) for pair in theirs.fv_candidates},
    ]
    print(f"candidates: ours {len(sets[0])} and {len(sets[2])}, not ipctk's {len(sets[0] - sets[1])} and {len(sets[2] - sets[3])};", end=" ")
    print(f"ipctk's alone {len(sets[1] - sets[0])} and {len(sets[3] - sets[2])}")
    cold = times["a new mesh and its step size"]
    for name, narrow in [("Tight-Inclusion", ipctk.TightInclusionCCD()), ("additive", ipctk.AdditiveCCD())]:

        def step_size(narrow: object = narrow) -> object:
            fresh = ipctk.CollisionMesh(start, edges, faces.astype(np.int32))
            return ipctk.compute_collision_free_stepsize(fresh, start, end, 0.0, ipctk.LBVH(), narrow)

        seconds = least(step_size, 2)
        print(f"{1e3 * seconds:10.2f} ms  ipctk, step size, {name}: {seconds / cold:.0f} times ours (cold)")

        def contacts(narrow: object = narrow) -> list[object]:
            pairs = ipctk.Candidates()
            pairs.build(mesh, start, end, 0.0, ipctk.LBVH())
            faces_i32 = mesh.faces
            return [pair.ccd(pair.dof(start, edges, faces_i32), pair.dof(end, edges, faces_i32), narrow_phase_ccd=narrow) for pair in (pairs[k] for k in range(len(pairs)))]

        seconds = least(contacts, 1)
        warm = times["contacts, times alone"]
        print(f"{1e3 * seconds:10.2f} ms  ipctk, all contacts from Python, {name}: {seconds / warm:.0f} times ours (warm)")


if __name__ == "__main__":
    main()
