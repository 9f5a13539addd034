"""What is native. Positions are anything that numpy makes an array of shape (vertex_count, 3) of: float32 and float64 in C order are
used where they are, others copied; whole numbers and mixed formats become float64."""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Literal, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._answers import (
    CandidatePairs,
    Contact,
    Contacts,
    ContactTimes,
    Crossings,
    Intersections,
    NearPairs,
    Release,
    TornEdge,
    Truncation,
    Untangled,
)

__all__ = ["ARM_SLEEVE", "EFFECTS", "Detector", "Simulation", "__version__", "time_of_impact", "touches"]

ARM_SLEEVE: str
"""The scene of a sleeve on a bending arm, for :meth:`Simulation.from_text`."""
EFFECTS: list[str]
"""Every effect that a scene may name."""
__version__: str

def time_of_impact(
    kind: int,
    start: ArrayLike,
    end: ArrayLike,
    *,
    separation: float = 0.0,
    tolerance: float | None = None,
    until: float = 1.0,
) -> float | None:
    """When a pair comes into contact during the step, in [0, 1]; None if it certainly does not, up to ``until``.

    ``start`` and ``end`` have shape (4, 3): a vertex and the corners of a face, or the ends of two edges (``kind`` a
    :class:`Kind`). The time is never after the exact one: before it the two are certainly farther apart than ``separation``. A pair
    that only comes within ``separation + tolerance`` may be a contact too. Lengths in the unit of the positions.

    Raises InputError for another shape, coordinates that are not finite, and lengths that are negative or not finite.
    """

def touches(kind: int, start: ArrayLike, end: ArrayLike) -> bool:
    """Whether a pair truly touches during the step: exact, for every input of finite numbers."""

