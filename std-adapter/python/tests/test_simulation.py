"""Simulations of cloth."""

import numpy as np
import pytest

from selvedge import ARM_SLEEVE, Crossings, NearPairs, Release, Simulation, TornEdge, errors


@pytest.fixture
def sleeve() -> Simulation:
    return Simulation.from_text(ARM_SLEEVE)


def test_positions_are_a_view_of_what_is_now(sleeve):
    positions = sleeve.positions
    assert positions.shape[1] == 3 and positions.dtype == np.float64
    assert sleeve.positions is positions
    before = positions.copy()
    sleeve.step(5)
    assert sleeve.steps_done == 5 and sleeve.time == pytest.approx(5 * sleeve.time_step)
    assert (positions != before).any()
    with pytest.raises(ValueError):
        positions[0, 0] = 1.0


def test_faces_are_the_cloths_first(sleeve):
    assert sleeve.faces[: sleeve.cloth_face_count].max() == sleeve.cloth_vertex_count - 1
    assert sleeve.faces.max() == len(sleeve.positions) - 1


def test_every_state_is_certified(sleeve):
    for _ in range(5):
        sleeve.step()
        assert sleeve.is_certified
    assert sleeve.blocked_steps == 0 and sleeve.lag == 0.0
    typical, largest = sleeve.edge_stretch
    assert 0.9 < typical <= largest < 1.2
    assert set(sleeve.effect_seconds) >= {"gravity", "stretch"}


def test_a_frame_takes_as_many_steps_as_the_cloth_needs(sleeve):
    steps, needed = sleeve.advance(1 / 60)
    assert 4 <= steps == needed and sleeve.time == pytest.approx(1 / 60)
    assert sleeve.advance(1 / 60, most=2)[0] == 2
    before = sleeve.time
    sleeve.advance()
    assert sleeve.time - before == pytest.approx(sleeve.steps_per_frame * sleeve.time_step)
    assert sleeve.overstretched_steps == 0
    for seconds in (0, 2, float("nan")):
        with pytest.raises(errors.InputError):
            sleeve.advance(seconds)


def test_a_step_that_is_too_long_for_the_limit_warns():
    long = Simulation.from_dict(
        {
            "time_step": "16 ms",
            "duration": "1 s",
            # Thrown at 20 m/s, it moves by seven edges in a step.
            "cloth": {
                "shape": "sheet",
                "cells": [20, 20],
                "density": 0.15,
                "sides": {"first": [1, 0, 0], "second": [0, 1, 0]},
                "velocity": [0, 0, 20],
            },
            "effects": {
                "gravity": {},
                "stretch": {"stiffness": 100},
                "strain_limit": {"limit": 1.0},
                "pins": {"group": [{"part": "bottom-left"}]},
            },
        }
    )
    with pytest.warns(RuntimeWarning, match="above its limit"):
        long.step(60)
    assert long.overstretched_steps > 0


def test_it_goes_on_from_a_checkpoint_with_the_same_bits(sleeve):
    sleeve.step(200)
    checkpoint = sleeve.checkpoint()
    assert checkpoint is not None
    sleeve.step(3)
    assert sleeve.checkpoint() is None
    again = Simulation.from_text(ARM_SLEEVE, 2)
    again.resume(checkpoint)
    assert again.steps_done == 200
    again.step(3)
    np.testing.assert_array_equal(again.positions, sleeve.positions)
    with pytest.raises(errors.CheckpointError):
        again.resume(checkpoint[:100])
    with pytest.raises(errors.CheckpointError):
        again.resume(b"nonsense")


