//! The detectors that live.
//!
//! To C a handle is a pointer; here it is a number that was given once and never again, looked up at each call. So a handle that
//! was freed, or never made, is told from one that lives, whatever memory holds, and no handle is ever followed.
//!
//! A detector stands behind a lock that only one call may have: a second thread is refused, not kept waiting. A panic poisons it,
//! as it does all of Rust's, and that is the mark of a broken detector.

use crate::answers::Answers;
use crate::guard::guarded;
use crate::input::{Out, Plain, unknown, view};
use crate::status::{Failure, Status};
use selvedge::{Cancellation, CollisionDetector, Contact, Scalar, Topology, TopologyError};
use std::collections::BTreeMap;
use std::ptr;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock, TryLockError};

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

/// What a handle stands for: a detector, and what is known of it while a call has it.
pub(crate) struct Kept {
    detector: Mutex<Detector>,
    /// The process whose threads it has, if it has any of its own.
    threads_of: Mutex<Option<u32>>,
    cancellation: Cancellation,
}

impl Kept {
    fn threads_of(&self) -> MutexGuard<'_, Option<u32>> {
        self.threads_of.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// It has threads of its own, of this process, or none.
    pub(crate) fn set_has_threads(&self, has_threads: bool) {
        *self.threads_of() = has_threads.then(std::process::id);
    }

    /// Whether its threads stayed behind in a parent process. To wait for them would be for ever.
    fn is_forked(&self) -> bool {
        self.threads_of().is_some_and(|process| process != std::process::id())
    }
}

static LIVING: RwLock<BTreeMap<usize, Arc<Kept>>> = RwLock::new(BTreeMap::new());
/// Zero is NULL.
static NEXT: AtomicUsize = AtomicUsize::new(1);

fn keep(detector: Detector) -> Result<*mut Handle, Failure> {
    let one_more = |number: usize| number.checked_add(1);
    let number = NEXT.fetch_update(Ordering::Relaxed, Ordering::Relaxed, one_more);
    let number = number.map_err(|_| Failure::new(Status::BadCount, "there are no more handles"))?;
    let kept = Kept {
        cancellation: with_either!(&detector.finder, finder => finder.detector.cancellation()),
        detector: Mutex::new(detector),
        threads_of: Mutex::new(None),
    };
    // A panic cannot leave the map half changed.
    let mut living = LIVING.write().unwrap_or_else(PoisonError::into_inner);
    living.insert(number, Arc::new(kept));
    Ok(ptr::without_provenance_mut(number))
}

fn no_such(handle: *const Handle) -> Failure {
    if handle.is_null() {
        Failure::new(Status::NullPointer, "the detector is NULL")
    } else {
        let text = "the detector was freed before, or its handle did not come from selvedge_detector_new";
        Failure::new(Status::NoSuchDetector, text)
    }
}

fn find(handle: *const Handle) -> Result<Arc<Kept>, Failure> {
    let living = LIVING.read().unwrap_or_else(PoisonError::into_inner);
    living.get(&handle.addr()).cloned().ok_or_else(|| no_such(handle))
}

/// Does something with a detector.
pub(crate) fn on(handle: *const Handle, action: impl FnOnce(&mut Detector) -> Result<(), Failure>) -> Status {
    on_kept(handle, |_, detector| action(detector))
}

/// Does something with a detector and what is kept beside it.
pub(crate) fn on_kept(handle: *const Handle, action: impl FnOnce(&Kept, &mut Detector) -> Result<(), Failure>) -> Status {
    guarded(|| {
        let kept = find(handle)?;
        if kept.is_forked() {
            let text = "the detector's threads are in the process that was forked: make one in the child";
            return Err(Failure::new(Status::Forked, text));
        }
        let mut detector = kept.detector.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => Failure::new(Status::Busy, "another thread is using the detector"),
            TryLockError::Poisoned(_) => {
                let text = "a call on this detector failed by a fault of Selvedge's: it can only be freed";
                Failure::new(Status::Internal, text)
            }
        })?;
        action(&kept, &mut detector)
    })
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
        let finder = match scalar {
            number if number == ScalarFormat::F32 as u32 => AnyFinder::F32(Finder::new(topology(vertex_count, given)?)),
            number if number == ScalarFormat::F64 as u32 => AnyFinder::F64(Finder::new(topology(vertex_count, given)?)),
            number => return Err(unknown("selvedge_scalar", number)),
        };
        out.set(keep(Detector {
            finder,
            answers: Answers::default(),
        })?);
        Ok(())
    })
}

fn topology(vertex_count: usize, given: &[[u32; 3]]) -> Result<Topology, Failure> {
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
    guarded(|| {
        let cancellation = &find(detector)?.cancellation;
        if cancelled == 0 {
            cancellation.reset();
        } else {
            cancellation.cancel();
        }
        Ok(())
    })
}

/// Frees a detector and tells its threads to end; all that it has shown is gone with it. NULL is well. One that another thread is
/// using goes when that call has ended.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_free(detector: *mut Handle) -> Status {
    guarded(|| {
        if detector.is_null() {
            return Ok(());
        }
        let mut living = LIVING.write().unwrap_or_else(PoisonError::into_inner);
        let freed = living.remove(&detector.addr());
        drop(living);
        let kept = freed.ok_or_else(|| no_such(detector))?;
        if kept.is_forked() {
            // The end would be told to threads that are not there. Its memory is the parent's.
            std::mem::forget(kept);
        }
        Ok(())
    })
}
