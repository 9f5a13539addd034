//! The loads of edges.
//!
//! Stretch pulls a triangle together along warp and weft with T_u = k_u·(|w_u| − 1)·w_u/|w_u|, and T_v likewise, in newtons per
//! metre of cloth at rest ([`stretch`](crate::effects::Stretch)). Compression does not pull. Across a line whose normal in the
//! cloth at rest is ν, the force per metre is T_u·ν_u + T_v·ν_v (the first Piola–Kirchhoff stress). The load of an edge is the
//! mean of this force in its two triangles. It leaves out shear and the forces of a strain limit.

use super::fans::Fabric;
use crate::model::membrane::{Flat, Membrane, image, triangles_around};
use crate::world::Cloth;
use selvedge::Topology;
use selvedge::parallel;
use selvedge_core::glam::{DVec2, DVec3};

/// The edges of a cloth that may tear, and their loads.
#[derive(Debug)]
pub(crate) struct Tearable {
    /// The effect's index in the scene.
    pub(crate) effect: usize,
    pub(crate) cloth: usize,
    /// The stiffnesses k_u and k_v along warp and weft, in N/m.
    stiffness: [f64; 2],
    pub(super) fabric: Fabric,
    /// The triangles of such edges, each with its corners.
    membranes: Vec<(Membrane, [u32; 3])>,
    pub(super) edges: Vec<Edge>,
    /// The tensions T_u and T_v of each of these triangles.
    tensions: Vec<[DVec3; 2]>,
}

/// An edge between two triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// The ends, as vertices of the cloth.
    pub(super) vertices: [u32; 2],
    /// The two triangles, as places in the list of triangles.
    triangles: [u32; 2],
    /// The normal ν of the edge in each triangle, along warp and weft.
    across: [DVec2; 2],
    /// The strength, in N/m.
    pub(super) strength: f64,
}

impl Tearable {
    /// Collects the edges of a cloth with this stiffness along warp and weft, in N/m. `strength` returns the strength of an edge
    /// between two vertices, in N/m, or `None` if it cannot tear.
    pub(crate) fn new(cloth: &Cloth, stiffness: [f64; 2], strength: impl Fn([u32; 2]) -> Option<f64>) -> Self {
        let flat = cloth.mesh.triangles.iter().map(|triangle| Flat::new(cloth, *triangle));
        let flat: Vec<Flat> = flat.collect();
        let topology = &cloth.topology;
        let mut triangles_of = vec![Vec::new(); topology.edges().len()];
        // Loose edges come after the triangles.
        let triangles = cloth.mesh.triangles.len() as u32;
        for (triangle, edges) in (0..triangles).zip(topology.triangle_edges()) {
            edges
                .iter()
                .filter(|&&edge| edge != Topology::NO_EDGE)
                .for_each(|&edge| triangles_of[edge as usize].push(triangle));
        }
        let edge = |(&vertices, triangles): (&[u32; 2], &Vec<u32>)| {
            let &[first, second] = triangles.as_slice() else { return None };
            let along = vertices.map(|vertex| cloth.mesh.positions[vertex as usize]);
            let across = [first, second].map(|triangle| flat[triangle as usize].across(along[1] - along[0]));
            Some(Edge {
                vertices,
                triangles: [first, second],
                across,
                strength: strength(vertices)?,
            })
        };
        let mut edges: Vec<Edge> = topology.edges().iter().zip(&triangles_of).filter_map(edge).collect();
        let mut looked_at: Vec<u32> = edges.iter().flat_map(|edge| edge.triangles).collect();
        looked_at.sort_unstable();
        looked_at.dedup();
        let place = |triangle: u32| looked_at.partition_point(|&other| other < triangle) as u32;
        edges.iter_mut().for_each(|edge| edge.triangles = edge.triangles.map(place));
        let membrane = |&triangle: &u32| (flat[triangle as usize].membrane, cloth.mesh.triangles[triangle as usize]);
        Self {
            effect: 0,
            cloth: 0,
            stiffness,
            membranes: looked_at.iter().map(membrane).collect(),
            edges,
            fabric: Fabric {
                around: triangles_around(cloth),
                triangles: cloth.mesh.triangles.clone(),
                rest: cloth.mesh.positions.clone(),
            },
            tensions: Vec::new(),
        }
    }

    pub(crate) fn placed(self, effect: usize, cloth: usize) -> Self {
        Self { effect, cloth, ..self }
    }

    /// Computes tensions at these positions, which [`load`](Self::load) needs.
    pub(super) fn look(&mut self, positions: &[DVec3]) {
        let Self {
            stiffness,
            membranes,
            tensions,
            ..
        } = self;
        let tension = |c: [f64; 2], stiffness: f64, x: [DVec3; 3]| {
            let pulled = image(c, x);
            let length = pulled.length();
            if length > 1.0 {
                pulled * (stiffness * (length - 1.0) / length)
            } else {
                DVec3::ZERO
            }
        };
        parallel::fill(tensions, membranes, |(membrane, triangle)| {
            let x = triangle.map(|vertex| positions[vertex as usize]);
            [tension(membrane.a, stiffness[0], x), tension(membrane.b, stiffness[1], x)]
        });
    }

    /// Returns the load of an edge, in N/m, at the positions of the last [`look`](Self::look).
    pub(super) fn load(&self, edge: &Edge) -> f64 {
        let pull = |(&triangle, across): (&u32, DVec2)| {
            let [warp, weft] = self.tensions[triangle as usize];
            (warp * across.x + weft * across.y).length()
        };
        let [first, second] = edge.triangles;
        0.5 * (pull((&first, edge.across[0])) + pull((&second, edge.across[1])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::sheet;

    /// Returns a sheet along x and y, stretched along its warp by a tenth and compressed along its weft.
    fn stretched() -> (Cloth, Vec<DVec3>) {
        let cloth = Cloth::of(sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [4, 4]));
        let positions = { cloth.mesh.positions.iter() }
            .map(|p| DVec3::new(1.1 * p.x, 0.9 * p.y, 0.0))
            .collect();
        (cloth, positions)
    }

    #[test]
    fn an_edge_across_the_pull_is_loaded_with_all_of_it_and_one_along_it_with_nothing() {
        let (cloth, positions) = stretched();
        let mut tearable = Tearable::new(&cloth, [500.0, 300.0], |_| Some(1.0));
        tearable.look(&positions);
        for edge in &tearable.edges {
            let [a, b] = edge.vertices.map(|v| cloth.mesh.positions[v as usize]);
            let along = (b - a).normalize();
            let expected = 500.0 * 0.1 * along.y.abs();
            assert!((tearable.load(edge) - expected).abs() < 1e-9, "{edge:?}");
        }
    }

    #[test]
    fn only_edges_between_two_triangles_may_tear_and_of_these_those_that_have_a_strength() {
        let (cloth, _) = stretched();
        let inner = cloth.topology.statistics().interior_edges;
        let edges = |strength: fn([u32; 2]) -> Option<f64>| Tearable::new(&cloth, [1.0; 2], strength).edges.len();
        assert_eq!(edges(|_| Some(1.0)), inner);
        assert_eq!(edges(|_| None), 0);
        assert_eq!(edges(|[a, b]| (a == 12 || b == 12).then_some(1.0)), 8);
    }
}
