//! The results of calls, and the last error of each thread.

use selvedge::{StepError, ThreadError, TopologyError, WorldError};
use std::cell::Cell;
use std::ffi::{CStr, c_char};
use std::fmt::Display;

/// The result of a call.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The call succeeded.
    Ok = 0,
    /// A pointer is NULL where NULL is not allowed.
    NullPointer = 1,
    /// A pointer does not have the alignment of its type.
    MisalignedPointer = 2,
    /// A count exceeds memory or the largest allowed value.
    BadCount = 3,
    /// A number is not a value of its enumeration.
    UnknownConstant = 4,
    /// The detector was freed or never created.
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
    /// A list does not have one entry for each vertex.
    WrongLength = 11,
    /// A coordinate is NaN or infinite.
    NotFinite = 12,
    /// A separation, a tolerance or a distance is negative, NaN or infinite.
    BadLimit = 13,
    /// A pair names a vertex, a face or an edge that the mesh does not have.
    NoSuchPair = 14,
    /// The threads could not be started, or their number is too large.
    NoThreads = 15,
    /// The operating system refused memory.
    NoMemory = 16,
    /// The process was forked after the detector, world or simulation had started threads. The child does not have them.
    Forked = 17,
    /// The call was cancelled.
    Cancelled = 18,
    /// There are more candidate pairs than the limit allows.
    TooManyPairs = 19,
    /// A contact's time is not in [0, 1].
    BadTime = 20,
    /// The library has a bug. The detector, world or simulation can only be freed from now on.
    Internal = 21,
    /// The world was freed or never created.
    NoSuchWorld = 22,
    /// The world has no such mesh: it was removed, or it belongs to another world.
    NoSuchMesh = 23,
    /// A mesh has two motions in one step.
    MovedTwice = 24,
    /// A pose is invalid: a number is not finite, the quaternion is zero, or the mesh would leave the range of the format.
    BadPose = 25,
    /// The simulation was freed or never created.
    NoSuchSimulation = 26,
    /// A scene is invalid. The message names file, line and column where there is one.
    BadScene = 27,
    /// A step found no motion without an intersection, in a scene that stops then. The part of the step that was done remains.
    Blocked = 28,
    /// The scene has no such cloth, body, group of pins or wind.
    NoSuchPart = 29,
    /// A body or a group of pins cannot be moved: its scene does not say that it is driven, or a proxy.
    NotDriven = 30,
    /// A position or a velocity is not finite or out of its range.
    BadValue = 31,
    /// The bytes are not a checkpoint, are damaged, or belong to another scene or version.
    BadCheckpoint = 32,
    /// There is no checkpoint after this step. One exists every SELVEDGE_CHECKPOINT_STEPS steps.
    NoCheckpoint = 33,
    /// A text is not valid UTF-8.
    BadText = 34,
    /// A scene starts with surfaces that pass through each other. The message names the first place and the possible settings.
    Tangled = 35,
    /// The pairs and contacts of a call take more memory than the limit allows.
    TooMuchMemory = 36,
    /// The file was freed or never read.
    NoSuchFile = 37,
    /// A file cannot be read as a mesh. The message names the place.
    BadFile = 38,
}

impl Status {
    /// A short text for each.
    const TEXTS: [(Self, &CStr); 39] = [
        (Self::Ok, c"ok"),
        (Self::NullPointer, c"null pointer"),
        (Self::MisalignedPointer, c"misaligned pointer"),
        (Self::BadCount, c"count too large"),
        (Self::UnknownConstant, c"unknown constant"),
        (Self::NoSuchDetector, c"no such detector"),
        (Self::Busy, c"in use by another thread"),
        (Self::WrongScalar, c"for the other format"),
        (Self::NoTriangles, c"no triangles"),
        (Self::VertexOutOfRange, c"vertex out of range"),
        (Self::TooLarge, c"mesh too large"),
        (Self::WrongLength, c"wrong length"),
        (Self::NotFinite, c"coordinate not finite"),
        (Self::BadLimit, c"bad separation, tolerance or distance"),
        (Self::NoSuchPair, c"no such pair"),
        (Self::NoThreads, c"threads refused"),
        (Self::NoMemory, c"memory refused"),
        (Self::Forked, c"of a parent process"),
        (Self::Cancelled, c"cancelled"),
        (Self::TooManyPairs, c"too many pairs"),
        (Self::BadTime, c"time not in [0, 1]"),
        (Self::Internal, c"internal error"),
        (Self::NoSuchWorld, c"no such world"),
        (Self::NoSuchMesh, c"no such mesh"),
        (Self::MovedTwice, c"moved twice"),
        (Self::BadPose, c"bad pose"),
        (Self::NoSuchSimulation, c"no such simulation"),
        (Self::BadScene, c"bad scene"),
        (Self::Blocked, c"blocked"),
        (Self::NoSuchPart, c"not in the scene"),
        (Self::NotDriven, c"not driven"),
        (Self::BadValue, c"not finite, or beyond its range"),
        (Self::BadCheckpoint, c"bad checkpoint"),
        (Self::NoCheckpoint, c"no checkpoint after this step"),
        (Self::BadText, c"not UTF-8"),
        (Self::Tangled, c"tangled at the start"),
        (Self::TooMuchMemory, c"too much memory"),
        (Self::NoSuchFile, c"no such file"),
        (Self::BadFile, c"bad mesh file"),
    ];
}

/// The status and the message of a failed call.
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
            StepError::TooMuchMemory { .. } => Status::TooMuchMemory,
            // This crate does not know the error yet.
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
            // This crate does not know the error yet.
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

/// The size of a message in bytes, with the final zero. Three coordinates need the most, about 300 digits each.
const ROOM: usize = 1280;

thread_local! {
    // It owns no memory, so it needs no destructor and can be read until the thread ends.
    static LAST: Cell<[u8; ROOM]> = const { Cell::new([0; ROOM]) };
}

/// Stores the message for the calling thread.
pub(crate) fn remember(failure: &Failure) -> Status {
    // A path or a name of the caller's may have control characters: a zero would end the text, and others change a terminal.
    let shown = |letter: char| if letter.is_control() { ' ' } else { letter };
    let text: String = failure.text.chars().map(shown).collect();
    let mut end = text.len().min(ROOM - 1);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let mut room = [0; ROOM];
    room[..end].copy_from_slice(&text.as_bytes()[..end]);
    LAST.set(room);
    failure.status
}

/// Returns the message of the last failed call on this thread, or an empty text. It is never NULL.
///
/// The text is valid until the next failed call on this thread, or until the thread ends. Successful calls do not change it.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_last_error() -> *const c_char {
    LAST.with(|last| last.as_ptr().cast::<c_char>().cast_const())
}

/// Returns a short text for a selvedge_status, or for any other number. It is never NULL, and valid forever.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_status_string(status: i32) -> *const c_char {
    let known = Status::TEXTS.into_iter().find(|(known, _)| *known as i32 == status);
    known.map_or(c"unknown status", |(_, text)| text).as_ptr()
}
