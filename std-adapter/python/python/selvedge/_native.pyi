"""The native module. Positions are anything that numpy converts to an array of shape (vertex_count, 3). float32 and float64 arrays in C
order are not copied; others are. Whole numbers and mixed formats become float64."""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Literal, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

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

__all__ = ["ARM_SLEEVE", "EFFECTS", "Detector", "Simulation", "__version__", "read_mesh", "time_of_impact", "touches", "welded"]

ARM_SLEEVE: str
"""The scene of a sleeve on a bending arm, for :meth:`Simulation.from_text`."""
EFFECTS: list[str]
"""Every effect that a scene may name."""
__version__: str

def read_mesh(path: str | PathLike[str], *, only: str | None = None, weld: float | None = None) -> MeshFile:
    """Reads a mesh file: OBJ, PLY, STL or OFF, by its extension.

    ``only`` is a group or object of an OBJ file. ``weld`` merges vertices at most so far apart, 0 those in the same place; all keep their
    numbers. Check ``missing`` before you trust an answer about the file.

    Raises InputError, with the file and the line or element, for a file that cannot be read.
    """

def welded(positions: ArrayLike, faces: ArrayLike, tolerance: float = 0.0) -> Welded:
    """Merges vertices that are at most ``tolerance`` apart, such as the split seams of a garment.

    Raises InputError for a face with a vertex that does not exist, and for a negative tolerance.
    """

def time_of_impact(
    kind: int,
    start: ArrayLike,
    end: ArrayLike,
    *,
    separation: float = 0.0,
    tolerance: float | None = None,
    until: float = 1.0,
) -> float | None:
    """Returns the time in [0, 1] at which a pair comes into contact, or None if it certainly does not, up to ``until``.

    ``start`` and ``end`` have shape (4, 3): a vertex and the corners of a face, or the ends of two edges (``kind`` is a
    :class:`Kind`). The time is never after the exact one. Before it the two are certainly farther apart than ``separation``. A pair
    that only comes within ``separation + tolerance`` may be reported too. Lengths are in the unit of the positions.

    Raises InputError for another shape, coordinates that are not finite, and lengths that are negative or not finite.
    """

def touches(kind: int, start: ArrayLike, end: ArrayLike) -> bool:
    """Decides exactly whether a pair touches during the step, for all finite numbers."""

