//! A story in C and in Rust: both must have the same results.

use super::*;
use crate::answers::PairRow;
use crate::settings::GroupsRow;
use crate::status::Status;
use crate::tests::{contact_row, geometry_row, last_error, list, same, sheet};
use crate::world::steps::*;
use crate::world::*;
use selvedge::core::elementary::Limits;
use selvedge::glam::{DQuat, DVec3};
use selvedge::{Criterion, Groups, MeshHandle, MeshMotion, Scalar, Threads, Topology, World, WorldContact, WorldContactGeometry};
use std::ptr;

fn row(contact: &WorldContact<S>, world: &World<[S; 3]>) -> WorldContactRow {
    WorldContactRow {
        meshes: contact.meshes.map(MeshHandle::to_bits),
        contact: contact_row(contact.kind, contact.pair, world.vertices_of(contact).unwrap(), contact.time),
    }
}

fn geometry(found: &WorldContactGeometry) -> WorldGeometryRow {
    WorldGeometryRow {
        meshes: found.meshes.map(MeshHandle::to_bits),
        geometry: geometry_row(found.kind, found.pair, found.vertices, &found.geometry),
    }
}

fn pose((rotation, origin): (DQuat, DVec3)) -> PoseRow {
    PoseRow {
        rotation: rotation.to_array(),
        origin: origin.to_array(),
    }
}

/// A world in C and the same in Rust.
struct Twin {
    handle: *mut WorldHandle,
    world: World<[S; 3]>,
}

/// The motion of one deforming mesh and of one body.
struct Step<'a> {
    cloth: MeshHandle,
    frames: [&'a [[S; 3]]; 2],
    plank: MeshHandle,
    poses: [(DQuat, DVec3); 2],
}

impl Twin {
    fn new() -> Self {
        let mut handle = ptr::null_mut();
        // SAFETY: there is a place for it.
        assert_eq!(unsafe { selvedge_world_new(FORMAT as u32, &raw mut handle) }, Status::Ok);
        Self {
            handle,
            world: World::new(),
        }
    }

    fn insert(&mut self, positions: &[[S; 3]], triangles: &[[u32; 3]], groups: Groups) -> MeshHandle {
        let topology = Topology::new(positions.len(), triangles.to_vec()).unwrap();
        let made = self.world.insert(topology, positions, groups).unwrap();
        let row = GroupsRow {
            memberships: groups.memberships,
            filter: groups.filter,
        };
        let row = if groups == Groups::ALL { ptr::null() } else { &raw const row };
        let (at, faces, mut from_c) = (positions.as_ptr().cast(), triangles.as_ptr().cast(), 0);
        // SAFETY: the arrays are as long as the counts say.
        let status = unsafe { insert(self.handle, positions.len(), faces, triangles.len(), at, row, &raw mut from_c) };
        assert_eq!((status, from_c), (Status::Ok, made.to_bits()), "{}", last_error());
        // SAFETY: the list is written to.
        let edges = list(|start, count| unsafe { selvedge_world_edges(self.handle, from_c, start, count) });
        same(&edges, self.world.topology(made).unwrap().edges().iter().map(|&edge| PairRow::from(edge)));
        made
    }

    fn change(&mut self, setting: usize, plank: MeshHandle, floor: MeshHandle) {
        let (separation, tolerance) = (Scalar::from_f64(0.015625), Scalar::from_f64(0.0009765625));
        let (handle, world) = (self.handle, &mut self.world);
        let status = match setting {
            1 => {
                let limits = Limits { tolerance, separation };
                world.set_criterion(Criterion::Within(limits)).unwrap();
                selvedge_world_set_within(handle, separation.to_f64(), tolerance.to_f64())
            }
            2 => {
                world.set_criterion(Criterion::Touching { tolerance }).unwrap();
                selvedge_world_set_touching(handle, tolerance.to_f64())
            }
            3 => {
                world.set_threads(Threads::from_count(2)).unwrap();
                selvedge_world_set_threads(handle, 2)
            }
            4 => {
                world.set_groups(plank, Groups::ALL).unwrap();
                // SAFETY: there are no groups.
                unsafe { selvedge_world_set_groups(handle, plank.to_bits(), ptr::null()) }
            }
            5 => {
                world.remove(floor).unwrap();
                assert_eq!(selvedge_world_remove(handle, floor.to_bits()), Status::Ok);
                assert_eq!(selvedge_world_remove(handle, floor.to_bits()), Status::NoSuchMesh);
                Status::Ok
            }
            _ => Status::Ok,
        };
        assert_eq!(status, Status::Ok);
    }

