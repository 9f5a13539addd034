//! Simulations have the same bits, however they are run.

use crate::common::*;

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let run = |threads| {
        let mut simulation = load("arm-sleeve-10.toml", |text| text, threads);
        advance(&mut simulation, 20);
        simulation.positions().to_vec()
    };
    assert_eq!(run(1), run(2));
}

#[test]
fn a_resumed_simulation_has_the_same_bits() {
    let fast = |text: String| text.replace("time = \"0.2 s\"", "time = \"0.01 s\"");
    let mut whole = load("arm-sleeve.toml", fast, 1);
    advance(&mut whole, CHECKPOINT_STEPS);
    let checkpoint = whole.checkpoint().unwrap();
    let mut resumed = load("arm-sleeve.toml", fast, 1);
    resumed.resume(&checkpoint).unwrap();
    // Counters continue as well.
    assert_eq!(resumed.contact_counts(), whole.contact_counts());
    assert_eq!(resumed.effects(), whole.effects());
    for _ in 0..150 {
        whole.step().unwrap();
        assert_eq!(whole.checkpoint(), None);
        resumed.step().unwrap();
    }
    assert_eq!(whole.positions(), resumed.positions());
    assert_eq!(resumed.steps_done(), CHECKPOINT_STEPS + 150);
    let mut other = load("hanging.toml", |text| text, 1);
    assert_eq!(other.resume(&checkpoint), Err(CheckpointError::OtherScene));
}

/// The bits are the same in a violent scene, where hierarchies are rebuilt in steps that depend on earlier ones.
#[test]
fn a_simulation_resumed_at_any_checkpoint_goes_on_with_the_same_bits() {
    let load = || load("violent.toml", |text| text, 1);
    let until_checkpoint = |simulation: &mut Simulation| {
        advance(simulation, CHECKPOINT_STEPS);
        simulation.checkpoint().unwrap()
    };
    let mut whole = load();
    let mut checkpoint = until_checkpoint(&mut whole);
    for _ in 0..3 {
        let mut resumed = load();
        resumed.resume(&checkpoint).unwrap();
        checkpoint = until_checkpoint(&mut whole);
        until_checkpoint(&mut resumed);
        let step = whole.steps_done();
        assert!(whole.positions() == resumed.positions(), "step {step}");
        assert_eq!(whole.contact_counts(), resumed.contact_counts());
    }
}

/// A scene without a time step runs by frames, whose steps differ in number. So a checkpoint comes after a frame, not after a
/// round number of steps.
#[test]
fn frames_of_a_scene_without_a_time_step_have_the_same_bits_on_any_threads_and_after_a_resume() {
    let load = |threads| load("drop.toml", |text| text.replace("time_step = \"1 ms\"\n", ""), threads);
    let (mut whole, mut resumed) = (load(2), load(1));
    let (mut checkpoint, mut frames) = (None, 0);
    while checkpoint.is_none() {
        whole.run().unwrap();
        frames += 1;
        let is_round = whole.steps_done().is_multiple_of(CHECKPOINT_STEPS);
        checkpoint = whole.checkpoint().filter(|_| !is_round);
    }
    assert!(frames < CHECKPOINT_STEPS && whole.steps_done() >= CHECKPOINT_STEPS);
    assert_eq!(whole.runs_done(), frames);
    resumed.resume(&checkpoint.unwrap()).unwrap();
    for _ in 0..10 {
        whole.run().unwrap();
        assert_eq!(whole.checkpoint(), None);
        let frame = resumed.advance(0.025).unwrap();
        assert!(frame.steps >= 6 && frame.steps == frame.needed);
    }
    assert_eq!(whole.positions(), resumed.positions());
    assert_eq!(whole.runs_done(), frames + 10);
    assert!((whole.time() - 0.025 * (frames + 10) as f64).abs() < 1e-9);
}
