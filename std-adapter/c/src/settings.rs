//! How a detector is to look, and what it knows of its mesh.

use crate::answers::Pair;
use crate::detector::{Detector, Handle, on, with_either};
use crate::handles;
use crate::input::{Out, OutList, view};
use crate::status::{Failure, Status};
use selvedge::core::elementary::Limits;
use selvedge::core::narrowing::rounded_up;
use selvedge::{CollisionFilter, Criterion, Groups, Scalar, StepError, Threads};

// The next two are for the header, and for tests.
/// At first the tolerance of detectors for float: 2^-20, a micrometre where positions are in metres.
#[allow(dead_code)]
pub const SELVEDGE_DEFAULT_TOLERANCE_F32: f64 = 9.5367431640625e-7;
/// At first the tolerance of detectors for double: 2^-30, a nanometre where positions are in metres.
#[allow(dead_code)]
pub const SELVEDGE_DEFAULT_TOLERANCE_F64: f64 = 9.313225746154785e-10;

/// A length in the format of the positions, not less than it was given: what is asked for is kept.
pub(crate) fn length<S: Scalar>(given: f64) -> Result<S, Failure> {
    if given >= 0.0 && given.is_finite() {
        Ok(rounded_up(given))
    } else {
        Err(StepError::BadLimit { length: given }.into())
    }
}

/// How many threads steps are split between: 1, as at first, is the one that calls; more are the detector's own; 0 is one for
/// each core. Answers are the same bit for bit. More than four for each core, and more than 256, are refused.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_threads(detector: *mut Handle, count: usize) -> Status {
    handles::on::<Detector>(detector, |kept, it| {
        with_either!(&mut it.finder, finder => finder.detector.set_threads(Threads::from_count(count)))?;
        kept.set_has_threads(count != 1);
        Ok(())
    })
}

/// Contacts are pairs that cannot be proven to stay farther apart than `separation`; those that only come within `tolerance` of it
/// may be among them. At first the separation is 0, the tolerance SELVEDGE_DEFAULT_TOLERANCE_F32 or _F64.
///
/// Both in the unit of the positions. For a detector for float they are rounded up to a float.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_within(detector: *mut Handle, separation: f64, tolerance: f64) -> Status {
    on(detector, |it| {
        with_either!(&mut it.finder, finder => {
            let (separation, tolerance) = (length(separation)?, length(tolerance)?);
            finder.detector.set_criterion(Criterion::Within(Limits { tolerance, separation }))?;
        });
        Ok(())
    })
}

/// Contacts are only pairs that truly touch, decided exactly. A time may be as much too early as the pair needs to come closer by
/// `tolerance`.
///
/// In the unit of the positions. For a detector for float it is rounded up to a float.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_touching(detector: *mut Handle, tolerance: f64) -> Status {
    on(detector, |it| {
        with_either!(&mut it.finder, finder => {
            let tolerance = length(tolerance)?;
            finder.detector.set_criterion(Criterion::Touching { tolerance })?;
        });
        Ok(())
    })
}

/// Names the vertices that move: for each of them a byte that is not 0. NULL and 0: all of them, as at first.
///
/// From the next step on pairs of which no vertex moves are not looked at. Positions of vertices that do not move are taken from
/// the next step, and not looked at again until this is called anew. The bytes are copied.
///
/// # Safety
/// `moving` points to `count` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_set_moving(detector: *mut Handle, moving: *const u8, count: usize) -> Status {
    on(detector, |it| {
        let expected = it.topology().vertex_count();
        if moving.is_null() && count == 0 {
            with_either!(&mut it.finder, finder => finder.detector.set_moving(None))?;
            return Ok(());
        }
        if count != expected {
            // Before one of them is looked at.
            return Err(StepError::WrongCount { found: count, expected }.into());
        }
        // SAFETY: the caller's promise.
        let given = unsafe { view::<_, 1>("moving", moving, count) }?;
        let moving: Vec<bool> = given.iter().map(|&[byte]| byte != 0).collect();
        with_either!(&mut it.finder, finder => finder.detector.set_moving(Some(&moving)))?;
        Ok(())
    })
}

