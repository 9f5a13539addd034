//! Figures that move: a skinned or morphing mesh of a glTF 2.0 file (`.gltf`, `.glb`), and where one of the file's animations takes its
//! vertices.
//!
//! Of a file are read: the triangles of one node's mesh, all its primitives one after the other, with their morph targets; the node's skin;
//! and one animation's channels of translation, rotation, scale and weights, with interpolation `STEP`, `LINEAR` (rotations along the shorter
//! arc) and `CUBICSPLINE`. What a file holds of surfaces, cameras and lights is left out. Compressed meshes (Draco, meshopt) are refused.
//!
//! Positions are computed in `f64` from the file's numbers, by the same operations on every platform: they are the same bits everywhere.
//!
//! Reading needs the feature `gltf`; without it [`read`] says so.

mod error;
#[cfg_attr(
    not(any(feature = "gltf", test)),
    expect(dead_code, reason = "only the reader makes figures")
)]
mod figure;
#[cfg(any(feature = "gltf", test))]
mod gltf;
#[cfg(test)]
mod tests;
#[cfg_attr(
    not(any(feature = "gltf", test)),
    expect(dead_code, reason = "only the reader makes tracks")
)]
mod track;

pub use error::{AnimationError, AnimationProblem, Choices};
pub use figure::Figure;

use crate::mesh::FileProblem;
use std::path::Path;

/// Which part of a file is wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Choice<'a> {
    /// The name of a node that has a mesh, or of its mesh; `None`: the only one there is.
    pub node: Option<&'a str>,
    /// The name of an animation; `None`: the only one there is.
    pub animation: Option<&'a str>,
}

/// Reads a moving figure from the glTF file at `path`, with the files beside it that it names.
///
/// # Errors
/// If a file cannot be read, is no glTF 2.0 or says more than it holds; if it has no such mesh or animation, or several and none was
/// chosen; if the animation does not move the mesh; if a number is not finite, or a vertex names a joint or a vertex that does not exist. The message
/// names the file, and the node, channel or vertex.
pub fn read(path: &Path, choice: &Choice<'_>) -> Result<Figure, AnimationError> {
    let bytes = std::fs::read(path).map_err(|error| AnimationError::of(path, FileProblem::from_read(error).into()))?;
    read_bytes(&bytes, path, choice)
}

/// Reads such a figure from the bytes of a file. Paths in it are relative to the folder of `path`, which is named in errors. Never panics,
/// whatever the bytes, and asks for memory only in proportion to them and to the files that they name.
///
/// # Errors
/// Those of [`read`].
pub fn read_bytes(bytes: &[u8], path: &Path, choice: &Choice<'_>) -> Result<Figure, AnimationError> {
    #[cfg(any(feature = "gltf", test))]
    let read = gltf::parse(bytes, path, choice);
    #[cfg(not(any(feature = "gltf", test)))]
    let read = {
        let _ = (bytes, choice);
        Err(AnimationProblem::NotBuiltIn)
    };
    read.map_err(|problem| AnimationError::of(path, problem))
}
