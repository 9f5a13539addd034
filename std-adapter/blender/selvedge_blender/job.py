"""One simulation: Blender's scene in, point caches out. No operators and no user interface."""

import warnings
from dataclasses import dataclass, field

import bpy
import numpy as np
from selvedge import Simulation, errors, seam_rows

from .meshes import Snapshot, at_rest, metres, snapshot, split_polygons, weights, without_results
from .point_cache import PointCache, path_of, play, read_sample


class Refused(ValueError):
    """The scene cannot be simulated. The message says why, and what to do."""


@dataclass
class Part:
    """A cloth object."""

    obj: object
    used: np.ndarray
    """The vertices of the evaluated mesh that the simulation has."""
    pinned: dict
    """group of pins -> indices of its vertices among these."""
    shot: Snapshot
    rows: slice = None
    """Of the simulation's positions."""
    cache: PointCache = None


@dataclass
class Report:
    """What a run did."""

    frames: int = 0
    steps: int = 0
    notes: list = field(default_factory=list)
    """What the user should know before looking at frames."""
    uncertified: dict = field(default_factory=dict)
    """frame -> the reason why it is not certified."""
    stretched: dict = field(default_factory=dict)
    """frame -> the largest stretch of an edge, beyond the limit."""
    stopped: str = ""

    def lines(self):
        """The report as lines of text; the first is a summary."""
        words = f"{self.frames} frames in {self.steps} steps"
        if self.uncertified:
            words += f", {len(self.uncertified)} not certified"
        elif self.frames:
            words += ", all free of intersections"
        if self.stretched:
            words += f"; {len(self.stretched)} stretched beyond the limit, up to {max(self.stretched.values()):.2f}"
        lines = [words] + ([f"Stopped: {self.stopped}"] if self.stopped else []) + self.notes
        return lines + [f"Frame {frame}: {why}" for frame, why in self.uncertified.items()]


