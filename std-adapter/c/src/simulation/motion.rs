//! The motion of free bodies, and proxies.

use super::loads::WrenchRow;
use super::on;
use super::run::SimulationHandle;
use crate::input::{Out, view};
use crate::status::Status;
use crate::world::steps::PoseRow;
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{BroughtBody, DriveError, FreeBodyState, Placement};

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

/// Where another physics engine has brought a body.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BroughtBodyRow {
    /// The placement of the body's mesh.
    pub placement: PoseRow,
    /// The velocity of the centre of mass, in m/s.
    pub velocity: [f64; 3],
    /// The angular velocity, in rad/s.
    pub spin: [f64; 3],
}

/// Says where another physics engine has brought the body of a proxy, a free body with `proxy = true` in the scene, in the time
/// of the next selvedge_simulation_advance or selvedge_simulation_step. In that time the proxy goes there, and yields to cloth on
/// the way by the mass of the body. Without a call it stays, and yields.
///
/// Afterwards move the engine's body to selvedge_simulation_placement, and add selvedge_simulation_proxy_load, times the length
/// of the frame, to its momentum. Both steps must have the same length. SELVEDGE_STATUS_NOT_DRIVEN means that the body is not a
/// proxy.
///
/// # Safety
/// `to` points to one entry.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_bring_body(
    simulation: *mut SimulationHandle,
    body: usize,
    to: *const BroughtBodyRow,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promise. An entry is 13 numbers.
        let given = unsafe { view::<f64, 13>("to", to.cast(), 1) }?;
        let [x, y, z, w, a, b, c, ref speeds @ ..] = given[0];
        let to = BroughtBody {
            placement: Placement::new(DQuat::from_xyzw(x, y, z, w), DVec3::new(a, b, c)),
            velocity: DVec3::from_slice(&speeds[..3]),
            spin: DVec3::from_slice(&speeds[3..]),
        };
        Ok(it.simulation.bring_body(body, to)?)
    })
}

/// Returns the mean force of cloth and ropes on a proxy in the last selvedge_simulation_step or selvedge_simulation_advance, with
/// the mean torque about its centre of mass. Cloth that is pinned to it is part of the load. `*is_proxy` is false for other
/// bodies; `*load` then stays unchanged.
///
/// # Safety
/// `is_proxy` and `load` point to one entry each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_proxy_load(
    simulation: *const SimulationHandle,
    body: usize,
    is_proxy: *mut bool,
    load: *mut WrenchRow,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promises.
        let (is_proxy, out) = unsafe { (Out::new("is_proxy", is_proxy)?, Out::new("load", load)?) };
        let bodies = it.simulation.body_names().len();
        if body >= bodies {
            return Err(DriveError::NoBody { body, bodies }.into());
        }
        let found = it.simulation.proxy_load(body);
        is_proxy.set(found.is_some());
        if let Some(load) = found {
            out.set(load.into());
        }
        Ok(())
    })
}
