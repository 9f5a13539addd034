"""The results of the detector and the simulation: arrays with one entry or row per item."""

from dataclasses import dataclass
from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Kind(IntEnum):
    """The primitives of a pair."""

    VERTEX_FACE = 0
    """A vertex and a face."""
    EDGE_EDGE = 1
    """Two edges."""


class IntersectionKind(IntEnum):
    """The primitives of an intersection."""

    EDGE_FACE = 0
    """An edge passes through a face, or touches it."""
    VERTEX_FACE = 1
    """A vertex touches a face of a neighbour, folded flat onto it."""
    EDGE_EDGE = 2
    """Two edges of neighbours touch, folded flat onto each other."""


@dataclass(frozen=True, eq=False)
class ContactTimes:
    """The contacts of a step, without geometry."""

    kind: NDArray[np.uint8]
    """(n,) a :class:`Kind`."""
    pair: NDArray[np.uint32]
    """(n, 2) the vertex and the face, or the two edges, the smaller number first."""
    time: NDArray[Any]
    """(n,) the time in [0, 1] of the step, in the format of the positions; never after the exact time."""
    vertices: NDArray[np.uint32]
    """(n, 4) the vertex and the corners of the face, or the ends of both edges."""

    def __len__(self) -> int:
        return len(self.kind)


@dataclass(frozen=True, eq=False)
class Contacts(ContactTimes):
    """The contacts of a step with their geometry at the time of contact, in float64."""

    points: NDArray[np.float64]
    """(n, 2, 3) the closest points of the first and the second side, in the unit of the positions."""
    weights: NDArray[np.float64]
    """(n, 4) barycentric weights of each side: the points are these weights times the vertices."""
    normals: NDArray[np.float64]
    """(n, 3) unit vectors from the second side to the first, just before contact. NaN if none can be certified: the pair touches at the
    start of the step, or rounding hides its distance."""
    distances: NDArray[np.float64]
    """(n, 2) a lower and an upper bound of the distance of the two sides."""
    speeds: NDArray[np.float64]
    """(n,) the speed at which the first point moves away from the second along the normal, in lengths per step; negative if they
    approach each other."""
    separated_at: NDArray[np.float64]
    """(n,) a time at which the sides were certainly apart along the normal: that of the contact, or slightly earlier."""


@dataclass(frozen=True)
class Contact:
    """One contact of a step."""

    kind: Kind
    """The primitives of the pair."""
    pair: tuple[int, int]
    """The vertex and the face, or the two edges, the smaller number first."""
    time: float
    """The time in [0, 1] of the step; never after the exact time."""
    vertices: tuple[int, int, int, int]
    """The vertex and the corners of the face, or the ends of both edges."""


@dataclass(frozen=True, eq=False)
class CandidatePairs:
    """The pairs that bounding boxes keep."""

    vertex_face: NDArray[np.uint32]
    """(n, 2) a vertex and a face."""
    edge_edge: NDArray[np.uint32]
    """(n, 2) two edges, the smaller number first."""

    def __len__(self) -> int:
        return len(self.vertex_face) + len(self.edge_edge)


@dataclass(frozen=True, eq=False)
class Intersections:
    """The intersections of a mesh at rest with itself."""

    kind: NDArray[np.uint8]
    """(n,) an :class:`IntersectionKind`."""
    pair: NDArray[np.uint32]
    """(n, 2) an edge and a face, a vertex and a face, or two edges."""
    face_pairs: NDArray[np.uint32]
    """(m, 2) the pairs of faces that share a point of an intersection, each once, the smaller number first, in order."""
    points: NDArray[np.float64]
    """(n, 3) a point of each intersection, rounded."""

    @property
    def faces(self) -> NDArray[np.uint32]:
        """The faces that intersect others, each once, in order."""
        return np.unique(self.face_pairs)

    def __len__(self) -> int:
        return len(self.kind)


@dataclass(frozen=True, eq=False)
class Truncation:
    """A step that was truncated vertex by vertex until it is free of contact."""

    positions: NDArray[Any]
    """(vertex_count, 3) the positions at the end of the step, in the format of the positions."""
    held_back: int
    """The number of vertices that do not go their whole way."""
    in_contact: int
    """The number of pairs in contact at the start; their vertices rest. If it is 0, the step to ``positions`` is certainly free."""
    rounds: int
    """The number of searches for contacts."""


@dataclass(frozen=True, eq=False)
class MeshFile:
    """A mesh that was read from a file. Vertices have the file's numbers, positions every bit that the file holds."""

    positions: NDArray[np.float64]
    """(n, 3) in the unit of the file."""
    faces: NDArray[np.uint32]
    """(m, 3) triangles. Polygons are split by their shape."""
    edges: NDArray[np.uint32]
    """(k, 2) edges that belong to no triangle."""
    points: list[int]
    """Vertices that are particles."""
    missing: str | None
    """The parts of the file that may have an area and were not read, or None. With such parts, contacts of this mesh are not all
    contacts of the file."""
    notes: str
    """A report in one line: counts, findings, what was split, merged or left out."""


