"""The names of ipctk: their answers, and candidates and step sizes, which are those of the detector."""

import pickle

import numpy as np
import pytest
from conftest import two_sheets

from selvedge import Detector, ipc


def cube(at, size=1.0):
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float) * size + at
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    return corners, np.array(faces)


@pytest.fixture
def cubes():
    (first, faces), (second, _) = cube((0, 0, 0)), cube((1.1, 0.05, 0.03))
    start = np.concatenate([first, second])
    end = start.copy()
    end[8:, 0] -= 0.4
    return start, end, np.concatenate([faces, faces + 8])


def test_two_cubes_that_meet(cubes):
    start, end, faces = cubes
    edges = ipc.edges(faces)
    mesh = ipc.CollisionMesh(start, edges, faces)
    assert not ipc.has_intersections(mesh, start) and ipc.has_intersections(mesh, end)
    assert not ipc.is_step_collision_free(mesh, start, end)
    step = ipc.compute_collision_free_stepsize(mesh, start, end)
    assert 0 < step < 1 and step == pytest.approx(0.25, abs=1e-7)
    assert ipc.is_step_collision_free(mesh, start, (end - start) * step * (1 - 1e-9) + start)
    assert ipc.compute_collision_free_stepsize(mesh, start, start) == 1.0


def test_candidates_cut_the_step_as_the_mesh_does(cubes):
    start, end, faces = cubes
    mesh = ipc.CollisionMesh(start, ipc.edges(faces), faces)
    candidates = ipc.Candidates()
    assert candidates.empty()
    candidates.build(mesh, start, end)
    assert len(candidates) == len(candidates.ee_candidates) + len(candidates.fv_candidates) > 0
    assert not candidates.is_step_collision_free(mesh, start, end)
    whole = ipc.compute_collision_free_stepsize(mesh, start, end)
    assert candidates.compute_collision_free_stepsize(mesh, start, end) == whole
    times = [candidate.ccd(start, end, mesh.edges, mesh.faces) for candidate in candidates]
    assert min(time for hit, time in times if hit) == pytest.approx(whole, abs=1e-8)
    candidates.build(mesh, start, 0.2)
    assert len(candidates) > 0
    candidates.clear()
    assert candidates.empty()


def test_edges_keep_the_callers_numbers(cubes):
    start, end, faces = cubes
    ours = ipc.CollisionMesh(start, faces=faces)
    shuffled = ipc.edges(faces)[np.random.default_rng(1).permutation(ours.num_edges)][:, ::-1]
    theirs = ipc.CollisionMesh(start, shuffled, faces)
    pairs = []
    for mesh in (ours, theirs):
        candidates = ipc.Candidates()
        candidates.build(mesh, start, end)
        ends = np.sort(mesh.edges[candidates.ee_candidates], axis=2)
        pairs.append({frozenset(map(tuple, pair.tolist())) for pair in ends})
    assert pairs[0] == pairs[1] != set()


def test_a_candidate_names_its_vertices(cubes):
    start, end, faces = cubes
    mesh = ipc.CollisionMesh(start, faces=faces)
    candidates = ipc.Candidates()
    candidates.build(mesh, start, end)
    edge_edge, face_vertex = candidates[0], candidates[len(candidates) - 1]
    assert isinstance(edge_edge, ipc.EdgeEdgeCandidate) and isinstance(face_vertex, ipc.FaceVertexCandidate)
    assert edge_edge.vertex_ids(mesh.edges, mesh.faces)[:2] == mesh.edges[edge_edge.edge0_id].tolist()
    assert face_vertex.vertex_ids(mesh.edges, mesh.faces) == [face_vertex.vertex_id, *mesh.faces[face_vertex.face_id]]
    with pytest.raises(IndexError, match="candidates"):
        candidates[len(candidates)]


