"""Selvedge under the names that users of ipctk know. It is not a complete replacement for ipctk.

``from selvedge import ipc as ipctk`` runs code that builds candidates, limits step sizes and looks for intersections. The differences:

* Every answer is certified: a step size is never too long, and a free step never has a contact. A step size reaches to the first
  contact and is not scaled back.
* A pair that comes within the tolerance of ``min_distance`` (a nanometre, if positions are in metres) may be reported as a
  contact.
* ``broad_phase`` and ``narrow_phase_ccd`` accept only None, since there is one of each.
* Only three dimensions are supported. Barriers, potentials, friction and derivatives of distances are missing; using them raises
  AttributeError.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._answers import CandidatePairs, Kind
from ._arrays import indices, positions
from ._native import Detector, time_of_impact
from .errors import DataTypeError, InputError

__all__ = [
    "Candidates",
    "CollisionFilter",
    "CollisionMesh",
    "EdgeEdgeCandidate",
    "FaceVertexCandidate",
    "compute_collision_free_stepsize",
    "edge_edge_ccd",
    "edges",
    "has_intersections",
    "is_step_collision_free",
    "make_connected_components_filter",
    "make_sparse_filter",
    "make_static_obstacle_filter",
    "make_vertex_patches_filter",
    "point_edge_ccd",
    "point_point_ccd",
    "point_triangle_ccd",
]

_Indices = NDArray[np.uint32]
_Flags = NDArray[np.bool_]
_Rule = Callable[[_Indices, _Indices], _Flags]


def __getattr__(name: str) -> Any:
    raise AttributeError(
        f"selvedge.ipc has no {name}. It has only collision detection ({', '.join(__all__)}); use ipctk for the rest"
    )


def _ours(**phases: object) -> None:
    for name, phase in phases.items():
        if phase is not None:
            raise NotImplementedError(f"{name}: selvedge has only its own; leave the argument out or pass None")


class CollisionFilter:
    """Says which vertices collide: from a function of two vertices, combined with ``&``, ``|`` and ``~``.

    A pair of primitives is kept if any vertex of one collides with any vertex of the other. The detector's traversal applies the filters
    of the factories below, and their ``&``, at no cost. Python functions, ``|`` and ``~`` run for each candidate pair.
    """

    def __init__(self, can_collide: Callable[[int, int], bool] | None = None) -> None:
        self._data: list[_Data] = []
        self._rules: list[_Rule] = [] if can_collide is None else [_each(can_collide)]

    def __call__(self, vi: int, vj: int) -> bool:
        """Says whether two vertices may collide."""
        return bool(self._allows(indices([vi], "vi", 1)[:, 0], indices([vj], "vj", 1)[:, 0])[0])

    def __and__(self, other: CollisionFilter) -> CollisionFilter:
        both = CollisionFilter()
        both._data = self._data + other._data
        both._rules = self._rules + other._rules
        return both

    def __or__(self, other: CollisionFilter) -> CollisionFilter:
        return _of_rule(lambda i, j: self._allows(i, j) | other._allows(i, j))

    def __invert__(self) -> CollisionFilter:
        return _of_rule(lambda i, j: ~self._allows(i, j))

    def _allows(self, i: _Indices, j: _Indices) -> _Flags:
        allowed: _Flags = np.ones(i.shape, np.bool_)
        for rule in [data.allows for data in self._data] + self._rules:
            allowed &= rule(i, j)
        return allowed


@dataclass(frozen=True)
class _Data:
    """A filter that the detector can apply."""

    patches: _Indices | None = None
    # Ascending vertices and the component of each; any other vertex is a component of its own.
    components: tuple[_Indices, _Indices] | None = None
    dynamic: int | None = None
    excluded: _Indices | None = None

    def allows(self, i: _Indices, j: _Indices) -> _Flags:
        allowed: _Flags = np.ones(i.shape, np.bool_)
        if self.patches is not None:
            allowed &= self.patches[i] != self.patches[j]
        if self.components is not None:
            allowed &= self._component(i) != self._component(j)
        if self.dynamic is not None:
            allowed &= (i < self.dynamic) | (j < self.dynamic)
        if self.excluded is not None:
            keys = np.minimum(i, j).astype(np.uint64) << np.uint64(32) | np.maximum(i, j)
            listed = self.excluded.min(1).astype(np.uint64) << np.uint64(32) | self.excluded.max(1)
            allowed &= ~np.isin(keys, listed)
        return allowed

    @property
    def has_patches(self) -> bool:
        return self.patches is not None or self.components is not None

    def patches_of(self, count: int) -> _Indices | None:
        """Returns the patch of each of ``count`` vertices, for the detector."""
        if self.components is not None:
            return self._component(np.arange(count, dtype=np.uint32))
        if self.patches is not None and len(self.patches) != count:
            raise InputError(f"the filter is for {len(self.patches)} vertices, but the mesh has {count}")
        return self.patches

    def _component(self, of: _Indices) -> _Indices:
        assert self.components is not None
        vertices, components = self.components
        # A component has the number of one of its vertices, so other vertices cannot clash with it.
        at = np.minimum(np.searchsorted(vertices, of), len(vertices) - 1)
        return np.where(vertices[at] == of, components[at], of)


def _each(can_collide: Callable[[int, int], bool]) -> _Rule:
    def rule(i: _Indices, j: _Indices) -> _Flags:
        return np.fromiter((bool(can_collide(int(a), int(b))) for a, b in zip(i, j)), np.bool_, len(i))

    return rule


def _of_rule(rule: _Rule) -> CollisionFilter:
    made = CollisionFilter()
    made._rules = [rule]
    return made


def _of_data(data: _Data) -> CollisionFilter:
    made = CollisionFilter()
    made._data = [data]
    return made


def make_sparse_filter(explicit_values: Mapping[tuple[int, int], bool], default_value: bool) -> CollisionFilter:
    """Lists pairs of vertices, in either order, that collide or do not; the default is for all other pairs."""
    listed = [pair for pair, collides in explicit_values.items() if bool(collides) != bool(default_value)]
    pairs = indices(np.array(listed, np.int64).reshape(-1, 2), "explicit_values", 2)
    unlike_default = _of_data(_Data(excluded=pairs))
    return unlike_default if default_value else ~unlike_default


def make_static_obstacle_filter(n_dynamic: int) -> CollisionFilter:
    """Makes all vertices from ``n_dynamic`` on static: two static vertices do not collide."""
    if n_dynamic < 0:
        raise InputError(f"n_dynamic is {n_dynamic}: it must not be negative")
    return _of_data(_Data(dynamic=n_dynamic))


def make_vertex_patches_filter(patch_ids: ArrayLike) -> CollisionFilter:
    """Excludes pairs of vertices in the same patch. ``patch_ids`` has an entry per vertex."""
    _, patches = np.unique(np.asarray(patch_ids), return_inverse=True)
    return _of_data(_Data(patches=indices(patches.reshape(-1), "patch_ids", 1)[:, 0]))


def make_connected_components_filter(faces: ArrayLike) -> CollisionFilter:
    """Excludes pairs of vertices in the same connected component."""
    vertices, corners = np.unique(indices(faces, "faces", 3), return_inverse=True)
    components = Detector(corners.reshape(-1, 3), len(vertices)).components
    return _of_data(_Data(components=(vertices, vertices[components])))


class CollisionMesh:
    """A mesh of faces and edges with its positions at rest. Edges without a face collide too.

    Edges keep the numbers that they have here. It pickles, unless its filter contains Python functions.
    """

    def __init__(
        self,
        rest_positions: ArrayLike,
        edges: ArrayLike | None = None,
        faces: ArrayLike | None = None,
        *,
        threads: int = 1,
    ) -> None:
        rest = np.asarray(rest_positions)
        if rest.ndim == 2 and rest.shape[1] == 2:
            raise InputError("rest_positions: two dimensions are not supported; append a column of zeros")
        self._rest = positions(rest, "rest_positions", False).copy()
        own_faces = indices([] if faces is None else faces, "faces", 3)
        own_edges = indices([] if edges is None else edges, "edges", 2)
        of_faces = Detector(own_faces, len(self._rest), threads) if len(own_faces) else None
        # If there are as many edges as the faces have, they are expected to be the same; `_numbers` checks that.
        if of_faces is not None and len(own_edges) in (0, len(of_faces.edges)):
            self._detector = of_faces
        else:
            loose = own_edges if of_faces is None else own_edges[~np.isin(_keys(own_edges), _keys(of_faces.edges))]
            self._detector = Detector(own_faces, len(self._rest), threads, edges=loose)
        self._face_count = len(own_faces)
        numbered = self._detector.edges
        if edges is None:
            self._edges, self._numbers = numbered, np.arange(len(numbered), dtype=np.uint32)
        else:
            self._edges, self._numbers = own_edges, _numbers(numbered, own_edges)
        self._can_collide = CollisionFilter()

    @property
    def rest_positions(self) -> NDArray[np.float64]:
        return self._rest

    @property
    def edges(self) -> _Indices:
        return self._edges

    @property
    def faces(self) -> _Indices:
        return self._detector.faces[: self._face_count]

    @property
    def num_vertices(self) -> int:
        return len(self._rest)

    @property
    def num_edges(self) -> int:
        return len(self._edges)

    @property
    def num_faces(self) -> int:
        return self._face_count

    @property
    def dim(self) -> int:
        return 3

    @property
    def can_collide(self) -> CollisionFilter:
        """The collision filter; by default all vertices collide."""
        return self._can_collide

    @can_collide.setter
    def can_collide(self, value: CollisionFilter | Callable[[int, int], bool]) -> None:
        given = value if isinstance(value, CollisionFilter) else CollisionFilter(value)
        groups, patches, excluded = None, None, []
        for data in given._data:
            if data.dynamic is not None:
                is_static = np.arange(self.num_vertices) >= data.dynamic
                both = groups if groups is not None else np.full((self.num_vertices, 2), 3, np.uint32)
                # Static vertices are only in group 2 and collide only with group 1.
                both[is_static] = (2, 1)
                groups = both
            # The traversal has one list of patches; further lists are applied to each candidate.
            of_data = data.patches_of(self.num_vertices)
            patches = of_data if patches is None else patches
            if data.excluded is not None:
                excluded.append(data.excluded)
        listed = np.concatenate(excluded) if excluded else None
        self._detector.set_collision_filter(groups=groups, patches=patches, excluded=listed)
        self._can_collide = given

    def _has_rules(self) -> bool:
        given = self._can_collide
        return bool(given._rules) or sum(data.has_patches for data in given._data) > 1

    def _allowed(self, pairs: CandidatePairs) -> CandidatePairs:
        """Returns the pairs that the Python rules keep."""
        if not self._has_rules():
            return pairs
        faces, ends = self._detector.faces, self._detector.edges
        vertex_face = _any_allows(self._can_collide, pairs.vertex_face[:, :1], faces[pairs.vertex_face[:, 1]])
        edge_edge = _any_allows(self._can_collide, ends[pairs.edge_edge[:, 0]], ends[pairs.edge_edge[:, 1]])
        return CandidatePairs(pairs.vertex_face[vertex_face], pairs.edge_edge[edge_edge])


def _any_allows(given: CollisionFilter, ones: _Indices, others: _Indices) -> _Flags:
    allowed: _Flags = np.zeros(len(ones), np.bool_)
    for one in ones.T:
        for other in others.T:
            allowed |= given._allows(one, other)
    return allowed


def _keys(pairs: _Indices) -> NDArray[np.uint64]:
    first, second = pairs[:, 0], pairs[:, 1]
    keys: NDArray[np.uint64] = np.minimum(first, second).astype(np.uint64) << np.uint64(32) | np.maximum(first, second)
    return keys


def _numbers(ours: _Indices, theirs: _Indices) -> _Indices:
    """Returns the caller's number of each of our edges."""
    keys, wanted = _keys(theirs), _keys(ours)
    if np.array_equal(keys, wanted):
        return np.arange(len(ours), dtype=np.uint32)
    order = np.argsort(keys, kind="stable")
    at = np.searchsorted(keys, wanted, sorter=order)
    found = order[np.minimum(at, len(order) - 1)] if len(order) else np.zeros(0, np.intp)
    if len(found) != len(ours) or np.any(keys[found] != wanted):
        raise InputError("edges: an edge of the faces is missing; leave edges out, or create them with ipc.edges(faces)")
    return found.astype(np.uint32)


