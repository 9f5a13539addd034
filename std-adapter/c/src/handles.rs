//! The registry of detectors, worlds and simulations.
//!
//! C sees a handle as a pointer. Here it is a number that is given out once, looked up at each call and never followed. A freed
//! or invented handle is therefore recognised, whatever memory contains.
//!
//! Each item has a lock. A second thread is refused and does not wait. A panic poisons the lock, which marks the item as broken.

use crate::guard::guarded;
use crate::status::{Failure, Status};
use selvedge::Cancellation;
use std::collections::BTreeMap;
use std::ptr;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock, TryLockError};

/// A type of item with handles.
pub(crate) trait Handled: Send + Sized + 'static {
    /// The type behind the pointer in C.
    type Handle;
    /// The name of the type in messages.
    const NAME: &'static str;
    const NO_SUCH: Status;

    fn living() -> &'static Living<Self>;

    /// Returns the switch that cancels its calls. Items without one return a switch that is never used.
    fn cancellation(&self) -> Cancellation {
        Cancellation::default()
    }

    /// Returns whether the new item has threads of its own.
    fn has_threads(&self) -> bool {
        false
    }
}

/// All items of a type, by the numbers of their handles.
pub(crate) struct Living<T>(RwLock<BTreeMap<usize, Arc<Kept<T>>>>);

impl<T> Living<T> {
    pub(crate) const fn new() -> Self {
        Self(RwLock::new(BTreeMap::new()))
    }
}

/// An item, and the data that other threads may read while a call uses it.
pub(crate) struct Kept<T> {
    item: Mutex<T>,
    /// The process that started its threads, if it has any.
    threads_of: Mutex<Option<u32>>,
    cancellation: Cancellation,
}

impl<T> Kept<T> {
    fn threads_of(&self) -> MutexGuard<'_, Option<u32>> {
        self.threads_of.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Records whether it has threads, which belong to this process.
    pub(crate) fn set_has_threads(&self, has_threads: bool) {
        *self.threads_of() = has_threads.then(std::process::id);
    }

    /// Returns whether its threads stayed behind in a parent process. Waiting for them would never end.
    fn is_forked(&self) -> bool {
        self.threads_of().is_some_and(|process| process != std::process::id())
    }
}

/// The next handle, for all types. Zero is NULL.
static NEXT: AtomicUsize = AtomicUsize::new(1);

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
        let text = format!("the {name} has been freed, or its handle did not come from selvedge_{name}_new");
        Failure::new(T::NO_SUCH, text)
    }
}

fn find<T: Handled>(handle: *const T::Handle) -> Result<Arc<Kept<T>>, Failure> {
    let living = T::living().0.read().unwrap_or_else(PoisonError::into_inner);
    living.get(&handle.addr()).cloned().ok_or_else(|| no_such::<T>(handle))
}

pub(crate) fn on<T: Handled>(handle: *const T::Handle, action: impl FnOnce(&Kept<T>, &mut T) -> Result<(), Failure>) -> Status {
    guarded(|| {
        let kept = find::<T>(handle)?;
        let name = T::NAME;
        if kept.is_forked() {
            let text = format!("the {name}'s threads are in the parent process: create a new {name} in the child");
            return Err(Failure::new(Status::Forked, text));
        }
        let mut item = kept.item.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => Failure::new(Status::Busy, format!("another thread is using the {name}")),
            TryLockError::Poisoned(_) => {
                let text = format!("a call on this {name} failed because of a bug in Selvedge: it can only be freed");
                Failure::new(Status::Internal, text)
            }
        })?;
        action(&kept, &mut item)
    })
}

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

/// Frees an item and its handle. NULL is allowed.
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
            // Its threads do not exist in this process, so it cannot be dropped. Its memory belongs to the parent.
            std::mem::forget(kept);
        }
        Ok(())
    })
}
