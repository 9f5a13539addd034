//! Bending: the quadratic isometric hinge (Bergou et al. 2006), C = ΣKᵢxᵢ of the four vertices around an inner edge, K made of
//! the cotangents of its angles at rest. The energy is (3k/2A)·|C|², A the area of both triangles: gradients are
//! constant, there is no trigonometry and no singular fold. Rest is flat.

use super::registration::{Effect, Registration};
use crate::input::{BENDING_STIFFNESS, Field, ValueError};
use crate::plan::Plan;
use crate::schedule::{Local, On, Schedule};
use crate::world::{Cloth, SceneParts};
use selvedge::Topology;
use selvedge_core::glam::DVec3;

const STIFFNESS: Field = Field::new("stiffness", BENDING_STIFFNESS, 1e-12, 10.0);

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["stiffness"],
    needs: &[],
    read: |table, _| {
        let stiffness = table.required_number(&STIFFNESS)?;
        Ok(Box::new(Bend { stiffness }))
    },
};

/// Resistance to bending; flat at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// In N·m.
    pub stiffness: f64,
}

impl Effect for Bend {
    fn name(&self) -> &'static str {
        "bend"
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        STIFFNESS.check(self.stiffness)
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        vec![("bending stiffness", BENDING_STIFFNESS.written_short(self.stiffness))]
    }

    fn register(self: Box<Self>, plan: &mut Plan<'_>) {
        let cloth = plan.scene.cloth;
        let hinges = hinges(cloth, self.stiffness);
        plan.add_constraint(Schedule::once(hinges, cloth.mesh.positions.len()));
    }
}

#[derive(Debug)]
struct Hinge {
    weights: [f64; 4],
    compliance: f64,
}

/// One for each edge between two triangles.
fn hinges(cloth: &Cloth, stiffness: f64) -> Vec<On<Hinge, 4>> {
    let topology = &cloth.topology;
    let mut opposite = vec![[u32::MAX; 2]; topology.edges().len()];
    for (triangle, edges) in topology.triangles().iter().zip(topology.triangle_edges()) {
        for (k, &edge) in edges.iter().enumerate() {
            if edge != Topology::NO_EDGE {
                let [first, second] = &mut opposite[edge as usize];
                let free = if *first == u32::MAX { first } else { second };
                *free = triangle[(k + 2) % 3];
            }
        }
    }
    let inner = topology.edges().iter().zip(opposite);
    let inner = inner.filter(|(_, [_, second])| *second != u32::MAX);
    let make = |(&[a, b], [c, d]): (&[u32; 2], [u32; 2])| {
        let vertices = [a, b, c, d];
        let [a, b, c, d] = vertices.map(|v| cloth.mesh.positions[v as usize]);
        let cotangent = |u: DVec3, v: DVec3| u.dot(v) / u.cross(v).length();
        let (at_a, at_b) = (
            [cotangent(b - a, c - a), cotangent(b - a, d - a)],
            [cotangent(a - b, c - b), cotangent(a - b, d - b)],
        );
        let area = 0.5 * ((b - a).cross(c - a).length() + (b - a).cross(d - a).length());
        let hinge = Hinge {
            weights: [at_b[0] + at_b[1], at_a[0] + at_a[1], -at_a[0] - at_b[0], -at_a[1] - at_b[1]],
            compliance: area / (3.0 * stiffness),
        };
        (vertices, hinge)
    };
    inner.map(make).collect()
}

impl Local<4> for Hinge {
    #[inline(always)]
    fn corrections(&self, x: [DVec3; 4], w: [f64; 4], stiffening: f64) -> [DVec3; 4] {
        let k = self.weights;
        let bent = x[0] * k[0] + x[1] * k[1] + x[2] * k[2] + x[3] * k[3];
        let mut weight = self.compliance * stiffening;
        for i in 0..4 {
            weight += w[i] * k[i] * k[i];
        }
        let multiplier = bent * (-1.0 / weight);
        // Written out: `map` would not be inlined here.
        let by = |i: usize| multiplier * (w[i] * k[i]);
        [by(0), by(1), by(2), by(3)]
    }

    /// ½|C|² over the compliance.
    fn energy(&self, x: [DVec3; 4]) -> Option<f64> {
        let bent: DVec3 = x.iter().zip(self.weights).map(|(&x, k)| x * k).sum();
        Some(0.5 * bent.length_squared() / self.compliance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use std::path::Path;

    /// A flat sheet has no bending force however it is moved rigidly; a folded one has.
    #[test]
    fn flat_cloth_is_at_rest_and_folded_cloth_is_not() {
        let text = r#"
            time_step = 0.001
            duration = 1
            [cloth]
            shape = "sheet"
            sides = { first = [1, 0, 0], second = [0.3, 1, 0] }
            cells = [3, 3]
            density = 1
        "#;
        let scene = Scene::parse(text, Path::new("sheet.toml")).unwrap();
        let hinges = hinges(&scene.cloth, 1.0);
        assert_eq!(hinges.len(), 3 * 3 + 2 * 3 * 2);
        for (vertices, hinge) in hinges {
            let rest = vertices.map(|v| scene.cloth.mesh.positions[v as usize]);
            let moves = hinge.corrections(rest, [1.0; 4], 1.0);
            assert!(moves.iter().all(|m| m.length() < 1e-14));
            let mut folded = rest;
            folded[3] += DVec3::Z * 0.1;
            let moves = hinge.corrections(folded, [1.0; 4], 1.0);
            assert!(moves[3].z < 0.0 && moves.iter().sum::<DVec3>().length() < 1e-14);
        }
    }
}
