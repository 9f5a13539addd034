//! One step after another.
//!
//! Extended position-based dynamics with small steps and one iteration each (Macklin et al. 2016, 2019): velocities take the
//! forces, positions are predicted, constraints move them, and the velocity is what comes out of it.
//!
//! With a contact effect the motion that comes out is then certified ([`contact`](crate::contact)), repaired or cut. Bodies and
//! pins have a clock of their own, which may have to wait.
//!
//! **Finite whatever the scene says**: no constraint divides by what may vanish, and no vertex moves faster than [`FASTEST`].

mod advance;
mod assembly;
mod checkpoint;
mod drive;
mod errors;
mod frame;
mod measures;
mod momentum;
mod resume;
mod set_up;
mod simulation;
mod state;
mod substep;
mod tangled;
mod tear;
mod tearing;
mod untangle;

pub use checkpoint::{CHECKPOINT_STEPS, CheckpointError};
pub use drive::DriveError;
pub use errors::{Blocked, SetupError};
pub use frame::{Frame, FrameError};
pub use measures::{EdgeStretch, EffectTime};
pub use simulation::Simulation;
pub use state::FASTEST;
pub use tangled::{Tangled, Untangled, UntanglingEnd, UntanglingProgress};
