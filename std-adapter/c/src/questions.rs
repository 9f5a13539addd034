//! What a detector can be asked of a step: thin functions for each format over one that is generic.

use crate::answers::{Answers, Boxes, CandidatePairs, ContactRow, GeometryRow, IntersectionRow, Pair, TruncationRow};
use crate::detector::{Detector, Finder, Format, Handle, on};
use crate::input::{Out, OutFrame, OutList, unknown, view};
use crate::settings::length;
use crate::status::{Failure, Status};
use selvedge::{CandidateBoxes, Frame, StepError};

/// What a question is about, as it came: `N` frames of a mesh, with their names.
struct Asked<S, const N: usize> {
    detector: *mut Handle,
    frames: [(&'static str, *const S); N],
    vertex_count: usize,
}

/// A question about a step.
type AskedStep<S> = Asked<S, 2>;

impl<S> AskedStep<S> {
    const fn new(detector: *mut Handle, start: *const S, end: *const S, vertex_count: usize) -> Self {
        Self::between(detector, [("start", start), ("end", end)], vertex_count)
    }

    const fn between(detector: *mut Handle, frames: [(&'static str, *const S); 2], vertex_count: usize) -> Self {
        Self {
            detector,
            frames,
            vertex_count,
        }
    }
}

/// A question about a mesh at rest.
type AskedState<S> = Asked<S, 1>;

impl<S> AskedState<S> {
    const fn new(detector: *mut Handle, positions: *const S, vertex_count: usize) -> Self {
        Self {
            detector,
            frames: [("positions", positions)],
            vertex_count,
        }
    }
}

impl<S: Format, const N: usize> Asked<S, N> {
    /// Puts the question, with the frames.
    ///
    /// # Safety
    /// Unless they are null, misaligned or too few, the frames have 3 * `vertex_count` numbers, which nobody writes to meanwhile.
    unsafe fn ask(self, question: impl FnOnce(&mut Finder<S>, &mut Answers, [&[[S; 3]]; N]) -> Result<(), Failure>) -> Status {
        on(self.detector, |it| {
            let found = self.vertex_count;
            let expected = it.topology().vertex_count();
            let Detector { finder, answers, .. } = it;
            let Some(finder) = S::of(finder) else {
                let text = format!("the detector is not for positions in {}", S::NAME);
                return Err(Failure::new(Status::WrongScalar, text));
            };
            if found != expected {
                // Before one of them is looked at.
                let frame = Frame::Start;
                return Err(StepError::WrongLength { frame, found, expected }.into());
            }
            let mut frames: [&[[S; 3]]; N] = [&[]; N];
            for (frame, (name, start)) in frames.iter_mut().zip(self.frames) {
                // SAFETY: the caller's promise.
                *frame = unsafe { view(name, start, found) }?;
            }
            question(finder, answers, frames)
        })
    }
}

unsafe fn find_contacts<S: Format>(asked: AskedStep<S>, contacts: *mut *const ContactRow, count: *mut usize) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        asked.ask(|finder, answers, [start, end]| {
            let out = OutList::new("contacts", contacts, count)?;
            finder.detector.contacts(start, end, &mut finder.contacts)?;
            out.set(answers.show_contacts(finder));
            Ok(())
        })
    }
}

unsafe fn find_contacts_of<S: Format>(
    asked: AskedStep<S>,
    vertex_face: (*const Pair, usize),
    edge_edge: (*const Pair, usize),
    contacts: *mut *const ContactRow,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promises. The pairs may be this detector's candidates, to which nothing is written here.
    unsafe {
        asked.ask(|finder, answers, [start, end]| {
            let out = OutList::new("contacts", contacts, count)?;
            let vertex_face = view("vertex_face", vertex_face.0.cast::<u32>(), vertex_face.1)?;
            let edge_edge = view("edge_edge", edge_edge.0.cast::<u32>(), edge_edge.1)?;
            let found = &mut finder.contacts;
            finder.detector.contacts_of(start, end, vertex_face, edge_edge, found)?;
            out.set(answers.show_contacts(finder));
            Ok(())
        })
    }
}

unsafe fn find_earliest<S: Format>(asked: AskedStep<S>, found: *mut bool, contact: *mut ContactRow) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        asked.ask(|finder, _, [start, end]| {
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

unsafe fn tell_free<S: Format>(asked: AskedStep<S>, is_free: *mut bool) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        asked.ask(|finder, _, [start, end]| {
            let out = Out::new("is_free", is_free)?;
            out.set(finder.detector.is_free(start, end)?);
            Ok(())
        })
    }
}

unsafe fn find_candidates<S: Format>(
    asked: AskedStep<S>,
    boxes: u32,
    vertex_face: (*mut *const Pair, *mut usize),
    edge_edge: (*mut *const Pair, *mut usize),
) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        asked.ask(|finder, answers, [start, end]| {
            let vf = OutList::new("vertex_face", vertex_face.0, vertex_face.1)?;
            let ee = OutList::new("edge_edge", edge_edge.0, edge_edge.1)?;
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

unsafe fn find_intersections<S: Format>(
    asked: AskedState<S>,
    intersections: *mut *const IntersectionRow,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        asked.ask(|finder, answers, [positions]| {
            let out = OutList::new("intersections", intersections, count)?;
            finder.detector.intersections(positions, &mut answers.found_at_rest)?;
            out.set(answers.show_intersections());
            Ok(())
        })
    }
}

unsafe fn tell_intersections<S: Format>(asked: AskedState<S>, has_any: *mut bool) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        asked.ask(|finder, _, [positions]| {
            let out = Out::new("has_any", has_any)?;
            out.set(finder.detector.has_intersections(positions)?);
            Ok(())
        })
    }
}

unsafe fn find_contact_geometries<S: Format>(
    asked: AskedStep<S>,
    contacts: (*const ContactRow, usize),
    geometries: *mut *const GeometryRow,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promises. The contacts may be this detector's own, to which nothing is written here.
    unsafe {
        asked.ask(|finder, answers, [start, end]| {
            let out = OutList::new("geometries", geometries, count)?;
            let rows = view::<_, 1>("contacts", contacts.0, contacts.1)?;
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

unsafe fn find_near<S: Format>(
    asked: AskedState<S>,
    distance: f64,
    geometries: *mut *const GeometryRow,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        asked.ask(|finder, answers, [positions]| {
            let out = OutList::new("geometries", geometries, count)?;
            finder
                .detector
                .near(positions, length(distance)?, &mut answers.found_geometries)?;
            out.set(answers.show_near());
            Ok(())
        })
    }
}

unsafe fn truncate<S: Format>(asked: AskedStep<S>, end: *mut S, truncation: *mut TruncationRow) -> Status {
    let vertex_count = asked.vertex_count;
    let (mut out, mut positions) = (None, Vec::new());
    // SAFETY: the caller's promises.
    let status = unsafe {
        asked.ask(|finder, _, [start, wanted]| {
            let (end, truncation) = (OutFrame::new("end", end, vertex_count)?, Out::new("truncation", truncation)?);
            let found = finder.detector.truncate(start, wanted, &mut positions)?;
            out = Some((end, truncation, found.into()));
            Ok(())
        })
    };
    // Not before the frames are looked at no more: the end may be one of them.
    if let Some((end, truncation, found)) = out {
        end.set(&positions);
        truncation.set(found);
    }
    status
}

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
