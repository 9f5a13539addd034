//! Calls on worlds.

use super::caller::{Caller, ROOM, VERTICES};
use super::detectors::{contact, frame, rows, triangles};
use selvedge_c::interface::*;
use std::ptr;

/// The largest number of meshes in a world. Steps of more take time and show nothing new.
const MOST_MESHES: usize = 6;

/// A world, and the meshes that it has had.
pub(super) struct Worlds {
    handle: *mut WorldHandle,
    meshes: Vec<MeshNumber>,
}

impl Default for Worlds {
    fn default() -> Self {
        Self {
            handle: ptr::null_mut(),
            meshes: Vec::new(),
        }
    }
}

fn pose(caller: &mut Caller<'_>) -> PoseRow {
    let rotation = match caller.byte() {
        0..200 => [0.0, 0.0, 0.0, 1.0],
        _ => [(); 4].map(|()| caller.number()),
    };
    let origin = match caller.byte() {
        0..128 => [0.0, 0.0, 0.0],
        _ => [(); 3].map(|()| caller.number()),
    };
    PoseRow { rotation, origin }
}

impl Worlds {
    pub(super) fn call(&mut self, caller: &mut Caller<'_>) {
        match caller.byte() % 8 {
            0 => self.make(caller),
            1 => self.set(caller),
            2 | 3 => self.insert(caller),
            4 => self.change(caller),
            5 => self.ask_geometries(caller),
            _ => self.ask(caller),
        }
    }

    pub(super) fn free(&mut self) {
        assert_eq!(selvedge_world_free(self.handle), Status::Ok);
        let again = if self.handle.is_null() {
            Status::Ok
        } else {
            Status::NoSuchWorld
        };
        assert_eq!(selvedge_world_free(self.handle), again);
    }

    fn make(&mut self, caller: &mut Caller<'_>) {
        assert_eq!(selvedge_world_free(self.handle), Status::Ok);
        self.handle = ptr::null_mut();
        // Numbers of the old world's meshes stay, since another world must refuse or know them.
        let scalar = caller.one_of(&[1, 1, 1, 0, 2, u32::MAX]);
        let made = caller.call(ptr::null_mut(), |out, caller| {
            // SAFETY: there is a place for the handle.
            unsafe { selvedge_world_new(scalar, caller.place(out)) }
        });
        self.handle = made.unwrap_or(ptr::null_mut());
    }