def test_a_scene_said_in_python_is_that_of_its_file(tmp_path):
    text = """
    name = "drop"
    time_step = "2 ms"
    duration = "0.1 s"
    [cloth]
    shape = "sheet"
    corner = [-0.15, 0.2, -0.15]
    sides = { first = [0.3, 0, 0], second = [0, 0, 0.3] }
    cells = [10, 10]
    density = "150 g/m2"
    [[body]]
    name = "ball"
    shape = "ball"
    centre = [0, 0, 0]
    radius = "80 mm"
    [effects.gravity]
    acceleration = [0, -9.81, 0]
    [effects.stretch]
    stiffness = "400 N/m"
    """
    said = {
        "name": "drop",
        "time_step": "2 ms",
        "duration": np.float64(0.1),
        "cloth": {
            "shape": "sheet",
            "corner": np.array([-0.15, 0.2, -0.15]),
            "sides": {"first": [0.3, 0, 0], "second": (0, 0, 0.3)},
            "cells": (10, 10),
            "density": "150 g/m2",
        },
        "body": [{"name": "ball", "shape": "ball", "centre": [0, 0, 0], "radius": "80 mm"}],
        "effects": {"gravity": {"acceleration": [0, -9.81, 0]}, "stretch": {"stiffness": "400 N/m"}},
    }
    file = tmp_path / "drop.toml"
    file.write_text(text)
    simulations = [Simulation(file), Simulation(str(file)), Simulation.from_text(text), Simulation.from_dict(said)]
    for simulation in simulations:
        assert simulation.steps == 50
        simulation.step(3)
        np.testing.assert_array_equal(simulation.positions, simulations[0].positions)


def test_a_rope_said_in_python_hangs_in_a_wind_by_its_loose_edges():
    rope = {
        "name": "rope",
        "time_step": "2 ms",
        "duration": "1 s",
        "cloth": {"shape": "rope", "points": [[0, 0, 0], [1, 0, 0]], "segments": 20, "linear_density": "50 g/m"},
        "effects": {
            "gravity": {},
            "rope_stretch": {"stiffness": "10 kN"},
            "pins": {"group": [{"part": "start"}]},
            "wind": {"velocity": [0, 10, 0], "rope_diameter": "8 mm"},
        },
    }
    simulation = Simulation.from_dict(rope)
    assert simulation.faces.shape == (0, 3)
    edges = simulation.loose_edges
    assert edges.shape == (20, 2) and edges.dtype == np.uint32
    simulation.step(100)
    lengths = np.linalg.norm(np.diff(simulation.positions[edges], axis=1), axis=2)
    np.testing.assert_allclose(lengths, 0.05, rtol=1e-3)
    assert simulation.positions[-1, 1] > 0.05 and simulation.positions[-1, 2] < -0.1


def test_what_is_wrong_in_a_dict_is_named_by_its_field():
    with pytest.raises(errors.SceneError, match="^time_step: .*parsec"):
        Simulation.from_dict({"name": "x", "time_step": "1 parsec"})


def over_a_ball() -> dict:
    """A sheet with pinned corners over a ball that Python moves."""
    return {
        "time_step": 0.002,
        "duration": 10,
        "cloth": {
            "shape": "sheet",
            "corner": [-0.15, -0.15, 0.075],
            "sides": {"first": [0.3, 0, 0], "second": [0, 0.3, 0]},
            "cells": [12, 12],
            "density": 0.2,
        },
        "body": [{"name": "ball", "shape": "ball", "centre": [0, 0, 0], "radius": 0.06, "driven": True}],
        "effects": {
            "gravity": {},
            "wind": {"velocity": [0, 0, 0]},
            "stretch": {"stiffness": 200},
            "pins": {"group": [{"part": "left", "driven": True}]},
            "body_contact": {"thickness": 0.004},
            "self_collision": {"thickness": 0.004},
        },
    }


def test_bodies_pins_and_wind_go_where_python_leads_them():
    simulation = Simulation.from_dict(over_a_ball())
    assert simulation.body_names == ["ball"]
    ball = simulation.body_vertices("ball")
    rest = simulation.positions[ball].copy()
    left = simulation.positions[0 : 13 * 13 : 13].copy()
    for step in range(1, 41):
        simulation.place_body("ball", [0, 0, 0.0005 * step], [0, 0, 1, 1])
        simulation.move_pins(0, left + [0, 0, 0.001 * step])
        simulation.set_wind(np.array([0, 1, 0]))
        simulation.step()
        assert simulation.is_certified
    translation, rotation = simulation.placement(0)
    assert translation == [0, 0, 0.02] and rotation == pytest.approx([0, 0, 0.5**0.5, 0.5**0.5])
    turned = np.stack([-rest[:, 1], rest[:, 0], rest[:, 2] + 0.02], 1)
    np.testing.assert_allclose(simulation.positions[ball], turned, atol=1e-14)
    np.testing.assert_allclose(simulation.positions[0 : 13 * 13 : 13], left + [0, 0, 0.04], atol=1e-15)
    assert simulation.velocities[: 13 * 13, 1].mean() != 0
    np.testing.assert_allclose(np.linalg.norm(simulation.normals, axis=1), 1)
    simulation.move_body(0, (turned * 1.01).astype(np.float32))
    simulation.step()
    assert simulation.placement("ball") is None
    np.testing.assert_array_equal(simulation.positions[ball], (turned * 1.01).astype(np.float32))


