"""Compares the time of ipctk's `has_intersections` and `selvedge check --any`, in turn, on a mesh at rest."""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import common
from common import fail, missing_package, positive, read_mesh

try:
    import ipctk
    import meshio
    import numpy as np
except ImportError as error:
    missing_package(error)

DEFAULT_BINARY = common.HERE / "../../../../target/release/selvedge"


def wavy_sheet(squares: int, path: Path) -> None:
    """Returns a wavy sheet of `squares` by `squares` squares, free of intersections."""
    along = np.arange(squares + 1) / squares
    y, x = np.meshgrid(along, along, indexing="ij")
    z = 0.02 * (np.sin(37 * x) * np.cos(23 * y) + 0.3 * np.sin(91 * x + 53 * y))
    j, i = np.meshgrid(np.arange(squares), np.arange(squares), indexing="ij")
    a = (j * (squares + 1) + i).ravel()
    b, c, d = a + 1, a + squares + 1, a + squares + 2
    # Diagonals alternate.
    is_even = ((i + j) % 2 == 0).ravel()[:, None]
    first = np.where(is_even, np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    second = np.where(is_even, np.stack([a, d, c], 1), np.stack([b, d, c], 1))
    points = np.stack([x, y, z], 2).reshape(-1, 3)
    triangles = np.stack([first, second], 1).reshape(-1, 3)
    meshio.write(path, meshio.Mesh(points, [("triangle", triangles.astype(np.int32))]))


def ours(binary: Path, mesh: Path, threads: int) -> tuple[bool, float, float]:
    """Returns the answer, the seconds of the first call, which builds hierarchies, and those of the faster of two more."""
    command = [os.fspath(binary.absolute()), "check", "--any", "--json", "--threads", str(threads)]
    done = subprocess.run([*command, *[os.fspath(mesh)] * 3], stdout=subprocess.PIPE, check=False)
    if done.returncode not in (0, 3):
        fail(f"`{' '.join(command)} …` ended with status {done.returncode}")
    first, *later = json.loads(done.stdout)["meshes"]
    return not first["is_free"], first["seconds"], min(run["seconds"] for run in later)


def theirs(mesh: ipctk.CollisionMesh, points: np.ndarray) -> tuple[bool, float]:
    begin = time.perf_counter()
    answer = ipctk.has_intersections(mesh, points, ipctk.LBVH())
    return answer, time.perf_counter() - begin


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("meshes", nargs="*", type=Path, metavar="MESH", help="OBJ or PLY")
    parser.add_argument(
        "--sheet", type=positive, metavar="N", help="a wavy sheet of N by N squares as well (806: 1.3 million triangles)"
    )
    parser.add_argument("--selvedge", type=Path, default=DEFAULT_BINARY, metavar="PATH")
    parser.add_argument("--threads", type=positive, default=1, help="threads (default: 1)")
    parser.add_argument("--repeats", type=positive, default=3, help="rounds (default: 3)")
    arguments = parser.parse_args()
    if not arguments.meshes and not arguments.sheet:
        parser.error("name a MESH, or --sheet N")
    ipctk.set_num_threads(arguments.threads)
    with tempfile.TemporaryDirectory() as folder:
        meshes = list(arguments.meshes)
        if arguments.sheet:
            meshes.append(Path(folder) / f"wavy-sheet-{arguments.sheet}.ply")
            wavy_sheet(arguments.sheet, meshes[-1])
        for path in meshes:
            compare(path, arguments)


def compare(path: Path, arguments: argparse.Namespace) -> None:
    points, triangles = read_mesh(path)
    mesh = ipctk.CollisionMesh(points, ipctk.edges(triangles), triangles)
    rounds = []
    for _ in range(arguments.repeats):
        their_answer, their_seconds = theirs(mesh, points)
        our_answer, first, later = ours(arguments.selvedge, path, arguments.threads)
        rounds.append((their_seconds, first, later))
    print(f"{path.name}: {len(triangles)} triangles; ipctk: {their_answer}, selvedge: {our_answer}")
    seconds = [statistics.median(column) for column in zip(*rounds)]
    print("  ipctk {:.3f} s, selvedge {:.3f} s the first time, {:.3f} s after it".format(*seconds))
    for name, column in (("the first time", 1), ("after it", 2)):
        ratios = [own[0] / own[column] for own in rounds]
        print(f"  ipctk over selvedge {name}: {statistics.median(ratios):.1f} ({min(ratios):.1f}–{max(ratios):.1f})")


if __name__ == "__main__":
    main()