    fn set(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&[self.handle]);
        let (number, other) = (caller.number(), caller.number());
        let limit = caller.one_of(&[u64::MAX, 0, 1, 100, 1 << 40]);
        let threads = caller.one_of(&[1, 1, 1, 2, 257, usize::MAX]);
        let which = caller.byte() % 6;
        caller.call((), |_, _| match which {
            0 => selvedge_world_set_threads(handle, threads),
            1 => selvedge_world_set_within(handle, number, other),
            2 => selvedge_world_set_touching(handle, number),
            3 => selvedge_world_set_pair_limit(handle, limit),
            4 => selvedge_world_set_memory_limit(handle, limit),
            _ => selvedge_world_set_cancelled(handle, i32::from(limit == 1)),
        });
    }

    fn insert(&mut self, caller: &mut Caller<'_>) {
        if self.meshes.len() >= MOST_MESHES {
            return;
        }
        let handle = caller.handle(&[self.handle]);
        let (vertex_count, triangle_count) = (caller.count(VERTICES), caller.count(2));
        let (triangles, positions) = (triangles(caller), frame(caller));
        let groups = groups(caller);
        let made = caller.call(0, |out, caller| {
            let (faces, at) = (
                caller.array(&triangles, triangle_count),
                caller.array(&positions, vertex_count),
            );
            let groups = caller.optional(&groups);
            // SAFETY: the arrays have as many entries as any count that is not refused unread.
            unsafe { selvedge_world_insert_f64(handle, vertex_count, faces, triangle_count, at, groups, caller.place(out)) }
        });
        if let Some(mesh) = made {
            assert_ne!(mesh, 0);
            self.meshes.push(mesh);
        }
    }

    /// Returns the number of a mesh that may be there.
    fn mesh(&self, caller: &mut Caller<'_>) -> MeshNumber {
        match caller.byte() {
            250.. => caller.one_of(&[0, 1, u64::MAX, 1 << 32]),
            tag if self.meshes.is_empty() => tag.into(),
            tag => self.meshes[usize::from(tag) % self.meshes.len()],
        }
    }

    fn change(&mut self, caller: &mut Caller<'_>) {
        let (handle, mesh) = (caller.handle(&[self.handle]), self.mesh(caller));
        let groups = groups(caller);
        match caller.byte() % 3 {
            0 => {
                if caller.call((), |_, _| selvedge_world_remove(handle, mesh)).is_some() {
                    self.meshes.retain(|&other| other != mesh);
                    let again = caller.call((), |_, _| selvedge_world_remove(handle, mesh));
                    assert!(again.is_none(), "the mesh is removed twice");
                }
            }
            1 => drop(caller.call((), |_, caller| {
                let at = caller.optional(&groups);
                // SAFETY: there is one entry.
                unsafe { selvedge_world_set_groups(handle, mesh, at) }
            })),
            _ => {
                let edges = caller.call((ptr::null(), 7), |out, caller| {
                    // SAFETY: there are places for the list.
                    unsafe {
                        let (to, count) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                        selvedge_world_edges(handle, mesh, to, count)
                    }
                });
                edges.map(|(start, count)| rows::<PairRow>(start, count));
            }
        }
    }

    fn ask(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&[self.handle]);
        let (start, end) = (frame(caller), frame(caller));
        let deforming = [(); 2].map(|()| {
            let (mesh, vertex_count) = (self.mesh(caller), caller.count(VERTICES));
            Deforming {
                mesh,
                start: caller.array(&start, 1),
                end: end.as_ptr(),
                vertex_count,
            }
        });
        let rigid = [(); 2].map(|()| Rigid {
            mesh: self.mesh(caller),
            start: pose(caller),
            end: pose(caller),
        });
        // A wrong pointer in a row counts only if the row is read.
        let (deforming_count, rigid_count) = (usize::from(caller.byte()) % 3, usize::from(caller.byte()) % 3);
        caller.accept_any_pointer();
        let (moving, turning) = (caller.array(&deforming, deforming_count), caller.array(&rigid, rigid_count));
        // SAFETY: the arrays have as many entries as the counts, frames as many as any count that is not refused unread, and
        // there are places for answers.
        unsafe {
            match caller.byte() % 3 {
                0 => {
                    let found = caller.call((ptr::null(), 7), |out, caller| {
                        let (to, count) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                        selvedge_world_contacts_f64(handle, moving, deforming_count, turning, rigid_count, to, count)
                    });
                    found.map(|(start, count)| rows::<WorldContactRow>(start, count));
                }
                1 => drop(caller.call((false, WorldContactRow::default()), |out, caller| {
                    let (found, contact) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                    selvedge_world_earliest_f64(handle, moving, deforming_count, turning, rigid_count, found, contact)
                })),
                _ => drop(caller.call(false, |out, caller| {
                    selvedge_world_is_free_f64(handle, moving, deforming_count, turning, rigid_count, caller.place(out))
                })),
            }
        }
    }

    fn ask_geometries(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&[self.handle]);
        let contacts = [(); ROOM].map(|()| WorldContactRow {
            meshes: [self.mesh(caller), self.mesh(caller)],
            contact: contact(caller),
        });
        let given = caller.short_count(1);
        let found = caller.call((ptr::null(), 7), |out, caller| {
            let at = caller.array(&contacts, given);
            // SAFETY: the array has as many entries as the count, and there are places for the list.
            unsafe {
                let (to, count) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                selvedge_world_contact_geometries(handle, at, given, to, count)
            }
        });
        if let Some((at, found)) = found {
            assert_eq!(rows::<WorldGeometryRow>(at, found).len(), given);
        }
    }
}

fn groups(caller: &mut Caller<'_>) -> [GroupsRow; 1] {
    [GroupsRow {
        memberships: caller.whole(),
        filter: caller.whole(),
    }]
}
