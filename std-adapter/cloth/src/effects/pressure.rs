//! Internal pressure: a closed cloth keeps a volume, as a constraint on all its vertices at once (Müller et al. 2007).
//!
//! C = V(x) − r·V₀ with the volume V = ⅙Σ a·(b × c) and the energy ½·K·C²/(r·V₀), K a bulk modulus: compliance r·V₀/K. The
//! volume is taken relative to the first vertex, so that it does not depend on where the cloth is.

use super::registration::{Effect, Registration};
use crate::energy::{Configuration, StoredEnergy};
use crate::input::{Field, PRESSURE, RATIO, ValueError};
use crate::membrane::Incidence;
use crate::plan::Plan;
use crate::step::{Constraint, TimeStep, Touches};
use crate::world::SceneParts;
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;

const VOLUME: Field = Field::new("volume", RATIO, 0.01, 10.0);
const MODULUS: Field = Field::new("modulus", PRESSURE, 1e-3, 1e9);

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["volume", "modulus"],
    needs: &[],
    read: |table, _| {
        let mut pressure = InternalPressure::of_volume(table.required_number(&VOLUME)?);
        if let Some(modulus) = table.number(&MODULUS)? {
            pressure.modulus = modulus;
        }
        Ok(Box::new(pressure))
    },
};

/// A closed cloth keeps a volume, as if it were full of a gas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InternalPressure {
    /// The volume aimed at over that at rest.
    pub volume: f64,
    /// How hard the gas is to compress, in Pa.
    pub modulus: f64,
}

impl InternalPressure {
    /// With air's modulus.
    #[must_use]
    pub const fn of_volume(volume: f64) -> Self {
        Self { volume, modulus: 1e5 }
    }
}

impl Effect for InternalPressure {
    fn name(&self) -> &'static str {
        "internal_pressure"
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        VOLUME.check(self.volume)?;
        MODULUS.check(self.modulus)?;
        let statistics = world.cloth.topology.statistics();
        match statistics.boundary_edges + statistics.non_manifold_edges {
            0 => Ok(()),
            open => {
                let message = format!("internal pressure needs a closed cloth, but this one has {open} open edges");
                Err(ValueError::new(VOLUME.name, message))
            }
        }
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let cloth = plan.scene.cloth;
        let triangles = cloth.mesh.triangles.clone();
        let rest = volume(&triangles, &cloth.mesh.positions);
        plan.add_constraint(Filling {
            goal: self.volume * rest,
            compliance: self.volume * rest.abs() / self.modulus,
            triangles,
            incidence: Incidence::new(cloth),
            normals: Vec::new(),
        });
    }
}

#[derive(Debug)]
struct Filling {
    goal: f64,
    compliance: f64,
    triangles: Vec<[u32; 3]>,
    incidence: Incidence,
    /// A sixth of each triangle's cross product.
    normals: Vec<DVec3>,
}

fn volume(triangles: &[[u32; 3]], positions: &[DVec3]) -> f64 {
    let origin = positions[0];
    let parts = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|v| positions[v as usize] - origin);
        a.dot(b.cross(c))
    });
    parts.sum::<f64>() / 6.0
}

impl Constraint for Filling {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], _: &mut Touches) {
        let read: &[DVec3] = positions;
        parallel::fill(&mut self.normals, &self.triangles, |triangle| {
            let [a, b, c] = triangle.map(|v| read[v as usize]);
            (b - a).cross(c - a) / 6.0
        });
        let gradient = |vertex: usize| -> DVec3 {
            let around = self.incidence.of(vertex).iter();
            around.map(|&(triangle, _)| self.normals[triangle as usize]).sum()
        };
        let mut weight = self.compliance / (step.h * step.h);
        for vertex in 0..self.incidence.len() {
            weight += step.inverse_masses[vertex] * gradient(vertex).length_squared();
        }
        let multiplier = (self.goal - volume(&self.triangles, positions)) / weight;
        for vertex in 0..self.incidence.len() {
            positions[vertex] += gradient(vertex) * (multiplier * step.inverse_masses[vertex]);
        }
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        let excess = volume(&self.triangles, now.positions) - self.goal;
        Some(StoredEnergy::Elastic(0.5 * excess * excess / self.compliance))
    }
}
