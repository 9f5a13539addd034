//! A simulation's state as bytes, and back.

use super::on;
use super::run::SimulationHandle;
use crate::input::{OutList, view};
use crate::status::{Failure, Status};
use selvedge_cloth::CheckpointError;

/// A checkpoint can be taken before the first step, after so many steps, and again after so many more.
pub const SELVEDGE_CHECKPOINT_STEPS: u64 = 200;

const _: () = assert!(SELVEDGE_CHECKPOINT_STEPS == selvedge_cloth::CHECKPOINT_STEPS);

impl From<CheckpointError> for Failure {
    fn from(error: CheckpointError) -> Self {
        Self::new(Status::BadCheckpoint, error)
    }
}

/// All that the rest of the simulation depends on, as bytes to keep. What the next step was told, and the wind, is not in it.
/// SELVEDGE_STATUS_NO_CHECKPOINT unless SELVEDGE_CHECKPOINT_STEPS divides the steps done.
///
/// `*bytes` is the simulation's, until its next checkpoint is taken, or it is freed.
///
/// # Safety
/// `bytes` points to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_checkpoint(
    simulation: *mut SimulationHandle,
    bytes: *mut *const u8,
    count: *mut usize,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promises.
        let out = unsafe { OutList::new("bytes", bytes, count) }?;
        it.answers.checkpoint = it.simulation.checkpoint().ok_or_else(|| {
            let done = it.simulation.steps_done();
            let next = done.next_multiple_of(SELVEDGE_CHECKPOINT_STEPS);
            let text = format!("there is no checkpoint after step {done}: the next one is after step {next}");
            Failure::new(Status::NoCheckpoint, text)
        })?;
        out.set(&it.answers.checkpoint);
        Ok(())
    })
}

/// Goes on from a checkpoint of the same scene, with the same bits as if that simulation had never ended. The bytes are copied, and
/// may be this simulation's own.
///
/// # Safety
/// `bytes` points to `count` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_resume(simulation: *mut SimulationHandle, bytes: *const u8, count: usize) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promise.
        let given = unsafe { view::<u8, 1>("bytes", bytes, count) }?;
        Ok(it.simulation.resume(given.as_flattened())?)
    })
}
