//! A swept 18-DOP for every vertex, edge and face, refitted each step (Hutter, Fuhrmann 2007).

use super::pairs::MovingMesh;
use crate::parallel::fill;
use selvedge_core::Scalar;
use selvedge_core::boxes::Dop18;

/// Empty unless the method stores DOPs.
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
        fill(&mut self.vertices, mesh.motions, Dop18::swept);
        let vertices = &self.vertices;
        let vertex = |v: u32| &vertices[v as usize];
        fill(&mut self.edges, mesh.topology.edges(), |&[a, b]| {
            vertex(a).merged(vertex(b))
        });
        fill(&mut self.faces, mesh.topology.triangles(), |&[a, b, c]| {
            vertex(a).merged(vertex(b)).merged(vertex(c))
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
