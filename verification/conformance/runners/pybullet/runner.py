"""PyBullet: triangles as convex hulls of their vertices."""

from importlib.metadata import version

import pybullet
from common import serve

pybullet.connect(pybullet.DIRECT)
BODIES = []


def body(vertices):
    shape = pybullet.createCollisionShape(pybullet.GEOM_MESH, vertices=vertices.tolist())
    return pybullet.createMultiBody(1, shape)


def at_rest(case):
    while BODIES:
        pybullet.removeBody(BODIES.pop())
    BODIES[:] = [body(vertices) for vertices, _ in case.two()]
    return lambda: len(pybullet.getClosestPoints(*BODIES, 0.0)) > 0


serve(version("pybullet"), {"triangles": at_rest})
