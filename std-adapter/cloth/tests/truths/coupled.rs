//! Free bodies and cloth together: ropes with weights, a ball in a sheet, a plate on a tablecloth, and heavy things on light
//! ones.

use crate::bodies::{G, THICKNESS, aside, ball, cuboid, free, of_mass, run, scene, sheet};
use crate::loads::{PACES, Pace};
use crate::{contact, table};
use selvedge_cloth::effects::{
    BodyContact, Friction, Gravity, PinGroup, PinMotion, Pins, RopeStretch, Shear, Stretch, Thickness,
};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Accuracy, Body, BodyMotion, Cloth, FreeMotion, Placement, Scene, Simulation};

const ROD: f64 = 0.05;

/// Two balls hang on a light rope that lies over a rod. Its ends are pinned to them.
fn over_a_rod([left, right]: [f64; 2], friction: f64, pace: Pace) -> Simulation {
    let radius = ROD + 1.05 * THICKNESS;
    let arc = |k: u32| {
        let angle = std::f64::consts::PI * (1.0 - f64::from(k) / 32.0);
        radius * DVec3::new(angle.cos(), 0.0, angle.sin())
    };
    let mut line = vec![DVec3::new(-radius, 0.0, -0.5)];
    line.extend((0..=32).map(arc));
    line.push(DVec3::new(radius, 0.0, -0.4));
    let rope = Cloth::rope(&line, 100, 2e-3).unwrap();
    let ends = [0, rope.mesh().positions.len() as u32 - 1];
    let mut scene = Scene::new(rope, pace.seconds());
    let rod = Body::capsule("rod", [-0.2 * DVec3::Y, 0.2 * DVec3::Y], ROD, 48).unwrap();
    scene.bodies.push(rod);
    let mut groups = Vec::new();
    for ((name, place), (mass, end)) in ["left", "right"]
        .into_iter()
        .zip([line[0], line[34]])
        .zip([left, right].into_iter().zip(ends))
    {
        let centre = place - DVec3::Z * (0.03 + 3.0 * THICKNESS);
        let weight = Body::ball(name, centre, 0.03, 16).unwrap();
        groups.push(PinGroup::new(vec![end], PinMotion::Body(scene.bodies.len())));
        scene.bodies.push(free(weight, of_mass(mass)));
    }
    scene
        .add(Gravity::default())
        .add(RopeStretch::new(3e4))
        .add(Pins { groups })
        .add(BodyContact(Thickness::new(THICKNESS)))
        .add(Friction { coefficient: friction });
    Simulation::new(scene, 1).unwrap()
}

/// Euler and Eytelwein: where the rope slips, the tensions m₁·(g + a) and m₂·(g − a) have the ratio e^{μπ}, as Atwood measured
/// the acceleration a.
#[test]
fn two_weights_on_a_rope_over_a_rod_slip_as_euler_eytelwein_and_atwood_say() {
    for pace in PACES {
        for (friction, right) in [(0.0, 1.25), (0.2, 2.5)] {
            let mut simulation = over_a_rod([1.0, right], friction, pace);
            // The right one sinks as fast as the left one rises, but for waves in the rope.
            let speed = |simulation: &Simulation| {
                let [left, right] = [1, 2].map(|body| simulation.body_motion(body).unwrap().velocity.z);
                0.5 * (left - right)
            };
            pace.run(&mut simulation, 0.15);
            let early = speed(&simulation);
            pace.run(&mut simulation, 0.15);
            let acceleration = (speed(&simulation) - early) / 0.15;
            let found = right * (G - acceleration) / (G + acceleration);
            let exact = (friction * std::f64::consts::PI).exp();
            println!("{pace:?}, friction {friction}: {acceleration} m/s², tensions 1 : {found} instead of {exact}");
            assert!((found - exact).abs() < 0.01 * exact, "{pace:?}: {found} instead of {exact}");
        }
    }
}

#[test]
fn two_weights_on_a_rope_over_a_rod_stay_where_friction_is_enough() {
    for pace in PACES {
        let mut simulation = over_a_rod([1.0, 1.5], 0.2, pace);
        pace.run(&mut simulation, 1.0);
        for body in [1, 2] {
            let speed = simulation.body_motion(body).unwrap().velocity.z;
            assert!(speed.abs() < 1e-3, "{pace:?}: {speed} m/s");
        }
        let rod = simulation.mean_body_load(0, DVec3::ZERO).unwrap().total().force;
        let weight = 2.5 * G;
        println!("{pace:?}: {rod}");
        assert!((rod.z + weight).abs() < 2e-3 * weight, "{pace:?}: {rod}");
    }
}

