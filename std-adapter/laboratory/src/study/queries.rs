//! Measures how often each test of one primitive pair is right, and how long it takes, on queries whose truth may be known.
//!
//! # Time
//! A test takes a few nanoseconds, reading the clock tens of them. Each query is therefore repeated until two microseconds have
//! passed, a hundred times the clock's own cost. A query's time is that of the whole run over its length, in the fastest of three
//! runs, so that an interruption does not count. The pair is then in the cache and the processor's branches are trained on it:
//! the time is that of the arithmetic.

use crate::methods::{QueryMethod, WithTest};
use crate::queries::Query;
use selvedge::PairKind;
use selvedge_core::{PrimitivePair, Scalar};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// One method's answers to all queries of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct QueryResult {
    /// The method.
    pub method: QueryMethod,
    /// The kind of pairs.
    pub kind: PairKind,
    /// The number of queries.
    pub queries: usize,
    /// The number of queries that the method did not cull, or found to touch.
    pub positives: usize,
    /// The comparison with the truth; `None` unless it is known for all queries.
    pub truth: Option<TruthCounts>,
    /// The time of a query.
    pub nanoseconds: Nanoseconds,
}

/// A method's answers compared with the truth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TruthCounts {
    /// The number of queries that collide.
    pub positives: usize,
    /// The number of queries that do not collide, and that the method kept.
    pub false_positives: usize,
    /// The number of queries that collide, and that the method culled or missed. A certified method has none.
    pub false_negatives: usize,
}

/// Times of single queries, in nanoseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Nanoseconds {
    /// The mean.
    pub mean: f64,
    /// The time that half of the queries do not exceed.
    pub median: f64,
    /// The time that 99 in 100 queries do not exceed.
    pub p99: f64,
    /// The time of the slowest query.
    pub max: f64,
}

/// Runs `method` on each of `queries`, all of one kind. Calls `progress` after each with the number that is done.
pub fn measure_queries<S: Scalar>(
    method: QueryMethod,
    kind: PairKind,
    queries: &[Query<S>],
    progress: &mut dyn FnMut(usize),
) -> QueryResult {
    method.run(MethodRun {
        kind,
        method,
        queries,
        progress,
    })
}

struct MethodRun<'a, S: Scalar> {
    method: QueryMethod,
    kind: PairKind,
    queries: &'a [Query<S>],
    progress: &'a mut dyn FnMut(usize),
}

impl<S: Scalar> WithTest<S, bool> for MethodRun<'_, S> {
    type Outcome = QueryResult;

    fn with(self, keeps: impl Fn(&PrimitivePair<S>) -> bool) -> QueryResult {
        let mut watch = StopWatch { repeats: 1 };
        let mut times = Vec::with_capacity(self.queries.len());
        let mut positives = 0;
        let mut truth = Some(TruthCounts::default());
        for (index, query) in self.queries.iter().enumerate() {
            let pair = query.pair;
            let (positive, nanoseconds) = watch.time(|| keeps(black_box(&pair)));
            times.push(nanoseconds);
            positives += usize::from(positive);
            truth = truth.zip(query.collides).map(|(mut truth, collides)| {
                truth.positives += usize::from(collides);
                truth.false_positives += usize::from(positive && !collides);
                truth.false_negatives += usize::from(!positive && collides);
                truth
            });
            (self.progress)(index + 1);
        }
        QueryResult {
            method: self.method,
            kind: self.kind,
            queries: self.queries.len(),
            positives,
            truth,
            nanoseconds: Nanoseconds::from_times(times),
        }
    }
}

impl Nanoseconds {
    /// Computes the times. All are zero without any.
    fn from_times(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        let Some(&max) = times.last() else {
            return Self::default();
        };
        // The rank is the nearest: the smallest time that this percentage of all times does not exceed.
        let percentile = |percent: usize| times[(times.len() * percent).div_ceil(100).max(1) - 1];
        Self {
            mean: times.iter().sum::<f64>() / times.len() as f64,
            median: percentile(50),
            p99: percentile(99),
            max,
        }
    }
}

