//! Selvedge for Python: the native part of the package `selvedge`.
//!
//! ```text
//! numpy arrays ──▶ arrays.rs (borrowed, or converted by _arrays.py) ──▶ the detector, without the GIL ──▶ answers.rs
//! ```
//! `call.rs` and `errors.rs` handle threads, processes and exceptions. The names of ipctk are in `ipc.py`, in Python only.

mod answers;
mod arrays;
mod call;
mod detector;
mod driven;
mod errors;
mod finder;
mod intersections;
mod loads;
mod meshes;
mod pairs;
mod scenes;
mod simulated;
mod simulation;

use pyo3::prelude::*;

/// The docstring of a name in the stub, `_native.pyi`: the one source of the package's documentation.
macro_rules! stub {
    ($name:literal) => {
        include_str!(concat!(env!("OUT_DIR"), "/", $name, ".txt"))
    };
}
pub(crate) use stub;

/// Defines the names that `selvedge/__init__.py` re-exports.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::detector::Detector;
    #[pymodule_export]
    use crate::meshes::{read_mesh, welded};
    #[pymodule_export]
    use crate::pairs::{time_of_impact, touches};
    #[pymodule_export]
    use crate::simulated::Simulation;

    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("ARM_SLEEVE", selvedge_cloth::ARM_SLEEVE)?;
        module.add("EFFECTS", selvedge_cloth::effect_names().to_vec())
    }
}