/// The cloth under a plate is pulled away at a steady acceleration.
fn tablecloth(acceleration: f64, [from, to]: [f64; 2], pace: Pace) -> f64 {
    let cloth = sheet(0.6, 24, 1.02 * THICKNESS);
    let all: Vec<u32> = (0..cloth.mesh().positions.len() as u32).collect();
    let start = cloth.mesh().positions.clone();
    let mut scene = scene(cloth, pace.seconds(), G, 0.3);
    // So stiff that waves in it are fast and small.
    scene.add(Stretch::isotropic(5e3)).add(Shear::new(1e3));
    scene.bodies.push(table(8, 0.0));
    let at = DVec3::Z * (0.01 + 2.1 * THICKNESS);
    scene
        .bodies
        .push(cuboid("plate", at, DVec3::new(0.1, 0.1, 0.02), of_mass(0.3)));
    let left = all.iter().copied().filter(|&vertex| start[vertex as usize].x > 0.299);
    let left: Vec<u32> = left.collect();
    let pinned: Vec<DVec3> = left.iter().map(|&vertex| start[vertex as usize]).collect();
    scene.add(Pins {
        groups: vec![PinGroup::new(left, PinMotion::Own(BodyMotion::Driven(Placement::default())))],
    });
    contact(&mut scene, THICKNESS, 0.0);
    let mut simulation = Simulation::new(scene, 1).unwrap();
    pace.run(&mut simulation, 0.2);
    let (mut speed, mut way) = (0.0, 0.0);
    let mut early = None;
    let velocity = |simulation: &Simulation| simulation.body_motion(1).unwrap().velocity.x;
    for step in 0..(to / pace.seconds()).round() as u32 {
        if f64::from(step) * pace.seconds() >= from {
            early.get_or_insert((step, velocity(&simulation)));
        }
        speed += acceleration * pace.seconds();
        way += speed * pace.seconds();
        let to: Vec<DVec3> = pinned.iter().map(|point| *point + DVec3::X * way).collect();
        simulation.move_pins(0, &to).unwrap();
        pace.run(&mut simulation, pace.seconds());
    }
    let (first, early) = early.unwrap();
    let steps = (to / pace.seconds()).round() - f64::from(first);
    (velocity(&simulation) - early) / (steps * pace.seconds())
}

#[test]
fn a_plate_goes_along_with_a_slow_tablecloth_and_slips_on_a_fast_one() {
    for pace in PACES {
        for (acceleration, exact, times) in [(1.5, 1.5, [0.2, 0.5]), (10.0, 0.3 * G, [0.016, 0.066])] {
            let found = tablecloth(acceleration, times, pace);
            println!("{pace:?}: {found} instead of {exact}");
            assert!((found - exact).abs() < 0.02 * exact, "{pace:?}: {found} instead of {exact}");
        }
    }
}

/// Returns how far a ball of this mass hangs in a held sheet.
fn sag(mass: f64, accuracy: Accuracy, pace: Pace) -> f64 {
    let cloth = sheet(0.5, 12, 0.0);
    let edge = |point: &DVec3| point.x.abs().max(point.y.abs()) > 0.2499;
    let vertices = cloth.mesh().positions.iter().zip(0..);
    let border: Vec<u32> = vertices.filter(|(point, _)| edge(point)).map(|(_, vertex)| vertex).collect();
    let mut scene = scene(cloth, pace.seconds(), G, 0.3);
    scene.accuracy = accuracy;
    scene.bodies.push(ball(DVec3::Z * 0.084, 0.08, of_mass(mass)));
    scene.add(Pins {
        groups: vec![PinGroup::resting(border)],
    });
    contact(&mut scene, THICKNESS, 0.0);
    let mut simulation = Simulation::new(scene, 1).unwrap();
    pace.run(&mut simulation, 8.0);
    // The mean of the last second, while it still swings.
    let mut sum = 0.0;
    for _ in 0..60 {
        pace.run(&mut simulation, 1.0 / 60.0);
        sum += simulation.body_motion(0).unwrap().centre.z;
    }
    sum / 60.0
}

#[test]
fn a_ball_in_a_held_sheet_hangs_as_deep_at_any_step() {
    for mass in [0.1, 1.0, 10.0] {
        let exact = sag(mass, Accuracy::Exact, Pace::Steps(4e-3));
        // In steps of 1 ms a heavy ball swings for a minute.
        for pace in PACES.into_iter().skip(usize::from(mass > 1.0)) {
            let found = sag(mass, Accuracy::Game, pace);
            println!("{mass} kg, {pace:?}: {found} instead of {exact}");
            assert!(
                (found - exact).abs() < 0.01 * (exact - 0.082).abs(),
                "{mass} kg, {pace:?}: {found} instead of {exact}"
            );
        }
    }
}

