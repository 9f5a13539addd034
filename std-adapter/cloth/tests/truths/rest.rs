//! Cloth that lies on a body or is too near to it comes to rest at its thickness. Recovery gives it no speed.

use crate::{contact, elastic, table};
use selvedge_cloth::effects::Gravity;
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Scene, Simulation};

/// Makes a sheet of 0.3 m in so many cells, in the plane at this height.
fn sheet(height: f64, cells: u32) -> Cloth {
    let corner = DVec3::new(-0.15, -0.15, height);
    Cloth::sheet(corner, [0.3 * DVec3::X, 0.3 * DVec3::Y], [cells; 2], 0.15).unwrap()
}

/// Returns the root mean square of the speeds of all cloth.
fn speed(simulation: &Simulation) -> f64 {
    let cloth = &simulation.velocities()[..simulation.cloth_vertices()];
    (cloth.iter().map(|v| v.length_squared()).sum::<f64>() / cloth.len() as f64).sqrt()
}

#[test]
fn cloth_that_starts_too_near_rises_to_its_thickness_and_no_higher_with_gravity_and_without() {
    let thickness = 5e-3;
    for has_gravity in [true, false] {
        let mut scene = Scene::new(sheet(1e-3, 6), 1e-3);
        scene.bodies.push(table(20, 0.0));
        elastic(&mut scene, 400.0, 15e-6);
        contact(&mut scene, thickness, 0.3);
        if has_gravity {
            scene.add(Gravity::default());
        }
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let mut highest = 0.0_f64;
        for _ in 0..1000 {
            simulation.step().unwrap();
            let cloth = &simulation.positions()[..simulation.cloth_vertices()];
            highest = cloth.iter().map(|p| p.z).fold(highest, f64::max);
        }
        let cloth = &simulation.positions()[..simulation.cloth_vertices()];
        let lowest = cloth.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        println!("gravity {has_gravity}: {lowest} to {highest} m, {} m/s", speed(&simulation));
        assert!(
            lowest > 0.99 * thickness && highest < 1.05 * thickness,
            "{lowest} to {highest}"
        );
        assert!(speed(&simulation) < 1e-4, "{}", speed(&simulation));
    }
}
