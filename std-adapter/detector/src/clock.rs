//! A clock that stands still without the feature `timing`, so that platforms without a clock never read one.

use std::time::Duration;

#[cfg(all(feature = "timing", not(all(target_family = "wasm", target_os = "unknown"))))]
use std::time::Instant;
/// The standard library's clock panics in a browser.
#[cfg(all(feature = "timing", target_family = "wasm", target_os = "unknown"))]
use web_time::Instant;

/// The moment at which something began.
///
/// ```
/// let clock = selvedge::clock::Clock::now();
/// let seconds = clock.elapsed().as_secs_f64(); // 0 without the feature `timing`
/// assert!(seconds >= 0.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    #[cfg(feature = "timing")]
    begin: Instant,
}

impl Clock {
    /// Starts the clock.
    #[must_use]
    pub fn now() -> Self {
        Self {
            #[cfg(feature = "timing")]
            begin: Instant::now(),
        }
    }

    /// Returns the time since the start; zero without the feature `timing`.
    #[cfg(feature = "timing")]
    #[must_use]
    pub fn elapsed(self) -> Duration {
        self.begin.elapsed()
    }

    /// Returns zero, since the feature `timing` is off.
    #[cfg(not(feature = "timing"))]
    #[allow(clippy::unused_self, reason = "the same call with the feature")]
    #[must_use]
    pub const fn elapsed(self) -> Duration {
        Duration::ZERO
    }
}
