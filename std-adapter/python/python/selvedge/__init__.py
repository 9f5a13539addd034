"""Finds every contact of a deforming triangle mesh during a time step, and never misses one.

Start with :class:`Detector`. It takes the positions at the start and at the end of a step and returns the contacts as numpy arrays.
:mod:`selvedge.ipc` offers the names that users of ipctk know. :class:`Simulation` simulates cloth. :mod:`selvedge.laboratory` measures
what accuracy costs in time. :mod:`selvedge.guard` certifies the steps of other simulators.

Positions are arrays of shape (vertex_count, 3) in any unit of length. float32 and float64 arrays in C order are not copied; others are.
Times are in [0, 1] of the step. Calls release the interpreter lock. Do not write to the positions during a call.
"""

from . import errors, guard, ipc, laboratory
from ._answers import (
    BodyLoad,
    CandidatePairs,
    Contact,
    ContactLoads,
    Contacts,
    ContactTimes,
    Crossings,
    FreeBodyState,
    Intersections,
    IntersectionKind,
    Kind,
    MeshFile,
    MeshInFiles,
    NearPairs,
    Release,
    TornEdge,
    Truncation,
    Untangled,
    Welded,
    Wrench,
)
from ._sewing import seam_rows
from ._native import ARM_SLEEVE, EFFECTS, Detector, Simulation, __version__, read_mesh, time_of_impact, touches, welded

__all__ = [
    "ARM_SLEEVE",
    "EFFECTS",
    "BodyLoad",
    "CandidatePairs",
    "Contact",
    "ContactLoads",
    "ContactTimes",
    "Contacts",
    "Crossings",
    "Detector",
    "FreeBodyState",
    "IntersectionKind",
    "Intersections",
    "Kind",
    "MeshFile",
    "MeshInFiles",
    "NearPairs",
    "Release",
    "Simulation",
    "TornEdge",
    "Truncation",
    "Untangled",
    "Welded",
    "Wrench",
    "__version__",
    "errors",
    "guard",
    "ipc",
    "laboratory",
    "read_mesh",
    "seam_rows",
    "time_of_impact",
    "touches",
    "welded",
]
