"""Compares what trimesh, meshio and Blender read with what `convert` reads and writes, for every file of the zoo, and what they read of the
frames that `selvedge simulate` writes."""

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

try:
    from blender import by_blender
except ImportError:  # bpy exists for one version of Python each.
    by_blender = None

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


def single(triangles):
    """Triangles as Blender has them: in 32-bit numbers, and one of those with the same corners."""
    return None if triangles is None else {tuple(sorted(map(tuple, triangle))) for triangle in numpy.asarray(triangles, "f4").tolist()}


def frames(command, folder):
    """What is wrong with the frames of a scene in three formats: they must be the same, and valid."""
    folder = pathlib.Path(folder)
    (folder / "scene.toml").write_text(SCENE)
    wrong = []
    for format in ("obj", "ply", "gltf"):
        subprocess.run([command, "simulate", "scene.toml", "--frames", format, "--output", format], check=True, capture_output=True, cwd=folder)
    last = [sorted((folder / format).glob(f"*.{format}"))[-1] for format in ("obj", "ply")]
    own = by_trimesh(last[0])
    for path in last:
        for name, reader in (("trimesh", by_trimesh), ("meshio", by_meshio)):
            found, said = read(reader, path)
            if found is None or said or not same(found, own):
                wrong.append(f"{path.name}: {name} reads it otherwise: {said}")
        if by_blender and single(by_blender(path)) != single(own):
            wrong.append(f"{path.name}: Blender reads it otherwise")
    scene = folder / "gltf" / "scene.glb"
    of_gltf = [("trimesh", len(by_trimesh(scene)))] + ([("Blender", len(by_blender(scene)))] if by_blender else [])
    wrong += [f"scene.glb: {name} reads {count} triangles, not {len(own)}" for name, count in of_gltf if count != len(own)]
    return wrong, scene.read_bytes()


SCENE = """
time_step = 0.002
duration = 0.1
[cloth]
shape = "sheet"
sides = { first = [0.3, 0, 0], second = [0, 0.3, 0] }
cells = [8, 8]
density = 0.2
[[body]]
name = "ball"
shape = "ball"
centre = [0.15, 0.15, -0.11]
radius = 0.1
[effects.gravity]
[effects.stretch]
stiffness = 200
[effects.body_contact]
thickness = 0.004
[effects.self_collision]
thickness = 0.004
"""


def main():
    convert, command, written_gltf = sys.argv[1:]
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
            if by_blender:
                blended = [to.suffix for to in written if single(read(by_blender, to)[0]) != single(own)]
                wrong += [f"{path.name}: Blender reads {suffix} otherwise" for suffix in blended]
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
        of_frames, scene = frames(command, folder)
        wrong += of_frames
        pathlib.Path(written_gltf).write_bytes(scene)
    print(f"Blender: {'the same triangles in all that is written' if by_blender else 'not installed'}")
    for name in readers:
        print(f"{name}: the same triangles in {agreed[name]} files, refused {refused[name]}")
    print(f"read otherwise, {len(differ)}: {', '.join(differ)}")
    if wrong or any(agreed[name] < 40 for name in readers):
        sys.exit("\n".join(wrong) or "too few files are read alike")


main()
