//! Selvedge for C. `include/selvedge.h` is made of this; `include/selvedge.hpp` stands on it.
//!
//! ```text
//! status     what becomes of a call: codes, texts, the last error of a thread
//! guard      one call: panics are caught
//! input      what comes from C: pointers, counts, numbers; nearly all that is unsafe
//! handles    what lives, by its handles, which are numbers and never followed
//! detector   detectors; settings, questions, answers    their functions, by what they are for
//! world      worlds, and their functions
//! simulation cloth in motion, with the feature `cloth`: `include/selvedge_cloth.h`, and `.hpp` on it
//! version    macros and functions
//! ```
//!
//! All that the project has of `unsafe` is in this crate. A function of it trusts its caller in one thing: that a pointer which
//! is neither null nor misaligned has so many items behind it as the count says, that nobody else writes to them meanwhile.

#![deny(unsafe_op_in_unsafe_fn, clippy::undocumented_unsafe_blocks)]
// Functions have to be public to be seen from C, though nobody can name them in Rust.
#![allow(unreachable_pub)]

#[cfg(not(panic = "unwind"))]
compile_error!("build the C interface with panic = \"unwind\": otherwise a fault of the library's ends the caller's program");

mod answers;
mod detector;
mod guard;
mod handles;
mod input;
mod questions;
mod settings;
#[cfg(feature = "cloth")]
mod simulation;
mod status;
#[cfg(test)]
mod tests;
mod version;
mod world;
