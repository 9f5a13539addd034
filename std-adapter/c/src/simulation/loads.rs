//! Forces on vertices in the next step, and the loads of cloth on bodies, pins and attachments.

use super::run::SimulationHandle;
use super::state::check_count;
use super::{HandledSimulation, on};
use crate::input::{Out, OutList, view};
use crate::status::{Failure, Status};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{BodyLoad, ContactLoad, Simulation, Wrench};

/// A force and its torque about a point.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WrenchRow {
    /// The force, in N.
    pub force: [f64; 3],
    /// The torque, in N m.
    pub torque: [f64; 3],
}

/// The load of cloth and ropes on a body. The sum of its parts is the whole load.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyLoadRow {
    /// The push of contacts, along their normals.
    pub contact: WrenchRow,
    /// The friction of contacts.
    pub friction: WrenchRow,
    /// The pull of pins that follow the body.
    pub pins: WrenchRow,
    /// The pull of attachments to the body.
    pub attachments: WrenchRow,
}

/// The load of one contact on a body.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactLoadRow {
    /// The vertices of the cloth and of the body. On a ball or a capsule, all four are the vertex of the cloth.
    pub vertices: [u32; 4],
    /// The point of the cloth at which it acts, in metres.
    pub point: [f64; 3],
    /// The push on the body, in N.
    pub push: [f64; 3],
    /// The friction on the body, in N.
    pub friction: [f64; 3],
}

impl From<Wrench> for WrenchRow {
    fn from(wrench: Wrench) -> Self {
        Self {
            force: wrench.force.to_array(),
            torque: wrench.torque.to_array(),
        }
    }
}

impl From<BodyLoad> for BodyLoadRow {
    fn from(load: BodyLoad) -> Self {
        Self {
            contact: load.contact.into(),
            friction: load.friction.into(),
            pins: load.pins.into(),
            attachments: load.attachments.into(),
        }
    }
}

impl From<ContactLoad> for ContactLoadRow {
    fn from(contact: ContactLoad) -> Self {
        Self {
            vertices: contact.vertices,
            point: contact.point.to_array(),
            push: contact.push.to_array(),
            friction: contact.friction.to_array(),
        }
    }
}

/// Adds a force on each of these vertices of cloth, in N, for the whole of the next selvedge_simulation_step or
/// selvedge_simulation_advance. After that call it is gone. Forces on the same vertex add up; those on pinned vertices go to
/// selvedge_simulation_pin_load.
///
/// # Safety
/// `vertices` points to `count` numbers, `forces` to 3 * `count`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_add_forces(
    simulation: *mut SimulationHandle,
    vertices: *const u32,
    forces: *const f64,
    count: usize,
) -> Status {
    on(simulation, |it| {
        let most = it.simulation.cloth_vertices();
        if count > most {
            // The count is checked before any number is read.
            check_count("vertices of cloth at most", count, most)?;
        }
        // SAFETY: the caller's promises.
        let (vertices, forces) = unsafe {
            (
                view::<u32, 1>("vertices", vertices, count)?,
                view::<f64, 3>("forces", forces, count)?,
            )
        };
        let forces: Vec<DVec3> = forces.iter().map(|&force| force.into()).collect();
        Ok(it.simulation.add_forces(vertices.as_flattened(), &forces)?)
    })
}

/// Finds a load about a point.
///
/// # Safety
/// `about` points to three numbers, `load` to one entry.
unsafe fn find<T, Row: From<T>>(
    simulation: *const SimulationHandle,
    (what, number): (&str, usize),
    about: *const f64,
    load: *mut Row,
    find: fn(&Simulation, usize, DVec3) -> Option<T>,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promises.
        let (out, about) = unsafe { (Out::new("load", load)?, view::<f64, 3>("about", about, 1)?) };
        let found = find(&it.simulation, number, about[0].into());
        out.set(found.ok_or_else(|| no_such(what, number))?.into());
        Ok(())
    })
}

fn no_such(what: &str, number: usize) -> Failure {
    Failure::new(
        Status::NoSuchPart,
        format!("the scene has no {what} {number}; they are numbered from 0"),
    )
}

/// Returns the load of cloth and ropes on a body at the end of the last step, with torques about a point. It is zero before the
/// first step, and after selvedge_simulation_resume.
///
/// # Safety
/// `about` points to three numbers, `load` to one entry.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_body_load(
    simulation: *const SimulationHandle,
    body: usize,
    about: *const f64,
    load: *mut BodyLoadRow,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe { find(simulation, ("body", body), about, load, Simulation::body_load) }
}

/// Returns the mean load on a body in the last selvedge_simulation_step or selvedge_simulation_advance. Times the length of that
/// call it is the impulse.
///
/// # Safety
/// The conditions are those of selvedge_simulation_body_load.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_mean_body_load(
    simulation: *const SimulationHandle,
    body: usize,
    about: *const f64,
    load: *mut BodyLoadRow,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe { find(simulation, ("body", body), about, load, Simulation::mean_body_load) }
}

/// Returns the load on a group of pins at the end of the last step: what moves or holds the pins feels. The weight and the
/// inertia of the pinned vertices are in it. Of a soft pin it is the pull of its spring. A vertex in several groups counts in
/// each.
///
/// # Safety
/// The conditions are those of selvedge_simulation_body_load.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_pin_load(
    simulation: *const SimulationHandle,
    group: usize,
    about: *const f64,
    load: *mut WrenchRow,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe { find(simulation, ("group of pins", group), about, load, Simulation::pin_load) }
}

/// Returns the mean load on a group of pins, as selvedge_simulation_mean_body_load.
///
/// # Safety
/// The conditions are those of selvedge_simulation_body_load.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_mean_pin_load(
    simulation: *const SimulationHandle,
    group: usize,
    about: *const f64,
    load: *mut WrenchRow,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe { find(simulation, ("group of pins", group), about, load, Simulation::mean_pin_load) }
}

/// Returns the load on a group of attachments at the end of the last step.
///
/// # Safety
/// The conditions are those of selvedge_simulation_body_load.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_attachment_load(
    simulation: *const SimulationHandle,
    group: usize,
    about: *const f64,
    load: *mut WrenchRow,
) -> Status {
    let of = ("group of attachments", group);
    // SAFETY: the caller's promises.
    unsafe { find(simulation, of, about, load, Simulation::attachment_load) }
}

/// Returns the mean load on a group of attachments, as selvedge_simulation_mean_body_load.
///
/// # Safety
/// The conditions are those of selvedge_simulation_body_load.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_mean_attachment_load(
    simulation: *const SimulationHandle,
    group: usize,
    about: *const f64,
    load: *mut WrenchRow,
) -> Status {
    let of = ("group of attachments", group);
    // SAFETY: the caller's promises.
    unsafe { find(simulation, of, about, load, Simulation::mean_attachment_load) }
}

/// Returns the contacts that pushed a body in the last part of the last step.
///
/// The list belongs to the simulation. It stays valid until the next call of this function, or until the simulation is freed.
///
/// # Safety
/// `contacts` points to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_contact_loads(
    simulation: *mut SimulationHandle,
    body: usize,
    contacts: *mut *const ContactLoadRow,
    count: *mut usize,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promises.
        let out = unsafe { OutList::new("contacts", contacts, count) }?;
        let HandledSimulation { simulation, answers, .. } = it;
        if body >= simulation.body_names().len() {
            return Err(no_such("body", body));
        }
        let shown = &mut answers.contact_loads;
        shown.clear();
        shown.extend(simulation.contact_loads(body).map(ContactLoadRow::from));
        out.set(shown);
        Ok(())
    })
}
