//! Shows a progress bar on standard error, if that is a terminal and the work takes longer than a second.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

const DELAY: Duration = Duration::from_secs(1);
const INTERVAL: Duration = Duration::from_millis(100);
const LENGTH: u64 = 1000;

/// A thread of its own shows it, so that it also moves during one long call. It disappears when dropped.
pub(crate) struct Progress {
    done: Arc<AtomicU64>,
    thread: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Shows work whose share is reported by [`set`](Self::set).
    pub(crate) fn bar(message: &'static str) -> Self {
        Self::start(message, LENGTH, "{msg} {wide_bar} {percent} %, {eta} left")
    }

    /// Shows work in this many steps, reported by [`set_steps`](Self::set_steps).
    pub(crate) fn steps(message: &'static str, steps: u64) -> Self {
        let template = "{msg} {wide_bar} {percent} %, step {pos}, {per_sec}, {eta} left";
        Self::start(message, steps, template)
    }

    /// Shows work that ends when nothing remains of this many, reported by [`set_steps`](Self::set_steps).
    pub(crate) fn shrinking(message: &'static str, most: u64) -> Self {
        Self::start(message, most, "{msg} {pos}, {elapsed}")
    }

    /// Shows work of unknown length.
    pub(crate) fn spinner(message: &'static str) -> Self {
        Self::start(message, LENGTH, "{spinner} {msg}, {elapsed}")
    }

    fn start(message: &'static str, length: u64, template: &'static str) -> Self {
        let done = Arc::new(AtomicU64::new(0));
        let thread = stderr().is_terminal().then(|| {
            let (stop, stopped) = channel::<()>();
            let done = Arc::clone(&done);
            let show = move || {
                if stopped.recv_timeout(DELAY) != Err(RecvTimeoutError::Timeout) {
                    return;
                }
                let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
                let bar = ProgressBar::new(length)
                    .with_style(style)
                    .with_message(message)
                    .with_elapsed(DELAY)
                    .with_position(done.load(Ordering::Relaxed));
                // Work done before the bar appeared must not count as done at once.
                bar.reset_eta();
                loop {
                    bar.set_position(done.load(Ordering::Relaxed));
                    bar.tick();
                    if stopped.recv_timeout(INTERVAL) != Err(RecvTimeoutError::Timeout) {
                        break;
                    }
                }
                bar.finish_and_clear();
            };
            let thread = std::thread::Builder::new().spawn(show).ok()?;
            Some((stop, thread))
        });
        Self {
            done,
            thread: thread.flatten(),
        }
    }

    /// Reports the number of steps that are done.
    pub(crate) fn set_steps(&self, steps: u64) {
        self.done.store(steps, Ordering::Relaxed);
    }

    /// Reports the share of the work that is done, from 0 to 1.
    pub(crate) fn set(&self, share: f64) {
        self.done.store((share * LENGTH as f64) as u64, Ordering::Relaxed);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((stop, thread)) = self.thread.take() {
            drop(stop);
            let _ = thread.join();
        }
    }
}
