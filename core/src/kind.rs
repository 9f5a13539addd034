//! The two kinds of primitive pair.

use core::fmt;
use core::str::FromStr;

/// A kind of primitive pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PairKind {
    /// A vertex and a triangle, one point and three, written `vertex-face`.
    VertexFace,
    /// Two edges, two points and two, written `edge-edge`.
    EdgeEdge,
}

impl PairKind {
    /// Both kinds.
    pub const ALL: [Self; 2] = [Self::VertexFace, Self::EdgeEdge];

    /// Returns `"vertex-face"` or `"edge-edge"`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::VertexFace => "vertex-face",
            Self::EdgeEdge => "edge-edge",
        }
    }
}

impl fmt::Display for PairKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The error of a text that is neither `vertex-face` nor `edge-edge`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ParsePairKindError;

impl fmt::Display for ParsePairKindError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("no kind of primitive pair; choose vertex-face or edge-edge")
    }
}

impl core::error::Error for ParsePairKindError {}

impl FromStr for PairKind {
    type Err = ParsePairKindError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "vertex-face" => Ok(Self::VertexFace),
            "edge-edge" => Ok(Self::EdgeEdge),
            _ => Err(ParsePairKindError),
        }
    }
}
