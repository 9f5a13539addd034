//! The report about a file.

use crate::excerpt::excerpt;
use selvedge::TopologyStatistics;
use std::fmt;

/// A report about a file that was read; `Display` shows it in one line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeshNotes {
    /// The number of faces with more than three corners, which were split into triangles.
    pub polygons_triangulated: usize,
    /// Faces for which no triangulation without overlap was found, numbered from 0. Each is split as a fan from its first corner.
    pub overlapping_polygons: Vec<usize>,
    /// The number of vertices that were merged into others.
    pub welded_vertices: usize,
    /// The number of triangles that lost their area in the merge, and are left out.
    pub collapsed_triangles: usize,
    /// Counts of the resulting mesh, duplicate and degenerate triangles included.
    pub statistics: TopologyStatistics,
    /// The parts of the file that are not in the mesh. Normals, colours, texture coordinates and materials are not listed.
    pub left_out: Vec<LeftOut>,
}

impl MeshNotes {
    /// Returns whether everything that has an area was read. If not, the file may have contacts that the mesh does not have.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        !self.left_out.iter().any(|part| part.may_have_area)
    }

    /// Names the parts that were left out and may have an area, as in `1 line 'surf' (line 12)`; `None` without such parts.
    #[must_use]
    pub fn missing(&self) -> Option<String> {
        missing(&self.left_out)
    }
}

/// The largest number of parts that a message names.
const MOST_NAMED: usize = 6;

pub(super) fn missing(left_out: &[LeftOut]) -> Option<String> {
    let parts = left_out.iter().filter(|part| part.may_have_area);
    let parts: Vec<String> = parts.take(MOST_NAMED).map(LeftOut::to_string).collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

impl fmt::Display for MeshNotes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.statistics)?;
        match self.polygons_triangulated {
            0 => {}
            1 => write!(f, ", 1 polygon split into triangles")?,
            count => write!(f, ", {count} polygons split into triangles")?,
        }
        match self.overlapping_polygons.as_slice() {
            [] => {}
            [face] => write!(f, ", face {face} has no triangulation without overlap")?,
            [face, rest @ ..] => write!(
                f,
                ", {} faces have no triangulation without overlap (the first is face {face})",
                rest.len() + 1
            )?,
        }
        if self.welded_vertices > 0 {
            let plural = if self.welded_vertices == 1 { "vertex" } else { "vertices" };
            write!(f, ", {} {plural} merged", self.welded_vertices)?;
        }
        if self.collapsed_triangles > 0 {
            let plural = if self.collapsed_triangles == 1 {
                "triangle"
            } else {
                "triangles"
            };
            write!(f, ", {} {plural} collapsed by that", self.collapsed_triangles)?;
        }
        for part in self.left_out.iter().take(MOST_NAMED) {
            write!(f, ", left out: {part}")?;
        }
        if self.left_out.len() > MOST_NAMED {
            write!(f, ", and {} other kinds of parts", self.left_out.len() - MOST_NAMED)?;
        }
        Ok(())
    }
}

/// A kind of part that a file has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FilePart {
    /// Lines of an OBJ file with one keyword.
    Line,
    /// Elements of a PLY file with one name.
    Element,
    /// Faces of an OFF file with fewer than three corners.
    Face,
    /// Bytes after the end that the header declares.
    TrailingByte,
    /// Primitives of a glTF mesh that are not triangles.
    Primitive,
    /// Nodes of a glTF file.
    Node,
    /// Channels of a glTF animation.
    Channel,
    /// Vertices of a glTF figure that follow no joint of their own.
    Vertex,
}

/// A part of a file that is not in the mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// The kind of the part.
    pub part: FilePart,
    /// The keyword or name of the part in the file, which may be empty.
    pub name: String,
    /// The number of such parts.
    pub count: usize,
    /// The line of the first, in a file with lines.
    pub line: Option<usize>,
    /// True if the part may have an area. Then the file may have contacts that the mesh does not have.
    pub may_have_area: bool,
}

impl LeftOut {
    pub(crate) fn new(part: FilePart, name: impl Into<String>, count: usize, line: Option<usize>, may_have_area: bool) -> Self {
        let name = name.into();
        Self {
            part,
            name,
            count,
            line,
            may_have_area,
        }
    }
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [singular, plural] = match self.part {
            FilePart::Line => ["line", "lines"],
            FilePart::Element => ["element", "elements"],
            FilePart::Face => ["face", "faces"],
            FilePart::TrailingByte => ["byte after the end", "bytes after the end"],
            FilePart::Primitive => ["primitive", "primitives"],
            FilePart::Node => ["node", "nodes"],
            FilePart::Channel => ["channel", "channels"],
            FilePart::Vertex => ["vertex", "vertices"],
        };
        write!(f, "{} {}", self.count, if self.count == 1 { singular } else { plural })?;
        if !self.name.is_empty() {
            write!(f, " '{}'", excerpt(&self.name, 40))?;
        }
        match (self.line, self.count) {
            (None, _) => Ok(()),
            (Some(line), 1) => write!(f, " (line {line})"),
            (Some(line), _) => write!(f, " (the first on line {line})"),
        }
    }
}

/// Counts parts by kind and name.
pub(super) fn count_part(parts: &mut Vec<LeftOut>, part: LeftOut) {
    let same = parts
        .iter()
        .position(|known| known.part == part.part && known.name == part.name);
    // A file of noise has a new keyword on each line.
    let full = (parts.len() >= 100).then(|| parts.len() - 1);
    match same.or(full) {
        None => parts.push(part),
        Some(place) => {
            let own = &mut parts[place];
            own.count += part.count;
            own.may_have_area |= part.may_have_area;
            if same.is_none() {
                own.name.clear();
            }
        }
    }
}
