//! The clock of statistics: stands still without the feature `timing`, as machines without a clock need it.

use std::time::Duration;

/// When something began.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    #[cfg(feature = "timing")]
    begin: std::time::Instant,
}

impl Clock {
    /// Now.
    pub(crate) fn now() -> Self {
        Self {
            #[cfg(feature = "timing")]
            begin: std::time::Instant::now(),
        }
    }

    /// The time since then; zero without the feature.
    #[cfg(feature = "timing")]
    pub(crate) fn elapsed(self) -> Duration {
        self.begin.elapsed()
    }

    #[cfg(not(feature = "timing"))]
    #[allow(clippy::unused_self, reason = "the same call with the feature")]
    pub(crate) const fn elapsed(self) -> Duration {
        Duration::ZERO
    }
}
