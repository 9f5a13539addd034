//! Internal pressure: a closed cloth keeps a volume, as a constraint on all its vertices at once (Müller et al. 2007).
//!
//! C = V(x) − r·V₀ with the volume V = ⅙Σ a·(b × c) and the energy ½·K·C²/(r·V₀), K a bulk modulus: compliance r·V₀/K. The
//! volume is taken relative to the first vertex, so that it does not depend on where the cloth is.

use super::registration::{Effect, Registration};
use crate::input::{PRESSURE, RATIO};
use crate::membrane::Incidence;
use crate::plan::Plan;
use crate::step::{Constraint, TimeStep, Touches};
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["volume", "modulus"],
    needs: &[],
    read: |table, world| {
        let statistics = world.cloth.topology.statistics();
        if statistics.boundary_edges > 0 || statistics.non_manifold_edges > 0 {
            let message = format!(
                "internal pressure needs a closed cloth, but this one has {} open edges",
                statistics.boundary_edges + statistics.non_manifold_edges
            );
            return Err(table.error("volume", message));
        }
        Ok(Box::new(Pressure {
            ratio: table.required_number("volume", RATIO, 0.01..=10.0)?,
            modulus: table.number("modulus", PRESSURE, 1e-3..=1e9)?.unwrap_or(1e5),
        }))
    },
};

#[derive(Debug)]
struct Pressure {
    /// Of the volume aimed at to that at rest.
    ratio: f64,
    /// In Pa.
    modulus: f64,
}

impl Effect for Pressure {
    fn register(self: Box<Self>, plan: &mut Plan<'_>) {
        let cloth = plan.world.cloth;
        let triangles = cloth.mesh.triangles.clone();
        let rest = volume(&triangles, &cloth.mesh.positions);
        plan.add_constraint(Filling {
            goal: self.ratio * rest,
            compliance: self.ratio * rest.abs() / self.modulus,
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
}
