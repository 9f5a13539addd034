//! C's functions, called as C does, beside the detector itself. `tests/interface/programs.rs` tests programs in C and C++.

use crate::answers::{Boxes, ContactRow, GeometryRow, IntersectionRow, Kind, Pair, TruncationRow};
use crate::detector::{Handle, ScalarFormat, on, selvedge_detector_free, selvedge_detector_new, selvedge_detector_set_cancelled};
use crate::questions::{double::*, single::*};
use crate::settings::*;
use crate::status::{Status, selvedge_last_error, selvedge_status_string};
use selvedge::core::elementary::Limits;
use selvedge::{
    CandidateBoxes, CollisionDetector, CollisionFilter, Contact, ContactGeometry, Criterion, Groups, PairKind, Scalar, Threads,
    Topology,
};
use std::ffi::CStr;
use std::fmt::Debug;
use std::ptr;

#[path = "../tests/sheet/mod.rs"]
pub(crate) mod sheet;

fn last_error() -> String {
    // SAFETY: the text ends with a zero and belongs to this thread, which calls nothing meanwhile.
    unsafe { CStr::from_ptr(selvedge_last_error()) }.to_str().unwrap().to_owned()
}

fn new(format: ScalarFormat) -> *mut Handle {
    let triangles = sheet::triangles();
    let vertex_count = sheet::frame(0).len();
    let mut handle = ptr::null_mut();
    // SAFETY: the array is as long as the count says.
    let status = unsafe {
        let start = triangles.as_ptr().cast();
        selvedge_detector_new(format as u32, vertex_count, start, triangles.len(), &raw mut handle)
    };
    assert_eq!(status, Status::Ok, "{}", last_error());
    handle
}

type OutPair<T> = (*mut *const T, *mut usize);
type InPairs = (*const Pair, usize);

/// The functions for one format.
trait ForC: Scalar {
    const FORMAT: ScalarFormat;
    fn from_double(value: f64) -> Self;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn contacts(on: *mut Handle, frames: [&[[Self; 3]]; 2], out: OutPair<ContactRow>) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn contacts_of(on: *mut Handle, frames: [&[[Self; 3]]; 2], pairs: [InPairs; 2], out: OutPair<ContactRow>) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn earliest(on: *mut Handle, frames: [&[[Self; 3]]; 2], found: *mut bool, out: *mut ContactRow) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn is_free(on: *mut Handle, frames: [&[[Self; 3]]; 2], out: *mut bool) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn candidates(on: *mut Handle, frames: [&[[Self; 3]]; 2], boxes: u32, out: [OutPair<Pair>; 2]) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn intersections(on: *mut Handle, at: &[[Self; 3]], out: OutPair<IntersectionRow>) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn has_intersections(on: *mut Handle, at: &[[Self; 3]], out: *mut bool) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn contact_geometries(
        on: *mut Handle,
        frames: [&[[Self; 3]]; 2],
        contacts: &[ContactRow],
        out: OutPair<GeometryRow>,
    ) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn near(on: *mut Handle, at: &[[Self; 3]], distance: f64, out: OutPair<GeometryRow>) -> Status;
    /// # Safety
    /// The conditions of the functions themselves hold.
    unsafe fn truncate(
        on: *mut Handle,
        start: *const [Self; 3],
        wanted: *const [Self; 3],
        count: usize,
        end: *mut [Self; 3],
        out: *mut TruncationRow,
    ) -> Status;
}

