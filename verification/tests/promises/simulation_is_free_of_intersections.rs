//! Every state that a simulation accepts is exactly free of intersections of cloth with itself and with bodies, ropes included.

use crate::support::prelude::*;
use selvedge_cloth::effects::{BodyContact, Friction, RopeBend, RopeStretch, SelfCollision, Stretch, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, Cloth, Scene, SetupError, Simulation};
use selvedge_verification::oracle::{edges_that_meet, intersections_with_loose_edges, mesh_intersections};
use std::path::{Path, PathBuf};

fn scene_file(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    root.join("std-adapter/cloth/scenes").join(name)
}

fn load(name: &str, change: impl Fn(String) -> String) -> Simulation {
    let path = scene_file(name);
    let text = std::fs::read_to_string(&path).expect("a scene that comes with the program");
    let scene = Scene::parse(&change(text), &path).expect("a good scene");
    Simulation::new(scene, 1).expect("a scene that starts free")
}

/// Returns pairs of triangles that intersect, at least one of them cloth; bodies may overlap each other.
fn intersections(simulation: &Simulation) -> Vec<[u32; 2]> {
    let positions: Vec<_> = simulation.positions().iter().map(|p| p.to_array()).collect();
    mesh_intersections(&positions, simulation.triangles(), simulation.cloth_triangles())
}

/// Checks every state that is a multiple of `every`. Returns the number of steps.
fn run(simulation: &mut Simulation, steps: u64, every: u64) {
    for step in 1..=steps {
        if let Err(blocked) = simulation.step() {
            panic!("step {step}: {blocked}");
        }
        assert!(simulation.positions().iter().all(|p| p.is_finite()));
        if step % every == 0 {
            assert_eq!(intersections(simulation), [[0; 2]; 0], "after step {step}");
        }
    }
}

#[test]
fn the_arm_sleeve_is_free_throughout_the_bend() {
    let mut simulation = load("arm-sleeve.toml", |text| text);
    run(&mut simulation, 1300, 100);
    let counts = simulation.contact_counts().expect("a scene with contact");
    assert!(counts.pushed > 1000, "the sleeve touches the arm and itself");
    assert_eq!(counts.cuts, 0);
    assert!(counts.held * 20 < 1300, "{} vertices held back", counts.held);
}

#[test]
fn a_sheet_that_falls_on_a_ball_is_free() {
    let mut simulation = load("drop.toml", |text| text);
    run(&mut simulation, 700, 100);
}

#[test]
fn a_sheet_that_is_folded_twice_is_free() {
    let mut simulation = load("fold.toml", |text| text);
    run(&mut simulation, 3000, 300);
}

/// The time step is doubled, and stiffness varies over six orders of magnitude.
#[test]
fn stiff_and_soft_cloth_in_long_steps_is_free() {
    for factor in [1e-3, 1.0, 1e3] {
        let change = |text: String| {
            let text = text.replace("time_step = \"1 ms\"", "time_step = \"2 ms\"");
            let text = text.replace("\"400 N/m\"", &(400.0 * factor).to_string());
            let text = text.replace("\"80 N/m\"", &(80.0 * factor).to_string());
            text.replace("\"15 uN m\"", &(15e-6 * factor).to_string())
        };
        let mut simulation = load("drop.toml", change);
        run(&mut simulation, 500, 50);
        let counts = simulation.contact_counts().expect("a scene with contact");
        assert!(counts.pushed > 1000, "{factor}");
    }
}

#[test]
fn a_tube_twisted_three_turns_is_free() {
    // The scene runs in a fifth of the time, so that the folds close within the test.
    let faster = |text: String| text.replace("time = \"10 s\"", "time = \"2 s\"");
    let mut simulation = load("twist.toml", faster);
    run(&mut simulation, 2000, 250);
}

/// Checks all steps in which the cloth tears, and the steps after which much has come loose.
#[test]
fn a_sheet_that_rips_is_free_in_every_state() {
    let coarser = |text: String| text.replace("cells = [60, 40]", "cells = [30, 20]");
    let mut simulation = load("tear.toml", coarser);
    run(&mut simulation, 200, 50);
    while simulation.steps_done() < 800 {
        let before = simulation.torn_edges().len();
        run(&mut simulation, 1, 20);
        if simulation.torn_edges().len() > before || simulation.steps_done() % 20 == 0 {
            assert_eq!(
                intersections(&simulation),
                [[0; 2]; 0],
                "after step {}",
                simulation.steps_done()
            );
            assert!(simulation.is_certified());
        }
    }
    assert!(simulation.torn_edges().len() >= 20);
}

#[test]
fn a_hem_pulled_through_folds_at_high_speed_is_free() {
    let mut simulation = load("violent.toml", |text| text);
    run(&mut simulation, 600, 60);
    let counts = simulation.contact_counts().expect("a scene with contact");
    assert!(counts.pushed > 1000, "contacts had something to do: {counts:?}");
}

