"""libigl. Argument: predicates, guigue or cgal."""

import sys
from importlib.metadata import version

import igl
import igl.copyleft.cgal
import igl.predicates
from common import serve


def predicates(case):
    corners = [p.copy() for p in case.start]
    return lambda: igl.predicates.triangle_triangle_intersect(*corners)[0]


def guigue(case):
    corners = [p.reshape(1, 3) for p in case.start]
    return lambda: igl.tri_tri_intersection_test_3d(*corners)[0]


def cgal(case):
    (v, f), (w, g) = case.two()
    f, g = f.astype("int64"), g.astype("int64")
    return lambda: len(igl.copyleft.cgal.intersect_other(v, f, w, g, detect_only=True, first_only=True)[0]) > 0


def find(case):
    (v, f), (w, g) = case.two()
    f, g = f.astype("int64"), g.astype("int64")
    return lambda: bool(igl.predicates.find_intersections(v, f, w, g, first_only=True)[0])


QUESTIONS = {
    "predicates": {"triangles": predicates, "meshes": find},
    "guigue": {"triangles": guigue},
    "cgal": {"triangles": cgal, "meshes": cgal},
}
serve(version("libigl"), QUESTIONS[sys.argv[1]])
