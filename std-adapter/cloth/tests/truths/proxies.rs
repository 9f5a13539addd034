//! Proxies: bodies of another engine that yield to cloth.

use crate::bodies::{DENSITY, G, THICKNESS, aside, ball, of_mass, scene, sheet};
use crate::loads::{PACES, Pace};
use crate::{contact, masses, momenta};
use selvedge_cloth::effects::{BodyContact, Gravity, PinGroup, PinMotion, Pins, RopeStretch, Thickness};
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{
    Body, BodyMotion, BroughtBody, CHECKPOINT_STEPS, Cloth, DriveError, FreeMotion, Placement, Scene, Simulation,
};

/// An engine with a ball: it knows gravity, and a floor which takes back a fifth of a penetration in each part of a step.
struct Engine {
    mass: f64,
    radius: f64,
    gravity: f64,
    /// The least height of the centre.
    floor: f64,
    /// The parts of a step, as some engines make them.
    parts: u32,
    /// The centre of the mesh at rest.
    middle: DVec3,
    at: Placement,
    velocity: DVec3,
    spin: DVec3,
}

impl Engine {
    fn new(mass: f64, radius: f64, at: DVec3) -> Self {
        Self {
            mass,
            radius,
            gravity: G,
            floor: f64::NEG_INFINITY,
            parts: 6,
            middle: DVec3::ZERO,
            at: Placement::at(at),
            velocity: DVec3::ZERO,
            spin: DVec3::ZERO,
        }
    }

    fn motion(&self) -> FreeMotion {
        FreeMotion {
            proxy: true,
            placement: self.at,
            velocity: self.velocity,
            ..of_mass(self.mass)
        }
    }

    fn step(&mut self, seconds: f64, [force, torque]: [DVec3; 2]) {
        self.velocity += force * (seconds / self.mass);
        self.spin += torque * (seconds / (0.4 * self.mass * self.radius * self.radius));
        let h = seconds / f64::from(self.parts);
        for _ in 0..self.parts {
            self.velocity -= self.gravity * DVec3::Z * h;
            let room = self.at.translation.z - self.floor;
            let least = if room > 0.0 { -room / h } else { -0.2 * room / h };
            if self.velocity.z < least {
                (self.velocity, self.spin) = (DVec3::Z * least, DVec3::ZERO);
            }
            let centre = self.at.apply(self.middle) + self.velocity * h;
            self.at.rotation = (DQuat::from_scaled_axis(self.spin * h) * self.at.rotation).normalize();
            self.at.translation = centre - self.at.rotation * self.middle;
        }
    }

    /// Runs the engine and the cloth for so many seconds. The body is number 0.
    fn run(&mut self, simulation: &mut Simulation, pace: Pace, seconds: f64) {
        let own = pace.seconds();
        for _ in 0..(seconds / own).round() as u32 {
            let load = simulation.proxy_load(0).unwrap();
            self.step(own, [load.force, load.torque]);
            let &mut Self { at, velocity, spin, .. } = self;
            let to = BroughtBody {
                placement: at,
                velocity,
                spin,
            };
            simulation.bring_body(0, to).unwrap();
            pace.run(simulation, own);
            self.at = simulation.placement(0).unwrap();
        }
    }
}

/// A ball of an engine near a cloth of which some vertices are pinned.
fn near(cloth: Cloth, engine: &Engine, pace: Pace, pins: Vec<u32>) -> Simulation {
    let mut scene = scene(cloth, pace.seconds(), engine.gravity, 0.3);
    scene.bodies.push(ball(DVec3::ZERO, engine.radius, engine.motion()));
    if !pins.is_empty() {
        scene.add(Pins {
            groups: vec![PinGroup::resting(pins)],
        });
    }
    contact(&mut scene, THICKNESS, 0.0);
    Simulation::new(scene, 1).unwrap()
}