def edges(faces: ArrayLike) -> _Indices:
    """Returns the edges of the faces, each once."""
    return _edges_of(indices(faces, "faces", 3))


def _edges_of(faces: _Indices) -> _Indices:
    if not len(faces):
        return np.zeros((0, 2), np.uint32)
    # Renumbered, so that there are no more vertices than corners.
    vertices, corners = np.unique(faces, return_inverse=True)
    return vertices[Detector(corners.reshape(-1, 3), len(vertices)).edges]


_T = TypeVar("_T")


def _with_limits(mesh: CollisionMesh, separation: float, action: Callable[[Detector], _T]) -> _T:
    if not isinstance(mesh, CollisionMesh):
        raise DataTypeError(f"mesh: expected a CollisionMesh, not {type(mesh).__name__}")
    mesh._detector.set_limits(separation)
    return action(mesh._detector)


def _step_size(mesh: CollisionMesh, start: ArrayLike, end: ArrayLike, min_distance: float) -> float | None:
    """Returns the time of the first contact, or None."""
    if mesh._has_rules():
        candidates = Candidates()
        candidates.build(mesh, start, end, min_distance / 2.0)
        return candidates._step_size(mesh, start, end, min_distance)
    earliest = _with_limits(mesh, min_distance, lambda detector: detector.earliest(start, end))
    return None if earliest is None else earliest.time


