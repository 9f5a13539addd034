//! The motion of free bodies.

use super::on;
use super::run::SimulationHandle;
use crate::input::Out;
use crate::status::Status;
use selvedge_cloth::{DriveError, FreeBodyState};

/// The mass and the motion of a free body.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FreeBodyStateRow {
    /// The mass, in kg, with that of cloth that is pinned to the body.
    pub mass: f64,
    /// The centre of mass, in metres.
    pub centre: [f64; 3],
    /// The velocity of the centre of mass, in m/s.
    pub velocity: [f64; 3],
    /// The angular velocity, in rad/s.
    pub spin: [f64; 3],
    /// The angular momentum about the centre of mass, in kg m^2/s.
    pub angular_momentum: [f64; 3],
}

impl From<FreeBodyState> for FreeBodyStateRow {
    fn from(state: FreeBodyState) -> Self {
        Self {
            mass: state.mass,
            centre: state.centre.to_array(),
            velocity: state.velocity.to_array(),
            spin: state.spin.to_array(),
            angular_momentum: state.angular_momentum.to_array(),
        }
    }
}

/// Returns the mass and the present motion of a free body, one with a `mass` or a `density` in the scene. `*is_free` is false for
/// other bodies; `*state` then stays unchanged. selvedge_simulation_placement says where its mesh is.
///
/// # Safety
/// `is_free` and `state` point to one entry each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_body_motion(
    simulation: *const SimulationHandle,
    body: usize,
    is_free: *mut bool,
    state: *mut FreeBodyStateRow,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promises.
        let (is_free, out) = unsafe { (Out::new("is_free", is_free)?, Out::new("state", state)?) };
        let bodies = it.simulation.body_names().len();
        if body >= bodies {
            return Err(DriveError::NoBody { body, bodies }.into());
        }
        let found = it.simulation.body_motion(body);
        is_free.set(found.is_some());
        if let Some(state) = found {
            out.set(state.into());
        }
        Ok(())
    })
}
