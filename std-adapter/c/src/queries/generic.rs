//! The queries, generic over the format of the positions.

use crate::answers::{Answers, Boxes, CandidatePairs, ContactRow, GeometryRow, IntersectionRow, Pair, TruncationRow};
use crate::detector::{Detector, Finder, Format, Handle, on};
use crate::input::{Out, OutFrame, OutList, unknown, view};
use crate::settings::length;
use crate::status::{Failure, Status};
use selvedge::{CandidateBoxes, Frame, StepError};

/// The arguments of a query, as C passes them: `N` frames of a mesh, with their names.
pub(super) struct Query<S, const N: usize> {
    detector: *mut Handle,
    frames: [(&'static str, *const S); N],
    vertex_count: usize,
}

pub(super) type StepQuery<S> = Query<S, 2>;

impl<S> StepQuery<S> {
    pub(super) const fn new(detector: *mut Handle, start: *const S, end: *const S, vertex_count: usize) -> Self {
        Self::between(detector, [("start", start), ("end", end)], vertex_count)
    }

    pub(super) const fn between(detector: *mut Handle, frames: [(&'static str, *const S); 2], vertex_count: usize) -> Self {
        Self {
            detector,
            frames,
            vertex_count,
        }
    }
}

pub(super) type StateQuery<S> = Query<S, 1>;

impl<S> StateQuery<S> {
    pub(super) const fn new(detector: *mut Handle, positions: *const S, vertex_count: usize) -> Self {
        Self {
            detector,
            frames: [("positions", positions)],
            vertex_count,
        }
    }
}

impl<S: Format, const N: usize> Query<S, N> {
    /// Runs `search` with the frames.
    ///
    /// # Safety
    /// Unless they are null or misaligned, the frames have 3 * `vertex_count` numbers, and no other thread writes to them.
    unsafe fn run(self, search: impl FnOnce(&mut Finder<S>, &mut Answers, [&[[S; 3]]; N]) -> Result<(), Failure>) -> Status {
        on(self.detector, |it| {
            let found = self.vertex_count;
            let expected = it.topology().vertex_count();
            let Detector { finder, answers, .. } = it;
            let Some(finder) = S::of(finder) else {
                let text = format!("the detector is not for positions in {}", S::NAME);
                return Err(Failure::new(Status::WrongScalar, text));
            };
            if found != expected {
                // The count is checked before any number is read.
                let frame = Frame::Start;
                return Err(StepError::WrongLength { frame, found, expected }.into());
            }
            let mut frames: [&[[S; 3]]; N] = [&[]; N];
            for (frame, (name, start)) in frames.iter_mut().zip(self.frames) {
                // SAFETY: the caller's promise.
                *frame = unsafe { view(name, start, found) }?;
            }
            search(finder, answers, frames)
        })
    }
}

pub(super) unsafe fn find_contacts<S: Format>(
    query: StepQuery<S>,
    contacts: *mut *const ContactRow,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        query.run(|finder, answers, [start, end]| {
            let out = OutList::new("contacts", contacts, count)?;
            finder.detector.contacts(start, end, &mut finder.contacts)?;
            out.set(answers.show_contacts(&finder.contacts, finder.detector.topology()));
            Ok(())
        })
    }
}

pub(super) unsafe fn find_contacts_of<S: Format>(
    query: StepQuery<S>,
    vertex_face: (*const Pair, usize),
    edge_edge: (*const Pair, usize),
    contacts: *mut *const ContactRow,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promises. The pairs may be this detector's candidates; they are not written to here.
    unsafe {
        query.run(|finder, answers, [start, end]| {
            let out = OutList::new("contacts", contacts, count)?;
            let vertex_face = view("vertex_face", vertex_face.0.cast::<u32>(), vertex_face.1)?;
            let edge_edge = view("edge_edge", edge_edge.0.cast::<u32>(), edge_edge.1)?;
            let found = &mut finder.contacts;
            finder.detector.contacts_of(start, end, vertex_face, edge_edge, found)?;
            out.set(answers.show_contacts(&finder.contacts, finder.detector.topology()));
            Ok(())
        })
    }
}

pub(super) unsafe fn find_earliest<S: Format>(query: StepQuery<S>, found: *mut bool, contact: *mut ContactRow) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        query.run(|finder, _, [start, end]| {
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

pub(super) unsafe fn answer_free<S: Format>(query: StepQuery<S>, is_free: *mut bool) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        query.run(|finder, _, [start, end]| {
            let out = Out::new("is_free", is_free)?;
            out.set(finder.detector.is_free(start, end)?);
            Ok(())
        })
    }
}

pub(super) unsafe fn find_candidates<S: Format>(
    query: StepQuery<S>,
    boxes: u32,
    vertex_face: (*mut *const Pair, *mut usize),
    edge_edge: (*mut *const Pair, *mut usize),
) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        query.run(|finder, answers, [start, end]| {
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

pub(super) unsafe fn find_intersections<S: Format>(
    query: StateQuery<S>,
    intersections: *mut *const IntersectionRow,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        query.run(|finder, answers, [positions]| {
            let out = OutList::new("intersections", intersections, count)?;
            finder.detector.intersections(positions, &mut answers.found_at_rest)?;
            out.set(answers.show_intersections());
            Ok(())
        })
    }
}

pub(super) unsafe fn answer_has_intersections<S: Format>(query: StateQuery<S>, has_any: *mut bool) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        query.run(|finder, _, [positions]| {
            let out = Out::new("has_any", has_any)?;
            out.set(finder.detector.has_intersections(positions)?);
            Ok(())
        })
    }
}

pub(super) unsafe fn find_contact_geometries<S: Format>(
    query: StepQuery<S>,
    contacts: (*const ContactRow, usize),
    geometries: *mut *const GeometryRow,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promises. The contacts may be this detector's own; they are not written to here.
    unsafe {
        query.run(|finder, answers, [start, end]| {
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

pub(super) unsafe fn find_near<S: Format>(
    query: StateQuery<S>,
    distance: f64,
    geometries: *mut *const GeometryRow,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        query.run(|finder, answers, [positions]| {
            let out = OutList::new("geometries", geometries, count)?;
            finder
                .detector
                .near(positions, length(distance)?, &mut answers.found_geometries)?;
            out.set(answers.show_near());
            Ok(())
        })
    }
}

pub(super) unsafe fn truncate<S: Format>(query: StepQuery<S>, end: *mut S, truncation: *mut TruncationRow) -> Status {
    let vertex_count = query.vertex_count;
    let (mut out, mut positions) = (None, Vec::new());
    // SAFETY: the caller's promises.
    let status = unsafe {
        query.run(|finder, _, [start, wanted]| {
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
