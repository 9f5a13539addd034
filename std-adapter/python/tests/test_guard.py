"""The guard: every positions that it returns are free, whatever the other simulator did."""

import itertools
from fractions import Fraction

import numpy as np
import pytest
from conftest import Frame, sheet, two_sheets
from numpy.typing import NDArray

import selvedge
from selvedge import Detector
from selvedge.errors import DataTypeError, InputError
from selvedge.guard import Guard

Faces = NDArray[np.uint32]

CUBE_FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)


def cube(size: float, corner: tuple[float, float, float]) -> Frame:
    """The vertices of a cube, whose lowest corner is given."""
    return size * np.array(list(itertools.product((0.0, 1.0), repeat=3))) + np.array(corner)


def turned(angle: float) -> Frame:
    """The matrix of a rotation about the diagonal of space, by Rodrigues."""
    cross = np.array([[0.0, -1.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 1.0, 0.0]]) / np.sqrt(3.0)
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def edges_of(faces: Faces) -> list[tuple[int, int]]:
    return sorted({(min(a, b), max(a, b)) for face in faces.tolist() for a, b in itertools.combinations(face, 2)})


def rough(start: Frame) -> Frame:
    """Uneven positions near these: no edge then lies in the plane of a face, which the oracle below would count as a crossing."""
    return start + np.random.default_rng(11).normal(0.0, 1e-3, start.shape)


def crossings(faces: Faces, positions: NDArray[np.floating], cloth: int | None = None) -> int:
    """Counts edges that meet faces, by rational numbers and without the library. Only the first ``cloth`` vertices are those of cloth;
    bodies may meet bodies. An edge in the plane of a face counts if their boxes overlap."""
    scale = 2 ** max(Fraction(float(x)).denominator.bit_length() for x in positions.ravel())
    exact = [[int(Fraction(float(x)) * scale) for x in vertex] for vertex in positions]

    def volume(a: int, b: int, c: int, d: int) -> int:
        u, v, w = ([x - y for x, y in zip(exact[other], exact[a], strict=True)] for other in (b, c, d))
        value = (
            u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0])
        )
        return (value > 0) - (value < 0)

    edges = np.array(edges_of(faces))
    # Exact comparisons of floats leave only pairs whose boxes overlap.
    low = [positions[items].min(axis=1) for items in (edges, faces)]
    high = [positions[items].max(axis=1) for items in (edges, faces)]
    overlap = ((low[0][:, None] <= high[1][None]) & (low[1][None] <= high[0][:, None])).all(axis=2)
    count = 0
    for edge, face in np.argwhere(overlap):
        (a, b), (p, q, r) = edges[edge].tolist(), faces[face].tolist()
        if {a, b} & {p, q, r} or (cloth is not None and min(a, p) >= cloth):
            continue
        if volume(p, q, r, a) * volume(p, q, r, b) > 0:
            continue
        sides = {volume(a, b, *ends) for ends in ((p, q), (q, r), (r, p))}
        count += not {-1, 1} <= sides
    return count


def passes(faces: Faces, start: Frame, end: Frame) -> bool:
    """Decides exactly whether any two primitives touch during the straight step, over all pairs."""
    edges = edges_of(faces)
    pairs = [(0, [v, *face]) for v in range(len(start)) for face in faces.tolist() if v not in face]
    pairs += [(1, [*a, *b]) for a, b in itertools.combinations(edges, 2) if not {*a} & {*b}]
    return any(selvedge.touches(kind, start[vertices], end[vertices]) for kind, vertices in pairs)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("separation", [0.0, 0.002])
