//! Times and counts elementary tests on one set of pairs in one format.

use super::{ElementaryRow, ElementarySet, ExactAnswer, METHODS, Questions};
use crate::methods::ElementaryTest;
use crate::study::AccuracyOptions;
use fastrand::Rng;
use selvedge_core::{PairKind, Scalar};
use std::hint::black_box;
use std::ops::Range;
use std::time::{Duration, Instant};

/// The number of pairs that a test runs on between two readings of the clock. Reading it takes as long as one pair of the fastest
/// test.
const CHUNK: usize = 16;

/// Runs every method.
pub(super) fn measure<S: Scalar>(
    questions: &Questions<S>,
    options: AccuracyOptions,
    progress: &mut dyn FnMut(f64),
) -> ElementarySet {
    let Questions { name, pairs, truth } = questions;
    let order = chunks(pairs.len(), options.seed);
    let mut rows = Vec::new();
    for method in METHODS {
        rows.push(ask(method, questions, &order, options));
        progress(rows.len() as f64 / METHODS.len() as f64);
    }
    let vertex_face = pairs.iter().filter(|pair| pair.kind == PairKind::VertexFace).count();
    let touches = |answer: &&ExactAnswer| matches!(answer, ExactAnswer::Touches { .. });
    let is_known = |answer: &&ExactAnswer| matches!(answer, ExactAnswer::Touches { first: Some(_) });
    ElementarySet {
        name: name.clone(),
        scalar: S::NAME,
        vertex_face,
        edge_edge: pairs.len() - vertex_face,
        touching: truth.iter().filter(touches).count(),
        with_time: truth.iter().filter(is_known).count(),
        rows,
    }
}

/// Splits all pairs into chunks of neighbours, in random order, so that the first ones represent all.
fn chunks(pairs: usize, seed: u64) -> Vec<Range<usize>> {
    let starts = (0..pairs).step_by(CHUNK);
    let mut chunks: Vec<_> = starts.map(|start| start..(start + CHUNK).min(pairs)).collect();
    Rng::with_seed(seed).shuffle(&mut chunks);
    chunks
}

fn ask<S: Scalar>(
    method: ElementaryTest,
    questions: &Questions<S>,
    order: &[Range<usize>],
    options: AccuracyOptions,
) -> ElementaryRow {
    let AccuracyOptions { repeat, budget, .. } = options;
    let mut counts = AnswerCounts::default();
    let mut answers = [None; CHUNK];
    let begin = Instant::now();
    for chunk in order {
        let pairs = &questions.pairs[chunk.clone()];
        let mut fastest = Duration::MAX;
        for _ in 0..repeat.max(1) {
            let begin = Instant::now();
            for (pair, answer) in pairs.iter().zip(&mut answers) {
                *answer = black_box(method.time(black_box(pair)));
            }
            fastest = fastest.min(begin.elapsed());
            // A slow chunk is not worth repeating, unless another process has interrupted it for some 10 ms.
            if fastest > budget / 8 {
                break;
            }
        }
        counts.seconds += fastest.as_secs_f64();
        for (answer, truth) in answers.iter().zip(&questions.truth[chunk.clone()]) {
            counts.count(answer.map(S::to_f64), truth);
        }
        // The check comes last, so that there is a time and a count however short the budget is.
        if begin.elapsed() > budget {
            break;
        }
    }
    counts.row(method)
}

#[derive(Default)]
struct AnswerCounts {
    asked: usize,
    touching: usize,
    seconds: f64,
    missed: usize,
    late: usize,
    latest: f64,
    false_alarms: usize,
    early: Vec<f64>,
}

impl AnswerCounts {
    fn count(&mut self, answer: Option<f64>, truth: &ExactAnswer) {
        self.asked += 1;
        match (answer, truth) {
            (None, ExactAnswer::Never) => {}
            (Some(_), ExactAnswer::Never) => self.false_alarms += 1,
            (None, ExactAnswer::Touches { .. }) => {
                self.touching += 1;
                self.missed += 1;
            }
            (Some(time), ExactAnswer::Touches { first }) => {
                self.touching += 1;
                let Some([from, to]) = *first else { return };
                if time.is_nan() {
                    return;
                }
                if time > to {
                    self.late += 1;
                    self.latest = self.latest.max(time - to);
                }
                self.early.push((from - time).max(0.0));
            }
        }
    }

    fn row(mut self, method: ElementaryTest) -> ElementaryRow {
        self.early.sort_by(f64::total_cmp);
        ElementaryRow {
            method,
            asked: self.asked,
            touching: self.touching,
            nanoseconds: self.seconds * 1e9 / self.asked as f64,
            missed: self.missed,
            late: self.late,
            latest: self.latest,
            false_alarms: self.false_alarms,
            early: self.early.get(self.early.len() / 2).copied(),
            earliest: self.early.last().copied().unwrap_or_default(),
        }
    }
}