class Job:
    """A run over the frames of a scene. Blender's main thread calls everything but :meth:`make` and :meth:`advance`."""

    def __init__(self, context, cloths, colliders, from_frame=None, untangle=False):
        self.context, self.scene = context, context.scene
        self.settings, self.cloths, self.colliders = context.scene.selvedge, cloths, colliders
        self.first, self.end = self.scene.frame_start, self.scene.frame_end
        self.start = self.first if from_frame is None else from_frame
        self.is_untangling = untangle
        self.fps = self.scene.render.fps / self.scene.render.fps_base
        self.report, self.counts, self.simulation = Report(), {}, None
        self._read_scene()

    # -- set-up: the main thread reads Blender, any thread makes the simulation

    def _read_scene(self):
        before = self.scene.frame_current
        if not self.is_untangling:
            self.scene.frame_set(self.start)
        try:
            self._split()
            with without_results(self.cloths):
                if self.scene.frame_current != self.start and not self.is_untangling:
                    self.scene.frame_set(self.start)
                self.described = self._described(self.context.evaluated_depsgraph_get())
        except Exception:
            self.scene.frame_set(before)
            raise

    def _split(self):
        depsgraph = self.context.evaluated_depsgraph_get()
        if self.is_untangling:
            return
        split = [obj.name for obj in self.cloths + self.colliders if split_polygons(obj, depsgraph)]
        if split:
            self.report.notes.append(
                f"Added a Triangulate modifier to {', '.join(split)}: Blender splits quads differently from frame to frame"
            )

    def _described(self, depsgraph):
        """The scene of the simulation, and its parts."""
        settings, groups, seams = self.settings, [], []
        self.parts = []
        cloths = [self._cloth(obj, depsgraph, groups, seams) for obj in self.cloths]
        bodies = []
        for obj in self.colliders:
            shot = snapshot(obj, depsgraph)
            self._check_faces(obj, shot)
            self.counts[obj.name] = len(shot.positions)
            bodies.append({"name": obj.name, "positions": shot.positions, "faces": shot.triangles, "driven": True})
        gravity = np.array(self.scene.gravity, float) * self.scene.use_gravity
        self.wind = self._wind()
        effects = {
            "gravity": {"acceleration": gravity},
            "air_drag": {"rate": settings.air_drag},
            "strain_limit": {"limit": 1 + settings.strain_limit} if settings.strain_limit > 0 else None,
            "friction": {"coefficient": settings.friction} if settings.friction > 0 else None,
            "wind": {"velocity": self.wind} if self.wind is not None else None,
            "pins": {"group": groups} if groups else None,
            "seams": {"seam": seams} if seams else None,
        }
        tangled = "untangle" if self.is_untangling else settings.if_tangled.lower()
        return {
            "name": bpy.path.display_name_from_filepath(bpy.data.filepath) or "untitled",
            "frames_per_second": self.fps,
            "on_blocked": settings.if_pinched.lower(),
            "tangled_start": tangled,
            "cloth": cloths,
            "body": bodies,
            "effects": {name: effect for name, effect in effects.items() if effect is not None},
        }

    @staticmethod
    def _check_faces(obj, shot):
        if not len(shot.triangles):
            raise Refused(f"'{obj.name}' has no faces at frame {bpy.context.scene.frame_current}: hide it, or give it faces")

    def _cloth(self, obj, depsgraph, groups, seams):
        own, shot = obj.selvedge, snapshot(obj, depsgraph)
        self._check_faces(obj, shot)
        used, faces = np.unique(shot.triangles, return_inverse=True)
        faces = faces.reshape(-1, 3)
        start = shot.positions
        if self.start != self.first:
            start = self._resumed(obj, shot)
        table = {
            "name": obj.name,
            "positions": start[used],
            "faces": faces,
            "material": own.fabric.lower(),
            "self_collision": {"thickness": own.thickness},
            "body_contact": {"thickness": own.thickness},
        }
        if not self.colliders:
            del table["body_contact"]
        rest = self._rest(obj, shot)
        if rest is not None:
            table["rest_positions"] = rest[used]
        pinned = self._pins(obj, weights(obj, depsgraph, own.pin_group, len(shot.positions))[used], groups)
        if own.sew:
            number = np.full(len(shot.positions), -1)
            number[used] = np.arange(len(used))
            loose = number[shot.loose_edges]
            rows = seam_rows(faces, loose[(loose >= 0).all(axis=1)])
            closing = {"closing": own.sewing_frames / self.fps} if own.sewing_frames > 0 else {}
            place = {"cloth": obj.name}
            seams += [{"first": place | {"vertices": a}, "second": place | {"vertices": b}} | closing for a, b in rows]
            if not rows:
                raise Refused(f"'{obj.name}' is to be sewn, but has no loose edges: join the sides of a seam by edges without faces")
        self.parts.append(Part(obj, used, pinned, shot))
        self.counts[obj.name] = len(shot.positions)
        return table

    @staticmethod
    def _pins(obj, shares, groups):
        """Adds the groups of hard and of soft pins, by the weights of the cloth's vertices; returns their vertices."""
        hard = np.flatnonzero(shares >= 1)
        soft = np.flatnonzero((shares > 0) & (shares < 1))
        kinds = [(hard, {}), (soft, {"stiffness": obj.selvedge.pin_stiffness, "weights": shares[soft]})]
        pinned = {}
        for vertices, springs in kinds:
            if len(vertices):
                pinned[len(groups)] = vertices
                groups.append({"cloth": obj.name, "vertices": vertices, "driven": True} | springs)
        return pinned

    def _rest(self, obj, shot):
        """The positions at rest, in world space: those of the rest shape key, or of the first frame of a run that continues."""
        key, keys = obj.selvedge.rest_key, obj.data.shape_keys
        if key:
            if keys is None or keys.key_blocks.find(key) < 0:
                raise Refused(f"'{obj.name}' has no shape key '{key}' to rest in: choose another one")
            with at_rest(obj, key):
                rest = snapshot(obj, self.context.evaluated_depsgraph_get(), with_faces=False)
            if len(rest.positions) != len(shot.positions):
                raise Refused(
                    f"'{obj.name}' has {len(rest.positions)} vertices at rest, but {len(shot.positions)} at frame {self.start}: "
                    "the modifiers below must make the same mesh of both shapes"
                )
            return rest.positions
        if self.start == self.first:
            return None
        self.scene.frame_set(self.first)
        try:
            return snapshot(obj, self.context.evaluated_depsgraph_get(), with_faces=False).positions
        finally:
            self.scene.frame_set(self.start)

    def _resumed(self, obj, shot):
        """The positions of the result at the frame from which the run continues."""
        sample = read_sample(path_of(self.scene, obj), self.start)
        if sample is None or len(sample[0]) != len(shot.positions):
            raise Refused(f"'{obj.name}' has no result at frame {self.start}: simulate from the start, or go to an earlier frame")
        homogeneous = np.c_[sample[0], np.ones(len(sample[0]))]
        return homogeneous @ shot.matrix[:3].T

    def _wind(self):
        """The velocity of all wind force fields, in m/s; None without any. Their strength is the speed along their own z axis."""
        winds = [obj for obj in self.scene.objects if obj.field is not None and obj.field.type == "WIND" and not obj.hide_viewport]
        if not winds:
            return None
        velocities = [np.array(obj.matrix_world.to_3x3().normalized().col[2]) * obj.field.strength for obj in winds]
        return np.sum(velocities, axis=0)

    def make(self):
        """Makes the simulation; any thread."""
        self.simulation = Simulation.from_dict(self.described, 0)
        for part in self.parts:
            part.rows = self.simulation.vertices_of_cloth(part.obj.name)
        self.described = None
        untangled = self.simulation.untangled
        if untangled is not None and untangled.crossings:
            self.report.notes.append(f"The start was tangled in {untangled.crossings} places; it was pulled apart")

    def _continue_motion(self):
        """Gives cloth the velocities that its result had before the frame from which the run continues."""
        for part in self.parts:
            before, now = (read_sample(path_of(self.scene, part.obj), frame) for frame in (self.start - 1, self.start))
            if before is None or now is None:
                continue
            moves = (now[0] - before[0])[part.used] @ part.shot.matrix[:3, :3].T * self.fps
            first = part.rows.start
            for vertex, velocity in enumerate(moves):
                self.simulation.set_velocity([first + vertex], velocity)

    # -- the run

    def prepare(self, frame, subframe=0.0):
        """Reads colliders and pins at a frame, and sets them as the goals of the next advance."""
        self.scene.frame_set(frame, subframe=subframe)
        depsgraph = self.context.evaluated_depsgraph_get()
        for obj in self.colliders:
            self.simulation.move_body(obj.name, self._read(obj, depsgraph).positions)
        for part in self.parts:
            part.shot = self._read(part.obj, depsgraph)
            for group, vertices in part.pinned.items():
                self.simulation.move_pins(group, part.shot.positions[part.used][vertices])
        if self.wind is not None:
            self.simulation.set_wind(self._wind())

    def _read(self, obj, depsgraph):
        shot = snapshot(obj, depsgraph, with_faces=False)
        if len(shot.positions) != self.counts[obj.name]:
            raise Refused(
                f"'{obj.name}' has {len(shot.positions)} vertices at frame {self.scene.frame_current}, but {self.counts[obj.name]} at "
                f"frame {self.start}: modifiers that change the mesh in time must come after the simulation, or be applied"
            )
        return shot

    def advance(self, share=1.0):
        """Advances by a share of a frame; any thread."""
        with warnings.catch_warnings():
            # The report has it.
            warnings.simplefilter("ignore", RuntimeWarning)
            before = self.simulation.steps_done
            try:
                return self.simulation.advance(share / self.fps, most=self.settings.most_steps)
            finally:
                self.report.steps += self.simulation.steps_done - before

    def _write(self, frame):
        simulation, report = self.simulation, self.report
        for part in self.parts:
            positions = part.shot.positions.copy()
            positions[part.used] = simulation.positions[part.rows]
            if part.cache is None:
                path = path_of(self.scene, part.obj)
                samples = 0 if self.start == self.first else read_sample(path, self.start)[1] - 1
                part.cache = PointCache(path, len(positions), self.first, samples)
            part.cache.add(part.shot.local(positions))
        report.frames += 1
        if not simulation.is_certified:
            pairs = simulation.tolerated_pairs
            report.uncertified[frame] = (
                f"{pairs} pairs still pass through each other" if pairs else "a collider pinches cloth, and passes through it until it is free"
            )
        elif simulation.lag > 0:
            report.uncertified[frame] = f"colliders and pins are {simulation.lag:.3f} s late, since cloth blocks them"
        limit, largest = self.settings.strain_limit, simulation.edge_stretch[1]
        if limit > 0 and largest > 1.05 * (1 + limit):
            report.stretched[frame] = largest

    def _close(self):
        for part in self.parts:
            if part.cache is None:
                continue
            part.cache.close()
            after = play(part.obj, part.cache.path, self.first)
            if after:
                self.report.notes.append(
                    f"'{part.obj.name}' has {', '.join(after)} after the result: they change the surface that was certified"
                )

    def run(self, submit=None):
        """A generator of the frames that are done. ``submit`` runs a call in another thread and returns a future, and then None is yielded
        while it runs; without it calls run here."""
        try:
            yield from self._called(submit, self.make)
            if self.start != self.first:
                self._continue_motion()
            with without_results(self.cloths):
                for _ in range(self.settings.settle if self.start == self.first else 0):
                    yield from self._called(submit, self.advance)
                self._write(self.start)
                yield self.start
                samples = self.settings.samples
                for frame in range(self.start, self.end):
                    for sample in range(1, samples + 1):
                        whole, part = divmod(sample, samples)
                        self.prepare(frame + whole, part / samples)
                        yield from self._called(submit, self.advance, 1 / samples)
                    self._write(frame + 1)
                    yield frame + 1
        except errors.BlockedError as blocked:
            self.report.stopped = str(blocked)
        except errors.CancelledError:
            self.report.stopped = "cancelled"
        finally:
            self._close()

    def _called(self, submit, call, *values):
        if submit is None:
            return call(*values)
        future = submit(call, *values)
        while not future.done():
            yield None
        return future.result()
