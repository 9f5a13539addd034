//! Your own effect: a magnet that attracts the cloth's vertices for a second.
//!
//! ```text
//! cargo run --release -p selvedge-cloth --example own_effect
//! ```

use selvedge_cloth::effects::{
    Bend, Effect, Force, Gravity, PinGroup, Pins, Plan, SceneParts, SelfCollision, Stretch, Thickness, TimeStep,
};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Scene, Simulation, ValueError};
use std::error::Error;

#[derive(Clone, Copy, Debug)]
struct Magnet {
    /// The position, in metres.
    at: DVec3,
    /// The acceleration in m/s² at ten centimetres; it falls with the square of the distance.
    strength: f64,
    /// The time at which it is switched off, in seconds.
    until: f64,
}

impl Effect for Magnet {
    fn name(&self) -> &'static str {
        "magnet"
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        if self.at.is_finite() && self.strength.is_finite() {
            return Ok(());
        }
        Err(ValueError::new("magnet", "`at` and `strength` must be finite"))
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.add_force(*self);
    }
}

impl Force for Magnet {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        if step.time > self.until {
            return;
        }
        for (vertex, velocity) in velocities.iter_mut().enumerate() {
            if step.inverse_masses[vertex] > 0.0 {
                let way = self.at - step.start[vertex];
                // The pull does not grow within a centimetre.
                let squared = way.length_squared().max(1e-4);
                *velocity += way.normalize_or_zero() * (self.strength * 0.01 / squared * step.h);
            }
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let cloth = Cloth::sheet(DVec3::ZERO, [0.4 * DVec3::X, -0.4 * DVec3::Z], [20, 20], 0.15)?;
    let top = cloth.part("bottom").unwrap_or_default().to_vec();
    let mut scene = Scene::new(cloth, 2e-3);
    scene.add(Pins {
        groups: vec![PinGroup::resting(top)],
    });
    scene.add(Gravity::default()).add(Stretch::isotropic(500.0));
    scene.add(Bend::isotropic(1e-5));
    scene.add(SelfCollision(Thickness::new(3e-3)));
    scene.add(Magnet {
        at: DVec3::new(0.2, 0.1, -0.3),
        strength: 30.0,
        until: 1.0,
    });

    let mut simulation = Simulation::new(scene, 0)?;
    for step in 1..=1000 {
        simulation.step()?;
        if step % 100 == 0 {
            let foremost = simulation.positions().iter().map(|p| p.y).fold(f64::MIN, f64::max);
            println!("{:.1} s: the foremost vertex is at y = {:.3} m", simulation.time(), foremost);
        }
    }
    Ok(())
}
