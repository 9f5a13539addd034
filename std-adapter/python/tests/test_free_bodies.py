"""Free rigid bodies: those of arrays, their motion, those of another engine, and what is wrong with them."""

import numpy as np
import pytest

from selvedge import FreeBodyState, Simulation, Wrench, errors

SIDES = np.array([0.1, 0.2, 0.3])
DENSITY = 500.0
GRAVITY = 9.81
CORNERS = np.array([[k & 1, k >> 1 & 1, k >> 2] for k in range(8)])
QUADS = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
# Each with two triangles that face outwards.
FACES = np.concatenate([QUADS[:, :3], QUADS[:, [0, 2, 3]]])


def box(centre: object = (0, 0, 0), **motion: object) -> dict:
    """A box of arrays around a centre."""
    return {"name": "box", "positions": SIDES * (CORNERS - 0.5) + centre, "faces": FACES, **motion}


def sheet(height: float) -> dict:
    corner, sides = [-0.2, -0.2, height], {"first": [0.4, 0, 0], "second": [0, 0.4, 0]}
    return {"name": "sheet", "shape": "sheet", "corner": corner, "sides": sides, "cells": [8, 8], "density": 0.15}


def scene(body: dict, height: float = 5.0, **effects: dict) -> dict:
    """A body and a sheet at a height."""
    thickness = {"thickness": 0.002}
    of_all = {"stretch": {"stiffness": 400}, "body_contact": thickness, "self_collision": thickness}
    return {"time_step": 0.002, "cloth": sheet(height), "body": [body], "effects": {**of_all, **effects}}


def masses(simulation: Simulation) -> np.ndarray:
    """The mass of each vertex of the sheet: a third of that of its triangles."""
    faces = simulation.faces[: simulation.cloth_face_count]
    a, b, c = simulation.positions[faces].swapaxes(0, 1)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return np.bincount(faces.ravel(), np.repeat(0.15 * areas / 3, 3))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_body_of_arrays_falls_by_gravity_and_its_placement_says_where_its_mesh_is(dtype: type):
    velocity, spin = np.array([1, 0, 2], dtype), np.array([3, 0, 0], dtype)
    body = box(density=np.float64(DENSITY), velocity=velocity, spin=spin)
    body["positions"] = body["positions"].astype(dtype)
    simulation = Simulation.from_dict(scene(body, gravity={}))
    mesh = simulation.positions[simulation.body_vertices("box")].copy()
    mass = DENSITY * SIDES.prod()
    before = simulation.body_motion("box")
    assert isinstance(before, FreeBodyState) and before.mass == pytest.approx(mass, rel=1e-6)
    np.testing.assert_allclose(before.spin, spin, atol=1e-12)
    # The text book's box, which turns about its axis x: m·(b² + c²)/12.
    np.testing.assert_allclose(before.angular_momentum, [mass * (SIDES[1] ** 2 + SIDES[2] ** 2) / 12 * 3, 0, 0], atol=1e-6)

    simulation.step(100)
    after = simulation.body_motion(0)
    np.testing.assert_allclose(after.velocity, velocity - [0, 0, GRAVITY * simulation.time], atol=1e-9)
    np.testing.assert_allclose(after.angular_momentum, before.angular_momentum, atol=1e-12)
    translation, rotation = simulation.placement("box")
    x, y, z, w = rotation
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    assert 2 * np.arccos(w) == pytest.approx(3 * simulation.time, abs=1e-3)
    np.testing.assert_allclose(simulation.positions[simulation.body_vertices("box")], mesh @ turn.T + translation, atol=1e-12)


def test_a_body_and_the_sheet_that_it_hits_keep_their_momentum():
    simulation = Simulation.from_dict(scene(box([0.05, 0.02, 0.16], mass=0.05, velocity=[0.3, 0, -2]), height=0.0))
    of_cloth = masses(simulation)

    def momentum() -> np.ndarray:
        body = simulation.body_motion("box")
        return body.mass * body.velocity + of_cloth @ simulation.velocities[: len(of_cloth)]

    before = momentum()
    np.testing.assert_allclose(before, [0.015, 0, -0.1], atol=1e-15)
    simulation.step(50)
    assert simulation.body_motion("box").velocity[2] > -1.9, "the sheet slows it down"
    np.testing.assert_allclose(momentum(), before, atol=1e-9 * np.linalg.norm(before))
    assert simulation.is_certified


