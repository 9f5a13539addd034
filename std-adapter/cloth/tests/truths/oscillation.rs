//! Periods: a mass on a spring swings with ω = √(k/m), a pendulum with T = 2π·√(l/g)·(1 + θ²/16) for small angles θ.
//!
//! A spring is linear, so a step is exactly an implicit Euler step: each turns the phase by atan(ωh) and divides the amplitude by √(1 + ω²h²). Both
//! errors vanish with the step.

use selvedge_cloth::effects::{Gravity, PinGroup, Pins, RopeStretch};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Scene, Simulation};
use std::f64::consts::TAU;

const LENGTH: f64 = 0.5;
const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 0.2;

/// One segment, pinned at the origin, whose other end is at `end`.
fn hung(end: DVec3, stiffness: f64, step: f64) -> Simulation {
    let mut scene = Scene::new(Cloth::rope(&[DVec3::ZERO, end], 1, DENSITY).unwrap(), step);
    scene.add(Gravity::default()).add(RopeStretch::new(stiffness));
    scene.add(Pins {
        groups: vec![PinGroup::resting([0])],
    });
    Simulation::new(scene, 1).unwrap()
}

#[test]
fn a_mass_on_a_spring_swings_as_its_stiffness_says_and_loses_what_implicit_steps_lose() {
    let mass = 0.5 * DENSITY * LENGTH;
    let stiffness = mass * (TAU / 0.4_f64).powi(2);
    let errors = [1e-3, 2e-3, 4e-3].map(|step| {
        let mut simulation = hung(-DVec3::Z * LENGTH, stiffness * LENGTH, step);
        let sag = mass * GRAVITY / stiffness;
        let square = stiffness / mass * step * step;
        let mut error = 0.0_f64;
        for n in 1..=(1.0 / step) as i32 {
            simulation.step().unwrap();
            let below = -simulation.positions()[1].z - LENGTH;
            let phase = f64::from(n) * square.sqrt().atan();
            let lost = (1.0 + square).powf(-0.5 * f64::from(n));
            let implicit = sag * (1.0 - lost * phase.cos());
            assert!(
                (below - implicit).abs() < 1e-6 * sag,
                "step {n} of {step} s: {below} for {implicit}"
            );
            let exact = sag * (1.0 - (f64::from(n) * step * TAU / 0.4).cos());
            error = error.max((below - exact).abs() / sag);
        }
        error
    });
    println!("largest errors in a second, in amplitudes: {errors:?}");
    assert!(
        errors[0] < 0.2 && errors[0] < 0.6 * errors[1] && errors[1] < 0.65 * errors[2],
        "{errors:?}"
    );
}

#[test]
fn a_pendulum_keeps_its_period() {
    let angle = 0.1_f64;
    let expected = TAU * (LENGTH / GRAVITY).sqrt() * (1.0 + angle * angle / 16.0);
    for step in [1e-3, 2e-3, 4e-3] {
        let mut simulation = hung(DVec3::new(angle.sin(), 0.0, -angle.cos()) * LENGTH, 1e6, step);
        let mut crossings = Vec::new();
        while crossings.len() < 9 {
            let before = simulation.positions()[1].x;
            simulation.step().unwrap();
            let after = simulation.positions()[1].x;
            if before * after < 0.0 {
                crossings.push(simulation.time() - step * after / (after - before));
            }
        }
        let period = (crossings[8] - crossings[0]) / 4.0;
        println!("{step} s: {period} s for {expected}");
        assert!((period / expected - 1.0).abs() < 1e-4, "{step} s: {period} for {expected}");
    }
}
