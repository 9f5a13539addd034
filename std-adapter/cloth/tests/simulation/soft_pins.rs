//! Soft pins in scenes and from code: the same bits, jumps, overlaps and mistakes.

use crate::common::*;

const FILE: &str = include_str!("scenes/soft_pins.toml");

fn of_file() -> Scene {
    Scene::parse(FILE, Path::new("s.toml")).unwrap()
}

fn soft(vertices: impl Into<Vec<u32>>, motion: PinMotion, stiffness: f64) -> PinGroup {
    PinGroup {
        stiffness: Some(stiffness),
        ..PinGroup::new(vertices, motion)
    }
}

fn driven() -> PinMotion {
    PinMotion::Own(BodyMotion::Driven(Placement::default()))
}

fn hung(groups: Vec<PinGroup>) -> Scene {
    let sheet = Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.2, DVec3::Z * 0.2], [4, 4], 0.2).unwrap();
    let mut scene = Scene::new(sheet, 2e-3);
    scene.add(Gravity::default()).add(Stretch::isotropic(500.0));
    scene.add(Shear::new(100.0)).add(AirDrag { rate: 5.0 });
    scene.add(Pins { groups });
    scene
}

#[test]
fn soft_pins_from_a_file_and_from_code_are_the_same_to_the_last_bit() {
    let mut held = PinGroup::resting([20, 21]);
    held.weights = vec![1.0, 0.0];
    let key = |time: f64, translation: DVec3| Keyframe {
        time,
        translation,
        ..Keyframe::default()
    };
    let keys = vec![key(0.1, DVec3::ZERO), key(0.5, DVec3::new(0.05, 0.0, 0.1))];
    let motion = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, keys).unwrap();
    let mut pulled = soft([22, 23, 24], PinMotion::Own(motion.into()), 20.0);
    pulled.weights = vec![0.0, 0.25, 1.0];
    assert_eq!(bits(&run(of_file(), 300)), bits(&run(hung(vec![held, pulled]), 300)));
}

#[test]
fn soft_pins_have_the_same_bits_on_any_number_of_threads_and_after_a_resume() {
    assert_same_bits(of_file, CHECKPOINT_STEPS, 100);
}

/// The anchors that the caller has moved are in the checkpoint, as the positions of hard pins are.
#[test]
fn driven_soft_pins_stay_where_they_were_moved_after_a_resume() {
    let scene = || {
        let mut group = soft([20, 22, 24], driven(), 50.0);
        group.weights = vec![1.0, 0.5, 1.0];
        hung(vec![group])
    };
    let start = scene().cloths[0].mesh().positions.clone();
    let lead = |simulation: &mut Simulation, steps: std::ops::RangeInclusive<u64>| {
        for step in steps {
            let way = DVec3::new(0.2, 0.1, 0.1) * (step as f64 * 2e-3);
            let to = [20, 22, 24].map(|vertex: usize| start[vertex] + way);
            simulation.move_pins(0, &to).unwrap();
            simulation.step().unwrap();
        }
    };
    let mut one = Simulation::new(scene(), 1).unwrap();
    lead(&mut one, 1..=CHECKPOINT_STEPS);
    let mut resumed = Simulation::new(scene(), 1).unwrap();
    resumed.resume(&one.checkpoint().unwrap()).unwrap();
    assert_eq!(one.energy(), resumed.energy());
    for simulation in [&mut one, &mut resumed] {
        advance(simulation, 20);
        lead(simulation, CHECKPOINT_STEPS + 1..=CHECKPOINT_STEPS + 50);
    }
    assert!(bits(&one) == bits(&resumed));
    assert_eq!(one.pin_load(0, DVec3::ZERO), resumed.pin_load(0, DVec3::ZERO));
}

/// Nothing pulls a vertex of weight 0, wherever the caller moves its point.
#[test]
fn vertices_of_weight_zero_are_free() {
    let scene = |weights: Vec<f64>, vertices: Vec<u32>| {
        let mut group = soft(vertices, driven(), 100.0);
        group.weights = weights;
        hung(vec![PinGroup::resting([20]), group])
    };
    let mut one = Simulation::new(scene(vec![1.0, 0.0], vec![24, 0]), 1).unwrap();
    let mut other = Simulation::new(scene(Vec::new(), vec![24]), 1).unwrap();
    let at = one.positions()[24];
    for step in 1..=100 {
        let to = at + DVec3::Z * (1e-4 * f64::from(step));
        one.move_pins(1, &[to, DVec3::splat(900.0 * f64::from(step % 2))]).unwrap();
        other.move_pins(1, &[to]).unwrap();
        one.step().unwrap();
        other.step().unwrap();
    }
    assert!(bits(&one) == bits(&other));
}

#[test]
fn anchors_that_are_moved_too_fast_are_errors_with_their_group() {
    let mut simulation = Simulation::new(hung(vec![soft([24], driven(), 100.0)]), 1).unwrap();
    let before = simulation.positions().to_vec();
    simulation.move_pins(0, &[DVec3::splat(1.0)]).unwrap();
    let blocked = simulation.step().unwrap_err().to_string();
    assert!(blocked.starts_with("the group 0 of pins is to move at "), "{blocked}");
    assert_eq!(simulation.positions(), before);
}