@final
class Detector:
    """A collision detector for one mesh.

    One thread at a time may use it; a call from a second thread raises BusyError. It pickles with its settings. After ``fork`` a
    detector with threads of its own raises ForkedError in the child; one without them works.
    """

    def __new__(
        cls,
        faces: ArrayLike,
        vertex_count: int,
        threads: int = 1,
        *,
        edges: ArrayLike | None = None,
        points: ArrayLike | None = None,
    ) -> Detector:
        """Creates a detector. ``faces`` has shape (n, 3) and names vertices from 0. ``edges`` (n, 2) and ``points`` (n,) are the loose
        edges and points of ropes, hair and particles; they become faces (a, b, b) and (p, p, p) after the others. ``threads`` is 1 for
        the calling thread or 0 for one per core. Answers do not depend on it."""

    @overload
    def contacts(self, start: ArrayLike, end: ArrayLike, *, geometry: Literal[True] = True) -> Contacts:
        """Finds all contacts of the step with their geometry, or only their times without ``geometry``.

        Raises InputError for frames of another length and coordinates that are not finite, BusyError, ForkedError, CancelledError and
        TooManyPairsError. Ctrl-C interrupts it and leaves the detector usable."""

    @overload
    def contacts(self, start: ArrayLike, end: ArrayLike, *, geometry: Literal[False]) -> ContactTimes: ...
    @overload
    def contacts(self, start: ArrayLike, end: ArrayLike, *, geometry: bool) -> ContactTimes: ...
    @overload
    def contacts_of(
        self, start: ArrayLike, end: ArrayLike, vertex_face: ArrayLike, edge_edge: ArrayLike, *, geometry: Literal[True] = True
    ) -> Contacts:
        """Finds the contacts among the given pairs, of shape (n, 2) each, in their order. See :meth:`contacts`."""

    @overload
    def contacts_of(
        self, start: ArrayLike, end: ArrayLike, vertex_face: ArrayLike, edge_edge: ArrayLike, *, geometry: Literal[False]
    ) -> ContactTimes: ...
    @overload
    def contacts_of(
        self, start: ArrayLike, end: ArrayLike, vertex_face: ArrayLike, edge_edge: ArrayLike, *, geometry: bool
    ) -> ContactTimes: ...
    def earliest(self, start: ArrayLike, end: ArrayLike) -> Contact | None:
        """Finds the earliest contact of the step. The step is certainly free of contact before its time; None if all of it is."""

    def is_free(self, start: ArrayLike, end: ArrayLike) -> bool:
        """Decides whether the step is certainly free of contact. The search ends at the first contact."""

    def candidates(self, start: ArrayLike, end: ArrayLike, *, swept: bool = False) -> CandidatePairs:
        """Finds the pairs that bounding boxes keep. All others certainly stay farther apart than the separation throughout the step. The
        boxes move with the primitives; ``swept`` uses the boxes that primitives sweep, which keep more pairs."""

    def intersections(self, positions: ArrayLike) -> Intersections:
        """Finds all intersections of a mesh at rest, exactly, touching included, with the pairs of faces that share a point and with the
        points. The result is empty exactly if no two faces share a point besides the vertices and edges that they have in common."""

    def has_intersections(self, positions: ArrayLike) -> bool:
        """Decides whether there is any intersection. The search ends at the first."""

    def near(self, positions: ArrayLike, distance: float) -> Contacts:
        """Finds all pairs of a mesh at rest within ``distance`` of each other, with their closest points; times are 0. None is missed. A
        pair that is farther apart by up to 2^-19 of the distance may be included."""

    def truncate(self, start: ArrayLike, wanted: ArrayLike) -> Truncation:
        """Moves each vertex as far as its neighbourhood allows, so that the step is certainly free of contact."""

    def cancel(self) -> None:
        """Cancels the call of another thread, where it raises CancelledError. Without such a call nothing happens."""

    def set_threads(self, threads: int) -> None:
        """Sets the number of threads: 1 is the calling thread, 0 one for each core."""

    def set_limits(self, separation: float = 0.0, tolerance: float | None = None, *, touching: bool = False) -> None:
        """Sets the minimum separation. Pairs that may come within it are contacts; a pair that only comes within ``separation +
        tolerance`` may be among them. The default tolerance is 2^-30 for float64 and 2^-20 for float32. With ``touching``, only pairs
        that truly touch are contacts, decided exactly. Lengths are in the unit of the positions; for float32 they are rounded up."""

    def set_moving(self, moving: ArrayLike | None = None) -> None:
        """Names the moving vertices by one bool each. None, the default: all vertices move. Pairs without a moving vertex are skipped. The
        next step sets the positions of resting vertices; they are not read again until the next call of this function."""

    def set_collision_filter(
        self,
        *,
        groups: ArrayLike | None = None,
        patches: ArrayLike | None = None,
        excluded: ArrayLike | None = None,
    ) -> None:
        """Sets the collision filter; it replaces the previous one.

        ``groups`` (vertex_count, 2): bits of the groups of a vertex, and of the groups it collides with; two vertices collide if each is
        in a group that the other collides with. ``patches`` (vertex_count,): vertices of the same patch do not collide. ``excluded``
        (n, 2): pairs of vertices that do not collide. A pair of primitives is kept if any vertex of one collides with any vertex of the
        other."""

    def set_coherent(self, coherent: bool) -> None:
        """Sets whether each step starts where the last one ended. Such steps are faster; the contacts are the same."""

    def set_pair_limit(self, limit: int | None = None) -> None:
        """Limits the number of candidate pairs of a call; more raise TooManyPairsError. None, the default, is no limit."""

    def set_memory_limit(self, limit: int | None = 2147483648) -> None:
        """Set the most memory that the pairs and contacts of a question may take, in bytes, at 48 bytes for a contact. A question that needs
        more raises TooMuchMemoryError. None: no limit."""

    @property
    def vertex_count(self) -> int:
        """The number of vertices."""
    @property
    def faces(self) -> NDArray[np.uint32]:
        """(n, 3), a copy."""
    @property
    def edges(self) -> NDArray[np.uint32]:
        """(n, 2), in the order of their numbers, the smaller vertex first; a copy."""
    @property
    def components(self) -> NDArray[np.uint32]:
        """(vertex_count,) the connected component of each vertex. As ``patches``, they let only different components collide."""
    @property
    def threads(self) -> int:
        """The number of threads that was set."""

