//! The functions for positions in double. `build.rs` makes those for float from this file.

use crate::input::{Out, OutList};
use crate::settings::GroupsRow;
use crate::status::Status;
use crate::world::steps::{Deforming, Query, Rigid, WorldContactRow};
use crate::world::{Inserted, MeshNumber, WorldHandle};

/// Inserts a mesh that rests at these positions. `*mesh` receives its number.
///
/// `groups` says which meshes it can collide with, itself included; NULL means all. Triangles and positions are copied. Edges and
/// points of ropes, hair and particles are triangles that name a vertex twice or three times, as for a detector.
///
/// # Safety
/// `triangles` points to 3 * `triangle_count` vertex numbers, `positions` to 3 * `vertex_count` numbers, `groups` to one entry
/// unless it is NULL, `mesh` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_insert_f64(
    world: *mut WorldHandle,
    vertex_count: usize,
    triangles: *const u32,
    triangle_count: usize,
    positions: *const f64,
    groups: *const GroupsRow,
    mesh: *mut MeshNumber,
) -> Status {
    let inserted = Inserted {
        vertex_count,
        triangles: (triangles, triangle_count),
        positions,
        groups,
        mesh,
    };
    // SAFETY: the caller's promises.
    unsafe { inserted.into(world) }
}

/// Finds all contacts of a step in which the given meshes move. Each mesh is given at most once. All other meshes rest where
/// their last motion ended.
///
/// The list stays valid until the next search for contacts in this world, or until the world is freed. An empty list is at NULL.
/// A refused call changes nothing; for a cancelled one see selvedge_world_set_cancelled.
///
/// # Safety
/// `deforming` and `rigid` point to as many entries as their counts say, each frame to 3 * `vertex_count` numbers, `contacts` to
/// a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_contacts_f64(
    world: *mut WorldHandle,
    deforming: *const Deforming<f64>,
    deforming_count: usize,
    rigid: *const Rigid,
    rigid_count: usize,
    contacts: *mut *const WorldContactRow,
    count: *mut usize,
) -> Status {
    let query = Query::new(world, (deforming, deforming_count), (rigid, rigid_count));
    // SAFETY: the caller's promises.
    unsafe {
        query.run(|finder, answers, motions| {
            let out = OutList::new("contacts", contacts, count)?;
            finder.world.contacts(motions, &mut finder.contacts)?;
            answers.contacts.clear();
            let rows = finder
                .contacts
                .iter()
                .map(|contact| WorldContactRow::new(contact, &finder.world));
            answers.contacts.extend(rows);
            out.set(&answers.contacts);
            Ok(())
        })
    }
}

/// Finds the earliest contact of such a step. The step is free of contact before its time.
///
/// `*found` says whether there is one. If not, the whole step is free, and `*contact` stays unchanged.
///
/// # Safety
/// The conditions are those of selvedge_world_contacts_f64; `found` and `contact` point to one value each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_earliest_f64(
    world: *mut WorldHandle,
    deforming: *const Deforming<f64>,
    deforming_count: usize,
    rigid: *const Rigid,
    rigid_count: usize,
    found: *mut bool,
    contact: *mut WorldContactRow,
) -> Status {
    let query = Query::new(world, (deforming, deforming_count), (rigid, rigid_count));
    // SAFETY: the caller's promises.
    unsafe {
        query.run(|finder, _, motions| {
            let (found, out) = (Out::new("found", found)?, Out::new("contact", contact)?);
            let earliest = finder.world.earliest(motions)?;
            found.set(earliest.is_some());
            if let Some(earliest) = earliest {
                out.set(WorldContactRow::new(&earliest, &finder.world));
            }
            Ok(())
        })
    }
}

/// Decides whether such a step is certainly free of contact.
///
/// # Safety
/// The conditions are those of selvedge_world_contacts_f64; `is_free` points to one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_is_free_f64(
    world: *mut WorldHandle,
    deforming: *const Deforming<f64>,
    deforming_count: usize,
    rigid: *const Rigid,
    rigid_count: usize,
    is_free: *mut bool,
) -> Status {
    let query = Query::new(world, (deforming, deforming_count), (rigid, rigid_count));
    // SAFETY: the caller's promises.
    unsafe {
        query.run(|finder, _, motions| {
            let out = Out::new("is_free", is_free)?;
            out.set(finder.world.is_free(motions)?);
            Ok(())
        })
    }
}
