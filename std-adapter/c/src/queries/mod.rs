//! The queries that C asks a detector about a step or a state.

/// The functions for `double`. `build.rs` makes those for `float` from this file.
pub mod double;
/// The functions for `float`.
pub mod single {
    include!(concat!(env!("OUT_DIR"), "/queries.rs"));
}

use crate::answers::DetectorAnswers;
use crate::detector::{Detector, DetectorFinder, Format, Handle, on};
use crate::input::view;
use crate::status::{Failure, Status};
use selvedge::{Frame, StepError};

/// Runs `search` with `N` frames of a mesh, each with its name in C.
///
/// # Safety
/// Unless they are null or misaligned, the frames have 3 * `vertex_count` numbers, and no other thread writes to them.
pub(super) unsafe fn on_frames<S: Format, const N: usize>(
    detector: *mut Handle,
    frames: [(&'static str, *const S); N],
    vertex_count: usize,
    search: impl FnOnce(&mut DetectorFinder<S>, &mut DetectorAnswers, [&[[S; 3]]; N]) -> Result<(), Failure>,
) -> Status {
    on(detector, |it| {
        let found = vertex_count;
        let expected = it.topology().vertex_count();
        let Detector { finder, answers, .. } = it;
        let Some(finder) = S::of(finder) else {
            let text = format!("the detector is not for positions in {}", S::NAME);
            return Err(Failure::new(Status::WrongScalar, text));
        };
        if found != expected {
            // The count is checked before any number is read.
            let frame = Frame::Start;
            return Err(StepError::WrongLength { frame, found, expected }.into());
        }
        let mut views: [&[[S; 3]]; N] = [&[]; N];
        for (view_of_frame, (name, start)) in views.iter_mut().zip(frames) {
            // SAFETY: the caller's promise.
            *view_of_frame = unsafe { view(name, start, found) }?;
        }
        search(finder, answers, views)
    })
}