def test_loose_edges_collide():
    start = np.array([[-1, 0, 1], [1, 0, 1], [0, -1, 0], [0, 1, 0]], float)
    end = start.copy()
    end[:2, 2] = -1.0
    mesh = ipc.CollisionMesh(start, [[0, 1], [2, 3]])
    assert (mesh.num_edges, mesh.num_faces) == (2, 0)
    assert ipc.compute_collision_free_stepsize(mesh, start, end) == pytest.approx(0.5, abs=1e-8)


@pytest.mark.parametrize("rule", [False, True], ids=["data", "function"])
def test_a_filter_is_asked(cubes, rule):
    start, end, faces = cubes
    mesh = ipc.CollisionMesh(start, faces=faces)
    body = np.arange(16) // 8
    mesh.can_collide = (lambda i, j: body[i] == body[j]) if rule else ipc.make_sparse_filter(
        {(a, b): False for a in range(8) for b in range(8, 16)}, True
    )
    assert ipc.is_step_collision_free(mesh, start, end)
    assert ipc.compute_collision_free_stepsize(mesh, start, end) == 1.0
    mesh.can_collide = (lambda i, j: body[i] != body[j]) if rule else ipc.make_connected_components_filter(faces)
    assert not ipc.is_step_collision_free(mesh, start, end)
    assert 0 < ipc.compute_collision_free_stepsize(mesh, start, end) < 1


FILTERS = {
    "all": ipc.CollisionFilter(),
    "function": ipc.CollisionFilter(lambda i, j: (i + j) % 3 == 0),
    "patches": ipc.make_vertex_patches_filter([0, 0, 7, 7, 2, 2]),
    "static": ipc.make_static_obstacle_filter(4),
    "components": ipc.make_connected_components_filter([[0, 1, 2], [3, 4, 5]]),
    "sparse": ipc.make_sparse_filter({(0, 1): False, (5, 2): False}, True),
    "sparse, none else": ipc.make_sparse_filter({(0, 1): True}, False),
}
MEANING = {
    "all": lambda i, j: True,
    "function": lambda i, j: (i + j) % 3 == 0,
    "patches": lambda i, j: i // 2 != j // 2,
    "static": lambda i, j: i < 4 or j < 4,
    "components": lambda i, j: i // 3 != j // 3,
    "sparse": lambda i, j: {i, j} not in ({0, 1}, {2, 5}),
    "sparse, none else": lambda i, j: {i, j} == {0, 1},
}


@pytest.mark.parametrize("one", FILTERS)
@pytest.mark.parametrize("other", FILTERS)
def test_filters_join(one, other):
    a, b, of_a, of_b = FILTERS[one], FILTERS[other], MEANING[one], MEANING[other]
    for i in range(6):
        for j in range(6):
            assert a(i, j) == of_a(i, j)
            assert (~a)(i, j) == (not of_a(i, j))
            assert (a & b)(i, j) == (of_a(i, j) and of_b(i, j))
            assert (a | b)(i, j) == (of_a(i, j) or of_b(i, j))


@pytest.mark.parametrize("one", FILTERS)
@pytest.mark.parametrize("other", FILTERS)
def test_the_detector_looks_at_what_a_filter_means(one, other):
    random = np.random.default_rng(0)
    start, end = random.uniform(-1, 1, (2, 6, 3))
    mesh = ipc.CollisionMesh(start, faces=[[0, 1, 2], [3, 4, 5]])
    both = FILTERS[one] & FILTERS[other]
    mesh.can_collide = both
    candidates = ipc.Candidates()
    candidates.build(mesh, start, end, 10.0)
    found = {tuple(pair) for pair in candidates.fv_candidates.tolist()}
    corners = {0: (0, 1, 2), 1: (3, 4, 5)}
    wanted = {
        (face, vertex)
        for face in (0, 1)
        for vertex in range(6)
        if vertex not in corners[face] and any(both(vertex, corner) for corner in corners[face])
    }
    assert found == wanted


