"""Mesh files and merged vertices: the file's numbers, what was not read, and messages that name the place."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import selvedge
from selvedge import errors

SEAM = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\nl 2 6\n"


def test_a_file_is_read_with_its_numbers(tmp_path):
    path = tmp_path / "seam.obj"
    path.write_text(SEAM)
    mesh = pickle.loads(pickle.dumps(selvedge.read_mesh(path)))
    assert mesh.faces.tolist() == [[0, 1, 2], [3, 4, 5]] and mesh.edges.tolist() == [[1, 5]]
    assert mesh.positions.shape == (6, 3) and mesh.missing is None
    assert selvedge.Detector(mesh.faces, len(mesh.positions)).has_intersections(mesh.positions)
    once = selvedge.read_mesh(path, weld=0)
    assert once.faces.tolist() == [[0, 1, 2], [0, 2, 5]] and "2 vertices merged" in once.notes
    path.write_text(SEAM + "surf 0 1 0 1 1 2 3\n")
    assert selvedge.read_mesh(path).missing == "1 line 'surf' (line 10)"


def test_vertices_in_one_place_are_merged_with_the_way_back():
    positions = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0], [1, 1, 1e-7], [0, 1, 0]], np.float32)
    faces = [[0, 1, 2], [3, 4, 5]]
    mesh = selvedge.welded(positions, faces)
    assert mesh.vertex_of.tolist() == [0, 1, 2, 0, 3, 4] and (mesh.positions[mesh.vertex_of] == positions).all()
    assert selvedge.welded(positions, faces, 1e-6).faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    with pytest.raises(errors.InputError, match="names vertex 6, but there are 6"):
        selvedge.welded(positions, [[0, 1, 6]])
    with pytest.raises(errors.InputError, match="tolerance is -1, but must be a distance, 0 or more"):
        selvedge.welded(positions, faces, -1)


def test_a_welded_cloth_has_its_files_numbers_back(tmp_path):
    (tmp_path / "seam.obj").write_text(SEAM.replace("l 2 6\n", ""))
    cloth = {"shape": "file", "file": "seam.obj", "weld": 0, "density": 0.1}
    scene = {"time_step": 0.01, "duration": 1, "cloth": cloth, "effects": {"gravity": {}}}
    simulation = selvedge.Simulation.from_dict(scene, folder=tmp_path)
    simulation.step()
    now = simulation.mesh_in_files()
    assert now.faces.tolist() == [[0, 1, 2], [3, 4, 5]] and now.edges.shape == (0, 2)
    assert now.number_of.tolist() == [0, 1, 2, 5] and (now.positions[now.number_of] == simulation.positions).all()
    assert (now.positions[[3, 4]] == now.positions[[0, 2]]).all() and now.positions[0, 2] < 0


def nonsense():
    """Each file's name, its bytes, and the message about it, which follows the name."""
    table = Path(__file__).parents[2] / "files" / "tests" / "nonsense" / "table.txt"
    for row in table.read_text().splitlines():
        if not row.startswith("#"):
            name, content, message = row.split(" | ")
            yield name, content.encode().decode("unicode_escape").encode("latin-1"), message


@pytest.mark.parametrize(("name", "content", "message"), list(nonsense()))
def test_nonsense_is_refused_with_the_place_and_what_was_found(tmp_path, name, content, message):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(errors.InputError) as refused:
        selvedge.read_mesh(path)
    assert str(refused.value) == f"{path}: {message}"
    scene = {"time_step": 0.001, "duration": 1, "cloth": {"shape": "file", "file": str(path), "density": 0.2}, "effects": {}}
    with pytest.raises(errors.SceneError) as refused:
        selvedge.Simulation.from_dict(scene)
    assert str(refused.value).endswith(f"{path}: {message}")