macro_rules! for_c {
    ($scalar:ident = $format:ident: $contacts:ident, $contacts_of:ident, $earliest:ident, $is_free:ident, $candidates:ident,
     $intersections:ident, $has_intersections:ident, $contact_geometries:ident, $near:ident, $truncate:ident) => {
        impl ForC for $scalar {
            const FORMAT: ScalarFormat = ScalarFormat::$format;
            fn from_double(value: f64) -> Self {
                value as Self
            }
            unsafe fn contacts(on: *mut Handle, [a, b]: [&[[Self; 3]]; 2], out: OutPair<ContactRow>) -> Status {
                // SAFETY: the caller's promise.
                unsafe { $contacts(on, a.as_ptr().cast(), b.as_ptr().cast(), a.len(), out.0, out.1) }
            }
            unsafe fn contacts_of(
                on: *mut Handle,
                [a, b]: [&[[Self; 3]]; 2],
                [vf, ee]: [InPairs; 2],
                out: OutPair<ContactRow>,
            ) -> Status {
                let (start, end) = (a.as_ptr().cast(), b.as_ptr().cast());
                // SAFETY: the caller's promise.
                unsafe { $contacts_of(on, start, end, a.len(), vf.0, vf.1, ee.0, ee.1, out.0, out.1) }
            }
            unsafe fn earliest(on: *mut Handle, [a, b]: [&[[Self; 3]]; 2], found: *mut bool, out: *mut ContactRow) -> Status {
                // SAFETY: the caller's promise.
                unsafe { $earliest(on, a.as_ptr().cast(), b.as_ptr().cast(), a.len(), found, out) }
            }
            unsafe fn intersections(on: *mut Handle, at: &[[Self; 3]], out: OutPair<IntersectionRow>) -> Status {
                // SAFETY: the caller's promise.
                unsafe { $intersections(on, at.as_ptr().cast(), at.len(), out.0, out.1) }
            }
            unsafe fn has_intersections(on: *mut Handle, at: &[[Self; 3]], out: *mut bool) -> Status {
                // SAFETY: the caller's promise.
                unsafe { $has_intersections(on, at.as_ptr().cast(), at.len(), out) }
            }
            unsafe fn contact_geometries(
                on: *mut Handle,
                [a, b]: [&[[Self; 3]]; 2],
                contacts: &[ContactRow],
                out: OutPair<GeometryRow>,
            ) -> Status {
                let (start, end) = (a.as_ptr().cast(), b.as_ptr().cast());
                // SAFETY: the caller's promise.
                unsafe { $contact_geometries(on, start, end, a.len(), contacts.as_ptr(), contacts.len(), out.0, out.1) }
            }
            unsafe fn near(on: *mut Handle, at: &[[Self; 3]], distance: f64, out: OutPair<GeometryRow>) -> Status {
                // SAFETY: the caller's promise.
                unsafe { $near(on, at.as_ptr().cast(), at.len(), distance, out.0, out.1) }
            }
            unsafe fn truncate(
                on: *mut Handle,
                start: *const [Self; 3],
                wanted: *const [Self; 3],
                count: usize,
                end: *mut [Self; 3],
                out: *mut TruncationRow,
            ) -> Status {
                // SAFETY: the caller's promise.
                unsafe { $truncate(on, start.cast(), wanted.cast(), count, end.cast(), out) }
            }
            unsafe fn is_free(on: *mut Handle, [a, b]: [&[[Self; 3]]; 2], out: *mut bool) -> Status {
                // SAFETY: the caller's promise.
                unsafe { $is_free(on, a.as_ptr().cast(), b.as_ptr().cast(), a.len(), out) }
            }
            unsafe fn candidates(on: *mut Handle, [a, b]: [&[[Self; 3]]; 2], boxes: u32, [vf, ee]: [OutPair<Pair>; 2]) -> Status {
                let (start, end) = (a.as_ptr().cast(), b.as_ptr().cast());
                // SAFETY: the caller's promise.
                unsafe { $candidates(on, start, end, a.len(), boxes, vf.0, vf.1, ee.0, ee.1) }
            }
        }
    };
}
for_c!(
    f32 = F32: selvedge_detector_contacts_f32,
    selvedge_detector_contacts_of_f32,
    selvedge_detector_earliest_f32,
    selvedge_detector_is_free_f32,
    selvedge_detector_candidates_f32,
    selvedge_detector_intersections_f32,
    selvedge_detector_has_intersections_f32,
    selvedge_detector_contact_geometries_f32,
    selvedge_detector_near_f32,
    selvedge_detector_truncate_f32
);
for_c!(
    f64 = F64: selvedge_detector_contacts_f64,
    selvedge_detector_contacts_of_f64,
    selvedge_detector_earliest_f64,
    selvedge_detector_is_free_f64,
    selvedge_detector_candidates_f64,
    selvedge_detector_intersections_f64,
    selvedge_detector_has_intersections_f64,
    selvedge_detector_contact_geometries_f64,
    selvedge_detector_near_f64,
    selvedge_detector_truncate_f64
);

