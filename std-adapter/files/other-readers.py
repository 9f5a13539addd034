"""Compares what trimesh and meshio read with what `convert` reads and writes, for every file of the zoo."""

import collections
import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile
import warnings

import meshio
import numpy
import trimesh

ZOO = pathlib.Path(__file__).parent / "tests" / "zoo"


def by_trimesh(path):
    """Returns the triangles that trimesh reads, as corners."""
    scene = trimesh.load(path, process=False, maintain_order=True)
    if isinstance(scene, trimesh.Scene):
        scene = scene.to_mesh()
    return numpy.asarray(scene.vertices, float)[numpy.asarray(scene.faces)]


def by_meshio(path):
    """Returns the triangles that meshio reads, as corners; it does not split other polygons."""
    mesh = meshio.read(path)
    if any(block.type not in ("triangle", "line", "vertex") for block in mesh.cells):
        raise ValueError("polygons")
    corners = [block.data for block in mesh.cells if block.type == "triangle"]
    return numpy.asarray(mesh.points, float)[numpy.concatenate(corners)]


def read(reader, path):
    """Reads a file: returns triangles and warnings, or why there are none."""
    with warnings.catch_warnings(record=True) as warned, contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        warnings.simplefilter("always")
        try:
            return reader(path), [str(one.message) for one in warned if "selvedge" in str(one.message)]
        except (SystemExit, Exception) as error:  # noqa: BLE001: readers raise anything
            return None, [f"{type(error).__name__}: {error}"]


def same(one, other):
    """Decides whether both have exactly the same triangles, in any order."""
    key = lambda triangles: collections.Counter(tuple(map(tuple, triangle)) for triangle in (triangles + 0.0).tolist())
    return key(one) == key(other)


def main():
    convert = sys.argv[1]
    readers = {"trimesh": by_trimesh, "meshio": by_meshio}
    agreed, refused, differ, wrong = collections.Counter(), collections.Counter(), [], []
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(ZOO.iterdir()):
            if path.suffix == ".txt":
                continue
            written = [pathlib.Path(folder) / f"written{suffix}" for suffix in (".obj", ".ply")]
            if any(subprocess.run([convert, path, to], capture_output=True, check=False).returncode for to in written):
                continue
            own = by_trimesh(written[0])
            for name, reader in readers.items():
                # All readers must read the files of this crate, with the same numbers.
                for to in written:
                    found, said = read(reader, to)
                    if found is None or said or not same(found, own):
                        wrong.append(f"{path.name}: {name} reads {to.suffix} otherwise: {said}")
                # Some readers disagree on the files of others; most must agree.
                found, said = read(reader, path)
                if found is None:
                    refused[name] += 1
                elif same(found, own):
                    agreed[name] += 1
                else:
                    differ.append(f"{path.name} ({name}: {len(found)} triangles, here {len(own)})")
    for name in readers:
        print(f"{name}: the same triangles in {agreed[name]} files, refused {refused[name]}")
    print(f"read otherwise, {len(differ)}: {', '.join(differ)}")
    if wrong or any(agreed[name] < 40 for name in readers):
        sys.exit("\n".join(wrong) or "too few files are read alike")


main()
