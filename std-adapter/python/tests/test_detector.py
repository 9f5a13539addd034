"""The detector's answers, and their arrays."""

import pickle

import numpy as np
import pytest
from conftest import two_sheets

import selvedge
from selvedge import Detector, Kind


def random_step(seed: int, size: int = 12, by: float = 0.15):
    faces, start = two_sheets(size)
    random = np.random.default_rng(seed)
    start = start + random.uniform(-0.02, 0.02, start.shape)
    return faces, start, start + random.uniform(-by, by, start.shape)


def test_contacts_are_arrays_of_kind_pair_time_vertices_and_geometry(falling):
    faces, start, end = falling
    contacts = Detector(faces, 6).contacts(start, end)
    count = len(contacts)
    assert count > 0
    assert contacts.kind.shape == (count,) and contacts.kind.dtype == np.uint8
    assert contacts.pair.shape == (count, 2) and contacts.pair.dtype == np.uint32
    assert contacts.time.shape == (count,) and contacts.time.dtype == np.float64
    assert contacts.vertices.shape == (count, 4)
    assert contacts.points.shape == (count, 2, 3)
    assert contacts.weights.shape == (count, 4)
    assert contacts.normals.shape == (count, 3)
    assert contacts.distances.shape == (count, 2)
    first = int(contacts.time.argmin())
    assert contacts.kind[first] == Kind.VERTEX_FACE
    assert contacts.vertices[first].tolist() == [3, 0, 1, 2]
    assert contacts.time[first] == pytest.approx(0.5, abs=1e-8)
    assert contacts.normals[first].tolist() == [0.0, 0.0, 1.0]
    assert contacts.speeds[first] == -2.0


def test_points_are_weights_times_vertices(falling):
    faces, start, end = falling
    contacts = Detector(faces, 6).contacts(start, end)
    for row in range(len(contacts)):
        at = start + (end - start) * contacts.time[row]
        split = 1 if contacts.kind[row] == Kind.VERTEX_FACE else 2
        weights, corners = contacts.weights[row], at[contacts.vertices[row]]
        for side, part in enumerate([slice(0, split), slice(split, 4)]):
            np.testing.assert_allclose(contacts.points[row, side], weights[part] @ corners[part], atol=1e-12)


def test_without_geometry_there_are_times_alone(falling):
    faces, start, end = falling
    times = Detector(faces, 6).contacts(start, end, geometry=False)
    assert not hasattr(times, "points")
    assert len(times) == len(Detector(faces, 6).contacts(start, end))


def test_the_earliest_contact_is_the_first_of_all(falling):
    faces, start, end = falling
    detector = Detector(faces, 6)
    earliest = detector.earliest(start, end)
    assert earliest is not None
    assert earliest.time == detector.contacts(start, end).time.min()
    assert earliest.vertices == (3, 0, 1, 2)
    assert detector.earliest(start, start) is None


@pytest.mark.parametrize("seed", range(40))
def test_a_step_cut_at_its_earliest_contact_is_free(seed):
    faces, start, end = random_step(seed)
    detector = Detector(faces, len(start))
    earliest = detector.earliest(start, end)
    if earliest is None:
        assert detector.is_free(start, end)
        return
    cut = start + (end - start) * (earliest.time * (1.0 - 1e-6))
    assert detector.is_free(start, cut)
    assert not detector.is_free(start, end)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_threads_change_no_bit(dtype):
    faces, start, end = random_step(7)
    start, end = start.astype(dtype), end.astype(dtype)
    one, two = (Detector(faces, len(start), threads).contacts(start, end) for threads in (1, 2))
    order = [np.lexsort((found.pair[:, 1], found.pair[:, 0], found.kind)) for found in (one, two)]
    for name in ["kind", "pair", "time", "vertices", "points", "weights", "normals", "distances", "speeds"]:
        np.testing.assert_array_equal(getattr(one, name)[order[0]], getattr(two, name)[order[1]])


def test_the_format_of_times_is_that_of_the_positions(falling):
    faces, start, end = falling
    detector = Detector(faces, 6)
    assert detector.contacts(start.astype(np.float32), end.astype(np.float32)).time.dtype == np.float32
    assert detector.contacts(start.astype(np.float32), end).time.dtype == np.float64
    assert detector.contacts(start, end).time.dtype == np.float64


