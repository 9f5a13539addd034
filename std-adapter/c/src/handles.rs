//! What lives, and is named by handles: detectors, worlds and simulations.
//!
//! To C a handle is a pointer; here it is a number that was given once and never again, looked up at each call. So a handle that
//! was freed, or never made, is told from one that lives, whatever memory holds, and no handle is ever followed.
//!
//! What it stands for is behind a lock that only one call may have: a second thread is refused, not kept waiting. A panic poisons it,
//! as it does all of Rust's, and that is the mark of something broken.

use crate::guard::guarded;
use crate::status::{Failure, Status};
use selvedge::Cancellation;
use std::collections::BTreeMap;
use std::ptr;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock, TryLockError};

/// What a handle can stand for.
pub(crate) trait Handled: Send + Sized + 'static {
    /// What its pointers point to, as C sees it.
    type Handle;
    /// In words.
    const NAME: &'static str;
    /// That there is none.
    const NO_SUCH: Status;

    fn living() -> &'static Living<Self>;

    /// What cuts its questions short; of what has none, one that nobody is given.
    fn cancellation(&self) -> Cancellation {
        Cancellation::default()
    }

    /// Whether it has threads of its own when it is made.
    fn has_threads(&self) -> bool {
        false
    }
}

/// All of a type, by the numbers of their handles.
pub(crate) struct Living<T>(RwLock<BTreeMap<usize, Arc<Kept<T>>>>);

impl<T> Living<T> {
    pub(crate) const fn new() -> Self {
        Self(RwLock::new(BTreeMap::new()))
    }
}

/// One of them, and what is known of it while a call has it.
pub(crate) struct Kept<T> {
    item: Mutex<T>,
    /// The process whose threads it has, if it has any of its own.
    threads_of: Mutex<Option<u32>>,
    cancellation: Cancellation,
}

impl<T> Kept<T> {
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

/// Of all types. Zero is NULL.
static NEXT: AtomicUsize = AtomicUsize::new(1);

/// From now on it lives. Returns its handle.
pub(crate) fn keep<T: Handled>(item: T) -> Result<*mut T::Handle, Failure> {
    let one_more = |number: usize| number.checked_add(1);
    let number = NEXT.fetch_update(Ordering::Relaxed, Ordering::Relaxed, one_more);
    let number = number.map_err(|_| Failure::new(Status::BadCount, "there are no more handles"))?;
    let has_threads = item.has_threads();
    let kept = Kept {
        cancellation: item.cancellation(),
        threads_of: Mutex::new(None),
        item: Mutex::new(item),
    };
    kept.set_has_threads(has_threads);
    // A panic cannot leave the map half changed.
    let mut living = T::living().0.write().unwrap_or_else(PoisonError::into_inner);
    living.insert(number, Arc::new(kept));
    Ok(ptr::without_provenance_mut(number))
}

fn no_such<T: Handled>(handle: *const T::Handle) -> Failure {
    let name = T::NAME;
    if handle.is_null() {
        Failure::new(Status::NullPointer, format!("the {name} is NULL"))
    } else {
        let text = format!("the {name} was freed before, or its handle did not come from selvedge_{name}_new");
        Failure::new(T::NO_SUCH, text)
    }
}

fn find<T: Handled>(handle: *const T::Handle) -> Result<Arc<Kept<T>>, Failure> {
    let living = T::living().0.read().unwrap_or_else(PoisonError::into_inner);
    living.get(&handle.addr()).cloned().ok_or_else(|| no_such::<T>(handle))
}

/// Does something with what a handle stands for, and with what is kept beside it.
pub(crate) fn on<T: Handled>(handle: *const T::Handle, action: impl FnOnce(&Kept<T>, &mut T) -> Result<(), Failure>) -> Status {
    guarded(|| {
        let kept = find::<T>(handle)?;
        let name = T::NAME;
        if kept.is_forked() {
            let text = format!("the {name}'s threads are in the process that was forked: make one in the child");
            return Err(Failure::new(Status::Forked, text));
        }
        let mut item = kept.item.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => Failure::new(Status::Busy, format!("another thread is using the {name}")),
            TryLockError::Poisoned(_) => {
                let text = format!("a call on this {name} failed by a fault of Selvedge's: it can only be freed");
                Failure::new(Status::Internal, text)
            }
        })?;
        action(&kept, &mut item)
    })
}

/// Cuts its questions short, or no more.
pub(crate) fn set_cancelled<T: Handled>(handle: *const T::Handle, cancelled: i32) -> Status {
    guarded(|| {
        let cancellation = &find::<T>(handle)?.cancellation;
        if cancelled == 0 {
            cancellation.reset();
        } else {
            cancellation.cancel();
        }
        Ok(())
    })
}

/// From now on it lives no more, nor does its handle; NULL is well.
pub(crate) fn free<T: Handled>(handle: *const T::Handle) -> Status {
    guarded(|| {
        if handle.is_null() {
            return Ok(());
        }
        let mut living = T::living().0.write().unwrap_or_else(PoisonError::into_inner);
        let freed = living.remove(&handle.addr());
        drop(living);
        let kept = freed.ok_or_else(|| no_such::<T>(handle))?;
        if kept.is_forked() {
            // The end would be told to threads that are not there. Its memory is the parent's.
            std::mem::forget(kept);
        }
        Ok(())
    })
}
