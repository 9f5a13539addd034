"""Evaluated meshes: what Blender draws, as arrays in metres."""

from contextlib import contextmanager
from dataclasses import dataclass

import bpy
import numpy as np

POLYGON = "selvedge_polygon"
"""The attribute with the number of a polygon, which modifiers pass on."""
CACHE = "Selvedge"
"""The name of the modifier that plays the result."""
SPLIT = "Selvedge Triangles"
"""The name of the modifier that splits polygons, before the result and on colliders."""

# Modifiers that move vertices without changing their number.
_DEFORMING = {
    "ARMATURE", "CAST", "CURVE", "DISPLACE", "HOOK", "LAPLACIANDEFORM", "LATTICE", "MESH_DEFORM", "SHRINKWRAP", "SIMPLE_DEFORM", "SMOOTH",
    "CORRECTIVE_SMOOTH", "LAPLACIANSMOOTH", "SURFACE_DEFORM", "WARP", "WAVE", "MESH_CACHE", "CLOTH", "SOFT_BODY",
}  # fmt: skip


@dataclass
class Snapshot:
    """An object at one frame, in world space."""

    positions: np.ndarray
    """(n, 3) in metres, float64."""
    triangles: np.ndarray
    """(m, 3) as Blender draws the polygons."""
    polygons: np.ndarray
    """(m,) the polygon of each triangle, in the object's own mesh where modifiers pass its number on."""
    loose_edges: np.ndarray
    """(k, 2) edges that belong to no polygon."""
    matrix: np.ndarray
    """From local space, in Blender's units, to world space in metres."""

    def local(self, positions):
        """Returns positions of the world in local space, in Blender's units."""
        inverse = np.linalg.inv(self.matrix)
        return positions @ inverse[:3, :3].T + inverse[:3, 3]


def metres(scene):
    """The length of Blender's unit."""
    return scene.unit_settings.scale_length or 1.0


def snapshot(obj, depsgraph, with_faces=True):
    """Evaluates modifiers, shape keys, armatures and the object's transform."""
    evaluated = obj.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        local = np.empty((len(mesh.vertices), 3), np.float32)
        mesh.vertices.foreach_get("co", local.ravel())
        matrix = np.array(evaluated.matrix_world, np.float64)
        matrix[:3] *= metres(bpy.context.scene)
        positions = local.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
        triangles, polygons, loose = _faces(mesh) if with_faces else (np.empty((0, 3), np.uint32), np.empty(0, np.int32), None)
    finally:
        evaluated.to_mesh_clear()
    return Snapshot(positions, triangles, polygons, loose, matrix)


def _faces(mesh):
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    triangles, polygons = np.empty((count, 3), np.int32), np.empty(count, np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles.ravel())
    mesh.loop_triangles.foreach_get("polygon_index", polygons)
    number = mesh.attributes.get(POLYGON)
    if number is not None and number.domain == "FACE" and len(number.data) == len(mesh.polygons):
        own = np.empty(len(mesh.polygons), np.int32)
        number.data.foreach_get("value", own)
        polygons = own[polygons]
    edges, of_polygons = np.empty((len(mesh.edges), 2), np.int32), np.empty(len(mesh.loops), np.int32)
    mesh.edges.foreach_get("vertices", edges.ravel())
    mesh.loops.foreach_get("edge_index", of_polygons)
    is_loose = np.ones(len(edges), bool)
    is_loose[of_polygons] = False
    return triangles.astype(np.uint32), polygons, edges[is_loose]


def number_polygons(obj):
    """Marks each polygon of an object, so that evaluated meshes name it."""
    if obj.mode == "OBJECT" and obj.library is None:
        number = obj.data.attributes.get(POLYGON) or obj.data.attributes.new(POLYGON, "INT", "FACE")
        number.data.foreach_set("value", np.arange(len(obj.data.polygons), dtype=np.int32))


def split_polygons(obj, depsgraph):
    """Adds a Triangulate modifier to an object that shows polygons with more than three corners. Returns whether it did.

    Blender splits a quad by its shape, in some frames along one diagonal and in some along the other. Then the drawn surface is not the
    simulated one. The modifier comes before the result, and after all that a collider has.
    """
    if obj.modifiers.get(SPLIT) is not None:
        return False
    evaluated = obj.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    is_plain = len(mesh.loops) == 3 * len(mesh.polygons)
    evaluated.to_mesh_clear()
    if is_plain:
        return False
    modifier = obj.modifiers.new(SPLIT, "TRIANGULATE")
    modifier.quad_method, modifier.ngon_method = "FIXED", "CLIP"
    result = obj.modifiers.find(CACHE)
    if result >= 0:
        obj.modifiers.move(len(obj.modifiers) - 1, result)
    return True


@contextmanager
def without_results(cloths):
    """Hides the modifiers of cloths from the result on: what remains is the input of the simulation."""
    hidden = []
    for obj in cloths:
        first = obj.modifiers.find(CACHE)
        for modifier in list(obj.modifiers)[first:] if first >= 0 else ():
            hidden.append((modifier, modifier.show_viewport))
            modifier.show_viewport = False
    bpy.context.view_layer.update()
    try:
        yield
    finally:
        for modifier, shown in hidden:
            modifier.show_viewport = shown


@contextmanager
def at_rest(obj, key):
    """Shows an object in the shape key of its rest shape, without the modifiers that deform it."""
    hidden = [(each, each.show_viewport) for each in obj.modifiers if each.type in _DEFORMING]
    before = obj.active_shape_key_index, obj.show_only_shape_key
    for modifier, _ in hidden:
        modifier.show_viewport = False
    obj.active_shape_key_index = obj.data.shape_keys.key_blocks.find(key)
    obj.show_only_shape_key = True
    bpy.context.view_layer.update()
    try:
        yield
    finally:
        obj.active_shape_key_index, obj.show_only_shape_key = before
        for modifier, shown in hidden:
            modifier.show_viewport = shown
        bpy.context.view_layer.update()


def weights(obj, depsgraph, name, count):
    """(count,) the weights of a vertex group on the evaluated mesh, whatever modifiers made of it."""
    result = np.zeros(count, np.float32)
    group = obj.vertex_groups.find(name)
    if group < 0:
        return result
    evaluated = obj.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh(preserve_all_data_layers=True, depsgraph=depsgraph)
    for vertex in mesh.vertices:
        for element in vertex.groups:
            if element.group == group:
                result[vertex.index] = element.weight
    evaluated.to_mesh_clear()
    return result


def select_polygons(obj, polygons):
    """Selects these polygons of an object and no others, as far as it has them."""
    if obj.mode == "EDIT":
        bpy.ops.object.mode_set(mode="OBJECT")
    mesh = obj.data
    selected = np.zeros(len(mesh.polygons), bool)
    chosen = np.fromiter(polygons, int, len(polygons))
    selected[chosen[(chosen >= 0) & (chosen < len(selected))]] = True
    for sequence in (mesh.vertices, mesh.edges):
        sequence.foreach_set("select", np.zeros(len(sequence), bool))
    mesh.polygons.foreach_set("select", selected)
    of_vertices = np.zeros(len(mesh.vertices), bool)
    for index in np.flatnonzero(selected):
        of_vertices[list(mesh.polygons[int(index)].vertices)] = True
    mesh.vertices.foreach_set("select", of_vertices)
    mesh.update()
