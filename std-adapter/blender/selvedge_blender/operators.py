"""What the user does: check, simulate, untangle."""

from concurrent.futures import ThreadPoolExecutor

import bpy
import numpy as np
from bpy.props import BoolProperty
from selvedge import errors

from .intersections import Checker
from .job import Job, Refused
from .meshes import CACHE, metres, select_polygons, without_results
from .point_cache import PointCache, path_of, play

MOST_PLACES = 1000
"""The number of places that Check remembers."""


def visible_meshes(context):
    return [obj for obj in context.scene.objects if obj.type == "MESH" and obj.visible_get()]


def cloths_of(context):
    return [obj for obj in visible_meshes(context) if obj.selvedge.fabric != "NONE"]


def colliders_of(context):
    return [obj for obj in visible_meshes(context) if obj.selvedge.fabric == "NONE" and obj.selvedge.is_collider]


def remember_places(scene, found):
    scene.selvedge.places.clear()
    for frame in found:
        for point in frame.points[: MOST_PLACES - len(scene.selvedge.places)]:
            place = scene.selvedge.places.add()
            place.frame, place.location = frame.frame, point / metres(scene)
    scene.selvedge.place = -1


def select_found(objects, found):
    for obj in objects:
        select_polygons(obj, set().union(*(frame.polygons[obj.name] for frame in found)))


class SELVEDGE_OT_check(bpy.types.Operator):
    """Find where the selected meshes, or all that are visible, pass through themselves and each other. The answer is exact"""

    bl_idname = "selvedge.check"
    bl_label = "Check"
    bl_options = {"REGISTER", "UNDO"}
    all_frames: BoolProperty(name="All Frames", description="Check each frame of the scene's range")

    def execute(self, context):
        scene = context.scene
        visible = visible_meshes(context)
        objects = [obj for obj in context.selected_objects if obj in visible] or visible
        if not objects:
            self.report({"ERROR"}, "There is no visible mesh to check")
            return {"CANCELLED"}
        if context.mode == "EDIT_MESH":
            bpy.ops.object.mode_set(mode="OBJECT")
        before = scene.frame_current
        frames = range(scene.frame_start, scene.frame_end + 1) if self.all_frames else [before]
        checker, bad = Checker(objects), []
        try:
            for frame in frames:
                if frame != scene.frame_current:
                    scene.frame_set(frame)
                found = checker.check()
                if found.count:
                    bad.append(found)
        except errors.Error as error:
            self.report({"ERROR"}, f"Frame {scene.frame_current}: {error}")
            return {"CANCELLED"}
        finally:
            if scene.frame_current != before:
                scene.frame_set(before)
        select_found(objects, bad)
        remember_places(scene, bad)
        checked = f"frame {before}" if not self.all_frames else f"{len(frames)} frames"
        if not bad:
            scene.selvedge.report = f"No intersections in {checked}"
            self.report({"INFO"}, scene.selvedge.report)
            return {"FINISHED"}
        worst = max(bad, key=lambda found: found.count)
        text = f"{worst.count} pairs of faces intersect at frame {worst.frame} ({worst.described()})"
        if self.all_frames:
            text = f"{len(bad)} of {checked} intersect: {', '.join(str(found.frame) for found in bad[:20])}; {text}"
        scene.selvedge.report = text
        self.report({"WARNING"}, text)
        return {"FINISHED"}


class SELVEDGE_OT_next_place(bpy.types.Operator):
    """Go to the next place that Check has found: its frame, with the 3D cursor there"""

    bl_idname = "selvedge.next_place"
    bl_label = "Next Place"

    @classmethod
    def poll(cls, context):
        return len(context.scene.selvedge.places) > 0

    def execute(self, context):
        settings = context.scene.selvedge
        settings.place = (settings.place + 1) % len(settings.places)
        place = settings.places[settings.place]
        if place.frame != context.scene.frame_current:
            context.scene.frame_set(place.frame)
        context.scene.cursor.location = place.location
        if context.area is not None and context.area.type == "VIEW_3D":
            bpy.ops.view3d.view_center_cursor()
        return {"FINISHED"}


def refuse(operator, context, error):
    """Reports why a scene is refused. If it starts tangled, selects the faces."""
    if isinstance(error, errors.TangledError):
        cloths = cloths_of(context)
        objects = cloths + colliders_of(context)
        with without_results(cloths):
            found = Checker(objects).check()
        # What colliders do among themselves is no concern of cloth.
        select_found(objects, [found])
        remember_places(context.scene, [found])
    context.scene.selvedge.report = str(error)
    operator.report({"ERROR"}, str(error))
    return {"CANCELLED"}


