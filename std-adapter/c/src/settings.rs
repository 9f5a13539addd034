//! The settings of a detector, and the edges of its mesh.

use crate::answers::PairRow;
use crate::detector::{Detector, Handle, on, with_either};
use crate::handles;
use crate::input::{Out, OutList, view};
use crate::status::{Failure, Status};
use selvedge::core::elementary::Limits;
use selvedge::core::narrowing::rounded_up;
use selvedge::{CollisionFilter, Criterion, Groups, Scalar, StepError, Threads};

// Only the header and the tests use the next two.
/// The default tolerance of detectors for float: 2^-20, a micrometre if positions are in metres.
#[allow(dead_code)]
pub const SELVEDGE_DEFAULT_TOLERANCE_F32: f64 = 9.5367431640625e-7;
/// The default tolerance of detectors for double: 2^-30, a nanometre if positions are in metres.
#[allow(dead_code)]
pub const SELVEDGE_DEFAULT_TOLERANCE_F64: f64 = 9.313225746154785e-10;

/// Rounds a length up to the format of the positions, so that the requested distance is kept.
pub(crate) fn length<S: Scalar>(given: f64) -> Result<S, Failure> {
    if given >= 0.0 && given.is_finite() {
        Ok(rounded_up(given))
    } else {
        Err(StepError::BadLimit { length: given }.into())
    }
}

/// Sets the number of threads of a step. 1, the default, is the calling thread; larger numbers start threads of the detector; 0
/// is one for each core. Answers are the same bit for bit. More than four for each core, or more than 256, are refused.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_threads(detector: *mut Handle, count: usize) -> Status {
    handles::on::<Detector>(detector, |kept, it| {
        with_either!(&mut it.finder, finder => finder.detector.set_threads(Threads::from_count(count)))?;
        kept.set_has_threads(count != 1);
        Ok(())
    })
}

/// Reports pairs that may come within `separation` of each other. A pair that only comes within `separation + tolerance` may be
/// among them. By default the separation is 0 and the tolerance is SELVEDGE_DEFAULT_TOLERANCE_F32 or _F64.
///
/// Both are in the unit of the positions. A detector for float rounds them up to a float.
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

/// Reports only pairs that truly touch, decided exactly. A reported time may be early: by as long as the pair takes to close the
/// distance `tolerance`.
///
/// The tolerance is in the unit of the positions. A detector for float rounds it up to a float.
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

/// Names the moving vertices: a byte for each vertex, not 0 if it moves. With NULL and 0, the default, all vertices move.
///
/// From the next step on, pairs without a moving vertex are skipped. The next step sets the positions of resting vertices; they
/// are not read again until the next call of this function. The bytes are copied.
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
            // The count is checked before any byte is read.
            return Err(StepError::WrongCount { found: count, expected }.into());
        }
        // SAFETY: the caller's promise.
        let given = unsafe { view::<_, 1>("moving", moving, count) }?;
        let moving: Vec<bool> = given.iter().map(|&[byte]| byte != 0).collect();
        with_either!(&mut it.finder, finder => finder.detector.set_moving(Some(&moving)))?;
        Ok(())
    })
}

/// The groups of a vertex and the groups it collides with, a bit for each group. Two vertices collide if each is in a group of
/// the other's filter.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct GroupsRow {
    /// The groups that it is in.
    pub memberships: u32,
    /// The groups that it collides with.
    pub filter: u32,
}

/// Sets the collision filter, from the next step on. It replaces the previous one.
///
/// Two vertices do not collide if their groups do not, if they have the same patch, or if they are an excluded pair, in either
/// order. A pair of primitives is skipped if no vertex of one side collides with any vertex of the other. NULL omits a rule; with
/// all three NULL, the default, no pair is skipped.
///
/// `groups` and `patches` have an entry for each of the `vertex_count` vertices; the count is ignored if both are NULL. The
/// filter does not apply to selvedge_detector_contacts_of_f64. All arguments are copied.
///
/// # Safety
/// `groups` and `patches` are NULL or point to `vertex_count` entries, `excluded` to `excluded_count` pairs of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_set_collision_filter(
    detector: *mut Handle,
    groups: *const GroupsRow,
    patches: *const u32,
    vertex_count: usize,
    excluded: *const PairRow,
    excluded_count: usize,
) -> Status {
    on(detector, |it| {
        let expected = it.topology().vertex_count();
        let has_entries = !groups.is_null() || !patches.is_null();
        if has_entries && vertex_count != expected {
            // The count is checked before any entry is read.
            let found = vertex_count;
            return Err(StepError::WrongCount { found, expected }.into());
        }
        let mut filter = CollisionFilter::new();
        if !groups.is_null() {
            // SAFETY: the caller's promise. Two numbers have the same layout as fields and as an array.
            let given = unsafe { view("groups", groups.cast::<u32>(), vertex_count) }?;
            let groups = given.iter().map(|&[memberships, filter]| Groups::new(memberships, filter));
            filter = filter.with_groups(groups.collect());
        }
        if !patches.is_null() {
            // SAFETY: the caller's promise.
            let given = unsafe { view::<_, 1>("patches", patches, vertex_count) }?;
            filter = filter.with_patches(given.as_flattened().to_vec());
        }
        // SAFETY: the caller's promise. The layout is two numbers, as above.
        let excluded = unsafe { view::<_, 2>("excluded", excluded.cast::<u32>(), excluded_count) }?;
        filter = filter.without_vertex_pairs(excluded.iter().copied());
        with_either!(&mut it.finder, finder => finder.detector.set_collision_filter(filter))?;
        Ok(())
    })
}

/// Sets whether each step starts where the last one ended, as in a simulation: not 0, or 0 as by default. Such steps are faster
/// if vertices move by much less than an edge. The contacts are the same, in ascending order of their pairs.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_coherent(detector: *mut Handle, coherent: i32) -> Status {
    on(detector, |it| {
        with_either!(&mut it.finder, finder => finder.detector.set_coherent(coherent != 0));
        Ok(())
    })
}

/// Limits the number of candidate pairs of a call. UINT64_MAX, the default, is no limit. A call with more pairs fails with
/// SELVEDGE_STATUS_TOO_MANY_PAIRS, on any number of threads.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_pair_limit(detector: *mut Handle, limit: u64) -> Status {
    on(detector, |it| {
        let limit = Some(limit).filter(|&limit| limit != u64::MAX);
        with_either!(&mut it.finder, finder => finder.detector.set_pair_limit(limit));
        Ok(())
    })
}

/// Limits the memory of the pairs and contacts of a call, in bytes, at 48 bytes for a contact. The default is 2 GiB; UINT64_MAX
/// is no limit. A call that needs more fails with SELVEDGE_STATUS_TOO_MUCH_MEMORY, on any number of threads.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_detector_set_memory_limit(detector: *mut Handle, limit: u64) -> Status {
    on(detector, |it| {
        let limit = Some(limit).filter(|&limit| limit != u64::MAX);
        with_either!(&mut it.finder, finder => finder.detector.set_memory_limit(limit));
        Ok(())
    })
}

/// Returns the number of threads of a step.
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

/// Returns the edges of the mesh in the order of their numbers. Each is a pair of vertices, the smaller number first.
///
/// The list stays valid until the detector is freed.
///
/// # Safety
/// `edges` points to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_detector_edges(
    detector: *const Handle,
    edges: *mut *const PairRow,
    count: *mut usize,
) -> Status {
    on(detector, |it| {
        // SAFETY: the caller's promise.
        let out = unsafe { OutList::new("edges", edges, count) }?;
        out.set_pairs(it.topology().edges());
        Ok(())
    })
}
