//! Every query and setting, from C and from Rust.

use super::*;
use crate::answers::{Boxes, ContactRow, IntersectionRow, PairRow, TruncationRow};
use crate::detector::{Handle, selvedge_detector_free};
use crate::settings::*;
use crate::status::Status;
use crate::tests::{geometry_row, last_error, list, new, rows, same, sheet};
use selvedge::core::elementary::Limits;
use selvedge::{
    CandidateBoxes, CollisionDetector, CollisionFilter, ContactGeometry, Criterion, Groups, PairKind, Scalar, Threads, Topology,
};
use std::ptr;

fn narrowed(number: f64) -> S {
    Scalar::from_f64(number)
}

fn frames(number: u32) -> [Vec<[S; 3]>; 2] {
    [number, number + 1].map(|number| sheet::frame(number).into_iter().map(|it| it.map(narrowed)).collect())
}

fn geometries(found: &[ContactGeometry]) -> Vec<crate::answers::GeometryRow> {
    let row = |it: &ContactGeometry| geometry_row(it.kind, it.pair, it.vertices, &it.geometry);
    found.iter().map(row).collect()
}

/// Compares geometries of contacts and near pairs, and truncation, of one step. Returns the number of geometries.
fn ask_both_where(handle: *mut Handle, detector: &mut CollisionDetector<S>, frames: [&[[S; 3]]; 2]) -> [usize; 3] {
    let [start, end] = frames;
    let (mut contacts, mut found) = (Vec::new(), Vec::new());
    detector.contacts(start, end, &mut contacts).unwrap();
    detector.contact_geometries(start, end, &contacts, &mut found).unwrap();
    let (first, last, count) = (start.as_ptr().cast(), end.as_ptr().cast(), start.len());
    let (mut shown, mut shown_count) = (ptr::null(), 0);
    // SAFETY: frames of the mesh, and places for the list.
    let status = unsafe { super::contacts(handle, first, last, count, &raw mut shown, &raw mut shown_count) };
    assert_eq!((status, shown_count), (Status::Ok, contacts.len()));
    // SAFETY: as above; the detector's own list is given back.
    let from_c = list(|to, rows| unsafe { contact_geometries(handle, first, last, count, shown, shown_count, to, rows) });
    same(&from_c, geometries(&found));

    let count_of_contacts = from_c.len();
    let mut count_of_near = 0;
    for distance in [0.0, 0.03125] {
        detector.near(end, narrowed(distance), &mut found).unwrap();
        // SAFETY: as above.
        let from_c = list(|to, rows| unsafe { near(handle, last, count, distance, to, rows) });
        same(&from_c, geometries(&found));
        count_of_near = from_c.len();
    }

    let (mut truncated, mut truncation) = (Vec::new(), TruncationRow::default());
    let nowhere = vec![[narrowed(f64::NAN); 3]; start.len()];
    let (mut elsewhere, mut over_start, mut over_wanted) = (nowhere, start.to_vec(), end.to_vec());
    let (as_start, as_wanted) = (over_start.as_mut_ptr(), over_wanted.as_mut_ptr());
    // The result goes to its own place, and over either of the frames.
    let places = [
        (start.as_ptr(), end.as_ptr(), elsewhere.as_mut_ptr()),
        (as_start.cast_const(), end.as_ptr(), as_start),
        (start.as_ptr(), as_wanted.cast_const(), as_wanted),
    ];
    for (first, wanted, place) in places {
        // The detector has had as many calls, since the order of contacts depends on earlier ones.
        truncation = detector.truncate(start, end, &mut truncated).unwrap().into();
        let mut row = TruncationRow::default();
        // SAFETY: each frame has as many positions as the mesh has vertices.
        let status = unsafe { truncate(handle, first.cast(), wanted.cast(), count, place.cast(), &raw mut row) };
        assert_eq!((status, row), (Status::Ok, truncation));
    }
    let bits = |positions: &[[S; 3]]| {
        positions
            .iter()
            .flatten()
            .map(|number| number.to_f64().to_bits())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        [elsewhere, over_start, over_wanted].map(|it| bits(&it)),
        [(); 3].map(|()| bits(&truncated))
    );
    [count_of_contacts, count_of_near, truncation.held_back]
}