@final
class Detector:
    """A mesh, and what is kept of it from step to step.

    One thread at a time: a call while another thread is using it raises BusyError. It pickles with its settings. After ``fork`` a
    detector with threads of its own raises ForkedError in the child; one without works.
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
        """``faces`` of shape (n, 3) name vertices from 0; ``edges`` (n, 2) and ``points`` (n,) are those that no face has, of ropes,
        hair and particles: faces (a, b, b) and (p, p, p) after the others. ``threads``: 1 is the one that calls, 0 one for each core.
        Answers do not depend on it."""

    @overload
    def contacts(self, start: ArrayLike, end: ArrayLike, *, geometry: Literal[True] = True) -> Contacts:
        """All contacts of the step, and how the two sides lie to each other; without ``geometry`` their times alone.

        Raises InputError for frames of another length and coordinates that are not finite, BusyError, ForkedError, CancelledError,
        TooManyPairsError; Ctrl-C ends it and leaves the detector usable."""

    @overload
    def contacts(self, start: ArrayLike, end: ArrayLike, *, geometry: Literal[False]) -> ContactTimes: ...
    @overload
    def contacts(self, start: ArrayLike, end: ArrayLike, *, geometry: bool) -> ContactTimes: ...
    @overload
    def contacts_of(
        self, start: ArrayLike, end: ArrayLike, vertex_face: ArrayLike, edge_edge: ArrayLike, *, geometry: Literal[True] = True
    ) -> Contacts:
        """Those contacts that are among the pairs given, of shape (n, 2) each, in their order: as :meth:`contacts`."""

    @overload
    def contacts_of(
        self, start: ArrayLike, end: ArrayLike, vertex_face: ArrayLike, edge_edge: ArrayLike, *, geometry: Literal[False]
    ) -> ContactTimes: ...
    @overload
    def contacts_of(
        self, start: ArrayLike, end: ArrayLike, vertex_face: ArrayLike, edge_edge: ArrayLike, *, geometry: bool
    ) -> ContactTimes: ...
    def earliest(self, start: ArrayLike, end: ArrayLike) -> Contact | None:
        """The earliest contact of the step. The step is certainly free of contact before its time, and as a whole if there is none."""

    def is_free(self, start: ArrayLike, end: ArrayLike) -> bool:
        """Whether the step is certainly free of contact. Ends at the first contact."""

    def candidates(self, start: ArrayLike, end: ArrayLike, *, swept: bool = False) -> CandidatePairs:
        """The pairs that boxes leave; all others are certainly farther apart than the separation throughout the step. By boxes that
        move, or (more pairs, what other systems call candidates) by those that primitives sweep."""

    def intersections(self, positions: ArrayLike) -> Intersections:
        """Where a mesh at rest meets itself: exact, touching included. Empty exactly if no two faces have a point in common besides
        vertices and edges that they share."""

    def has_intersections(self, positions: ArrayLike) -> bool:
        """Whether there is any of the intersections. Ends at the first."""

    def near(self, positions: ArrayLike, distance: float) -> Contacts:
        """All pairs of a mesh at rest within ``distance`` of each other, with their nearest points; times are 0. None is missed, a
        pair by 2^-19 of the distance farther away may be among them."""

    def truncate(self, start: ArrayLike, wanted: ArrayLike) -> Truncation:
        """Holds vertices back, each as far as its own neighbourhood asks for, so that the step is certainly free of contact."""

    def cancel(self) -> None:
        """Ends the question that another thread is asking: there it raises CancelledError. Without one nothing happens."""

    def set_threads(self, threads: int) -> None:
        """How many threads steps are split between: 1 is the one that calls, 0 one for each core."""

    def set_limits(self, separation: float = 0.0, tolerance: float | None = None, *, touching: bool = False) -> None:
        """Contacts are pairs that cannot be proven to stay farther apart than ``separation``; those that only come within ``tolerance`` of
        it may be among them (at first 2^-30 for float64, 2^-20 for float32). Or, ``touching``, only pairs that truly touch, decided exactly. In
        the unit of the positions; for float32 rounded up."""

    def set_moving(self, moving: ArrayLike | None = None) -> None:
        """Names the vertices that move, by one bool each; None: all, as at first. Pairs of which none moves are not looked at, and
        positions of those that do not are taken from the next step and not again until this is called anew."""

    def set_collision_filter(
        self,
        *,
        groups: ArrayLike | None = None,
        patches: ArrayLike | None = None,
        excluded: ArrayLike | None = None,
    ) -> None:
        """Which pairs are looked at, in place of what was said before. ``groups`` (vertex_count, 2): the groups that a vertex is in and
        those that it collides with, a bit each; two collide if each is in one that the other collides with. ``patches``
        (vertex_count,): vertices of one patch do not collide. ``excluded`` (n, 2): pairs of vertices that do not. A pair of primitives
        is looked at if any vertex of one collides with any of the other."""

    def set_coherent(self, coherent: bool) -> None:
        """Whether steps go on from one another, as those of a simulation do: less time, the same contacts."""

    def set_pair_limit(self, limit: int | None = None) -> None:
        """Most pairs that a question may look at; one with more raises TooManyPairsError. None: no limit, as at first."""

    @property
    def vertex_count(self) -> int: ...
    @property
    def faces(self) -> NDArray[np.uint32]:
        """(n, 3), a copy."""
    @property
    def edges(self) -> NDArray[np.uint32]:
        """(n, 2) as the detector numbers them, the smaller vertex first; a copy."""
    @property
    def components(self) -> NDArray[np.uint32]:
        """(vertex_count,) the connected component of each vertex: as ``patches``, only different ones collide."""
    @property
    def threads(self) -> int: ...

@final
class Simulation:
    """Cloth, step by step: certified free of intersections after each, on any number of threads with the same bits.

    ``scene`` is a scene file (TOML). See the project's documentation of scenes for what it can say. One that starts with surfaces that pass
    through each other raises TangledError, which says where, unless it says otherwise (``tangled_start``)."""

    def __new__(cls, scene: str | PathLike[str], threads: int = 1) -> Simulation: ...
    @classmethod
    def from_text(cls, text: str, threads: int = 1, *, path: str | PathLike[str] | None = None) -> Simulation:
        """Of the text of a scene file; ``path`` is for messages, and files that it names are in its folder."""

    @classmethod
    def from_dict(cls, scene: Mapping[str, Any], threads: int = 1, *, folder: str | PathLike[str] | None = None) -> Simulation:
        """Of a scene said in Python: a file's tables as dicts, its lists as lists or arrays."""

    def step(self, count: int = 1) -> None:
        """Does so many steps. Ctrl-C ends them after a whole one; what is done stays. Raises BlockedError where bodies or pins force the
        cloth where it cannot go, and the scene says to stop then."""

    @property
    def positions(self) -> NDArray[np.float64]:
        """(n, 3) in metres: the cloth's vertices, then the bodies'. Always the same array, which shows where they are now: copy it to
        keep it. It cannot be written to. Where cloth tears there are more vertices, hence another array, and :attr:`faces` are others."""
    @property
    def velocities(self) -> NDArray[np.float64]:
        """(n, 3) in m/s, of :attr:`positions`; a copy."""
    @property
    def normals(self) -> NDArray[np.float64]:
        """(n, 3): the mean direction of the faces at each vertex, of length one; zero where they have none."""
    @property
    def near_pairs(self) -> NearPairs:
        """What came near each other in the last part of the last step; nothing without a contact effect. A copy."""
    @property
    def crossings(self) -> Crossings:
        """Where cloth still passes through itself or a body, of what the scene tolerates from its start. A copy."""
    @property
    def tolerated_pairs(self) -> int:
        """How many pairs have left the promise since the start: those about :attr:`crossings`, and those not apart yet."""
    @property
    def untangled(self) -> Untangled | None:
        """What was pulled apart before the first step, if anything was."""
    @property
    def released(self) -> list[Release]:
        """What attachments have let go of so far, attachment by attachment."""
    @property
    def torn_edges(self) -> list[TornEdge]:
        """What has torn so far, in the order in which it did."""
    @property
    def body_names(self) -> list[str]: ...
    def body_vertices(self, body: str | int) -> slice:
        """The part of :attr:`positions` that is a body's."""

    def place_body(
        self,
        body: str | int,
        translation: Sequence[float] | NDArray[np.floating[Any]] = ...,
        rotation: Sequence[float] | NDArray[np.floating[Any]] = ...,
    ) -> None:
        """Leads a body that the scene calls ``driven`` to where its points at rest are turned by ``rotation``, a quaternion (x, y, z, w)
        as scipy has it, then moved, both at first not at all, in the next step: it turns the shorter way round. Where it would leave the cloth no way out, it stops
        on the way, or the step fails, as the scene's ``on_blocked`` says."""

    def placement(self, body: str | int) -> tuple[list[float], list[float]] | None:
        """Translation and rotation of a driven body now; None for any other, and for one that was moved vertex by vertex."""

    def move_body(self, body: str | int, positions: ArrayLike) -> None:
        """Leads each vertex of a driven body straight to a position, in metres, in the next step: a skinned figure."""

    def move_pins(self, group: int, positions: ArrayLike) -> None:
        """The same for a group of pins that the scene calls ``driven``, by its index."""

    def set_wind(self, velocity: Sequence[float] | NDArray[np.floating[Any]]) -> None:
        """Lets the scene's wind blow so from now on, in m/s."""

    @property
    def faces(self) -> NDArray[np.uint32]:
        """(n, 3): the cloth's, then the bodies'."""
    @property
    def loose_edges(self) -> NDArray[np.uint32]:
        """(n, 2): edges of cloths that belong to no face, of ropes, laces and fringes. Others where cloth tears, as :attr:`faces`."""
    @property
    def cloth_vertex_count(self) -> int: ...
    @property
    def cloth_face_count(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def time_step(self) -> float:
        """In seconds."""
    @property
    def steps(self) -> int:
        """How many steps the scene takes."""
    @property
    def steps_per_frame(self) -> int: ...
    @property
    def settings(self) -> dict[str, str]:
        """What trades time for accuracy, with value and unit."""
    @property
    def steps_done(self) -> int: ...
    @property
    def time(self) -> float:
        """In seconds."""
    @property
    def lag(self) -> float:
        """How far bodies and pins are behind their keyframes, in seconds."""
    @property
    def is_certified(self) -> bool:
        """Whether the state is certified free of intersections of whatever the scene's contact effects name."""
    @property
    def blocked_steps(self) -> int: ...
    @property
    def edge_stretch(self) -> tuple[float, float]:
        """The length of the cloth's edges over that at rest: of the 99th percentile, and of the longest."""
    @property
    def effect_seconds(self) -> dict[str, float]:
        """What each effect has taken so far."""
    @property
    def contact_counts(self) -> dict[str, int] | None:
        """What contact has counted so far, None without a contact effect: ``candidates`` (pairs that boxes leave), ``looked_at`` (not
        settled by the direction of the step before), ``pushed``, ``violated`` (not free on the motion wanted), ``zone_rounds``, ``held``
        (vertices held back), ``cuts`` (times a step was cut in half)."""
    @property
    def contact_seconds(self) -> dict[str, float] | None:
        """What contact has taken so far besides its pushes, None without a contact effect: ``candidates``, ``constraints``,
        ``certificates``, ``repairs``."""
    def checkpoint(self) -> bytes | None:
        """All that the rest of the simulation depends on, every 200 steps; None in between."""

    def resume(self, checkpoint: bytes) -> None:
        """Goes on from a checkpoint of the same scene, with the same bits as if it had never ended."""
