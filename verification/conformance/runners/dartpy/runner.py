"""DART: its FCL collision detector, with meshes from files, which is how dartpy takes them."""

import tempfile
from importlib.metadata import version
from pathlib import Path

import dartpy
from common import Refused, serve

FOLDER = Path(tempfile.mkdtemp())
URDF = (
    '<robot name="{0}"><link name="{0}"><collision><geometry><mesh filename="file://{1}"/></geometry></collision></link></robot>'
)
DETECTOR = dartpy.collision.FCLCollisionDetector()
DETECTOR.setPrimitiveShapeType(dartpy.collision.FCLCollisionDetector.MESH)
COUNT = 0


def group(mesh):
    global COUNT
    COUNT += 1
    name = f"m{COUNT}"
    path = FOLDER / f"{name}.obj"
    vertices, faces = mesh
    lines = ["v " + " ".join(f"{x:.17g}" for x in v) for v in vertices] + ["f " + " ".join(str(v + 1) for v in f) for f in faces]
    path.write_text("\n".join(lines) + "\n")
    text = URDF.format(name, path)
    skeleton = dartpy.utils.DartLoader().parseSkeletonString(text, dartpy.common.Uri(f"file://{FOLDER}/{name}.urdf"))
    path.unlink()
    if skeleton is None:
        raise Refused("the file is not read")
    made = DETECTOR.createCollisionGroup()
    made.addShapeFramesOf(skeleton)
    return made, skeleton


def at_rest(case):
    (one, a), (other, b) = map(group, case.two())
    option, result = dartpy.collision.CollisionOption(), dartpy.collision.CollisionResult()
    return lambda: (one.collide(other, option, result), a, b)[0]


serve(version("dartpy"), {"triangles": at_rest, "meshes": at_rest})