def is_step_collision_free(
    mesh: CollisionMesh,
    vertices_t0: ArrayLike,
    vertices_t1: ArrayLike,
    min_distance: float = 0.0,
    broad_phase: None = None,
    narrow_phase_ccd: None = None,
) -> bool:
    """Decides whether the step is certainly free of contact."""
    _ours(broad_phase=broad_phase, narrow_phase_ccd=narrow_phase_ccd)
    if isinstance(mesh, CollisionMesh) and mesh._has_rules():
        return _step_size(mesh, vertices_t0, vertices_t1, min_distance) is None
    return _with_limits(mesh, min_distance, lambda detector: detector.is_free(vertices_t0, vertices_t1))


def compute_collision_free_stepsize(
    mesh: CollisionMesh,
    vertices_t0: ArrayLike,
    vertices_t1: ArrayLike,
    min_distance: float = 0.0,
    broad_phase: None = None,
    narrow_phase_ccd: None = None,
) -> float:
    """Returns a step size in [0, 1]; any shorter step is certainly free of contact."""
    _ours(broad_phase=broad_phase, narrow_phase_ccd=narrow_phase_ccd)
    size = _step_size(mesh, vertices_t0, vertices_t1, min_distance)
    return 1.0 if size is None else size


def has_intersections(mesh: CollisionMesh, vertices: ArrayLike, broad_phase: None = None) -> bool:
    """Decides exactly whether a mesh at rest intersects itself, touching included. The filter is not applied."""
    _ours(broad_phase=broad_phase)
    return _with_limits(mesh, 0.0, lambda detector: detector.has_intersections(vertices))


