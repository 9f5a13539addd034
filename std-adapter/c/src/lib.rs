//! Selvedge for C. cbindgen makes `include/selvedge.h` from this crate; `include/selvedge.hpp` wraps it for C++.
//!
//! ```text
//! status      result codes, their texts, the last error of each thread
//! guard       catches panics at the border
//! input       checks pointers, counts and enumeration values; most `unsafe` code is here
//! files       reads mesh files, with the feature `cloth`
//! handles     looks up detectors, worlds, simulations and files by number
//! detector    creates and frees detectors
//! settings    how a detector searches
//! queries     what C can ask a detector
//! answers     the rows that C reads
//! world       worlds of several meshes
//! simulation  cloth in motion, with the feature `cloth` (`include/selvedge_cloth.h` and `.hpp`)
//! version     version macros and functions
//! weld        merges vertices in the same place
//! ```
//!
//! This crate holds all `unsafe` code of the product. Its functions rely on one promise of the caller. A pointer that is neither
//! null nor misaligned points to as many items as the count says. No other thread writes to them during the call.

#![deny(unsafe_op_in_unsafe_fn, clippy::undocumented_unsafe_blocks)]
// C can only call public functions. Rust code cannot name them.
#![allow(unreachable_pub)]

#[cfg(not(panic = "unwind"))]
compile_error!("build the C interface with panic = \"unwind\": otherwise a bug in the library ends the caller's program");

mod answers;
mod detector;
#[cfg(feature = "cloth")]
mod files;
mod guard;
mod handles;
mod input;
mod queries;
mod settings;
#[cfg(feature = "cloth")]
mod simulation;
mod status;
#[cfg(test)]
mod tests;
mod version;
mod weld;
mod world;

/// The functions and rows that C sees. C's headers declare them; this is for the fuzz target that calls them as C does, so that
/// the compiler checks its calls.
#[doc(hidden)]
pub mod interface {
    pub use crate::answers::{Boxes, ContactRow, GeometryRow, IntersectionRow, PairRow, TruncationRow};
    pub use crate::detector::*;
    #[cfg(feature = "cloth")]
    pub use crate::files::*;
    pub use crate::queries::{double::*, single::*};
    pub use crate::settings::*;
    #[cfg(feature = "cloth")]
    pub use crate::simulation::{checkpoint::*, counts::*, lead::*, run::*, state::*};
    pub use crate::status::*;
    pub use crate::weld::*;
    pub use crate::world::steps::{
        Deforming, PoseRow, Rigid, WorldContactRow, WorldGeometryRow, selvedge_world_contact_geometries,
    };
    pub use crate::world::{double::*, single::*, *};
}
