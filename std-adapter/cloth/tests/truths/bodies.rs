//! Free rigid bodies: free fall, momenta, weights, friction on a slope, and rest.

use crate::{contact, elastic, masses, momenta, table};
use selvedge_cloth::effects::{AirDrag, Friction, Gravity, PinGroup, Pins};
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{
    Accuracy, Body, BodyMass, CHECKPOINT_STEPS, Cloth, FreeMotion, LockedAxes, Mesh, Placement, Scene, Simulation,
};

pub(crate) const G: f64 = 9.81;
pub(crate) const DENSITY: f64 = 0.15;
pub(crate) const THICKNESS: f64 = 2e-3;

pub(crate) fn free(mut body: Body, motion: FreeMotion) -> Body {
    body.motion = motion.into();
    body
}

pub(crate) fn ball(centre: DVec3, radius: f64, motion: FreeMotion) -> Body {
    free(Body::ball("ball", centre, radius, 16).unwrap(), motion)
}

/// A box of these sides around a centre.
pub(crate) fn cuboid(name: &str, centre: DVec3, sides: DVec3, motion: FreeMotion) -> Body {
    let at = |k: usize| {
        let corner = DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64);
        centre + sides * (corner - DVec3::splat(0.5))
    };
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let mesh = Mesh::new((0..8).map(at).collect(), triangles.collect());
    free(Body::from_mesh(name, mesh), motion)
}

pub(crate) fn of_mass(mass: f64) -> FreeMotion {
    FreeMotion::new(BodyMass::Mass(mass))
}

/// A sheet that lies around the origin at a height.
pub(crate) fn sheet(side: f64, cells: u32, height: f64) -> Cloth {
    let corner = DVec3::new(-0.5 * side, -0.5 * side, height);
    Cloth::sheet(corner, [DVec3::X * side, DVec3::Y * side], [cells; 2], DENSITY).unwrap()
}

/// A small sheet far away, since a scene needs cloth.
pub(crate) fn aside() -> Cloth {
    sheet(0.1, 2, 20.0)
}

pub(crate) fn scene(cloth: Cloth, time_step: f64, gravity: f64, friction: f64) -> Scene {
    let mut scene = Scene::new(cloth, time_step);
    if gravity > 0.0 {
        scene.add(Gravity {
            acceleration: -gravity * DVec3::Z,
        });
    }
    elastic(&mut scene, 400.0, 15e-6);
    if friction > 0.0 {
        scene.add(Friction { coefficient: friction });
    }
    scene
}

pub(crate) fn run(simulation: &mut Simulation, seconds: f64, time_step: f64) {
    (0..(seconds / time_step).round() as u32).for_each(|_| simulation.step().unwrap());
}

/// A box that flies, with its centre of mass at the origin.
fn flying(accuracy: Accuracy, time_step: f64, motion: FreeMotion) -> Simulation {
    let mut scene = scene(aside(), time_step, G, 0.0);
    scene.accuracy = accuracy;
    scene
        .bodies
        .push(cuboid("box", DVec3::ZERO, DVec3::new(0.1, 0.2, 0.4), motion));
    contact(&mut scene, THICKNESS, 0.0);
    Simulation::new(scene, 1).unwrap()
}

/// Steps of first order fall by ½·g·t·(t + h). Those of second order begin with one of first.
#[test]
fn a_body_falls_as_far_as_its_steps_say() {
    for (accuracy, time_step) in [(Accuracy::Game, 4e-3), (Accuracy::Film, 4e-3), (Accuracy::Game, 1e-3)] {
        let velocity = DVec3::new(1.0, 0.0, 2.0);
        let motion = FreeMotion {
            velocity,
            ..of_mass(2.0)
        };
        let mut simulation = flying(accuracy, time_step, motion);
        let t = 0.4;
        run(&mut simulation, t, time_step);
        let after = simulation.body_motion(0).unwrap();
        let error = (after.velocity - velocity + DVec3::Z * G * t).length();
        assert!(error < 1e-9, "{accuracy:?} at {time_step}: {}", after.velocity);
        let (more, allowed) = match accuracy {
            Accuracy::Game => (0.5 * G * t * time_step, 1e-9),
            _ => (0.0, G * time_step * time_step),
        };
        let way = velocity * t - DVec3::Z * (0.5 * G * t * t + more);
        assert!(
            (after.centre - way).length() < allowed,
            "{accuracy:?} at {time_step}: {} instead of {way}",
            after.centre
        );
    }
}