/// What a vertex belongs to, and what it collides with, a bit for each group: two vertices collide if each is in a group that the
/// other's filter has.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct GroupsRow {
    /// The groups that it is in.
    pub memberships: u32,
    /// The groups that it collides with.
    pub filter: u32,
}

/// Which pairs are looked at from the next step on, in place of what was said before. Vertices do not collide whose groups do
/// not, that are of one patch, or that are an excluded pair, in either order; a pair is not looked at if no vertex of one side
/// collides with any of the other. NULL: no such rule. All three NULL: all pairs are looked at, as at first.
///
/// `groups` and `patches` have an entry for each vertex, `vertex_count` of them; it is not looked at if both are NULL. Pairs of
/// selvedge_detector_contacts_of_f64 are looked at whatever this says. All is copied.
///
/// # Safety
/// `groups` and `patches` are NULL or point to `vertex_count` entries, `excluded` to `excluded_count` pairs of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_set_collision_filter(
    detector: *mut Handle,
    groups: *const GroupsRow,
    patches: *const u32,
    vertex_count: usize,
    excluded: *const Pair,
    excluded_count: usize,
) -> Status {
    on(detector, |it| {
        let expected = it.topology().vertex_count();
        let has_entries = !groups.is_null() || !patches.is_null();
        if has_entries && vertex_count != expected {
            // Before one of them is looked at.
            let found = vertex_count;
            return Err(StepError::WrongCount { found, expected }.into());
        }
        let mut filter = CollisionFilter::new();
        if !groups.is_null() {
            // SAFETY: the caller's promise. Two numbers in a row, whether as fields or as an array.
            let given = unsafe { view("groups", groups.cast::<u32>(), vertex_count) }?;
            let groups = given.iter().map(|&[memberships, filter]| Groups::new(memberships, filter));
            filter = filter.with_groups(groups.collect());
        }
        if !patches.is_null() {
            // SAFETY: the caller's promise.
            let given = unsafe { view::<_, 1>("patches", patches, vertex_count) }?;
            filter = filter.with_patches(given.as_flattened().to_vec());
        }
        // SAFETY: the caller's promise. Two numbers in a row, as above.
        let excluded = unsafe { view::<_, 2>("excluded", excluded.cast::<u32>(), excluded_count) }?;
        filter = filter.without_vertex_pairs(excluded.iter().copied());
        with_either!(&mut it.finder, finder => finder.detector.set_collision_filter(filter))?;
        Ok(())
    })
}

/// Whether steps go on from one another, as those of a simulation do: 0, as at first, or not 0. Then a step takes less time where
/// vertices move by much less than an edge. The contacts are the same, in ascending order of their pairs' numbers.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_coherent(detector: *mut Handle, coherent: i32) -> Status {
    on(detector, |it| {
        with_either!(&mut it.finder, finder => finder.detector.set_coherent(coherent != 0));
        Ok(())
    })
}

/// Most pairs that a question may look at, of those that boxes leave; UINT64_MAX, as at first: as many as there are. One with
/// more fails with SELVEDGE_STATUS_TOO_MANY_PAIRS, on any number of threads.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_pair_limit(detector: *mut Handle, limit: u64) -> Status {
    on(detector, |it| {
        let limit = Some(limit).filter(|&limit| limit != u64::MAX);
        with_either!(&mut it.finder, finder => finder.detector.set_pair_limit(limit));
        Ok(())
    })
}

/// How many threads a step uses.
///
/// # Safety
/// `count` points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_threads(detector: *const Handle, count: *mut usize) -> Status {
    on(detector, |it| {
        // SAFETY: the caller's promise.
        let out = unsafe { Out::new("the count", count) }?;
        out.set(with_either!(&it.finder, finder => finder.detector.threads()));
        Ok(())
    })
}

/// The edges of the mesh by their numbers, each as its vertices, the smaller first; `count` becomes how many there are.
///
/// They stay where they are until the detector is freed.
///
/// # Safety
/// `edges` points to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_edges(detector: *const Handle, edges: *mut *const Pair, count: *mut usize) -> Status {
    on(detector, |it| {
        // SAFETY: the caller's promise.
        let out = unsafe { OutList::new("edges", edges, count) }?;
        out.set_pairs(it.topology().edges());
        Ok(())
    })
}
