//! The threads of the feature `parallel`, by rayon.

use std::cell::Cell;
use std::fmt;
use std::num::NonZeroUsize;

/// Selects the threads of a detector or world. Results are the same, bit for bit, for all of them.
///
/// ```
/// use selvedge::{CollisionDetector, Threads, Topology};
///
/// let topology = Topology::new(3, vec![[0, 1, 2]])?;
/// let mut detector = CollisionDetector::<f64>::new(topology);
/// detector.set_threads(Threads::EachCore)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Threads {
    /// The calling thread only, even in a rayon pool.
    #[default]
    Calling,
    /// The threads of the rayon pool in which a method is called, or the calling thread outside of one. The global pool counts
    /// only for code that runs on its threads.
    CallersPool,
    /// This number of own threads, at most [`most`](Self::most). One of them is the calling thread.
    Own(NonZeroUsize),
    /// One own thread for each core.
    EachCore,
}

impl Threads {
    /// Takes a number as on command lines: 0 is one thread for each core, 1 the calling thread.
    #[must_use]
    pub const fn from_count(count: usize) -> Self {
        match NonZeroUsize::new(count) {
            None => Self::EachCore,
            Some(NonZeroUsize::MIN) => Self::Calling,
            Some(count) => Self::Own(count),
        }
    }

    /// Returns the largest number of threads that are started: four for each core, and at least 256. More would only take memory,
    /// some megabytes each.
    #[must_use]
    pub fn most() -> usize {
        let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        (4 * cores).max(256)
    }
}

/// The requested threads could not be started: the operating system refuses them, or they are more than [`Threads::most`].
#[derive(Debug)]
#[non_exhaustive]
pub struct ThreadError {
    /// The requested threads.
    pub threads: Threads,
    /// The error of the operating system.
    source: Option<rayon::ThreadPoolBuildError>,
}

impl fmt::Display for ThreadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { threads, source } = self;
        match threads {
            Threads::Own(count) => write!(f, "cannot start {count} threads")?,
            _ => f.write_str("cannot start a thread for each core")?,
        }
        match source {
            Some(source) => write!(f, ": {source}"),
            None => write!(f, ": {} are the most on this machine", Threads::most()),
        }
    }
}

impl std::error::Error for ThreadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        let source = self.source.as_ref()?;
        Some(source)
    }
}

/// Started threads, on which loops can run. The default is the calling thread.
#[derive(Debug, Default)]
pub struct Workers(Kind);

#[derive(Debug, Default)]
enum Kind {
    #[default]
    Calling,
    CallersPool,
    Own(rayon::ThreadPool),
}

impl Workers {
    /// Starts these threads.
    ///
    /// # Errors
    /// Returns an error if the operating system refuses the threads, or they are more than [`Threads::most`].
    pub fn new(threads: Threads) -> Result<Self, ThreadError> {
        let count = match threads {
            Threads::Calling | Threads::Own(NonZeroUsize::MIN) => return Ok(Self(Kind::Calling)),
            Threads::CallersPool => return Ok(Self(Kind::CallersPool)),
            Threads::Own(count) if count.get() > Threads::most() => return Err(ThreadError { threads, source: None }),
            Threads::Own(count) => count.get(),
            // Rayon starts one for each core.
            Threads::EachCore => 0,
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        let pool = pool.map_err(|source| ThreadError {
            threads,
            source: Some(source),
        })?;
        Ok(Self(Kind::Own(pool)))
    }

    /// Returns the number of threads that [`run`](Self::run) has when called from here.
    #[must_use]
    pub fn count(&self) -> usize {
        match &self.0 {
            Kind::Calling => 1,
            Kind::CallersPool => threads(),
            Kind::Own(pool) => pool.current_num_threads(),
        }
    }

    /// Runs `action`, whose loops are split between the threads.
    pub fn run<T: Send>(&self, action: impl FnOnce() -> T + Send) -> T {
        match &self.0 {
            Kind::Calling => {
                let _alone = Alone::new();
                action()
            }
            Kind::CallersPool => action(),
            Kind::Own(pool) => pool.install(action),
        }
    }
}

thread_local! {
    /// True if this thread shares no work.
    static IS_ALONE: Cell<bool> = const { Cell::new(false) };
}

/// While this value lives, the thread shares no work.
struct Alone {
    before: bool,
}

impl Alone {
    fn new() -> Self {
        Self {
            before: IS_ALONE.replace(true),
        }
    }
}

impl Drop for Alone {
    fn drop(&mut self) {
        IS_ALONE.set(self.before);
    }
}

/// Returns whether loops are split between threads.
#[must_use]
pub fn has_many_threads() -> bool {
    rayon::current_thread_index().is_some() && rayon::current_num_threads() > 1 && !IS_ALONE.get()
}

/// Returns the number of the calling thread, below [`threads`].
#[must_use]
pub fn own_index() -> usize {
    if has_many_threads() {
        rayon::current_thread_index().unwrap_or(0)
    } else {
        0
    }
}

/// Returns the number of threads that loops are split between.
#[must_use]
pub fn threads() -> usize {
    if has_many_threads() { rayon::current_num_threads() } else { 1 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parallel::for_each;
    use std::collections::BTreeSet;
    use std::panic::AssertUnwindSafe;
    use std::thread::{ThreadId, current};

    fn pool(threads: usize) -> rayon::ThreadPool {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
    }

    /// Returns the threads that a loop runs on.
    fn used(threads: Threads) -> BTreeSet<String> {
        let workers = Workers::new(threads).unwrap();
        let mut items = vec![None; 200];
        workers.run(|| {
            for_each(&mut items, |_, item: &mut Option<ThreadId>| {
                std::thread::sleep(std::time::Duration::from_micros(200));
                *item = Some(current().id());
            });
        });
        items.into_iter().map(|id| format!("{id:?}")).collect()
    }

    fn own() -> BTreeSet<String> {
        BTreeSet::from([format!("{:?}", Some(current().id()))])
    }

    #[test]
    fn the_calling_thread_alone_works_even_in_a_pool() {
        let one = NonZeroUsize::MIN;
        for threads in [Threads::Calling, Threads::Own(one), Threads::from_count(1)] {
            assert_eq!(used(threads), own());
            pool(3).install(|| assert_eq!(used(threads), own()));
        }
    }

    #[test]
    fn the_callers_pool_is_used_where_there_is_one() {
        assert_eq!(used(Threads::CallersPool), own());
        let pool = pool(3);
        let of_pool: BTreeSet<String> = pool
            .broadcast(|_| format!("{:?}", Some(current().id())))
            .into_iter()
            .collect();
        let used = pool.install(|| used(Threads::CallersPool));
        assert!(used.is_subset(&of_pool) && used.len() > 1, "{used:?} of {of_pool:?}");
    }

    #[test]
    fn own_threads_are_none_of_the_callers() {
        let three = Threads::Own(NonZeroUsize::new(3).unwrap());
        assert_eq!(Workers::new(three).unwrap().count(), 3);
        assert!(used(three).is_disjoint(&own()));
    }

    #[test]
    fn a_panic_does_not_leave_the_thread_alone() {
        pool(2).install(|| {
            let workers = Workers::default();
            let panicked = std::panic::catch_unwind(AssertUnwindSafe(|| workers.run::<()>(|| panic!("on purpose"))));
            assert!(panicked.is_err() && has_many_threads());
        });
    }
}
