"""What the detector answers: arrays with an entry, or a row, for each pair."""

from dataclasses import dataclass
from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Kind(IntEnum):
    """Of what a pair is made."""

    VERTEX_FACE = 0
    """A vertex and a face."""
    EDGE_EDGE = 1
    """Two edges."""


class IntersectionKind(IntEnum):
    """Which primitives of a mesh at rest meet."""

    EDGE_FACE = 0
    """An edge passes through a face, or touches it."""
    VERTEX_FACE = 1
    """A vertex touches a face of a neighbour, folded flat onto it."""
    EDGE_EDGE = 2
    """Two edges of neighbours touch, folded flat onto each other."""


@dataclass(frozen=True, eq=False)
class ContactTimes:
    """Contacts of a step: an entry for each."""

    kind: NDArray[np.uint8]
    """(n,) a :class:`Kind`."""
    pair: NDArray[np.uint32]
    """(n, 2) the vertex and the face, or the two edges, the smaller number first."""
    time: NDArray[Any]
    """(n,) in [0, 1] of the step, in the format of the positions: never after the exact time."""
    vertices: NDArray[np.uint32]
    """(n, 4) the vertex and the corners of the face, or the ends of both edges."""

    def __len__(self) -> int:
        return len(self.kind)


@dataclass(frozen=True, eq=False)
class Contacts(ContactTimes):
    """Contacts of a step and how the two sides lie to each other at the time of contact. All in float64."""

    points: NDArray[np.float64]
    """(n, 2, 3) the nearest points of the first and the second side, in the unit of the positions."""
    weights: NDArray[np.float64]
    """(n, 4) barycentric, of each side: the points are these weights times the vertices."""
    normals: NDArray[np.float64]
    """(n, 3) from the second side to the first as it was before contact, of length one. NaN where none can be shown: the pair touches
    as the step begins, or is nearer than rounding can tell."""
    distances: NDArray[np.float64]
    """(n, 2) the distance of the two sides is in this range."""
    speeds: NDArray[np.float64]
    """(n,) how fast the first point moves away from the second along the normal, in lengths a step; negative as they approach."""
    separated_at: NDArray[np.float64]
    """(n,) when the sides were certainly apart along the normal: the time of contact, or a little before it."""


@dataclass(frozen=True)
class Contact:
    """One contact of a step."""

    kind: Kind
    """Vertex and face, or two edges."""
    pair: tuple[int, int]
    """The vertex and the face, or the two edges, the smaller number first."""
    time: float
    """In [0, 1] of the step: never after the exact time."""
    vertices: tuple[int, int, int, int]
    """The vertex and the corners of the face, or the ends of both edges."""


@dataclass(frozen=True, eq=False)
class CandidatePairs:
    """The pairs that boxes leave."""

    vertex_face: NDArray[np.uint32]
    """(n, 2) a vertex and a face."""
    edge_edge: NDArray[np.uint32]
    """(n, 2) two edges, the smaller number first."""

    def __len__(self) -> int:
        return len(self.vertex_face) + len(self.edge_edge)


@dataclass(frozen=True, eq=False)
class Intersections:
    """Where a mesh at rest meets itself."""

    kind: NDArray[np.uint8]
    """(n,) an :class:`IntersectionKind`."""
    pair: NDArray[np.uint32]
    """(n, 2) an edge and a face, a vertex and a face, or two edges."""

    def __len__(self) -> int:
        return len(self.kind)


@dataclass(frozen=True, eq=False)
class Truncation:
    """A step that was cut vertex by vertex until it is free of contact."""

    positions: NDArray[Any]
    """(vertex_count, 3) where the step ends, in the format of the positions."""
    held_back: int
    """Vertices that go less than the whole of their way."""
    in_contact: int
    """Pairs in contact at the start already; their vertices rest. With none, the step to ``positions`` is certainly free."""
    rounds: int
    """How often contacts were looked for."""


@dataclass(frozen=True, eq=False)
class NearPairs:
    """Pairs of a simulation that came near each other in the last part of its last step, as contact saw them at its start."""

    vertices: NDArray[np.uint32]
    """(n, 4) a vertex and the corners of a face, or the ends of both edges: rows of the simulation's positions."""
    weights: NDArray[np.float64]
    """(n, 4) of each vertex in the way between the nearest points: positive on the first side, where they add up to one, negative on
    the other."""
    normals: NDArray[np.float64]
    """(n, 3) from the second side to the first, of length one."""
    thickness: NDArray[np.float64]
    """(n,) how far apart the pair is to be, in metres."""

    def __len__(self) -> int:
        return len(self.vertices)


@dataclass(frozen=True, eq=False)
class Crossings:
    """Edges that meet faces, of cloth with itself or with bodies. Where neighbours lie flat on each other, an edge may be a vertex twice, and a
    face an edge with its second end twice."""

    edges: NDArray[np.uint32]
    """(n, 2) rows of the simulation's positions, those of bodies after the cloth's."""
    faces: NDArray[np.uint32]
    """(n, 3) likewise."""
    points: NDArray[np.float64]
    """(n, 3) where they meet, in metres."""
    bodies: NDArray[np.int64]
    """(n,) the body that one of them belongs to, by its index; -1 if both are cloth."""

    def __len__(self) -> int:
        return len(self.edges)


@dataclass(frozen=True)
class Untangled:
    """What was pulled apart before the first step."""

    crossings: int
    """Edges that met faces where the scene starts."""
    left: int
    """Those that still do."""
    steps: int
    """Steps that were taken, without time."""
    edge_stretch: tuple[float, float]
    """The length of edges then over that in the scene: of the 99th percentile, and of the longest."""
    farthest: float
    """How far the cloth was moved where it was moved most, in metres."""
    seconds: float
    """How long it took."""


class TornEdge(NamedTuple):
    """An edge of cloth that has torn."""

    cloth: int
    """In the order of the scene."""
    vertices: tuple[int, int]
    """Its ends, as the cloth's mesh in the scene numbers them."""
    time: float
    """When the step had ended after which it tore, in seconds."""
    load: float
    """What it was loaded with, in N for each metre of its length at rest."""


class Release(NamedTuple):
    """A vertex that an attachment has let go of, for good."""

    group: int
    """Of attachments, in the order of the scene."""
    vertex: int
    """Of the cloth."""
    time: float
    """When the step began in which it let go, in seconds."""
