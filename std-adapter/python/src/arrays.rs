//! Borrows the caller's arrays if their layout fits; `selvedge/_arrays.py` converts the others.

use crate::errors::{self, InputError};
use numpy::{Element, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyModule;

fn helper<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let module = MODULE.get_or_try_init(py, || py.import("selvedge._arrays").map(Bound::unbind))?;
    module.bind(py).getattr(name)
}

/// A borrowed array of rows. numpy refuses writers while it lives.
pub(crate) struct Rows<'py, T: Element, const N: usize>(PyReadonlyArray2<'py, T>);

impl<'py, T: Element, const N: usize> Rows<'py, T, N> {
    /// Returns the array if it is aligned, in C order and native byte order, and has `N` columns.
    fn as_it_is(value: &Bound<'py, PyAny>) -> Option<Self> {
        // A subclass may mean something else by its numbers, as masked arrays do.
        if !value.is_exact_instance_of::<PyUntypedArray>() {
            return None;
        }
        let array = value.cast::<PyArray2<T>>().ok()?;
        let fits = array.is_c_contiguous() && array.shape()[1] == N;
        let array = fits.then(|| array.try_readonly().ok())??;
        array.as_slice().is_ok().then_some(Self(array))
    }

    fn made(value: &Bound<'py, PyAny>, name: &str) -> PyResult<Self> {
        // Only one reason remains: another extension has borrowed it for writing.
        Self::as_it_is(value).ok_or_else(|| InputError::new_err(format!("{name}: another extension is writing to it")))
    }

    pub(crate) fn rows(&self) -> PyResult<&[[T; N]]> {
        let (rows, _) = self.0.as_slice()?.as_chunks();
        Ok(rows)
    }
}

/// `N` frames of positions in one format: `f32` if all frames have it, otherwise `f64`.
pub(crate) enum Frames<'py, const N: usize> {
    Single([Rows<'py, f32, 3>; N]),
    Double([Rows<'py, f64, 3>; N]),
}

impl<'py, const N: usize> Frames<'py, N> {
    pub(crate) fn of(values: [(&str, &Bound<'py, PyAny>); N]) -> PyResult<Self> {
        if let Some(frames) = all(values, |_, value| Rows::as_it_is(value)) {
            return Ok(Self::Double(frames));
        }
        if let Some(frames) = all(values, |_, value| Rows::as_it_is(value)) {
            return Ok(Self::Single(frames));
        }
        let positions = |is_single: bool| {
            let mut made = Vec::with_capacity(N);
            for (name, value) in values {
                made.push(helper(value.py(), "positions")?.call1((value, name, is_single))?);
            }
            Ok::<_, PyErr>(made)
        };
        let made = positions(true)?;
        if made.iter().all(|array| array.cast::<PyArray2<f32>>().is_ok()) {
            return Ok(Self::Single(rows_of(&made, values)?));
        }
        Ok(Self::Double(rows_of(&positions(false)?, values)?))
    }
}

fn rows_of<'py, T: Element, const N: usize>(
    made: &[Bound<'py, PyAny>],
    values: [(&str, &Bound<'py, PyAny>); N],
) -> PyResult<[Rows<'py, T, 3>; N]> {
    let mut error = None;
    let mut made = made.iter();
    let rows = all(values, |name, _| match Rows::made(made.next()?, name) {
        Ok(rows) => Some(rows),
        Err(failed) => {
            error = Some(failed);
            None
        }
    });
    rows.ok_or_else(|| error.unwrap_or_else(|| InputError::new_err("there are too few frames")))
}

/// Returns all of the rows, or `None` if one is missing.
fn all<'a, 'py, T, const N: usize>(
    values: [(&'a str, &'a Bound<'py, PyAny>); N],
    mut make: impl FnMut(&'a str, &'a Bound<'py, PyAny>) -> Option<T>,
) -> Option<[T; N]> {
    let mut made = Vec::with_capacity(N);
    for (name, value) in values {
        made.push(make(name, value)?);
    }
    made.try_into().ok()
}

/// Evaluates one expression with frames of either format.
macro_rules! with_frames {
    ($frames:expr, $rows:pat => $action:expr) => {
        match $frames {
            $crate::arrays::Frames::Single($rows) => $action,
            $crate::arrays::Frames::Double($rows) => $action,
        }
    };
}
pub(crate) use with_frames;

/// Copies rows of whole numbers.
pub(crate) fn indices<const N: usize>(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<[u32; N]>> {
    let rows = match Rows::<u32, N>::as_it_is(value) {
        Some(rows) => rows,
        None => Rows::made(&helper(value.py(), "indices")?.call1((value, name, N))?, name)?,
    };
    let rows = rows.rows()?;
    let mut copied = Vec::new();
    copied
        .try_reserve_exact(rows.len())
        .map_err(|_| errors::no_memory(name, rows.len()))?;
    copied.extend_from_slice(rows);
    Ok(copied)
}

/// Copies one truth value per entry.
pub(crate) fn flags(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<bool>> {
    let array = helper(value.py(), "flags")?.call1((value, name))?;
    Ok(array.cast::<numpy::PyArray1<bool>>()?.to_vec()?)
}
