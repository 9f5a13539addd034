"""Cloth in USD: reads meshes of a stage, simulates them, and writes the result as time samples of points into a layer of its own.

It needs the package ``usd-core`` (``pip install selvedge[usd]``), which it imports when it is used.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._native import Simulation
from .errors import InputError

__all__ = ["Result", "simulate"]


@dataclass
class Result:
    """A finished simulation of a stage."""

    simulation: Simulation
    """In its last state. Its cloths and bodies have the paths of their prims as names."""
    frames: int = 0
    """The number of time codes that were written."""
    steps: int = 0
    """The number of steps."""
    uncertified: list[float] = field(default_factory=list)
    """The time codes whose state is not certified free of intersections."""


def simulate(
    path: str | os.PathLike[str],
    cloths: Mapping[str, Mapping[str, Any]],
    bodies: Sequence[str] = (),
    *,
    out: str | os.PathLike[str],
    thickness: float = 0.004,
    effects: Mapping[str, Any] | None = None,
    start: float | None = None,
    end: float | None = None,
    settle: int = 0,
    most: int = 200,
    threads: int = 0,
    **scene: Any,
) -> Result:
    """Simulates meshes of a stage from time code to time code, and writes ``out``: a layer over the file, which stays as it is.

    ``cloths`` maps paths of meshes, or of subsets of their faces, to the keys of a cloth (``{"material": "cotton"}``) with two of its own:
    ``pins``, vertices of the mesh (numbers, a mask, or the name of a primvar whose vertices of 0.5 or more are pinned) that follow the
    stage's animation, and ``rest_time``, the time code at which the cloth has its shape at rest. ``bodies`` are paths of meshes that cloth
    does not pass through. ``effects`` are added to gravity along the stage's up axis, friction and contact with ``thickness`` in metres.
    Times are the stage's without ``start`` and ``end``; cloth first gets ``settle`` frames to come to rest. Other keys are those of a scene
    for :meth:`~selvedge.Simulation.from_dict`, such as ``tangled_start``.

    Polygons are split into fans, in the same way at all times. Points, extents and their time samples are written; authored normals and
    velocities of cloths are blocked, since they are those of the input.

    Raises InputError for prims that are not meshes, that skeletons or changing topology move, or that instances share, with the remedy,
    and the errors of :class:`~selvedge.Simulation`.
    """
    try:
        from pxr import Sdf, Usd, UsdGeom
    except ImportError:
        raise ImportError("selvedge.usd needs the package usd-core: pip install selvedge[usd]") from None
    stage = Usd.Stage.Open(os.fspath(path))
    first = stage.GetStartTimeCode() if start is None else start
    last = stage.GetEndTimeCode() if end is None else end
    if not last >= first:
        raise InputError(f"the time codes end at {last}, before they start at {first}")
    rate, unit = stage.GetTimeCodesPerSecond(), UsdGeom.GetStageMetersPerUnit(stage)
    up = 1 if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y else 2
    worn = [_Mesh(stage, prim, first, unit, is_written=True) for prim in cloths]
    solid = [_Mesh(stage, prim, first, unit) for prim in bodies]
    groups: list[dict[str, Any]] = []
    tables = [mesh.cloth(own, groups) for mesh, own in zip(worn, cloths.values())]
    described: dict[str, Any] = {
        "name": os.path.basename(os.fspath(path)),
        "frames_per_second": max(rate, 1.0),
        "on_blocked": "yield",
        "cloth": tables,
        "body": [mesh.body() for mesh in solid],
        "effects": {
            "gravity": {"acceleration": [-9.81 if axis == up else 0.0 for axis in range(3)]},
            "self_collision": {"thickness": thickness},
            "body_contact": {"thickness": thickness},
            "friction": {"coefficient": 0.3},
        }
        | ({"pins": {"group": groups}} if groups else {})
        | dict(effects or {}),
    }
    simulation = Simulation.from_dict(described | scene, threads)
    layer = Sdf.Layer.CreateNew(os.fspath(out))
    layer.subLayerPaths.append(os.path.relpath(os.fspath(path), os.path.dirname(os.path.abspath(out))))
    over = Usd.Stage.Open(layer)
    over.SetStartTimeCode(first)
    over.SetEndTimeCode(last)
    over.SetTimeCodesPerSecond(rate)
    UsdGeom.SetStageMetersPerUnit(over, unit)
    UsdGeom.SetStageUpAxis(over, UsdGeom.GetStageUpAxis(stage))
    if stage.GetDefaultPrim():
        over.SetDefaultPrim(over.GetPrimAtPath(stage.GetDefaultPrim().GetPath()))
    result = Result(simulation)
    for _ in range(settle):
        result.steps += simulation.advance(1 / rate, most=most)[0]
    for code in np.arange(first, last + 1e-9):
        if code > first:
            for mesh in solid:
                simulation.move_body(mesh.name, mesh.world(code))
            for mesh in worn:
                if mesh.group >= 0:
                    simulation.move_pins(mesh.group, mesh.world(code)[mesh.used[mesh.pinned]])
            result.steps += simulation.advance(1 / rate, most=most)[0]
        for mesh in worn:
            mesh.write(over, simulation, code)
        result.frames += 1
        if not simulation.is_certified:
            result.uncertified.append(float(code))
    layer.Save()
    return result


class _Mesh:
    """A mesh of a stage, or a subset of its faces, in world space and metres."""

    def __init__(self, stage: Any, path: str, at: float, unit: float, is_written: bool = False) -> None:
        from pxr import UsdGeom

        prim = stage.GetPrimAtPath(path)
        if not prim:
            raise InputError(f"{path}: the stage has no such prim")
        subset = UsdGeom.Subset(prim) if prim.IsA(UsdGeom.Subset) else None
        self.mesh = UsdGeom.Mesh(prim.GetParent() if subset else prim)
        if not self.mesh or not self.mesh.GetPrim().IsA(UsdGeom.Mesh):
            raise InputError(f"{path}: the prim is of type {prim.GetTypeName() or 'none'}, not a Mesh")
        self.name, self.unit, self.group = path, unit, -1
        if is_written and self.mesh.GetPrim().IsInstanceProxy():
            raise InputError(f"{path}: the mesh belongs to an instance, which others share: make the instance editable first")
        if self.mesh.GetPrim().GetRelationship("skel:skeleton").GetTargets():
            raise InputError(f"{path}: a skeleton moves the mesh: bake its points first (for example by an export with Armatures off)")
        if subset and subset.GetElementTypeAttr().Get() != UsdGeom.Tokens.face:
            raise InputError(f"{path}: the subset is not one of faces")
        chosen = np.asarray(subset.GetIndicesAttr().Get(at)) if subset else None
        self.count = len(self._points(at))
        self.used, faces = np.unique(self._faces(at, chosen), return_inverse=True)
        self.faces = faces.reshape(-1, 3)
        self.pinned: NDArray[Any] = np.zeros(0, int)
        self.start = at

    def _points(self, at: float) -> NDArray[np.float64]:
        points = self.mesh.GetPointsAttr().Get(at)
        if points is None or len(points) == 0:
            raise InputError(f"{self.name}: the mesh has no points at the time code {at}")
        return np.asarray(points, np.float64)

    def _faces(self, at: float, chosen: NDArray[Any] | None) -> NDArray[np.uint32]:
        from pxr import UsdGeom

        counts = np.asarray(self.mesh.GetFaceVertexCountsAttr().Get(at))
        corners = np.asarray(self.mesh.GetFaceVertexIndicesAttr().Get(at))
        if counts.ndim != 1 or len(counts) == 0:
            raise InputError(f"{self.name}: the mesh has no faces")
        firsts = np.cumsum(counts) - counts
        if chosen is not None:
            counts, firsts = counts[chosen], firsts[chosen]
        fans = []
        for k in range(1, int(counts.max()) - 1):
            own = firsts[counts > k + 1]
            fans.append(np.stack([corners[own], corners[own + k], corners[own + k + 1]], axis=1))
        faces = np.concatenate(fans).astype(np.uint32)
        is_left = self.mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded
        return faces[:, ::-1] if is_left else faces

    def _matrix(self, at: float) -> NDArray[np.float64]:
        """From local space to the world, for rows."""
        from pxr import UsdGeom

        return np.array(UsdGeom.XformCache(at).GetLocalToWorldTransform(self.mesh.GetPrim()))

    def world(self, at: float) -> NDArray[np.float64]:
        """The positions of all points at a time code."""
        points, matrix = self._points(at), self._matrix(at)
        if len(points) != self.count:
            raise InputError(
                f"{self.name}: the mesh has {len(points)} points at the time code {at}, but {self.count} at {self.start}: "
                "its topology must not change"
            )
        world: NDArray[np.float64] = (points @ matrix[:3, :3] + matrix[3, :3]) * self.unit
        return world

    def body(self) -> dict[str, Any]:
        return {"name": self.name, "positions": self.world(self.start), "faces": self.used[self.faces], "driven": True}

    def cloth(self, keys: Mapping[str, Any], groups: list[dict[str, Any]]) -> dict[str, Any]:
        own = dict(keys)
        pins, rest = own.pop("pins", None), own.pop("rest_time", None)
        table = {"name": self.name, "positions": self.world(self.start)[self.used], "faces": self.faces} | own
        if rest is not None:
            table["rest_positions"] = self.world(rest)[self.used]
        if pins is not None:
            self.pinned = np.flatnonzero(self._mask(pins)[self.used])
        if len(self.pinned):
            groups.append({"cloth": self.name, "vertices": self.pinned, "driven": True})
            self.group = len(groups) - 1
        return table

    def _mask(self, pins: str | ArrayLike) -> NDArray[np.bool_]:
        """One bool for each point of the mesh."""
        if isinstance(pins, str):
            from pxr import UsdGeom

            primvar = UsdGeom.PrimvarsAPI(self.mesh).GetPrimvar(pins)
            values = primvar.Get(self.start) if primvar else None
            if values is None or len(values) != self.count:
                raise InputError(f"{self.name}: there is no primvar '{pins}' with a value for each of the {self.count} points")
            return np.asarray(np.asarray(values) >= 0.5)
        given = np.asarray(pins)
        if given.dtype == np.bool_:
            if given.shape != (self.count,):
                raise InputError(f"{self.name}: the mask of pins has the shape {given.shape} for {self.count} points")
            return given
        if given.size and not (given.dtype.kind in "iu" and given.min() >= 0 and given.max() < self.count):
            raise InputError(f"{self.name}: pins are numbers of the {self.count} points, from 0")
        mask = np.zeros(self.count, bool)
        mask[given.astype(int)] = True
        return mask

    def write(self, stage: Any, simulation: Simulation, at: float) -> None:
        """Writes the points at a time code."""
        from pxr import UsdGeom, Vt

        mesh = UsdGeom.Mesh(stage.GetPrimAtPath(self.mesh.GetPath()))
        if at == self.start:
            for stale in (mesh.GetNormalsAttr(), mesh.GetVelocitiesAttr()):
                if stale.HasAuthoredValue():
                    stale.Block()
        world = self.world(at)
        world[self.used] = simulation.positions[simulation.vertices_of_cloth(self.name)]
        inverse = np.linalg.inv(self._matrix(at))
        points = Vt.Vec3fArray.FromNumpy((world / self.unit @ inverse[:3, :3] + inverse[3, :3]).astype(np.float32))
        mesh.GetPointsAttr().Set(points, at)
        mesh.GetExtentAttr().Set(UsdGeom.PointBased.ComputeExtent(points), at)
