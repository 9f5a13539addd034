//! Detectors, of either format.

use crate::answers::Answers;
use crate::guard::guarded;
use crate::handles::{self, Handled, Living};
use crate::input::{Out, Plain, unknown, view};
use crate::status::{Failure, Status};
use selvedge::{Cancellation, CollisionDetector, Contact, Scalar, Topology, TopologyError};

/// A mesh, and what is kept of it from step to step. Only pointers to it exist; they are numbers, and nothing is behind them.
///
/// One thread at a time: a call on a detector that another thread is using fails with SELVEDGE_STATUS_BUSY and changes nothing.
/// Detectors do not know of each other: each may be used by a thread of its own.
pub struct Handle {
    _nothing: [u8; 0],
}

/// The format of a detector's positions.
#[repr(u32)]
#[derive(Clone, Copy)]
pub enum ScalarFormat {
    /// float: functions whose names end in _f32.
    F32 = 0,
    /// double: functions whose names end in _f64.
    F64 = 1,
}

/// A detector for one format of positions, and where its contacts go first.
pub(crate) struct Finder<S: Scalar> {
    pub(crate) detector: CollisionDetector<S>,
    pub(crate) contacts: Vec<Contact<S>>,
}

impl<S: Scalar> Finder<S> {
    fn new(topology: Topology) -> Self {
        Self {
            detector: CollisionDetector::new(topology),
            contacts: Vec::new(),
        }
    }
}

pub(crate) enum AnyFinder {
    F32(Finder<f32>),
    F64(Finder<f64>),
}

/// Does the same with a detector of either format.
macro_rules! with_either {
    ($any:expr, $finder:ident => $action:expr) => {
        match $any {
            $crate::detector::AnyFinder::F32($finder) => $action,
            $crate::detector::AnyFinder::F64($finder) => $action,
        }
    };
}
pub(crate) use with_either;

/// A format of positions that there are detectors for.
pub(crate) trait Format: Scalar + Plain {
    fn of(any: &mut AnyFinder) -> Option<&mut Finder<Self>>;
}

impl Format for f32 {
    fn of(any: &mut AnyFinder) -> Option<&mut Finder<Self>> {
        match any {
            AnyFinder::F32(finder) => Some(finder),
            AnyFinder::F64(_) => None,
        }
    }
}

impl Format for f64 {
    fn of(any: &mut AnyFinder) -> Option<&mut Finder<Self>> {
        match any {
            AnyFinder::F32(_) => None,
            AnyFinder::F64(finder) => Some(finder),
        }
    }
}

/// What a call works on.
pub(crate) struct Detector {
    pub(crate) finder: AnyFinder,
    pub(crate) answers: Answers,
}

impl Detector {
    pub(crate) fn topology(&self) -> &Topology {
        with_either!(&self.finder, finder => finder.detector.topology())
    }
}

impl Handled for Detector {
    type Handle = Handle;
    const NAME: &'static str = "detector";
    const NO_SUCH: Status = Status::NoSuchDetector;

    fn living() -> &'static Living<Self> {
        static LIVING: Living<Detector> = Living::new();
        &LIVING
    }

    fn cancellation(&self) -> Cancellation {
        with_either!(&self.finder, finder => finder.detector.cancellation())
    }
}

/// Does something with a detector.
pub(crate) fn on(handle: *const Handle, action: impl FnOnce(&mut Detector) -> Result<(), Failure>) -> Status {
    handles::on(handle, |_, detector| action(detector))
}

/// A detector for a mesh. `scalar` is a selvedge_scalar: the format that its positions will have. On the calling thread at first,
/// all vertices moving, steps not coherent, contacts within the default tolerance.
///
/// Edges and points that belong to no triangle, of ropes, hair and particles, are triangles that name a vertex twice, (a, b, b), or
/// three times, (p, p, p): they collide as what they are. A vertex that nothing names touches nothing.
///
/// The triangles are copied. `*detector` becomes the handle; selvedge_detector_free gives back what it takes.
///
/// # Safety
/// `triangles` points to 3 * `triangle_count` vertex numbers, `detector` to a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_new(
    scalar: u32,
    vertex_count: usize,
    triangles: *const u32,
    triangle_count: usize,
    detector: *mut *mut Handle,
) -> Status {
    guarded(|| {
        // SAFETY: the caller's promise.
        let out = unsafe { Out::new("where the detector goes", detector) }?;
        // SAFETY: the caller's promise.
        let topology = unsafe { topology(vertex_count, triangles, triangle_count) }?;
        let finder = match scalar {
            number if number == ScalarFormat::F32 as u32 => AnyFinder::F32(Finder::new(topology)),
            number if number == ScalarFormat::F64 as u32 => AnyFinder::F64(Finder::new(topology)),
            number => return Err(unknown("selvedge_scalar", number)),
        };
        out.set(handles::keep(Detector {
            finder,
            answers: Answers::default(),
        })?);
        Ok(())
    })
}

/// # Safety
/// Unless `triangles` is null or misaligned, it points to three numbers for each of so many.
pub(crate) unsafe fn topology(vertex_count: usize, triangles: *const u32, triangle_count: usize) -> Result<Topology, Failure> {
    if triangle_count > Topology::MAX_TRIANGLES {
        // Before one of them is looked at.
        let error = TopologyError::TooLarge {
            vertex_count,
            triangle_count,
        };
        return Err(error.into());
    }
    // SAFETY: the caller's promise.
    let given = unsafe { view::<_, 3>("triangles", triangles, triangle_count) }?;
    let mut triangles = Vec::new();
    // Refused memory is an error here, where a wrong count is the likeliest reason.
    triangles.try_reserve_exact(given.len()).map_err(|_| {
        let text = format!("the operating system refuses memory for {} triangles", given.len());
        Failure::new(Status::NoMemory, text)
    })?;
    triangles.extend_from_slice(given);
    Ok(Topology::new(vertex_count, triangles)?)
}

/// Cuts the question short that another thread is asking, and each one from now on: it fails with SELVEDGE_STATUS_CANCELLED,
/// unless it is as good as answered. `cancelled` is not 0; 0 takes it back. Afterwards the detector answers as if nothing had
/// been.
///
/// For any thread at any time: the only function that a detector in use does not refuse, but for selvedge_detector_free.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_cancelled(detector: *mut Handle, cancelled: i32) -> Status {
    handles::set_cancelled::<Detector>(detector, cancelled)
}

/// Frees a detector and tells its threads to end; all that it has shown is gone with it. NULL is well. One that another thread is
/// using goes when that call has ended.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_free(detector: *mut Handle) -> Status {
    handles::free::<Detector>(detector)
}
