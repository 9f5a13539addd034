"""Scenes for the tests, and what all of them need. Each test is a process of its own, since bpy holds one scene and may hang at its exit."""

import importlib
import math
import os
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np
from ending import end_after

# The installed extension has another name than the folder.
PACKAGE = os.environ.get("SELVEDGE_BLENDER", "selvedge_blender")
if PACKAGE == "selvedge_blender":
    sys.path.insert(0, str(Path(__file__).parents[1]))
addon = importlib.import_module(PACKAGE)
intersections = importlib.import_module(PACKAGE + ".intersections")
point_cache = importlib.import_module(PACKAGE + ".point_cache")


def main(test):
    """Runs a test and ends the process at once."""
    end_after(lambda: in_empty_scene(test))


def in_empty_scene(test):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if not hasattr(bpy.types.Scene, "selvedge"):
        addon.register()
    scene = bpy.context.scene
    scene.frame_end = 20
    with tempfile.TemporaryDirectory() as folder:
        scene.selvedge.folder = folder
        test(scene)


def run(operator, **values):
    """Runs an operator; returns its result, or the text of its error."""
    try:
        return operator(**values)
    except RuntimeError as error:
        return str(error)


def simulate(**values):
    result = run(bpy.ops.selvedge.simulate, **values)
    print(bpy.context.scene.selvedge.report)
    assert result == {"FINISHED"}, result
    return bpy.context.scene.selvedge.report


def bad_frames(objects, frames=None):
    """The frames of the scene at which what Blender shows intersects."""
    scene = bpy.context.scene
    checker, bad = intersections.Checker(objects), {}
    for frame in frames or range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
        found = checker.check()
        if found.count:
            bad[frame] = found.described()
    return bad


def grid(name, size, cells, at, fabric="COTTON"):
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=cells, y_subdivisions=cells, size=size, location=at)
    obj = bpy.context.object
    obj.name, obj.selvedge.fabric = name, fabric
    return obj


def suzanne(size=0.5, at=(0, 0, 0.5), levels=1):
    bpy.ops.mesh.primitive_monkey_add(size=size, location=at)
    obj = bpy.context.object
    if levels:
        obj.modifiers.new("Subdivision", "SUBSURF").levels = levels
    return obj


def mesh_object(name, positions, faces, edges=()):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(positions, edges, faces)
    mesh.update()
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def figure(frames=60):
    """A torso with two legs that walk, skinned by an armature."""
    scene = bpy.context.scene
    armature = bpy.data.armatures.new("rig")
    rig = bpy.data.objects.new("rig", armature)
    scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")

    def bone(name, head, tail, parent=None):
        made = armature.edit_bones.new(name)
        made.head, made.tail = head, tail
        made.parent = armature.edit_bones[parent] if parent else None

    bone("spine", (0, 0, 0.95), (0, 0, 1.45))
    for side, sign in (("L", 1), ("R", -1)):
        bone("thigh." + side, (0.1 * sign, 0, 0.92), (0.1 * sign, 0, 0.5), "spine")
        bone("shin." + side, (0.1 * sign, 0, 0.5), (0.1 * sign, 0, 0.06), "thigh." + side)
    bpy.ops.object.mode_set(mode="OBJECT")
    body = _body(scene)
    groups = {each.name: body.vertex_groups.new(name=each.name) for each in armature.bones}
    for vertex in body.data.vertices:
        x, _, z = vertex.co
        side = "L" if x > 0 else "R"
        hip, knee = min(1, max(0, (z - 0.84) / 0.14)), min(1, max(0, (z - 0.44) / 0.12))
        shares = {"spine": hip, "thigh." + side: (1 - hip) * knee, "shin." + side: (1 - hip) * (1 - knee)}
        for name, share in shares.items():
            if share > 0:
                groups[name].add([vertex.index], share, "REPLACE")
    body.modifiers.new("Armature", "ARMATURE").object = rig
    body.parent = rig
    _walk(rig, frames)
    return rig, body


def _body(scene):
    """A closed surface of metaballs."""
    balls = bpy.data.metaballs.new("balls")
    balls.resolution = 0.05
    obj = bpy.data.objects.new("balls", balls)
    scene.collection.objects.link(obj)

    def ball(place, radius):
        element = balls.elements.new()
        element.co, element.radius = place, 1.7 * radius

    for z in np.arange(0.95, 1.5, 0.05):
        ball((0, 0, z), 0.13)
    for sign in (1, -1):
        for z in np.arange(0.08, 0.95, 0.04):
            ball((0.1 * sign, 0, z), 0.07)
    ball((0, 0, 1.65), 0.12)
    bpy.context.view_layer.update()
    mesh = bpy.data.meshes.new_from_object(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    bpy.data.objects.remove(obj)
    body = bpy.data.objects.new("body", mesh)
    scene.collection.objects.link(body)
    return body


def _walk(rig, frames):
    for bone in rig.pose.bones:
        bone.rotation_mode = "XYZ"
    for frame in range(1, frames + 1, 3):
        time = (frame - 1) / 24
        ease = min(1, time / 0.5)
        swing = math.sin(2 * math.pi * time / 1.2) * ease
        for side, sign in (("L", 1), ("R", -1)):
            rig.pose.bones["thigh." + side].rotation_euler = (0.7 * sign * swing, 0, 0)
            rig.pose.bones["shin." + side].rotation_euler = (-0.5 * ease + 0.5 * min(0, -sign * swing), 0, 0)
            for name in ("thigh.", "shin."):
                rig.pose.bones[name + side].keyframe_insert("rotation_euler", frame=frame)
        rig.rotation_euler = (0, 0, 0.8 * math.sin(2 * math.pi * time / 2.4) * ease)
        rig.location = (0, -0.25 * time * ease, 0.02 * math.sin(4 * math.pi * time / 1.2))
        rig.keyframe_insert("rotation_euler", frame=frame)
        rig.keyframe_insert("location", frame=frame)


def skirt(rig, name="skirt", around=72, rows=36, waist=0.175, flare=0.2, length=0.56):
    """A skirt in the shape of an A, whose waist the spine carries."""
    positions = []
    for row in range(rows + 1):
        radius, z = waist + flare * row / rows, 1.06 - length * row / rows
        angles = 2 * np.pi * np.arange(around) / around
        positions += [(radius * math.cos(angle), radius * math.sin(angle), z) for angle in angles]
    faces = []
    for row in range(rows):
        for k in range(around):
            a, b = row * around + k, row * around + (k + 1) % around
            faces.append((a, a + around, b + around, b))
    obj = mesh_object(name, positions, faces)
    obj.vertex_groups.new(name="waist").add(list(range(2 * around)), 1.0, "REPLACE")
    obj.vertex_groups.new(name="spine").add(list(range(len(positions))), 1.0, "REPLACE")
    obj.modifiers.new("Armature", "ARMATURE").object = rig
    obj.parent = rig
    obj.selvedge.fabric, obj.selvedge.pin_group, obj.selvedge.thickness = "COTTON", "waist", 0.003
    return obj


def positions_of(obj):
    """The evaluated positions of an object, in world space."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    local = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("co", local.ravel())
    evaluated.to_mesh_clear()
    matrix = np.array(obj.matrix_world)
    return local @ matrix[:3, :3].T + matrix[:3, 3]
