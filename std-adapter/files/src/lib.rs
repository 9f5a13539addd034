//! Mesh files, read exactly and with errors that say where the problem is and what to do.
//!
//! | module | what it is |
//! |---|---|
//! | [`mesh`] | **start here**: OBJ, PLY, STL, OFF and glTF files: one mesh, both frames of a step, or numbered frames |
//! | [`animation`] | skinned and morphing figures of glTF files; reading glTF needs the feature `gltf` |
//!
//! A file is read whole, or the report about it lists what was left out: see [`mesh::MeshNotes`].

#![forbid(unsafe_code)]

pub mod animation;
// These modules are for the project's other crates, and may change at any time.
#[doc(hidden)]
pub mod bytes;
#[doc(hidden)]
pub mod excerpt;
pub mod mesh;
mod problem;
mod source;
#[doc(hidden)]
pub mod temporary_file;

pub use source::FileSource;

/// Runs the examples of the readme as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