#[test]
fn a_body_that_tumbles_keeps_its_angular_momentum() {
    for (accuracy, time_step) in [(Accuracy::Game, 4e-3), (Accuracy::Film, 4e-3), (Accuracy::Game, 1e-3)] {
        let spin = DVec3::new(3.0, 20.0, 0.5);
        let mut simulation = flying(accuracy, time_step, FreeMotion { spin, ..of_mass(2.0) });
        let before = simulation.body_motion(0).unwrap();
        assert!((before.spin - spin).length() < 1e-12);
        run(&mut simulation, 0.4, time_step);
        let after = simulation.body_motion(0).unwrap();
        let lost = (after.angular_momentum - before.angular_momentum).length() / before.angular_momentum.length();
        assert!(lost < 1e-12, "{accuracy:?} at {time_step}: {lost:e}");
        assert!(after.spin.distance(before.spin) > 1.0, "it tumbles");
        // Its vertices are where its placement says.
        let placement = simulation.placement(0).unwrap();
        let vertex = simulation.positions()[simulation.body_vertices(0).unwrap().start];
        assert!(vertex.distance(placement.apply(DVec3::new(-0.05, -0.1, -0.2))) < 1e-12);
    }
}

/// What holds a door at its middle has no moment about the hinge. So door and ball keep their angular momentum about it.
#[test]
fn a_door_turns_about_its_free_axis_alone_as_much_as_a_ball_pushes_it() {
    for time_step in [1e-3, 4e-3] {
        let mut scene = scene(aside(), time_step, 0.0, 0.0);
        let door = FreeMotion {
            locked: LockedAxes {
                translation: [true; 3],
                rotation: [true, true, false],
            },
            ..of_mass(2.0)
        };
        scene
            .bodies
            .push(cuboid("door", DVec3::ZERO, DVec3::new(0.3, 0.02, 0.4), door));
        let thrown = FreeMotion {
            velocity: DVec3::new(0.0, 3.0, 0.2),
            ..of_mass(0.1)
        };
        scene.bodies.push(ball(DVec3::new(0.1, -0.1, 0.0), 0.03, thrown));
        contact(&mut scene, THICKNESS, 0.0);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        run(&mut simulation, 0.1, time_step);
        let [door, ball] = [0, 1].map(|body| simulation.body_motion(body).unwrap());
        assert!(
            door.centre.length() < 1e-15 && door.velocity == DVec3::ZERO,
            "{}",
            door.centre
        );
        assert!(
            door.spin.x.abs().max(door.spin.y.abs()) < 1e-12 && door.spin.z > 0.5,
            "{}",
            door.spin
        );
        let own = ball.centre.cross(ball.velocity * ball.mass) + ball.angular_momentum;
        let [found, exact] = [door.angular_momentum.z + own.z, 0.1 * 0.1 * 3.0];
        println!("{time_step}: {found} instead of {exact}, turns by {}", door.spin.z);
        assert!((found - exact).abs() < 5e-3 * exact, "{time_step}: {found}");
    }
}

#[test]
fn a_ball_that_hits_a_free_sheet_keeps_momentum_and_angular_momentum_together_with_it() {
    for time_step in [1e-3, 4e-3] {
        let cloth = sheet(0.4, 12, 0.0);
        let of_sheet = masses(cloth.mesh(), DENSITY);
        let mut scene = scene(cloth, time_step, 0.0, 0.3);
        let motion = FreeMotion {
            velocity: DVec3::new(0.3, 0.0, -2.0),
            spin: DVec3::new(0.0, 5.0, 2.0),
            ..of_mass(0.05)
        };
        scene.bodies.push(ball(DVec3::new(0.05, 0.02, 0.06), 0.05, motion));
        contact(&mut scene, THICKNESS, 0.0);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let all = |simulation: &Simulation| {
            let [linear, angular] = momenta(simulation, &of_sheet, DVec3::ZERO);
            let body = simulation.body_motion(0).unwrap();
            let own = body.velocity * body.mass;
            [linear + own, angular + body.centre.cross(own) + body.angular_momentum]
        };
        let before = all(&simulation);
        run(&mut simulation, 0.1, time_step);
        let after = all(&simulation);
        let ball = simulation.body_motion(0).unwrap();
        assert!(ball.velocity.z > -1.9, "the sheet slows it down: {}", ball.velocity);
        for (what, k) in [("momentum", 0), ("angular momentum", 1)] {
            let error = (after[k] - before[k]).length() / before[k].length();
            println!("{time_step}: {what} changes by {error:e}");
            assert!(error < 1e-9, "{time_step}: {what} changes by {error:e}");
        }
        assert!(simulation.is_certified());
    }
}

