//! Free fall: s = ½·g·t². With a drag of the rate k, v = g/k·(1 − e^(−kt)), which ends at the terminal speed g/k.
//!
//! Semi-implicit steps of h give ½·g·t·(t + h), on any mesh, since no inner force acts. So the error is ½·g·t·h.

use crate::elastic;
use selvedge_cloth::effects::{AirDrag, Gravity};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Scene, Simulation};

#[test]
fn cloth_falls_by_the_law_but_for_half_of_a_step() {
    let (gravity, time) = (9.81, 0.24);
    for cells in [1, 4, 16] {
        for step in [1e-3, 2e-3, 4e-3] {
            let cloth = Cloth::sheet(DVec3::ZERO, [0.5 * DVec3::X, 0.5 * DVec3::Y], [cells; 2], 0.15).unwrap();
            let mut scene = Scene::new(cloth, step);
            scene.add(Gravity {
                acceleration: -gravity * DVec3::Z,
            });
            elastic(&mut scene, 400.0, 1e-2);
            let mut simulation = Simulation::new(scene, 1).unwrap();
            while simulation.time() < time - 0.5 * step {
                simulation.step().unwrap();
            }
            let expected = 0.5 * gravity * time * (time + step);
            for position in simulation.positions() {
                assert!(
                    (position.z + expected).abs() < 1e-12,
                    "{cells} cells, {step} s: {} for {expected}",
                    position.z
                );
            }
        }
    }
}

#[test]
fn drag_ends_at_the_terminal_speed_and_leads_there_by_the_law() {
    let (gravity, rate) = (9.81, 4.0);
    for step in [1e-3, 2e-3, 4e-3] {
        let cloth = Cloth::sheet(DVec3::ZERO, [0.5 * DVec3::X, 0.5 * DVec3::Y], [4; 2], 0.15).unwrap();
        let mut scene = Scene::new(cloth, step);
        scene.add(Gravity::default()).add(AirDrag { rate });
        elastic(&mut scene, 400.0, 1e-2);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let mut error = 0.0_f64;
        while simulation.time() < 3.0 {
            simulation.step().unwrap();
            let expected = gravity / rate * (1.0 - (-rate * simulation.time()).exp());
            let own = simulation.velocities().iter().map(|v| (-v.z - expected).abs());
            error = own.fold(error, f64::max) * rate / gravity;
        }
        println!("{step} s: {error} of the terminal speed");
        assert!(error < 0.6 * rate * step, "{step} s: {error}");
    }
}
