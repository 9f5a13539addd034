//! Checks the input from C: pointers, counts and enumeration values.

use crate::status::{Failure, Status};
#[cfg(feature = "cloth")]
use std::ffi::{CStr, c_char};
use std::ptr::NonNull;
use std::slice;

/// A type for which all bits are a valid value.
pub(crate) trait Plain: Copy {}
impl Plain for u8 {}
impl Plain for u32 {}
impl Plain for usize {}
impl Plain for f32 {}
impl Plain for f64 {}
impl<T: Plain, const N: usize> Plain for [T; N] {}

/// Returns `count` groups of `N` numbers. A null pointer is allowed if `count` is 0.
///
/// # Safety
/// A pointer that is neither null nor misaligned points to that many, and no other code writes to them while the slice lives.
pub(crate) unsafe fn view<'a, T: Plain, const N: usize>(
    name: &str,
    start: *const T,
    count: usize,
) -> Result<&'a [[T; N]], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    check_pointer(name, start)?;
    let bytes = count.checked_mul(size_of::<[T; N]>());
    if bytes.is_none_or(|bytes| bytes > isize::MAX as usize) {
        let text = format!("{name} cannot have {count} entries: they do not fit into memory");
        return Err(Failure::new(Status::BadCount, text));
    }
    // SAFETY: the pointer is neither null nor misaligned, and the size is valid. Any bits are a value of `T`; the rest is the
    // caller's promise.
    Ok(unsafe { slice::from_raw_parts(start.cast(), count) })
}

fn check_pointer<T>(name: &str, pointer: *const T) -> Result<(), Failure> {
    if pointer.is_null() {
        Err(Failure::new(Status::NullPointer, format!("{name} is NULL")))
    } else if pointer.is_aligned() {
        Ok(())
    } else {
        let text = format!("{name} is not aligned: its address must be a multiple of {}", align_of::<T>());
        Err(Failure::new(Status::MisalignedPointer, text))
    }
}

/// A place for an answer. It is checked before the work starts and written when the work is done.
#[derive(Debug)]
pub(crate) struct Out<T>(NonNull<T>);

impl<T> Out<T> {
    /// # Safety
    /// A pointer that is neither null nor misaligned may be written to until the call ends.
    pub(crate) unsafe fn new(name: &str, pointer: *mut T) -> Result<Self, Failure> {
        check_pointer(name, pointer)?;
        NonNull::new(pointer)
            .map(Self)
            .ok_or_else(|| Failure::new(Status::NullPointer, format!("{name} is NULL")))
    }

    pub(crate) fn set(self, answer: T) {
        // SAFETY: the pointer is aligned, and the caller of `new` promised that it may be written to. The old value is plain and
        // is not dropped.
        unsafe { self.0.write(answer) }
    }
}

/// Room of the caller for numbers: three for each vertex, or as many as a row has.
#[derive(Debug)]
pub(crate) struct OutFrame<S> {
    start: Out<S>,
    vertex_count: usize,
}

impl<S: Plain> OutFrame<S> {
    /// # Safety
    /// The conditions are those of [`Out::new`], for as many numbers, until [`set`](Self::set).
    pub(crate) unsafe fn new(name: &str, start: *mut S, vertex_count: usize) -> Result<Self, Failure> {
        // SAFETY: the caller's promise.
        let start = unsafe { Out::new(name, start) }?;
        Ok(Self { start, vertex_count })
    }

    /// Writes the rows, as many as there is room for.
    pub(crate) fn fill<const N: usize>(self, rows: impl Iterator<Item = [S; N]>) {
        let start = self.start.0.cast::<[S; N]>();
        for (index, row) in rows.take(self.vertex_count).enumerate() {
            // SAFETY: the pointer is aligned as its numbers are, and the caller of `new` promised that so many may be written to.
            unsafe { start.add(index).write(row) };
        }
    }

    /// Writes positions that the library owns.
    pub(crate) fn set(self, positions: &[[S; 3]]) {
        let count = positions.len().min(self.vertex_count);
        let (from, to) = (NonNull::from(positions).cast::<[S; 3]>(), self.start.0.cast());
        // SAFETY: the pointer is aligned, and the caller of `new` promised that so many may be written to; the library's slice
        // does not overlap.
        unsafe { to.copy_from_nonoverlapping(from, count) };
    }
}

/// A place for a list: its first entry and its length.
#[derive(Debug)]
pub(crate) struct OutList<T> {
    start: Out<*const T>,
    count: Out<usize>,
}

impl<T> OutList<T> {
    /// # Safety
    /// The conditions are those of [`Out::new`], for both pointers.
    pub(crate) unsafe fn new(name: &str, start: *mut *const T, count: *mut usize) -> Result<Self, Failure> {
        // SAFETY: the caller's promise.
        let (start, count) = unsafe { (Out::new(name, start)?, Out::new("the count", count)?) };
        Ok(Self { start, count })
    }

    /// Writes the address and the length of the list. An empty list is at NULL.
    pub(crate) fn set(self, list: &[T]) {
        self.set_parts(list.as_ptr(), list.len());
    }

    /// Writes the address and the length of a list that lives elsewhere.
    pub(crate) fn set_parts(self, start: *const T, count: usize) {
        self.start.set(if count == 0 { std::ptr::null() } else { start });
        self.count.set(count);
    }
}

/// Returns a text that ends with a zero byte.
///
/// # Safety
/// Unless the pointer is null, a zero byte follows it, and no other code writes to the text while it lives.
#[cfg(feature = "cloth")]
pub(crate) unsafe fn text<'a>(name: &str, start: *const c_char) -> Result<&'a str, Failure> {
    check_pointer(name, start)?;
    // SAFETY: the pointer is not null; the rest is the caller's promise.
    let bytes = unsafe { CStr::from_ptr(start) };
    let not_utf8 = |error| Failure::new(Status::BadText, format!("{name} is not UTF-8: {error}"));
    bytes.to_str().map_err(not_utf8)
}

/// Returns the error that `number` is not a value of the enumeration `name`.
pub(crate) fn unknown(name: &str, number: u32) -> Failure {
    Failure::new(Status::UnknownConstant, format!("{number} is not a value of {name}"))
}