def test_components_are_of_the_faces_and_every_other_vertex_is_its_own():
    filters = ipc.make_connected_components_filter([[0, 1, 2], [7, 8, 9]])
    assert not filters(0, 2) and not filters(7, 9)
    assert filters(0, 7) and filters(3, 4) and filters(0, 11) and filters(11, 12)
    # Two ropes beside the triangles, of vertices that no face has.
    start = np.random.default_rng(4).uniform(-1, 1, (14, 3))
    mesh = ipc.CollisionMesh(start, [[10, 11], [12, 13]] + ipc.edges([[0, 1, 2], [7, 8, 9]]).tolist(), [[0, 1, 2], [7, 8, 9]])
    mesh.can_collide = filters
    candidates = ipc.Candidates()
    candidates.build(mesh, start, 10.0)
    pairs = {frozenset(map(tuple, np.sort(mesh.edges[pair], axis=1).tolist())) for pair in candidates.ee_candidates}
    assert frozenset([(10, 11), (12, 13)]) in pairs and frozenset([(0, 1), (7, 8)]) in pairs


def test_large_numbers_of_vertices_take_no_memory():
    assert sorted(map(sorted, ipc.edges([[0, 1, 2**32 - 1]]).tolist())) == [[0, 1], [0, 2**32 - 1], [1, 2**32 - 1]]
    assert ipc.make_connected_components_filter([[0, 1, 2**32 - 1]])(2, 3)
    assert len(ipc.edges([])) == 0
    with pytest.raises(ValueError, match="no triangles"):
        ipc.make_connected_components_filter([])


def test_a_filter_is_for_the_mesh():
    mesh = ipc.CollisionMesh(np.zeros((6, 3)), faces=[[0, 1, 2], [3, 4, 5]])
    with pytest.raises(ValueError, match="for 3 vertices, but the mesh has 6"):
        mesh.can_collide = ipc.make_vertex_patches_filter([0, 1, 2])


def test_scalar_queries():
    down = ([0.2, 0.2, 1.0], [0.2, 0.2, -1.0])
    face = ([0, 0, 0], [1, 0, 0], [0, 1, 0])
    hit, time = ipc.point_triangle_ccd(down[0], *face, down[1], *face)
    assert hit and time == pytest.approx(0.5, abs=1e-8) and time <= 0.5
    assert ipc.point_triangle_ccd(down[0], *face, down[0], *face) == (False, float("inf"))
    assert ipc.point_triangle_ccd(down[0], *face, down[1], *face, tmax=0.4)[0] is False
    assert ipc.point_triangle_ccd(down[0], *face, down[1], *face, min_distance=0.5)[1] == pytest.approx(0.25, abs=1e-6)
    one, other = ([-1, 0, 1], [1, 0, 1], [-1, 0, -1], [1, 0, -1]), ([0, -1, 0], [0, 1, 0])
    assert ipc.edge_edge_ccd(*one[:2], *other, *one[2:], *other)[0]
    assert ipc.point_edge_ccd([0, 0, 1], [-1, 0, 0], [1, 0, 0], [0, 0, -1], [-1, 0, 0], [1, 0, 0])[0]
    assert ipc.point_point_ccd([0, 0, 1], [0, 0, 0], [0, 0, -1], [0, 0, 0])[0]
    assert not ipc.point_point_ccd([0, 0, 1], [0, 1, 0], [0, 0, -1], [0, 1, 0])[0]


def test_a_mesh_pickles(cubes):
    start, end, faces = cubes
    mesh = ipc.CollisionMesh(start, faces=faces)
    mesh.can_collide = ipc.make_connected_components_filter(faces)
    again = pickle.loads(pickle.dumps(mesh))
    assert ipc.compute_collision_free_stepsize(again, start, end) == ipc.compute_collision_free_stepsize(mesh, start, end)


def test_the_mesh_is_the_detectors():
    faces, start = two_sheets(6)
    end = start + np.random.default_rng(2).uniform(-0.2, 0.2, start.shape)
    earliest = Detector(faces, len(start)).earliest(start, end)
    assert earliest is not None
    assert ipc.compute_collision_free_stepsize(ipc.CollisionMesh(start, faces=faces), start, end) == earliest.time
