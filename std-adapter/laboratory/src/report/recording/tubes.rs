//! Loose edges as thin tubes, so that whatever shows triangles shows ropes.

use selvedge_cloth::{Cloth, Scene};
use selvedge_core::glam::DVec3;
use std::f64::consts::TAU;

/// Of a ring of a tube.
const SIDES: u32 = 8;
/// Where no contact says how thick a rope is: its radius, in lengths of its edges.
const THIN: f64 = 0.15;

/// What is shown of a cloth: its vertices, if it has triangles, then the rings of its tubes, then the copies of vertices that tears have made.
#[derive(Clone, Debug)]
pub(super) struct Shown {
    /// As it was made.
    vertices: usize,
    has_triangles: bool,
    /// Vertices of the cloth, each joined with the next.
    rows: Vec<Vec<u32>>,
    /// In metres.
    radius: f64,
}

impl Shown {
    /// Of one of a scene's cloths.
    pub(super) fn new(scene: &Scene, index: usize) -> Self {
        let cloth = &scene.cloths[index];
        let edges = cloth.topology().loose_edges();
        let count = edges.len().max(1) as f64;
        let at = |vertex: u32| cloth.mesh().positions[vertex as usize];
        let mean = edges.map(|[a, b]| at(a).distance(at(b))).sum::<f64>() / count;
        Self {
            vertices: cloth.mesh().positions.len(),
            has_triangles: !cloth.mesh().triangles.is_empty(),
            rows: cloth.loose_rows(),
            radius: scene.thickness_of(index).map_or(THIN * mean, |thickness| 0.5 * thickness),
        }
    }

    fn own_vertices(&self) -> usize {
        if self.has_triangles { self.vertices } else { 0 }
    }

    fn tube_vertices(&self) -> usize {
        self.rows.iter().map(|row| row.len() * SIDES as usize).sum()
    }

    /// The place of one of the cloth's vertices, which has triangles.
    pub(super) fn place_of(&self, vertex: u32) -> u32 {
        let is_copy = vertex as usize >= self.vertices;
        if is_copy {
            vertex + self.tube_vertices() as u32
        } else {
            vertex
        }
    }

    /// How many vertices are shown, and the triangles on them, of the cloth as it was made.
    pub(super) fn mesh(&self, cloth: &Cloth) -> (usize, Vec<[u32; 3]>) {
        let mut triangles = cloth.mesh().triangles.clone();
        self.add_tubes(&mut triangles);
        (self.own_vertices() + self.tube_vertices(), triangles)
    }

    /// Adds the triangles of its tubes.
    pub(super) fn add_tubes(&self, triangles: &mut Vec<[u32; 3]>) {
        let mut next = self.own_vertices() as u32;
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
    }

    /// Adds where they are, when the cloth's vertices are at `own`.
    pub(super) fn place(&self, own: &[DVec3], shown: &mut Vec<DVec3>) {
        shown.extend_from_slice(&own[..self.own_vertices()]);
        for row in &self.rows {
            let points: Vec<DVec3> = row.iter().map(|&vertex| own[vertex as usize]).collect();
            // Carried from ring to ring, so that the tube is not twisted.
            let mut side = DVec3::ZERO;
            for (k, &point) in points.iter().enumerate() {
                let along = points[(k + 1).min(points.len() - 1)] - points[k.saturating_sub(1)];
                let along = along.try_normalize().unwrap_or(DVec3::Z);
                let carried = side.reject_from_normalized(along).try_normalize();
                side = carried.unwrap_or_else(|| along.any_orthonormal_vector());
                let other = along.cross(side);
                shown.extend((0..SIDES).map(|corner| {
                    let (sine, cosine) = (TAU * f64::from(corner) / f64::from(SIDES)).sin_cos();
                    point + (side * cosine + other * sine) * self.radius
                }));
            }
        }
        shown.extend_from_slice(&own[self.vertices..]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use selvedge::Mesh;
    use selvedge_cloth::effects::{SelfCollision, Thickness};

    #[test]
    fn a_rope_is_shown_as_a_closed_tube_as_thick_as_contact_keeps_it() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)];
        let mut scene = Scene::new(Cloth::rope(&points, 20, 0.1).unwrap(), 1e-3);
        scene.add(SelfCollision(Thickness::of(0.01)));
        let shown = Shown::new(&scene, 0);
        let (count, triangles) = shown.mesh(&scene.cloths[0]);
        let mut positions = Vec::new();
        shown.place(&scene.cloths[0].mesh().positions, &mut positions);
        assert_eq!((count, positions.len()), (21 * 8, 21 * 8));
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
        // Outwards: what it encloses is as much as a prism of eight sides does, but for its bend.
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

    #[test]
    fn a_fringe_is_shown_after_the_triangles_of_its_cloth() {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_X * 2.0];
        let mesh = Mesh {
            positions,
            triangles: vec![[0, 1, 2]],
        };
        let cloth = Cloth::of_mesh_with_loose_edges(mesh, &[[0, 3], [3, 4]], DVec3::X, [0.1, 0.1]).unwrap();
        let scene = Scene::new(cloth, 1e-3);
        let shown = Shown::new(&scene, 0);
        let (count, triangles) = shown.mesh(&scene.cloths[0]);
        assert_eq!((count, triangles[0]), (5 + 3 * 8, [0, 1, 2]));
        let mut placed = Vec::new();
        shown.place(&scene.cloths[0].mesh().positions, &mut placed);
        assert_eq!((placed.len(), &placed[..5]), (count, &scene.cloths[0].mesh().positions[..]));
    }
}
