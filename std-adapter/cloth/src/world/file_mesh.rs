//! Cloths of files in the numbering of their files.

use selvedge::Mesh;
use std::ops::Range;

/// A mesh as its file has it, and its vertices in the cloth.
#[derive(Clone, Debug, Default)]
pub(crate) struct FileMesh {
    /// In the scene's place, in metres.
    pub(crate) mesh: Mesh,
    pub(crate) loose_edges: Vec<[u32; 2]>,
    /// The cloth's vertex for each vertex of the file; [`LEFT_OUT`] if it has none.
    pub(crate) vertex_of: Vec<u32>,
}

/// Marks a vertex that the cloth does not have.
pub(crate) const LEFT_OUT: u32 = u32::MAX;

impl FileMesh {
    pub(crate) fn new(mesh: &Mesh, loose_edges: &[[u32; 2]]) -> Self {
        Self {
            mesh: mesh.clone(),
            loose_edges: loose_edges.to_vec(),
            vertex_of: (0..mesh.positions.len() as u32).collect(),
        }
    }

    /// Gives the cloth's vertices new numbers.
    pub(crate) fn renumber(&mut self, number: &[u32]) {
        let named = self.vertex_of.iter_mut().filter(|vertex| **vertex != LEFT_OUT);
        named.for_each(|vertex| *vertex = number[*vertex as usize]);
    }

    /// Returns whether the cloth has the file's numbers.
    pub(crate) fn is_cloth(&self) -> bool {
        (0..).zip(&self.vertex_of).all(|(vertex, &own)| vertex == own)
    }

    /// Returns the number of the cloth's vertices before it tore.
    fn vertices_as_made(&self) -> usize {
        let named = self.vertex_of.iter().filter(|&&vertex| vertex != LEFT_OUT);
        named.max().map_or(0, |&last| last as usize + 1)
    }
}

/// The state of a simulation as one mesh in which cloths from files have the vertices and faces of their files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshInFiles {
    /// Each cloth, then the bodies.
    pub mesh: Mesh,
    /// The edges of cloths that belong to no triangle.
    pub loose_edges: Vec<[u32; 2]>,
    /// The number in this mesh of each vertex of the simulation. Of vertices that `weld` merged it is the first.
    pub number_of: Vec<u32>,
    /// The vertices of each cloth in this mesh: those of its file, then the copies that tears made.
    pub vertices_of_cloths: Vec<Range<usize>>,
}

/// Maps the numbers of a simulation to those of files.
#[derive(Debug)]
pub(crate) struct FileNumbering {
    /// For each cloth, unless it has the numbers of its file, or has no file.
    cloths: Vec<Option<FileMesh>>,
}

impl FileNumbering {
    /// Takes the file of each cloth that has not the numbers of its file.
    pub(crate) fn new(files: impl Iterator<Item = Option<FileMesh>>) -> Self {
        Self { cloths: files.collect() }
    }

    /// Converts the mesh and the loose edges of a simulation whose cloths have these ranges of vertices.
    pub(crate) fn numbered(&self, state: &Mesh, edges: &[[u32; 2]], cloths: &[Range<usize>]) -> MeshInFiles {
        let mut made = MeshInFiles::default();
        let (mut triangles, mut edges) = (state.triangles.as_slice(), edges);
        for (own, file) in cloths.iter().zip(&self.cloths) {
            let first = made.mesh.positions.len();
            let positions = &state.positions[own.clone()];
            let vertex_of = file.as_ref().map_or(&[][..], |file| &file.vertex_of);
            let first_copy = file.as_ref().map_or(0, FileMesh::vertices_as_made);
            for (rest, &vertex) in file.iter().flat_map(|file| file.mesh.positions.iter().zip(vertex_of)) {
                let position = positions.get(vertex as usize).copied().unwrap_or(*rest);
                made.mesh.positions.push(position);
            }
            made.number_of.resize(own.start + first_copy, 0);
            made.number_of
                .extend((made.mesh.positions.len() as u32..).take(own.len() - first_copy));
            made.mesh.positions.extend_from_slice(&positions[first_copy..]);
            let named = (first..).zip(vertex_of).filter(|(_, vertex)| **vertex != LEFT_OUT);
            // The first of merged vertices is the last to be written.
            for (number, &vertex) in named.collect::<Vec<_>>().into_iter().rev() {
                made.number_of[own.start + vertex as usize] = number as u32;
            }
            made.vertices_of_cloths.push(first..made.mesh.positions.len());
            let place = Place {
                own,
                first: first as u32,
                number_of: &made.number_of,
                vertex_of,
            };
            let faces = file.as_ref().map(|file| &*file.mesh.triangles);
            place.renumber(&mut triangles, faces, &mut made.mesh.triangles);
            let loose_edges = file.as_ref().map(|file| &*file.loose_edges);
            place.renumber(&mut edges, loose_edges, &mut made.loose_edges);
        }
        let bodies = &state.positions[made.number_of.len()..];
        made.number_of.extend((made.mesh.positions.len() as u32..).take(bodies.len()));
        made.mesh.positions.extend_from_slice(bodies);
        let of_bodies = triangles
            .iter()
            .map(|corners| corners.map(|corner| made.number_of[corner as usize]));
        made.mesh.triangles.extend(of_bodies);
        made
    }
}

