//! Stores a bounding volume for every vertex, edge and face, refitted each step.

use super::pairs::MovingMesh;
use crate::baselines::nine_directions::Dop18;
use selvedge::parallel::fill;
use selvedge_core::boxes::Aabb;
use selvedge_core::{Motion, Scalar};

/// A volume that holds a feature throughout the step.
pub(super) trait BoundingVolume<S: Scalar>: Copy + Send + Sync {
    fn swept(motion: &Motion<S>) -> Self;
    fn merged(&self, other: &Self) -> Self;
    fn overlaps(&self, other: &Self) -> bool;
}

impl<S: Scalar> BoundingVolume<S> for Aabb<S> {
    #[inline(always)]
    fn swept(motion: &Motion<S>) -> Self {
        Self::swept(&[*motion])
    }

    #[inline(always)]
    fn merged(&self, other: &Self) -> Self {
        self.merged(other)
    }

    #[inline(always)]
    fn overlaps(&self, other: &Self) -> bool {
        self.overlaps(other)
    }
}

impl<S: Scalar> BoundingVolume<S> for Dop18<S> {
    #[inline(always)]
    fn swept(motion: &Motion<S>) -> Self {
        Self::swept(motion)
    }

    #[inline(always)]
    fn merged(&self, other: &Self) -> Self {
        self.merged(other)
    }

    #[inline(always)]
    fn overlaps(&self, other: &Self) -> bool {
        self.overlaps(other)
    }
}

/// The volumes, which are empty until they are refitted.
#[derive(Clone, Debug)]
pub(super) struct Stored<V> {
    vertices: Vec<V>,
    edges: Vec<V>,
    faces: Vec<V>,
}

impl<V> Stored<V> {
    pub(super) const fn new() -> Self {
        Self {
            vertices: Vec::new(),
            edges: Vec::new(),
            faces: Vec::new(),
        }
    }

    pub(super) fn faces(&self) -> &[V] {
        &self.faces
    }

    pub(super) fn refit_vertices_and_faces<S: Scalar>(&mut self, mesh: MovingMesh<'_, S>)
    where
        V: BoundingVolume<S>,
    {
        fill(&mut self.vertices, mesh.rows, |row| V::swept(&row.motion()));
        let vertices = &self.vertices;
        fill(&mut self.faces, mesh.topology.triangles(), |triangle| {
            let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
            a.merged(&b).merged(&c)
        });
    }

    /// Refits edges, after [`refit_vertices_and_faces`](Self::refit_vertices_and_faces).
    pub(super) fn refit_edges<S: Scalar>(&mut self, mesh: MovingMesh<'_, S>)
    where
        V: BoundingVolume<S>,
    {
        let vertices = &self.vertices;
        fill(&mut self.edges, mesh.topology.edges(), |edge| {
            let [a, b] = edge.map(|vertex| vertices[vertex as usize]);
            a.merged(&b)
        });
    }

    #[inline(always)]
    pub(super) fn vertex_face_overlap<S: Scalar>(&self, [vertex, face]: [u32; 2]) -> bool
    where
        V: BoundingVolume<S>,
    {
        self.vertices[vertex as usize].overlaps(&self.faces[face as usize])
    }

    #[inline(always)]
    pub(super) fn edge_edge_overlap<S: Scalar>(&self, [first, second]: [u32; 2]) -> bool
    where
        V: BoundingVolume<S>,
    {
        self.edges[first as usize].overlaps(&self.edges[second as usize])
    }
}
