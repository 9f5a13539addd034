//! C's functions for worlds, beside the world itself.

use super::double::*;
use super::single::*;
use super::steps::*;
use super::*;
use crate::answers::{ContactRow, GeometryRow, Kind};
use crate::status::{Status, selvedge_last_error};
use crate::tests::sheet;
use selvedge::glam::{DQuat, DVec3};
use selvedge::{MeshMotion, PairKind, Topology};
use std::ffi::CStr;
use std::{ptr, slice};

fn last_error() -> String {
    // SAFETY: the text ends with a zero and belongs to this thread, which calls nothing meanwhile.
    unsafe { CStr::from_ptr(selvedge_last_error()) }.to_str().unwrap().to_owned()
}

type OutPair<T> = (*mut *const T, *mut usize);

/// The functions for a format, called as C does.
trait ForC: Format {
    const FORMAT: ScalarFormat;
    fn from_double(value: f64) -> Self;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn insert(world: *mut WorldHandle, at: &[[Self; 3]], triangles: &[[u32; 3]], groups: Option<GroupsRow>) -> Mesh;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn contacts(world: *mut WorldHandle, moving: (&[Deforming<Self>], &[Rigid]), out: OutPair<WorldContactRow>) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn earliest(
        world: *mut WorldHandle,
        moving: (&[Deforming<Self>], &[Rigid]),
        found: *mut bool,
        out: *mut WorldContactRow,
    ) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn is_free(world: *mut WorldHandle, moving: (&[Deforming<Self>], &[Rigid]), out: *mut bool) -> Status;
}

fn deforming<S>(mesh: Mesh, start: &[[S; 3]], end: &[[S; 3]]) -> Deforming<S> {
    Deforming {
        mesh,
        start: start.as_ptr().cast(),
        end: end.as_ptr().cast(),
        vertex_count: start.len(),
    }
}

macro_rules! for_c {
    ($scalar:ident = $format:ident: $insert:ident, $contacts:ident, $earliest:ident, $is_free:ident) => {
        impl ForC for $scalar {
            const FORMAT: ScalarFormat = ScalarFormat::$format;
            fn from_double(value: f64) -> Self {
                value as Self
            }
            unsafe fn insert(
                world: *mut WorldHandle,
                at: &[[Self; 3]],
                triangles: &[[u32; 3]],
                groups: Option<GroupsRow>,
            ) -> Mesh {
                let mut mesh = 0;
                let groups = groups.as_ref().map_or(ptr::null(), ptr::from_ref);
                let (faces, positions) = (triangles.as_ptr().cast(), at.as_ptr().cast());
                // SAFETY: the caller's promise.
                let status = unsafe {
                    $insert(
                        world,
                        at.len(),
                        faces,
                        triangles.len(),
                        positions,
                        groups,
                        &raw mut mesh,
                    )
                };
                assert_eq!(status, Status::Ok, "{}", last_error());
                mesh
            }
            unsafe fn contacts(
                world: *mut WorldHandle,
                (deforming, rigid): (&[Deforming<Self>], &[Rigid]),
                out: OutPair<WorldContactRow>,
            ) -> Status {
                let (some, others) = (deforming.as_ptr(), rigid.as_ptr());
                // SAFETY: the caller's promise.
                unsafe { $contacts(world, some, deforming.len(), others, rigid.len(), out.0, out.1) }
            }
            unsafe fn earliest(
                world: *mut WorldHandle,
                (deforming, rigid): (&[Deforming<Self>], &[Rigid]),
                found: *mut bool,
                out: *mut WorldContactRow,
            ) -> Status {
                let (some, others) = (deforming.as_ptr(), rigid.as_ptr());
                // SAFETY: the caller's promise.
                unsafe { $earliest(world, some, deforming.len(), others, rigid.len(), found, out) }
            }
            unsafe fn is_free(
                world: *mut WorldHandle,
                (deforming, rigid): (&[Deforming<Self>], &[Rigid]),
                out: *mut bool,
            ) -> Status {
                let (some, others) = (deforming.as_ptr(), rigid.as_ptr());
                // SAFETY: the caller's promise.
                unsafe { $is_free(world, some, deforming.len(), others, rigid.len(), out) }
            }
        }
    };
}
for_c!(
    f64 = F64: selvedge_world_insert_f64,
    selvedge_world_contacts_f64,
    selvedge_world_earliest_f64,
    selvedge_world_is_free_f64
);
for_c!(
    f32 = F32: selvedge_world_insert_f32,
    selvedge_world_contacts_f32,
    selvedge_world_earliest_f32,
    selvedge_world_is_free_f32
);