#[test]
fn a_ball_of_an_engine_comes_to_rest_in_a_held_sheet_which_bears_its_weight() {
    let [_, steps, frames] = PACES;
    for (pace, mass, parts) in [(steps, 0.1, 6), (frames, 0.1, 1), (frames, 0.1, 6), (frames, 0.005, 6)] {
        let cloth = sheet(0.5, 12, 0.0);
        let edge = |point: &DVec3| point.x.abs().max(point.y.abs()) > 0.2499;
        let vertices = cloth.mesh().positions.iter().zip(0..).filter(|(point, _)| edge(point));
        let border = vertices.map(|(_, vertex)| vertex).collect();
        let mut engine = Engine {
            parts,
            ..Engine::new(mass, 0.08, DVec3::Z * 0.1)
        };
        let mut simulation = near(cloth, &engine, pace, border);
        engine.run(&mut simulation, pace, 4.0);
        // A very light ball rolls to and fro in the sheet for long.
        let count = (1.0 / pace.seconds()).round() as u32;
        let (mut force, before) = (DVec3::ZERO, engine.at.translation);
        let mut places = vec![before];
        for _ in 0..count {
            engine.run(&mut simulation, pace, pace.seconds());
            force += simulation.proxy_load(0).unwrap().force / f64::from(count);
            places.push(engine.at.translation);
        }
        let moved = engine.at.translation.distance(before);
        // What bears its weight, and moves it as its places say.
        let [first, second, .., last, end] = places[..] else {
            unreachable!()
        };
        let faster = (end - last - (second - first)) / (pace.seconds() * f64::from(count - 1) * pace.seconds());
        let exact = mass * (G * DVec3::Z + faster);
        println!("{pace:?}, {mass} kg: {force} of {exact}, moved by {moved:e}");
        let (of_force, of_place) = if mass < 0.01 { (4e-3, 5e-2) } else { (1e-3, 1e-3) };
        assert!((force - exact).length() < of_force * mass * G, "{force}");
        assert!(moved < of_place, "{moved}");
    }
}

#[test]
fn a_body_that_an_engine_holds_does_not_sink_under_a_sheet_and_feels_its_weight() {
    for pace in &PACES[1..] {
        let pace = *pace;
        for share in [2.0, 50.0] {
            let all = 0.09 * DENSITY;
            let mut engine = Engine {
                floor: 0.0,
                ..Engine::new(share * all, 0.05, DVec3::ZERO)
            };
            let mut simulation = near(sheet(0.3, 12, 0.054), &engine, pace, Vec::new());
            let (mut deepest, mut force) = (0.0_f64, 0.0);
            for frame in 0..120 {
                engine.run(&mut simulation, pace, 1.0 / 60.0);
                deepest = deepest.min(engine.at.translation.z);
                force += if frame < 60 {
                    0.0
                } else {
                    simulation.proxy_load(0).unwrap().force.z / 60.0
                };
            }
            println!("{pace:?}, {share}: {force} of {}, {deepest:e} m deep", -all * G);
            assert!((force + all * G).abs() < 0.02 * all * G, "{force}");
            assert!(deepest > -THICKNESS, "{deepest}");
        }
    }
}

#[test]
fn a_ball_of_an_engine_and_a_free_sheet_keep_their_momentum() {
    for pace in PACES {
        for share in [0.1, 20.0] {
            let cloth = sheet(0.3, 12, 0.2);
            let own = masses(cloth.mesh(), DENSITY);
            let mut engine = Engine {
                gravity: 0.0,
                ..Engine::new(share * 0.09 * DENSITY, 0.05, DVec3::ZERO)
            };
            engine.velocity = DVec3::Z * 2.0;
            let mut simulation = near(cloth, &engine, pace, Vec::new());
            let before = engine.velocity * engine.mass;
            engine.run(&mut simulation, pace, 0.2);
            let [of_cloth, _] = momenta(&simulation, &own, DVec3::ZERO);
            let load = simulation.proxy_load(0).unwrap().force * pace.seconds();
            let after = engine.velocity * engine.mass + load + of_cloth;
            assert!(of_cloth.z > 0.02 * before.z, "the ball has met the sheet: {of_cloth}");
            assert!(
                (after - before).length() < 1e-12 * before.length(),
                "{pace:?}: {after} after {before}"
            );
        }
    }
}

