//! Soft pins: the sag under a weight, the lag in moving air, their loads and their energy, and the limit of hard pins.

use super::loads::{PACES, Pace, near};
use super::masses;
use selvedge_cloth::effects::{AirDrag, Gravity, PinGroup, PinMotion, Pins, Shear, Stretch};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Animation, Body, BodyMotion, Cloth, Keyframe, KeyframeMotion, Placement, Scene, Simulation};

const GRAVITY: f64 = 9.81;
/// In kg/m².
const DENSITY: f64 = 0.2;
/// In N/m.
const STIFFNESS: f64 = 100.0;
const WEIGHTS: [f64; 4] = [1.0, 0.75, 0.5, 0.25];
const ALL: [u32; 4] = [0, 1, 2, 3];

/// A square of 1 m and 200 g/m² without any elasticity: four masses.
fn square() -> Cloth {
    Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [1; 2], DENSITY).unwrap()
}

/// The masses on soft pins, in air that lets them come to rest.
fn scene(motion: PinMotion, air: f64, pace: Pace) -> Scene {
    let mut scene = Scene::new(square(), pace.seconds());
    let group = PinGroup {
        stiffness: Some(STIFFNESS),
        weights: WEIGHTS.to_vec(),
        ..PinGroup::new(ALL, motion)
    };
    scene.add(AirDrag { rate: air }).add(Pins { groups: vec![group] });
    scene
}

#[test]
fn a_mass_sags_by_its_weight_over_stiffness_and_weight() {
    for pace in PACES {
        let mut scene = scene(PinGroup::resting([]).motion, 10.0, pace);
        scene.add(Gravity::default());
        let cloth = square();
        let mut simulation = Simulation::new(scene, 1).unwrap();
        pace.run(&mut simulation, 3.0);
        let (mut stored, mut pulled) = (0.0, DVec3::ZERO);
        for (vertex, mass) in masses(cloth.mesh(), DENSITY).into_iter().enumerate() {
            let stiffness = STIFFNESS * WEIGHTS[vertex];
            let sag = -mass * GRAVITY / stiffness * DVec3::Z;
            let found = simulation.positions()[vertex] - cloth.mesh().positions[vertex];
            near(&format!("{pace:?}, sag of {vertex}"), found, sag, sag.length(), 1e-3);
            stored += 0.5 * stiffness * sag.length_squared();
            pulled -= mass * GRAVITY * DVec3::Z;
        }
        let load = simulation.pin_load(0, DVec3::ZERO).unwrap();
        near(&format!("{pace:?}, load"), load.force, pulled, pulled.length(), 1e-3);
        let energy = simulation.energy();
        let of_pins = energy.stored.iter().find(|(name, _)| *name == "pins").unwrap();
        assert!((of_pins.1.joules() / stored - 1.0).abs() < 2e-3, "{of_pins:?}, not {stored}");
    }
}

/// In m/s.
const SPEED: DVec3 = DVec3::new(0.5, 0.0, 0.25);
const SECONDS: f64 = 3.0;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Mover {
    Body,
    Caller,
    Keyframes,
    Animation,
}

/// Leads the pins along evenly, and returns the simulation at the end.
fn led(mover: Mover, air: f64, pace: Pace) -> Simulation {
    let start = square().mesh().positions.clone();
    let moved = |way: DVec3| start.iter().map(|point| *point + way).collect::<Vec<_>>();
    let driven = BodyMotion::Driven(Placement::default());
    // A little longer than the run, whose end no rounding may miss.
    let end = 1.01 * SECONDS;
    let key = |time: f64| Keyframe {
        time,
        translation: time * SPEED,
        ..Keyframe::default()
    };
    let motion = match mover {
        Mover::Body => PinMotion::Body(0),
        Mover::Caller => PinMotion::Own(driven.clone()),
        Mover::Keyframes => {
            let motion = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, vec![key(0.0), key(end)]).unwrap();
            PinMotion::Own(motion.into())
        }
        Mover::Animation => {
            let frames = vec![start.clone(), moved(end * SPEED)];
            PinMotion::Own(Animation::from_frames(frames, end.recip()).unwrap().into())
        }
    };
    let mut scene = scene(motion, air, pace);
    if mover == Mover::Body {
        let mut body = Body::ball("ball", DVec3::new(0.5, 0.5, -1.0), 0.1, 8).unwrap();
        body.motion = driven;
        scene.bodies.push(body);
    }
    let mut simulation = Simulation::new(scene, 1).unwrap();
    for step in 1..=(SECONDS / pace.seconds()).round() as u32 {
        let way = f64::from(step) * pace.seconds() * SPEED;
        match mover {
            Mover::Body => simulation.place_body(0, Placement::at(way)).unwrap(),
            Mover::Caller => simulation.move_pins(0, &moved(way)).unwrap(),
            Mover::Keyframes | Mover::Animation => {}
        }
        pace.run(&mut simulation, pace.seconds());
    }
    simulation
}