/// Returns a list that C was given.
fn list<T: Copy + Debug>(ask: impl FnOnce(OutPair<T>) -> Status) -> Vec<T> {
    let (mut start, mut count) = (ptr::null(), usize::MAX);
    let status = ask((&raw mut start, &raw mut count));
    assert_eq!(status, Status::Ok, "{}", last_error());
    assert_eq!(start.is_null(), count == 0);
    if count == 0 {
        return Vec::new();
    }
    // SAFETY: the list is valid until the next call.
    unsafe { std::slice::from_raw_parts(start, count) }.to_vec()
}

fn frames<S: ForC>(number: u32) -> [Vec<[S; 3]>; 2] {
    let narrowed = |number| sheet::frame(number).into_iter().map(|it| it.map(S::from_double)).collect();
    [narrowed(number), narrowed(number + 1)]
}

fn rows<S: Scalar>(contacts: &[Contact<S>], topology: &Topology) -> Vec<(u64, ContactRow)> {
    let row = |contact: &Contact<S>| {
        let kind = match contact.kind {
            PairKind::VertexFace => Kind::VertexFace,
            PairKind::EdgeEdge => Kind::EdgeEdge,
        };
        let row = ContactRow {
            time: contact.time.to_f64(),
            kind: kind as u32,
            pair: contact.pair.into(),
            vertices: topology.vertices_of(contact.kind, contact.pair),
        };
        (row.time.to_bits(), row)
    };
    contacts.iter().map(row).collect()
}

fn with_bits(rows: &[ContactRow]) -> Vec<(u64, ContactRow)> {
    rows.iter().map(|row| (row.time.to_bits(), *row)).collect()
}

/// The bits of all numbers of a geometry: kind, pair, vertices, whether there is a normal, and the rest in its order.
type Bits = (u32, [u32; 2], [u32; 4], bool, Vec<u64>);

fn geometries_from_c(rows: &[GeometryRow]) -> Vec<Bits> {
    let bits = |row: &GeometryRow| {
        let [first, second] = row.points;
        let numbers = [
            &row.weights[..],
            &first,
            &second,
            &row.normal,
            &[row.separated_at],
            &row.distance,
            &[row.speed],
        ]
        .concat();
        let pair = [row.pair.first, row.pair.second];
        let numbers = numbers.into_iter().map(f64::to_bits).collect();
        (row.kind, pair, row.vertices, row.has_normal, numbers)
    };
    rows.iter().map(bits).collect()
}

fn geometries_from_rust(found: &[ContactGeometry]) -> Vec<Bits> {
    let bits = |found: &ContactGeometry| {
        let kind = match found.kind {
            PairKind::VertexFace => Kind::VertexFace,
            PairKind::EdgeEdge => Kind::EdgeEdge,
        };
        let it = &found.geometry;
        let [first, second] = it.points.map(|point| point.to_array());
        let normal = it.normal.unwrap_or_default().to_array();
        let numbers = [
            &it.weights[..],
            &first,
            &second,
            &normal,
            &[it.separated_at],
            &it.distance,
            &[it.speed],
        ]
        .concat();
        let numbers = numbers.into_iter().map(f64::to_bits).collect();
        (kind as u32, found.pair, found.vertices, it.normal.is_some(), numbers)
    };
    found.iter().map(bits).collect()
}