#[test]
fn pins_carry_the_weight_of_a_sheet_and_of_the_ball_that_lies_in_it() {
    for (mass, time_step) in [(0.1, 4e-3), (1.0, 4e-3), (0.1, 1e-3)] {
        let cloth = sheet(0.5, 16, 0.0);
        let all: f64 = masses(cloth.mesh(), DENSITY).iter().sum();
        let edge = |point: &DVec3| point.x.abs().max(point.y.abs()) > 0.2499;
        let vertices = cloth.mesh().positions.iter().zip(0..);
        let border: Vec<u32> = vertices.filter(|(point, _)| edge(point)).map(|(_, vertex)| vertex).collect();
        let mut scene = scene(cloth, time_step, G, 0.3);
        scene.add(AirDrag { rate: 100.0 });
        scene.bodies.push(ball(DVec3::Z * 0.084, 0.08, of_mass(mass)));
        scene.add(Pins {
            groups: vec![PinGroup::resting(border)],
        });
        contact(&mut scene, THICKNESS, 0.0);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        run(&mut simulation, 16.0, time_step);
        let pins = simulation.pin_load(0, DVec3::ZERO).unwrap().force;
        let weight = (mass + all) * G;
        let error = (pins + DVec3::Z * weight).length() / weight;
        let own = simulation.body_load(0, DVec3::ZERO).unwrap().total().force;
        let of_ball = (own - DVec3::Z * mass * G).length() / (mass * G);
        let speed = simulation.body_motion(0).unwrap().velocity.length();
        println!("{mass} kg at {time_step}: pins {error:e}, ball {of_ball:e}, {speed:e} m/s");
        assert!(error < 1e-3, "{mass} kg: {pins} instead of {weight}");
        assert!(of_ball < 1e-3, "{mass} kg: {own}");
        assert!(speed < 1e-2, "{mass} kg: {speed} m/s");
        assert!(simulation.is_certified());
    }
}

#[test]
fn a_box_rests_on_a_table_that_carries_its_weight() {
    for (mass, time_step) in [(0.1, 4e-3), (10.0, 4e-3), (1.0, 1e-3)] {
        let mut scene = scene(aside(), time_step, G, 0.4);
        scene.bodies.push(table(8, 0.0));
        scene
            .bodies
            .push(cuboid("box", DVec3::Z * 0.06, DVec3::new(0.2, 0.1, 0.1), of_mass(mass)));
        contact(&mut scene, THICKNESS, 0.0);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        run(&mut simulation, 1.0, time_step);
        let load = simulation.body_load(0, DVec3::ZERO).unwrap().total().force;
        let error = (load + DVec3::Z * mass * G).length() / (mass * G);
        let body = simulation.body_motion(1).unwrap();
        println!(
            "{mass} kg at {time_step}: {error:e}, {:e} m/s, at {}",
            body.velocity.length(),
            body.centre
        );
        assert!(error < 1e-3, "{mass} kg: {load}");
        assert!(body.velocity.length() < 1e-3 && body.spin.length() < 1e-2);
        assert!((body.centre.z - 0.05 - THICKNESS).abs() < 0.1 * THICKNESS, "{}", body.centre);
    }
}

#[test]
fn a_box_on_a_slope_slides_by_coulombs_law_or_stays() {
    let angle = 0.5_f64;
    let down = DVec3::new(angle.cos(), 0.0, -angle.sin());
    let up = DVec3::new(angle.sin(), 0.0, angle.cos());
    for (friction, time_step) in [(0.2, 1e-3), (0.2, 4e-3), (0.8, 4e-3)] {
        let mut scene = scene(aside(), time_step, G, friction);
        scene.bodies.push(table(8, angle));
        let mut body = cuboid("box", DVec3::ZERO, DVec3::new(0.2, 0.2, 0.05), of_mass(1.0));
        let turn = DQuat::from_rotation_y(angle);
        let placement = Placement::new(turn, up * (0.025 + THICKNESS) - down * 0.4);
        body.motion = FreeMotion {
            placement,
            ..of_mass(1.0)
        }
        .into();
        scene.bodies.push(body);
        contact(&mut scene, THICKNESS, 0.0);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        run(&mut simulation, 0.2, time_step);
        let early = simulation.body_motion(1).unwrap().velocity.dot(down);
        run(&mut simulation, 0.2, time_step);
        let late = simulation.body_motion(1).unwrap();
        let found = (late.velocity.dot(down) - early) / 0.2;
        let exact = (G * (angle.sin() - friction * angle.cos())).max(0.0);
        println!(
            "friction {friction} at {time_step}: {found} instead of {exact}; spin {}",
            late.spin
        );
        assert!((found - exact).abs() < 0.01 * G, "{found} instead of {exact}");
        assert!(late.spin.length() < 0.05, "{}", late.spin);
    }
}

