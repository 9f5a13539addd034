//! A hinge: an edge between two triangles with its bending resistance.

use crate::model::membrane::warp_and_weft;
use crate::world::Cloth;
use selvedge::Topology;
use selvedge_core::glam::DVec3;

/// A hinge on four vertices, those of the edge first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hinge {
    /// The weights K of the four vertices.
    pub(crate) weights: [f64; 4],
    /// The factor of |C|² in twice the energy, in N/m.
    pub(crate) coefficient: f64,
    /// The area A of both triangles, in m².
    pub(super) area: f64,
}

/// The vertices of a hinge, and the hinge.
pub(crate) type PlacedHinge = ([u32; 4], Hinge);

impl Hinge {
    /// Returns the bend C = ΣKᵢxᵢ, in m.
    #[inline(always)]
    pub(crate) fn bent(&self, x: [DVec3; 4]) -> DVec3 {
        let k = self.weights;
        x[0] * k[0] + x[1] * k[1] + x[2] * k[2] + x[3] * k[3]
    }
}

/// The least α. It gives every hinge some stiffness, however blunt the angles opposite its edge.
const LEAST_SHARE: f64 = 1.0 / 3.0;

/// Returns a hinge for each edge between two triangles. `rigidity` maps the square of the cosine between the warp and the
/// direction of bending, across the edge, to a flexural rigidity.
pub(crate) fn hinges(cloth: &Cloth, rigidity: impl Fn(f64) -> f64) -> Vec<PlacedHinge> {
    let topology = &cloth.topology;
    let mut opposite = vec![[u32::MAX; 2]; topology.edges().len()];
    for (triangle, edges) in topology.proper_triangles().iter().zip(topology.triangle_edges()) {
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
        let [_, weft] = warp_and_weft(b - a, c - a, cloth.warp);
        let area = 0.5 * ((b - a).cross(c - a).length() + (b - a).cross(d - a).length());
        let opposite = cotangent(a - c, b - c) + cotangent(a - d, b - d);
        // The angle between the warp and the direction across the edge equals that between the weft and the edge.
        let of_warp = weft.dot((b - a).normalize()).powi(2).min(1.0);
        let hinge = Hinge {
            weights: [at_b[0] + at_b[1], at_a[0] + at_a[1], -at_a[0] - at_b[0], -at_a[1] - at_b[1]],
            coefficient: rigidity(of_warp) * share(opposite) / area,
            area,
        };
        (vertices, hinge)
    };
    inner.map(make).collect()
}

/// Returns the factor α of the energy, given the sum of the cotangents of the angles opposite the edge.
fn share(opposite: f64) -> f64 {
    ((2.0 + opposite) / 3.0).max(LEAST_SHARE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::sheet;

    /// A flat sheet has no bending force after any rigid motion; a folded one has.
    #[test]
    fn flat_cloth_is_at_rest_and_folded_cloth_is_not() {
        let cloth = Cloth::of(sheet(DVec3::ZERO, [DVec3::X, DVec3::new(0.3, 1.0, 0.0)], [3, 3]));
        let hinges = hinges(&cloth, |_| 1.0);
        assert_eq!(hinges.len(), 3 * 3 + 2 * 3 * 2);
        for (vertices, hinge) in hinges {
            let rest = vertices.map(|v| cloth.mesh.positions[v as usize]);
            assert!(hinge.bent(rest).length() < 1e-14);
            let mut folded = rest;
            folded[3] += DVec3::Z * 0.1;
            let forces = hinge.weights.map(|weight| hinge.bent(folded) * -weight);
            assert!(forces[3].z < 0.0 && forces.iter().sum::<DVec3>().length() < 1e-14);
        }
    }

    #[test]
    fn an_edge_along_the_warp_bends_the_weft() {
        let cloth = Cloth::of(sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [2, 2]));
        let all = hinges(&cloth, |_| 1.0);
        for ((vertices, hinge), (_, whole)) in hinges(&cloth, |of_warp| of_warp).into_iter().zip(all) {
            let [a, b] = [vertices[0], vertices[1]].map(|v| cloth.mesh.positions[v as usize]);
            let edge = (b - a).normalize();
            assert!((hinge.coefficient / whole.coefficient - edge.y * edge.y).abs() < 1e-15);
        }
    }
}
