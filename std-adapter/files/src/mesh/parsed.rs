//! The common result of all parsers, and its conversion to a mesh.

use super::notes::{LeftOut, MeshNotes, count_part, missing};
use super::polygon::Triangulator;
use super::{LooseMesh, MeshFile};
use crate::problem::FileProblem;
use selvedge::{Mesh, Topology, first_coincident};
use selvedge_core::glam::DVec3;

/// A file's content: finite and in range, but it may have no faces.
#[derive(Debug, Default)]
pub(super) struct Parsed {
    pub(super) positions: Vec<DVec3>,
    pub(super) faces: Faces,
    /// The edges of no face, if they were requested.
    pub(super) loose_edges: Vec<[u32; 2]>,
    /// The points of no face, if they were requested.
    pub(super) points: Vec<u32>,
    pub(super) left_out: Vec<LeftOut>,
    /// The distance of [`ReadOptions`](super::ReadOptions::weld).
    pub(super) weld: Option<f64>,
}

/// The corners of faces with three corners or more.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Faces {
    corners: Vec<u32>,
    /// The end of the corners of each face.
    ends: Vec<usize>,
}

impl Faces {
    pub(super) fn push(&mut self, corners: &[u32]) {
        self.corners.extend_from_slice(corners);
        self.ends.push(self.corners.len());
    }

    pub(super) fn renumber(&mut self, numbers: &[u32]) {
        self.corners.iter_mut().for_each(|corner| *corner = numbers[*corner as usize]);
    }

    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[u32]> {
        let begins = std::iter::once(0).chain(self.ends.iter().copied());
        begins.zip(&self.ends).map(|(begin, &end)| &self.corners[begin..end])
    }
}

#[derive(Debug, Default)]
pub(super) struct Triangles {
    pub(super) triangles: Vec<[u32; 3]>,
    polygons: usize,
    overlapping: Vec<usize>,
    welded_vertices: usize,
    collapsed: usize,
}

impl Parsed {
    pub(super) fn leave_out(&mut self, part: LeftOut) {
        count_part(&mut self.left_out, part);
    }

    /// Refuses a file if a part with an area was left out.
    pub(super) fn whole(self) -> Result<Self, FileProblem> {
        match missing(&self.left_out) {
            None => Ok(self),
            Some(missing) => Err(FileProblem::Incomplete(missing)),
        }
    }

    /// Refuses a file of which nothing was read but vertices, and names what else there is.
    pub(super) fn check_content(&self) -> Result<(), FileProblem> {
        let is_empty = self.faces.len() == 0 && self.loose_edges.is_empty() && self.points.is_empty();
        if !is_empty || self.left_out.is_empty() {
            return Ok(());
        }
        let parts: Vec<String> = self.left_out.iter().take(3).map(LeftOut::to_string).collect();
        let more = if self.left_out.len() > 3 { " and others" } else { "" };
        Err(FileProblem::NoFace(format!("{}{more}", parts.join(", "))))
    }

    /// Splits all faces into triangles, in their order, and merges vertices on request.
    pub(super) fn triangles(&mut self) -> Triangles {
        let mut split = self.split();
        let Some(tolerance) = self.weld else {
            return split;
        };
        let first = first_coincident(&self.positions, tolerance);
        let merged = |vertex: u32| first[vertex as usize];
        split.welded_vertices = (0_u32..).zip(&first).filter(|&(vertex, &first)| vertex != first).count();
        let before = split.triangles.len();
        split.triangles.iter_mut().for_each(|corners| *corners = corners.map(merged));
        split.triangles.retain(|[a, b, c]| a != b && b != c && c != a);
        split.collapsed = before - split.triangles.len();
        self.loose_edges.iter_mut().for_each(|ends| *ends = ends.map(merged));
        self.loose_edges.retain(|[from, to]| from != to);
        self.points.retain(|&point| merged(point) == point);
        split
    }

    fn split(&self) -> Triangles {
        let mut split = Triangles::default();
        // A polygon has two triangles fewer than corners.
        split
            .triangles
            .reserve_exact(self.faces.corners.len().saturating_sub(2 * self.faces.len()));
        let mut triangulator = Triangulator::default();
        for (face, corners) in self.faces.iter().enumerate() {
            if let &[a, b, c] = corners {
                split.triangles.push([a, b, c]);
                continue;
            }
            split.polygons += 1;
            if !triangulator.triangulate(&self.positions, corners, &mut split.triangles) {
                split.overlapping.push(face);
            }
        }
        split
    }

    pub(super) fn notes(&mut self, split: &mut Triangles, topology: &Topology) -> MeshNotes {
        MeshNotes {
            polygons_triangulated: split.polygons,
            overlapping_polygons: std::mem::take(&mut split.overlapping),
            welded_vertices: split.welded_vertices,
            collapsed_triangles: split.collapsed,
            statistics: topology.statistics(),
            left_out: std::mem::take(&mut self.left_out),
        }
    }

    /// Makes a mesh of triangles alone.
    pub(super) fn into_file(mut self) -> Result<MeshFile, FileProblem> {
        self.check_content()?;
        let mut split = self.triangles();
        let topology = Topology::new(self.positions.len(), std::mem::take(&mut split.triangles))?;
        let notes = self.notes(&mut split, &topology);
        let triangles = topology.triangles().to_vec();
        let mesh = Mesh::new(self.positions, triangles);
        Ok(MeshFile { mesh, notes })
    }

    /// Makes a mesh with loose edges and points.
    pub(super) fn into_loose(mut self) -> Result<LooseMesh, FileProblem> {
        self.check_content()?;
        let mut split = self.triangles();
        let triangles = std::mem::take(&mut split.triangles);
        let topology = Topology::with_loose_features(self.positions.len(), triangles, &self.loose_edges, &self.points)?;
        let notes = self.notes(&mut split, &topology);
        Ok(LooseMesh {
            positions: self.positions,
            topology,
            notes,
        })
    }
}
