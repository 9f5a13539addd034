//! What a simulation can be asked: how much of what, where everything is, what is promised of it.

use super::run::SimulationHandle;
use super::{HandledSimulation, on};
use crate::input::{Out, OutFrame, OutList, Plain, text};
use crate::status::{Failure, Status};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{NearPair, Simulation, vertex_normals};
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

/// A vertex and a face, or two edges, that came near each other in the last step.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NearPairRow {
    /// Vertex and face, or first edge and second edge; bodies' vertices come after the cloth's.
    pub vertices: [u32; 4],
    /// Of each vertex in the way between the closest points: positive on the first side, where they add up to one, negative on the other.
    pub weights: [f64; 4],
    /// From the second side to the first, of length one.
    pub normal: [f64; 3],
    /// How far apart the pair is to be, in metres.
    pub thickness: f64,
}

impl From<NearPair> for NearPairRow {
    fn from(pair: NearPair) -> Self {
        Self {
            vertices: pair.vertices,
            weights: pair.weights,
            normal: pair.normal.to_array(),
            thickness: pair.thickness,
        }
    }
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

/// The list does not have as many entries as there are.
pub(super) fn check_count(what: &str, found: usize, expected: usize) -> Result<(), Failure> {
    if found == expected {
        return Ok(());
    }
    let text = format!("there are {expected} {what}, and {found} were given");
    Err(Failure::new(Status::WrongLength, text))
}

/// Writes what there is to where the caller has room for just that.
///
/// # Safety
/// Unless it is null or misaligned, `start` may be written to until the call ends, three numbers for each of `count`.
unsafe fn copy_rows<S: Plain, I: Iterator<Item = [S; 3]>>(
    simulation: *const SimulationHandle,
    (start, count): (*mut S, usize),
    of: (&str, impl FnOnce(&HandledSimulation) -> (usize, I)),
) -> Status {
    on(simulation, |it| {
        let (what, rows) = of;
        let (expected, rows) = rows(it);
        check_count(what, count, expected)?;
        // SAFETY: the caller's promise.
        unsafe { OutFrame::new(what, start, count) }?.fill(rows);
        Ok(())
    })
}

fn rows(vectors: Vec<DVec3>) -> (usize, impl Iterator<Item = [f64; 3]>) {
    (vectors.len(), vectors.into_iter().map(|it| it.to_array()))
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

/// Copies where all vertices are, in metres. `vertex_count` is that of selvedge_simulation_sizes.
///
/// # Safety
/// `positions` has room for 3 * `vertex_count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_positions(
    simulation: *const SimulationHandle,
    positions: *mut f64,
    vertex_count: usize,
) -> Status {
    let all = |it: &HandledSimulation| rows(it.simulation.positions().to_vec());
    // SAFETY: the caller's promise.
    unsafe { copy_rows(simulation, (positions, vertex_count), ("positions", all)) }
}

/// Copies how fast all vertices move, in m/s.
///
/// # Safety
/// `velocities` has room for 3 * `vertex_count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_velocities(
    simulation: *const SimulationHandle,
    velocities: *mut f64,
    vertex_count: usize,
) -> Status {
    let all = |it: &HandledSimulation| rows(it.simulation.velocities().to_vec());
    // SAFETY: the caller's promise.
    unsafe { copy_rows(simulation, (velocities, vertex_count), ("velocities", all)) }
}

/// Copies which way the surface faces at each vertex: the mean direction of its triangles, weighted by area, of length one; zero
/// where it has none.
///
/// # Safety
/// `normals` has room for 3 * `vertex_count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_normals(
    simulation: *const SimulationHandle,
    normals: *mut f64,
    vertex_count: usize,
) -> Status {
    let all = |it: &HandledSimulation| {
        let mut normals = Vec::new();
        vertex_normals(it.simulation.positions(), it.simulation.triangles(), &mut normals);
        rows(normals)
    };
    // SAFETY: the caller's promise.
    unsafe { copy_rows(simulation, (normals, vertex_count), ("normals", all)) }
}

/// Copies all triangles, three vertex numbers each. No step changes them. `triangle_count` is that of selvedge_simulation_sizes.
///
/// # Safety
/// `triangles` has room for 3 * `triangle_count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_triangles(
    simulation: *const SimulationHandle,
    triangles: *mut u32,
    triangle_count: usize,
) -> Status {
    let all = |it: &HandledSimulation| {
        let triangles = it.simulation.triangles().to_vec();
        (triangles.len(), triangles.into_iter())
    };
    // SAFETY: the caller's promise.
    unsafe { copy_rows(simulation, (triangles, triangle_count), ("triangles", all)) }
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

/// The pairs that came near each other in the last part of the last step, as contact saw them at its start. None without a contact
/// effect.
///
/// `*pairs` is the simulation's, until its near pairs are asked for again, or it is freed.
///
/// # Safety
/// `pairs` points to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_near_pairs(
    simulation: *mut SimulationHandle,
    pairs: *mut *const NearPairRow,
    count: *mut usize,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promises.
        let out = unsafe { OutList::new("pairs", pairs, count) }?;
        let shown = &mut it.answers.near_pairs;
        shown.clear();
        shown.extend(it.simulation.near_pairs().map(NearPairRow::from));
        out.set(shown);
        Ok(())
    })
}
