"""Pictures of a skirt and of two layers, and the skirt beside Blender's own cloth: python pictures.py [FOLDER], with bpy and selvedge.

Each scene is a process of its own, as in the tests. A picture takes up to a minute.
"""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent
COLOURS = {"skirt": (0.08, 0.2, 0.55), "lining": (0.7, 0.1, 0.12), "coat": (0.1, 0.2, 0.4), "body": (0.7, 0.5, 0.38)}
BLENDERS = [(5, 2), (12, 5), (20, 10)]


def picture(bpy, path, at, objects):
    """Renders objects at a place with Cycles."""
    from mathutils import Vector

    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    for each in (camera, sun):
        scene.collection.objects.link(each)
    sun.data.energy, sun.data.angle, sun.rotation_euler = 3, 0.2, (0.7, 0.3, 0.6)
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.6, 0.65, 0.72, 1)
    camera.location = Vector(at) + Vector((1.5, -2.0, 0.55))
    camera.rotation_euler = (Vector(at) - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.lens, scene.camera = 60, camera
    for obj in objects:
        material = bpy.data.materials.new(obj.name)
        material.use_nodes = True
        shader = material.node_tree.nodes["Principled BSDF"]
        shader.inputs["Base Color"].default_value = (*COLOURS[obj.name], 1)
        shader.inputs["Roughness"].default_value = 0.8
        obj.data.materials.clear()
        obj.data.materials.append(material)
        obj.data.polygons.foreach_set("use_smooth", [True] * len(obj.data.polygons))
    render = scene.render
    render.engine, scene.cycles.device, scene.cycles.samples = "CYCLES", "CPU", 32
    render.resolution_x, render.resolution_y, render.filepath = 440, 520, str(path)
    bpy.ops.render.render(write_still=True)


def skirt(scene, folder):
    from stage import bpy, figure, simulate, skirt

    scene.frame_end = 60
    rig, body = figure()
    worn = skirt(rig)
    clock, cpu = time.perf_counter(), time.process_time()
    simulate()
    measure("Selvedge", clock, cpu, [worn, body])
    scene.frame_set(44)
    picture(bpy, folder / "blender-skirt.png", (0, rig.matrix_world.translation[1], 0.75), [worn, body])


def layers(scene, folder):
    from stage import bad_frames, bpy, figure, simulate, skirt

    scene.frame_end = 40
    rig, body = figure()
    inner = skirt(rig, "lining", 60, 28, length=0.62)
    outer = skirt(rig, "coat", 60, 24, waist=0.187, flare=0.22, length=0.5)
    inner.selvedge.fabric, outer.selvedge.fabric = "SILK", "DENIM"
    simulate()
    assert bad_frames([inner, outer, body]) == {}
    scene.frame_set(32)
    picture(bpy, folder / "blender-layers.png", (0, rig.matrix_world.translation[1], 0.75), [inner, outer, body])


def blender(scene, folder, quality, collisions):
    from stage import bpy, figure, skirt

    scene.frame_end = 60
    rig, body = figure()
    worn = skirt(rig)
    worn.selvedge.fabric = "NONE"
    for obj in (worn, body):
        obj.modifiers.new("Split", "TRIANGULATE").quad_method = "FIXED"
    body.modifiers.new("Collision", "COLLISION")
    body.collision.thickness_outer, body.collision.use_culling = 0.003, False
    cloth = worn.modifiers.new("Cloth", "CLOTH")
    settings, contact = cloth.settings, cloth.collision_settings
    settings.quality, settings.vertex_group_mass, settings.mass = quality, "waist", 0.3
    settings.tension_stiffness = settings.compression_stiffness = 15
    settings.shear_stiffness, settings.bending_stiffness = 5, 0.5
    contact.use_self_collision, contact.collision_quality = True, collisions
    contact.distance_min = contact.self_distance_min = 0.003
    cloth.point_cache.frame_start, cloth.point_cache.frame_end = 1, 60
    clock, cpu = time.perf_counter(), time.process_time()
    for frame in range(1, 61):
        scene.frame_set(frame)
        worn.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    measure(f"Blender's cloth, quality {quality}, collision quality {collisions}", clock, cpu, [worn, body])
    if quality == BLENDERS[0][0]:
        scene.frame_set(44)
        picture(bpy, folder / "blender-own.png", (0, rig.matrix_world.translation[1], 0.75), [worn, body])


def measure(name, clock, cpu, objects):
    from stage import bad_frames

    clock, cpu = time.perf_counter() - clock, time.process_time() - cpu
    print("MEASURED", json.dumps([name, clock, cpu, len(bad_frames(objects))]))


def main(folder):
    jobs = [["skirt"], ["layers"]] + [["blender", str(a), str(b)] for a, b in BLENDERS]
    print("| the skirt, 60 frames | time | of all cores | frames that intersect |\n|---|---|---|---|")
    for job in jobs:
        environment = os.environ | {"PYTHONPATH": str(HERE / "tests")}
        command = [sys.executable, __file__, "--job", str(folder), *job]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=1200)
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)
        for line in done.stdout.splitlines():
            if line.startswith("MEASURED"):
                name, clock, cpu, bad = json.loads(line.split(" ", 1)[1])
                print(f"| {name} | {clock:.1f} s | {cpu:.1f} s | {bad} of 60 |", flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--job"]:
        from stage import main as on_stage

        folder, name, *values = sys.argv[2:]
        on_stage(lambda scene: globals()[name](scene, Path(folder), *map(int, values)))
    else:
        main(Path(sys.argv[1] if sys.argv[1:] else ".").resolve())
