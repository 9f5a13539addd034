//! Loose edges as thin tubes, so that programs that draw triangles can draw ropes.

use crate::scene::Scene;
use libm::{cos, sin};
use selvedge_core::glam::DVec3;
use std::array;
use std::f64::consts::TAU;

const SIDES: u32 = 8;
/// The radius in edge lengths, for ropes without contact.
const THIN: f64 = 0.15;

/// Draws the ropes, laces and fringes of a cloth as closed tubes of eight sides. They are as thick as the distance that
/// `self_collision` keeps, or thin without it.
///
/// ```
/// use selvedge_cloth::{Cloth, Scene, Tubes, glam::DVec3};
///
/// let scene = Scene::new(Cloth::rope(&[DVec3::ZERO, DVec3::X], 10, 0.05)?, 1e-3);
/// let tubes = Tubes::from_scene(&scene, 0).expect("a rope has loose edges");
/// let mut positions = Vec::new();
/// tubes.place(&scene.cloths[0].mesh().positions, &mut positions);
/// assert_eq!(positions.len(), tubes.vertex_count());
/// assert!(tubes.triangles(0).as_flattened().iter().all(|&vertex| (vertex as usize) < positions.len()));
/// # Ok::<(), selvedge_cloth::ValueError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Tubes {
    /// Vertices of the cloth, each joined with the next.
    rows: Vec<Vec<u32>>,
    /// The radius, in metres.
    radius: f64,
}

impl Tubes {
    /// Makes the tubes of one of the scene's cloths, by its index. Returns `None` if the cloth has no loose edges or does not
    /// exist.
    #[must_use]
    pub fn from_scene(scene: &Scene, cloth: usize) -> Option<Self> {
        let own = scene.cloths.get(cloth).filter(|own| own.has_loose_edges())?;
        let edges = own.topology().loose_edges();
        let count = edges.len() as f64;
        let at = |vertex: u32| own.mesh().positions[vertex as usize];
        let mean = edges.map(|[a, b]| at(a).distance(at(b))).sum::<f64>() / count;
        Some(Self {
            rows: own.loose_rows(),
            radius: scene.thickness_of(cloth).map_or(THIN * mean, |thickness| 0.5 * thickness),
        })
    }

    /// Returns the number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.rows.iter().map(|row| row.len() * SIDES as usize).sum()
    }

    /// Returns the triangles, facing outwards. Vertices are numbered from `first`.
    #[must_use]
    pub fn triangles(&self, first: u32) -> Vec<[u32; 3]> {
        let mut triangles = Vec::new();
        let mut next = first;
        for row in &self.rows {
            let rings = row.len() as u32;
            let at = |ring: u32, side: u32| next + ring * SIDES + side % SIDES;
            for ring in 0..rings - 1 {
                for side in 0..SIDES {
                    let [a, b] = [at(ring, side), at(ring, side + 1)];
                    let [c, d] = [at(ring + 1, side), at(ring + 1, side + 1)];
                    triangles.extend([[a, b, d], [a, d, c]]);
                }
            }
            for side in 1..SIDES - 1 {
                triangles.push([at(0, 0), at(0, side + 1), at(0, side)]);
                triangles.push([at(rings - 1, 0), at(rings - 1, side), at(rings - 1, side + 1)]);
            }
            next += rings * SIDES;
        }
        triangles
    }

    /// Appends the positions of the tubes' vertices to `shown`, when the cloth's vertices are at `own`.
    ///
    /// # Panics
    /// Panics if `own` has fewer vertices than the cloth.
    pub fn place(&self, own: &[DVec3], shown: &mut Vec<DVec3>) {
        let corners: [[f64; 2]; SIDES as usize] = array::from_fn(|corner| {
            let angle = TAU * corner as f64 / f64::from(SIDES);
            [cos(angle), sin(angle)]
        });
        for row in &self.rows {
            let points: Vec<DVec3> = row.iter().map(|&vertex| own[vertex as usize]).collect();
            // The side is carried from ring to ring, so that the tube is not twisted.
            let mut side = DVec3::ZERO;
            for (k, &point) in points.iter().enumerate() {
                let along = points[(k + 1).min(points.len() - 1)] - points[k.saturating_sub(1)];
                let along = along.try_normalize().unwrap_or(DVec3::Z);
                let carried = side.reject_from_normalized(along).try_normalize();
                side = carried.unwrap_or_else(|| along.any_orthonormal_vector());
                let other = along.cross(side);
                shown.extend(corners.map(|[cosine, sine]| point + (side * cosine + other * sine) * self.radius));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{SelfCollision, Thickness};
    use crate::world::Cloth;
    use selvedge::Mesh;

    #[test]
    fn a_rope_is_shown_as_a_closed_tube_as_thick_as_contact_keeps_it() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)];
        let mut scene = Scene::new(Cloth::rope(&points, 20, 0.1).unwrap(), 1e-3);
        scene.add(SelfCollision(Thickness::new(0.01)));
        let tubes = Tubes::from_scene(&scene, 0).unwrap();
        let triangles = tubes.triangles(0);
        let mut positions = Vec::new();
        tubes.place(&scene.cloths[0].mesh().positions, &mut positions);
        assert_eq!((tubes.vertex_count(), positions.len()), (21 * 8, 21 * 8));
        let mesh = Mesh { positions, triangles };
        let statistics = mesh.topology().unwrap().statistics();
        assert_eq!(
            (
                statistics.boundary_edges,
                statistics.non_manifold_edges,
                statistics.isolated_vertices
            ),
            (0, 0, 0)
        );
        // The triangles face outwards: they enclose as much as a prism of eight sides, apart from its bend.
        let corners = |t: &[u32; 3]| t.map(|v| mesh.positions[v as usize]);
        let volume: f64 = mesh
            .triangles
            .iter()
            .map(corners)
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum();
        let prism = 0.5 * 8.0 * 0.005_f64.powi(2) * (TAU / 8.0).sin() * 2.0;
        assert!((volume / prism - 1.0).abs() < 0.05, "{volume} for {prism}");
    }
}
