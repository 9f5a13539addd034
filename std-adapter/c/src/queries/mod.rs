//! The queries that C asks a detector about a step or a state.

/// The functions for `double`. `build.rs` makes those for `float` from this file.
pub mod double;
mod generic;
/// The functions for `float`.
pub mod single {
    include!(concat!(env!("OUT_DIR"), "/queries.rs"));
}
