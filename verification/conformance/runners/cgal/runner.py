"""CGAL's own bindings, with the kernel Epick: exact predicates."""

from importlib.metadata import version

from CGAL.CGAL_AABB_tree import AABB_tree_Triangle_3_soup
from CGAL.CGAL_Kernel import Point_3, Triangle_3, do_intersect
from common import serve


def triangles(mesh):
    vertices, faces = mesh
    return [Triangle_3(*(Point_3(*map(float, vertices[v])) for v in face)) for face in faces]


def at_rest(case):
    (one,), (other,) = map(triangles, case.two())
    return lambda: do_intersect(one, other)


def meshes(case):
    one, other = map(triangles, case.two())
    tree = AABB_tree_Triangle_3_soup(one)
    return lambda: any(tree.do_intersect(triangle) for triangle in other)


serve(version("cgal"), {"triangles": at_rest, "meshes": meshes})
