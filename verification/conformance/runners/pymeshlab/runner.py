"""PyMeshLab: both triangles as one mesh, and its filter for self-intersections."""

from importlib.metadata import version

import pymeshlab
from common import serve


def at_rest(case):
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(case.start, case.faces))

    def ask():
        meshes.compute_selection_by_self_intersections_per_face()
        return meshes.current_mesh().selected_face_number() > 0

    return ask


serve(version("pymeshlab"), {"triangles": at_rest})
