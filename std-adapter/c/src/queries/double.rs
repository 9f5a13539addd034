//! The queries for positions in double.

use super::on_frames;
use crate::answers::{Boxes, CandidatePairs, ContactRow, GeometryRow, IntersectionRow, PairRow, TruncationRow};
use crate::detector::Handle;
use crate::input::{Out, OutFrame, OutList, unknown, view};
use crate::settings::length;
use crate::status::Status;
use selvedge::CandidateBoxes;
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
    let frames = [("start", start), ("end", end)];
    // SAFETY: the caller's promises.
    unsafe {
        on_frames(detector, frames, vertex_count, |finder, answers, [start, end]| {
            let out = OutList::new("contacts", contacts, count)?;
            finder.detector.contacts(start, end, &mut finder.contacts)?;
            out.set(answers.show_contacts(&finder.contacts, finder.detector.topology()));
            Ok(())
        })
    }
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
    vertex_face: *const PairRow,
    vertex_face_count: usize,
    edge_edge: *const PairRow,
    edge_edge_count: usize,
    contacts: *mut *const ContactRow,
    count: *mut usize,
) -> Status {
    let frames = [("start", start), ("end", end)];
    // SAFETY: the caller's promises. The pairs may be this detector's candidates; they are not written to here.
    unsafe {
        on_frames(detector, frames, vertex_count, |finder, answers, [start, end]| {
            let out = OutList::new("contacts", contacts, count)?;
            let vertex_face = view("vertex_face", vertex_face.cast::<u32>(), vertex_face_count)?;
            let edge_edge = view("edge_edge", edge_edge.cast::<u32>(), edge_edge_count)?;
            let found = &mut finder.contacts;
            finder.detector.contacts_of(start, end, vertex_face, edge_edge, found)?;
            out.set(answers.show_contacts(&finder.contacts, finder.detector.topology()));
            Ok(())
        })
    }
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
    let frames = [("start", start), ("end", end)];
    // SAFETY: the caller's promises.
    unsafe {
        on_frames(detector, frames, vertex_count, |finder, _, [start, end]| {
            let (found, out) = (Out::new("found", found)?, Out::new("contact", contact)?);
            let earliest = finder.detector.earliest(start, end)?;
            found.set(earliest.is_some());
            if let Some(earliest) = earliest {
                out.set(ContactRow::new(&earliest, finder.detector.topology()));
            }
            Ok(())
        })
    }
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
    let frames = [("start", start), ("end", end)];
    // SAFETY: the caller's promises.
    unsafe {
        on_frames(detector, frames, vertex_count, |finder, _, [start, end]| {
            let out = Out::new("is_free", is_free)?;
            out.set(finder.detector.is_free(start, end)?);
            Ok(())
        })
    }
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
    vertex_face: *mut *const PairRow,
    vertex_face_count: *mut usize,
    edge_edge: *mut *const PairRow,
    edge_edge_count: *mut usize,
) -> Status {
    let frames = [("start", start), ("end", end)];
    // SAFETY: the caller's promises.
    unsafe {
        on_frames(detector, frames, vertex_count, |finder, answers, [start, end]| {
            let vf = OutList::new("vertex_face", vertex_face, vertex_face_count)?;
            let ee = OutList::new("edge_edge", edge_edge, edge_edge_count)?;
            let boxes = match boxes {
                number if number == Boxes::Moving as u32 => CandidateBoxes::Moving,
                number if number == Boxes::Swept as u32 => CandidateBoxes::Swept,
                number => return Err(unknown("selvedge_boxes", number)),
            };
            let CandidatePairs { vertex_face, edge_edge } = &mut answers.found_candidates;
            finder.detector.candidates(start, end, boxes, vertex_face, edge_edge)?;
            let shown = answers.show_candidates();
            vf.set_pairs(&shown.vertex_face);
            ee.set_pairs(&shown.edge_edge);
            Ok(())
        })
    }
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
    let frames = [("positions", positions)];
    // SAFETY: the caller's promises.
    unsafe {
        on_frames(detector, frames, vertex_count, |finder, answers, [positions]| {
            let out = OutList::new("intersections", intersections, count)?;
            finder.detector.intersections(positions, &mut answers.found_at_rest)?;
            out.set(answers.show_intersections());
            Ok(())
        })
    }
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
    let frames = [("positions", positions)];
    // SAFETY: the caller's promises.
    unsafe {
        on_frames(detector, frames, vertex_count, |finder, _, [positions]| {
            let out = Out::new("has_any", has_any)?;
            out.set(finder.detector.has_intersections(positions)?);
            Ok(())
        })
    }
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
    let frames = [("start", start), ("end", end)];
    // SAFETY: the caller's promises. The contacts may be this detector's own; they are not written to here.
    unsafe {
        on_frames(detector, frames, vertex_count, |finder, answers, [start, end]| {
            let out = OutList::new("geometries", geometries, count)?;
            let rows = view::<_, 1>("contacts", contacts, contact_count)?;
            let given = &mut finder.contacts;
            given.clear();
            for [row] in rows {
                given.push(row.contact()?);
            }
            let found = &mut answers.found_geometries;
            finder.detector.contact_geometries(start, end, given, found)?;
            out.set(answers.show_contact_geometries());
            Ok(())
        })
    }
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
    let frames = [("positions", positions)];
    // SAFETY: the caller's promises.
    unsafe {
        on_frames(detector, frames, vertex_count, |finder, answers, [positions]| {
            let out = OutList::new("geometries", geometries, count)?;
            finder
                .detector
                .near(positions, length(distance)?, &mut answers.found_geometries)?;
            out.set(answers.show_near());
            Ok(())
        })
    }
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
    let (mut out, mut positions) = (None, Vec::new());
    let frames = [("start", start), ("wanted", wanted)];
    // SAFETY: the caller's promises.
    let status = unsafe {
        on_frames(detector, frames, vertex_count, |finder, _, [start, wanted]| {
            let (end, truncation) = (OutFrame::new("end", end, vertex_count)?, Out::new("truncation", truncation)?);
            let found = finder.detector.truncate(start, wanted, &mut positions)?;
            out = Some((end, truncation, found.into()));
            Ok(())
        })
    };
    // The answer is written last, since `end` may be one of the frames.
    if let Some((end, truncation, found)) = out {
        end.set(&positions);
        truncation.set(found);
    }
    status
}
