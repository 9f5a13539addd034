//! Runs a call without the interpreter lock; Ctrl-C interrupts it.

use crate::errors;
use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread;
use std::time::Duration;

/// The longest time until Ctrl-C is noticed.
const POLL: Duration = Duration::from_millis(50);

/// The expected length of a call.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Length {
    /// The call takes a second at most.
    Short,
    /// The call may take any time.
    Long,
}

/// Runs `action` without the interpreter lock. On Ctrl-C it calls `stop`, so that `action` returns soon, and raises
/// `KeyboardInterrupt`.
///
/// Python runs signal handlers only on its main thread, and only when that thread checks for them. On the main thread the work
/// therefore runs on a separate thread.
///
/// # Errors
/// The outer result is an exception. The inner one is the message of a panic.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    length: Length,
    stop: impl Fn() + Send + Sync,
    action: impl FnOnce() -> T + Send,
) -> PyResult<Result<T, String>> {
    let guarded = || catch_unwind(AssertUnwindSafe(action)).map_err(message_of);
    if length == Length::Short || !is_main_thread(py)? {
        return Ok(py.detach(guarded));
    }
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, receiver) = sync_channel(1);
            let work = move || {
                // The receiver is gone only if this thread has panicked.
                let _ = sender.send(guarded());
            };
            thread::Builder::new()
                .name("selvedge".into())
                .spawn_scoped(scope, work)
                .map_err(|error| errors::ThreadsError::new_err(format!("the operating system refused a thread: {error}")))?;
            loop {
                match receiver.recv_timeout(POLL) {
                    Ok(done) => return Ok(done),
                    Err(RecvTimeoutError::Timeout) => Python::attach(|py| py.check_signals()).inspect_err(|_| stop())?,
                    Err(RecvTimeoutError::Disconnected) => return Ok(Err("a thread ended before its work".into())),
                }
            }
        })
    })
}

/// Returns whether Python runs signal handlers on this thread.
pub(crate) fn is_main_thread(py: Python<'_>) -> PyResult<bool> {
    let threading = py.import("threading")?;
    let main = threading.call_method0("main_thread")?.getattr("ident")?;
    main.eq(threading.call_method0("get_ident")?)
}

fn message_of(payload: Box<dyn Any + Send>) -> String {
    match (payload.downcast_ref::<String>(), payload.downcast_ref::<&str>()) {
        (Some(message), _) => message.clone(),
        (None, Some(&message)) => message.to_owned(),
        (None, None) => {
            // Another payload's drop may itself panic.
            std::mem::forget(payload);
            "a panic without a message".to_owned()
        }
    }
}
