"""python-fcl. Argument: mesh or naive."""

import sys
from importlib.metadata import version

import fcl
from common import serve


def model(vertices, faces):
    shape = fcl.BVHModel()
    shape.beginModel(len(faces), len(vertices))
    shape.addSubModel(vertices, faces)
    shape.endModel()
    return shape


def at_rest(case):
    one, other = (fcl.CollisionObject(model(*mesh)) for mesh in case.two())
    return lambda: fcl.collide(one, other, fcl.CollisionRequest(), fcl.CollisionResult()) > 0


SOLVER = fcl.CCDSolverType.CCDC_NAIVE if sys.argv[1] == "naive" else fcl.CCDSolverType.CCDC_CONSERVATIVE_ADVANCEMENT
REQUEST = fcl.ContinuousCollisionRequest(ccd_motion_type=fcl.CCDMotionType.CCDM_TRANS, ccd_solver_type=SOLVER)


def in_motion(case):
    one, other = (fcl.CollisionObject(model(*mesh), fcl.Transform()) for mesh in case.two())
    still, moved = fcl.Transform(), fcl.Transform(case.move)

    def ask():
        result = fcl.ContinuousCollisionResult()
        fcl.continuousCollide(one, still, other, moved, REQUEST, result)
        return bool(result.is_collide), result.time_of_contact

    return ask


serve(version("python-fcl"), {"triangles": at_rest, "meshes": at_rest, "moving-triangle": in_motion})
