//! The two kinds of primitive pair, and how a benchmark file's path tells which it holds.

use crate::mesh::Topology;
use std::{fmt, ops::AddAssign, path::Path, str::FromStr};

/// A kind of primitive pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PairKind {
    /// A vertex against a triangle; written `vertex-face`.
    VertexFace,
    /// An edge against an edge; written `edge-edge`.
    EdgeEdge,
}

impl PairKind {
    /// `"vertex-face"` or `"edge-edge"`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::VertexFace => "vertex-face",
            Self::EdgeEdge => "edge-edge",
        }
    }

    /// The four mesh vertices of a pair of this kind: the vertex and the face's three, or the two edges' ends.
    ///
    /// # Panics
    /// If the pair is not of this mesh.
    #[must_use]
    pub fn vertices(self, pair: [u32; 2], topology: &Topology) -> [u32; 4] {
        let [first, second] = pair.map(|feature| feature as usize);
        match self {
            Self::VertexFace => {
                let [a, b, c] = topology.triangles()[second];
                [pair[0], a, b, c]
            }
            Self::EdgeEdge => {
                let ([a, b], [c, d]) = (topology.edges()[first], topology.edges()[second]);
                [a, b, c, d]
            }
        }
    }

    /// The names of a query's four points, in the order of its rows.
    #[must_use]
    pub fn point_names(self) -> [&'static str; 4] {
        match self {
            Self::VertexFace => ["v", "f0", "f1", "f2"],
            Self::EdgeEdge => ["a0", "a1", "b0", "b1"],
        }
    }

    /// The kind that a path names, or `None`.
    ///
    /// The file's folder decides if it is called `vertex-face` or `edge-edge` (so the benchmark's
    /// query sets are laid out); else a file name that ends in `vf` or `ee` before its extension
    /// does, if no letter comes before it (`227vf.csv`, but not `knee.csv`).
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        // Made absolute so that `data.csv` inside `vertex-face` is recognised from there.
        let absolute = std::path::absolute(path);
        let folder = absolute.as_deref().unwrap_or(path).parent();
        let folder_name = folder.and_then(Path::file_name).and_then(|name| name.to_str());
        folder_name
            .and_then(|name| name.parse().ok())
            .or_else(|| Self::from_stem(path.file_stem()?.to_str()?))
    }

    fn from_stem(stem: &str) -> Option<Self> {
        let ends_in = |suffix| {
            stem.strip_suffix(suffix)
                .is_some_and(|rest| !rest.ends_with(char::is_alphabetic))
        };
        if ends_in("vf") {
            Some(Self::VertexFace)
        } else if ends_in("ee") {
            Some(Self::EdgeEdge)
        } else {
            None
        }
    }
}

/// How many pairs of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PairCounts {
    /// Vertex–face pairs.
    pub vertex_face: u64,
    /// Edge–edge pairs.
    pub edge_edge: u64,
}

impl PairCounts {
    /// No pairs.
    pub(crate) const NONE: Self = Self {
        vertex_face: 0,
        edge_edge: 0,
    };

    /// Both kinds together.
    #[must_use]
    pub const fn total(self) -> u64 {
        self.vertex_face + self.edge_edge
    }
}

impl AddAssign for PairCounts {
    fn add_assign(&mut self, other: Self) {
        self.vertex_face += other.vertex_face;
        self.edge_edge += other.edge_edge;
    }
}

impl fmt::Display for PairKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The text is neither `vertex-face` nor `edge-edge`.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("'{0}' is no kind of primitive pair; choose vertex-face or edge-edge")]
pub struct ParsePairKindError(String);

impl FromStr for PairKind {
    type Err = ParsePairKindError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "vertex-face" => Ok(Self::VertexFace),
            "edge-edge" => Ok(Self::EdgeEdge),
            _ => Err(ParsePairKindError(text.to_owned())),
        }
    }
}