class _Stencil:
    """A pair of a mesh."""

    _kind: ClassVar[Kind]

    def _ids(self, edges: ArrayLike, faces: ArrayLike) -> _Indices:
        raise NotImplementedError

    def vertex_ids(self, edges: ArrayLike, faces: ArrayLike) -> list[int]:
        """The four vertices."""
        return [int(vertex) for vertex in self._ids(edges, faces)]

    def ccd(
        self,
        vertices_t0: ArrayLike,
        vertices_t1: ArrayLike,
        edges: ArrayLike,
        faces: ArrayLike,
        min_distance: float = 0.0,
        tmax: float = 1.0,
        narrow_phase_ccd: None = None,
    ) -> tuple[bool, float]:
        """Returns whether the pair comes into contact, and when."""
        _ours(narrow_phase_ccd=narrow_phase_ccd)
        ids = self._ids(edges, faces)
        start, end = np.asarray(vertices_t0)[ids], np.asarray(vertices_t1)[ids]
        return _found(time_of_impact(self._kind, start, end, separation=min_distance, until=tmax))


@dataclass(frozen=True)
class EdgeEdgeCandidate(_Stencil):
    """Two edges, with the numbers of the mesh."""

    edge0_id: int
    edge1_id: int
    _kind: ClassVar[Kind] = Kind.EDGE_EDGE

    def _ids(self, edges: ArrayLike, faces: ArrayLike) -> _Indices:
        return indices(edges, "edges", 2)[[self.edge0_id, self.edge1_id]].reshape(4)


