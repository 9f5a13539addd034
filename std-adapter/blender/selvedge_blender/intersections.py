"""Where evaluated meshes intersect, exactly."""

from dataclasses import dataclass

import bpy
import numpy as np
from selvedge import Detector

from .meshes import number_polygons, snapshot


@dataclass
class Found:
    """The intersections of one frame."""

    frame: int
    count: int
    of_pairs: dict
    """(name, name) -> the number of pairs of faces that intersect."""
    polygons: dict
    """name -> the polygons that intersect others."""
    points: np.ndarray
    """(n, 3) a point of each, in metres."""

    def described(self):
        pairs = self.of_pairs.items()
        return ", ".join(f"{a} with itself: {n}" if a == b else f"{a} with {b}: {n}" for (a, b), n in pairs)


class Checker:
    """Finds intersections of objects with themselves and each other, frame by frame."""

    def __init__(self, objects):
        self.objects, self.detector, self.triangles = objects, None, None
        for obj in objects:
            number_polygons(obj)
        bpy.context.view_layer.update()

    def check(self):
        """Checks the present frame."""
        depsgraph = bpy.context.evaluated_depsgraph_get()
        shots = [snapshot(obj, depsgraph) for obj in self.objects]
        firsts = np.cumsum([0] + [len(shot.positions) for shot in shots])
        triangles = np.concatenate([shot.triangles + np.uint32(first) for shot, first in zip(shots, firsts)])
        positions = np.concatenate([shot.positions for shot in shots])
        # Quads may be split along the other diagonal, and modifiers may change the mesh.
        is_known = self.detector is not None and self.detector.vertex_count == len(positions)
        if not is_known or not np.array_equal(self.triangles, triangles):
            self.detector, self.triangles = Detector(triangles, len(positions), threads=0), triangles
        found = self.detector.intersections(positions)
        objects = np.repeat(np.arange(len(shots)), [len(shot.triangles) for shot in shots])
        polygons = np.concatenate([shot.polygons for shot in shots])
        of_pairs = {}
        pairs, counts = np.unique(np.sort(objects[found.face_pairs], axis=1).reshape(-1, 2), axis=0, return_counts=True)
        for (one, other), count in zip(pairs, counts):
            of_pairs[self.objects[one].name, self.objects[other].name] = int(count)
        faces = found.faces
        of_objects = {obj.name: set(polygons[faces[objects[faces] == k]].tolist()) for k, obj in enumerate(self.objects)}
        return Found(bpy.context.scene.frame_current, len(found.face_pairs), of_pairs, of_objects, found.points)