STIFFNESS = 50.0


def on_soft_pins(weights: object, stiffness: float = STIFFNESS) -> dict:
    """The corners of a sheet, on soft pins that Python moves."""
    scene = over_a_ball()
    corners = {"vertices": np.array([0, 12, 156, 168]), "stiffness": stiffness, "weights": weights, "driven": True}
    scene["effects"] = {"gravity": {}, "air_drag": {"rate": 10}, "stretch": {"stiffness": 200}, "pins": {"group": [corners]}}
    return scene


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_soft_pins_yield_by_force_over_stiffness_and_go_where_python_leads_them(dtype: type):
    weights = np.array([1, 1, 0.5, 0.5], dtype)
    simulation = Simulation.from_dict(on_soft_pins(weights))
    corners = [0, 12, 156, 168]
    start = simulation.positions[corners].copy()
    weight = 0.2 * 0.3**2 * 9.81
    for step in range(1, 1501):
        simulation.move_pins(0, start + [0, 0, 0.05 * min(step, 250) / 250])
        simulation.step()
    pulls = (start + [0, 0, 0.05] - simulation.positions[corners]) * (STIFFNESS * weights[:, None])
    load = simulation.pin_load(0).force
    np.testing.assert_allclose(pulls.sum(0), [0, 0, weight], atol=1e-3 * weight)
    np.testing.assert_allclose(load, [0, 0, -weight], atol=1e-3 * weight)


@pytest.mark.parametrize(
    ("weights", "stiffness", "message"),
    [
        ([1, 1, np.nan, 1], 1.0, r"effects\.pins\.group\[0\]\.weights.*NaN, but must be from 0 to 1"),
        ([1, 1, 1.5, 1], 1.0, r"effects\.pins\.group\[0\]\.weights.*1\.5, but must be from 0 to 1"),
        ([1, 1], 1.0, r"effects\.pins\.group\[0\]\.weights: `weights` has 2 numbers for 4 vertices"),
        ([1, 1, 1, 1], -1.0, r"effects\.pins\.group\[0\]\.stiffness.*-1 N/m, but must be from"),
    ],
)
def test_wrong_soft_pins_are_named_by_their_field(weights: list, stiffness: float, message: str):
    with pytest.raises(errors.SceneError, match=message):
        Simulation.from_dict(on_soft_pins(weights, stiffness))


def test_a_body_that_jumps_is_refused_and_a_teleport_takes_the_cloth_along():
    simulation = Simulation.from_dict(over_a_ball())
    simulation.step(5)
    before = simulation.positions.copy()
    simulation.place_body("ball", [50, 0, 0])
    with pytest.raises(errors.BlockedError, match="the body 'ball' is to move at 25000 m/s at 0.01"):
        simulation.step()
    np.testing.assert_array_equal(simulation.positions, before)
    with pytest.raises(errors.InputError, match="no cloth 'cape'"):
        simulation.teleport(["ball"], [50, 0, 0], cloths=["cape"])
    simulation.teleport(["ball"], [50, 0, 0], cloths=["cloth"])
    np.testing.assert_allclose(simulation.positions, before + [50, 0, 0], atol=1e-12)
    simulation.step(5)
    assert simulation.is_certified and np.linalg.norm(simulation.velocities, axis=1).max() < 1


