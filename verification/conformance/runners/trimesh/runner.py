"""trimesh: its collision manager, which uses FCL."""

import trimesh
from common import serve


def at_rest(case):
    one, other = (trimesh.Trimesh(vertices, faces, process=False) for vertices, faces in case.two())
    manager = trimesh.collision.CollisionManager()
    manager.add_object("one", one)
    return lambda: bool(manager.in_collision_single(other))


serve(trimesh.__version__, {"triangles": at_rest, "meshes": at_rest})
