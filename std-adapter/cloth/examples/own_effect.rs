//! Your own effects: a magnet that attracts the cloth's vertices for a second, as a force, and a soft ceiling above them, as an
//! energy.
//!
//! ```text
//! cargo run --release -p selvedge-cloth --example own_effect
//! ```

use selvedge_cloth::effects::{
    Bend, Configuration, Effect, Force, Gravity, Matrix, PinGroup, Pins, Plan, SceneParts, SelfCollision, StoredEnergy, Stretch,
    Term, Thickness, TimeStep,
};
use selvedge_cloth::glam::{DMat3, DVec3};
use selvedge_cloth::{Cloth, Scene, Simulation, ValueError};
use std::error::Error;
use std::ops::Range;

/// A magnet.
#[derive(Clone, Copy, Debug)]
struct Magnet {
    /// The position, in metres.
    at: DVec3,
    /// The acceleration in m/s² at ten centimetres; it falls with the square of the distance.
    strength: f64,
    /// The time at which it is switched off, in seconds.
    until: f64,
}

selvedge_cloth::identify!(Magnet { at, strength, until });

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

/// A force changes velocities before the step is solved. Use one for what depends little on where the step ends.
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

/// A soft ceiling.
#[derive(Clone, Copy, Debug)]
struct Ceiling {
    /// The height, in metres.
    height: f64,
    /// The force on a vertex for each metre that it is above the ceiling, in N/m.
    stiffness: f64,
}

selvedge_cloth::identify!(Ceiling { height, stiffness });

impl Effect for Ceiling {
    fn name(&self) -> &'static str {
        "ceiling"
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        if self.height.is_finite() && self.stiffness.is_finite() && self.stiffness >= 0.0 {
            return Ok(());
        }
        Err(ValueError::new(
            "ceiling",
            "`height` and `stiffness` must be finite, and the stiffness not negative",
        ))
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.add_term(CeilingEnergy {
            ceiling: *self,
            vertices: plan.vertices(),
        });
    }
}

/// The energy ½·k·(z − height)² of each vertex above the ceiling.
#[derive(Debug)]
struct CeilingEnergy {
    ceiling: Ceiling,
    /// The vertices of the cloth, as the scene numbers them.
    vertices: Range<usize>,
}

impl CeilingEnergy {
    fn depth(&self, position: DVec3) -> f64 {
        (position.z - self.ceiling.height).max(0.0)
    }
}

/// A term is a part of the energy that each step minimises. So it acts where the step ends, and however stiff it is, the step is
/// stable.
impl Term for CeilingEnergy {
    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for vertex in self.vertices.clone() {
            let depth = self.depth(x[vertex]);
            gradient[vertex].z += self.ceiling.stiffness * depth;
            energy += 0.5 * self.ceiling.stiffness * depth * depth;
        }
        energy
    }

    fn curvature(&mut self, x: &[DVec3], matrix: &mut Matrix) {
        let along_z = DMat3::from_diagonal(DVec3::Z * self.ceiling.stiffness);
        for vertex in self.vertices.clone().filter(|&vertex| self.depth(x[vertex]) > 0.0) {
            matrix.add(&[vertex as u32], &[1.0], along_z);
        }
    }

    fn energy(&self, now: &Configuration<'_>, own: usize) -> Vec<(usize, StoredEnergy)> {
        let depths = now.positions[self.vertices.clone()]
            .iter()
            .map(|position| self.depth(*position));
        let energies = depths.map(|depth| 0.5 * self.ceiling.stiffness * depth * depth);
        vec![(own, StoredEnergy::Elastic(energies.sum()))]
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
    scene.add(Ceiling {
        height: 0.01,
        stiffness: 50.0,
    });

    let mut simulation = Simulation::new(scene, 0)?;
    for step in 1..=1000 {
        simulation.step()?;
        if step % 100 == 0 {
            let positions = || simulation.positions().iter();
            let foremost = positions().map(|p| p.y).fold(f64::MIN, f64::max);
            let highest = positions().map(|p| p.z).fold(f64::MIN, f64::max);
            println!(
                "{:.1} s: the foremost vertex is at y = {foremost:.3} m, the highest at z = {highest:.3} m",
                simulation.time()
            );
        }
    }
    Ok(())
}