def test_near_pairs_say_where_the_cloth_nearly_touches():
    simulation = Simulation.from_dict(over_a_ball())
    assert len(simulation.near_pairs) == 0
    ball = simulation.body_vertices("ball")
    for step in range(1, 81):
        simulation.place_body("ball", [0, 0, 0.0005 * step])
        simulation.step()
    near = simulation.near_pairs
    assert len(near) > 0 and isinstance(near, NearPairs)
    assert near.vertices.shape == near.weights.shape == (len(near), 4) and near.normals.shape == (len(near), 3)
    for sign in (1, -1):
        np.testing.assert_allclose(np.where(near.weights * sign > 0, near.weights, 0).sum(axis=1), sign)
    np.testing.assert_allclose(np.linalg.norm(near.normals, axis=1), 1)
    assert (near.thickness > 0).all() and (near.thickness < 0.0041).all()
    # From the second side to the first, in a motion of half a millimetre a step.
    ways = np.einsum("ij,ijk->ik", near.weights, simulation.positions[near.vertices])
    apart = np.einsum("ij,ij->i", ways, near.normals)
    assert (apart > 0).all() and (apart < 0.008).all()
    assert (near.vertices >= ball.start).any()
    counts, seconds = simulation.contact_counts, simulation.contact_seconds
    assert counts["candidates"] >= counts["looked_at"] >= 0 and counts["pushed"] >= len(near)
    assert list(seconds) == ["candidates", "constraints", "certificates", "repairs"] and min(seconds.values()) >= 0


def test_what_attachments_let_go_of_is_told():
    scene = over_a_ball()
    held = {"part": "left", "limit": 0.02}
    scene["effects"] = {"gravity": {}, "stretch": {"stiffness": 200}, "attachments": {"group": [held]}}
    simulation = Simulation.from_dict(scene)
    assert simulation.released == []
    simulation.step(100)
    released = simulation.released
    assert released and all(isinstance(release, Release) for release in released)
    for group, vertex, time in released:
        assert group == 0 and vertex % 13 == 0 and 0 <= time < simulation.time


def test_cloth_that_tears_has_more_vertices_and_says_what_tore():
    scene = over_a_ball()
    held = [{"part": "left"}, {"part": "right", "keyframes": [{"time": 0}, {"time": 0.05, "translation": [0.1, 0, 0]}]}]
    scene["effects"] = {
        "pins": {"group": held},
        "stretch": {"stiffness": 200},
        "self_collision": {"thickness": 1e-3},
        "tearing": {"strength": 20},
    }
    simulation = Simulation.from_dict(scene)
    before, faces = simulation.positions, simulation.faces
    assert simulation.torn_edges == []
    simulation.step(60)
    torn = simulation.torn_edges
    assert torn and all(isinstance(edge, TornEdge) and edge.load > 20 and edge.cloth == 0 for edge in torn)
    assert len(simulation.positions) > len(before) and simulation.positions is simulation.positions
    assert simulation.faces.shape == faces.shape and (simulation.faces != faces).any()
    assert simulation.is_certified


def through_a_ball(tangled_start: str) -> dict:
    scene = over_a_ball()
    scene["cloth"]["corner"] = [-0.15, -0.15, 0.03]
    del scene["effects"]["pins"]
    return scene | {"tangled_start": tangled_start}


def test_a_tangled_start_says_where():
    with pytest.raises(errors.TangledError, match="intersection") as caught:
        Simulation.from_dict(through_a_ball("refuse"))
    crossings = caught.value.crossings
    assert isinstance(caught.value, errors.SceneError) and caught.value.untangled is None
    assert isinstance(crossings, Crossings) and len(crossings) > 10
    assert crossings.edges.shape == (len(crossings), 2) and crossings.faces.shape == (len(crossings), 3)
    assert (crossings.bodies == 0).all()
    np.testing.assert_allclose(crossings.points[:, 2], 0.03, atol=1e-12)

    tolerant = Simulation.from_dict(through_a_ball("tolerate"))
    np.testing.assert_array_equal(tolerant.crossings.edges, crossings.edges)
    np.testing.assert_array_equal(tolerant.crossings.points, crossings.points)
    assert tolerant.tolerated_pairs > len(crossings) and not tolerant.is_certified and tolerant.untangled is None

    untangled = Simulation.from_dict(through_a_ball("untangle"))
    done = untangled.untangled
    assert done is not None and untangled.is_certified
    assert done.crossings == len(crossings) and done.left == 0 and done.steps > 0 and done.seconds > 0
    assert done.farthest > 0.01 and 1 <= done.edge_stretch[0] <= done.edge_stretch[1] < 2
    assert len(untangled.crossings) == 0 and untangled.tolerated_pairs == 0


def test_without_a_contact_effect_nothing_is_near_and_nothing_counted():
    scene = over_a_ball()
    del scene["effects"]["body_contact"], scene["effects"]["self_collision"]
    simulation = Simulation.from_dict(scene)
    simulation.step()
    assert len(simulation.near_pairs) == 0 and not simulation.is_certified
    assert simulation.contact_counts is None and simulation.contact_seconds is None


