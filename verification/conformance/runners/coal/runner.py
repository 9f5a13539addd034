"""coal. Argument: mesh or triangle."""

import sys

import coal
from common import serve

PLACE = coal.Transform3s()


def shape(vertices, faces):
    if sys.argv[1] == "triangle":
        return coal.TriangleP(*(v.copy() for v in vertices))
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(faces), 3 * len(faces))
    for face in faces:
        model.addTriangle(*(vertices[v].copy() for v in face))
    model.endModel()
    return model


def at_rest(case):
    one, other = (shape(*mesh) for mesh in case.two())
    request = coal.CollisionRequest()
    return lambda: coal.collide(one, PLACE, other, PLACE, request, coal.CollisionResult()) > 0


QUESTIONS = {"triangles": at_rest} if sys.argv[1] == "triangle" else {"triangles": at_rest, "meshes": at_rest}
serve(coal.__version__, QUESTIONS)