def test_cloth_that_is_pinned_to_a_body_adds_to_its_mass():
    pins = {"group": [{"cloth": "sheet", "vertices": [40], "follow": "box"}]}
    alone = Simulation.from_dict(scene(box(mass=2)))
    carried = Simulation.from_dict(scene(box(mass=2), height=0.152, pins=pins))
    assert alone.body_motion("box").mass == 2
    assert carried.body_motion("box").mass == pytest.approx(2 + masses(alone)[40], abs=1e-12)


def test_the_load_on_a_body_that_flies_alone_is_zero():
    simulation = Simulation.from_dict(scene(box(mass=1), gravity={}))
    simulation.step(3)
    assert not simulation.body_load("box").total.force.any() and not simulation.contact_loads("box").pushes.any()


def test_other_bodies_have_no_motion_of_their_own():
    simulation = Simulation.from_dict(scene(box(driven=True)))
    assert simulation.body_motion("box") is None and simulation.placement("box") is not None
    resting = Simulation.from_dict(scene(box()))
    assert resting.body_motion(0) is None and resting.placement(0) is None
    with pytest.raises(errors.InputError, match="there is no body 'bax'; the scene has"):
        resting.body_motion("bax")
    with pytest.raises(errors.InputError, match="there is no body 1; the scene has 1"):
        resting.body_motion(1)


@pytest.mark.parametrize(
    ("motion", "message"),
    [
        ({"mass": 0}, r"^body\[0\]\.mass: .*0 kg, but must be from"),
        ({"mass": "1 parsec"}, r"^body\[0\]\.mass: .*parsec"),
        ({"mass": np.nan}, r"^body\[0\]\.mass: .*NaN"),
        ({"mass": 1, "density": 500}, r"^body\[0\]\.density: a body has `mass` or `density`, not both"),
        ({"velocity": [0, 0, 1]}, r"^body\[0\]\.velocity: .*it needs `mass` or `density`"),
        ({"mass": 1, "velocity": [0, 0]}, r"^body\[0\]\.velocity: "),
        ({"mass": 1, "spin": [0, 0, np.inf]}, r"^body\[0\]\.spin\[2\]: .*inf rad/s"),
        ({"mass": 1, "driven": True}, r"^body\[0\]\.driven: a free body has no `driven`: it moves by itself"),
        ({"density": 500, "faces": FACES[:-1]}, r"^body\[0\]\.density: the mesh has open edges.*give its `mass`"),
    ],
)
def test_a_wrong_free_body_is_named_by_its_field(motion: dict, message: str):
    with pytest.raises(errors.SceneError, match=message):
        Simulation.from_dict(scene(box(**motion)))


def test_a_free_body_cannot_be_moved_by_hand_nor_held_softly():
    simulation = Simulation.from_dict(scene(box(mass=1)))
    with pytest.raises(errors.InputError, match="cannot be moved by hand"):
        simulation.place_body("box")
    soft = {"group": [{"cloth": "sheet", "vertices": [0], "follow": "box", "stiffness": 10}]}
    with pytest.raises(errors.SceneError, match="soft pins cannot follow 'box', which moves freely"):
        Simulation.from_dict(scene(box(mass=1), pins=soft))


def test_a_free_body_teleports_and_keeps_its_motion():
    simulation = Simulation.from_dict(scene(box(mass=1, velocity=[0, 0, 1], spin=[0, 0, 2])))
    before = simulation.body_motion("box")
    half_turn = [1, 0, 0, 0]
    simulation.teleport(["box"], [3, 0, 0], half_turn)
    after = simulation.body_motion("box")
    np.testing.assert_allclose(after.centre, before.centre + [3, 0, 0], atol=1e-12)
    np.testing.assert_allclose([after.velocity, after.spin], [[0, 0, -1], [0, 0, -2]], atol=1e-12)