/// A weight that hangs on a rope and swings, as a proxy or as a free body.
fn pendulum(engine: &Engine, motion: FreeMotion, pace: Pace) -> Simulation {
    let rope = Cloth::rope(&[DVec3::ZERO, -0.5 * DVec3::Z], 20, 0.02).unwrap();
    let mut scene = Scene::new(rope, pace.seconds());
    scene.bodies.push(ball(engine.middle, engine.radius, motion));
    let groups = vec![PinGroup::resting(vec![0]), PinGroup::new(vec![20], PinMotion::Body(0))];
    scene
        .add(Gravity::default())
        .add(RopeStretch::new(3e4))
        .add(Pins { groups })
        .add(BodyContact(Thickness::new(THICKNESS)));
    Simulation::new(scene, 1).unwrap()
}

#[test]
fn what_is_pinned_to_a_body_of_an_engine_moves_it_as_if_the_body_were_free() {
    for pace in PACES {
        for mass in [0.02, 0.5] {
            let mut engine = Engine {
                middle: DVec3::Z * -0.535,
                at: Placement::default(),
                velocity: DVec3::X * 0.3,
                ..Engine::new(mass, 0.03, DVec3::ZERO)
            };
            let motion = engine.motion();
            let mut simulation = pendulum(&engine, motion, pace);
            let mut free = pendulum(&engine, FreeMotion { proxy: false, ..motion }, pace);
            let (mut apart, mut widest): (f64, f64) = (0.0, 0.0);
            for _ in 0..120 {
                engine.run(&mut simulation, pace, 1.0 / 60.0);
                pace.run(&mut free, 1.0 / 60.0);
                let [own, of_free] = [&simulation, &free].map(|it| it.body_motion(0).unwrap().centre);
                (apart, widest) = (apart.max(own.distance(of_free)), widest.max(of_free.x.abs()));
            }
            println!("{pace:?}, {mass} kg: {apart} apart, swings by {widest}");
            assert!(apart < 0.1 * widest, "{pace:?}, {mass} kg: {apart} of {widest}");
        }
    }
}

#[test]
fn proxies_go_on_with_the_same_bits_after_a_checkpoint() {
    let pace = Pace::Steps(4e-3);
    let make = || {
        let engine = Engine {
            velocity: DVec3::X * 0.2,
            ..Engine::new(0.05, 0.05, DVec3::Z * 0.055)
        };
        let simulation = near(sheet(0.3, 8, 0.0), &engine, pace, vec![0, 8, 72, 80]);
        (engine, simulation)
    };
    let (mut engine, mut whole) = make();
    engine.run(&mut whole, pace, 4e-3 * CHECKPOINT_STEPS as f64);
    let (_, mut resumed) = make();
    resumed.resume(&whole.checkpoint().unwrap()).unwrap();
    assert_ne!(whole.placement(0).unwrap().translation.z, 0.055);
    for _ in 0..20 {
        let to = BroughtBody {
            placement: whole.placement(0).unwrap(),
            velocity: DVec3::NEG_Z,
            spin: DVec3::X,
        };
        for simulation in [&mut whole, &mut resumed] {
            simulation.bring_body(0, to).unwrap();
            simulation.step().unwrap();
        }
        assert_eq!(whole.placement(0), resumed.placement(0));
        assert_eq!(whole.positions(), resumed.positions());
    }
}

#[test]
fn a_teleport_moves_a_proxy_with_its_cloth_and_its_next_frame_goes_on_from_there() {
    let pace = Pace::Frames(1.0 / 60.0);
    let by = Placement::new(DQuat::from_rotation_z(1.0), DVec3::new(3.0, -1.0, 0.0));
    let make = || {
        let engine = Engine {
            middle: DVec3::Z * -0.535,
            at: Placement::default(),
            ..Engine::new(0.1, 0.03, DVec3::ZERO)
        };
        let mut scene = Scene::new(Cloth::rope(&[DVec3::ZERO, -0.5 * DVec3::Z], 20, 0.02).unwrap(), 4e-3);
        scene.bodies.push(ball(engine.middle, engine.radius, engine.motion()));
        let groups = vec![PinGroup::new(vec![20], PinMotion::Body(0))];
        scene.add(RopeStretch::new(3e3)).add(Pins { groups });
        (engine, Simulation::new(scene, 1).unwrap())
    };
    let ((mut engine, mut here), (mut other, mut there)) = (make(), make());
    for engine in [&mut engine, &mut other] {
        engine.gravity = 0.0;
        (engine.velocity, engine.spin) = (DVec3::X, DVec3::Y);
    }
    engine.run(&mut here, pace, 0.1);
    other.run(&mut there, pace, 0.1);
    there.teleport(&[0], &[], by).unwrap();
    (other.velocity, other.spin) = (by.rotation * other.velocity, by.rotation * other.spin);
    other.at = there.placement(0).unwrap();
    engine.run(&mut here, pace, 0.1);
    other.run(&mut there, pace, 0.1);
    for (one, other) in here.positions().iter().zip(there.positions()) {
        assert!(
            by.apply(*one).distance(*other) < 1e-5,
            "{other} instead of {}",
            by.apply(*one)
        );
    }
}

