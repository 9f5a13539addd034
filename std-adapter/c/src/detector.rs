//! Detectors for either format.

use crate::answers::DetectorAnswers;
use crate::guard::guarded;
use crate::handles::{self, Handled, Living};
use crate::input::{Out, Plain, unknown, view};
use crate::status::{Failure, Status};
use selvedge::{Cancellation, CollisionDetector, Contact, Scalar, Topology, TopologyError};

/// A detector for one mesh. Its pointer is a handle: a number that is looked up and never followed.
///
/// One thread at a time may use a detector. A call on a detector in use fails with SELVEDGE_STATUS_BUSY and changes nothing.
/// Different detectors are independent, and each may have a thread of its own.
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

/// A detector for one format of positions, with a buffer for its contacts.
pub(crate) struct DetectorFinder<S: Scalar> {
    pub(crate) detector: CollisionDetector<S>,
    pub(crate) contacts: Vec<Contact<S>>,
}

impl<S: Scalar> DetectorFinder<S> {
    fn new(topology: Topology) -> Self {
        Self {
            detector: CollisionDetector::new(topology),
            contacts: Vec::new(),
        }
    }
}

/// An object of C that has a finder for one format of positions.
pub(crate) trait OfFormat {
    type Finder<S: Format>;
}

pub(crate) enum AnyFinder<T: OfFormat> {
    F32(T::Finder<f32>),
    F64(T::Finder<f64>),
}

/// Evaluates one expression with a finder of either format.
macro_rules! with_either {
    ($any:expr, $finder:ident => $action:expr) => {
        match $any {
            $crate::detector::AnyFinder::F32($finder) => $action,
            $crate::detector::AnyFinder::F64($finder) => $action,
        }
    };
}
pub(crate) use with_either;

pub(crate) trait Format: Scalar + Plain {
    fn of<T: OfFormat>(any: &mut AnyFinder<T>) -> Option<&mut T::Finder<Self>>;
}

impl Format for f32 {
    fn of<T: OfFormat>(any: &mut AnyFinder<T>) -> Option<&mut T::Finder<Self>> {
        match any {
            AnyFinder::F32(finder) => Some(finder),
            AnyFinder::F64(_) => None,
        }
    }
}

impl Format for f64 {
    fn of<T: OfFormat>(any: &mut AnyFinder<T>) -> Option<&mut T::Finder<Self>> {
        match any {
            AnyFinder::F32(_) => None,
            AnyFinder::F64(finder) => Some(finder),
        }
    }
}

pub(crate) struct Detector {
    pub(crate) finder: AnyFinder<Self>,
    pub(crate) answers: DetectorAnswers,
}

impl OfFormat for Detector {
    type Finder<S: Format> = DetectorFinder<S>;
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

pub(crate) fn on(handle: *const Handle, action: impl FnOnce(&mut Detector) -> Result<(), Failure>) -> Status {
    handles::on(handle, |_, detector| action(detector))
}

/// Creates a detector for a mesh. `scalar` is a selvedge_scalar, the format of its positions. By default it uses the calling
/// thread, all vertices move, steps are not coherent, and contacts are pairs within the default tolerance.
///
/// A triangle that names a vertex twice, (a, b, b), is a loose edge, and one that names it three times, (p, p, p), a point: parts
/// of ropes, hair and particles. They collide as edges and points. A vertex that no triangle names collides with nothing.
///
/// The triangles are copied. `*detector` receives the handle; free it with selvedge_detector_free.
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
            number if number == ScalarFormat::F32 as u32 => AnyFinder::F32(DetectorFinder::new(topology)),
            number if number == ScalarFormat::F64 as u32 => AnyFinder::F64(DetectorFinder::new(topology)),
            number => return Err(unknown("selvedge_scalar", number)),
        };
        out.set(handles::keep(Detector {
            finder,
            answers: DetectorAnswers::default(),
        })?);
        Ok(())
    })
}

/// # Safety
/// Unless `triangles` is null or misaligned, it points to three numbers for each of so many.
pub(crate) unsafe fn topology(vertex_count: usize, triangles: *const u32, triangle_count: usize) -> Result<Topology, Failure> {
    if triangle_count > Topology::MAX_TRIANGLES {
        // The counts are checked before any number is read.
        let error = TopologyError::TooLarge {
            vertex_count,
            triangle_count,
        };
        return Err(error.into());
    }
    // SAFETY: the caller's promise.
    let given = unsafe { view::<_, 3>("triangles", triangles, triangle_count) }?;
    let mut triangles = Vec::new();
    // A wrong count is the likeliest reason why the system refuses memory, so this is an error and no abort.
    triangles.try_reserve_exact(given.len()).map_err(|_| {
        let text = format!("the operating system refuses memory for {} triangles", given.len());
        Failure::new(Status::NoMemory, text)
    })?;
    triangles.extend_from_slice(given);
    Ok(Topology::new(vertex_count, triangles)?)
}

/// Cancels the call that another thread is making, and all later calls, if `cancelled` is not 0. They fail with
/// SELVEDGE_STATUS_CANCELLED unless they are nearly done. 0 ends this; the detector then works as usual.
///
/// Any thread may call this at any time. Besides selvedge_detector_free it is the only function that a detector in use accepts.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_cancelled(detector: *mut Handle, cancelled: i32) -> Status {
    handles::set_cancelled::<Detector>(detector, cancelled)
}

/// Frees a detector, its lists and its threads. NULL is allowed. A detector that another thread is using is freed when that call
/// has ended.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_free(detector: *mut Handle) -> Status {
    handles::free::<Detector>(detector)
}
