//! Selvedge for Python: the native part of the package `selvedge`.
//!
//! ```text
//! numpy arrays ──▶ arrays.rs (borrowed as they are, or made so by _arrays.py) ──▶ the detector, without the interpreter ──▶ answers.rs
//! ```
//! What a call may do to a thread, a process and an exception is in `call.rs` and `errors.rs`; the names of ipctk are Python alone,
//! in `ipc.py`.

mod answers;
mod arrays;
mod call;
mod detector;
mod errors;
mod finder;
mod pairs;
mod simulation;

use pyo3::prelude::*;

/// What `selvedge/__init__.py` shows.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::detector::Detector;
    #[pymodule_export]
    use crate::pairs::{time_of_impact, touches};
    #[pymodule_export]
    use crate::simulation::Simulation;

    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("ARM_SLEEVE", selvedge_cloth::ARM_SLEEVE)?;
        module.add("EFFECTS", selvedge_cloth::effect_names().to_vec())
    }
}