/// The engine keeps its bodies apart. So its ball flies through another one of the engine, and through one that the caller moves,
/// as if nothing were there.
#[test]
fn a_proxy_meets_free_bodies_but_no_driven_body_and_no_other_proxy() {
    for pace in PACES {
        let free = || of_mass(0.1);
        let others: [BodyMotion; 3] = [
            free().into(),
            BodyMotion::Driven(Placement::default()),
            FreeMotion { proxy: true, ..free() }.into(),
        ];
        let [met, passed @ ..] = others.map(|motion| {
            let mut engine = Engine {
                gravity: 0.0,
                velocity: DVec3::X,
                ..Engine::new(0.1, 0.05, DVec3::ZERO)
            };
            let mut other = Body::ball("other", DVec3::X * 0.2, 0.05, 16).unwrap();
            other.motion = motion;
            let mut scene = scene(aside(), pace.seconds(), 0.0, 0.0);
            scene.bodies = vec![ball(DVec3::ZERO, engine.radius, engine.motion()), other];
            contact(&mut scene, THICKNESS, 0.0);
            let mut simulation = Simulation::new(scene, 1).unwrap();
            engine.run(&mut simulation, pace, 0.4);
            [0, 1].map(|body| simulation.placement(body).unwrap().translation)
        });
        // Both balls have the same mass, and a contact of the solve takes no more speed than it must: they go on together.
        assert!(met[1].x > 0.1 && met[0].x < met[1].x + 0.1, "{pace:?}: pushed to {met:?}");
        for [own, other] in passed {
            assert!((own - 0.4 * DVec3::X).length() < 1e-9, "{pace:?}: {own}");
            assert_eq!(other, DVec3::ZERO, "{pace:?}");
        }
    }
}

#[test]
fn a_body_that_is_no_proxy_or_is_brought_too_far_is_refused() {
    let engine = Engine::new(1.0, 0.05, DVec3::ZERO);
    let mut simulation = near(sheet(0.3, 4, 0.2), &engine, Pace::Steps(4e-3), Vec::new());
    let to = BroughtBody {
        placement: Placement::at(DVec3::X),
        velocity: DVec3::ZERO,
        spin: DVec3::ZERO,
    };
    assert_eq!(simulation.bring_body(1, to), Err(DriveError::NoBody { body: 1, bodies: 1 }));
    let wrong = BroughtBody {
        velocity: DVec3::X * f64::NAN,
        ..to
    };
    assert!(matches!(simulation.bring_body(0, wrong), Err(DriveError::Value(error)) if error.field == "velocity"));
    simulation.bring_body(0, to).unwrap();
    let blocked = simulation.step().unwrap_err();
    assert!(blocked.speed.is_some_and(|speed| (speed - 250.0).abs() < 1e-9), "{blocked}");
    assert_eq!(blocked.body.as_deref(), Some("ball"));
    assert_eq!(simulation.placement(0).unwrap().translation, DVec3::ZERO);
    // What was brought is forgotten, and the ball stays.
    simulation.step().unwrap();
    assert!(simulation.placement(0).unwrap().translation.length() < 1e-12);

    let mut scene = scene(sheet(0.3, 4, 0.2), 4e-3, G, 0.3);
    scene.bodies.push(ball(DVec3::ZERO, 0.05, of_mass(1.0)));
    contact(&mut scene, THICKNESS, 0.0);
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let error = simulation.bring_body(0, to).unwrap_err();
    assert_eq!(error, DriveError::NoProxy { name: "ball".to_owned() });
    assert!(simulation.proxy_load(0).is_none());
}
