//! The parts of a file that a caller wants.

/// The parts of a file that the caller wants.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions<'a> {
    /// Reads edges and points that belong to no triangle as well. See
    /// [`read_with_loose_features`](super::read_with_loose_features).
    pub loose_features: bool,
    /// The group or object of an OBJ file, or the node of a glTF file, whose faces are read. `None` reads all. Vertices of OBJ
    /// files keep their numbers.
    pub only: Option<&'a str>,
    /// The distance up to which vertices are merged, in the file's unit; 0 merges only equal positions, and `None` merges
    /// nothing. Triangles, edges and points then name the lowest-numbered vertex. The others stay as unused vertices, so that all
    /// keep their numbers.
    pub weld: Option<f64>,
}
