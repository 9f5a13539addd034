//! Writes the state of a simulation to bytes, and reads it back.

use super::on;
use super::run::SimulationHandle;
use crate::input::{OutList, view};
use crate::status::{Failure, Status};
use selvedge_cloth::CheckpointError;

/// A checkpoint can be taken before the first step and after every multiple of this number of steps.
pub const SELVEDGE_CHECKPOINT_STEPS: u64 = 200;

const _: () = assert!(SELVEDGE_CHECKPOINT_STEPS == selvedge_cloth::CHECKPOINT_STEPS);

impl From<CheckpointError> for Failure {
    fn from(error: CheckpointError) -> Self {
        Self::new(Status::BadCheckpoint, error)
    }
}

/// Returns the state of the simulation as bytes. Motions that were set for the next step and the wind are not included. The call
/// fails with SELVEDGE_STATUS_NO_CHECKPOINT unless SELVEDGE_CHECKPOINT_STEPS divides the number of steps done.
///
/// The bytes belong to the simulation. They stay valid until its next checkpoint, or until it is freed.
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

/// Continues from a checkpoint of the same scene, with the same bits as an uninterrupted simulation. The bytes are copied; they
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