@dataclass(frozen=True)
class FaceVertexCandidate(_Stencil):
    """A face and a vertex, with the numbers of the mesh."""

    face_id: int
    vertex_id: int
    _kind: ClassVar[Kind] = Kind.VERTEX_FACE

    def _ids(self, edges: ArrayLike, faces: ArrayLike) -> _Indices:
        return np.concatenate([np.array([self.vertex_id], np.uint32), indices(faces, "faces", 3)[self.face_id]])


class Candidates:
    """The pairs whose swept boxes overlap, as in ipctk."""

    def __init__(self) -> None:
        self.clear()

    def build(
        self,
        mesh: CollisionMesh,
        vertices_t0: ArrayLike,
        vertices_t1: ArrayLike | float | None = None,
        inflation_radius: float = 0.0,
        broad_phase: None = None,
    ) -> None:
        """Finds the candidates of a step, or of a mesh at rest without ``vertices_t1``. ``inflation_radius`` enlarges the boxes on all
        sides."""
        _ours(broad_phase=broad_phase)
        end: ArrayLike = vertices_t0
        if isinstance(vertices_t1, (int, float)):
            # The other signature in ipctk: a mesh at rest and the radius.
            inflation_radius = vertices_t1
        elif vertices_t1 is not None:
            end = vertices_t1
        find = _with_limits(mesh, 2.0 * inflation_radius, lambda detector: detector.candidates(vertices_t0, end, swept=True))
        self._pairs, self._numbers = mesh._allowed(find), mesh._numbers

    def clear(self) -> None:
        """Removes all candidates."""
        none = np.zeros((0, 2), np.uint32)
        self._pairs, self._numbers = CandidatePairs(none, none), np.zeros(0, np.uint32)

    def empty(self) -> bool:
        """Says whether there are no candidates."""
        return not len(self)

    def __len__(self) -> int:
        return len(self._pairs)

    def __getitem__(self, index: int) -> EdgeEdgeCandidate | FaceVertexCandidate:
        edge_edge = len(self._pairs.edge_edge)
        if not -len(self) <= index < len(self):
            raise IndexError(f"there are {len(self)} candidates; index {index} is out of range")
        index %= len(self)
        if index < edge_edge:
            return EdgeEdgeCandidate(*self._numbers[self._pairs.edge_edge[index]].tolist())
        vertex, face = self._pairs.vertex_face[index - edge_edge].tolist()
        return FaceVertexCandidate(face, vertex)

    def __iter__(self) -> Iterator[EdgeEdgeCandidate | FaceVertexCandidate]:
        yield from (EdgeEdgeCandidate(*pair) for pair in self.ee_candidates.tolist())
        yield from (FaceVertexCandidate(*pair) for pair in self.fv_candidates.tolist())

    @property
    def ee_candidates(self) -> _Indices:
        """(n, 2) pairs of edges."""
        return self._numbers[self._pairs.edge_edge]

    @property
    def fv_candidates(self) -> _Indices:
        """(n, 2) pairs of a face and a vertex. Face numbers from the mesh's number of faces on are loose edges."""
        return self._pairs.vertex_face[:, ::-1]

    def _step_size(self, mesh: CollisionMesh, start: ArrayLike, end: ArrayLike, min_distance: float) -> float | None:
        pairs = self._pairs
        found = _with_limits(
            mesh,
            min_distance,
            lambda detector: detector.contacts_of(start, end, pairs.vertex_face, pairs.edge_edge, geometry=False),
        )
        return float(found.time.min()) if len(found) else None

    def is_step_collision_free(
        self,
        mesh: CollisionMesh,
        vertices_t0: ArrayLike,
        vertices_t1: ArrayLike,
        min_distance: float = 0.0,
        narrow_phase_ccd: None = None,
    ) -> bool:
        """Decides whether these pairs are certainly free of contact during the step."""
        _ours(narrow_phase_ccd=narrow_phase_ccd)
        return self._step_size(mesh, vertices_t0, vertices_t1, min_distance) is None

    def compute_collision_free_stepsize(
        self,
        mesh: CollisionMesh,
        vertices_t0: ArrayLike,
        vertices_t1: ArrayLike,
        min_distance: float = 0.0,
        narrow_phase_ccd: None = None,
    ) -> float:
        """Returns a step size in [0, 1]; these pairs are certainly free of contact in any shorter step."""
        _ours(narrow_phase_ccd=narrow_phase_ccd)
        size = self._step_size(mesh, vertices_t0, vertices_t1, min_distance)
        return 1.0 if size is None else size


