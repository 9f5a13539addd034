//! The steps of a simulation.
//!
//! A step is one [solve](crate::solve): forces change velocities, inertia predicts positions, and Newton's method finds the
//! positions of the least energy. With a contact effect the resulting motion is then certified ([`contact`](crate::contact)),
//! repaired or cut. Bodies and pins have a separate clock, which may have to wait.
//!
//! **All numbers stay finite, whatever the scene**: nothing divides by a number that may be zero, and no vertex moves
//! faster than [`FASTEST`].

mod added_forces;
mod advance;
mod ahead;
mod assembly;
mod checkpoint;
mod doubled;
mod drive;
mod errors;
mod frame;
mod free_bodies;
mod growth;
mod loads;
mod measures;
mod momentum;
mod proxies;
mod read_bodies;
mod read_loads;
mod resume;
mod set_up;
mod simulation;
mod state;
mod substep;
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
pub use loads::{BodyLoad, ContactLoad, Wrench};
pub use measures::{EdgeStretch, EffectTime};
pub use read_bodies::FreeBodyState;
pub use simulation::Simulation;
pub use state::FASTEST;
pub use tangled::{Tangled, Untangled, UntanglingEnd, UntanglingProgress};
pub use teleport::TeleportError;
