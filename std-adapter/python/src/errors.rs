//! Converts errors to exceptions of `selvedge.errors`, with the library's messages.

use crate::answers::{show_crossings, show_untangled};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use selvedge::{StepError, ThreadError, TopologyError};
use selvedge_cloth::{DriveError, SetupError, TeleportError};

macro_rules! exceptions {
    ($($name:ident),*) => { $(pyo3::import_exception!(selvedge.errors, $name);)* };
}
exceptions!(
    BlockedError,
    BrokenError,
    BusyError,
    CancelledError,
    CheckpointError,
    DataTypeError,
    ForkedError,
    InputError,
    SceneError,
    TangledError,
    ThreadsError,
    TooManyPairsError,
    TooMuchMemoryError
);

pub(crate) fn of_step(error: &StepError) -> PyErr {
    let text = error.to_string();
    match error {
        StepError::Cancelled => CancelledError::new_err(text),
        StepError::TooManyPairs { .. } => TooManyPairsError::new_err(text),
        StepError::TooMuchMemory { .. } => TooMuchMemoryError::new_err(text),
        _ => InputError::new_err(text),
    }
}

pub(crate) fn of_topology(error: TopologyError) -> PyErr {
    InputError::new_err(error.to_string())
}

pub(crate) fn of_threads(error: &ThreadError) -> PyErr {
    ThreadsError::new_err(error.to_string())
}

pub(crate) fn no_memory(what: &str, count: usize) -> PyErr {
    PyMemoryError::new_err(format!("the operating system refused memory for {count} {what}"))
}

pub(crate) fn busy() -> PyErr {
    BusyError::new_err("another thread is using this object")
}

pub(crate) fn broken(words: &str) -> PyErr {
    BrokenError::new_err(format!("a bug in Selvedge, please report it: {words}"))
}

pub(crate) fn of_setup(py: Python<'_>, error: &SetupError) -> PyErr {
    match error {
        SetupError::Threads(error) => of_threads(error),
        SetupError::Tangled(tangled) => {
            let crossings: Vec<_> = tangled.crossings_in_files().collect();
            let shown = show_crossings(py, &crossings).and_then(|crossings| {
                let untangled = show_untangled(py, tangled.untangled.as_ref())?;
                Ok((tangled.to_string(), crossings.unbind(), untangled.map(Bound::unbind)))
            });
            shown.map_or_else(|error| error, TangledError::new_err)
        }
        error => SceneError::new_err(error.to_string()),
    }
}

pub(crate) fn of_scene(error: &selvedge_cloth::SceneError) -> PyErr {
    SceneError::new_err(error.to_string())
}

pub(crate) fn of_teleport(error: &TeleportError) -> PyErr {
    match error {
        TeleportError::NoRoom { .. } => BlockedError::new_err(error.to_string()),
        error => InputError::new_err(error.to_string()),
    }
}

pub(crate) fn of_driving(error: &DriveError) -> PyErr {
    InputError::new_err(error.to_string())
}