def test_what_cannot_be_moved_is_told(sleeve):
    simulation = Simulation.from_dict(over_a_ball())
    for action, words in [
        (lambda: simulation.place_body("bal", [0, 0, 0]), "no body 'bal'"),
        (lambda: simulation.place_body(3), "no body 3"),
        (lambda: simulation.place_body(0, [0, 0, 1e9]), "`translation` is 1e9 m"),
        (lambda: simulation.place_body(0, rotation=[0, 0, 0, 0]), "`rotation` must be a quaternion"),
        (lambda: simulation.move_body(0, [[0, 0, 0]]), "1 positions were given for"),
        (lambda: simulation.move_body(0, np.full((5, 2), 0.0)), "shape"),
        (lambda: simulation.move_pins(1, [[0, 0, 0]]), "no group 1 of pins"),
        (lambda: simulation.set_wind([0, 0, float("nan")]), "`velocity` is NaN"),
        (lambda: sleeve.set_wind([0, 0, 1]), "no wind"),
        (lambda: sleeve.place_body(0), "cannot be moved by hand"),
    ]:
        with pytest.raises(errors.InputError, match=words):
            action()
    for wrong in ([0, 0], "abc", None):
        with pytest.raises((TypeError, ValueError)):
            simulation.set_wind(wrong)


RESTING = """
time_step = 0.004
[[body]]
name = "table"
shape = "ball"
centre = [0, 0, -1]
radius = 1
around = 24
[cloth]
shape = "sheet"
corner = [-0.1, -0.1, 0.0055]
sides = { first = [0.2, 0, 0], second = [0, 0.2, 0] }
cells = [6, 6]
density = 0.15
[effects.gravity]
[effects.stretch]
stiffness = 400
[effects.friction]
coefficient = 0.5
[effects.self_collision]
thickness = 0.005
[effects.body_contact]
thickness = 0.005
[[effects.pins.group]]
vertices = [0]
"""


def test_a_body_and_pins_carry_the_weight_of_the_cloth():
    simulation = Simulation.from_text(RESTING)
    weight = 0.2 * 0.2 * 0.15 * 9.81
    assert (simulation.body_load("table").total.force == 0).all()
    for _ in range(40):
        simulation.advance(1 / 60)
    body, pins = simulation.body_load("table", mean=True), simulation.pin_load(0, mean=True)
    np.testing.assert_allclose(body.total.force + pins.force, [0, 0, -weight], atol=1e-3 * weight)
    contacts = simulation.contact_loads(0)
    assert len(contacts) > 10 and contacts.vertices.shape == (len(contacts), 4)
    about = np.array([0.3, 0.0, 0.1])
    here = simulation.body_load("table", about)
    np.testing.assert_allclose(contacts.pushes.sum(axis=0), here.contact.force, atol=1e-12)
    np.testing.assert_allclose(np.cross(contacts.points - about, contacts.frictions).sum(axis=0), here.friction.torque, atol=1e-12)
    assert np.linalg.norm(simulation.unbalanced_force) < 1e-3 * weight
    for wrong in (lambda: simulation.pin_load(1), lambda: simulation.attachment_load(0), lambda: simulation.body_load("chair")):
        with pytest.raises(errors.InputError):
            wrong()


def test_forces_act_for_one_frame():
    simulation = Simulation.from_text(RESTING)
    simulation.add_force([0], [0, 3, 0])
    simulation.advance(0.01)
    assert simulation.pin_load(0).force[1] == pytest.approx(3, abs=0.1)
    simulation.advance(0.01)
    assert abs(simulation.pin_load(0).force[1]) < 0.1
    simulation.add_force([1, 2], [[0, 0, 1.0], [0, 0, 2.0]])
    before = simulation.positions.copy()
    simulation.advance(0.01)
    assert (simulation.positions[[1, 2], 2] > before[[1, 2], 2] + 1e-3).all()
    with pytest.raises(errors.InputError, match="2 forces were given for 1 vertices"):
        simulation.add_force([1], [[0, 0, 1.0], [0, 0, 2.0]])
    with pytest.raises(errors.InputError):
        simulation.add_force([1], [0, 0, float("nan")])
