"""Bad input raises an exception that says what to do; the object answers as before."""

import numpy as np
import pytest

from selvedge import Detector, Simulation, errors, ipc, time_of_impact

LARGE = [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]]
START = np.array(LARGE + [[0.0, 0.0, 1.0], [1.0, 0.0, 1.1], [0.0, 1.0, 1.2]])
FACES = [[0, 1, 2], [3, 4, 5]]


def changed(row: int, column: int, value: float) -> np.ndarray:
    frame = START.copy()
    frame[row, column] = value
    return frame


@pytest.mark.parametrize(
    ("frame", "error", "words"),
    [
        (START[:5], errors.InputError, "5 positions, but the mesh has 6"),
        (np.concatenate([START, START]), errors.InputError, "12 positions"),
        (START[:, :2], errors.InputError, r"expected an array of shape \(n, 3\), not \(6, 2\)"),
        (START.ravel(), errors.InputError, r"not \(18,\)"),
        (START[None], errors.InputError, r"not \(1, 6, 3\)"),
        (np.zeros((0, 3)), errors.InputError, "0 positions"),
        (None, errors.DataTypeError, "expected numbers"),
        ("positions", errors.DataTypeError, "expected numbers"),
        ([[1.0, 2.0], [3.0]], errors.InputError, "different lengths"),
        (START.astype(complex), errors.DataTypeError, "complex"),
        (START.astype(bool), errors.DataTypeError, "bool"),
        (START.astype(object), errors.DataTypeError, "object"),
        (START.astype(np.longdouble), errors.DataTypeError, "rounded"),
        (np.full((6, 3), 2**53 + 1), errors.DataTypeError, "2\\^53"),
        (changed(4, 1, np.nan), errors.InputError, r"vertex 4 is at \(1, NaN, 1.1\)"),
        (changed(2, 0, -np.inf), errors.InputError, "not a finite number"),
    ],
)
def test_frames(frame, error, words):
    detector = Detector(FACES, 6)
    for ask in [
        lambda: detector.contacts(START, frame),
        lambda: detector.is_free(frame, START),
        lambda: detector.earliest(START, frame),
        lambda: detector.candidates(START, frame),
        lambda: detector.has_intersections(frame),
        lambda: detector.truncate(START, frame),
        lambda: detector.near(frame, 0.1),
    ]:
        with pytest.raises(error, match=words):
            ask()
    assert detector.is_free(START, START)


@pytest.mark.parametrize(
    ("faces", "count", "error", "words"),
    [
        ([[0, 1, 6]], 6, errors.InputError, "names vertex 6, but there are 6"),
        ([[0, 1, -1]], 6, errors.InputError, "-1 is negative"),
        ([[0, 1, 2**32]], 6, errors.InputError, "larger than 2\\^32"),
        ([[0.0, 1.0, 2.0]], 6, errors.DataTypeError, "whole numbers"),
        ([[0, 1, 2, 3]], 6, errors.InputError, r"\(n, 3\)"),
        ([0, 1, 2], 6, errors.InputError, r"\(n, 3\)"),
        ([], 6, errors.InputError, "no triangles"),
        (None, 6, errors.DataTypeError, "numbers"),
        ([[0, 1, 2]], 2**40, errors.InputError, "cannot be numbered"),
        ([[0, 1, 2]], -1, OverflowError, "negative"),
        ([[0, 1, 2]], 2.5, TypeError, "integer"),
    ],
)
def test_meshes(faces, count, error, words):
    with pytest.raises(error, match=words):
        Detector(faces, count)


def test_numbers_of_loose_features():
    with pytest.raises(errors.InputError, match="loose edge 0 names vertex 9"):
        Detector(FACES, 6, edges=[[0, 9]])
    with pytest.raises(errors.InputError, match="point 0 names vertex 9"):
        Detector(FACES, 6, points=[9])


@pytest.mark.parametrize("threads", [10**6, 2**63])
def test_absurd_threads(threads):
    with pytest.raises(errors.ThreadsError):
        Detector(FACES, 6, threads)
    detector = Detector(FACES, 6)
    with pytest.raises(errors.ThreadsError):
        detector.set_threads(threads)
    assert detector.threads == 1 and detector.is_free(START, START)


@pytest.mark.parametrize("length", [-1.0, np.nan, np.inf])
def test_lengths(length):
    detector = Detector(FACES, 6)
    for ask in [
        lambda: detector.set_limits(length),
        lambda: detector.set_limits(0.0, length),
        lambda: detector.near(START, length),
        lambda: time_of_impact(0, START[:4], START[:4], separation=length),
    ]:
        with pytest.raises(errors.InputError, match="finite and not negative"):
            ask()
    assert detector.is_free(START, START)


def test_touching_at_a_distance_makes_no_sense():
    with pytest.raises(errors.InputError, match="touching"):
        Detector(FACES, 6).set_limits(0.1, touching=True)


