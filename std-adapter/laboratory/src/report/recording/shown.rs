//! The visible geometry of a cloth: its triangles, and its loose edges as [tubes](Tubes).

use selvedge_cloth::{Cloth, Scene, Tubes};
use selvedge_core::glam::DVec3;

/// The visible geometry of a cloth. Its vertices are the cloth's own, if it has triangles, then the rings of its tubes, then the
/// copies that tears have made.
#[derive(Clone, Debug)]
pub(super) struct ShownGeometry {
    vertices: usize,
    has_triangles: bool,
    tubes: Option<Tubes>,
}

impl ShownGeometry {
    /// Makes the geometry of one of a scene's cloths.
    pub(super) fn new(scene: &Scene, index: usize) -> Self {
        let mesh = scene.cloths[index].mesh();
        Self {
            vertices: mesh.positions.len(),
            has_triangles: !mesh.triangles.is_empty(),
            tubes: Tubes::from_scene(scene, index),
        }
    }

    fn own_vertices(&self) -> usize {
        if self.has_triangles { self.vertices } else { 0 }
    }

    fn tube_vertices(&self) -> usize {
        self.tubes.as_ref().map_or(0, Tubes::vertex_count)
    }

    /// Returns the place of a cloth's vertex; the cloth has triangles.
    pub(super) fn place_of(&self, vertex: u32) -> u32 {
        let is_copy = vertex as usize >= self.vertices;
        if is_copy {
            vertex + self.tube_vertices() as u32
        } else {
            vertex
        }
    }

    /// Returns the number of vertices and the triangles of the cloth at the start.
    pub(super) fn mesh(&self, cloth: &Cloth) -> (usize, Vec<[u32; 3]>) {
        let mut triangles = cloth.mesh().triangles.clone();
        self.add_tubes(&mut triangles);
        (self.own_vertices() + self.tube_vertices(), triangles)
    }

    pub(super) fn add_tubes(&self, triangles: &mut Vec<[u32; 3]>) {
        let first = self.own_vertices() as u32;
        triangles.extend(self.tubes.iter().flat_map(|tubes| tubes.triangles(first)));
    }

    /// Adds the positions, when the cloth's vertices are at `own`.
    pub(super) fn place(&self, positions: &[DVec3], shown: &mut Vec<DVec3>) {
        shown.extend_from_slice(&positions[..self.own_vertices()]);
        if let Some(tubes) = &self.tubes {
            tubes.place(positions, shown);
        }
        shown.extend_from_slice(&positions[self.vertices..]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use selvedge::Mesh;

    #[test]
    fn a_fringe_is_shown_after_the_triangles_of_its_cloth() {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_X * 2.0];
        let mesh = Mesh::new(positions, vec![[0, 1, 2]]);
        let cloth = Cloth::from_mesh_with_loose_edges(mesh, &[[0, 3], [3, 4]], DVec3::X, [0.1, 0.1]).unwrap();
        let scene = Scene::new(cloth, 1e-3);
        let shown = ShownGeometry::new(&scene, 0);
        let (count, triangles) = shown.mesh(&scene.cloths[0]);
        assert_eq!((count, triangles[0]), (5 + 3 * 8, [0, 1, 2]));
        let mut placed = Vec::new();
        shown.place(&scene.cloths[0].mesh().positions, &mut placed);
        assert_eq!((placed.len(), &placed[..5]), (count, &scene.cloths[0].mesh().positions[..]));
    }
}