/// Cloth that is coarser, thicker and a thousand times as stiff jams between the pins: thousands of pairs push. The pins never
/// wait, and hardly a step is cut.
#[test]
fn stiff_cloth_that_is_jammed_between_pins_is_free_and_does_not_stop_them() {
    let change = |text: String| {
        let text = text.replace("\"300 N/m\"", "300e3").replace("\"100 N/m\"", "100e3");
        let text = text.replace("\"10 uN m\"", "10e-3");
        text.replace("[20, 20]", "[8, 8]").replace("\"3 mm\"", "\"10 mm\"")
    };
    let mut simulation = load("violent.toml", change);
    run(&mut simulation, 1500, 100);
    let counts = simulation.contact_counts().expect("a scene with contact");
    assert!(counts.pushed > 10_000, "it is jammed: {counts:?}");
    assert_eq!(simulation.blocked_steps(), 0, "{counts:?}");
    assert!(counts.cuts < 65, "{counts:?}");
}

/// The same sleeve without the certified effects shows that the tests above can fail.
#[test]
fn without_self_collision_the_sleeve_passes_through_itself() {
    let without = |text: String| text.replace("[effects.self_collision]\nthickness = \"3 mm\"\n", "");
    let mut simulation = load("arm-sleeve.toml", without);
    let mut crossed = 0;
    for step in 1..=1300 {
        simulation.step().expect("bodies alone do not block");
        if step % 100 == 0 {
            crossed += intersections(&simulation).len();
        }
    }
    assert!(crossed > 0);
}

/// Makes ropes through these points, thrown at each other, at a sheet and at a ball.
fn thrown(ropes: &[([DVec3; 3], DVec3)], is_kept: bool) -> Scene {
    let sheet = Cloth::sheet(DVec3::new(-0.1, -0.1, -0.05), [DVec3::X * 0.2, DVec3::Y * 0.2], [6, 6], 0.2);
    let mut scene = Scene::new(sheet.expect("a sheet").named("sheet"), 2e-3);
    scene.add_to("sheet", Stretch::isotropic(500.0));
    for (number, (points, velocity)) in ropes.iter().enumerate() {
        let name = format!("rope {number}");
        let mut rope = Cloth::rope(points, 20, 0.02).expect("three places").named(&name);
        rope.velocity = *velocity;
        scene
            .add_to(&name, RopeStretch::new(2e3))
            .add_to(&name, RopeBend::straight(1e-6));
        if is_kept {
            scene.add_to(&name, SelfCollision(Thickness::new(6e-3)));
        }
        scene.cloths.push(rope);
    }
    scene
        .bodies
        .push(Body::ball("ball", DVec3::Z * -0.2, 0.1, 12).expect("a ball"));
    scene
        .add(BodyContact(Thickness::new(3e-3)))
        .add(Friction { coefficient: 0.2 });
    if is_kept {
        scene.add(SelfCollision(Thickness::new(3e-3)));
    }
    scene
}

/// Returns the number of paths that were examined, and the intersections on them or after them.
fn judge(simulation: &mut Simulation, steps: u64) -> (u64, Vec<String>) {
    let (mut judged, mut found) = (0, Vec::new());
    let cuts = |simulation: &Simulation| simulation.contact_counts().map_or(0, |counts| counts.cuts);
    let at = |simulation: &Simulation| -> Vec<[f64; 3]> { simulation.positions().iter().map(|p| p.to_array()).collect() };
    for _ in 0..steps {
        let (before, cuts_before) = (at(simulation), cuts(simulation));
        simulation.step().expect("nothing is forced to move");
        let after = at(simulation);
        let [triangles, count] = [simulation.triangles().len(), simulation.cloth_triangles()];
        assert!(count < triangles);
        let at_rest = intersections_with_loose_edges(&after, simulation.triangles(), simulation.loose_edges(), count);
        found.extend(at_rest.iter().map(|pair| format!("{pair:?}")));
        // In a step that is cut into parts, a path is not straight.
        if cuts(simulation) == cuts_before {
            judged += 1;
            let on_the_way = edges_that_meet(&before, &after, simulation.loose_edges());
            found.extend(on_the_way.iter().map(|pair| format!("{pair:?}")));
        }
    }
    (judged, found)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10))]

    #[test]
    fn ropes_that_are_thrown_at_each_other_at_cloth_and_at_a_body_never_meet(
        ropes in prop::collection::vec((
            prop::array::uniform3(prop::array::uniform3(-0.2..0.2_f64).prop_map(DVec3::from)),
            prop::array::uniform3(-8.0..8.0_f64).prop_map(DVec3::from),
        ), 2..5),
    ) {
        let mut simulation = match Simulation::new(thrown(&ropes, true), 1) {
            Ok(simulation) => simulation,
            Err(SetupError::Tangled(_)) => return Err(TestCaseError::reject("through the sheet or the ball at the start")),
            Err(error) => panic!("{error}"),
        };
        let (judged, found) = judge(&mut simulation, 60);
        prop_assert!(found.is_empty(), "{found:?}");
        prop_assert!(judged > 30, "{judged}");
    }
}

/// This shows that the test above can fail.
#[test]
fn without_self_collision_ropes_pass_through_each_other() {
    let rope = |axis: DVec3, z: f64, speed: f64| {
        (
            [axis * -0.2, DVec3::ZERO, axis * 0.2].map(|p| p + DVec3::Z * z),
            DVec3::Z * speed,
        )
    };
    let ropes = [rope(DVec3::X, 0.2, -2.0), rope(DVec3::Y, 0.1, 0.0)];
    let found = |is_kept| judge(&mut Simulation::new(thrown(&ropes, is_kept), 1).expect("it starts free"), 60).1;
    assert!(!found(false).is_empty() && found(true).is_empty());
}
