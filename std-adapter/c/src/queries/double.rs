//! Thin functions over `generic.rs`. A C program calls these with positions in double.

use super::generic::{
    StateQuery, StepQuery, answer_free, answer_has_intersections, find_candidates, find_contact_geometries, find_contacts,
    find_contacts_of, find_earliest, find_intersections, find_near, truncate,
};
use crate::answers::{ContactRow, GeometryRow, IntersectionRow, Pair, TruncationRow};
use crate::detector::Handle;
use crate::status::Status;
use std::ffi::c_double;

/// Finds all contacts of the step from `start` to `end`. The list stays valid until the next search for contacts with this
/// detector, or until the detector is freed. An empty list is at NULL.
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
    let query = StepQuery::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_contacts(query, contacts, count) }
}

/// Finds the contacts among the given pairs, in their order. The pairs may be this detector's own candidates. The list stays
/// valid as for selvedge_detector_contacts_f64.
///
/// # Safety
/// The conditions are those of selvedge_detector_contacts_f64; `vertex_face` and `edge_edge` point to as many pairs as their
/// counts say.
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
    let query = StepQuery::new(detector, start, end, vertex_count);
    let pairs = ((vertex_face, vertex_face_count), (edge_edge, edge_edge_count));
    // SAFETY: the caller's promises.
    unsafe { find_contacts_of(query, pairs.0, pairs.1, contacts, count) }
}

/// Finds the earliest contact of the step. If several have the same time, it is the one with the smallest numbers.
///
/// `*found` says whether there is one. If so, `*contact` receives it, and the step is free of contact before its time. Otherwise
/// the whole step is free, and `*contact` stays unchanged.
///
/// # Safety
/// `start` and `end` point to 3 * `vertex_count` numbers, `found` and `contact` to one value of their type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_earliest_f64(
    detector: *mut Handle,
    start: *const f64,
    end: *const f64,
    vertex_count: usize,
    found: *mut bool,
    contact: *mut ContactRow,
) -> Status {
    let query = StepQuery::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_earliest(query, found, contact) }
}

/// Decides whether the step is certainly free of contact. The search ends at the first contact.
///
/// # Safety
/// `start` and `end` point to 3 * `vertex_count` numbers, `is_free` to one value of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_is_free_f64(
    detector: *mut Handle,
    start: *const f64,
    end: *const f64,
    vertex_count: usize,
    is_free: *mut bool,
) -> Status {
    let query = StepQuery::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { answer_free(query, is_free) }
}

/// Finds the pairs that bounding boxes keep. All other pairs certainly stay farther apart than the separation throughout the
/// step. `boxes` is a selvedge_boxes. The lists stay valid until the next search for candidates with this detector, or until the
/// detector is freed.
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
    let query = StepQuery::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_candidates(query, boxes, (vertex_face, vertex_face_count), (edge_edge, edge_edge_count)) }
}

/// Finds all intersections of the mesh at rest, exactly. They are edges and faces that meet, touching included, and primitives of
/// neighbours that are folded flat onto each other.
///
/// The list is empty exactly if no two triangles share a point besides the vertices and the edge that they have in common. It
/// stays valid until the next search for intersections with this detector, or until the detector is freed.
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
    let query = StateQuery::new(detector, positions, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_intersections(query, intersections, count) }
}

/// Decides whether the mesh at rest intersects itself. The search ends at the first intersection.
///
/// # Safety
/// `positions` points to 3 * `vertex_count` numbers, `has_any` to one value of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_has_intersections_f64(
    detector: *mut Handle,
    positions: *const f64,
    vertex_count: usize,
    has_any: *mut bool,
) -> Status {
    let query = StateQuery::new(detector, positions, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { answer_has_intersections(query, has_any) }
}

/// Computes the geometry of each contact at its time: the closest points, their weights, a normal along which the two sides were
/// certainly apart, and bounds of their distance.
///
/// `contacts` may be this detector's own list or rows of the caller, of which kind, pair and time are read. The geometries have
/// the same order. A detector for float rounds a time down to a float. The list stays valid until the next call of this function
/// for this detector, or until the detector is freed.
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
    let query = StepQuery::new(detector, start, end, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_contact_geometries(query, (contacts, contact_count), geometries, count) }
}

/// Finds all pairs within `distance` of each other in a mesh at rest, with their closest points. None is missed; a pair that is a
/// little farther apart may be included, and each row has bounds of its distance.
///
/// Rows ascend by kind and pair. Pairs that share a vertex, pairs without a moving vertex (selvedge_detector_set_moving) and
/// pairs that selvedge_detector_set_collision_filter excludes are left out. `distance` is in the unit of the positions; a
/// detector for float rounds it up to a float. The list stays valid until the next call of this function for this detector, or
/// until the detector is freed.
///
/// # Safety
/// `positions` points to 3 * `vertex_count` numbers, `geometries` to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_near_f64(
    detector: *mut Handle,
    positions: *const f64,
    vertex_count: usize,
    distance: c_double,
    geometries: *mut *const GeometryRow,
    count: *mut usize,
) -> Status {
    let query = StateQuery::new(detector, positions, vertex_count);
    // SAFETY: the caller's promises.
    unsafe { find_near(query, distance, geometries, count) }
}

/// Moves each vertex from `start` towards `wanted` as far as its neighbourhood allows, and writes the positions to `end`. The
/// step from `start` to `end` is free of contact, except for pairs in contact at the start; their vertices rest. `*truncation`
/// receives the counts.
///
/// `end` may be `wanted` or `start` itself: it is written last, and not by a call that fails.
///
/// # Safety
/// `start` and `wanted` point to 3 * `vertex_count` numbers, `end` to room for as many, `truncation` to one value of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_truncate_f64(
    detector: *mut Handle,
    start: *const f64,
    wanted: *const f64,
    vertex_count: usize,
    end: *mut f64,
    truncation: *mut TruncationRow,
) -> Status {
    let query = StepQuery::between(detector, [("start", start), ("wanted", wanted)], vertex_count);
    // SAFETY: the caller's promises.
    unsafe { truncate(query, end, truncation) }
}
