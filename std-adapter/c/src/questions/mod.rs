//! What a detector can be asked of a step: thin functions for each format over one that is generic (`ask.rs`).

mod ask;

use crate::answers::{ContactRow, GeometryRow, IntersectionRow, Pair, TruncationRow};
use crate::detector::Handle;
use crate::status::Status;
use ask::{
    AskedState, AskedStep, find_candidates, find_contact_geometries, find_contacts, find_contacts_of, find_earliest,
    find_intersections, find_near, tell_free, tell_intersections, truncate,
};

/// All contacts of the step from `start` to `end`. They stay where they are until this detector's contacts are asked for again,
/// in either way, or it is freed. If there are none they are at NULL.
///
/// # Safety
/// `start` and `end` point to 3 * `vertex_count` numbers, `contacts` to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_contacts_f64(
    detector: *mut Handle,
    start: *const f64,
    end: *const f64,
    vertex_count: usize,
    contacts: *mut *const ContactRow,
    count: *mut usize,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_contacts(asked, contacts, count) }
}

/// selvedge_detector_contacts_f64 for float.
///
/// # Safety
/// As selvedge_detector_contacts_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_contacts_f32(
    detector: *mut Handle,
    start: *const f32,
    end: *const f32,
    vertex_count: usize,
    contacts: *mut *const ContactRow,
    count: *mut usize,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_contacts(asked, contacts, count) }
}

/// The contacts among pairs that the caller has, in their order: so many of a vertex and a face, and so many of two edges. They
/// stay as those of selvedge_detector_contacts_f64. The pairs may be this detector's own candidates.
///
/// # Safety
/// As selvedge_detector_contacts_f64; `vertex_face` and `edge_edge` point to so many pairs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_contacts_of_f64(
    detector: *mut Handle,
    start: *const f64,
    end: *const f64,
    vertex_count: usize,
    vertex_face: *const Pair,
    vertex_face_count: usize,
    edge_edge: *const Pair,
    edge_edge_count: usize,
    contacts: *mut *const ContactRow,
    count: *mut usize,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe {
        find_contacts_of(
            asked,
            (vertex_face, vertex_face_count),
            (edge_edge, edge_edge_count),
            contacts,
            count,
        )
    }
}

/// selvedge_detector_contacts_of_f64 for float.
///
/// # Safety
/// As selvedge_detector_contacts_of_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_contacts_of_f32(
    detector: *mut Handle,
    start: *const f32,
    end: *const f32,
    vertex_count: usize,
    vertex_face: *const Pair,
    vertex_face_count: usize,
    edge_edge: *const Pair,
    edge_edge_count: usize,
    contacts: *mut *const ContactRow,
    count: *mut usize,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe {
        find_contacts_of(
            asked,
            (vertex_face, vertex_face_count),
            (edge_edge, edge_edge_count),
            contacts,
            count,
        )
    }
}

/// The earliest contact of the step: of several at the same time the one with the smallest numbers. `*found` becomes whether
/// there is one. Then `*contact` becomes it, and the step is free of contact before its time; otherwise the whole step is, and
/// `*contact` stays.
///
/// # Safety
/// `start` and `end` point to 3 * `vertex_count` numbers, `found` and `contact` to one of their type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_earliest_f64(
    detector: *mut Handle,
    start: *const f64,
    end: *const f64,
    vertex_count: usize,
    found: *mut bool,
    contact: *mut ContactRow,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_earliest(asked, found, contact) }
}

/// selvedge_detector_earliest_f64 for float.
///
/// # Safety
/// As selvedge_detector_earliest_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_earliest_f32(
    detector: *mut Handle,
    start: *const f32,
    end: *const f32,
    vertex_count: usize,
    found: *mut bool,
    contact: *mut ContactRow,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_earliest(asked, found, contact) }
}

/// Whether the step is certainly free of contact. Ends at the first contact.
///
/// # Safety
/// `start` and `end` point to 3 * `vertex_count` numbers, `is_free` to one of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_is_free_f64(
    detector: *mut Handle,
    start: *const f64,
    end: *const f64,
    vertex_count: usize,
    is_free: *mut bool,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { tell_free(asked, is_free) }
}