def test_violent_moves_end_free_and_pass_through_nothing(dtype, separation):
    random = np.random.default_rng(7)
    faces, start = two_sheets(4)
    before = rough(start).astype(dtype)
    guard = Guard(faces, len(before), separation=separation)
    passed = held = 0
    for _ in range(6):
        after = (before + random.normal(0.0, 0.4, before.shape)).astype(dtype)
        step = guard.hold(before, after)
        assert step.free and step.positions.dtype == dtype
        passed += passes(faces, before, after)
        held += len(step.held_back)
        assert crossings(faces, step.positions) == 0
        assert not passes(faces, before, step.positions)
        before = step.positions
    assert passed == 6 and held > 0


def test_violent_moves_among_driven_bodies_end_free_with_the_bodies_at_their_ends():
    random = np.random.default_rng(3)
    faces, cloth = sheet(8)
    cloth = rough(cloth)
    bodies = [cube(0.2, (0.2, 0.2, -0.25)), cube(0.15, (0.6, 0.5, 0.05))]
    both = np.concatenate([faces, CUBE_FACES + len(cloth), CUBE_FACES + len(cloth) + 8]).astype(np.uint32)
    guard = Guard(faces, len(cloth), bodies=[(CUBE_FACES, 8)] * 2)
    crossed = free = 0
    for _ in range(12):
        after = cloth + random.normal(0.0, 0.1, cloth.shape)
        moved = [body + random.normal(0.0, 0.06, 3) for body in bodies]
        crossed += crossings(both, np.concatenate([after, *moved]), len(cloth)) > 0
        step = guard.hold(cloth, after, bodies_before=bodies, bodies_after=moved)
        if not step.free:
            assert step.positions is None and "out of its way" in step.reason
            continue
        free += 1
        assert all(np.array_equal(body, end) for body, end in zip(step.bodies, moved, strict=True))
        cloth, bodies = step.positions, step.bodies
        assert crossings(both, np.concatenate([cloth, *bodies]), len(cloth)) == 0
    assert crossed >= 10 and free >= 10


def test_a_body_carries_cloth_that_its_simulator_leaves_in_its_way():
    faces, cloth = sheet(8)
    cloth = rough(cloth)
    body = cube(0.2, (0.4, 0.4, -0.25))
    guard = Guard(faces, len(cloth), bodies=[(CUBE_FACES, 8)])
    for _ in range(4):
        moved = body + np.array([0.01, 0.0, 0.1])
        step = guard.hold(cloth, cloth, bodies_before=[body], bodies_after=[moved])
        assert step.free and np.array_equal(step.bodies[0], moved)
        cloth, body = step.positions, moved
    both = np.concatenate([faces, CUBE_FACES + len(cloth)]).astype(np.uint32)
    assert crossings(both, np.concatenate([cloth, body]), len(cloth)) == 0
    # Its top was 0.05 below the sheet and rose by 0.4; the sheet lies on it, and far from it rests.
    assert cloth[:, 2].max() > 0.35 and abs(cloth[0, 2]) < 0.01


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_crumpled_cloth_is_never_in_the_way_of_one_rigid_body(dtype):
    random = np.random.default_rng(4)
    faces, cloth = sheet(6)
    cloth, body = rough(cloth).astype(dtype), cube(0.3, (0.3, 0.3, -0.45)).astype(dtype)
    both = np.concatenate([faces, CUBE_FACES + len(cloth)]).astype(np.uint32)
    guard = Guard(faces, len(cloth), bodies=[(CUBE_FACES, 8)], separation=1e-3)
    carried = 0
    for _ in range(12):
        after = (cloth + random.normal(0.0, 0.15, cloth.shape)).astype(dtype)
        # It turns by up to 0.3 about the diagonal of space, and goes towards the middle of the cloth.
        turn = turned(random.uniform(-0.3, 0.3))
        centre = body.mean(axis=0)
        way = 0.5 * (cloth.mean(axis=0) - centre) + random.normal(0.0, 0.1, 3)
        moved = ((body - centre) @ turn.T + centre + way).astype(dtype)
        step = guard.hold(cloth, after, bodies_before=[body], bodies_after=[moved])
        assert step.free, step.reason
        assert np.array_equal(step.bodies[0], moved)
        carried += (step.distances > 0.0).any()
        cloth, body = step.positions, moved
        assert crossings(both, np.concatenate([cloth, body]), len(cloth)) == 0
    assert carried > 6


