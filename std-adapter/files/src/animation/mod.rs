//! Figures of glTF 2.0 files (`.gltf`, `.glb`): meshes of one node or of a whole scene, and the motion of their vertices in one
//! animation.
//!
//! The reader takes the triangles of each mesh (lists, strips and fans), all its primitives in turn, with their morph targets,
//! and the node's skin. Of one animation it takes the channels of translation, rotation, scale and weights. Interpolation is
//! `STEP`, `LINEAR` (rotations along the shorter arc) or `CUBICSPLINE`. A file without animations is a figure that rests. Looks,
//! lights and cameras are ignored, even if the file requires extensions for them. Points, lines and other channels are
//! [listed](Figure::left_out). Compressed meshes (Draco, meshopt) are refused; the message has the command that converts them.
//!
//! Positions are computed in `f64` from the file's numbers, with the same bits on every platform.
//!
//! Reading needs the feature `gltf`; without it [`read`] returns [`AnimationProblem::NotBuiltIn`].

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

pub use crate::problem::{AnimationProblem, NamesInFile};
pub use error::AnimationError;
pub use figure::Figure;

use crate::FileSource;
use crate::problem::FileProblem;
use std::path::Path;

/// The part of a file that the caller wants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Choice<'a> {
    /// The name of a node that has a mesh, the name of its mesh, or its path, such as `figure/arm`. With `None` all nodes of the
    /// scene are one mesh.
    pub node: Option<&'a str>,
    /// The name of an animation. With `None` it is the only one, if there is one.
    pub animation: Option<&'a str>,
    /// True if the figure rests in the pose of its nodes, without an animation.
    pub at_rest: bool,
}

/// Reads a moving figure from the glTF file at `path`, with the files beside it that it names.
///
/// # Errors
/// Returns an error if a file cannot be read, is no glTF 2.0 or declares more than it holds. The node and the animation must
/// exist and be unique. Other errors are a required extension that changes shapes, a number that is not finite, and a joint or
/// vertex that does not exist. The message names the file, and the node, channel or vertex.
pub fn read(path: &Path, choice: &Choice<'_>) -> Result<Figure, AnimationError> {
    read_from(&FileSource::Disk, path, choice)
}

/// Reads a moving figure from a glTF file of any source, like [`read`].
///
/// # Errors
/// Those of [`read`].
pub fn read_from(source: &FileSource, path: &Path, choice: &Choice<'_>) -> Result<Figure, AnimationError> {
    let bytes = source.read(path);
    let bytes = bytes.map_err(|error| AnimationError::of(path, FileProblem::from_read(error).into()))?;
    parse(&bytes, source.beside(path), choice).map_err(|problem| AnimationError::of(path, problem))
}

/// Reads such a figure from the bytes of a file. Paths in it are relative to the folder of `path`, which errors name. No input
/// causes a panic, and the memory is in proportion to the bytes and the files that they name.
///
/// # Errors
/// Returns the errors of [`read`].
pub fn read_bytes(bytes: &[u8], path: &Path, choice: &Choice<'_>) -> Result<Figure, AnimationError> {
    parse(bytes, path, choice).map_err(|problem| AnimationError::of(path, problem))
}

#[cfg(any(feature = "gltf", test))]
pub(crate) use gltf::parse;

#[cfg(not(any(feature = "gltf", test)))]
pub(crate) fn parse(_bytes: &[u8], _path: &Path, _choice: &Choice<'_>) -> Result<Figure, AnimationProblem> {
    Err(AnimationProblem::NotBuiltIn)
}
