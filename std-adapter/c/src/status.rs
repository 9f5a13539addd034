//! What becomes of a call.

use selvedge::{StepError, ThreadError, TopologyError, WorldError};
use std::cell::Cell;
use std::ffi::{CStr, c_char};
use std::fmt::Display;

/// What became of a call.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// All is well.
    Ok = 0,
    /// A pointer is NULL that must not be.
    NullPointer = 1,
    /// A pointer is not aligned as its type has to be.
    MisalignedPointer = 2,
    /// A count is larger than memory, or than what may be asked for.
    BadCount = 3,
    /// A number is none of its enumeration's.
    UnknownConstant = 4,
    /// There is no such detector: it was freed, or never made.
    NoSuchDetector = 5,
    /// Another thread is using the detector, world or simulation.
    Busy = 6,
    /// The detector or world is for positions in the other format.
    WrongScalar = 7,
    /// The mesh has no triangles.
    NoTriangles = 8,
    /// A triangle, or a pair of vertices, names a vertex that the mesh does not have.
    VertexOutOfRange = 9,
    /// The mesh has more vertices or triangles than can be numbered.
    TooLarge = 10,
    /// A list does not have an entry for each vertex.
    WrongLength = 11,
    /// A coordinate is NaN or infinite.
    NotFinite = 12,
    /// A separation, a tolerance or a distance is negative, NaN or infinite.
    BadLimit = 13,
    /// A pair names a vertex, a face or an edge that the mesh does not have.
    NoSuchPair = 14,
    /// The operating system refuses threads, or there are more of them than any machine has use for.
    NoThreads = 15,
    /// The operating system refuses memory.
    NoMemory = 16,
    /// The process was forked after the detector, world or simulation has started threads; they are not in the child.
    Forked = 17,
    /// The detector or world is cancelled.
    Cancelled = 18,
    /// More pairs are near each other than may be looked at.
    TooManyPairs = 19,
    /// A contact's time is not in [0, 1].
    BadTime = 20,
    /// A fault of the library's own. The detector, world or simulation can only be freed from now on.
    Internal = 21,
    /// There is no such world: it was freed, or never made.
    NoSuchWorld = 22,
    /// The world has no such mesh: it was removed, or is of another world.
    NoSuchMesh = 23,
    /// Two motions are given for one mesh.
    MovedTwice = 24,
    /// A pose is none: a number is not finite, the quaternion is zero, or the mesh would be out of the range of numbers.
    BadPose = 25,
    /// There is no such simulation: it was freed, or never made.
    NoSuchSimulation = 26,
    /// A scene cannot be read or used: the words name its file, line and column where one is at fault.
    BadScene = 27,
    /// A step found no motion without an intersection, in a scene that stops then. What is done of the step stays.
    Blocked = 28,
    /// The scene has no such cloth, body, group of pins, or wind.
    NoSuchPart = 29,
    /// A body or a group of pins has a motion of its own: its scene does not say that it is driven.
    NotDriven = 30,
    /// A position or a velocity is not finite, or beyond its range.
    BadValue = 31,
    /// Bytes are no checkpoint, are damaged, or are one of another scene.
    BadCheckpoint = 32,
    /// There is no checkpoint after this step: one is every SELVEDGE_CHECKPOINT_STEPS steps.
    NoCheckpoint = 33,
    /// A text is not UTF-8, or has a zero before its end.
    BadText = 34,
    /// A scene starts with surfaces that pass through each other: the words say where first, and what the scene may say of it.
    Tangled = 35,
}

impl Status {
    const ALL: [Self; 36] = [
        Self::Ok,
        Self::NullPointer,
        Self::MisalignedPointer,
        Self::BadCount,
        Self::UnknownConstant,
        Self::NoSuchDetector,
        Self::Busy,
        Self::WrongScalar,
        Self::NoTriangles,
        Self::VertexOutOfRange,
        Self::TooLarge,
        Self::WrongLength,
        Self::NotFinite,
        Self::BadLimit,
        Self::NoSuchPair,
        Self::NoThreads,
        Self::NoMemory,
        Self::Forked,
        Self::Cancelled,
        Self::TooManyPairs,
        Self::BadTime,
        Self::Internal,
        Self::NoSuchWorld,
        Self::NoSuchMesh,
        Self::MovedTwice,
        Self::BadPose,
        Self::NoSuchSimulation,
        Self::BadScene,
        Self::Blocked,
        Self::NoSuchPart,
        Self::NotDriven,
        Self::BadValue,
        Self::BadCheckpoint,
        Self::NoCheckpoint,
        Self::BadText,
        Self::Tangled,
    ];