def test_a_layer_far_from_a_body_follows_the_cloth_under_it_that_the_body_carries():
    # A long triangle, and a small one close above its far end. The body lifts the long one at its near end.
    cloth = np.array([[-0.5, -0.5, 0.0], [-0.5, 0.5, 0.0], [3.0, 0.0, 0.0], [2.0, 0.0, 1e-5], [2.2, -0.1, 1e-5], [2.2, 0.1, 1e-5]])
    body = cube(0.2, (-0.4, -0.1, -0.21))
    guard = Guard([[0, 1, 2], [3, 4, 5]], len(cloth), bodies=[(CUBE_FACES, 8)])
    moved = body + [0.0, 0.0, 0.2]
    step = guard.hold(cloth, cloth, bodies_before=[body], bodies_after=[moved])
    assert step.free and np.array_equal(step.bodies[0], moved)
    both = np.concatenate([[[0, 1, 2], [3, 4, 5]], CUBE_FACES + len(cloth)]).astype(np.uint32)
    assert crossings(both, np.concatenate([step.positions, moved]), len(cloth)) == 0


def test_a_body_that_presses_does_not_use_up_the_separation():
    faces, cloth = sheet(4)
    cloth = rough(cloth)
    under = cloth[:, 2].min() - 0.0005
    body = cube(0.4, (0.3, 0.3, under - 0.4))
    guard = Guard(faces, len(cloth), bodies=[(CUBE_FACES, 8)], separation=0.001)
    moved = body + [0.0, 0.0, 0.05]
    step = guard.hold(cloth, cloth, bodies_before=[body], bodies_after=[moved])
    both = np.concatenate([faces, CUBE_FACES + len(cloth)]).astype(np.uint32)
    near = Detector(both, len(cloth) + 8).near(np.concatenate([step.positions, moved]), 0.1)
    between = (near.vertices < len(cloth)).any(axis=1) & (near.vertices >= len(cloth)).any(axis=1)
    assert step.free and near.distances[between, 1].min() >= 0.001


def test_what_starts_within_the_separation_keeps_a_part_of_its_distance(falling):
    faces, before, _ = falling
    before[3:, 2] = 0.01
    step = Guard(faces, 6, separation=0.1).hold(before, before - np.array([0.0, 0.0, 1.0]) * np.repeat([0, 1], 3)[:, None])
    assert step.free and (step.positions[3:, 2] > 0.1 / 4**3).all()


def test_a_free_step_is_returned_bit_for_bit():
    random = np.random.default_rng(2)
    faces, before = two_sheets(6)
    body = cube(0.2, (0.2, 0.2, -0.6))
    guard = Guard(faces, len(before), bodies=[(CUBE_FACES, 8)])
    after = before + random.normal(0.0, 0.01, before.shape)
    after[3, 2] = -0.0
    step = guard.hold(before, after, bodies_before=[body], bodies_after=[body + 0.1])
    assert step.free and step.positions.tobytes() == after.tobytes()
    assert len(step.held_back) == len(step.distances) == 0


def test_only_vertices_in_the_way_are_held_back_and_it_says_how_far(falling):
    faces, before, after = falling
    after[0] -= 1.0
    step = Guard(faces, 6).hold(before, after)
    assert step.held_back.tolist() == [3, 4, 5]
    assert np.array_equal(step.distances, np.linalg.norm(step.positions - after, axis=1)[3:])
    assert np.array_equal(step.positions[:3], after[:3])


def test_a_separation_is_kept_by_what_is_held_back(falling):
    faces, before, after = falling
    step = Guard(faces, 6, separation=0.25).hold(before, after)
    near = Detector(faces, 6).near(step.positions, 1.0)
    assert near.distances[:, 1].min() >= 0.25