/// Returns a list that the library shows.
fn list<T: Copy>(ask: impl FnOnce(OutPair<T>) -> Status) -> Vec<T> {
    let (mut start, mut count) = (ptr::null(), 0);
    let status = ask((&raw mut start, &raw mut count));
    assert_eq!(status, Status::Ok, "{}", last_error());
    match count {
        0 => Vec::new(),
        // SAFETY: the list is valid until the next call.
        _ => unsafe { slice::from_raw_parts(start, count) }.to_vec(),
    }
}

fn kind(kind: PairKind) -> u32 {
    match kind {
        PairKind::VertexFace => Kind::VertexFace as u32,
        PairKind::EdgeEdge => Kind::EdgeEdge as u32,
    }
}

fn row<S: Scalar>(contact: &WorldContact<S>, world: &World<[S; 3]>) -> WorldContactRow {
    WorldContactRow {
        meshes: contact.meshes.map(MeshHandle::to_bits),
        contact: ContactRow {
            time: contact.time.to_f64(),
            kind: kind(contact.kind),
            pair: contact.pair.into(),
            vertices: world.vertices_of(contact).unwrap(),
        },
    }
}

fn geometry(found: &WorldContactGeometry) -> WorldGeometryRow {
    let it = &found.geometry;
    WorldGeometryRow {
        meshes: found.meshes.map(MeshHandle::to_bits),
        geometry: GeometryRow {
            kind: kind(found.kind),
            pair: found.pair.into(),
            vertices: found.vertices,
            has_normal: it.normal.is_some(),
            weights: it.weights,
            points: it.points.map(|point| point.to_array()),
            normal: it.normal.unwrap_or_default().to_array(),
            separated_at: it.separated_at,
            distance: it.distance,
            speed: it.speed,
        },
    }
}

/// Asserts equality to the last bit: none of the values is NaN, and every digit of a number is printed.
fn same<T: PartialEq + std::fmt::Debug>(a: &[T], b: &[T]) {
    assert_eq!(a, b);
    assert_eq!(format!("{a:?}"), format!("{b:?}"), "but for the sign of a zero");
}

fn pose((rotation, origin): (DQuat, DVec3)) -> Pose {
    Pose {
        rotation: rotation.to_array(),
        origin: origin.to_array(),
    }
}