class Engine:
    """An engine with a ball that does not turn. It knows gravity alone."""

    def __init__(self, simulation: Simulation, mass: float) -> None:
        self.simulation, self.mass = simulation, mass
        self.translation, self.rotation, self.velocity = np.zeros(3), [0, 0, 0, 1], np.zeros(3)

    def advance(self, seconds: float) -> None:
        self.velocity = self.velocity - [0, 0, GRAVITY * seconds]
        self.translation = self.translation + self.velocity * seconds
        self.simulation.bring_body("ball", self.translation, self.rotation, self.velocity, [0, 0, 0])
        self.simulation.advance(seconds)
        self.translation, self.rotation = self.simulation.placement("ball")
        self.velocity = self.velocity + self.simulation.proxy_load("ball").force * (seconds / self.mass)


# The sheet weighs 24 g.
@pytest.mark.parametrize("mass", [0.02, 0.2])
def test_a_ball_of_another_engine_rests_in_a_held_sheet_and_feels_its_weight(mass: float):
    ball = {"name": "ball", "shape": "ball", "centre": [0, 0, 0.06], "radius": 0.05, "around": 16, "mass": mass, "proxy": True}
    pins = {"group": [{"part": part} for part in ("left", "right", "bottom", "top")]}
    simulation = Simulation.from_dict(scene(ball, height=0.0, pins=pins, gravity={}, shear={"stiffness": 80}, friction={"coefficient": 0.3}))
    engine = Engine(simulation, mass)
    for _ in range(300):
        engine.advance(1 / 60)
    forces, places = [], [engine.translation]
    for _ in range(60):
        engine.advance(1 / 60)
        load = simulation.proxy_load("ball")
        assert isinstance(load, Wrench)
        forces.append(load.force)
        places.append(engine.translation)
    # What bears its weight, and moves it as its places say: it swings a little.
    ways = np.diff(places, axis=0)
    faster = (ways[-1] - ways[0]) * 60 * 60 / 59
    np.testing.assert_allclose(np.mean(forces, axis=0), mass * (np.array([0, 0, GRAVITY]) + faster), atol=1e-3 * mass * GRAVITY)
    np.testing.assert_allclose(engine.translation, places[0], atol=1e-3)
    assert simulation.is_certified


def test_what_cannot_be_brought_is_refused_and_named():
    simulation = Simulation.from_dict(scene(box(mass=1, proxy=True)))
    nowhere = [0, 0, 0]
    for action in (simulation.place_body, lambda body: simulation.teleport([body], [np.nan, 0, 0])):
        with pytest.raises(errors.InputError):
            action("box")
    with pytest.raises(errors.InputError, match="velocity"):
        simulation.bring_body("box", nowhere, [0, 0, 0, 1], [0, 0, np.nan], nowhere)
    with pytest.raises(errors.InputError, match="spin"):
        simulation.bring_body("box", nowhere, [0, 0, 0, 1], nowhere, [1e9, 0, 0])
    with pytest.raises(errors.InputError, match="there is no body 'bax'"):
        simulation.bring_body("bax", nowhere, [0, 0, 0, 1], nowhere, nowhere)
    with pytest.raises(errors.InputError, match="there is no body 1"):
        simulation.proxy_load(1)
    before = simulation.positions.copy()
    simulation.bring_body("box", [1, 0, 0], [0, 0, 0, 1], nowhere, nowhere)
    with pytest.raises(errors.BlockedError, match="'box'.* 500 m/s"):
        simulation.step()
    np.testing.assert_array_equal(simulation.positions, before)

    other = Simulation.from_dict(scene(box(mass=1)))
    assert other.proxy_load("box") is None
    with pytest.raises(errors.InputError, match="the body 'box' is not a proxy"):
        other.bring_body("box", nowhere, [0, 0, 0, 1], nowhere, nowhere)
