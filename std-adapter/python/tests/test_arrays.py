"""Scenes of meshes from arrays, and what threads may ask while another one runs steps."""

import inspect
import logging
import signal
import threading
import time

import numpy as np
import pytest

from selvedge import Detector, Simulation, errors, seam_rows


def sheet(cells: int = 10, size: float = 0.5, height: float = 0.0) -> dict:
    along = np.linspace(-size / 2, size / 2, cells + 1)
    x, y = np.meshgrid(along, along)
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    faces = [[first, first + 1, first + cells + 2], [first, first + cells + 2, first + cells + 1]]
    positions = np.stack([x.ravel(), y.ravel(), np.full(x.size, height)], axis=1)
    return {"positions": positions, "faces": np.concatenate([np.stack(corners, axis=1) for corners in faces])}


def cube(half: float = 0.1) -> dict:
    corners = np.array([[x, y, z] for x in (-half, half) for y in (-half, half) for z in (-half, half)])
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return {"positions": corners, "faces": np.array([[q[0], q[k], q[k + 1]] for q in quads for k in (1, 2)])}


CONTACT = {"gravity": {}, "self_collision": {"thickness": 0.004}, "body_contact": {"thickness": 0.004}}


def scene(cells: int = 10, **changes: object) -> dict:
    return {
        "cloth": sheet(cells, height=0.12) | {"name": "sheet", "material": "cotton"},
        "body": cube() | {"name": "cube", "driven": True},
        "effects": CONTACT,
    } | changes


def test_cloths_and_bodies_are_arrays():
    simulation = Simulation.from_dict(scene())
    given = sheet(height=0.12)["positions"]
    np.testing.assert_array_equal(simulation.positions[simulation.vertices_of_cloth("sheet")], given)
    np.testing.assert_array_equal(simulation.positions[simulation.body_vertices("cube")], cube()["positions"])
    simulation.advance()
    assert simulation.is_certified and simulation.steps is None
    assert (simulation.positions[simulation.vertices_of_cloth(0), 2] < 0.12).any()


def test_arrays_are_the_same_scene_as_a_file(tmp_path):
    mesh = sheet(height=0.12)
    lines = [f"v {x!r} {y!r} {z!r}\n" for x, y, z in mesh["positions"].tolist()]
    lines += [f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in mesh["faces"].tolist()]
    (tmp_path / "sheet.obj").write_text("".join(lines))
    of_file = Simulation.from_dict(
        scene(cloth={"shape": "file", "file": "sheet.obj", "name": "sheet", "material": "cotton"}), folder=tmp_path
    )
    of_arrays = Simulation.from_dict(scene())
    for simulation in (of_file, of_arrays):
        simulation.step(5)
    np.testing.assert_array_equal(of_file.positions, of_arrays.positions)


def test_a_place_and_a_unit_apply_to_arrays():
    mesh = sheet()
    moved = mesh | {"material": "cotton", "unit": "cm", "translation": [0, 0, 1]}
    simulation = Simulation.from_dict({"cloth": moved, "effects": {"gravity": {}}})
    np.testing.assert_allclose(simulation.positions, mesh["positions"] * 0.01 + [0, 0, 1])


def test_a_body_of_frames_deforms_by_itself():
    frames = [cube(0.1 + 0.01 * k)["positions"] for k in range(3)]
    body = {"name": "cube", "frames": np.array(frames), "faces": cube()["faces"], "frames_per_second": 10}
    simulation = Simulation.from_dict(scene(body=body))
    simulation.advance(0.05)
    expected = (frames[0] + frames[1]) / 2
    np.testing.assert_allclose(simulation.positions[simulation.body_vertices(0)], expected, atol=1e-9)


def test_a_garment_starts_in_another_shape_than_it_rests_in():
    mesh = sheet()
    worn = mesh["positions"] * [0.9, 0.9, 1]
    cloth = mesh | {"positions": worn, "rest_positions": mesh["positions"], "material": "cotton"}
    simulation = Simulation.from_dict({"cloth": cloth, "effects": {"stretch": {}}})
    np.testing.assert_array_equal(simulation.positions, worn)
    assert simulation.edge_stretch == pytest.approx((0.9, 0.9))
    width = np.ptp(simulation.positions[:, 0])
    for _ in range(20):
        simulation.advance()
    assert np.ptp(simulation.positions[:, 0]) > 1.05 * width


def test_a_rest_shape_of_a_file_needs_the_same_vertices(tmp_path):
    def write(name: str, mesh: dict) -> None:
        lines = [f"v {x} {y} {z}\n" for x, y, z in mesh["positions"].tolist()]
        (tmp_path / name).write_text("".join(lines + [f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in mesh["faces"].tolist()]))

    write("worn.obj", sheet(4, 0.4))
    write("flat.obj", sheet(4, 0.5))
    write("other.obj", sheet(5, 0.5))
    cloth = {"shape": "file", "file": "worn.obj", "rest_file": "flat.obj", "material": "cotton"}
    simulation = Simulation.from_dict({"cloth": cloth, "effects": {"stretch": {}}}, folder=tmp_path)
    assert simulation.edge_stretch == pytest.approx((0.8, 0.8))
    with pytest.raises(errors.SceneError, match="36 vertices, but the mesh has 25"):
        Simulation.from_dict({"cloth": cloth | {"rest_file": "other.obj"}, "effects": {"stretch": {}}}, folder=tmp_path)