/// A clock for calls that are too short for the system's clock.
struct StopWatch {
    /// The repetitions of the last query: a good guess for the next.
    repeats: u32,
}

impl StopWatch {
    /// The length of a run: a hundred times the cost of reading the clock, which is 20 ns or so.
    const RUN: Duration = Duration::from_micros(2);
    const RUNS: usize = 3;

    /// Returns the answer of `call`, and its time in nanoseconds.
    fn time(&mut self, call: impl Fn() -> bool) -> (bool, f64) {
        let run = |repeats: u32| {
            let begin = Instant::now();
            for _ in 0..repeats {
                black_box(call());
            }
            begin.elapsed()
        };
        let mut fastest = run(self.repeats);
        while fastest < Self::RUN {
            self.repeats = self.repeats.saturating_mul(2);
            fastest = run(self.repeats);
        }
        for _ in 1..Self::RUNS {
            fastest = fastest.min(run(self.repeats));
        }
        let nanoseconds = fastest.as_secs_f64() * 1e9 / f64::from(self.repeats);
        if fastest > 4 * Self::RUN {
            self.repeats = (self.repeats / 2).max(1);
        }
        (call(), nanoseconds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use selvedge::glam::DVec3;
    use selvedge_core::Motion;

    /// Makes a query of a vertex that falls from z = 1 to z = `end` above the middle of a resting triangle.
    fn fall(end: f64, collides: Option<bool>) -> Query {
        let at = |z| DVec3::new(0.25, 0.25, z);
        let face = [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting);
        Query {
            pair: PrimitivePair::vertex_face(Motion::new(at(1.0), at(end)), face),
            collides,
            line: 1,
        }
    }

    fn measure(method: QueryMethod, queries: &[Query]) -> QueryResult {
        measure_queries::<f64>(method, PairKind::VertexFace, queries, &mut |_| ())
    }

    #[test]
    fn every_method_keeps_a_hit_and_culls_a_miss() {
        let queries = [fall(-1.0, Some(true)), fall(0.5, Some(false))];
        for method in QueryMethod::ALL {
            let result = measure(method, &queries);
            let truth = TruthCounts {
                positives: 1,
                ..TruthCounts::default()
            };
            assert_eq!((result.positives, result.truth), (1, Some(truth)), "{method}");
        }
    }

    #[test]
    fn answers_against_the_truth_are_counted() {
        let queries = [fall(-1.0, Some(false)), fall(0.5, Some(true))];
        let truth = TruthCounts {
            positives: 1,
            false_positives: 1,
            false_negatives: 1,
        };
        assert_eq!(measure(QueryMethod::Selvedge, &queries).truth, Some(truth));
    }

    #[test]
    fn one_query_without_truth_leaves_nothing_to_compare_with() {
        let queries = [fall(-1.0, Some(true)), fall(0.5, None)];
        assert_eq!(measure(QueryMethod::Selvedge, &queries).truth, None);
    }

    #[test]
    fn percentiles_are_of_the_nearest_rank() {
        let times = (1..=200).rev().map(f64::from).collect();
        let expected = Nanoseconds {
            mean: 100.5,
            median: 100.0,
            p99: 198.0,
            max: 200.0,
        };
        assert_eq!(Nanoseconds::from_times(times), expected);
        let one = Nanoseconds::from_times(vec![7.0]);
        assert_eq!((one.median, one.p99, one.max), (7.0, 7.0, 7.0));
    }

    #[test]
    fn names_read_back() {
        for method in QueryMethod::ALL {
            assert_eq!(method.name().parse(), Ok(method));
        }
    }

    #[test]
    fn the_error_about_an_unknown_name_lists_the_known_ones() {
        let message = "quartic".parse::<QueryMethod>().unwrap_err().to_string();
        assert!(
            message.contains("no method `quartic`") && message.contains("dop_18, cubic"),
            "{message}"
        );
    }
}