/// Compares geometries of contacts and near pairs, and truncation, of one step. Returns the number of geometries.
fn ask_both_where<S: ForC>(handle: *mut Handle, detector: &mut CollisionDetector<S>, frames: [&[[S; 3]]; 2]) -> [usize; 3] {
    let [start, end] = frames;
    let (mut contacts, mut found) = (Vec::new(), Vec::new());
    detector.contacts(start, end, &mut contacts).unwrap();
    detector.contact_geometries(start, end, &contacts, &mut found).unwrap();
    let (mut rows, mut count) = (ptr::null(), 0);
    // SAFETY: these are frames of the mesh; lists are only written to while they live.
    let status = unsafe { S::contacts(handle, frames, (&raw mut rows, &raw mut count)) };
    assert_eq!((status, count), (Status::Ok, contacts.len()));
    // The detector's own list is passed back.
    let rows = match count {
        0 => &[],
        // SAFETY: the list is valid until the next search for contacts.
        _ => unsafe { std::slice::from_raw_parts(rows, count) },
    };
    // SAFETY: as above.
    let from_c = list(|out| unsafe { S::contact_geometries(handle, frames, rows, out) });
    assert_eq!(geometries_from_c(&from_c), geometries_from_rust(&found));

    let count_of_contacts = from_c.len();
    let mut count_of_near = 0;
    for distance in [0.0, 0.03125] {
        detector.near(end, S::from_double(distance), &mut found).unwrap();
        // SAFETY: as above.
        let from_c = list(|out| unsafe { S::near(handle, end, distance, out) });
        assert_eq!(geometries_from_c(&from_c), geometries_from_rust(&found));
        count_of_near = from_c.len();
    }

    let (mut truncated, mut truncation) = (Vec::new(), TruncationRow::default());
    let nowhere = vec![[S::from_double(f64::NAN); 3]; start.len()];
    let (mut elsewhere, mut over_start, mut over_wanted) = (nowhere, start.to_vec(), end.to_vec());
    let (first, last) = (over_start.as_mut_ptr(), over_wanted.as_mut_ptr());
    // The result goes to its own place, and over either of the frames.
    let places = [
        (start.as_ptr(), end.as_ptr(), elsewhere.as_mut_ptr()),
        (first.cast_const(), end.as_ptr(), first),
        (start.as_ptr(), last.cast_const(), last),
    ];
    for (first, wanted, place) in places {
        // The detector has had as many calls, since the order of contacts depends on earlier ones.
        truncation = detector.truncate(start, end, &mut truncated).unwrap().into();
        let mut row = TruncationRow::default();
        // SAFETY: each frame has as many positions as the mesh has vertices.
        let status = unsafe { S::truncate(handle, first, wanted, truncated.len(), place, &raw mut row) };
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
fn ask_both<S: ForC>(handle: *mut Handle, detector: &mut CollisionDetector<S>) -> usize {
    let (mut contacts, mut vf, mut ee, mut total) = (Vec::new(), Vec::new(), Vec::new(), 0);
    let topology = detector.topology().clone();
    for number in 0..4 {
        let frames = frames::<S>(number);
        let frames = [&frames[0][..], &frames[1][..]];
        let [start, end] = frames;

        detector.contacts(start, end, &mut contacts).unwrap();
        // SAFETY: these are frames of the mesh; lists are only written to while they live.
        let from_c = list(|out| unsafe { S::contacts(handle, frames, out) });
        assert_eq!(with_bits(&from_c), rows(&contacts, &topology));
        total += contacts.len();

        let earliest = detector.earliest(start, end).unwrap();
        let (mut found, mut row) = (false, ContactRow::default());
        // SAFETY: as above.
        let status = unsafe { S::earliest(handle, frames, &raw mut found, &raw mut row) };
        assert_eq!((status, found), (Status::Ok, earliest.is_some()));
        let from_c = if found { vec![row] } else { Vec::new() };
        assert_eq!(with_bits(&from_c), rows(&Vec::from_iter(earliest), &topology));

        let mut is_free = false;
        // SAFETY: as above.
        let status = unsafe { S::is_free(handle, frames, &raw mut is_free) };
        assert_eq!((status, is_free), (Status::Ok, detector.is_free(start, end).unwrap()));

        let mut at_rest = Vec::new();
        detector.intersections(end, &mut at_rest).unwrap();
        // SAFETY: as above.
        let from_c = list(|out| unsafe { S::intersections(handle, end, out) });
        assert_eq!(from_c, at_rest.iter().map(IntersectionRow::from).collect::<Vec<_>>());
        let mut has_any = false;
        // SAFETY: as above.
        let status = unsafe { S::has_intersections(handle, end, &raw mut has_any) };
        assert_eq!((status, has_any), (Status::Ok, !at_rest.is_empty()));

        for (boxes, number) in [(CandidateBoxes::Moving, Boxes::Moving), (CandidateBoxes::Swept, Boxes::Swept)] {
            detector.candidates(start, end, boxes, &mut vf, &mut ee).unwrap();
            let (mut at, mut counts) = ([ptr::null(); 2], [0; 2]);
            let [at_vf, at_ee] = &mut at;
            let [vf_count, ee_count] = &mut counts;
            let out = [(&raw mut *at_vf, &raw mut *vf_count), (&raw mut *at_ee, &raw mut *ee_count)];
            // SAFETY: as above.
            assert_eq!(unsafe { S::candidates(handle, frames, number as u32, out) }, Status::Ok);
            let pairs = |which: usize| {
                list(|(start, count)| {
                    // SAFETY: the pointers come from `list`.
                    unsafe { (*start, *count) = (at[which], counts[which]) };
                    Status::Ok
                })
            };
            let as_pairs = |pairs: &[[u32; 2]]| pairs.iter().map(|&pair| Pair::from(pair)).collect::<Vec<_>>();
            assert_eq!((pairs(0), pairs(1)), (as_pairs(&vf), as_pairs(&ee)));

            // The detector's own lists are passed back.
            detector.contacts_of(start, end, &vf, &ee, &mut contacts).unwrap();
            let given = [(at[0], counts[0]), (at[1], counts[1])];
            // SAFETY: as above; the lists live until the next search for candidates.
            let from_c = list(|out| unsafe { S::contacts_of(handle, frames, given, out) });
            assert_eq!(with_bits(&from_c), rows(&contacts, &topology));
        }
        ask_both_where(handle, detector, frames);
    }
    total
}

fn every_question_in_every_setting<S: ForC>() {
    let handle = new(S::FORMAT);
    let topology = Topology::new(sheet::frame(0).len(), sheet::triangles()).unwrap();
    // SAFETY: the list is written to.
    let edges = list(|(start, count)| unsafe { selvedge_detector_edges(handle, start, count) });
    assert_eq!(edges, topology.edges().iter().map(|&edge| edge.into()).collect::<Vec<Pair>>());

    let mut detector = CollisionDetector::<S>::new(topology);
    let at_first = ask_both(handle, &mut detector);
    assert!(at_first > 100, "{at_first} contacts show little");
    let [start, end] = frames::<S>(1);
    let counts = ask_both_where(handle, &mut detector, [&start, &end]);
    assert!(counts.iter().all(|&count| count > 100), "{counts:?} show little");

    let (separation, tolerance) = (S::from_double(0.015625), S::from_double(0.0009765625));
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

/// One of two particles falls onto the other and onto one piece of a rope of two.
#[test]
fn ropes_and_particles_are_triangles_that_name_a_vertex_again() {
    let (edges, points) = ([[0, 1], [1, 2]], [3, 4]);
    let topology = Topology::with_loose_features(5, vec![], &edges, &points).unwrap();
    let faces = [[0_u32, 1, 1], [1, 2, 2], [3, 3, 3], [4, 4, 4]];
    let mut handle = ptr::null_mut();
    // SAFETY: the array is as long as the count says.
    let status = unsafe { selvedge_detector_new(ScalarFormat::F64 as u32, 5, faces.as_ptr().cast(), 4, &raw mut handle) };
    assert_eq!(status, Status::Ok, "{}", last_error());
    let start = [
        [-1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [1.0, 0.0, 1.0],
        [1.0, 0.0, 0.5],
    ];
    let mut end = start;
    end[3][2] = -1.0;
    let mut contacts = Vec::new();
    let mut detector = CollisionDetector::<f64>::new(topology.clone());
    detector.contacts(&start, &end, &mut contacts).unwrap();
    assert_eq!(
        contacts.len(),
        3,
        "each particle with the other, one with the piece: {contacts:?}"
    );
    // SAFETY: the frames are as long as the mesh requires.
    let from_c = list(|out| unsafe { f64::contacts(handle, [&start, &end], out) });
    assert_eq!(with_bits(&from_c), rows(&contacts, &topology));
    assert_eq!(selvedge_detector_free(handle), Status::Ok);
}

/// Tests groups, patches and vertex pairs, one by one and together, and then no filter.
fn filters_exclude_what_they_do_in_rust<S: ForC>() {
    let handle = new(S::FORMAT);
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
    let [start, end] = frames::<S>(2);
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
    let pairs: Vec<Pair> = excluded.iter().map(|&pair| pair.into()).collect();

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

#[test]
fn filters_of_double_exclude_what_they_do_in_rust() {
    filters_exclude_what_they_do_in_rust::<f64>();
}

#[test]
fn filters_of_float_exclude_what_they_do_in_rust() {
    filters_exclude_what_they_do_in_rust::<f32>();
}

#[test]
fn double_is_answered_as_in_rust_bit_for_bit() {
    every_question_in_every_setting::<f64>();
}

#[test]
fn float_is_answered_as_in_rust_bit_for_bit() {
    every_question_in_every_setting::<f32>();
}

#[test]
fn default_tolerances_are_the_detectors() {
    assert_eq!(SELVEDGE_DEFAULT_TOLERANCE_F32, f64::from(Limits::<f32>::default().tolerance));
    assert_eq!(SELVEDGE_DEFAULT_TOLERANCE_F64, Limits::<f64>::default().tolerance);
}

#[test]
fn a_separation_is_never_rounded_down() {
    // The nearest float is larger, smaller, or zero.
    for separation in [0.1, 0.7, 1e-60] {
        let kept: f64 = length::<f32>(separation).unwrap().into();
        assert!(
            kept >= separation && kept <= separation * 1.000001 + 1e-29,
            "{separation} became {kept}"
        );
        assert_eq!(length::<f64>(separation).unwrap(), separation);
    }
    assert!(
        [-1e-60, -1.0, f64::NAN, f64::INFINITY]
            .iter()
            .all(|&none| length::<f32>(none).is_err())
    );
}

#[test]
fn a_panic_breaks_its_detector_and_no_other() {
    let (broken, other) = (new(ScalarFormat::F64), new(ScalarFormat::F64));
    assert_eq!(on(broken, |_| panic!("on purpose, {}", 1)), Status::Internal);
    assert!(last_error().ends_with("on purpose, 1"), "{}", last_error());
    assert_eq!(selvedge_detector_set_coherent(broken, 1), Status::Internal);
    assert!(last_error().contains("only be freed"), "{}", last_error());
    assert_eq!(selvedge_detector_set_coherent(other, 1), Status::Ok);
    assert_eq!(selvedge_detector_free(broken), Status::Ok);
    assert_eq!(selvedge_detector_free(broken), Status::NoSuchDetector);
    assert_eq!(selvedge_detector_free(other), Status::Ok);
}

/// A panic payload whose drop panics.
struct Unhappy;
impl Drop for Unhappy {
    fn drop(&mut self) {
        panic!("again");
    }
}

#[test]
fn a_panic_without_a_message_ends_at_the_border_too() {
    let handle = new(ScalarFormat::F64);
    assert_eq!(on(handle, |_| std::panic::panic_any(Unhappy)), Status::Internal);
    assert!(last_error().contains("without a message"));
    selvedge_detector_free(handle);
}

#[test]
fn a_second_thread_is_refused_and_may_cancel_and_free() {
    let handle = new(ScalarFormat::F64);
    let status = on(handle, |_| {
        let address = handle.addr();
        let second = std::thread::spawn(move || {
            let handle = ptr::without_provenance_mut(address);
            let refused = selvedge_detector_set_coherent(handle, 1);
            let words = last_error();
            // These two calls are the exceptions.
            let cancelled = selvedge_detector_set_cancelled(handle, 1);
            (refused, words, cancelled, selvedge_detector_free(handle))
        });
        let (refused, words, cancelled, freed) = second.join().unwrap();
        assert_eq!((refused, cancelled, freed), (Status::Busy, Status::Ok, Status::Ok));
        assert!(words.contains("another thread"));
        Ok(())
    });
    assert_eq!(status, Status::Ok);
    assert_eq!(selvedge_detector_set_coherent(handle, 1), Status::NoSuchDetector);
}

#[test]
fn each_thread_has_its_own_last_error() {
    assert_eq!(selvedge_detector_set_coherent(ptr::null_mut(), 1), Status::NullPointer);
    let before = last_error();
    std::thread::spawn(|| assert_eq!(last_error(), "")).join().unwrap();
    assert_eq!(last_error(), before);
    assert_eq!(before, "the detector is NULL");
}

#[test]
fn every_status_has_a_text_of_its_own() {
    let text = |status| {
        // SAFETY: the text ends with a zero and is valid forever.
        unsafe { CStr::from_ptr(selvedge_status_string(status)) }.to_str().unwrap()
    };
    let last = Status::TooMuchMemory as i32;
    let texts: std::collections::BTreeSet<_> = (0..=last).map(text).collect();
    assert_eq!(texts.len(), last as usize + 1);
    assert!(!texts.contains("unknown status"));
    assert!([-1, i32::MIN, i32::MAX, last + 1].map(text) == ["unknown status"; 4]);
}

#[test]
fn a_long_text_is_cut_at_a_character() {
    let text = "é".repeat(2000);
    assert_eq!(
        crate::status::remember(&crate::status::Failure::new(Status::Internal, text)),
        Status::Internal
    );
    assert!(last_error().len() > 1000 && last_error().chars().all(|letter| letter == 'é'));
}