class SELVEDGE_OT_simulate(bpy.types.Operator):
    """Simulate all cloth among all colliders, over the frames of the scene"""

    bl_idname = "selvedge.simulate"
    bl_label = "Simulate"
    bl_options = {"REGISTER", "UNDO"}
    resume: BoolProperty(name="Continue", description="Keep the result up to the present frame, and continue from there")

    def invoke(self, context, _event):
        if not self._start(context):
            return {"CANCELLED"}
        self.pool = ThreadPoolExecutor(1)
        self.work = self.job.run(self.pool.submit)
        self.timer = context.window_manager.event_timer_add(0.02, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        if not self._start(context):
            return {"CANCELLED"}
        self.work = self.job.run()
        while True:
            result = self._next(context)
            if result is not None:
                return result

    def modal(self, context, event):
        if event.type == "ESC" or not context.scene.selvedge.is_running:
            # The run notices it after the step.
            context.scene.selvedge.is_running = False
            self.is_cancelled = True
            if self.job.simulation is not None:
                self.job.simulation.cancel()
        elif event.type != "TIMER":
            return {"PASS_THROUGH"}
        return self._next(context) or {"RUNNING_MODAL"}

    def _start(self, context):
        self.pool = self.timer = None
        self.is_cancelled = False
        cloths = cloths_of(context)
        if context.mode == "EDIT_MESH":
            bpy.ops.object.mode_set(mode="OBJECT")
        if not cloths:
            self.report({"ERROR"}, "Nothing is cloth: select a mesh and choose its fabric")
            return False
        self.frame = context.scene.frame_current
        try:
            self.job = Job(context, cloths, colliders_of(context), self.frame if self.resume else None)
        except (errors.Error, Refused) as error:
            refuse(self, context, error)
            return False
        context.scene.selvedge.is_running = True
        context.window_manager.progress_begin(self.job.start, self.job.end)
        return True

    def _next(self, context):
        """Runs on until a frame is done or time has passed. Returns a result at the end."""
        try:
            frame = next(self.work)
        except StopIteration:
            return self._finish(context)
        except (errors.Error, Refused, OSError) as error:
            self._finish(context)
            return refuse(self, context, error)
        if self.is_cancelled and frame is not None:
            self.job.report.stopped = "cancelled"
            self.work.close()
            return self._finish(context)
        if frame is not None:
            length = max(1, self.job.end - self.job.start)
            context.scene.selvedge.progress = (frame - self.job.start) / length
            context.window_manager.progress_update(frame)
        if context.area is not None:
            context.area.tag_redraw()
        return None

    def _finish(self, context):
        settings = context.scene.selvedge
        settings.is_running = False
        context.window_manager.progress_end()
        if self.timer is not None:
            context.window_manager.event_timer_remove(self.timer)
        if self.pool is not None:
            self.pool.shutdown(wait=False)
        context.scene.frame_set(self.frame)
        report = self.job.report
        lines = report.lines()
        settings.report = "\n".join(lines)
        is_clean = not (report.uncertified or report.stretched or report.stopped)
        self.report({"INFO"} if is_clean else {"WARNING"}, "; ".join(lines[:3]))
        return {"FINISHED"}


class SELVEDGE_OT_untangle(bpy.types.Operator):
    """Pull cloth out of itself and of colliders at the present frame, into a shape key"""

    bl_idname = "selvedge.untangle"
    bl_label = "Untangle"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        cloths = cloths_of(context)
        if not cloths:
            self.report({"ERROR"}, "Nothing is cloth: select a mesh and choose its fabric")
            return {"CANCELLED"}
        if context.mode == "EDIT_MESH":
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            job = Job(context, cloths, colliders_of(context), context.scene.frame_current, untangle=True)
            job.make()
        except (errors.Error, Refused) as error:
            return refuse(self, context, error)
        done = job.simulation.untangled
        if done is None or not done.crossings:
            self.report({"INFO"}, "Nothing is tangled")
            return {"FINISHED"}
        for part in job.parts:
            positions = part.shot.positions.copy()
            positions[part.used] = job.simulation.positions[part.rows]
            self._keep(context, part, part.shot.local(positions))
        text = f"{done.crossings} intersections pulled apart; vertices moved by up to {done.farthest:.4f} m"
        context.scene.selvedge.report = text
        self.report({"INFO"}, text)
        return {"FINISHED"}

    @staticmethod
    def _keep(context, part, local):
        """Keeps positions in a shape key; where modifiers made the mesh, in a result of one frame."""
        obj = part.obj
        if any(each.show_viewport and each.name != CACHE for each in obj.modifiers) or len(obj.data.vertices) != len(local):
            cache = PointCache(path_of(context.scene, obj), len(local), context.scene.frame_current)
            cache.add(local)
            cache.close()
            play(obj, cache.path, context.scene.frame_current)
            return
        if obj.data.shape_keys is None:
            obj.shape_key_add(name="Basis", from_mix=False)
        key = obj.data.shape_keys.key_blocks.get("Untangled") or obj.shape_key_add(name="Untangled", from_mix=False)
        for other in obj.data.shape_keys.key_blocks[1:]:
            other.value = 0.0
        key.data.foreach_set("co", np.ascontiguousarray(local, np.float32).ravel())
        key.value = 1.0
        obj.data.update()


class SELVEDGE_OT_clear(bpy.types.Operator):
    """Remove the results from all cloth; the files stay"""

    bl_idname = "selvedge.clear"
    bl_label = "Clear Results"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        for obj in context.scene.objects:
            modifier = obj.modifiers.get(CACHE) if obj.type == "MESH" else None
            if modifier is not None:
                obj.modifiers.remove(modifier)
        context.scene.selvedge.report = ""
        return {"FINISHED"}


CLASSES = (SELVEDGE_OT_check, SELVEDGE_OT_next_place, SELVEDGE_OT_simulate, SELVEDGE_OT_untangle, SELVEDGE_OT_clear)
