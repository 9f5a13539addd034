"""Which vertex–face and edge–edge pairs of a deforming triangle mesh collide during a time step: certified, none is ever missed.

Start at :class:`Detector`: positions at the start and at the end of a step in, contacts out, as numpy arrays. :mod:`selvedge.ipc`
has the names that users of ipctk know, :class:`Simulation` cloth, :mod:`selvedge.laboratory` what accuracy costs in time.

Positions are arrays of shape (vertex_count, 3) in any unit of length. float32 and float64 in C order are used where they are, others
are copied. Times are in [0, 1] of the step. The interpreter is free for other threads while a question is answered; that nobody
writes to the positions meanwhile is up to the caller.
"""

from . import errors, ipc, laboratory
from ._answers import (
    CandidatePairs,
    Contact,
    Contacts,
    ContactTimes,
    Crossings,
    Intersections,
    IntersectionKind,
    Kind,
    NearPairs,
    Release,
    TornEdge,
    Truncation,
    Untangled,
)
from ._native import ARM_SLEEVE, EFFECTS, Detector, Simulation, __version__, time_of_impact, touches

__all__ = [
    "ARM_SLEEVE",
    "EFFECTS",
    "CandidatePairs",
    "Contact",
    "ContactTimes",
    "Contacts",
    "Crossings",
    "Detector",
    "IntersectionKind",
    "Intersections",
    "Kind",
    "NearPairs",
    "Release",
    "Simulation",
    "TornEdge",
    "Truncation",
    "Untangled",
    "__version__",
    "errors",
    "ipc",
    "laboratory",
    "time_of_impact",
    "touches",
]