/// Compares all calls on each step of the sheet. Returns the number of contacts.
fn ask_both(handle: *mut Handle, detector: &mut CollisionDetector<S>) -> usize {
    let (mut contacts, mut vf, mut ee, mut total) = (Vec::new(), Vec::new(), Vec::new(), 0);
    let topology = detector.topology().clone();
    for number in 0..4 {
        let frames = frames(number);
        let frames = [&frames[0][..], &frames[1][..]];
        let [start, end] = frames;

        detector.contacts(start, end, &mut contacts).unwrap();
        let (first, last, count) = (start.as_ptr().cast(), end.as_ptr().cast(), start.len());
        // SAFETY: these are frames of the mesh; lists are only written to while they live.
        let from_c = list(|to, rows| unsafe { super::contacts(handle, first, last, count, to, rows) });
        same(&from_c, rows(&contacts, &topology));
        total += contacts.len();

        let known = detector.earliest(start, end).unwrap();
        let (mut found, mut row) = (false, ContactRow::default());
        // SAFETY: as above.
        let status = unsafe { earliest(handle, first, last, count, &raw mut found, &raw mut row) };
        assert_eq!((status, found), (Status::Ok, known.is_some()));
        let from_c = if found { vec![row] } else { Vec::new() };
        same(&from_c, rows(&Vec::from_iter(known), &topology));

        let mut free = false;
        // SAFETY: as above.
        let status = unsafe { is_free(handle, first, last, count, &raw mut free) };
        assert_eq!((status, free), (Status::Ok, detector.is_free(start, end).unwrap()));

        let mut at_rest = Vec::new();
        detector.intersections(end, &mut at_rest).unwrap();
        // SAFETY: as above.
        let from_c = list(|to, rows| unsafe { intersections(handle, last, count, to, rows) });
        same(&from_c, at_rest.iter().map(IntersectionRow::from));
        let mut has_any = false;
        // SAFETY: as above.
        let status = unsafe { has_intersections(handle, last, count, &raw mut has_any) };
        assert_eq!((status, has_any), (Status::Ok, !at_rest.is_empty()));

        for (boxes, number) in [(CandidateBoxes::Moving, Boxes::Moving), (CandidateBoxes::Swept, Boxes::Swept)] {
            detector.candidates(start, end, boxes, &mut vf, &mut ee).unwrap();
            let ([mut at_vf, mut at_ee], [mut vf_count, mut ee_count]) = ([ptr::null(); 2], [0; 2]);
            let (to_vf, to_ee) = ((&raw mut at_vf, &raw mut vf_count), (&raw mut at_ee, &raw mut ee_count));
            // SAFETY: as above.
            let status = unsafe { candidates(handle, first, last, count, number as u32, to_vf.0, to_vf.1, to_ee.0, to_ee.1) };
            assert_eq!(status, Status::Ok);
            for (shown, shown_count, known) in [(at_vf, vf_count, &vf), (at_ee, ee_count, &ee)] {
                let pairs = list(|to, rows| {
                    // SAFETY: places of `list`.
                    unsafe { (*to, *rows) = (shown, shown_count) };
                    Status::Ok
                });
                same(&pairs, known.iter().map(|&pair| PairRow::from(pair)));
            }

            // The detector's own lists are passed back.
            detector.contacts_of(start, end, &vf, &ee, &mut contacts).unwrap();
            // SAFETY: as above; the lists live until the next search for candidates.
            let from_c = list(|to, rows| unsafe {
                contacts_of(handle, first, last, count, at_vf, vf_count, at_ee, ee_count, to, rows)
            });
            same(&from_c, rows(&contacts, &topology));
        }
        ask_both_where(handle, detector, frames);
    }
    total
}

