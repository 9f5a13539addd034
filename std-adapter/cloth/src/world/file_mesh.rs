//! Cloths of files in the numbering of their files.

use super::Cloth;
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

    /// Takes note that the cloth's vertices have these numbers from now on.
    pub(crate) fn renumber(&mut self, number: &[u32]) {
        let named = self.vertex_of.iter_mut().filter(|vertex| **vertex != LEFT_OUT);
        named.for_each(|vertex| *vertex = number[*vertex as usize]);
    }

    /// Returns whether the cloth has the file's numbers.
    pub(crate) fn is_cloth(&self) -> bool {
        (0..).zip(&self.vertex_of).all(|(vertex, &own)| vertex == own)
    }

    /// Returns the number of the cloth's vertices before it tore.
    fn vertices_as_made(&self) -> u32 {
        let named = self.vertex_of.iter().filter(|&&vertex| vertex != LEFT_OUT);
        named.max().map_or(0, |last| last + 1)
    }
}

/// The way from the numbers of a simulation to those of files.
#[derive(Debug)]
pub(crate) struct FileNumbering {
    /// For each cloth, unless it has the numbers of its file, or has no file.
    cloths: Vec<Option<FileMesh>>,
}

impl FileNumbering {
    pub(crate) fn new(cloths: &[Cloth]) -> Self {
        Self {
            cloths: cloths.iter().map(|cloth| cloth.file.clone()).collect(),
        }
    }

    /// Converts the mesh and the loose edges of a simulation whose cloths have these ranges of vertices.
    pub(crate) fn numbered(&self, state: Mesh, edges: &[[u32; 2]], cloths: &[Range<usize>]) -> (Mesh, Vec<[u32; 2]>) {
        if self.cloths.iter().all(Option::is_none) {
            return (state, edges.to_vec());
        }
        let (mut made, mut made_edges, mut end) = (Mesh::default(), Vec::new(), 0);
        let (mut triangles, mut edges) = (state.triangles.as_slice(), edges);
        for (own, file) in cloths.iter().zip(&self.cloths) {
            let place = Place {
                from: own.start as u32,
                to: made.positions.len() as u32,
                file: file.as_ref(),
            };
            let positions = &state.positions[own.clone()];
            let first_copy = file.as_ref().map_or(0, |file| file.vertices_as_made() as usize);
            for (rest, &vertex) in file.iter().flat_map(|file| file.mesh.positions.iter().zip(&file.vertex_of)) {
                made.positions.push(positions.get(vertex as usize).copied().unwrap_or(*rest));
            }
            made.positions.extend_from_slice(&positions[first_copy..]);
            place.renumber(
                &mut triangles,
                own.end,
                file.as_ref().map(|file| &*file.mesh.triangles),
                &mut made.triangles,
            );
            place.renumber(
                &mut edges,
                own.end,
                file.as_ref().map(|file| &*file.loose_edges),
                &mut made_edges,
            );
            end = own.end;
        }
        let bodies = Place {
            from: end as u32,
            to: made.positions.len() as u32,
            file: None,
        };
        made.positions.extend_from_slice(&state.positions[end..]);
        bodies.renumber(&mut triangles, state.positions.len(), None, &mut made.triangles);
        (made, made_edges)
    }
}

/// The way from the numbers of a simulation to those of a file, for one cloth or all bodies.
struct Place<'a> {
    /// The first vertex of the simulation, and of the result.
    from: u32,
    to: u32,
    file: Option<&'a FileMesh>,
}

impl Place<'_> {
    /// Takes the features below the vertex `end` from the front of `features`, and appends those of the file.
    fn renumber<const N: usize>(
        &self,
        features: &mut &[[u32; N]],
        end: usize,
        of_file: Option<&[[u32; N]]>,
        made: &mut Vec<[u32; N]>,
    ) {
        let count = features.iter().take_while(|vertices| (vertices[0] as usize) < end).count();
        let (own, rest) = features.split_at(count);
        *features = rest;
        let (Some(file), Some(of_file)) = (self.file, of_file) else {
            made.extend(own.iter().map(|vertices| vertices.map(|vertex| vertex - self.from + self.to)));
            return;
        };
        let first_copy = file.vertices_as_made();
        let mut own = own.iter();
        for corners in of_file {
            let merged = corners.map(|corner| file.vertex_of[corner as usize]);
            let has_collapsed = (1..N).any(|k| merged[..k].contains(&merged[k]));
            let torn = if has_collapsed { None } else { own.next() };
            made.push(std::array::from_fn(|k| match torn.map(|now| now[k] - self.from) {
                Some(copy) if copy != merged[k] => self.to + file.vertex_of.len() as u32 + (copy - first_copy),
                _ => self.to + corners[k],
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
        // Two triangles with a split seam (1 and 3, 2 and 4), one that collapses between 1 and 3, an unused vertex 5; and a loose edge.
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
        let (mesh, edges) = numbering.numbered(state, &[[0, 1], [5, 2]], &[0..2, 2..7]);
        let expected = [10, 11, 12, 13, 14, 13, 14, 9, 15, 16, 17, 18, 19];
        assert_eq!(mesh.positions, expected.map(at));
        assert_eq!(mesh.triangles, [[2, 3, 4], [3, 5, 4], [5, 8, 9], [10, 11, 12]]);
        assert_eq!(edges, [[0, 1], [8, 2]]);
    }
}
