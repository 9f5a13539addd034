//! One call from C.

use crate::status::{Failure, Status, remember};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs `action`; a panic ends here. What it was about to change is left to a lock that knows of panics.
pub(crate) fn guarded(action: impl FnOnce() -> Result<(), Failure>) -> Status {
    let failure = match catch_unwind(AssertUnwindSafe(action)) {
        Ok(Ok(())) => return Status::Ok,
        Ok(Err(failure)) => failure,
        Err(payload) => Failure::new(Status::Internal, words_of(payload)),
    };
    remember(&failure)
}

fn words_of(payload: Box<dyn Any + Send>) -> String {
    let words = match (payload.downcast_ref::<String>(), payload.downcast_ref::<&str>()) {
        (Some(words), _) => words.clone(),
        (None, Some(&words)) => words.to_owned(),
        (None, None) => {
            // Another payload's drop may itself panic.
            std::mem::forget(payload);
            "a panic without words".to_owned()
        }
    };
    format!("a fault of Selvedge's, please report it: {words}")
}
