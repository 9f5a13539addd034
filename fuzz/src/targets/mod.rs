//! The targets. Each takes any bytes, and panics if a promise of the project is broken on them.

mod box_tests;
mod c_interface;
mod certified_filter;
mod detector;
pub(crate) mod exact_signs;
mod exact_verdict;
mod meshes;
mod message;
mod pair;
mod scene;
mod time_of_impact;

pub use box_tests::box_tests;
pub use c_interface::c_interface;
pub use certified_filter::certified_filter;
pub use detector::detector;
pub use exact_signs::exact_signs;
pub use exact_verdict::exact_verdict;
pub use meshes::{gltf, obj, off, ply, stl};
pub use scene::scene;
pub use time_of_impact::time_of_impact;

/// A target and its name.
pub type Target = (&'static str, fn(&[u8]));

/// Every target.
pub const ALL: [Target; 13] = [
    ("certified_filter", certified_filter),
    ("box_tests", box_tests),
    ("exact_signs", exact_signs),
    ("exact_verdict", exact_verdict),
    ("time_of_impact", time_of_impact),
    ("detector", detector),
    ("obj", obj),
    ("ply", ply),
    ("stl", stl),
    ("off", off),
    ("gltf", gltf),
    ("scene", scene),
    ("c_interface", c_interface),
];