/// The anchors move by four cells in the first frame, while the cloth is still at rest.
#[test]
fn a_frame_takes_as_many_steps_for_anchors_as_for_pinned_vertices() {
    const FRAME: f64 = 1.0 / 60.0;
    let way = DVec3::Z * 0.2;
    let key = |time: f64, translation: DVec3| Keyframe {
        time,
        translation,
        ..Keyframe::default()
    };
    let keys = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, vec![key(0.0, DVec3::ZERO), key(FRAME, way)]).unwrap();
    for motion in [driven(), PinMotion::Body(0), PinMotion::Own(keys.into())] {
        let [hard, soft] = [None, Some(50.0)].map(|stiffness| {
            let mut group = PinGroup::new([20, 24], motion.clone());
            group.stiffness = stiffness;
            let mut scene = hung(vec![group]);
            let mut ball = Body::ball("ball", DVec3::new(0.1, 0.3, 0.2), 0.1, 12).unwrap();
            ball.motion = BodyMotion::Driven(Placement::default());
            scene.bodies.push(ball);
            let mut simulation = Simulation::new(scene, 1).unwrap();
            match motion {
                PinMotion::Body(_) => simulation.place_body(0, Placement::at(way)).unwrap(),
                PinMotion::Own(BodyMotion::Driven(_)) => {
                    let to = [20, 24].map(|vertex: usize| simulation.positions()[vertex] + way);
                    simulation.move_pins(0, &to).unwrap();
                }
                PinMotion::Own(_) => {}
            }
            simulation.advance(FRAME).unwrap().needed
        });
        assert!(soft == hard && hard > 4, "{motion:?}: {soft} and {hard}");
    }
}

/// Two springs of 10 N/m are one of 20 N/m.
#[test]
fn the_forces_of_soft_pins_at_one_vertex_add_up() {
    let rest = PinGroup::resting([]).motion;
    let [twice, once] = [vec![10.0, 10.0], vec![20.0]].map(|each| {
        let groups = each.into_iter().map(|stiffness| soft([20, 24], rest.clone(), stiffness));
        run(hung(groups.collect()), 2500)
    });
    for (twice, once) in twice.positions().iter().zip(once.positions()) {
        assert!(twice.distance(*once) < 1e-6, "{twice} and {once}");
    }
    let loads = [&twice, &once].map(|simulation| simulation.pin_load(0, DVec3::ZERO).unwrap().force.z);
    assert!((loads[0] / loads[1] - 0.5).abs() < 1e-4, "{loads:?}");
}

/// A sheet whose corners follow a driven ball with soft pins, and hang on soft pins that the caller drives.
fn on_a_ball(others: PinMotion) -> Scene {
    let rest = PinMotion::Body(0);
    let mut scene = hung(vec![soft([20, 24], rest, 50.0), soft([22], others, 20.0)]);
    let mut ball = Body::ball("ball", DVec3::new(0.1, 0.3, 0.2), 0.1, 12).unwrap();
    ball.motion = BodyMotion::Driven(Placement::default());
    scene.bodies.push(ball);
    // Without gravity the world looks alike everywhere.
    scene.add(Gravity {
        acceleration: DVec3::ZERO,
    });
    scene
}

#[test]
fn a_teleport_takes_anchors_and_cloth_along() {
    let by = Placement::at(DVec3::new(30.0, -4.0, 2.0));
    for is_moved in [false, true] {
        let [mut simulation, mut stays] = [0, 1].map(|_| {
            let mut simulation = Simulation::new(on_a_ball(driven()), 1).unwrap();
            let middle = simulation.positions()[22];
            for step in 1..=50 {
                let way = DVec3::X * (1e-3 * f64::from(step));
                simulation.place_body(0, Placement::at(way)).unwrap();
                if is_moved {
                    simulation.move_pins(1, &[middle + 0.5 * way]).unwrap();
                }
                simulation.step().unwrap();
            }
            simulation
        });
        simulation.teleport(&[0], &[], by).unwrap();
        for _ in 0..50 {
            simulation.step().unwrap();
            stays.step().unwrap();
        }
        for (there, here) in simulation.positions().iter().zip(stays.positions()) {
            let off = there.distance(by.apply(*here));
            assert!(off < 1e-4, "{off} m off");
        }
    }
}

#[test]
fn a_teleport_is_refused_where_soft_pins_with_keyframes_hold_the_cloth() {
    let mut simulation = Simulation::new(on_a_ball(PinGroup::resting([]).motion), 1).unwrap();
    let error = simulation.teleport(&[0], &[], Placement::at(DVec3::X)).unwrap_err();
    assert_message(
        &error.to_string(),
        "the cloth 'cloth' is held by attachments or soft pins with keyframes as well, which stays…",
    );
}

#[test]
fn wrong_stiffness_and_weights_are_errors_that_say_what_would_be_right() {
    let group = |stiffness: Option<f64>, weights: &[f64]| {
        let mut group = PinGroup::resting([20, 24]);
        (group.stiffness, group.weights) = (stiffness, weights.to_vec());
        Pins { groups: vec![group] }
    };
    assert_complaints! { of_file();
        |s| _ = s.add(group(Some(-1.0), &[])) => "pins: `stiffness` is -1 N/m, but must be from 1e-6 N/m to 1e9 N/m";
        |s| _ = s.add(group(Some(f64::NAN), &[])) => "pins: `stiffness` is NaN N/m, but must be from 1e-6 N/m to 1e9 N/m";
        |s| _ = s.add(group(Some(1.0), &[0.5, f64::NAN])) => "pins: `weights` is NaN, but must be from 0 to 1, at vertex 24";
        |s| _ = s.add(group(Some(1.0), &[1.5, 1.0])) => "pins: `weights` is 1.5, but must be from 0 to 1, at vertex 20";
        |s| _ = s.add(group(Some(1.0), &[1.0]))
            => "pins: `weights` has 1 numbers for 2 vertices: give one number for each vertex, in the order of the vertices";
        |s| _ = s.add(group(None, &[1.0, 0.5]))
            => "pins: vertex 24 has the weight 0.5, which needs soft pins: give `stiffness` in N/m, or weights of 0 and 1 only";
    }
}