def test_what_starts_within_the_tolerance_may_leave_and_not_pass(falling):
    faces, before, _ = falling
    before[3:, 2] = 1e-12
    guard = Guard(faces, 6)
    away = before + np.array([0.0, 0.0, 1.0]) * np.repeat([0, 1], 3)[:, None]
    assert np.array_equal(guard.hold(before, away).positions, away)
    through = before - np.array([0.0, 0.0, 1.0]) * np.repeat([0, 1], 3)[:, None]
    held = guard.hold(before, through)
    assert held.free and (held.positions[3:, 2] > 0.0).all()


@pytest.mark.parametrize("where", ["before", "after", "body"])
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_numbers_that_are_not_finite_are_not_free(where, value):
    faces, cloth = sheet(3)
    frames = {"before": cloth.copy(), "after": cloth.copy(), "body": cube(0.2, (0.4, 0.4, -0.5))}
    body = frames["body"].copy()
    frames[where][4, 1] = value
    guard = Guard(faces, len(cloth), bodies=[(CUBE_FACES, 8)])
    step = guard.hold(frames["before"], frames["after"], bodies_before=[body], bodies_after=[frames["body"]])
    assert not step.free and step.positions is None and step.bodies is None
    assert "not finite" in step.reason and ("vertex 4 of body 0" if where == "body" else "vertex 4 of the cloth") in step.reason
    # The guard remains usable.
    assert guard.hold(cloth, cloth, bodies_before=[body]).free


def test_a_tangled_start_is_not_free_and_its_faces_are_named(falling):
    faces, start, _ = falling
    start[3, 2] = -0.5
    step = Guard(faces, 6).hold(start, start)
    assert not step.free and step.positions is None
    assert step.tangled.tolist() == [[0, 1]]
    assert "face 0 of the cloth and face 1 of the cloth" in step.reason
    bodies = Guard(faces[:1], 3, bodies=[(faces[:1], 3)]).hold(start[:3], start[:3], bodies_before=[start[3:]])
    assert not bodies.free and "face 0 of the cloth and face 0 of body 0" in bodies.reason


def test_bodies_may_pass_through_each_other():
    faces, cloth = sheet(3)
    body = cube(0.2, (0.4, 0.4, -0.5))
    guard = Guard(faces, len(cloth), bodies=[(CUBE_FACES, 8)] * 2)
    step = guard.hold(cloth, cloth, bodies_before=[body, body + 0.05], bodies_after=[body, body])
    assert step.free and np.array_equal(step.bodies[1], body)


def pressed() -> tuple[Guard, Guard, Frame, list[Frame], list[Frame]]:
    """A sheet between two bodies that move through each other: guards that drive and hold them, the sheet, the bodies before and after."""
    faces, cloth = sheet(4)
    cloth = rough(cloth)
    bodies = [cube(0.4, (0.3, 0.3, -0.45)), cube(0.4, (0.3, 0.3, 0.05))]
    moved = [bodies[0] + np.array([0.0, 0.0, 0.2]), bodies[1] - np.array([0.0, 0.0, 0.2])]
    guards = [Guard(faces, len(cloth), bodies=[(CUBE_FACES, 8)] * 2, hold_bodies=hold) for hold in (False, True)]
    return guards[0], guards[1], cloth, bodies, moved


def test_cloth_that_cannot_get_out_of_the_way_is_not_free():
    guard, _, cloth, bodies, moved = pressed()
    step = guard.hold(cloth, cloth, bodies_before=bodies, bodies_after=moved)
    assert not step.free and step.positions is None and "out of its way" in step.reason


