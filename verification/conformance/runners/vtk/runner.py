"""VTK."""

from importlib.metadata import version

from common import serve
from vtkmodules.vtkCommonDataModel import vtkTriangle


def at_rest(case):
    corners = case.start.tolist()
    return lambda: vtkTriangle.TrianglesIntersect(*corners) != 0


serve(version("vtk"), {"triangles": at_rest})