def test_vertices_of_arrays_keep_their_numbers_or_are_refused():
    mesh = sheet()
    mesh["positions"] = np.concatenate([mesh["positions"], [[9.0, 9.0, 9.0]]])
    with pytest.raises(errors.SceneError, match=r"^cloth.mesh: vertex 121 of the mesh belongs to no face"):
        Simulation.from_dict(scene(cloth=mesh | {"material": "cotton"}))


def test_isolated_vertices_of_a_file_are_remarked_and_counted(tmp_path, caplog):
    (tmp_path / "a.obj").write_text("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n")
    cloth = {"shape": "file", "file": "a.obj", "name": "a", "density": 0.2}
    with caplog.at_level(logging.WARNING, "selvedge"):
        simulation = Simulation.from_dict({"cloth": cloth, "effects": {"gravity": {}}}, folder=tmp_path)
    assert "Isolated vertices" in simulation.remarks[0] and "Isolated vertices" in caplog.text
    assert simulation.vertices_of_cloth("a") == slice(0, 3, 1)
    np.testing.assert_array_equal(simulation.positions_of_cloth("a"), [[9, 9, 9], [0, 0, 0], [1, 0, 0], [0, 1, 0]])


def test_frames_are_logged(caplog):
    simulation = Simulation.from_dict(scene())
    with caplog.at_level(logging.DEBUG, "selvedge"):
        simulation.advance()
    assert "steps" in caplog.text


def test_messages_of_dicts_name_the_field():
    for change, message in [
        ({"effects": CONTACT | {"friction": {"coefficient": 30}}}, r"^effects\.friction\.coefficient: .*30"),
        ({"cloth": [sheet() | {"name": "a", "densty": 1}]}, r"^cloth\[0\]\.densty: .*density"),
        ({"cloth": {"positions": sheet()["positions"]}}, r"^cloth: .*faces"),
        ({"cloth": sheet() | {"shape": "file"}}, r"^cloth: .*shape"),
        ({"cloth": sheet()}, r"^cloth: .*density"),
    ]:
        with pytest.raises((errors.SceneError, errors.InputError), match=message):
            Simulation.from_dict(scene(**change))
    with pytest.raises(errors.SceneError, match="there is no mesh 'shirt'; meshes come from code"):
        Simulation.from_text('cloth = {shape = "mesh", mesh = "shirt", density = 1}')


def test_body_contact_waits_for_the_first_body():
    bare = scene()
    del bare["body"]
    for body in ({}, {"body": []}):
        Simulation.from_dict(bare | body).step()


def test_pins_may_be_a_mask():
    corner = np.zeros(121, bool)
    corner[[0, 10]] = True
    pins = {"group": [{"vertices": corner, "driven": True}]}
    simulation = Simulation.from_dict({"cloth": sheet() | {"material": "cotton"}, "effects": {"gravity": {}, "pins": pins}})
    before = simulation.positions.copy()
    simulation.advance()
    assert (simulation.positions[corner] == before[corner]).all() and (simulation.positions[~corner] != before[~corner]).any()


def test_what_is_not_driven_cannot_be_moved_and_the_message_says_how():
    body = {key: value for key, value in scene()["body"].items() if key != "driven"}
    with pytest.raises(errors.InputError, match="driven = true"):
        Simulation.from_dict(scene(body=body)).move_body("cube", cube()["positions"])


def test_a_pull_sets_velocities():
    simulation = Simulation.from_dict({"cloth": sheet() | {"material": "cotton"}, "effects": {"gravity": {"acceleration": [0, 0, 0]}}})
    everything = np.ones(121, bool)
    simulation.set_velocity(everything, [0, 0, 1])
    simulation.set_velocity([0, 1], [0, 0, 1])
    before = simulation.positions.copy()
    simulation.advance(0.1)
    np.testing.assert_allclose(simulation.positions[:, 2] - before[:, 2], 0.1, rtol=0.05)
    with pytest.raises(errors.InputError, match="121 vertices"):
        simulation.set_velocity(np.ones(3, bool), [0, 0, 1])


def test_pinned_vertices_of_a_tangled_start_are_named():
    pins = {"group": [{"ball": {"centre": [0, 0, 0.05], "radius": 0.06}}]}
    inside = scene(cloth=sheet(height=0.05) | {"material": "cotton"}, effects=CONTACT | {"pins": pins})
    with pytest.raises(errors.TangledError, match=r"pinned vert.* there \(\d+"):
        Simulation.from_dict(inside)
    with pytest.raises(errors.TangledError, match=r"(\d+) of \d+ edges still meet faces"):
        Simulation.from_dict(inside | {"tangled_start": "untangle"})