/// A box of 10 kg on one of 10 g, and the other way round.
#[test]
fn what_is_a_thousand_times_heavier_rests_on_what_is_light() {
    for pace in PACES {
        for (lower, upper) in [(0.01, 10.0), (10.0, 0.01)] {
            let mut scene = scene(aside(), pace.seconds(), G, 0.4);
            scene.bodies.push(table(8, 0.0));
            let sides = DVec3::splat(0.1);
            let height = |k: f64| DVec3::Z * (0.05 + 1.1 * THICKNESS + k * (0.1 + 1.1 * THICKNESS));
            scene.bodies.push(cuboid("lower", height(0.0), sides, of_mass(lower)));
            scene.bodies.push(cuboid("upper", height(1.0), sides, of_mass(upper)));
            contact(&mut scene, THICKNESS, 0.0);
            let mut simulation = Simulation::new(scene, 1).unwrap();
            pace.run(&mut simulation, 2.0);
            let weight = (lower + upper) * G;
            let load = simulation.body_load(0, DVec3::ZERO).unwrap().total().force;
            let bodies = [1, 2].map(|body| simulation.body_motion(body).unwrap());
            println!(
                "{pace:?}, {lower} under {upper}: {load}, {} {}",
                bodies[0].velocity, bodies[1].velocity
            );
            assert!((load + DVec3::Z * weight).length() < 0.02 * weight, "{pace:?}: {load}");
            for (body, k) in bodies.iter().zip([0.0, 1.0]) {
                assert!(body.velocity.length() < 5e-3, "{pace:?}: {}", body.velocity);
                let expected = 0.05 + THICKNESS + k * (0.1 + THICKNESS);
                assert!(
                    (body.centre.z - expected).abs() < 0.1 * THICKNESS,
                    "{pace:?}: {}",
                    body.centre
                );
            }
        }
    }
}

#[test]
fn a_ball_and_the_sheet_that_is_pinned_to_it_keep_momentum_together() {
    for time_step in [1e-3, 4e-3] {
        let cloth = sheet(0.4, 12, 0.0);
        let masses = crate::masses(cloth.mesh(), crate::bodies::DENSITY);
        let start = cloth.mesh().positions.clone();
        let near = |point: &DVec3| (*point - DVec3::new(0.2, 0.2, 0.0)).length() < 0.06;
        let corner: Vec<u32> = { start.iter().zip(0..) }
            .filter(|(point, _)| near(point))
            .map(|(_, vertex)| vertex)
            .collect();
        assert!(corner.len() > 2);
        let mut scene = scene(cloth, time_step, 0.0, 0.3);
        let motion = FreeMotion {
            velocity: DVec3::new(-0.5, 1.0, 0.3),
            spin: DVec3::new(1.0, 2.0, -4.0),
            ..of_mass(0.02)
        };
        scene.bodies.push(ball(DVec3::new(0.2, 0.2, 0.06), 0.05, motion));
        scene.add(Pins {
            groups: vec![PinGroup::new(corner.clone(), PinMotion::Body(0))],
        });
        contact(&mut scene, THICKNESS, 0.0);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let mut free_masses = masses.clone();
        corner.iter().for_each(|&vertex| free_masses[vertex as usize] = 0.0);
        let all = |simulation: &Simulation| {
            let [linear, angular] = crate::momenta(simulation, &free_masses, DVec3::ZERO);
            let body = simulation.body_motion(0).unwrap();
            let own = body.velocity * body.mass;
            [linear + own, angular + body.centre.cross(own) + body.angular_momentum]
        };
        let pinned: f64 = corner.iter().map(|&vertex| masses[vertex as usize]).sum();
        let mass = simulation.body_motion(0).unwrap().mass;
        assert!((mass - 0.02 - pinned).abs() < 1e-12, "what is pinned belongs to the body");
        let before = all(&simulation);
        run(&mut simulation, 0.2, time_step);
        let after = all(&simulation);
        for k in 0..2 {
            let error = (after[k] - before[k]).length() / before[k].length();
            println!("{time_step}: {error:e}");
            assert!(error < 1e-9, "{time_step}: {error:e}");
        }
        let ball = simulation.body_motion(0).unwrap();
        assert!(ball.velocity.length() < 1.1, "the sheet slows it down");
        // What is pinned moves with the ball.
        let place = simulation.placement(0).unwrap();
        for vertex in corner {
            let expected = place.apply(start[vertex as usize]);
            assert!(simulation.positions()[vertex as usize].distance(expected) < 1e-12);
        }
    }
}

/// Nothing drives what falls, so energy of motion and strain may only fall.
#[test]
fn a_ball_that_bounces_in_a_sheet_gains_no_energy() {
    for pace in PACES {
        let cloth = sheet(0.5, 12, 0.0);
        let edge = |point: &DVec3| point.x.abs().max(point.y.abs()) > 0.2499;
        let vertices = cloth.mesh().positions.iter().zip(0..);
        let border: Vec<u32> = vertices.filter(|(point, _)| edge(point)).map(|(_, vertex)| vertex).collect();
        let mut scene = scene(cloth, pace.seconds(), 0.0, 0.3);
        let motion = FreeMotion {
            velocity: DVec3::new(0.5, 0.0, -2.0),
            spin: DVec3::Y * 10.0,
            ..of_mass(0.3)
        };
        scene.bodies.push(ball(DVec3::Z * 0.09, 0.08, motion));
        scene.add(Pins {
            groups: vec![PinGroup::resting(border)],
        });
        contact(&mut scene, THICKNESS, 0.0);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let start = simulation.energy().total();
        let mut before = start;
        for _ in 0..60 {
            pace.run(&mut simulation, 1.0 / 60.0);
            let now = simulation.energy().total();
            assert!(now - before < 1e-3 * start, "{pace:?}: {now} J after {before} J");
            before = now;
        }
        println!("{pace:?}: {before} of {start} J left");
    }
}
