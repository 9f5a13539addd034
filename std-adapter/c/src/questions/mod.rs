//! The questions that C asks a detector about a step or a state.

mod ask;
/// The functions for `double`. `build.rs` makes those for `float` from this file.
pub mod double;
/// The functions for `float`.
pub mod single {
    include!(concat!(env!("OUT_DIR"), "/questions.rs"));
}