@final
class Simulation:
    """A simulation of cloth. Each state is certified free of intersections, with the same bits on any number of threads.

    ``scene`` is the path of a scene file (TOML); std-adapter/cloth/scenes/README.md describes the format. ``threads`` is 1 for the
    calling thread or 0 for one per core. A scene that starts with surfaces that pass through each other raises TangledError, unless its
    ``tangled_start`` allows it. The scene needs no ``duration``.

    One thread at a time may run steps; a call from a second thread raises BusyError. Names, vertex ranges, counts, :attr:`time`,
    :attr:`steps_done` and :attr:`progress` may be read meanwhile, and :meth:`cancel` may be called. The logger ``selvedge`` warns of
    :attr:`remarks`, and reports set-up (INFO) and each frame (DEBUG)."""

    def __new__(cls, scene: str | PathLike[str], threads: int = 1) -> Simulation: ...
    @classmethod
    def from_text(cls, text: str, threads: int = 1, *, path: str | PathLike[str] | None = None) -> Simulation:
        """Creates a simulation from the text of a scene. Messages name ``path``, and files in the scene are relative to its folder."""

    @classmethod
    def from_dict(cls, scene: Mapping[str, Any], threads: int = 1, *, folder: str | PathLike[str] | None = None) -> Simulation:
        """Creates a simulation from a scene in Python: dicts for the tables of a file, lists or arrays for its lists.

        A cloth or a body may be a mesh of arrays instead of a ``shape``: ``positions`` (n, 3) in metres and ``faces`` (m, 3). The keys
        ``unit``, ``scale``, ``rotation``, ``translation`` and ``weld`` apply as to files. A cloth may also have ``edges`` (k, 2), its loose
        edges, and ``rest_positions`` (n, 3), its shape at rest if it starts in another one. Each of its vertices must be in a face or an
        edge, so that numbers never change. A body that deforms has ``frames`` (f, n, 3) with ``frames_per_second`` instead of
        ``positions``. A body with a ``mass``, or a ``density`` if its mesh is closed, moves freely, from a ``velocity`` and a ``spin``.
        ``vertices`` may be a mask of bool. ``body_contact`` is left out of a scene without bodies.

        Messages name the path of the field, such as ``effects.friction.coefficient``. Files are relative to ``folder``."""

    def step(self, count: int = 1) -> None:
        """Runs ``count`` steps. Ctrl-C and :meth:`cancel` stop after a whole step, and the steps that were done remain. Raises BlockedError
        if bodies or pins force the cloth where it cannot go and the scene stops then, and CancelledError."""

    def advance(self, seconds: float | None = None, *, most: int = 64) -> tuple[int, int]:
        """Runs a frame: ``seconds`` pass (from 1e-6 to 1; the scene's frame if left out), in as many steps as the cloth needs, at least one
        and at most ``most``. Returns the number of steps, and the number that the cloth needs; if that is larger, edges may be longer than
        their limit. Bodies and pins that were moved do so evenly throughout; a frame that is stopped leaves them on their way. Raises as
        :meth:`step`."""

    def cancel(self) -> None:
        """Cancels the call of another thread that runs steps: it raises CancelledError after the present step. Without such a call nothing
        happens."""

    @property
    def progress(self) -> tuple[int, int]:
        """The number of steps that the present call of :meth:`step` or :meth:`advance` has done, and the number that it takes. After a
        call they are those of the last one."""

    @property
    def positions(self) -> NDArray[np.float64]:
        """(n, 3) the current positions in metres: the vertices of the cloths, then of the bodies. It is always the same read-only array;
        copy it to keep it. Tearing adds vertices and so creates a new array and new :attr:`faces`."""
    @property
    def velocities(self) -> NDArray[np.float64]:
        """(n, 3) the velocities of :attr:`positions` in m/s; a copy."""
    @property
    def normals(self) -> NDArray[np.float64]:
        """(n, 3) the unit normal at each vertex, averaged over its faces; zero for a vertex without a face."""
    @property
    def near_pairs(self) -> NearPairs:
        """The near pairs of the last part of the last step; none without a contact effect. A copy."""
    @property
    def crossings(self) -> Crossings:
        """The places where cloth still passes through itself or a body, if the scene tolerates a tangled start. A copy."""
    @property
    def tolerated_pairs(self) -> int:
        """The number of pairs without a guarantee: those at :attr:`crossings`, and those that are not apart yet."""
    @property
    def untangled(self) -> Untangled | None:
        """The result of untangling before the first step, if there was any."""
    @property
    def released(self) -> list[Release]:
        """The vertices that attachments have released so far, attachment by attachment."""
    @property
    def torn_edges(self) -> list[TornEdge]:
        """The edges that have torn so far, in order of time."""
    @property
    def body_names(self) -> list[str]:
        """The names of the bodies, in the order of the scene."""
    def body_vertices(self, body: str | int) -> slice:
        """The slice of :attr:`positions` that belongs to a body, given by its name or index."""

    @property
    def cloth_names(self) -> list[str]:
        """The names of the cloths, in the order of the scene."""
    def vertices_of_cloth(self, cloth: str | int) -> slice:
        """The slice of :attr:`positions` that belongs to a cloth, given by its name or index. A file's isolated vertices are not in it, and
        :attr:`remarks` name their number; :meth:`positions_of_cloth` has them."""

    def positions_of_cloth(self, cloth: str | int) -> NDArray[np.float64]:
        """(n, 3) the positions of a cloth with the vertices of its file or arrays, in their numbers; a copy. Vertices that ``weld`` merged
        are apart again, isolated ones stay where they were, and copies that tears made follow at the end."""

    def place_body(
        self,
        body: str | int,
        translation: Sequence[float] | NDArray[np.floating[Any]] = ...,
        rotation: Sequence[float] | NDArray[np.floating[Any]] = ...,
    ) -> None:
        """Moves a driven body in the next step: its mesh in the scene is rotated by the quaternion ``rotation`` (x, y, z, w), as in scipy,
        and then translated. It rotates the short way. If it leaves the cloth no room, it stops on its way or the step fails, depending on
        the scene's ``on_blocked``."""

    def bring_body(
        self,
        body: str | int,
        translation: Sequence[float] | NDArray[np.floating[Any]],
        rotation: Sequence[float] | NDArray[np.floating[Any]],
        velocity: Sequence[float] | NDArray[np.floating[Any]],
        spin: Sequence[float] | NDArray[np.floating[Any]],
    ) -> None:
        """Says where another physics engine has brought the body of a proxy, a free body with ``proxy``, in the time of the next call of
        :meth:`advance` or of the next step: the placement of its mesh as in :meth:`place_body`, the velocity of its centre of mass in m/s
        and its angular velocity in rad/s. The proxy goes there, and yields to cloth on the way by its mass. Without a call it stays, and
        yields. Afterwards move the engine's body to :meth:`placement`, and add the impulse of :meth:`proxy_load` to it. Both steps must
        have the same length. With a ``count``, :meth:`step` brings the body in its first step alone."""

    def teleport(
        self,
        bodies: Sequence[str | int],
        translation: Sequence[float] | NDArray[np.floating[Any]] = ...,
        rotation: Sequence[float] | NDArray[np.floating[Any]] = ...,
        *,
        cloths: Sequence[str | int] = ...,
    ) -> None:
        """Moves driven and free bodies elsewhere at once, with their pins and the cloth that hangs on them, as for a figure that teleports.
        No time passes. Positions in the world are rotated about the origin, then translated; velocities turn along. ``cloths`` move as well,
        such as a garment without pins. On an error nothing has changed."""

    def placement(self, body: str | int) -> tuple[list[float], list[float]] | None:
        """Returns the translation and rotation of a driven or free body; None for other bodies and for one that was moved vertex by vertex.
        They take the mesh of the scene to where it is now."""

    def body_motion(self, body: str | int) -> FreeBodyState | None:
        """Returns the mass and the present motion of a free body, one with a ``mass`` or a ``density``; None for any other body."""

    def move_body(self, body: str | int, positions: ArrayLike) -> None:
        """Moves each vertex of a driven body straight to a position, in metres, in the next step, as for a skinned figure."""

    def move_pins(self, group: int, positions: ArrayLike) -> None:
        """Moves each vertex of a driven group of pins, given by its index, in the next step. Soft pins (a group with a ``stiffness`` in
        N/m, and perhaps ``weights`` from 0 to 1, one for each of its vertices) pull their vertices towards these positions."""

    def set_velocity(self, vertices: ArrayLike, velocity: Sequence[float] | NDArray[np.floating[Any]]) -> None:
        """Sets the velocity, in m/s, with which vertices of cloth start the next step, as if a hand pulled them. ``vertices`` are rows of
        :attr:`positions`, or a mask of bool for all vertices of cloth. Pinned vertices keep theirs."""

    def add_force(self, vertices: ArrayLike, force: ArrayLike) -> None:
        """Adds a force, in N, on each of these vertices of cloth, for the whole of the next call of :meth:`step` or :meth:`advance`; after
        it the force is gone. ``force`` is (3,) for all, or (n, 3) with one for each. ``vertices`` are rows of :attr:`positions`, or a mask
        of bool for all vertices of cloth. Forces on the same vertex add up; those on pinned vertices go to :meth:`pin_load`. With a
        ``count``, :meth:`step` applies them in its first step alone."""

    def body_load(
        self, body: str | int, about: Sequence[float] | NDArray[np.floating[Any]] = ..., *, mean: bool = False
    ) -> BodyLoad:
        """The load of cloth and ropes on a body at the end of the last step, with torques about the point ``about``; or the mean over the
        last frame (``mean``): the last :meth:`advance`, or the last step of :meth:`step`. It is zero before the first step and after
        :meth:`resume`."""

    def proxy_load(self, body: str | int) -> Wrench | None:
        """The mean force of cloth and ropes on a proxy in the last :meth:`advance` or step, with the mean torque about its centre of mass;
        None for any other body. Cloth that is pinned to it is part of the load. See :meth:`bring_body`."""

    def pin_load(
        self, group: int, about: Sequence[float] | NDArray[np.floating[Any]] = ..., *, mean: bool = False
    ) -> Wrench:
        """The load on a group of pins, given by its index, as :meth:`body_load`: what moves or holds the pins feels. The weight and the
        inertia of the pinned vertices are in it. Of a soft pin it is the pull of its spring. A vertex in several groups counts in each."""

    def attachment_load(
        self, group: int, about: Sequence[float] | NDArray[np.floating[Any]] = ..., *, mean: bool = False
    ) -> Wrench:
        """The load on a group of attachments, given by its index, as :meth:`body_load`."""

    def contact_loads(self, body: str | int) -> ContactLoads:
        """The contacts that pushed a body in the last part of the last step. A copy."""

    @property
    def unbalanced_force(self) -> NDArray[np.float64]:
        """(3,) the force in N that the last solve left in sum: the error of all loads together. A finer ``accuracy`` lowers it, and it
        vanishes at rest."""
    def set_wind(self, velocity: Sequence[float] | NDArray[np.floating[Any]]) -> None:
        """Sets the velocity of the scene's wind from now on, in m/s."""

    @property
    def faces(self) -> NDArray[np.uint32]:
        """(n, 3) the faces of the cloths, then of the bodies."""
    @property
    def loose_edges(self) -> NDArray[np.uint32]:
        """(n, 2) the loose edges of cloths: ropes, laces and fringes. Tearing changes them, as :attr:`faces`."""
    def mesh_in_files(self) -> MeshInFiles:
        """Returns the present state with the vertices and faces of the cloths' files, seams included."""

    @property
    def cloth_vertex_count(self) -> int:
        """The number of vertices of all cloths."""
    @property
    def cloth_face_count(self) -> int:
        """The number of faces of all cloths."""
    @property
    def name(self) -> str:
        """The name of the scene."""
    @property
    def remarks(self) -> list[str]:
        """Remarks about the scene's files, such as vertices that were left out."""
    @property
    def time_step(self) -> float:
        """The length of a step, in seconds."""
    @property
    def steps(self) -> int | None:
        """The number of steps in the scene's duration; None without one. A scene without a ``time_step`` counts frames."""
    @property
    def steps_per_frame(self) -> int:
        """The number of steps in a frame."""
    @property
    def settings(self) -> dict[str, str]:
        """The settings that trade time for accuracy, with values and units."""
    @property
    def steps_done(self) -> int:
        """The number of steps since the start."""
    @property
    def time(self) -> float:
        """The simulated time, in seconds."""
    @property
    def lag(self) -> float:
        """The time by which bodies and pins lag behind their keyframes, in seconds."""
    @property
    def is_certified(self) -> bool:
        """Whether the state is certified free of the intersections that the scene's contact effects name."""
    @property
    def blocked_steps(self) -> int:
        """The number of steps in which bodies or pins had to wait, or were let pass."""
    @property
    def overstretched_steps(self) -> int:
        """The number of steps after which an edge was more than 5 % above its strain limit. :meth:`step` then issues a
        RuntimeWarning, and :meth:`advance` if it was allowed fewer steps than the cloth needs."""
    @property
    def edge_stretch(self) -> tuple[float, float]:
        """The length of the cloth's edges relative to rest: the 99th percentile and the largest."""
    @property
    def effect_seconds(self) -> dict[str, float]:
        """The processing time of each effect so far."""
    @property
    def contact_counts(self) -> dict[str, int] | None:
        """The counts of contact so far; None without a contact effect. ``candidates``: pairs that boxes keep; ``looked_at``: pairs that the
        previous direction did not settle; ``pushed``; ``violated``: pairs that collide on the intended motion; ``zone_rounds``;
        ``held``: vertices held back; ``cuts``: steps cut in half."""
    @property
    def contact_seconds(self) -> dict[str, float] | None:
        """The processing time of contact so far, without its pushes; None without a contact effect: ``candidates``, ``constraints``,
        ``certificates``, ``repairs``."""
    def checkpoint(self) -> bytes | None:
        """Returns the state as bytes after every 200th step; None in between."""

    def resume(self, checkpoint: bytes) -> None:
        """Continues from a checkpoint of the same scene, with the same bits as an uninterrupted simulation."""