#[test]
fn a_mass_has_the_speed_of_its_anchor_and_lags_by_the_drag_of_the_air() {
    const AIR: f64 = 10.0;
    for (pace, mover) in PACES
        .into_iter()
        .flat_map(|pace| [Mover::Body, Mover::Caller, Mover::Keyframes, Mover::Animation].map(|mover| (pace, mover)))
    {
        let simulation = led(mover, AIR, pace);
        let cloth = square();
        let mut drag = DVec3::ZERO;
        for (vertex, mass) in masses(cloth.mesh(), DENSITY).into_iter().enumerate() {
            let what = format!("{pace:?}, {mover:?}, vertex {vertex}");
            let lag = -mass * AIR * SPEED / (STIFFNESS * WEIGHTS[vertex]);
            let anchor = cloth.mesh().positions[vertex] + simulation.time() * SPEED;
            near(
                &format!("lag: {what}"),
                simulation.positions()[vertex] - anchor,
                lag,
                lag.length(),
                1e-3,
            );
            near(
                &format!("speed: {what}"),
                simulation.velocities()[vertex],
                SPEED,
                SPEED.length(),
                1e-3,
            );
            drag -= mass * AIR * SPEED;
        }
        let load = simulation.pin_load(0, DVec3::ZERO).unwrap();
        near(&format!("load: {pace:?}, {mover:?}"), load.force, drag, drag.length(), 1e-3);
        if mover == Mover::Body {
            let of_body = simulation.body_load(0, DVec3::ZERO).unwrap();
            assert_eq!((of_body.pins, of_body.attachments.force), (load, DVec3::ZERO));
        }
    }
}

/// Without air it swings about its anchor for good, and goes with it in the mean.
#[test]
fn a_mass_that_swings_about_a_steady_anchor_has_its_speed_in_the_mean() {
    for pace in PACES {
        let simulation = led(Mover::Body, 0.0, pace);
        let cloth = square();
        for (vertex, mass) in masses(cloth.mesh(), DENSITY).into_iter().enumerate() {
            let way = simulation.positions()[vertex] - cloth.mesh().positions[vertex];
            // It starts at rest, so that it swings with the anchor's speed, by at most speed/ω. Steps only take from that.
            let swing = SPEED.length() * (mass / (STIFFNESS * WEIGHTS[vertex])).sqrt();
            let off = way.distance(SECONDS * SPEED);
            assert!(
                off <= swing * 1.001,
                "{pace:?}, vertex {vertex}: {off} m off, swings by {swing} m"
            );
        }
    }
}

/// A curtain of 200 g/m² whose top is led aside.
fn curtain(stiffness: Option<f64>, pace: Pace) -> Simulation {
    let cloth = Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.4, DVec3::Z * 0.4], [6; 2], DENSITY).unwrap();
    let top = cloth.part("top").unwrap().to_vec();
    let key = |time: f64, x: f64| Keyframe {
        time,
        translation: x * DVec3::X,
        ..Keyframe::default()
    };
    let motion = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, vec![key(0.0, 0.0), key(0.5, 0.1)]).unwrap();
    let mut scene = Scene::new(cloth, pace.seconds());
    scene.add(Gravity::default()).add(Stretch::isotropic(400.0));
    scene.add(Shear::new(100.0)).add(AirDrag { rate: 5.0 });
    let group = PinGroup {
        stiffness,
        ..PinGroup::new(top, PinMotion::Own(motion.into()))
    };
    scene.add(Pins { groups: vec![group] });
    let mut simulation = Simulation::new(scene, 1).unwrap();
    pace.run(&mut simulation, 1.0);
    simulation
}

/// The curtain weighs 0.3 N, under which pins of 100 kN/m yield by less than a hundredth of a millimetre.
#[test]
fn stiff_pins_hold_cloth_where_hard_pins_do() {
    for pace in PACES {
        let hard = curtain(None, pace);
        let carried = hard.pin_load(0, DVec3::ZERO).unwrap();
        // The second is the stiffest that there is.
        for stiffness in [1e5, 1e9] {
            let soft = curtain(Some(stiffness), pace);
            let pairs = soft.positions().iter().zip(hard.positions());
            let off = pairs.map(|(soft, hard)| soft.distance(*hard)).fold(0.0, f64::max);
            assert!(off < 1e-5, "{pace:?}, {stiffness} N/m: {off} m apart");
            let load = soft.pin_load(0, DVec3::ZERO).unwrap();
            near(
                &format!("{pace:?}, {stiffness} N/m, load"),
                load.force,
                carried.force,
                carried.force.length(),
                1e-3,
            );
        }
    }
}
