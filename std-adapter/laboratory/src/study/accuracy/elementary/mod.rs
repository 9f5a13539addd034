//! Measures what accuracy costs in time, for elementary tests: every test on the same pairs, at tolerances from 1e-2 to 1e-12.
//!
//! # Pairs
//! The sets are the [hard cases](crate::hard_cases) that a format holds exactly, candidates of real steps, and nearly coplanar
//! pairs whose swept boxes overlap. A slow test runs on fewer pairs: in random order until its [budget](AccuracyOptions::budget)
//! is used up. Its counts are of these pairs.
//!
//! # Truth
//! *Whether* a pair touches is decided exactly, in whole numbers, by [`selvedge_core::elementary::contact`](mod@contact), on the
//! coordinates in the given format.
//!
//! *When* it first touches is an algebraic number. The hard cases come with it, enclosed by two neighbouring numbers, which
//! `verification/` has computed with exact rationals. For scenes the time is *enclosed* in `f64`, on the same coordinates. The
//! lower bound comes from advancing with a tolerance of zero. The upper bound is the end of an interval in which contact is
//! certain ([`certain_contact`]). Both are proven; `verification/` checks that the exact time is in between. If the bounds are
//! farther apart than [`WIDEST`] (touching without passing through, resting, sliding), the time is unknown. Such a pair counts
//! for misses only.
//!
//! # Errors
//! A time before the exact one is early by the difference. A time after it is *late*, which is as bad as a miss: a step up to it
//! passes through.

mod measure;
mod truth;

pub use truth::{ExactAnswer, WIDEST, exact_answer};

use super::{AccuracyOptions, PairSet, scene_pairs};
use crate::hard_cases::{ExactContact, hard_cases};
use crate::methods::ElementaryTest;
use crate::study::Frames;
use crate::study::hard_cases::exactly;
use selvedge_core::{PrimitivePair, Scalar, boxes};
use std::error::Error;

#[cfg(doc)]
use selvedge_core::elementary::{advance::certain_contact, contact};

/// The tolerances of the tests, in units of length.
const TOLERANCES: [f64; 7] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12];

/// Every test at every tolerance.
pub const METHODS: [ElementaryTest; 3 * TOLERANCES.len() + 4] = {
    let mut all = [ElementaryTest::Exact; 3 * TOLERANCES.len() + 4];
    let count = TOLERANCES.len();
    let mut index = 0;
    while index < count {
        let tolerance = TOLERANCES[index];
        all[index] = ElementaryTest::Certified(tolerance);
        all[count + 1 + index] = ElementaryTest::TightInclusion(tolerance);
        all[2 * count + 1 + index] = ElementaryTest::Uncertified(tolerance);
        index += 1;
    }
    all[3 * count + 1] = ElementaryTest::Additive;
    all[3 * count + 2] = ElementaryTest::BernsteinSign;
    all[3 * count + 3] = ElementaryTest::Cubic;
    all
};

/// Every elementary test on every set.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementaryAccuracy {
    /// The options. The separation is ignored.
    pub options: AccuracyOptions,
    /// The sets, each in `f32`, then in `f64`.
    pub sets: Vec<ElementarySet>,
}

/// Every elementary test on one set of pairs in one format.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementarySet {
    /// The name of the set.
    pub name: String,
    /// `"f32"` or `"f64"`.
    pub scalar: &'static str,
    /// The number of vertex–face pairs.
    pub vertex_face: usize,
    /// The number of edge–edge pairs.
    pub edge_edge: usize,
    /// The number of pairs that touch.
    pub touching: usize,
    /// The number of touching pairs with a known time.
    pub with_time: usize,
    /// A row for each test, in the order of [`METHODS`].
    pub rows: Vec<ElementaryRow>,
}

/// One test on one set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElementaryRow {
    /// The test.
    pub method: ElementaryTest,
    /// The number of pairs that it ran on.
    pub asked: usize,
    /// The number of these that touch.
    pub touching: usize,
    /// The nanoseconds per pair, one at a time, gathered.
    pub nanoseconds: f64,
    /// The number of touching pairs that it calls free of contact.
    pub missed: usize,
    /// The number of contacts whose time is after the exact one.
    pub late: usize,
    /// The largest delay, in steps.
    pub latest: f64,
    /// The number of pairs without contact that it does not call free of contact.
    pub false_alarms: usize,
    /// The median error of early contact times, in steps. Late ones count as zero. It is `None` without a contact of known time.
    pub early: Option<f64>,
    /// The largest such error.
    pub earliest: f64,
}

/// Pairs in one format, with their exact answers.
struct Questions<S: Scalar> {
    name: String,
    pairs: Vec<PrimitivePair<S>>,
    truth: Vec<ExactAnswer>,
}

/// Measures every elementary test on hard cases, candidates of the arm scene and of all steps of `mesh`, if given, and nearly
/// coplanar pairs. Calls `progress` with the share that is done.
///
/// # Errors
/// Returns an error if threads cannot be started or a frame is not finite.
pub fn measure_elementary_accuracy(
    mesh: Option<&dyn Frames>,
    options: AccuracyOptions,
    progress: &mut dyn FnMut(f64),
) -> Result<ElementaryAccuracy, Box<dyn Error + Send + Sync>> {
    let all = scene_pairs(mesh, options)?;
    let in_each_format = all.in_each_format();
    let count = (2 * in_each_format.len() + 2) as f64;
    let mut sets = Vec::new();
    ask(&of_hard_cases::<f32>(), options, count, &mut sets, progress);
    ask(&of_hard_cases::<f64>(), options, count, &mut sets, progress);
    for [single, double] in in_each_format {
        ask(&of_pairs::<f32>(single), options, count, &mut sets, progress);
        ask(&of_pairs::<f64>(double), options, count, &mut sets, progress);
    }
    Ok(ElementaryAccuracy { options, sets })
}

/// Adds one set to those of `count` that are measured.
fn ask<S: Scalar>(
    questions: &Questions<S>,
    options: AccuracyOptions,
    count: f64,
    sets: &mut Vec<ElementarySet>,
    progress: &mut dyn FnMut(f64),
) {
    let done = sets.len() as f64;
    let share = &mut |part| progress((done + part) / count);
    sets.push(measure::measure(questions, options, share));
}

fn of_hard_cases<S: Scalar>() -> Questions<S> {
    let mut questions = Questions {
        name: "Hard cases".to_owned(),
        pairs: Vec::new(),
        truth: Vec::new(),
    };
    for case in hard_cases() {
        let truth = match &case.contact {
            ExactContact::Never => ExactAnswer::Never,
            ExactContact::First { from, to, .. } => ExactAnswer::Touches {
                first: Some([*from, *to]),
            },
            // A pair that is not finite has no exact answer.
            ExactContact::Undefined => continue,
        };
        if let Some(pair) = exactly::<S>(case) {
            questions.pairs.push(pair);
            questions.truth.push(truth);
        }
    }
    questions
}

/// Returns the pairs whose swept boxes overlap.
fn of_pairs<S: Scalar>(set: &PairSet) -> Questions<S> {
    let rows = set.rows::<S>();
    let mut pairs = Vec::new();
    for (kind, indices) in set.by_kind() {
        let all = indices
            .iter()
            .map(|indices| PrimitivePair::new(kind, indices.map(|index| rows[index as usize].motion())));
        pairs.extend(all.filter(|pair| !boxes::swept_boxes(pair).is_culled()));
    }
    let truth = pairs.iter().map(exact_answer);
    Questions {
        name: set.name.clone(),
        truth: truth.collect(),
        pairs,
    }
}

#[cfg(test)]
mod tests;