    const fn text(self) -> &'static CStr {
        match self {
            Self::Ok => c"ok",
            Self::NullPointer => c"null pointer",
            Self::MisalignedPointer => c"misaligned pointer",
            Self::BadCount => c"count too large",
            Self::UnknownConstant => c"unknown constant",
            Self::NoSuchDetector => c"no such detector",
            Self::Busy => c"in use by another thread",
            Self::WrongScalar => c"for the other format",
            Self::NoTriangles => c"no triangles",
            Self::VertexOutOfRange => c"vertex out of range",
            Self::TooLarge => c"mesh too large",
            Self::WrongLength => c"wrong length",
            Self::NotFinite => c"coordinate not finite",
            Self::BadLimit => c"bad separation, tolerance or distance",
            Self::NoSuchPair => c"no such pair",
            Self::NoThreads => c"threads refused",
            Self::NoMemory => c"memory refused",
            Self::Forked => c"of a parent process",
            Self::Cancelled => c"cancelled",
            Self::TooManyPairs => c"too many pairs",
            Self::BadTime => c"time not in [0, 1]",
            Self::Internal => c"internal error",
            Self::NoSuchWorld => c"no such world",
            Self::NoSuchMesh => c"no such mesh",
            Self::MovedTwice => c"moved twice",
            Self::BadPose => c"bad pose",
            Self::NoSuchSimulation => c"no such simulation",
            Self::BadScene => c"bad scene",
            Self::Blocked => c"blocked",
            Self::NoSuchPart => c"not in the scene",
            Self::NotDriven => c"not driven",
            Self::BadValue => c"not finite, or beyond its range",
            Self::BadCheckpoint => c"bad checkpoint",
            Self::NoCheckpoint => c"no checkpoint after this step",
            Self::BadText => c"not UTF-8",
            Self::Tangled => c"tangled at the start",
        }
    }
}

/// A call that failed, in a code and in words.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) status: Status,
    pub(crate) text: String,
}

impl Failure {
    pub(crate) fn new(status: Status, text: impl Display) -> Self {
        let text = text.to_string();
        Self { status, text }
    }
}

impl From<TopologyError> for Failure {
    fn from(error: TopologyError) -> Self {
        let status = match error {
            TopologyError::VertexOutOfRange { .. } | TopologyError::LooseVertexOutOfRange { .. } => Status::VertexOutOfRange,
            TopologyError::NoTriangles => Status::NoTriangles,
            TopologyError::TooLarge { .. } => Status::TooLarge,
        };
        Self::new(status, error)
    }
}

impl From<StepError> for Failure {
    fn from(error: StepError) -> Self {
        let status = match error {
            StepError::WrongLength { .. } | StepError::WrongCount { .. } => Status::WrongLength,
            StepError::NotFinite { .. } => Status::NotFinite,
            StepError::BadLimit { .. } => Status::BadLimit,
            StepError::NoSuchVertex { .. } => Status::VertexOutOfRange,
            StepError::NoSuchPair { .. } => Status::NoSuchPair,
            StepError::BadTime { .. } => Status::BadTime,
            StepError::Cancelled => Status::Cancelled,
            StepError::TooManyPairs { .. } => Status::TooManyPairs,
            // One that this crate does not know yet.
            _ => Status::Internal,
        };
        Self::new(status, error)
    }
}

impl From<WorldError> for Failure {
    fn from(error: WorldError) -> Self {
        let status = match error {
            WorldError::NoSuchMesh { .. } => Status::NoSuchMesh,
            WorldError::MovedTwice { .. } => Status::MovedTwice,
            WorldError::BadPositions { error, .. } | WorldError::Step(error) => Self::from(error).status,
            WorldError::BadPose { .. } => Status::BadPose,
            WorldError::TooLarge { .. } => Status::TooLarge,
            // One that this crate does not know yet.
            _ => Status::Internal,
        };
        Self::new(status, error)
    }
}

impl From<ThreadError> for Failure {
    fn from(error: ThreadError) -> Self {
        Self::new(Status::NoThreads, error)
    }
}

/// Bytes of a last error, the final zero included. Three coordinates take the most, some 300 digits each.
const ROOM: usize = 1280;

thread_local! {
    // Without memory of its own: nothing is to be freed, and it can be read for as long as the thread lives.
    static LAST: Cell<[u8; ROOM]> = const { Cell::new([0; ROOM]) };
}

/// Keeps the words for the thread that calls.
pub(crate) fn remember(failure: &Failure) -> Status {
    let mut end = failure.text.len().min(ROOM - 1);
    while !failure.text.is_char_boundary(end) {
        end -= 1;
    }
    let mut room = [0; ROOM];
    for (byte, &of_text) in room.iter_mut().zip(&failure.text.as_bytes()[..end]) {
        // A zero would end it.
        *byte = if of_text == 0 { b' ' } else { of_text };
    }
    LAST.set(room);
    failure.status
}

/// What the last call that failed on this thread has to say, in words; empty if none has. Never NULL.
///
/// Valid until the next call that fails on this thread, or the thread's end. A call that succeeds leaves it.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_last_error() -> *const c_char {
    LAST.with(|last| last.as_ptr().cast::<c_char>().cast_const())
}

/// A selvedge_status in a few words, for any number. Never NULL; valid for ever.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_status_string(status: i32) -> *const c_char {
    let known = Status::ALL.into_iter().find(|&known| known as i32 == status);
    known.map_or(c"unknown status", Status::text).as_ptr()
}