/// Moves a sheet that folds onto itself, a plank that spins through it, and a floor that goes away.
fn a_story_is_told_as_in_rust<S: ForC>() {
    let mut handle = ptr::null_mut();
    // SAFETY: there is a place for it.
    assert_eq!(unsafe { selvedge_world_new(S::FORMAT as u32, &raw mut handle) }, Status::Ok);
    let mut world = World::<[S; 3]>::new();
    let narrowed = |points: &[[f64; 3]]| -> Vec<[S; 3]> { points.iter().map(|it| it.map(S::from_double)).collect() };
    let sheet = |number| narrowed(&sheet::frame(number));
    let plank = narrowed(&[[-2.0, -0.1, 0.0], [2.0, -0.1, 0.0], [2.0, 0.1, 0.0], [-2.0, 0.1, 0.0]]);
    let floor = narrowed(&[[-9.0, -9.0, -0.25], [9.0, -9.0, -0.25], [0.0, 9.0, -0.25]]);
    let meshes = [
        (sheet(0), sheet::triangles(), Groups::ALL),
        (plank, vec![[0, 1, 2], [0, 2, 3]], Groups::new(2, 1)),
        (floor, vec![[0, 1, 2]], Groups::ALL),
    ];
    let mut handles = Vec::new();
    for (positions, triangles, groups) in &meshes {
        let topology = Topology::new(positions.len(), triangles.clone()).unwrap();
        let made = world.insert(topology, positions, *groups).unwrap();
        let row = GroupsRow {
            memberships: groups.memberships,
            filter: groups.filter,
        };
        let row = (*groups != Groups::ALL).then_some(row);
        // SAFETY: the arrays are as long as the counts say.
        let from_c = unsafe { S::insert(handle, positions, triangles, row) };
        assert_eq!(from_c, made.to_bits());
        // SAFETY: the list is written to.
        let edges = list(|(start, count)| unsafe { selvedge_world_edges(handle, from_c, start, count) });
        let known = world.topology(made).unwrap().edges();
        assert_eq!(edges, known.iter().map(|&edge| edge.into()).collect::<Vec<Pair>>());
        handles.push(made);
    }
    let [cloth, plank, floor] = handles[..] else { unreachable!() };

    let (separation, tolerance) = (S::from_double(0.015625), S::from_double(0.0009765625));
    let mut totals = Vec::new();
    for (setting, number) in [0, 1, 2, 3, 0, 1].into_iter().enumerate() {
        match setting {
            1 => {
                world
                    .set_criterion(Criterion::Within(Limits { tolerance, separation }))
                    .unwrap();
                assert_eq!(
                    selvedge_world_set_within(handle, separation.to_f64(), tolerance.to_f64()),
                    Status::Ok
                );
            }
            2 => {
                world.set_criterion(Criterion::Touching { tolerance }).unwrap();
                assert_eq!(selvedge_world_set_touching(handle, tolerance.to_f64()), Status::Ok);
            }
            3 => {
                world.set_threads(Threads::from_count(2)).unwrap();
                assert_eq!(selvedge_world_set_threads(handle, 2), Status::Ok);
            }
            4 => {
                let groups = Groups::ALL;
                world.set_groups(plank, groups).unwrap();
                // SAFETY: there are no groups.
                let status = unsafe { selvedge_world_set_groups(handle, plank.to_bits(), ptr::null()) };
                assert_eq!(status, Status::Ok);
            }
            5 => {
                world.remove(floor).unwrap();
                assert_eq!(selvedge_world_remove(handle, floor.to_bits()), Status::Ok);
                assert_eq!(selvedge_world_remove(handle, floor.to_bits()), Status::NoSuchMesh);
            }
            _ => {}
        }
        let (start, end) = (sheet(number), sheet(number + 1));
        let turned = |angle: f64| (DQuat::from_rotation_y(angle), DVec3::new(0.0, 0.0, 0.125));
        let poses = [turned(0.5 * setting as f64), turned(0.5 * setting as f64 + 0.5)];
        let motions = [
            (
                cloth,
                MeshMotion::Deforming {
                    start: &start,
                    end: &end,
                },
            ),
            (
                plank,
                MeshMotion::Rigid {
                    start: poses[0],
                    end: poses[1],
                },
            ),
        ];
        let deforming = [deforming(cloth.to_bits(), &start, &end)];
        let rigid = [Rigid {
            mesh: plank.to_bits(),
            start: pose(poses[0]),
            end: pose(poses[1]),
        }];

        let mut contacts = Vec::new();
        world.contacts(&motions, &mut contacts).unwrap();
        // SAFETY: these are frames of the mesh; lists are only written to while they live.
        let from_c = list(|out| unsafe { S::contacts(handle, (&deforming, &rigid), out) });
        same(
            &from_c,
            &contacts.iter().map(|contact| row(contact, &world)).collect::<Vec<_>>(),
        );
        totals.push(contacts.len());

        let earliest = world.earliest(&motions).unwrap();
        let (mut found, mut told) = (false, WorldContactRow::default());
        // SAFETY: as above.
        let status = unsafe { S::earliest(handle, (&deforming, &rigid), &raw mut found, &raw mut told) };
        assert_eq!((status, found), (Status::Ok, earliest.is_some()));
        let known: Vec<_> = earliest.iter().map(|contact| row(contact, &world)).collect();
        same(if found { slice::from_ref(&told) } else { &[] }, &known);

        let mut is_free = true;
        // SAFETY: as above.
        let status = unsafe { S::is_free(handle, (&deforming, &rigid), &raw mut is_free) };
        assert_eq!((status, is_free), (Status::Ok, world.is_free(&motions).unwrap()));

        let mut geometries = Vec::new();
        world.contact_geometries(&contacts, &mut geometries).unwrap();
        // SAFETY: as above.
        let shown = list(|(start, count)| unsafe {
            selvedge_world_contact_geometries(handle, from_c.as_ptr(), from_c.len(), start, count)
        });
        same(&shown, &geometries.iter().map(geometry).collect::<Vec<_>>());
    }
    assert!(totals.iter().all(|&count| count > 20), "{totals:?} show little");
    assert_eq!(selvedge_world_free(handle), Status::Ok);
}

#[test]
fn a_world_of_double_tells_what_it_does_in_rust_bit_for_bit() {
    a_story_is_told_as_in_rust::<f64>();
}

#[test]
fn a_world_of_float_tells_what_it_does_in_rust_bit_for_bit() {
    a_story_is_told_as_in_rust::<f32>();
}

#[test]
fn a_panic_breaks_its_world_and_no_detectors_handle_names_a_world() {
    let [mut broken, mut other] = [ptr::null_mut(); 2];
    for handle in [&mut broken, &mut other] {
        // SAFETY: there is a place for it.
        assert_eq!(unsafe { selvedge_world_new(0, handle) }, Status::Ok);
    }
    assert_eq!(on(broken, |_| panic!("on purpose")), Status::Internal);
    assert_eq!(selvedge_world_set_pair_limit(broken, 1), Status::Internal);
    assert!(last_error().contains("only be freed"), "{}", last_error());
    assert_eq!(selvedge_world_set_pair_limit(other, 1), Status::Ok);
    let as_detector = other.cast();
    assert_eq!(crate::detector::selvedge_detector_free(as_detector), Status::NoSuchDetector);
    assert_eq!(selvedge_world_free(broken), Status::Ok);
    assert_eq!(selvedge_world_free(broken), Status::NoSuchWorld);
    assert_eq!(selvedge_world_free(other), Status::Ok);
}