def _found(time: float | None) -> tuple[bool, float]:
    # As in ipctk, the time is infinite without a contact.
    return (False, float("inf")) if time is None else (True, time)


def _points(*given: ArrayLike) -> NDArray[Any]:
    return np.stack([np.asarray(point).reshape(-1) for point in given])


def point_triangle_ccd(
    p_t0: ArrayLike, t0_t0: ArrayLike, t1_t0: ArrayLike, t2_t0: ArrayLike,
    p_t1: ArrayLike, t0_t1: ArrayLike, t1_t1: ArrayLike, t2_t1: ArrayLike,
    min_distance: float = 0.0, tmax: float = 1.0,
) -> tuple[bool, float]:  # fmt: skip
    """Returns whether a point and a triangle come into contact, and when."""
    start, end = _points(p_t0, t0_t0, t1_t0, t2_t0), _points(p_t1, t0_t1, t1_t1, t2_t1)
    return _found(time_of_impact(Kind.VERTEX_FACE, start, end, separation=min_distance, until=tmax))


def edge_edge_ccd(
    ea0_t0: ArrayLike, ea1_t0: ArrayLike, eb0_t0: ArrayLike, eb1_t0: ArrayLike,
    ea0_t1: ArrayLike, ea1_t1: ArrayLike, eb0_t1: ArrayLike, eb1_t1: ArrayLike,
    min_distance: float = 0.0, tmax: float = 1.0,
) -> tuple[bool, float]:  # fmt: skip
    """Returns whether two edges come into contact, and when."""
    start, end = _points(ea0_t0, ea1_t0, eb0_t0, eb1_t0), _points(ea0_t1, ea1_t1, eb0_t1, eb1_t1)
    return _found(time_of_impact(Kind.EDGE_EDGE, start, end, separation=min_distance, until=tmax))


def point_edge_ccd(
    p_t0: ArrayLike, e0_t0: ArrayLike, e1_t0: ArrayLike,
    p_t1: ArrayLike, e0_t1: ArrayLike, e1_t1: ArrayLike,
    min_distance: float = 0.0, tmax: float = 1.0,
) -> tuple[bool, float]:  # fmt: skip
    """Returns whether a point and an edge come into contact, and when. The edge is treated as a triangle without area."""
    return point_triangle_ccd(p_t0, e0_t0, e1_t0, e1_t0, p_t1, e0_t1, e1_t1, e1_t1, min_distance, tmax)


def point_point_ccd(
    p0_t0: ArrayLike, p1_t0: ArrayLike, p0_t1: ArrayLike, p1_t1: ArrayLike,
    min_distance: float = 0.0, tmax: float = 1.0,
) -> tuple[bool, float]:  # fmt: skip
    """Returns whether two points come into contact, and when."""
    return point_edge_ccd(p0_t0, p1_t0, p1_t0, p0_t1, p1_t1, p1_t1, min_distance, tmax)
