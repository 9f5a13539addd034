//! A flag in a wind that the caller turns, and in a field of wind.
//!
//! ```text
//! cargo run --release -p selvedge-cloth --example wind
//! ```

use selvedge_cloth::effects::{Air, Bend, Gravity, PinGroup, Pins, Stretch, Wind, WindField};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Scene, Simulation};
use std::error::Error;

/// Wind that grows with height.
#[derive(Debug)]
struct NearGround;

selvedge_cloth::identify!(NearGround {});

impl Air for NearGround {
    fn velocity(&self, at: DVec3, _time: f64) -> DVec3 {
        DVec3::X * (3.0 * (1.0 + at.z).max(0.0))
    }
}

fn flag() -> Result<Scene, Box<dyn Error>> {
    let cloth = Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.6, DVec3::Z * 0.4], [24, 16], 0.1)?;
    let mut scene = Scene::new(cloth.named("flag"), 2e-3);
    let pole = scene.part("flag", "left").ok_or("a sheet has a left side")?;
    scene.add(Pins {
        groups: vec![PinGroup::resting(pole)],
    });
    scene.add(Gravity::default()).add(Stretch::isotropic(500.0));
    scene.add(Bend::isotropic(1e-5));
    Ok(scene)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut scene = flag()?;
    scene.add(Wind::default()); // still at first
    let mut simulation = Simulation::new(scene, 0)?;
    for step in 0..500 {
        let angle = 2e-3 * f64::from(step);
        simulation.set_wind(DVec3::new(5.0 * angle.cos(), 5.0 * angle.sin(), 0.0))?;
        simulation.step()?;
    }
    println!("in a turning wind: {:.3} J of motion", simulation.energy().kinetic);

    let mut scene = flag()?;
    scene.add(WindField::new(NearGround));
    let mut simulation = Simulation::new(scene, 0)?;
    (0..500).try_for_each(|_| simulation.step())?;
    println!("in wind near the ground: {:.3} J of motion", simulation.energy().kinetic);
    Ok(())
}
