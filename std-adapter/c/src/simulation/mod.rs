//! The simulations behind the handles.

pub(crate) mod checkpoint;
pub(crate) mod counts;
pub(crate) mod lead;
pub(crate) mod loads;
pub(crate) mod motion;
pub(crate) mod run;
pub(crate) mod state;
#[cfg(test)]
mod tests;

use crate::files::ListedMesh;
use crate::handles::{self, Handled, Living};
use crate::status::{Failure, Status};
use loads::ContactLoadRow;
use run::SimulationHandle;
use selvedge_cloth::{SceneError, SetupError, Simulation};
use state::NearPairRow;

/// A simulation, facts about its scene, and the lists that C reads.
pub(crate) struct HandledSimulation {
    simulation: Simulation,
    of_scene: OfScene,
    has_threads: bool,
    answers: SimulationAnswers,
}

/// Facts of the scene that the simulation does not store.
struct OfScene {
    time_step: f64,
    steps: u64,
    steps_per_frame: u64,
}

/// The lists to which C holds pointers.
#[derive(Default)]
struct SimulationAnswers {
    near_pairs: Vec<NearPairRow>,
    contact_loads: Vec<ContactLoadRow>,
    checkpoint: Vec<u8>,
    in_files: ListedMesh,
    number_of: Vec<u32>,
}

impl Handled for HandledSimulation {
    type Handle = SimulationHandle;
    const NAME: &'static str = "simulation";
    const NO_SUCH: Status = Status::NoSuchSimulation;

    fn living() -> &'static Living<Self> {
        static LIVING: Living<HandledSimulation> = Living::new();
        &LIVING
    }

    fn has_threads(&self) -> bool {
        self.has_threads
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::new(Status::BadScene, error)
    }
}

impl From<SetupError> for Failure {
    fn from(error: SetupError) -> Self {
        match error {
            SetupError::Threads(error) => error.into(),
            SetupError::Topology(error) => error.into(),
            SetupError::Positions(error) => error.into(),
            SetupError::Tangled(tangled) => Self::new(Status::Tangled, tangled),
            SetupError::Value(error) => Self::new(Status::BadScene, error),
        }
    }
}

fn on(handle: *const SimulationHandle, action: impl FnOnce(&mut HandledSimulation) -> Result<(), Failure>) -> Status {
    handles::on(handle, |_, simulation| action(simulation))
}