def test_settings_of_another_length():
    detector = Detector(FACES, 6)
    for ask in [
        lambda: detector.set_moving(np.ones(5, bool)),
        lambda: detector.set_collision_filter(patches=[0] * 7),
        lambda: detector.set_collision_filter(groups=np.ones((5, 2), int)),
    ]:
        with pytest.raises(errors.InputError, match="but the mesh has 6 vertices"):
            ask()
    with pytest.raises(errors.InputError, match="no vertex 6"):
        detector.set_collision_filter(excluded=[[0, 6]])
    with pytest.raises(errors.DataTypeError, match="bool"):
        detector.set_moving(np.ones(6))
    assert detector.is_free(START, START)


def test_pairs_that_the_mesh_does_not_have():
    detector = Detector(FACES, 6)
    with pytest.raises(errors.InputError, match="no vertex-face pair 0, 2"):
        detector.contacts_of(START, START, [[0, 2]], [])
    with pytest.raises(errors.InputError, match="no edge-edge pair 0, 6"):
        detector.contacts_of(START, START, [], [[0, 6]])


def test_more_pairs_than_allowed():
    detector = Detector(FACES, 6)
    detector.set_pair_limit(1)
    end = START.copy()
    end[3:, 2] -= 2.0
    with pytest.raises(errors.TooManyPairsError, match="more than 1 pairs"):
        detector.contacts(START, end)
    detector.set_pair_limit()
    assert len(detector.contacts(START, end)) > 0
    with pytest.raises(OverflowError):
        detector.set_pair_limit(-1)


def test_more_contacts_than_memory_is_allowed_for():
    detector = Detector(FACES, 6)
    detector.set_memory_limit(47)
    end = START.copy()
    end[3:, 2] -= 2.0
    with pytest.raises(errors.TooMuchMemoryError, match="more than 47 bytes"):
        detector.contacts(START, end)
    detector.set_memory_limit(None)
    assert len(detector.contacts(START, end)) > 0


@pytest.mark.parametrize(
    ("kind", "start", "words"),
    [
        (2, START[:4], "2 is not a Kind"),
        (0, START[:3], r"\(4, 3\), not 3"),
        (0, START[:5], r"\(4, 3\), not 5"),
        (1, changed(0, 0, np.nan)[:4], "not a finite number"),
    ],
)
def test_pairs_without_a_mesh(kind, start, words):
    with pytest.raises(errors.InputError, match=words):
        time_of_impact(kind, start, START[:4])


def test_every_exception_is_one_of_pythons_too():
    for error, builtin in [
        (errors.InputError, ValueError),
        (errors.SceneError, ValueError),
        (errors.DataTypeError, TypeError),
        (errors.BusyError, RuntimeError),
        (errors.ThreadsError, OSError),
    ]:
        assert issubclass(error, errors.Error) and issubclass(error, builtin)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", r"scene.toml:1:1: the scene has no \[cloth\]"),
        ("name = ", "scene.toml"),
        ('name = "x"\ntime_step = "1 parsec"', "parsec"),
    ],
)
def test_scenes(text, words):
    with pytest.raises(errors.SceneError, match=words):
        Simulation.from_text(text)


def test_scene_files_that_are_not_there():
    with pytest.raises(errors.SceneError, match="none.toml"):
        Simulation("none.toml")


def test_scenes_said_in_python():
    with pytest.raises(errors.DataTypeError, match="cloth.density"):
        Simulation.from_dict({"name": "x", "cloth": {"density": None}})
    with pytest.raises(errors.DataTypeError, match="names in a scene must be text"):
        Simulation.from_dict({1: "x"})


def test_ipc_says_what_it_does_not_have():
    with pytest.raises(AttributeError, match="BarrierPotential.*use ipctk for the rest"):
        ipc.BarrierPotential  # noqa: B018
    mesh = ipc.CollisionMesh(START, faces=FACES)
    with pytest.raises(NotImplementedError, match="broad_phase"):
        ipc.is_step_collision_free(mesh, START, START, broad_phase=object())
    with pytest.raises(errors.InputError, match="two dimensions"):
        ipc.CollisionMesh(START[:, :2], [[0, 1]])
    with pytest.raises(errors.InputError, match="is missing"):
        ipc.CollisionMesh(START, [[0, 1]], FACES)
    with pytest.raises(errors.DataTypeError, match="CollisionMesh"):
        ipc.has_intersections(START, START)


def test_masked_arrays_are_refused_since_masked_entries_have_no_value():
    masked = np.ma.masked_array(START, mask=START > 1)
    with pytest.raises(errors.InputError, match="start: this is a masked array"):
        Detector(FACES, 6).contacts(masked, START)
    with pytest.raises(errors.InputError, match="faces: this is a masked array"):
        Detector(np.ma.masked_array(FACES, mask=[[0, 0, 1], [0, 0, 0]]), 6)
