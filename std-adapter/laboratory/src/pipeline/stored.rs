//! Stores the swept 18-DOP of every vertex, edge and face, refitted each step.

use super::pairs::MovingMesh;
use crate::baselines::nine_directions::Dop18;
use selvedge::parallel::fill;
use selvedge_core::Scalar;

/// The volumes, which are empty until they are refitted.
#[derive(Clone, Debug)]
pub(super) struct StoredDops<S> {
    vertices: Vec<Dop18<S>>,
    edges: Vec<Dop18<S>>,
    faces: Vec<Dop18<S>>,
}

impl<S: Scalar> StoredDops<S> {
    pub(super) const fn new() -> Self {
        Self {
            vertices: Vec::new(),
            edges: Vec::new(),
            faces: Vec::new(),
        }
    }

    pub(super) fn refit(&mut self, mesh: MovingMesh<'_, S>) {
        fill(&mut self.vertices, mesh.rows, |row| Dop18::swept(&row.motion()));
        let vertices = &self.vertices;
        fill(&mut self.faces, mesh.topology.triangles(), |triangle| {
            let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
            a.merged(&b).merged(&c)
        });
        fill(&mut self.edges, mesh.topology.edges(), |edge| {
            let [a, b] = edge.map(|vertex| vertices[vertex as usize]);
            a.merged(&b)
        });
    }

    #[inline(always)]
    pub(super) fn vertex_face_overlap(&self, [vertex, face]: [u32; 2]) -> bool {
        self.vertices[vertex as usize].overlaps(&self.faces[face as usize])
    }

    #[inline(always)]
    pub(super) fn edge_edge_overlap(&self, [first, second]: [u32; 2]) -> bool {
        self.edges[first as usize].overlaps(&self.edges[second as usize])
    }
}
