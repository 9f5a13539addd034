//! Free fall: s = ½·g·t².
//!
//! Semi-implicit steps of h give ½·g·t·(t + h), on any mesh, since no inner force acts. So the error is ½·g·t·h.

use crate::elastic;
use selvedge_cloth::effects::Gravity;
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