def test_others_read_progress_while_one_thread_runs_steps_and_cancel_it():
    simulation = Simulation.from_dict(scene(cells=40))
    seen, failed = [], []

    def run() -> None:
        try:
            while True:
                simulation.advance(0.5, most=400)
        except errors.CancelledError as error:
            failed.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    until = time.monotonic() + 60
    while len(set(seen)) < 3 and time.monotonic() < until:
        seen.append((simulation.progress, simulation.steps_done))
        assert simulation.name == "scene" and simulation.body_names == ["cube"] and simulation.cloth_vertex_count == 41**2
        assert simulation.vertices_of_cloth("sheet") == slice(0, 41**2, 1)
        time.sleep(0.002)
    while thread.is_alive():
        simulation.cancel()
        thread.join(0.01)
    assert len(set(seen)) >= 3 and len(failed) == 1
    done, of = simulation.progress
    assert 0 < done <= of
    simulation.cancel()
    simulation.advance()


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="the system has no timers")
def test_ctrl_c_stops_a_frame_after_a_step():
    simulation = Simulation.from_dict(scene(cells=60))
    former = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with pytest.raises(KeyboardInterrupt):
            while True:
                simulation.advance(1.0, most=2000)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, former)
    done, of = simulation.progress
    assert done < of and simulation.time > 0
    simulation.advance()


def test_intersections_have_faces_and_points():
    flat, upright = sheet(4, 1.0), sheet(4, 1.0)
    upright["positions"] = upright["positions"][:, [2, 0, 1]] * [1, 0.7, 0.7] + [0.03, 0.01, 0.02]
    faces = np.concatenate([flat["faces"], upright["faces"] + 25])
    detector = Detector(faces, 50)
    positions = np.concatenate([flat["positions"], upright["positions"]])
    for given in (positions, positions.astype(np.float32)):
        found = detector.intersections(given)
        assert len(found) == len(found.points) > 0
        np.testing.assert_allclose(found.points[:, 0], 0.03, atol=1e-6)
        np.testing.assert_allclose(found.points[:, 2], 0.0, atol=1e-6)
        assert (found.face_pairs[:, 0] < 32).all() and (found.face_pairs[:, 1] >= 32).all()
        np.testing.assert_array_equal(found.faces, np.unique(found.face_pairs))
        for one, other in found.face_pairs:
            alone = np.array([faces[one], faces[other]])
            assert Detector(alone, 50).has_intersections(given)
    assert detector.intersections(positions + np.eye(3)[2] * 3 * (np.arange(50) < 25)[:, None]).face_pairs.shape == (0, 2)


def test_loose_edges_draw_seams():
    one = sheet(3)["faces"]
    other = one + 16
    right, left = [3, 7, 11, 15], [16, 20, 24, 28]
    edges = [*zip(right, left), (0, 19)]
    rows = seam_rows(np.concatenate([one, other]), edges[::-1])
    assert sorted(len(a) for a, _ in rows) == [1, 4]
    first, second = max(rows, key=lambda row: len(row[0]))
    assert sorted([first, second], key=min) in ([right, left], [right[::-1], left[::-1]])
    # A tube and a smaller one around it.
    ring = [[k, (k + 1) % 6, 6 + k] for k in range(6)] + [[(k + 1) % 6, 6 + (k + 1) % 6, 6 + k] for k in range(6)]
    tubes = np.concatenate([ring, np.array(ring) + 12])
    ((first, second),) = seam_rows(tubes, [(6 + k, 12 + k) for k in range(6)])
    assert len(first) == 7 and first[0] == first[-1] and [b - a for a, b in zip(first, second)] in ([6] * 7, [-6] * 7)
    assert seam_rows(one, [(0, 1)]) == []


def test_help_is_that_of_the_stub():
    import ast
    from pathlib import Path

    import selvedge

    stub = ast.parse((Path(selvedge.__file__).parent / "_native.pyi").read_text())
    functions = [node for node in stub.body if isinstance(node, ast.FunctionDef)]
    assert len(functions) >= 4
    for node in functions:
        assert inspect.getdoc(getattr(selvedge, node.name)) == ast.get_docstring(node), node.name
    for name in ("Detector", "Simulation"):
        (node,) = (node for node in stub.body if isinstance(node, ast.ClassDef) and node.name == name)
        own = getattr(selvedge, name)
        assert inspect.getdoc(own).startswith(ast.get_docstring(node))
        seen = set()
        for method in node.body:
            if isinstance(method, ast.FunctionDef) and method.name not in seen and method.name != "__new__":
                seen.add(method.name)
                assert ast.get_docstring(method), f"{name}.{method.name} has no documentation"
                assert inspect.getdoc(getattr(own, method.name)) == ast.get_docstring(method), f"{name}.{method.name}"
        assert len(seen) > 20
