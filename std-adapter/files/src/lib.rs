//! Mesh files, read exactly and with errors that say where the problem is and what to do.
//!
//! | module | what it is |
//! |---|---|
//! | [`mesh`] | **start here**: OBJ and PLY files, one mesh, both frames of a step, or numbered frames |
//! | [`animation`] | skinned and morphing figures of glTF files; reading them needs the feature `gltf` |

#![forbid(unsafe_code)]

pub mod animation;
// What the project's other crates use besides; nothing is promised of it.
#[doc(hidden)]
pub mod bytes;
#[doc(hidden)]
pub mod excerpt;
pub mod mesh;
#[doc(hidden)]
pub mod temporary_file;
