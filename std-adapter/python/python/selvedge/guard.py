"""Puts certified steps behind another simulator.

A :class:`Guard` takes the positions before and after a step of any simulator. It returns positions that are reached without a contact:
the same where the step is free, and held back where cloth would pass through itself or through a body. If it cannot certify a step, the
result says so and has no positions::

    guard = Guard(cloth_faces, len(cloth), bodies=[(table_faces, len(table))])
    before = cloth
    for _ in range(steps):
        after = simulate(before)
        step = guard.hold(before, after, bodies_before=[table])
        if not step.free:
            raise RuntimeError(step.reason)
        before = step.positions

Give the simulator the returned positions, and reduce the velocity of the vertices in ``held_back``, or it pushes again in its next step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import indices, positions
from ._native import Detector
from .errors import DataTypeError, InputError, TooManyPairsError, TooMuchMemoryError

__all__ = ["Guard", "GuardedStep"]

_Positions = NDArray[Any]

# A driven body carries cloth along in so many equal parts of its motion, and up to so many lengths of an edge from it, until an
# attempt succeeds. Where cloth is folded sharply, it must move as one as far as the fold goes; without a limit all of it follows.
# Each part costs as much as a step, so all attempts together cost at most twelve.
_ATTEMPTS = ((1, 0.0), (1, 1.0), (1, 4.0), (1, np.inf), (4, 1.0), (4, 4.0))
# So many separations are tried for a step, each a quarter of the last.
_SEPARATIONS = 4
# A held body is slowed so often before it rests.
_SLOWED = 3


@dataclass(frozen=True, eq=False)
class GuardedStep:
    """The result of :meth:`Guard.hold`."""

    positions: _Positions | None
    """(vertex_count, 3) certified positions of the cloth, in the format of the input; None if the step could not be certified."""
    bodies: list[_Positions] | None
    """The positions of each body at the end; None if the step could not be certified."""
    held_back: NDArray[np.uint32]
    """(n,) the vertices of the cloth that are not where the simulator put them."""
    distances: NDArray[np.float64]
    """(n,) how far each of them is from there."""
    reason: str | None
    """Why the step could not be certified; None if it is."""
    tangled: NDArray[np.uint32] = field(default_factory=lambda: np.zeros((0, 2), np.uint32))
    """(m, 2) pairs of faces that intersect at the start. The faces of the cloth come first, then those of each body, then the loose edges
    and the points of the cloth."""

    @property
    def free(self) -> bool:
        """True if ``positions`` are certified."""
        return self.reason is None


class _NotFree(Exception):
    """A step that cannot be certified."""

    def __init__(self, reason: str, tangled: NDArray[np.uint32] | None = None) -> None:
        super().__init__(reason)
        self.tangled = tangled


class Guard:
    """Certifies the steps of another simulator.

    ``faces`` (n, 3) are the triangles of the cloth, and ``edges`` (n, 2) and ``points`` (n,) its loose edges and points, of
    ``vertex_count`` vertices. ``bodies`` has the triangles and the number of vertices of each body. Cloth collides with itself and with
    bodies; bodies do not collide with each other.

    ``separation`` is a distance that held vertices keep, in the unit of the positions. Without it they may come as near as the
    ``tolerance`` (2^-30, or 2^-20 for float32). Pairs that start nearer than ``separation`` may stay there, but never touch.

    ``hold_bodies`` holds back bodies like cloth, each as a whole; otherwise they reach their ends. ``threads`` is 1 for the calling
    thread or 0 for one per core; results do not depend on it. ``pair_limit`` bounds the candidate pairs of a step.

    Raises InputError or DataTypeError for meshes and lengths that are invalid.
    """

    def __init__(
        self,
        faces: ArrayLike,
        vertex_count: int,
        *,
        edges: ArrayLike | None = None,
        points: ArrayLike | None = None,
        bodies: Sequence[tuple[ArrayLike, int]] = (),
        separation: float = 0.0,
        tolerance: float | None = None,
        hold_bodies: bool = False,
        threads: int = 1,
        pair_limit: int | None = None,
    ) -> None:
        self._count = vertex_count
        self._hold_bodies = hold_bodies
        self._separation, self._tolerance = float(separation), tolerance
        # A number that is too large would name a vertex of a body.
        edges = None if edges is None else _of_mesh(edges, vertex_count, "edges", 2)
        points = None if points is None else _of_mesh(points, vertex_count, "points", 1)[:, 0]
        counts = [vertex_count, *(count for _, count in bodies)]
        self._starts = np.cumsum([0, *counts])
        meshes = [_of_mesh(faces, vertex_count, "faces")]
        self._faces = meshes[0]
        meshes += [_of_mesh(own, count, f"faces of body {body}") for body, (own, count) in enumerate(bodies)]
        self._face_starts = np.cumsum([0, *map(len, meshes)])
        joined = np.concatenate([mesh + np.uint32(start) for mesh, start in zip(meshes, self._starts[:-1], strict=True)])
        total = int(self._starts[-1])
        # Bits of groups: 1 is cloth, 2 bodies.
        is_body = np.arange(total) >= vertex_count

        def detector(cloth: int, body: int, touching: bool) -> Detector:
            made = Detector(joined, total, threads, edges=edges, points=points)
            made.set_limits(0.0 if touching else separation, tolerance, touching=touching)
            made.set_collision_filter(groups=np.where(is_body[:, None], [2, body], [1, cloth]).astype(np.uint32))
            made.set_pair_limit(pair_limit)
            return made

        self._detector = detector(3, 1, False)
        self._exact = detector(3, 1, True)
        # Only for distances between cloth and bodies.
        self._between = detector(2, 1, False)
        self._certified: _Positions | None = None

    def hold(
        self,
        before: ArrayLike,
        after: ArrayLike,
        *,
        bodies_before: Sequence[ArrayLike] = (),
        bodies_after: Sequence[ArrayLike] | None = None,
    ) -> GuardedStep:
        """Returns certified positions for a step from ``before`` to ``after``.

        The result is reached from ``before`` by straight motions without a contact, so that nothing passes through anything in between
        either. A vertex ends where the simulator put it, or on the way there. Bodies end at ``bodies_after``; without it they rest. A
        body that moves into cloth carries it along first; such cloth may end beside its own path. One rigid body that turns by less than
        half a turn, or several that move as one, can be followed if no other body is in the way.

        The result is not free, and has no positions, if a coordinate is not finite, if the start intersects itself, if a body cannot
        reach its end, or if there are more pairs than the limits allow. The guard remains usable. If ``before`` and ``bodies_before``
        are the previous result, they need no check.

        Raises InputError for other shapes, and DataTypeError if bodies are float64 and the cloth is float32.
        """
        start = self._joined(before, bodies_before, "before")
        wanted = self._joined(after, bodies_before if bodies_after is None else bodies_after, "after")
        if start.dtype != wanted.dtype:
            raise DataTypeError(f"before is {start.dtype} and after is {wanted.dtype}; convert one of them")
        try:
            self._look_at_numbers(start, "before")
            self._look_at_numbers(wanted, "after")
            self._look_at_start(start)
            end = self._held(start, wanted)
        except _NotFree as error:
            nothing = np.zeros(0)
            tangled = np.zeros((0, 2), np.uint32) if error.tangled is None else error.tangled
            return GuardedStep(None, None, nothing.astype(np.uint32), nothing, str(error), tangled)
        except (TooManyPairsError, TooMuchMemoryError) as error:
            nothing = np.zeros(0)
            return GuardedStep(None, None, nothing.astype(np.uint32), nothing, f"the step is too violent to look at: {error}")
        self._certified = end.copy()
        cloth, *bodies = np.split(end, self._starts[1:-1])
        ways = cloth.astype(np.float64) - wanted[: self._count]
        held = np.flatnonzero((ways != 0.0).any(axis=1)).astype(np.uint32)
        return GuardedStep(cloth, bodies, held, _lengths(ways[held]), None)

    def _joined(self, cloth: ArrayLike, bodies: Sequence[ArrayLike], when: str) -> _Positions:
        """Returns the positions of cloth and bodies as one array, in the format of the cloth."""
        if len(bodies) != len(self._starts) - 2:
            raise InputError(f"bodies_{when}: expected {len(self._starts) - 2} bodies, not {len(bodies)}")
        names = [when, *(f"bodies_{when}[{body}]" for body in range(len(bodies)))]
        parts = [positions(part, name, True) for part, name in zip([cloth, *bodies], names, strict=True)]
        for name, part, count in zip(names, parts, np.diff(self._starts), strict=True):
            if len(part) != count:
                raise InputError(f"{name}: expected {count} vertices, not {len(part)}")
            if part.dtype.itemsize > parts[0].dtype.itemsize:
                raise DataTypeError(f"{name}: {part.dtype} would have to be rounded to the cloth's {parts[0].dtype}; convert it")
        return np.concatenate(parts).astype(parts[0].dtype, copy=False)

    def _look_at_numbers(self, joined: _Positions, when: str) -> None:
        wrong = np.flatnonzero(~np.isfinite(joined).all(axis=1))
        if len(wrong):
            raise _NotFree(f"{when}: {len(wrong)} vertices are not finite, the first is {self._vertex_name(int(wrong[0]))}")

    def _look_at_start(self, start: _Positions) -> None:
        """Checks exactly that nothing intersects at the start, unless this is known."""
        if self._certified is not None and self._certified.dtype == start.dtype and np.array_equal(self._certified, start):
            return
        if not self._exact.has_intersections(start):
            return
        # Intersections are those of all faces, so those of bodies among themselves are among them.
        pairs = self._exact.intersections(start).face_pairs
        is_body = (pairs >= self._face_starts[1]) & (pairs < self._face_starts[-1])
        pairs = pairs[~is_body.all(axis=1)]
        if len(pairs):
            first, second = (self._face_name(int(face)) for face in pairs[0])
            raise _NotFree(f"before: {len(pairs)} pairs of faces intersect at the start; the first is {first} and {second}", pairs)

    def _held(self, start: _Positions, wanted: _Positions) -> _Positions:
        end = self._truncated(start, wanted)
        if self._reach(end, wanted):
            return end
        if self._hold_bodies:
            return self._with_held_bodies(start, wanted, end)
        for parts, edges in _ATTEMPTS:
            try:
                carried = self._carried(start, wanted, parts, edges * self._edge_length(start))
            except (TooManyPairsError, TooMuchMemoryError):
                # Other attempts may look at fewer pairs.
                continue
            if carried is not None:
                return self._truncated(carried, wanted)
        raise _NotFree("after: a body moves through cloth that cannot get out of its way; move it less in a step, or pass hold_bodies")

    def _truncated(self, start: _Positions, wanted: _Positions) -> _Positions:
        """Returns the ends of a certified step. The start must be free."""
        # Pairs that start nearer than the separation would rest. A smaller one lets them leave, and keeps some of their distance.
        for shrunk in range(_SEPARATIONS):
            self._detector.set_limits(self._separation / 4.0**shrunk, self._tolerance)
            done = self._detector.truncate(start, wanted)
            if not done.in_contact:
                return done.positions
            if self._separation == 0.0:
                break
        return self._exactly_truncated(start, wanted)

    def _exactly_truncated(self, start: _Positions, wanted: _Positions) -> _Positions:
        """Returns the ends of a certified step without a separation. Pairs within the tolerance can leave each other, too."""
        done = self._exact.truncate(start, wanted)
        if done.in_contact:
            raise _NotFree(f"before: {done.in_contact} pairs are in contact")
        return done.positions

    def _reach(self, end: _Positions, wanted: _Positions) -> bool:
        """Says whether all bodies are at their ends."""
        return np.array_equal(end[self._count :], wanted[self._count :])

    def _with_held_bodies(self, start: _Positions, wanted: _Positions, end: _Positions) -> _Positions:
        """Slows each body that is held back until it reaches its end as a whole, so that it keeps its shape."""
        wanted = wanted.copy()
        for attempt in range(_SLOWED + 1):
            for first, last in zip(self._starts[1:-1], self._starts[2:], strict=True):
                ways = _lengths(wanted[first:last].astype(np.float64) - start[first:last])
                gone = _lengths(end[first:last].astype(np.float64) - start[first:last])
                if np.array_equal(end[first:last], wanted[first:last]):
                    continue
                share = 0.0 if attempt == _SLOWED else float(np.min(gone[ways > 0.0] / ways[ways > 0.0]))
                wanted[first:last] = start[first:last] + (wanted[first:last] - start[first:last]) * wanted.dtype.type(share)
            end = self._truncated(start, wanted)
            if self._reach(end, wanted):
                return end
        # Resting bodies are never held back, so only bodies that were free at first can be left: all rest.
        wanted[self._count :] = start[self._count :]
        return self._truncated(start, wanted)

    def _edge_length(self, start: _Positions) -> float:
        """Returns the mean length of the edges of the cloth, or 0 without faces."""
        if not len(self._faces):
            return 0.0
        corners = start[self._faces].astype(np.float64)
        return float(_lengths((corners - np.roll(corners, 1, axis=1)).reshape(-1, 3)).mean())

    def _carried(self, start: _Positions, wanted: _Positions, parts: int, width: float) -> _Positions | None:
        """Moves the bodies to their ends in equal parts, each with the cloth near it, or returns None if cloth is in their way."""
        here = start
        for part in range(1, parts + 1):
            there = wanted.copy() if part == parts else start + (wanted - start) * start.dtype.type(part / parts)
            there[: self._count] = self._pushed(here, there, width) if np.isfinite(width) else self._following(here, there)
            # Only true contact stops a body here: carried cloth may come nearer than the separation for a moment.
            here = self._exactly_truncated(here, there)
            if not self._reach(here, there):
                return None
        return here

    def _pushed(self, start: _Positions, bodies: _Positions, width: float) -> _Positions:
        """Returns positions of the cloth that has moved with the nearest body.

        Cloth within the longest way s of a body moves as the body does. Over twice the ``width`` from there, at least 2 s, the motion
        fades. So two points at distances d and e differ by at most |d - e| / 2 in their motion, and layers do not meet. Cloth that is
        nearer than twice the separation also moves away from the body, so that pressure does not use up its distance.
        """
        count = self._count
        motion = bodies.astype(np.float64) - start
        motion[:count] = 0.0
        way = float(_lengths(motion).max())
        apart = 2.0 * self._separation
        fade = 2.0 * max(width, way)
        reach = max(way + fade, apart)
        if not np.isfinite(reach):
            raise _NotFree("after: a body moves too far to measure its way")
        near = self._between.near(start, reach)
        pushed = start[:count].copy()
        if not len(near):
            return pushed
        pairs, corners = np.nonzero(near.vertices < count)
        order = np.lexsort((pairs, near.distances[pairs, 0]))
        moved, first = np.unique(near.vertices[pairs, corners][order], return_index=True)
        nearest = pairs[order][first]
        # Each side of a pair is cloth or body as a whole.
        touched = near.vertices[nearest]
        is_body = touched >= count
        weights = np.where(is_body, near.weights[nearest], 0.0)
        body = np.searchsorted(self._starts, touched.max(axis=1), side="right") - 1
        own = np.zeros((len(moved), 3))
        for mesh in np.unique(body):
            rows = body == mesh
            motion_at = _affine(start[self._starts[mesh] : self._starts[mesh + 1]], motion[self._starts[mesh] : self._starts[mesh + 1]])
            rest = motion[touched[rows]] - motion_at(start[touched[rows]])
            own[rows] = motion_at(start[moved[rows]]) + np.einsum("ij,ijk->ik", weights[rows], rest)
        distance = near.distances[nearest, 0]
        fading = np.clip((way + fade - distance) / fade, 0.0, 1.0)
        # Normals point to the first side.
        normals = np.where(is_body[:, :1], -1.0, 1.0) * np.nan_to_num(near.normals[nearest])
        pushed[moved] = start[moved] + fading[:, None] * own + np.maximum(apart - distance, 0.0)[:, None] * normals
        return pushed

    def _following(self, start: _Positions, bodies: _Positions) -> _Positions:
        """Returns positions of the cloth that has moved as a whole, as all bodies that move do together. Behind one rigid body, or several
        that move as one, neither cloth nor body comes nearer to anything of both."""
        moves = np.zeros(len(start), bool)
        for first, last in zip(self._starts[1:-1], self._starts[2:], strict=True):
            moves[first:last] = (bodies[first:last] != start[first:last]).any()
        followed = _affine(start[moves], bodies[moves].astype(np.float64) - start[moves])
        cloth = start[: self._count]
        return (cloth + followed(cloth)).astype(start.dtype)

    def _vertex_name(self, vertex: int) -> str:
        mesh = int(np.searchsorted(self._starts, vertex, side="right")) - 1
        return f"vertex {vertex - int(self._starts[mesh])} of " + ("the cloth" if mesh == 0 else f"body {mesh - 1}")

    def _face_name(self, face: int) -> str:
        mesh = int(np.searchsorted(self._face_starts, face, side="right")) - 1
        if mesh == len(self._face_starts) - 1:
            return f"loose edge or point {face - int(self._face_starts[mesh])} of the cloth"
        return f"face {face - int(self._face_starts[mesh])} of " + ("the cloth" if mesh == 0 else f"body {mesh - 1}")


def _lengths(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Returns the length of each row. Squares of its numbers may be too large."""
    lengths: NDArray[np.float64] = np.hypot(np.hypot(rows[:, 0], rows[:, 1]), rows[:, 2])
    return lengths


def _affine(points: _Positions, motion: NDArray[np.float64]) -> Callable[[_Positions], NDArray[np.float64]]:
    """Returns the affine motion of space that is nearest to that of these points.

    It is the motion itself for a rigid body whose points move straight, whatever it turns by. So cloth that follows it keeps its
    distance from all of the body, not only from the nearest point.
    """
    centre = points.astype(np.float64).mean(axis=0)
    mean = motion.mean(axis=0)
    gradient, *_ = np.linalg.lstsq(points - centre, motion - mean, rcond=None)
    return lambda at: (at - centre) @ gradient + mean


def _of_mesh(faces: ArrayLike, count: int, name: str, columns: int = 3) -> NDArray[np.uint32]:
    """Returns the primitives of a mesh. A number that is too large would name a vertex of the next mesh."""
    found = indices(faces, name, columns)
    if found.size and int(found.max()) >= count:
        raise InputError(f"{name}: there is no vertex {int(found.max())}; there are {count}")
    return found