@dataclass(frozen=True, eq=False)
class MeshInFiles:
    """The state of a simulation in which cloths from files have the vertices and faces of their files: each cloth, then the bodies."""

    positions: NDArray[np.float64]
    """(n, 3) in metres. Vertices that ``weld`` merged are apart again; those that the cloth does not have stay where the file puts them.
    Copies that tears made follow those of the file."""
    faces: NDArray[np.uint32]
    """(m, 3) triangles."""
    edges: NDArray[np.uint32]
    """(k, 2) edges that belong to no triangle."""
    number_of: NDArray[np.uint32]
    """The number here of each row of the simulation's positions. Of vertices that ``weld`` merged it is the first."""


@dataclass(frozen=True, eq=False)
class Welded:
    """A mesh whose vertices in the same place are one."""

    positions: NDArray[np.float64]
    """(n, 3) each the position of the lowest-numbered vertex that was merged into it."""
    faces: NDArray[np.uint32]
    """(m, 3) without the triangles that lost their area."""
    vertex_of: NDArray[np.uint32]
    """For each vertex before, its vertex now: ``positions[vertex_of]`` has the old numbers, with seams."""


@dataclass(frozen=True, eq=False)
class NearPairs:
    """The near pairs of a simulation, at the start of the last part of its last step."""

    vertices: NDArray[np.uint32]
    """(n, 4) a vertex and the corners of a face, or the ends of both edges: rows of the simulation's positions."""
    weights: NDArray[np.float64]
    """(n, 4) the weight of each vertex in the vector between the closest points: positive on the first side, where they add up to one,
    and negative on the second."""
    normals: NDArray[np.float64]
    """(n, 3) unit vectors from the second side to the first."""
    thickness: NDArray[np.float64]
    """(n,) the distance that contact keeps between the two, in metres."""

    def __len__(self) -> int:
        return len(self.vertices)


@dataclass(frozen=True, eq=False)
class Crossings:
    """Edges that meet faces, of cloth with itself or with bodies. If neighbours are folded flat, an edge may name one vertex twice, and a
    face may be an edge whose second end is named twice."""

    edges: NDArray[np.uint32]
    """(n, 2) rows of the simulation's positions; bodies follow the cloth."""
    faces: NDArray[np.uint32]
    """(n, 3) rows of the simulation's positions."""
    points: NDArray[np.float64]
    """(n, 3) the points where they meet, in metres."""
    bodies: NDArray[np.int64]
    """(n,) the index of the body that one of them belongs to; -1 if both are cloth."""

    def __len__(self) -> int:
        return len(self.edges)


@dataclass(frozen=True)
class Untangled:
    """The result of untangling a scene before the first step."""

    crossings: int
    """The number of edges that met faces at the start."""
    left: int
    """The number of edges that still do."""
    steps: int
    """The number of untangling steps; they take no simulated time."""
    edge_stretch: tuple[float, float]
    """The length of edges afterwards, relative to the scene: the 99th percentile and the largest."""
    farthest: float
    """The largest displacement of a vertex, in metres."""
    seconds: float
    """The processing time."""


class TornEdge(NamedTuple):
    """A torn edge of cloth."""

    cloth: int
    """The index of the cloth in the scene."""
    vertices: tuple[int, int]
    """Its ends, numbered as in the cloth's mesh in the scene."""
    time: float
    """The end of the step after which it tore, in seconds."""
    load: float
    """Its load, in N per metre of its length at rest."""


class Wrench(NamedTuple):
    """A force and its torque about a point."""

    force: NDArray[np.float64]
    """(3,) the force, in N."""
    torque: NDArray[np.float64]
    """(3,) the torque, in N m."""


class BodyLoad(NamedTuple):
    """The load of cloth and ropes on a body."""

    contact: Wrench
    """The push of contacts, along their normals."""
    friction: Wrench
    """The friction of contacts."""
    pins: Wrench
    """The pull of pins that follow the body."""
    attachments: Wrench
    """The pull of attachments to the body."""

    @property
    def total(self) -> Wrench:
        """The sum."""
        return Wrench(np.sum([part.force for part in self], axis=0), np.sum([part.torque for part in self], axis=0))


class FreeBodyState(NamedTuple):
    """The mass and the motion of a free body."""

    mass: float
    """The mass, in kg, with that of cloth that is pinned to it."""
    centre: NDArray[np.float64]
    """(3,) the centre of mass, in m."""
    velocity: NDArray[np.float64]
    """(3,) the velocity of the centre of mass, in m/s."""
    spin: NDArray[np.float64]
    """(3,) the angular velocity, in rad/s."""
    angular_momentum: NDArray[np.float64]
    """(3,) the angular momentum about the centre of mass, in kg m^2/s."""


@dataclass(frozen=True, eq=False)
class ContactLoads:
    """The contacts that pushed a body."""

    vertices: NDArray[np.uint32]
    """(n, 4) the vertices of the cloth and of the body: rows of the simulation's positions. On a ball or a capsule, all four are the vertex
    of the cloth."""
    points: NDArray[np.float64]
    """(n, 3) the points of the cloth at which they act."""
    pushes: NDArray[np.float64]
    """(n, 3) the pushes on the body, in N."""
    frictions: NDArray[np.float64]
    """(n, 3) the friction on the body, in N."""

    def __len__(self) -> int:
        return len(self.vertices)


class Release(NamedTuple):
    """A vertex that an attachment has released for good."""

    group: int
    """The index of the group of attachments in the scene."""
    vertex: int
    """The vertex of the cloth."""
    time: float
    """The start of the step that released it, in seconds."""
