//! Converts errors to exceptions of `selvedge.errors`, with the library's messages.

use pyo3::PyErr;
use pyo3::exceptions::PyMemoryError;
use selvedge::{StepError, ThreadError, TopologyError};

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
