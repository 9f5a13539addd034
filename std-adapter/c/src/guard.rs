//! Catches panics of a call from C.

use crate::status::{Failure, Status, remember};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs `action` and turns a panic into an error. A poisoned lock marks the item that the action was changing.
pub(crate) fn guarded(action: impl FnOnce() -> Result<(), Failure>) -> Status {
    let failure = match catch_unwind(AssertUnwindSafe(action)) {
        Ok(Ok(())) => return Status::Ok,
        Ok(Err(failure)) => failure,
        Err(payload) => Failure::new(Status::Internal, message_of(payload)),
    };
    remember(&failure)
}

fn message_of(payload: Box<dyn Any + Send>) -> String {
    let message = match (payload.downcast_ref::<String>(), payload.downcast_ref::<&str>()) {
        (Some(message), _) => message.clone(),
        (None, Some(&message)) => message.to_owned(),
        (None, None) => {
            // The drop of another payload may itself panic.
            std::mem::forget(payload);
            "a panic without a message".to_owned()
        }
    };
    format!("a bug in Selvedge, please report it: {message}")
}
