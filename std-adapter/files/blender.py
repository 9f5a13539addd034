"""Reads meshes with Blender's importers: `blender.by_blender(path)`."""

import contextlib
import os
import pathlib

import bpy
import numpy


@contextlib.contextmanager
def _quiet():
    """Keeps Blender's own output, which does not pass through Python, off the terminal; yields the file that receives it."""
    saved, read = os.dup(1), pathlib.Path(bpy.app.tempdir) / "said.txt"
    with open(read, "wb") as said:
        os.dup2(said.fileno(), 1)
        try:
            yield read
        finally:
            os.dup2(saved, 1)
            os.close(saved)


def by_blender(path):
    """The triangles that Blender reads, as corners in 32-bit numbers. Raises if it warns."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with _quiet() as said:
        if path.suffix == ".obj":
            result = bpy.ops.wm.obj_import(filepath=str(path), forward_axis="Y", up_axis="Z", validate_meshes=False)
        elif path.suffix == ".ply":
            result = bpy.ops.wm.ply_import(filepath=str(path))
        else:
            result = bpy.ops.import_scene.gltf(filepath=str(path))
    words = said.read_text(errors="replace")
    if result != {"FINISHED"} or "warn" in words.lower() or "error" in words.lower():
        raise ValueError(words)
    corners = []
    for mesh in (thing.data for thing in bpy.data.objects if thing.type == "MESH"):
        positions = numpy.empty(3 * len(mesh.vertices), "f4")
        mesh.vertices.foreach_get("co", positions)
        faces = [list(face.vertices) for face in mesh.polygons]
        corners.append(positions.reshape(-1, 3)[numpy.array(faces, int).reshape(-1, 3)])
    return numpy.concatenate(corners)