/// selvedge_detector_is_free_f64 for float.
///
/// # Safety
/// As selvedge_detector_is_free_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_is_free_f32(
    detector: *mut Handle,
    start: *const f32,
    end: *const f32,
    vertex_count: usize,
    is_free: *mut bool,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { tell_free(asked, is_free) }
}

/// The pairs that boxes leave; all others are certainly farther apart than the separation throughout the step. `boxes`
/// is a selvedge_boxes. They stay where they are until this detector's candidates are asked for again, or it is freed.
///
/// # Safety
/// `start` and `end` point to 3 * `vertex_count` numbers, `vertex_face` and `edge_edge` to pointers, the counts to numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_candidates_f64(
    detector: *mut Handle,
    start: *const f64,
    end: *const f64,
    vertex_count: usize,
    boxes: u32,
    vertex_face: *mut *const Pair,
    vertex_face_count: *mut usize,
    edge_edge: *mut *const Pair,
    edge_edge_count: *mut usize,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_candidates(asked, boxes, (vertex_face, vertex_face_count), (edge_edge, edge_edge_count)) }
}

/// selvedge_detector_candidates_f64 for float.
///
/// # Safety
/// As selvedge_detector_candidates_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_candidates_f32(
    detector: *mut Handle,
    start: *const f32,
    end: *const f32,
    vertex_count: usize,
    boxes: u32,
    vertex_face: *mut *const Pair,
    vertex_face_count: *mut usize,
    edge_edge: *mut *const Pair,
    edge_edge_count: *mut usize,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_candidates(asked, boxes, (vertex_face, vertex_face_count), (edge_edge, edge_edge_count)) }
}

/// All edges and faces that meet where the mesh is at `positions`, at rest, touching included, exactly; and vertices and faces,
/// and edges, that touch where neighbours are folded flat onto each other. None exactly if no two triangles have a point in
/// common besides the vertices and the edge that they share. They stay where they are until this detector's intersections are
/// asked for again, or it is freed.
///
/// # Safety
/// `positions` points to 3 * `vertex_count` numbers, `intersections` to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_intersections_f64(
    detector: *mut Handle,
    positions: *const f64,
    vertex_count: usize,
    intersections: *mut *const IntersectionRow,
    count: *mut usize,
) -> Status {
    let asked = AskedState::new(detector, positions, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_intersections(asked, intersections, count) }
}

/// selvedge_detector_intersections_f64 for float.
///
/// # Safety
/// As selvedge_detector_intersections_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_intersections_f32(
    detector: *mut Handle,
    positions: *const f32,
    vertex_count: usize,
    intersections: *mut *const IntersectionRow,
    count: *mut usize,
) -> Status {
    let asked = AskedState::new(detector, positions, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_intersections(asked, intersections, count) }
}

/// Whether there is any intersection. Ends at the first.
///
/// # Safety
/// `positions` points to 3 * `vertex_count` numbers, `has_any` to one of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_has_intersections_f64(
    detector: *mut Handle,
    positions: *const f64,
    vertex_count: usize,
    has_any: *mut bool,
) -> Status {
    let asked = AskedState::new(detector, positions, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { tell_intersections(asked, has_any) }
}

/// selvedge_detector_has_intersections_f64 for float.
///
/// # Safety
/// As selvedge_detector_has_intersections_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_has_intersections_f32(
    detector: *mut Handle,
    positions: *const f32,
    vertex_count: usize,
    has_any: *mut bool,
) -> Status {
    let asked = AskedState::new(detector, positions, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { tell_intersections(asked, has_any) }
}

/// How the two of each contact lie to each other at its time: the closest points, their weights, a normal along which they were
/// certainly apart, the range that their distance is in. `contacts` may be this detector's own list, or any rows of the caller's,
/// of which kind, pair and time are looked at; the geometries are in their order. For a detector for float a time is rounded down
/// to a float. They stay where they are until this detector's contact geometries are asked for again, or it is freed.
///
/// # Safety
/// `start` and `end` point to 3 * `vertex_count` numbers, `contacts` to `contact_count` rows, `geometries` to a pointer, `count`
/// to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_contact_geometries_f64(
    detector: *mut Handle,
    start: *const f64,
    end: *const f64,
    vertex_count: usize,
    contacts: *const ContactRow,
    contact_count: usize,
    geometries: *mut *const GeometryRow,
    count: *mut usize,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_contact_geometries(asked, (contacts, contact_count), geometries, count) }
}

