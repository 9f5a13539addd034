//! The sizes, the progress and the parts of a simulation.

use super::on;
use super::run::SimulationHandle;
use crate::input::{Out, text};
use crate::status::{Failure, Status};
use selvedge_cloth::Simulation;
use std::ffi::c_char;
use std::ops::Range;

/// The sizes of a scene. Only tearing changes them. The vertices and triangles of the cloths come first, then those of the
/// bodies, in the order of the scene.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SizesRow {
    /// The number for cloths and bodies together.
    pub vertex_count: usize,
    /// The number for cloths and bodies together.
    pub triangle_count: usize,
    /// The number of vertices of cloth.
    pub cloth_vertex_count: usize,
    /// The number of triangles of cloth.
    pub cloth_triangle_count: usize,
    /// The number of edges without a triangle: ropes, laces and fringes.
    pub loose_edge_count: usize,
    /// The number of cloths; they are numbered from 0.
    pub cloth_count: usize,
    /// The number of bodies; they are numbered from 0.
    pub body_count: usize,
    /// The time step in seconds.
    pub time_step: f64,
    /// The number of steps in the scene's duration. A scene without a `time_step` counts frames.
    pub steps: u64,
    /// The number of steps from one frame to the next.
    pub steps_per_frame: u64,
}

/// The progress of a simulation and the guarantee of its state.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProgressRow {
    /// The number of steps done.
    pub steps_done: u64,
    /// The simulated time in seconds.
    pub time: f64,
    /// The time by which bodies and pins lag behind their keyframes, in seconds.
    pub lag: f64,
    /// The number of steps in which bodies or pins had to wait or were let through.
    pub blocked_steps: u64,
    /// The number of steps after which an edge was more than 5 % above its strain limit: steps that were too long.
    pub overstretched_steps: u64,
    /// The number of pairs without a guarantee, in a scene that tolerates a tangled start.
    pub tolerated_pairs: usize,
    /// True if the state is certified free of the intersections that the scene's contact effects name. It is false without a
    /// contact effect, while a body is let through, and while a tangled start is tolerated.
    pub is_certified: bool,
}

/// The place of a cloth or a body among the others and among the vertices.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PartRow {
    /// Its number among the cloths or the bodies, from 0.
    pub number: usize,
    /// The number of its first vertex.
    pub first_vertex: usize,
    /// The number of its vertices, which are consecutive.
    pub vertex_count: usize,
}

/// Returns the sizes of the scene.
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

/// Returns the progress and whether the state is certified.
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
            overstretched_steps: simulation.overstretched_steps(),
            tolerated_pairs: simulation.tolerated_pairs(),
            is_certified: simulation.is_certified(),
        });
        Ok(())
    })
}

/// # Safety
/// The conditions are those of selvedge_simulation_body.
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
            // A name of the caller's may be long, or have characters that are not shown.
            let short: String = name.chars().take(40).collect();
            let short = short.escape_debug();
            let text = format!("there is no {kind} '{short}'; the scene has {names:?}");
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

/// Finds the body of this name.
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

/// Finds the cloth of this name.
///
/// # Safety
/// The conditions are those of selvedge_simulation_body.
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
