//! Where everything is, copied to where the caller has room; what came near what.

use super::on;
use super::run::SimulationHandle;
use crate::input::{OutFrame, OutList, Plain};
use crate::status::{Failure, Status};
use selvedge_cloth::{ProximityPair, Simulation, vertex_normals};
use std::borrow::Cow;

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

impl From<ProximityPair> for NearPairRow {
    fn from(pair: ProximityPair) -> Self {
        Self {
            vertices: pair.vertices,
            weights: pair.weights,
            normal: pair.normal.to_array(),
            thickness: pair.thickness,
        }
    }
}

/// The list does not have as many entries as there are.
pub(super) fn check_count(what: &str, found: usize, expected: usize) -> Result<(), Failure> {
    if found == expected {
        return Ok(());
    }
    let text = format!("there are {expected} {what}, and {found} were given");
    Err(Failure::new(Status::WrongLength, text))
}

/// Writes what there is to where the caller has room for just that: anywhere if there is nothing.
///
/// # Safety
/// Unless it is null or misaligned, `start` may be written to until the call ends, N numbers for each of `count`.
unsafe fn copy_rows<S: Plain, T: Copy + Into<[S; N]>, const N: usize>(
    simulation: *const SimulationHandle,
    (what, start, count): (&str, *mut S, usize),
    all: fn(&Simulation) -> Cow<'_, [T]>,
) -> Status {
    on(simulation, |it| {
        let rows = all(&it.simulation);
        check_count(what, count, rows.len())?;
        if rows.is_empty() {
            return Ok(());
        }
        // SAFETY: the caller's promise.
        unsafe { OutFrame::new(what, start, count) }?.fill(rows.iter().map(|&row| row.into()));
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
    // SAFETY: the caller's promise.
    unsafe { copy_rows(simulation, ("positions", positions, vertex_count), |it| it.positions().into()) }
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
    // SAFETY: the caller's promise.
    unsafe {
        copy_rows(simulation, ("velocities", velocities, vertex_count), |it| {
            it.velocities().into()
        })
    }
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
    let all = |it: &Simulation| {
        let mut normals = Vec::new();
        vertex_normals(it.positions(), it.triangles(), &mut normals);
        normals.into()
    };
    // SAFETY: the caller's promise.
    unsafe { copy_rows(simulation, ("normals", normals, vertex_count), all) }
}

/// Copies all triangles, three vertex numbers each. A step changes them only where cloth tears: then there are more vertices as well, and
/// selvedge_simulation_sizes has new counts. `triangle_count` is that of selvedge_simulation_sizes.
///
/// # Safety
/// `triangles` has room for 3 * `triangle_count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_triangles(
    simulation: *const SimulationHandle,
    triangles: *mut u32,
    triangle_count: usize,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        copy_rows(simulation, ("triangles", triangles, triangle_count), |it| {
            it.triangles().into()
        })
    }
}

/// Copies all loose edges, of ropes, laces and fringes: two vertex numbers each. A step changes them only where cloth tears.
/// `loose_edge_count` is that of selvedge_simulation_sizes.
///
/// # Safety
/// `loose_edges` has room for 2 * `loose_edge_count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_loose_edges(
    simulation: *const SimulationHandle,
    loose_edges: *mut u32,
    loose_edge_count: usize,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        copy_rows(simulation, ("loose edges", loose_edges, loose_edge_count), |it| {
            it.loose_edges().into()
        })
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