/// selvedge_detector_contact_geometries_f64 for float.
///
/// # Safety
/// As selvedge_detector_contact_geometries_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_contact_geometries_f32(
    detector: *mut Handle,
    start: *const f32,
    end: *const f32,
    vertex_count: usize,
    contacts: *const ContactRow,
    contact_count: usize,
    geometries: *mut *const GeometryRow,
    count: *mut usize,
) -> Status {
    let asked = AskedStep::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_contact_geometries(asked, (contacts, contact_count), geometries, count) }
}

/// All pairs that are within `distance` of each other where the mesh is at `positions`, at rest, with their closest points: none
/// missed; a pair a little farther away may be among them, each tells the range that its distance is in. Ascending by kind and
/// pair. Not asked are pairs that share a vertex, pairs of which no vertex moves (selvedge_detector_set_moving) and those that
/// selvedge_detector_set_collision_filter excludes.
///
/// `distance` is in the unit of the positions; for a detector for float it is rounded up to a float. The list stays where it is
/// until this detector is asked for what is near again, or it is freed.
///
/// # Safety
/// `positions` points to 3 * `vertex_count` numbers, `geometries` to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_near_f64(
    detector: *mut Handle,
    positions: *const f64,
    vertex_count: usize,
    distance: f64,
    geometries: *mut *const GeometryRow,
    count: *mut usize,
) -> Status {
    let asked = AskedState::new(detector, positions, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_near(asked, distance, geometries, count) }
}

/// selvedge_detector_near_f64 for float.
///
/// # Safety
/// As selvedge_detector_near_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_near_f32(
    detector: *mut Handle,
    positions: *const f32,
    vertex_count: usize,
    distance: f64,
    geometries: *mut *const GeometryRow,
    count: *mut usize,
) -> Status {
    let asked = AskedState::new(detector, positions, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_near(asked, distance, geometries, count) }
}

/// Lets each vertex go from `start` to where it is `wanted` as far as its neighbourhood lets it: `end` becomes positions on these
/// ways such that the step from `start` to `end` is free of contact, but for pairs that are in contact at the start, whose
/// vertices rest. `*truncation` becomes what was done.
///
/// `end` may be `wanted` or `start` itself: it is written to when all else is done, and not by a call that fails.
///
/// # Safety
/// `start` and `wanted` point to 3 * `vertex_count` numbers, `end` to room for as many, `truncation` to one of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_truncate_f64(
    detector: *mut Handle,
    start: *const f64,
    wanted: *const f64,
    vertex_count: usize,
    end: *mut f64,
    truncation: *mut TruncationRow,
) -> Status {
    let asked = AskedStep::between(detector, [("start", start), ("wanted", wanted)], vertex_count);
    // SAFETY: the caller's promises.
    unsafe { truncate(asked, end, truncation) }
}

/// selvedge_detector_truncate_f64 for float.
///
/// # Safety
/// As selvedge_detector_truncate_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_truncate_f32(
    detector: *mut Handle,
    start: *const f32,
    wanted: *const f32,
    vertex_count: usize,
    end: *mut f32,
    truncation: *mut TruncationRow,
) -> Status {
    let asked = AskedStep::between(detector, [("start", start), ("wanted", wanted)], vertex_count);
    // SAFETY: the caller's promises.
    unsafe { truncate(asked, end, truncation) }
}
