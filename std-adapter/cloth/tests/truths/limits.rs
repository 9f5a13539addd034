//! No edge is longer than its limit by more than 5 %, with friction, contact and seams.

use crate::elastic;
use selvedge_cloth::effects::{BodyContact, Friction, Gravity, SelfCollision, StrainLimit, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, Cloth, Scene, Simulation};
use std::path::Path;

const LIMIT: f64 = 1.08;

fn dropped(step: f64) -> Simulation {
    let cloth = Cloth::sheet(DVec3::new(-0.4, -0.4, 0.25), [0.8 * DVec3::X, 0.8 * DVec3::Y], [16, 16], 0.15).unwrap();
    let mut scene = Scene::new(cloth, step);
    scene
        .bodies
        .push(Body::ball("ball", DVec3::new(0.03, 0.02, 0.0), 0.2, 24).unwrap());
    elastic(&mut scene, 400.0, 15e-6);
    scene
        .add(Gravity::default())
        .add(StrainLimit::at(LIMIT))
        .add(Friction { coefficient: 0.3 });
    let thickness = Thickness::new(3e-3);
    scene.add(BodyContact(thickness)).add(SelfCollision(thickness));
    Simulation::new(scene, 1).unwrap()
}

/// Returns the longest edge in a second over its length at rest, where `advance` simulates a frame of 1/60 s.
fn longest(simulation: &mut Simulation, mut advance: impl FnMut(&mut Simulation)) -> f64 {
    let mut longest = 0.0_f64;
    while simulation.time() < 1.0 {
        advance(simulation);
        longest = longest.max(simulation.edge_stretch().largest);
    }
    longest
}

#[test]
fn edges_keep_their_limit_in_contact_and_in_frames() {
    for step in [1e-3, 2e-3, 1.0 / 240.0] {
        let mut simulation = dropped(step);
        let longest = longest(&mut simulation, |simulation| simulation.step().unwrap());
        println!("{step} s: {longest}");
        assert!(longest < 1.05 * LIMIT, "{step} s: {longest}");
        assert_eq!(simulation.overstretched_steps(), 0);
    }
    let mut simulation = dropped(1e-3);
    let longest = longest(&mut simulation, |simulation| {
        let frame = simulation.advance(1.0 / 60.0).unwrap();
        assert_eq!(frame.steps, frame.needed);
    });
    println!("frames: {longest}");
    assert!(longest < 1.05 * LIMIT, "{longest}");
}

/// The shirt's shoulders close after 0.3 s, those of the vest over it after 0.4 s.
#[test]
fn edges_at_the_ends_of_seams_keep_their_limit() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/layers.toml");
    let mut simulation = Simulation::new(Scene::read(&path).unwrap(), 1).unwrap();
    let mut largest = 0.0_f64;
    while simulation.time() < 0.45 {
        simulation.step().unwrap();
        largest = largest.max(simulation.longest_over_limit().unwrap());
    }
    println!("{largest}");
    assert!(largest < 1.05 && simulation.overstretched_steps() == 0, "{largest}");
}

/// Attachments draw the sheet taut over a rod, and must feel that it is, to release it.
#[test]
fn a_sheet_that_is_drawn_over_a_rod_is_short_again_after_its_release() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/crease.toml");
    let mut scene = Scene::read(&path).unwrap();
    scene.time_step = 2e-3;
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let mut largest = 0.0_f64;
    while simulation.time() < 1.4 {
        simulation.step().unwrap();
        largest = largest.max(simulation.edge_stretch().largest);
    }
    let at_end = simulation.edge_stretch().largest;
    println!("{largest}, {at_end}");
    assert!(largest < 2.0 && at_end < 1.1, "{largest} {at_end}");
}

#[test]
fn a_step_of_a_whole_frame_keeps_the_limit_too_and_a_frame_says_how_many_steps_it_needs() {
    let mut simulation = dropped(1.0 / 60.0);
    let longest = longest(&mut simulation, |simulation| simulation.step().unwrap());
    println!("1/60 s: {longest}");
    assert!(longest < 1.02 * LIMIT && simulation.overstretched_steps() == 0, "{longest}");
    let limited = dropped(1e-3).advance_within(1.0 / 60.0, 2).unwrap();
    assert!(limited.steps == 2 && limited.needed == 4, "{limited:?}");
    assert!(dropped(1e-3).advance(2.0).is_err() && dropped(1e-3).advance(f64::NAN).is_err());
}