    /// Checks that all answers about a step are the same. Returns the number of contacts.
    fn step(&mut self, step: &Step<'_>) -> usize {
        let (handle, world) = (self.handle, &mut self.world);
        let ([start, end], [first, last]) = (step.frames, step.poses);
        let motions = [
            (step.cloth, MeshMotion::Deforming { start, end }),
            (step.plank, MeshMotion::Rigid { start: first, end: last }),
        ];
        let deforming = Deforming {
            mesh: step.cloth.to_bits(),
            start: start.as_ptr().cast(),
            end: end.as_ptr().cast(),
            vertex_count: start.len(),
        };
        let rigid = Rigid {
            mesh: step.plank.to_bits(),
            start: pose(first),
            end: pose(last),
        };
        let (deforming, rigid) = (&raw const deforming, &raw const rigid);

        let mut found = Vec::new();
        world.contacts(&motions, &mut found).unwrap();
        // SAFETY: these are frames of the mesh; lists are only written to while they live.
        let from_c = list(|to, rows| unsafe { contacts(handle, deforming, 1, rigid, 1, to, rows) });
        same(&from_c, found.iter().map(|contact| row(contact, world)));

        let known = world.earliest(&motions).unwrap();
        let (mut is_any, mut shown) = (false, WorldContactRow::default());
        // SAFETY: as above.
        let status = unsafe { earliest(handle, deforming, 1, rigid, 1, &raw mut is_any, &raw mut shown) };
        assert_eq!((status, is_any), (Status::Ok, known.is_some()));
        same(if is_any { std::slice::from_ref(&shown) } else { &[] }, known.iter().map(|contact| row(contact, world)));

        let mut free = true;
        // SAFETY: as above.
        let status = unsafe { is_free(handle, deforming, 1, rigid, 1, &raw mut free) };
        assert_eq!((status, free), (Status::Ok, world.is_free(&motions).unwrap()));

        let mut geometries = Vec::new();
        world.contact_geometries(&found, &mut geometries).unwrap();
        // SAFETY: as above.
        let shown = list(|to, rows| unsafe { selvedge_world_contact_geometries(handle, from_c.as_ptr(), from_c.len(), to, rows) });
        same(&shown, geometries.iter().map(geometry));
        found.len()
    }
}

/// Moves a sheet that folds onto itself, a plank that spins through it, and a floor that goes away.
#[test]
fn a_story_has_the_results_of_rust() {
    let narrowed = |points: &[[f64; 3]]| -> Vec<[S; 3]> { points.iter().map(|it| it.map(<S as Scalar>::from_f64)).collect() };
    let sheet = |number| narrowed(&sheet::frame(number));
    let plank = narrowed(&[[-2.0, -0.1, 0.0], [2.0, -0.1, 0.0], [2.0, 0.1, 0.0], [-2.0, 0.1, 0.0]]);
    let floor = narrowed(&[[-9.0, -9.0, -0.25], [9.0, -9.0, -0.25], [0.0, 9.0, -0.25]]);
    let mut twin = Twin::new();
    let cloth = twin.insert(&sheet(0), &sheet::triangles(), Groups::ALL);
    let plank = twin.insert(&plank, &[[0, 1, 2], [0, 2, 3]], Groups::new(2, 1));
    let floor = twin.insert(&floor, &[[0, 1, 2]], Groups::ALL);
    let mut totals = Vec::new();
    for (setting, number) in [0, 1, 2, 3, 0, 1].into_iter().enumerate() {
        twin.change(setting, plank, floor);
        let (start, end) = (sheet(number), sheet(number + 1));
        let turned = |angle: f64| (DQuat::from_rotation_y(angle), DVec3::new(0.0, 0.0, 0.125));
        totals.push(twin.step(&Step {
            cloth,
            frames: [&start, &end],
            plank,
            poses: [turned(0.5 * setting as f64), turned(0.5 * setting as f64 + 0.5)],
        }));
    }
    assert!(totals.iter().all(|&count| count > 20), "{totals:?} show little");
    assert_eq!(selvedge_world_free(twin.handle), Status::Ok);
}
