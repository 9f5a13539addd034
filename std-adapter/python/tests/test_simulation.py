"""Cloth, step by step."""

import numpy as np
import pytest

from selvedge import ARM_SLEEVE, Simulation, errors


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


def test_what_is_wrong_in_a_dict_is_named_by_its_line():
    with pytest.raises(errors.SceneError, match="scene.toml:2:.*parsec"):
        Simulation.from_dict({"name": "x", "time_step": "1 parsec"})