def test_bodies_are_held_back_as_a_whole_if_told():
    _, guard, cloth, bodies, moved = pressed()
    step = guard.hold(cloth, cloth, bodies_before=bodies, bodies_after=moved)
    assert step.free
    for body, end, wanted in zip(bodies, step.bodies, moved, strict=True):
        ways = end - body
        assert np.allclose(ways, ways[0], atol=1e-12) and abs(ways[0, 2]) < abs((wanted - body)[0, 2])
    both = np.concatenate([sheet(4)[0], CUBE_FACES + 16, CUBE_FACES + 24]).astype(np.uint32)
    assert crossings(both, np.concatenate([step.positions, *step.bodies]), len(cloth)) == 0


def test_more_pairs_than_the_limit_are_not_free():
    faces, cloth = two_sheets(6)
    step = Guard(faces, len(cloth), pair_limit=3).hold(cloth, -cloth)
    assert not step.free and step.positions is None and "too violent" in step.reason


def test_a_rope_and_a_particle_do_not_pass_through_a_body_either():
    table = np.array([[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]])
    start = np.array([[-1.0, -1.0, 0.1], [0.0, -1.0, 0.1], [1.0, -1.0, 0.1], [0.0, 0.0, 0.2]])
    guard = Guard([], 4, edges=[[0, 1], [1, 2]], points=[3], bodies=[([[0, 1, 2]], 3)])
    step = guard.hold(start, start - [0.0, 0.0, 1.0], bodies_before=[table])
    assert step.free and (step.positions[:, 2] > 0.0).all() and (step.positions[:, 2] < 0.01).all()
    through = start.copy()
    through[1, 2] = -0.1
    tangled = guard.hold(through, through, bodies_before=[table])
    assert not tangled.free and tangled.tangled.tolist() == [[0, 1], [0, 2]]
    assert "face 0 of body 0 and loose edge or point 0 of the cloth" in tangled.reason


def test_a_body_that_moves_farther_than_numbers_reach_is_not_free():
    faces, cloth = sheet(3)
    body = cube(0.2, (0.4, 0.4, -0.5))
    guard = Guard(faces, len(cloth), bodies=[(CUBE_FACES, 8)])
    step = guard.hold(cloth, cloth, bodies_before=[body], bodies_after=[body + [0.0, 0.0, 1e308]])
    assert not step.free and step.positions is None and "too far" in step.reason


def test_results_do_not_depend_on_threads():
    random = np.random.default_rng(5)
    faces, cloth = two_sheets(8)
    after = cloth + random.normal(0.0, 0.1, cloth.shape)
    first, second = (Guard(faces, len(cloth), threads=threads).hold(cloth, after) for threads in (1, 2))
    assert first.positions.tobytes() == second.positions.tobytes()


def test_bad_shapes_and_formats_are_errors():
    faces, cloth = sheet(3)
    guard = Guard(faces, len(cloth), bodies=[(CUBE_FACES, 8)])
    body = cube(0.2, (0.4, 0.4, -0.5))
    with pytest.raises(InputError, match="bodies_before: expected 1 bodies, not 0"):
        guard.hold(cloth, cloth)
    with pytest.raises(InputError, match="after: expected 9 vertices, not 8"):
        guard.hold(cloth, cloth[1:], bodies_before=[body])
    with pytest.raises(DataTypeError, match=r"bodies_before\[0\]: float64 would have to be rounded"):
        guard.hold(cloth.astype(np.float32), cloth.astype(np.float32), bodies_before=[body])
    with pytest.raises(DataTypeError, match="before is float64 and after is float32"):
        guard.hold(cloth, cloth.astype(np.float32), bodies_before=[body], bodies_after=[body.astype(np.float32)])
    with pytest.raises(InputError, match="faces of body 0: there is no vertex 7"):
        Guard(faces, len(cloth), bodies=[(CUBE_FACES, 7)])
    with pytest.raises(InputError, match="edges: there is no vertex 9"):
        Guard(faces, len(cloth), edges=[[0, 9]], bodies=[(CUBE_FACES, 8)])