@pytest.mark.parametrize(
    "other",
    [
        np.asfortranarray,
        lambda frame: np.repeat(frame, 2, axis=0)[::2],
        lambda frame: np.repeat(frame, 2, axis=1)[:, ::2],
        lambda frame: frame.astype(">f8"),
        lambda frame: np.frombuffer(b"x" + frame.tobytes(), np.uint8)[1:].view(np.float64).reshape(-1, 3),
        lambda frame: frame.tolist(),
        lambda frame: np.lib.stride_tricks.as_strided(frame.copy(), writeable=False),
    ],
    ids=["fortran", "rows", "columns", "big-endian", "misaligned", "lists", "read-only"],
)
def test_other_layouts_give_the_same_bits(falling, other):
    faces, start, end = falling
    as_it_is, copied = Detector(faces, 6).contacts(start, end), Detector(faces, 6).contacts(other(start), other(end))
    np.testing.assert_array_equal(as_it_is.pair, copied.pair)
    np.testing.assert_array_equal(as_it_is.time, copied.time)


def test_whole_numbers_are_positions():
    faces = [[0, 1, 2], [3, 4, 5]]
    start = [[-5, -5, 0], [5, -5, 0], [0, 5, 0], [0, 0, 1], [1, 0, 2], [0, 1, 2]]
    end = [[-5, -5, 0], [5, -5, 0], [0, 5, 0], [0, 0, -1], [1, 0, 0], [0, 1, 0]]
    assert Detector(faces, 6).earliest(start, end) is not None
    assert Detector(faces, 6).earliest(np.array(start, np.int8), np.array(end, np.int8)) is not None


def test_candidates_have_all_contacts(falling):
    faces, start, end = falling
    detector = Detector(faces, 6)
    moving, swept = detector.candidates(start, end), detector.candidates(start, end, swept=True)
    contacts = detector.contacts(start, end)
    for candidates in (moving, swept):
        found = detector.contacts_of(start, end, candidates.vertex_face, candidates.edge_edge)
        assert sorted(map(tuple, found.pair)) == sorted(map(tuple, contacts.pair))
    assert len(moving) <= len(swept)


def test_intersections_are_exact():
    faces = [[0, 1, 2], [3, 4, 5]]
    positions = np.array([[-5, -5, 0], [5, -5, 0], [0, 5, 0], [0, 0, -1], [1, 0, 1], [0, 1, 1]], float)
    detector = Detector(faces, 6)
    found = detector.intersections(positions)
    assert detector.has_intersections(positions)
    assert set(found.kind) == {selvedge.IntersectionKind.EDGE_FACE}
    assert detector.edges[found.pair[:, 0]].tolist() == [[3, 4], [3, 5]]
    positions[3, 2] = np.nextafter(0.0, 1.0)
    assert not detector.has_intersections(positions)
    positions[3, 2] = 0.0
    assert detector.has_intersections(positions)


def test_near_finds_what_is_within_a_distance(falling):
    faces, start, _ = falling
    detector = Detector(faces, 6)
    assert len(detector.near(start, 0.5)) == 0
    near = detector.near(start, 1.05)
    assert near.vertices.tolist() == [[3, 0, 1, 2]]
    assert near.distances[0, 0] <= 1.0 <= near.distances[0, 1]


def test_a_truncated_step_is_free_and_goes_as_far_as_it_may():
    faces, start, end = random_step(3)
    detector = Detector(faces, len(start))
    truncation = detector.truncate(start, end)
    assert truncation.held_back > 0 and truncation.in_contact == 0
    assert detector.is_free(start, truncation.positions)
    reached = (truncation.positions == end).all(axis=1)
    assert reached.sum() == len(start) - truncation.held_back


def test_a_separation_is_kept(falling):
    faces, start, end = falling
    detector = Detector(faces, 6)
    touching = detector.earliest(start, end)
    detector.set_limits(0.5)
    apart = detector.earliest(start, end)
    assert apart is not None and touching is not None
    assert apart.time == pytest.approx(0.25, abs=1e-6) and apart.time < touching.time


def test_touching_is_decided_exactly():
    faces = [[0, 1, 2], [3, 4, 5]]
    large = [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]]
    # A corner falls past an edge of the large triangle, nearer than the tolerance.
    start = np.array(large + [[0.0, -5.0 - 1e-11, 1.0], [1.0, -8.0, 1.1], [-1.0, -8.0, 1.2]])
    end = start - np.array([0.0, 0.0, 2.0])
    end[:3] = start[:3]
    detector = Detector(faces, 6)
    assert not detector.is_free(start, end)
    detector.set_limits(touching=True)
    assert detector.is_free(start, end)
    start[3, 1] = end[3, 1] = -5.0
    assert not detector.is_free(start, end)