#[test]
fn every_question_in_every_setting() {
    let handle = new(FORMAT);
    let topology = Topology::new(sheet::frame(0).len(), sheet::triangles()).unwrap();
    // SAFETY: the list is written to.
    let edges = list(|start, count| unsafe { selvedge_detector_edges(handle, start, count) });
    same(&edges, topology.edges().iter().map(|&edge| PairRow::from(edge)));

    let mut detector = CollisionDetector::<S>::new(topology);
    let at_first = ask_both(handle, &mut detector);
    assert!(at_first > 100, "{at_first} contacts show little");
    let [start, end] = frames(1);
    let counts = ask_both_where(handle, &mut detector, [&start, &end]);
    assert!(counts.iter().all(|&count| count > 100), "{counts:?} show little");

    let (separation, tolerance) = (narrowed(0.015625), narrowed(0.0009765625));
    let criterion = Criterion::Within(Limits { tolerance, separation });
    detector.set_criterion(criterion).unwrap();
    let status = selvedge_detector_set_within(handle, separation.to_f64(), tolerance.to_f64());
    assert_eq!(status, Status::Ok);
    let within = ask_both(handle, &mut detector);
    assert!(within > at_first);

    detector.set_criterion(Criterion::Touching { tolerance }).unwrap();
    assert_eq!(selvedge_detector_set_touching(handle, tolerance.to_f64()), Status::Ok);
    assert!(ask_both(handle, &mut detector) < within);

    detector.set_threads(Threads::from_count(3)).unwrap();
    assert_eq!(selvedge_detector_set_threads(handle, 3), Status::Ok);
    let mut threads = 0;
    // SAFETY: there is a number.
    assert_eq!(unsafe { selvedge_detector_threads(handle, &raw mut threads) }, Status::Ok);
    assert_eq!(threads, 3);
    ask_both(handle, &mut detector);

    detector.set_coherent(true);
    assert_eq!(selvedge_detector_set_coherent(handle, -1), Status::Ok);
    ask_both(handle, &mut detector);
    detector.set_coherent(false);
    assert_eq!(selvedge_detector_set_coherent(handle, 0), Status::Ok);

    // One half rests.
    let moving: Vec<bool> = sheet::frame(0).iter().map(|position| position[0] < 0.0).collect();
    let bytes: Vec<u8> = moving.iter().map(|&moves| if moves { 7 } else { 0 }).collect();
    detector.set_moving(Some(&moving)).unwrap();
    // SAFETY: the array is as long as the count says.
    let status = unsafe { selvedge_detector_set_moving(handle, bytes.as_ptr(), bytes.len()) };
    assert_eq!(status, Status::Ok);
    ask_both(handle, &mut detector);
    detector.set_moving(None).unwrap();
    // SAFETY: there are no bytes.
    let status = unsafe { selvedge_detector_set_moving(handle, ptr::null(), 0) };
    assert_eq!(status, Status::Ok);
    ask_both(handle, &mut detector);
    assert_eq!(selvedge_detector_free(handle), Status::Ok);
}

/// Tests groups, patches and vertex pairs, one by one and together, and then no filter.
#[test]
fn filters_exclude_what_they_do_in_rust() {
    let handle = new(FORMAT);
    let topology = Topology::new(sheet::frame(0).len(), sheet::triangles()).unwrap();
    let count = topology.vertex_count();
    let vertices = || 0..u32::try_from(count).unwrap();
    let groups: Vec<Groups> = vertices()
        .map(|vertex| Groups::new(1 << (vertex % 3), 0b11 << (vertex % 2)))
        .collect();
    let group_rows: Vec<GroupsRow> = groups
        .iter()
        .map(|&Groups { memberships, filter }| GroupsRow { memberships, filter })
        .collect();
    // The patches are the halves of each of the sheet's rows.
    let patches: Vec<u32> = vertices().map(|vertex| vertex / 8).collect();
    let mut detector = CollisionDetector::<S>::new(topology);
    let all = ask_both(handle, &mut detector);

    // The excluded pairs are all those of one vertex in contact, in either order.
    let [start, end] = frames(2);
    let mut contacts = Vec::new();
    detector.contacts(&start, &end, &mut contacts).unwrap();
    let first = contacts
        .iter()
        .find(|contact| contact.kind == PairKind::VertexFace)
        .expect("a vertex meets a face");
    let [vertex, ..] = detector.topology().vertices_of(first.kind, first.pair);
    let excluded: Vec<[u32; 2]> = vertices()
        .filter(|&other| other != vertex)
        .map(|other| [other, vertex])
        .collect();
    let pairs: Vec<PairRow> = excluded.iter().map(|&pair| pair.into()).collect();

    let mut totals = Vec::new();
    for (has_groups, has_patches, has_pairs) in [
        (true, false, false),
        (false, true, false),
        (false, false, true),
        (true, true, true),
        (false, false, false),
    ] {
        let mut filter = CollisionFilter::new();
        let (mut at_groups, mut at_patches, mut at_pairs) = (ptr::null(), ptr::null(), (ptr::null(), 0));
        if has_groups {
            filter = filter.with_groups(groups.clone());
            at_groups = group_rows.as_ptr();
        }
        if has_patches {
            filter = filter.with_patches(patches.clone());
            at_patches = patches.as_ptr();
        }
        if has_pairs {
            filter = filter.without_vertex_pairs(excluded.clone());
            at_pairs = (pairs.as_ptr(), pairs.len());
        }
        detector.set_collision_filter(filter).unwrap();
        let length = if has_groups || has_patches { count } else { 0 };
        // SAFETY: the arrays are as long as the counts say.
        let status =
            unsafe { selvedge_detector_set_collision_filter(handle, at_groups, at_patches, length, at_pairs.0, at_pairs.1) };
        assert_eq!(status, Status::Ok, "{}", last_error());
        totals.push(ask_both(handle, &mut detector));
    }
    assert!(
        totals[..4].iter().all(|&some| some < all) && totals[4] == all,
        "{totals:?} of {all}"
    );
    assert_eq!(selvedge_detector_free(handle), Status::Ok);
}

