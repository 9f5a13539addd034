"""MeshLib."""

from importlib.metadata import version

import meshlib.mrmeshnumpy as mrmeshnumpy
import meshlib.mrmeshpy as mrmeshpy
import numpy as np
from common import serve


def at_rest(case):
    meshes = [mrmeshnumpy.meshFromFacesVerts(faces, vertices) for vertices, faces in case.two(np.float32)]
    one, other = map(mrmeshpy.MeshPart, meshes)
    return lambda: (meshes, len(mrmeshpy.findCollidingTriangles(one, other, firstIntersectionOnly=True)) > 0)[1]


serve(version("meshlib"), {"triangles": at_rest, "meshes": at_rest})
