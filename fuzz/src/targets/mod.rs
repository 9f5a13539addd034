//! The targets. Each takes any bytes, and panics if a promise of the project is broken on them.

mod box_tests;
mod certified_filter;
mod distribution;
mod meshes;
mod message;
mod pair;
mod query_csv;

pub use box_tests::box_tests;
pub use certified_filter::certified_filter;
pub use distribution::distribution;
pub use meshes::{obj, ply};
pub use query_csv::query_csv;

/// A target by name.
pub type Target = (&'static str, fn(&[u8]));

/// Every target there is.
pub const ALL: [Target; 6] = [
    ("certified_filter", certified_filter),
    ("box_tests", box_tests),
    ("distribution", distribution),
    ("obj", obj),
    ("ply", ply),
    ("query_csv", query_csv),
];
