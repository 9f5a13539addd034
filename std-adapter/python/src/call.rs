//! One call from Python: without the interpreter, and ended by Ctrl-C.

use crate::errors;
use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread;
use std::time::Duration;

/// How long Ctrl-C may go unseen.
const POLL: Duration = Duration::from_millis(50);

/// Whether a call may take long enough that somebody wants to end it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Length {
    /// A second at the very worst.
    Short,
    /// Any.
    Long,
}

/// Runs `action` without the interpreter. On Ctrl-C calls `stop`, which has `action` return soon, and raises `KeyboardInterrupt`.
///
/// Python runs handlers of signals on its main thread alone, and only if that asks for them: there the work goes to a thread of its own.
///
/// # Errors
/// The outer result is an exception; the inner one, words of a panic.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    length: Length,
    stop: impl Fn() + Send + Sync,
    action: impl FnOnce() -> T + Send,
) -> PyResult<Result<T, String>> {
    let guarded = || catch_unwind(AssertUnwindSafe(action)).map_err(words_of);
    if length == Length::Short || !is_main_thread(py)? {
        return Ok(py.detach(guarded));
    }
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, receiver) = sync_channel(1);
            let work = move || {
                // Nobody waits for it any more only if this thread has panicked.
                let _ = sender.send(guarded());
            };
            thread::Builder::new()
                .name("selvedge".into())
                .spawn_scoped(scope, work)
                .map_err(|error| errors::ThreadsError::new_err(format!("the operating system refuses a thread: {error}")))?;
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

fn is_main_thread(py: Python<'_>) -> PyResult<bool> {
    let threading = py.import("threading")?;
    let main = threading.call_method0("main_thread")?.getattr("ident")?;
    main.eq(threading.call_method0("get_ident")?)
}

fn words_of(payload: Box<dyn Any + Send>) -> String {
    match (payload.downcast_ref::<String>(), payload.downcast_ref::<&str>()) {
        (Some(words), _) => words.clone(),
        (None, Some(&words)) => words.to_owned(),
        (None, None) => {
            // Another payload's drop may itself panic.
            std::mem::forget(payload);
            "a panic without words".to_owned()
        }
    }
}