#[test]
fn two_balls_that_meet_keep_their_momenta_and_do_not_pass_through_each_other() {
    for time_step in [1e-3, 4e-3] {
        let mut scene = scene(aside(), time_step, 0.0, 0.3);
        for (name, x, mass, speed) in [("left", -0.1, 0.1, 1.0), ("right", 0.1, 100.0, -0.5)] {
            let motion = FreeMotion {
                velocity: DVec3::X * speed,
                ..of_mass(mass)
            };
            let centre = DVec3::new(x, 0.2 * x, 0.0);
            scene.bodies.push(free(Body::ball(name, centre, 0.05, 16).unwrap(), motion));
        }
        contact(&mut scene, THICKNESS, 0.0);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let all = |simulation: &Simulation| {
            let bodies = [0, 1].map(|body| simulation.body_motion(body).unwrap());
            let add = |[linear, angular]: [DVec3; 2], body: selvedge_cloth::FreeBodyState| {
                let own = body.velocity * body.mass;
                [linear + own, angular + body.centre.cross(own) + body.angular_momentum]
            };
            bodies.into_iter().fold([DVec3::ZERO; 2], add)
        };
        let before = all(&simulation);
        run(&mut simulation, 0.4, time_step);
        let after = all(&simulation);
        let [left, right] = [0, 1].map(|body| simulation.body_motion(body).unwrap());
        println!("{time_step}: {left:?} {right:?}");
        assert!(left.velocity.x < 0.0 && left.centre.distance(right.centre) > 0.099);
        for k in 0..2 {
            let error = (after[k] - before[k]).length() / before[0].length();
            assert!(error < 1e-9, "{time_step}: {error:e}");
        }
    }
}

/// A ball that falls into a sheet which is held at two sides, and from there onto a table.
fn falling() -> Scene {
    let cloth = sheet(0.4, 10, 0.1);
    let edge = |point: &DVec3| point.x.abs() > 0.199;
    let vertices = cloth.mesh().positions.iter().zip(0..);
    let border: Vec<u32> = vertices.filter(|(point, _)| edge(point)).map(|(_, vertex)| vertex).collect();
    let mut scene = scene(cloth, 2e-3, G, 0.3);
    scene.add(Pins {
        groups: vec![PinGroup::resting(border)],
    });
    let motion = FreeMotion {
        spin: DVec3::new(0.0, 3.0, 1.0),
        velocity: DVec3::new(0.0, 0.4, 0.0),
        ..of_mass(0.3)
    };
    scene.bodies.push(ball(DVec3::new(0.02, 0.03, 0.2), 0.05, motion));
    scene.bodies.push(table(8, 0.0));
    contact(&mut scene, THICKNESS, 0.0);
    scene
}

#[test]
fn a_scene_with_a_free_body_has_the_same_bits_on_any_number_of_threads_and_after_a_checkpoint() {
    let steps = |simulation: &mut Simulation, count: u64| (0..count).for_each(|_| simulation.step().unwrap());
    let mut whole = Simulation::new(falling(), 1).unwrap();
    let mut other = Simulation::new(falling(), 2).unwrap();
    steps(&mut whole, CHECKPOINT_STEPS);
    steps(&mut other, CHECKPOINT_STEPS);
    assert_eq!(whole.positions(), other.positions());
    let mut resumed = Simulation::new(falling(), 1).unwrap();
    resumed.resume(&whole.checkpoint().unwrap()).unwrap();
    assert_eq!(whole.body_motion(0), resumed.body_motion(0));
    steps(&mut whole, 100);
    steps(&mut resumed, 100);
    assert_eq!(whole.positions(), resumed.positions());
    assert_eq!(whole.body_motion(0), resumed.body_motion(0));
    assert!(whole.is_certified());
}
