//! Loads on bodies, pins and attachments, forces on vertices, and the motion of free bodies.

use crate::answers::{class, column, rows};
use crate::driven::copied_as;
use crate::errors::{self, InputError};
use pyo3::prelude::*;
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{BodyLoad, ContactLoad, FreeBodyState, Simulation, Wrench};

/// Adds one force on all vertices, or one for each of them.
pub(crate) fn add_force(simulation: &mut Simulation, vertices: &[u32], force: &Bound<'_, PyAny>) -> PyResult<()> {
    let added = match force.extract::<[f64; 3]>() {
        Ok(force) => simulation.add_force(vertices, force.into()),
        Err(_) => simulation.add_forces(vertices, &copied_as(force, "force")?),
    };
    added.map_err(|error| errors::of_driving(&error))
}

pub(crate) fn vector(py: Python<'_>, vector: DVec3) -> Bound<'_, PyAny> {
    column(py, vector.to_array().to_vec())
}

pub(crate) fn wrench(py: Python<'_>, wrench: Wrench) -> PyResult<Bound<'_, PyAny>> {
    class(py, "Wrench")?.call1((vector(py, wrench.force), vector(py, wrench.torque)))
}

/// Returns the load on a body, whose index is known to be right.
pub(crate) fn of_body<'py>(
    py: Python<'py>,
    simulation: &Simulation,
    body: usize,
    about: DVec3,
    mean: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let load = if mean {
        simulation.mean_body_load(body, about)
    } else {
        simulation.body_load(body, about)
    };
    let BodyLoad {
        contact,
        friction,
        pins,
        attachments,
    } = load.unwrap_or_default();
    class(py, "BodyLoad")?.call1((
        wrench(py, contact)?,
        wrench(py, friction)?,
        wrench(py, pins)?,
        wrench(py, attachments)?,
    ))
}

type GroupLoad = fn(&Simulation, usize, DVec3) -> Option<Wrench>;

/// A kind of groups, with its loads at the end of the last step and in the mean of the last call.
pub(crate) struct Groups(&'static str, GroupLoad, GroupLoad);

pub(crate) const PINS: Groups = Groups("pins", Simulation::pin_load, Simulation::mean_pin_load);
pub(crate) const ATTACHMENTS: Groups = Groups("attachments", Simulation::attachment_load, Simulation::mean_attachment_load);

/// Returns the load on a group. Raises an error if there is no such group.
pub(crate) fn of_group<'py>(
    py: Python<'py>,
    simulation: &Simulation,
    Groups(what, now, in_mean): Groups,
    (group, about): (usize, DVec3),
    mean: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let load = if mean { in_mean } else { now }(simulation, group, about);
    let no_group = || InputError::new_err(format!("the scene has no group {group} of {what}"));
    wrench(py, load.ok_or_else(no_group)?)
}

pub(crate) fn of_contacts<'py>(py: Python<'py>, simulation: &Simulation, body: usize) -> PyResult<Bound<'py, PyAny>> {
    let all: Vec<ContactLoad> = simulation.contact_loads(body).collect();
    let column = |of: fn(&ContactLoad) -> DVec3| rows(py, all.iter().map(|contact| of(contact).to_array()).collect());
    class(py, "ContactLoads")?.call1((
        rows(py, all.iter().map(|contact| contact.vertices).collect())?,
        column(|contact| contact.point)?,
        column(|contact| contact.push)?,
        column(|contact| contact.friction)?,
    ))
}

/// Returns the motion of a body, whose index is known to be right; `None` unless it is free.
pub(crate) fn of_free_body<'py>(py: Python<'py>, simulation: &Simulation, body: usize) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Some(state) = simulation.body_motion(body) else {
        return Ok(None);
    };
    let FreeBodyState {
        mass,
        centre,
        velocity,
        spin,
        angular_momentum,
    } = state;
    let [centre, velocity, spin, angular_momentum] = [centre, velocity, spin, angular_momentum].map(|of| vector(py, of));
    class(py, "FreeBodyState")?
        .call1((mass, centre, velocity, spin, angular_momentum))
        .map(Some)
}
