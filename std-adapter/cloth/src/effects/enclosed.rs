//! The volume of a closed cloth, and its gradient.
//!
//! The volume is V = ⅙Σ a·(b × c), relative to the first vertex, so that it does not depend on the cloth's position. Its gradient
//! at a vertex is a third of the area vectors around it. This is the force in N of a pressure of one pascal, whether the cloth is
//! closed or not.

use crate::model::membrane::triangles_around;
use crate::world::Cloth;
use crate::world::Incidence;
use selvedge::Topology;
use selvedge::parallel;
use selvedge_core::glam::DVec3;

/// The triangles of a cloth, as walls.
#[derive(Debug)]
pub(super) struct Walls {
    triangles: Vec<[u32; 3]>,
    incidence: Incidence<(u32, f64)>,
    /// A sixth of each triangle's cross product.
    normals: Vec<DVec3>,
}

impl Walls {
    pub(super) fn new(cloth: &Cloth) -> Self {
        Self {
            triangles: cloth.mesh.triangles.clone(),
            incidence: triangles_around(cloth),
            normals: Vec::new(),
        }
    }

    /// Returns the volume in m³ of a closed cloth. It is negative if the triangles face inwards.
    pub(super) fn volume(&self, positions: &[DVec3]) -> f64 {
        let origin = positions[0];
        let parts = self.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|v| positions[v as usize] - origin);
            a.dot(b.cross(c))
        });
        parts.sum::<f64>() / 6.0
    }

    /// Computes the triangles' normals, which the gradients need.
    pub(super) fn look(&mut self, positions: &[DVec3]) {
        parallel::fill(&mut self.normals, &self.triangles, |triangle| {
            let [a, b, c] = triangle.map(|v| positions[v as usize]);
            (b - a).cross(c - a) / 6.0
        });
    }

    /// Returns the gradient of the volume, in m².
    pub(super) fn gradient(&self, vertex: usize) -> DVec3 {
        let around = self.incidence.of(vertex).iter();
        around.map(|&(triangle, _)| self.normals[triangle as usize]).sum()
    }

    pub(super) fn len(&self) -> usize {
        self.incidence.len()
    }
}

/// Returns the number of open edges of a cloth; zero if it is closed.
pub(super) fn open_edges(topology: &Topology) -> usize {
    let statistics = topology.statistics();
    statistics.boundary_edges + statistics.non_manifold_edges
}
