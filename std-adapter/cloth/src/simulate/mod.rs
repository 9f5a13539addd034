//! The steps of a simulation.
//!
//! The method is extended position-based dynamics with small steps and one iteration each (Macklin et al. 2016, 2019). Forces
//! change velocities, positions are predicted, and constraints correct them. The new velocity is the change of position over the
//! length of the step.
//!
//! With a contact effect the resulting motion is then certified ([`contact`](crate::contact)), repaired or cut. Bodies and pins
//! have a separate clock, which may have to wait.
//!
//! **All numbers stay finite, whatever the scene**: no constraint divides by a number that may be zero, and no vertex moves
//! faster than [`FASTEST`].

mod advance;
mod assembly;
mod checkpoint;
mod drive;
mod errors;
mod frame;
mod growth;
mod measures;
mod momentum;
mod resume;
mod set_up;
mod simulation;
mod solving;
mod state;
mod tangled;
mod tear;
mod tearing;
mod teleport;
mod untangle;
mod waiting;

pub use checkpoint::{CHECKPOINT_STEPS, CheckpointError};
pub use drive::DriveError;
pub use errors::{Blocked, SetupError};
pub use frame::{FrameError, FrameProgress, FrameSteps};
pub use measures::{EdgeStretch, EffectTime};
pub use simulation::Simulation;
pub use state::FASTEST;
pub use tangled::{Tangled, Untangled, UntanglingEnd, UntanglingProgress};
pub use teleport::TeleportError;
