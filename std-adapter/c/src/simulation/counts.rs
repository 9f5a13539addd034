//! What a simulation tells of itself in numbers: how much of what there is, how far it is, whether its state is certified.

use super::on;
use super::run::SimulationHandle;
use crate::input::{Out, text};
use crate::status::{Failure, Status};
use selvedge_cloth::Simulation;
use std::ffi::c_char;
use std::ops::Range;

/// How much of what there is in a scene, which no step changes. Vertices and triangles are those of each cloth, then those of
/// bodies, in the order of the scene.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SizesRow {
    /// Of cloth and bodies.
    pub vertex_count: usize,
    /// Of cloth and bodies.
    pub triangle_count: usize,
    /// How many of the vertices are of cloth.
    pub cloth_vertex_count: usize,
    /// How many of the triangles are of cloth.
    pub cloth_triangle_count: usize,
    /// How many edges belong to no triangle: of ropes, laces and fringes.
    pub loose_edge_count: usize,
    /// How many cloths there are, numbered from 0 on.
    pub cloth_count: usize,
    /// How many bodies there are, numbered from 0 on.
    pub body_count: usize,
    /// Of a step, in seconds.
    pub time_step: f64,
    /// As many as the scene's duration has.
    pub steps: u64,
    /// From one frame to the next.
    pub steps_per_frame: u64,
}

/// How far a simulation is, and what is promised of its state.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProgressRow {
    /// So far.
    pub steps_done: u64,
    /// Simulated so far, in seconds.
    pub time: f64,
    /// How far bodies and pins are behind their keyframes, in seconds.
    pub lag: f64,
    /// Steps in which bodies or pins had to wait, or to be let pass.
    pub blocked_steps: u64,
    /// Pairs that have left the promise since the start, in a scene that tolerates what is tangled there.
    pub tolerated_pairs: usize,
    /// Whether the state is certified to be free of intersections of whatever the scene's contact effects name: not without any,
    /// not while a body is let pass, and not while what was tangled at the start is tolerated.
    pub is_certified: bool,
}

/// A cloth or a body, among others and among the vertices.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PartRow {
    /// Among the cloths, or the bodies, from 0 on.
    pub number: usize,
    /// The first of its vertices.
    pub first_vertex: usize,
    /// They come one after another.
    pub vertex_count: usize,
}

/// How much of what there is.
///
/// # Safety
/// `sizes` points to one entry.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_sizes(simulation: *const SimulationHandle, sizes: *mut SizesRow) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promise.
        let out = unsafe { Out::new("sizes", sizes) }?;
        let simulation = &it.simulation;
        out.set(SizesRow {
            vertex_count: simulation.positions().len(),
            triangle_count: simulation.triangles().len(),
            cloth_vertex_count: simulation.cloth_vertices(),
            cloth_triangle_count: simulation.cloth_triangles(),
            loose_edge_count: simulation.loose_edges().len(),
            cloth_count: simulation.cloth_names().len(),
            body_count: simulation.body_names().len(),
            time_step: it.of_scene.time_step,
            steps: it.of_scene.steps,
            steps_per_frame: it.of_scene.steps_per_frame,
        });
        Ok(())
    })
}

/// How far it is, and whether its state is certified.
///
/// # Safety
/// `progress` points to one entry.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_progress(simulation: *const SimulationHandle, progress: *mut ProgressRow) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promise.
        let out = unsafe { Out::new("progress", progress) }?;
        let simulation = &it.simulation;
        out.set(ProgressRow {
            steps_done: simulation.steps_done(),
            time: simulation.time(),
            lag: simulation.lag(),
            blocked_steps: simulation.blocked_steps(),
            tolerated_pairs: simulation.tolerated_pairs(),
            is_certified: simulation.is_certified(),
        });
        Ok(())
    })
}

/// # Safety
/// As selvedge_simulation_body.
unsafe fn find_part(
    simulation: *const SimulationHandle,
    (kind, names): (&str, fn(&Simulation) -> &[String]),
    vertices_of: fn(&Simulation, usize) -> Option<Range<usize>>,
    name: *const c_char,
    part: *mut PartRow,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promises.
        let (out, name) = unsafe { (Out::new("part", part)?, text("the name", name)?) };
        let names = names(&it.simulation);
        let number = names.iter().position(|known| known == name);
        let found = number.and_then(|number| Some((number, vertices_of(&it.simulation, number)?)));
        let (number, vertices) = found.ok_or_else(|| {
            let text = format!("the scene has no {kind} '{name}'; it has {names:?}");
            Failure::new(Status::NoSuchPart, text)
        })?;
        out.set(PartRow {
            number,
            first_vertex: vertices.start,
            vertex_count: vertices.len(),
        });
        Ok(())
    })
}

/// The body of this name.
///
/// # Safety
/// `name` points to a text that a zero ends, `part` to one entry.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_body(
    simulation: *const SimulationHandle,
    name: *const c_char,
    part: *mut PartRow,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        find_part(
            simulation,
            ("body", Simulation::body_names),
            Simulation::body_vertices,
            name,
            part,
        )
    }
}

/// The cloth of this name.
///
/// # Safety
/// As selvedge_simulation_body.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_cloth(
    simulation: *const SimulationHandle,
    name: *const c_char,
    part: *mut PartRow,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        find_part(
            simulation,
            ("cloth", Simulation::cloth_names),
            Simulation::vertices_of_cloth,
            name,
            part,
        )
    }
}