/// Maps the numbers of a simulation to those of a file, for one cloth.
struct Place<'a> {
    /// The vertices of the simulation.
    own: &'a Range<usize>,
    /// The first vertex in the result.
    first: u32,
    /// The numbers in the result.
    number_of: &'a [u32],
    /// The cloth's vertex for each vertex of the file.
    vertex_of: &'a [u32],
}

impl Place<'_> {
    /// Takes the cloth's features from the front of `features`, and appends those of the file.
    fn renumber<const N: usize>(&self, features: &mut &[[u32; N]], of_file: Option<&[[u32; N]]>, made: &mut Vec<[u32; N]>) {
        let is_own = |vertices: &&[u32; N]| (vertices[0] as usize) < self.own.end;
        let (own, rest) = features.split_at(features.iter().take_while(is_own).count());
        *features = rest;
        let number = |vertex: u32| self.number_of[vertex as usize];
        let Some(of_file) = of_file else {
            made.extend(own.iter().map(|vertices| vertices.map(number)));
            return;
        };
        let mut own = own.iter();
        for corners in of_file {
            let merged = corners.map(|corner| self.vertex_of[corner as usize]);
            let has_collapsed = (1..N).any(|k| merged[..k].contains(&merged[k]));
            let torn = if has_collapsed { None } else { own.next() };
            made.push(std::array::from_fn(|k| match torn.map(|now| now[k]) {
                Some(copy) if copy - self.own.start as u32 != merged[k] => number(copy),
                _ => self.first + corners[k],
            }));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use selvedge_core::glam::DVec3;

    #[test]
    fn a_torn_cloth_of_merged_vertices_gets_its_files_numbers_back() {
        let at = |x: i32| DVec3::X * f64::from(x);
        // Two triangles with a split seam (1 and 3, 2 and 4), one that collapses between 1 and 3, an unused vertex 5; and a loose
        // edge.
        let file = FileMesh {
            mesh: Mesh::new([0, 1, 2, 1, 2, 9, 3].map(at).to_vec(), vec![[0, 1, 2], [1, 3, 2], [3, 6, 4]]),
            loose_edges: vec![[6, 0]],
            vertex_of: vec![0, 1, 2, 1, 2, LEFT_OUT, 3],
        };
        assert!(!file.is_cloth());
        let numbering = FileNumbering {
            cloths: vec![None, Some(file)],
        };
        // A rope of two vertices; the cloth, which has torn at its vertex 2; a body.
        let state = Mesh::new((10..20).map(at).collect(), vec![[2, 3, 4], [3, 5, 6], [7, 8, 9]]);
        let MeshInFiles {
            mesh,
            loose_edges,
            number_of,
            vertices_of_cloths,
        } = numbering.numbered(&state, &[[0, 1], [5, 2]], &[0..2, 2..7]);
        let expected = [10, 11, 12, 13, 14, 13, 14, 9, 15, 16, 17, 18, 19];
        assert_eq!(mesh.positions, expected.map(at));
        assert_eq!(mesh.triangles, [[2, 3, 4], [3, 5, 4], [5, 8, 9], [10, 11, 12]]);
        assert_eq!(loose_edges, [[0, 1], [8, 2]]);
        assert_eq!(number_of, [0, 1, 2, 3, 4, 8, 9, 10, 11, 12]);
        assert_eq!(vertices_of_cloths, [0..2, 2..10]);
    }
}
