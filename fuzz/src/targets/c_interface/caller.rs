//! A program in C that calls with any arguments, and looks at the status, the last error and its own variables afterwards.

use crate::targets::message;
use selvedge_c::interface::{Handle, Status, selvedge_detector_free, selvedge_last_error, selvedge_status_string};
use std::ffi::CStr;
use std::fmt::Debug;
use std::ptr;

/// The number of entries that each array of the caller has, whatever count it passes.
pub(super) const ROOM: usize = 16;
/// The number of vertices of the meshes.
pub(super) const VERTICES: usize = 6;
/// Counts that no array has: every one is refused before an entry is read.
const HUGE: [usize; 2] = [usize::MAX, 1 << 62];

/// The fuzzer's bytes, read as arguments. Zeros follow the last byte.
pub(super) struct Caller<'a> {
    bytes: &'a [u8],
    /// True if an argument of the next call is a pointer that no call accepts.
    has_bad_pointer: bool,
}

impl<'a> Caller<'a> {
    pub(super) const fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            has_bad_pointer: false,
        }
    }

    pub(super) const fn is_done(&self) -> bool {
        self.bytes.is_empty()
    }

    pub(super) fn byte(&mut self) -> u8 {
        let (&first, rest) = self.bytes.split_first().unwrap_or((&0, &[]));
        self.bytes = rest;
        first
    }

    pub(super) fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[usize::from(self.byte()) % choices.len()]
    }

    /// Returns a number: mostly a small one, sometimes one that breaks arithmetic, or any eight bytes.
    pub(super) fn number(&mut self) -> f64 {
        const BREAKING: [f64; 11] = [
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::MAX,
            f64::MIN_POSITIVE,
            5e-324,
            -0.0,
            1e30,
            -1e30,
            1e-30,
            4_294_967_296.0,
        ];
        match self.byte() {
            tag @ 0..192 => (f64::from(tag) - 96.0) / 32.0,
            tag @ 192..240 => BREAKING[usize::from(tag) % BREAKING.len()],
            _ => f64::from_bits(u64::from_le_bytes([(); 8].map(|()| self.byte()))),
        }
    }

    /// Returns a whole number: mostly a small one.
    pub(super) fn whole(&mut self) -> u32 {
        match self.byte() {
            tag @ 0..240 => u32::from(tag) % 8,
            tag => u32::MAX - u32::from(tag % 4),
        }
    }

    /// Returns the right count, another one that the arrays have, or one that is refused unread.
    pub(super) fn count(&mut self, right: usize) -> usize {
        match self.byte() {
            0..200 => right,
            tag @ 200..240 => usize::from(tag) % (ROOM + 1),
            tag => HUGE[usize::from(tag) % HUGE.len()],
        }
    }

    /// Returns `count` if the arrays have that many entries, and 0 otherwise.
    pub(super) fn short_count(&mut self, right: usize) -> usize {
        Some(self.count(right)).filter(|&count| count <= ROOM).unwrap_or_default()
    }

    /// Returns the address of an array, sometimes one that must be refused if there is an entry.
    pub(super) fn array<T, N>(&mut self, array: &[T], count: usize) -> *const N {
        let start = array.as_ptr().cast::<N>();
        match self.byte() {
            0..248 => start,
            _ if count == 0 => ptr::null(),
            248..252 => {
                self.has_bad_pointer = true;
                ptr::null()
            }
            // A byte is nowhere misaligned.
            _ if align_of::<N>() == 1 => start,
            _ => {
                self.has_bad_pointer = true;
                start.wrapping_byte_add(1)
            }
        }
    }

    /// Returns the address of one entry that may be left out: NULL, or as [`array`](Self::array).
    pub(super) fn optional<T>(&mut self, entry: &[T; 1]) -> *const T {
        match self.byte() {
            0..200 => ptr::null(),
            200..248 => entry.as_ptr(),
            _ => {
                self.has_bad_pointer = true;
                entry.as_ptr().wrapping_byte_add(1)
            }
        }
    }

    /// Returns where an answer goes, sometimes an address that must be refused.
    pub(super) fn place<T>(&mut self, place: *mut T) -> *mut T {
        match self.byte() {
            0..250 => place,
            tag if tag % 2 == 0 || align_of::<T>() == 1 => {
                self.has_bad_pointer = true;
                ptr::null_mut()
            }
            _ => {
                self.has_bad_pointer = true;
                place.wrapping_byte_add(1)
            }
        }
    }

    /// Returns one of the handles, sometimes NULL or one that was never given out.
    pub(super) fn handle<H>(&mut self, handles: &[*mut H]) -> *mut H {
        match self.byte() {
            tag @ 0..248 => handles[usize::from(tag) % handles.len()],
            tag => ptr::without_provenance_mut(usize::MAX * usize::from(tag % 2)),
        }
    }

    /// Forgets wrong pointers in rows that the next call may not read.
    pub(super) const fn accept_any_pointer(&mut self) {
        self.has_bad_pointer = false;
    }

    /// Makes a call, and checks what each promises. A call that fails says so in one readable line, and writes no answer. A
    /// call that succeeds leaves the last error as it was. Returns the answers of a call that succeeded.
    pub(super) fn call<T: Copy + PartialEq + Debug>(
        &mut self,
        answers: T,
        call: impl FnOnce(*mut T, &mut Self) -> Status,
    ) -> Option<T> {
        let before = known_error();
        let mut after = answers;
        let status = call(&raw mut after, self);
        let error = last_error();
        // SAFETY: the text ends with a zero and is valid forever.
        let name = unsafe { CStr::from_ptr(selvedge_status_string(status as i32)) };
        assert_ne!(name, c"unknown status");
        let has_bad_pointer = std::mem::take(&mut self.has_bad_pointer);
        if status == Status::Ok {
            assert_eq!(error, before, "a call that succeeds is no error");
            assert!(!has_bad_pointer, "a wrong pointer was accepted");
            return Some(after);
        }
        assert_ne!(status, Status::Internal, "{error}");
        message::check(&error);
        assert!(
            error != before || status == Status::NoSuchDetector,
            "{status:?} without a message of its own"
        );
        assert_eq!(after, answers, "{status:?} wrote an answer");
        None
    }
}

/// Fails on purpose, and returns the message.
fn known_error() -> String {
    let nothing = ptr::without_provenance_mut::<Handle>(usize::MAX - 1);
    assert_eq!(selvedge_detector_free(nothing), Status::NoSuchDetector);
    last_error()
}

fn last_error() -> String {
    // SAFETY: the text ends with a zero and belongs to this thread, which calls nothing meanwhile.
    let text = unsafe { CStr::from_ptr(selvedge_last_error()) };
    text.to_str().expect("messages are UTF-8").to_owned()
}
