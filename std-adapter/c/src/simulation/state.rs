//! Copies positions, velocities and meshes into the caller's arrays, and lists near pairs.

use super::on;
use super::run::SimulationHandle;
use crate::files::{ListedMesh, MeshLists};
use crate::input::{Out, OutFrame, OutList, Plain};
use crate::status::{Failure, Status};
use selvedge_cloth::{MeshInFiles, ProximityPair, Simulation, vertex_normals};
use std::borrow::Cow;

/// A vertex and a face, or two edges, that were near each other in the last step.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NearPairRow {
    /// The vertices of the two sides. The vertices of bodies follow those of the cloths.
    pub vertices: [u32; 4],
    /// The weight of each vertex in the vector between the closest points: positive on the first side, where they add up to one,
    /// and negative on the second.
    pub weights: [f64; 4],
    /// The direction from the second side to the first, of length one.
    pub normal: [f64; 3],
    /// The distance that contact keeps between the two, in metres.
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

/// Checks that a list has the expected number of entries.
pub(super) fn check_count(what: &str, found: usize, expected: usize) -> Result<(), Failure> {
    if found == expected {
        return Ok(());
    }
    let text = format!("there are {expected} {what}, and {found} were given");
    Err(Failure::new(Status::WrongLength, text))
}

/// Writes all rows to the caller's array, which must have exactly their number. An empty list needs no array.
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

/// Copies the positions of all vertices, in metres. `vertex_count` is that of selvedge_simulation_sizes.
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

/// Copies the velocities of all vertices, in m/s.
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

/// Copies the normal of the surface at each vertex: the mean of its triangles' normals, weighted by area, of length one. It is
/// zero for a vertex without a surface.
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

/// Copies all triangles, three vertex numbers each. Only tearing changes them; it also adds vertices, and
/// selvedge_simulation_sizes then returns new counts. `triangle_count` is that of selvedge_simulation_sizes.
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

/// Copies all loose edges (ropes, laces and fringes), two vertex numbers each. Only tearing changes them. `loose_edge_count` is
/// that of selvedge_simulation_sizes.
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

/// Returns the near pairs at the start of the last part of the last step. There are none without a contact effect.
///
/// The list belongs to the simulation. It stays valid until the next call of this function, or until the simulation is freed.
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

/// Returns the state as one mesh in which cloths from files have the vertices and faces of their files: each cloth, then the
/// bodies. Vertices that `weld` merged are apart again, those that the cloth does not have stay where the file puts them, and
/// copies that tears made follow those of the file. `*number_of` receives a list with the number in this mesh of each of the
/// simulation's vertices.
///
/// The lists belong to the simulation. They stay valid until the next call of this function, or until the simulation is freed.
///
/// # Safety
/// `mesh` points to one entry, `number_of` to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_mesh_in_files(
    simulation: *mut SimulationHandle,
    mesh: *mut MeshLists,
    number_of: *mut *const u32,
    count: *mut usize,
) -> Status {
    on(simulation, |it| {
        // SAFETY: the caller's promises.
        let (lists, numbers) = unsafe { (Out::new("mesh", mesh)?, OutList::new("number_of", number_of, count)?) };
        let MeshInFiles {
            mesh,
            loose_edges,
            number_of,
            ..
        } = it.simulation.mesh_in_files();
        it.answers.in_files = ListedMesh::new(mesh, loose_edges, Vec::new());
        it.answers.number_of = number_of;
        lists.set(it.answers.in_files.lists());
        numbers.set(&it.answers.number_of);
        Ok(())
    })
}
