//! The first difference between two files that should be frames of one mesh.

use super::parsed::Parsed;
use std::fmt;

/// The first difference between the faces of two frames.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FrameDifference {
    /// The numbers of vertices differ.
    #[error("the first has {start} vertices, the second {end}")]
    VertexCount {
        /// The number at the start of the step.
        start: usize,
        /// The number at the end of the step.
        end: usize,
    },
    /// A face has different vertices, or the same ones in another order.
    #[error("face {face} is {} in the first, {} in the second", Corners(start), Corners(end))]
    Face {
        /// The number of the face, from 0.
        face: usize,
        /// Its vertices at the start of the step.
        start: Vec<u32>,
        /// Its vertices at the end of the step.
        end: Vec<u32>,
    },
    /// The numbers of faces differ, and all faces are alike as far as both lists go.
    #[error("the first has {start} faces, the second {end}")]
    FaceCount {
        /// The number at the start of the step.
        start: usize,
        /// The number at the end of the step.
        end: usize,
    },
}

impl FrameDifference {
    /// The first difference between the vertices and faces of two frames, if any.
    pub(super) fn find(start: &Parsed, end: &Parsed) -> Option<Self> {
        if start.positions.len() != end.positions.len() {
            return Some(Self::VertexCount {
                start: start.positions.len(),
                end: end.positions.len(),
            });
        }
        let mut pairs = start.faces.iter().zip(end.faces.iter()).enumerate();
        if let Some((face, (start, end))) = pairs.find(|(_, (start, end))| start != end) {
            return Some(Self::Face {
                face,
                start: start.to_vec(),
                end: end.to_vec(),
            });
        }
        let counts = [start, end].map(|frame| frame.faces.len());
        (counts[0] != counts[1]).then_some(Self::FaceCount {
            start: counts[0],
            end: counts[1],
        })
    }
}

struct Corners<'a>(&'a [u32]);

impl fmt::Display for Corners<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let corners: Vec<String> = self.0.iter().take(8).map(u32::to_string).collect();
        write!(f, "{}{}", corners.join(" "), if self.0.len() > 8 { " …" } else { "" })
    }
}
