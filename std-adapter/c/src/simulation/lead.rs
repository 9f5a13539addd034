//! Moves bodies and pins in the next step, and sets the wind.

use super::on;
use super::run::SimulationHandle;
use super::state::check_count;
use crate::input::{Out, view};
use crate::status::{Failure, Status};
use crate::world::steps::PoseRow;
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{DriveError, Placement, Simulation, TeleportError};

impl From<DriveError> for Failure {
    fn from(error: DriveError) -> Self {
        let status = match error {
            DriveError::NoBody { .. } | DriveError::NoPins { .. } | DriveError::NoVertex { .. } | DriveError::NoWind => {
                Status::NoSuchPart
            }
            DriveError::NotDriven { .. } | DriveError::NoProxy { .. } => Status::NotDriven,
            DriveError::VertexCount { .. } | DriveError::ForceCount { .. } => Status::WrongLength,
            DriveError::Value(_) => Status::BadValue,
        };
        Self::new(status, error)
    }
}

impl From<TeleportError> for Failure {
    fn from(error: TeleportError) -> Self {
        let status = match error {
            TeleportError::Drive(error) => return error.into(),
            TeleportError::NoCloth { .. } => Status::NoSuchPart,
            TeleportError::Held { .. } => Status::NotDriven,
            _ => Status::Blocked,
        };
        Self::new(status, error)
    }
}

/// Returns a placement from C: seven numbers, as fields or as an array.
///
/// # Safety
/// `placement` points to one entry.
unsafe fn placement_at(name: &str, placement: *const PoseRow) -> Result<Placement, Failure> {
    // SAFETY: the caller's promise.
    let given = unsafe { view::<f64, 7>(name, placement.cast(), 1) }?;
    let [x, y, z, w, a, b, c] = given[0];
    Ok(Placement::new(DQuat::from_xyzw(x, y, z, w), DVec3::new(a, b, c)))
}

/// Moves a driven body to a placement in the next step: its mesh in the scene is rotated and then translated. It rotates the
/// short way about its origin while it moves, both at a constant rate. It then stays there. A step that is cut or has to wait
/// leaves it on its way; selvedge_simulation_placement says where.
///
/// # Safety
/// `placement` points to one entry.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_place_body(
    simulation: *mut SimulationHandle,
    body: usize,
    placement: *const PoseRow,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promise.
        let placement = unsafe { placement_at("placement", placement) }?;
        Ok(it.simulation.place_body(body, placement)?)
    })
}

/// Moves driven and free bodies elsewhere at once, and with them their pins and the cloth that hangs on them, for a figure that
/// teleports. No time passes, and nothing is swept on the way. `by` is applied to positions in the world: they are rotated about
/// the origin, then translated. Velocities turn along. Cloth moves if it is pinned or attached to one of the bodies, or if it
/// belongs to one of `cloths`, such as a garment without pins. Bodies and cloths have their numbers in the scene.
///
/// On an error nothing has changed. SELVEDGE_STATUS_NOT_DRIVEN means that a body is neither driven nor free, or that something
/// that stays holds the cloth as well, SELVEDGE_STATUS_BLOCKED that there is no room.
///
/// # Safety
/// `bodies` points to `body_count` numbers, `cloths` to `cloth_count`, `by` to one entry. Lists may be NULL if they have no
/// entry.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_teleport(
    simulation: *mut SimulationHandle,
    bodies: *const usize,
    body_count: usize,
    cloths: *const usize,
    cloth_count: usize,
    by: *const PoseRow,
) -> Status {
    on(simulation, |it| {
        let most = it.simulation.body_names().len().max(it.simulation.cloth_names().len());
        for (name, count) in [("bodies", body_count), ("cloths", cloth_count)] {
            if count > most {
                // The count is checked before any number is read.
                check_count(&format!("{name} in the scene"), count, most)?;
            }
        }
        // SAFETY: the caller's promises.
        let (bodies, cloths, by) = unsafe {
            (
                view::<usize, 1>("bodies", bodies, body_count)?,
                view::<usize, 1>("cloths", cloths, cloth_count)?,
                placement_at("by", by)?,
            )
        };
        Ok(it.simulation.teleport(bodies.as_flattened(), cloths.as_flattened(), by)?)
    })
}

/// Returns the current placement of a driven or free body. `*is_known` is false for other bodies and for one that was moved
/// vertex by vertex; `*placement` then stays unchanged.
///
/// # Safety
/// `is_known` and `placement` point to one entry each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_placement(
    simulation: *const SimulationHandle,
    body: usize,
    is_known: *mut bool,
    placement: *mut PoseRow,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promises.
        let (is_known, out) = unsafe { (Out::new("is_known", is_known)?, Out::new("placement", placement)?) };
        let bodies = it.simulation.body_names().len();
        if body >= bodies {
            return Err(DriveError::NoBody { body, bodies }.into());
        }
        let found = it.simulation.placement(body);
        is_known.set(found.is_some());
        if let Some(Placement { rotation, translation }) = found {
            out.set(PoseRow {
                rotation: rotation.to_array(),
                origin: translation.to_array(),
            });
        }
        Ok(())
    })
}

/// Moves vertices to positions from C.
///
/// # Safety
/// Unless it is null or misaligned, `start` points to three numbers for each of `count`.
unsafe fn move_to(
    simulation: *mut SimulationHandle,
    (start, count): (*const f64, usize),
    move_them: impl FnOnce(&mut Simulation, &[DVec3]) -> Result<(), DriveError>,
) -> Status {
    on(simulation, |it| {
        let most = it.simulation.positions().len();
        if count > most {
            // The count is checked before any number is read.
            check_count("vertices in the scene", count, most)?;
        }
        // SAFETY: the caller's promise.
        let given = unsafe { view::<f64, 3>("positions", start, count) }?;
        let positions: Vec<DVec3> = given.iter().map(|&point| point.into()).collect();
        Ok(move_them(&mut it.simulation, &positions)?)
    })
}

/// Moves each vertex of a driven body straight to a position, in metres, in the next step. Use it for a body that changes its
/// shape, such as a skinned figure. Pins that follow such a body stay where they are; move them separately.
///
/// # Safety
/// `positions` points to 3 * `vertex_count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_move_body(
    simulation: *mut SimulationHandle,
    body: usize,
    positions: *const f64,
    vertex_count: usize,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        move_to(simulation, (positions, vertex_count), |it, positions| {
            it.move_body(body, positions)
        })
    }
}

/// Moves each vertex of a driven group of pins in the next step. `group` is its number in the scene, from 0. Soft pins pull their
/// vertices towards these positions.
///
/// # Safety
/// The conditions are those of selvedge_simulation_move_body.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_move_pins(
    simulation: *mut SimulationHandle,
    group: usize,
    positions: *const f64,
    vertex_count: usize,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        move_to(simulation, (positions, vertex_count), |it, positions| {
            it.move_pins(group, positions)
        })
    }
}

/// Sets the velocity of the scene's wind from now on, in m/s.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_simulation_set_wind(simulation: *mut SimulationHandle, x: f64, y: f64, z: f64) -> Status {
    on(simulation, |it| Ok(it.simulation.set_wind(DVec3::new(x, y, z))?))
}
