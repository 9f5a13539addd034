"""Open3D."""

import open3d
from common import serve


def shape(vertices, faces):
    return open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(vertices), open3d.utility.Vector3iVector(faces))


def at_rest(case):
    one, other = (shape(*mesh) for mesh in case.two())
    return lambda: one.is_intersecting(other)


serve(open3d.__version__, {"triangles": at_rest, "meshes": at_rest})