def test_filters_exclude_groups_patches_and_pairs(falling):
    faces, start, end = falling
    detector = Detector(faces, 6)
    everything = len(detector.contacts(start, end))
    groups = np.full((6, 2), 0xFFFF_FFFF, np.uint32)
    groups[3:, 1] = 0
    for filtered in [
        {"groups": groups},
        {"patches": [0] * 6},
        {"excluded": [[a, b] for a in range(3) for b in range(3, 6)]},
    ]:
        detector.set_collision_filter(**filtered)
        assert len(detector.contacts(start, end)) == 0
    detector.set_collision_filter(patches=detector.components)
    assert len(detector.contacts(start, end)) == everything
    detector.set_collision_filter()
    assert len(detector.contacts(start, end)) == everything


def test_what_does_not_move_is_not_looked_at(falling):
    faces, start, end = falling
    detector = Detector(faces, 6)
    detector.set_moving(np.zeros(6, bool))
    assert detector.is_free(start, end)
    detector.set_moving(None)
    assert not detector.is_free(start, end)


def test_loose_edges_and_points_collide():
    rope = Detector([], 5, edges=[[0, 1], [2, 3]], points=[4])
    start = np.array([[-1, 0, 1], [1, 0, 1], [0, -1, 0], [0, 1, 0], [9, 9, 9]], float)
    end = start.copy()
    end[:2, 2] = -1.0
    earliest = rope.earliest(start, end)
    assert earliest is not None and earliest.kind == Kind.EDGE_EDGE
    assert earliest.time == pytest.approx(0.5, abs=1e-8)


def test_coherent_steps_have_the_same_contacts():
    faces, start, end = random_step(5, by=0.03)
    coherent, anew = Detector(faces, len(start)), Detector(faces, len(start))
    coherent.set_coherent(True)
    for step in range(10):
        a, b = (start + (end - start) * at for at in (step / 5, (step + 1) / 5))
        ours, theirs = coherent.contacts(a, b, geometry=False), anew.contacts(a, b, geometry=False)
        assert sorted(zip(ours.kind, map(tuple, ours.pair), ours.time)) == sorted(
            zip(theirs.kind, map(tuple, theirs.pair), theirs.time)
        )


def test_a_pickled_detector_has_its_settings(falling):
    faces, start, end = falling
    detector = Detector(faces, 6, 2, edges=[[0, 3]])
    detector.set_limits(0.5, 1e-4)
    detector.set_moving(np.array([True, False] * 3))
    detector.set_collision_filter(patches=[0, 1, 2, 3, 4, 5], excluded=[[0, 3]], groups=np.full((6, 2), 3))
    detector.set_coherent(True)
    detector.set_pair_limit(12345)
    detector.set_memory_limit(1 << 20)
    again = pickle.loads(pickle.dumps(detector))
    assert again.__reduce__()[1][1:] == detector.__reduce__()[1][1:]
    for name, value in detector.__reduce__()[2].items():
        np.testing.assert_array_equal(again.__reduce__()[2][name], value)
    np.testing.assert_array_equal(again.edges, detector.edges)
    np.testing.assert_array_equal(again.contacts(start, end).time, detector.contacts(start, end).time)


def test_answers_pickle(falling):
    faces, start, end = falling
    contacts = Detector(faces, 6).contacts(start, end)
    again = pickle.loads(pickle.dumps(contacts))
    np.testing.assert_array_equal(again.points, contacts.points)


def test_one_pair_without_a_mesh(falling):
    _, start, end = falling
    rows = [3, 0, 1, 2]
    time = selvedge.time_of_impact(Kind.VERTEX_FACE, start[rows], end[rows])
    assert time == pytest.approx(0.5, abs=1e-8) and time <= 0.5
    assert selvedge.touches(Kind.VERTEX_FACE, start[rows], end[rows])
    assert selvedge.time_of_impact(Kind.VERTEX_FACE, start[rows], end[rows], until=0.4) is None
    assert selvedge.time_of_impact(Kind.VERTEX_FACE, start[rows], start[rows]) is None
    assert selvedge.time_of_impact(Kind.VERTEX_FACE, start[rows], start[rows], separation=1.0) == 0.0
