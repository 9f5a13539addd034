//! How often each test of one primitive pair is right, and how long it takes, on queries whose truth may be known.
//!
//! # Time
//! A test takes a few nanoseconds, reading the clock tens of them. So each query is tested again and again, as often as
//! it takes to fill two microseconds, a hundred times the clock's own cost; a query's time is that of the whole run over
//! its length, in the fastest of three runs, so that an interruption is not taken for a slow query. The pair is then in
//! the cache and the processor's branches are trained on it: what is measured is the arithmetic.

use crate::baselines::{additive, bernstein_sign, cubic, plain, tight_inclusion};
use crate::pipeline::{CullingTest, Preset, Stages};
use selvedge::PairKind;
use selvedge_core::boxes::{self, Dop18};
use selvedge_core::elementary::{Contact, Impact, Limits, advance::time_of_impact};
use selvedge_core::{PrimitivePair, Scalar, Verdict, elementary, filter};
use selvedge_files::queries::Query;
use std::fmt;
use std::hint::black_box;
use std::str::FromStr;
use std::time::{Duration, Instant};

/// A test of one primitive pair, by its name on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum QueryMethod {
    /// All stages of [`Preset::Selvedge`] from its culling tests on: they, then the certified time of impact.
    Selvedge,
    /// [`elementary::contact`](mod@elementary::contact), the exact verdict.
    Exact,
    /// [`elementary::advance`] alone, the certified time of impact with its default tolerance.
    TimeOfImpact,
    /// [`CullingTest::CertifiedNonCoplanarity`] alone.
    NonCoplanarity,
    /// [`CullingTest::PlainNonCoplanarity`] alone, as printed in the paper. **Not certified.**
    NonCoplanarityPlain,
    /// [`CullingTest::RelativeBoxes`] alone.
    RelativeBoxes,
    /// [`CullingTest::RelativeBoxesNine`] alone.
    RelativeBoxesNine,
    /// [`CullingTest::SweptBoxes`] alone.
    SweptBoxes,
    /// [`CullingTest::SegmentBox`] alone, the paper's box tests.
    SegmentBox,
    /// [`CullingTest::StoredDop18`] alone, the DOPs made from the pair.
    Dop18,
    /// [`cubic`], Provot's test. **Not certified**: it misses contacts.
    Cubic,
    /// [`bernstein_sign`], Tang et al. 2014 without exact arithmetic. **Not certified**: it misses contacts.
    BernsteinSign,
    /// [`tight_inclusion`], the bisection of Wang et al. 2021, with their default tolerance of 1e-6.
    TightInclusion,
    /// [`additive`], Li et al. 2021. **Not certified.**
    Additive,
}

impl QueryMethod {
    /// Every method, ours first.
    pub const ALL: [Self; 14] = [
        Self::Selvedge,
        Self::Exact,
        Self::TimeOfImpact,
        Self::NonCoplanarity,
        Self::NonCoplanarityPlain,
        Self::RelativeBoxes,
        Self::RelativeBoxesNine,
        Self::SweptBoxes,
        Self::SegmentBox,
        Self::Dop18,
        Self::Cubic,
        Self::BernsteinSign,
        Self::TightInclusion,
        Self::Additive,
    ];

    /// The name on the command line and in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Selvedge => "selvedge",
            Self::Exact => "exact",
            Self::TimeOfImpact => "time_of_impact",
            Self::NonCoplanarity => "non_coplanarity",
            Self::NonCoplanarityPlain => "non_coplanarity_plain",
            Self::RelativeBoxes => "relative_boxes",
            Self::RelativeBoxesNine => "relative_boxes_nine",
            Self::SweptBoxes => "swept_boxes",
            Self::SegmentBox => "segment_box",
            Self::Dop18 => "dop_18",
            Self::Cubic => "cubic",
            Self::BernsteinSign => "bernstein_sign",
            Self::TightInclusion => "tight_inclusion",
            Self::Additive => "additive",
        }
    }

    /// Asks it about one pair: false if it culls the pair, or finds that it does not touch.
    #[must_use]
    pub fn keeps<S: Scalar>(self, pair: PrimitivePair<S>) -> bool {
        let query = Query {
            pair,
            collides: None,
            line: 0,
        };
        let run = Run {
            method: self,
            kind: pair.kind,
            queries: &[query],
            progress: &mut |_| {},
            is_timed: false,
        };
        measure(run).positives > 0
    }

    /// Whether it never denies a contact, rounding included.
    #[must_use]
    pub fn is_certified(self) -> bool {
        match self {
            Self::NonCoplanarityPlain | Self::Cubic | Self::BernsteinSign | Self::Additive => false,
            Self::Selvedge => SELVEDGE.elementary.is_certified() && SELVEDGE.tests.iter().all(|test| test.is_certified()),
            _ => true,
        }
    }
}

impl fmt::Display for QueryMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that no method has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no method `{0}`; choose from {list}", list = QueryMethod::ALL.map(QueryMethod::name).join(", "))]
pub struct UnknownMethod(String);

impl FromStr for QueryMethod {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        let known = Self::ALL.into_iter().find(|method| method.name() == name);
        known.ok_or_else(|| UnknownMethod(name.to_owned()))
    }
}

/// What one method said of all queries of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct QueryResult {
    /// Which method.
    pub method: QueryMethod,
    /// Which kind of pairs.
    pub kind: PairKind,
    /// How many there were.
    pub queries: usize,
    /// How many the method did not cull, or found to touch.
    pub positives: usize,
    /// The comparison with the truth; `None` unless it is known for all queries.
    pub truth: Option<TruthCounts>,
    /// Time of a query.
    pub nanoseconds: Nanoseconds,
}

/// A method's answers beside the truth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TruthCounts {
    /// Queries that collide.
    pub positives: usize,
    /// Queries that do not collide, and that the method kept.
    pub false_positives: usize,
    /// Queries that collide, and that the method culled or missed. A certified method has none.
    pub false_negatives: usize,
}

/// Times of single queries, in nanoseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Nanoseconds {
    /// The mean.
    pub mean: f64,
    /// Half of the queries take no longer.
    pub median: f64,
    /// 99 in 100 queries take no longer.
    pub p99: f64,
    /// The slowest query.
    pub max: f64,
}

/// Runs `method` on each of `queries`, all of one kind, and calls `progress` after each with how many are done.
#[must_use]
pub fn measure_queries<S: Scalar>(
    method: QueryMethod,
    kind: PairKind,
    queries: &[Query<S>],
    progress: &mut dyn FnMut(usize),
) -> QueryResult {
    let run = Run {
        kind,
        method,
        queries,
        progress,
        is_timed: true,
    };
    measure(run)
}

fn measure<S: Scalar>(mut run: Run<'_, S>) -> QueryResult {
    use CullingTest as Test;
    // One loop for each method, compiled for it alone.
    match run.method {
        QueryMethod::Selvedge => {
            let limits = Limits::default();
            run.with(|pair| {
                SELVEDGE.tests.iter().all(|&test| keeps(test, pair)) && time_of_impact(pair, &limits) != Impact::Never
            })
        }
        QueryMethod::Exact => run.with(|pair| elementary::contact(pair) != Contact::Never),
        QueryMethod::TimeOfImpact => {
            let limits = Limits::default();
            run.with(|pair| time_of_impact(pair, &limits) != Impact::Never)
        }
        QueryMethod::NonCoplanarity => run.with(|pair| keeps(Test::CertifiedNonCoplanarity, pair)),
        QueryMethod::NonCoplanarityPlain => run.with(|pair| keeps(Test::PlainNonCoplanarity, pair)),
        QueryMethod::RelativeBoxes => run.with(|pair| keeps(Test::RelativeBoxes, pair)),
        QueryMethod::RelativeBoxesNine => run.with(|pair| keeps(Test::RelativeBoxesNine, pair)),
        QueryMethod::SweptBoxes => run.with(|pair| keeps(Test::SweptBoxes, pair)),
        QueryMethod::SegmentBox => run.with(|pair| keeps(Test::SegmentBox, pair)),
        QueryMethod::Dop18 => run.with(|pair| keeps(Test::StoredDop18, pair)),
        QueryMethod::Cubic => run.with(|pair| cubic::time_of_impact(pair).is_some()),
        QueryMethod::BernsteinSign => run.with(|pair| bernstein_sign::touches(pair)),
        QueryMethod::TightInclusion => {
            let limits = Limits {
                tolerance: S::from_f64(1e-6),
                separation: S::ZERO,
            };
            run.with(|pair| tight_inclusion::time_of_impact(pair, &limits) != Impact::Never)
        }
        QueryMethod::Additive => run.with(|pair| additive::time_of_impact(pair, S::ZERO) != Impact::Never),
    }
}

const SELVEDGE: Stages = Preset::Selvedge.stages();

/// Whether the pair survives a culling test.
#[inline(always)]
fn keeps<S: Scalar>(test: CullingTest, pair: &PrimitivePair<S>) -> bool {
    let verdict = match test {
        CullingTest::SweptBoxes | CullingTest::StoredSweptBoxes => boxes::swept_boxes(pair),
        CullingTest::StoredDop18 => dop_18(pair),
        CullingTest::SegmentBox => boxes::segment::primitive_boxes(pair),
        CullingTest::RelativeBoxes | CullingTest::SubspaceThree => boxes::relative::three_axes(pair),
        CullingTest::RelativeBoxesNine | CullingTest::SubspaceNine => boxes::relative::nine_directions(pair),
        CullingTest::PlainNonCoplanarity => plain::non_coplanarity(pair),
        CullingTest::CertifiedNonCoplanarity => filter::certified::non_coplanarity(pair),
    };
    !verdict.is_culled()
}

fn dop_18<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    let [first, second] = pair.sets().map(|set| {
        let dops = set.iter().map(Dop18::swept);
        dops.reduce(|all, dop| all.merged(&dop)).expect("a set has points")
    });
    Verdict::culled_if(!first.overlaps(&second))
}

struct Run<'a, S: Scalar> {
    method: QueryMethod,
    kind: PairKind,
    queries: &'a [Query<S>],
    progress: &'a mut dyn FnMut(usize),
    /// Otherwise each query is asked once, and no clock is read.
    is_timed: bool,
}

impl<S: Scalar> Run<'_, S> {
    fn with(&mut self, test: impl Fn(&PrimitivePair<S>) -> bool) -> QueryResult {
        let mut watch = StopWatch { repeats: 1 };
        let mut times = Vec::with_capacity(self.queries.len());
        let mut positives = 0;
        let mut truth = Some(TruthCounts::default());
        for (index, query) in self.queries.iter().enumerate() {
            let pair = query.pair;
            let positive = if self.is_timed {
                let (positive, nanoseconds) = watch.time(|| test(black_box(&pair)));
                times.push(nanoseconds);
                positive
            } else {
                test(&pair)
            };
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
            nanoseconds: Nanoseconds::of(times),
        }
    }
}

impl Nanoseconds {
    /// All zero without times.
    fn of(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        let Some(&max) = times.last() else {
            return Self::default();
        };
        // Nearest rank: the smallest time that so many per cent of all do not exceed.
        let percentile = |percent: usize| times[(times.len() * percent).div_ceil(100).max(1) - 1];
        Self {
            mean: times.iter().sum::<f64>() / times.len() as f64,
            median: percentile(50),
            p99: percentile(99),
            max,
        }
    }
}

/// Measures calls that are shorter than the clock can tell; see the module.
struct StopWatch {
    /// How often the last query was called in one run: a good guess for the next.
    repeats: u32,
}

impl StopWatch {
    /// A hundred times the cost of reading the clock, which is 20 ns or so.
    const RUN: Duration = Duration::from_micros(2);
    const RUNS: usize = 3;

    /// The answer of `call`, and how many nanoseconds it takes.
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

    /// A vertex that falls from z = 1 to z = `end` above the middle of a resting triangle.
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
        assert_eq!(Nanoseconds::of(times), expected);
        let one = Nanoseconds::of(vec![7.0]);
        assert_eq!((one.median, one.p99, one.max), (7.0, 7.0, 7.0));
    }

    #[test]
    fn names_read_back() {
        for method in QueryMethod::ALL {
            assert_eq!(method.name().parse(), Ok(method));
        }
    }

    #[test]
    fn an_unknown_name_is_told_the_known_ones() {
        let message = "quartic".parse::<QueryMethod>().unwrap_err().to_string();
        assert!(
            message.contains("no method `quartic`") && message.contains("dop_18, cubic"),
            "{message}"
        );
    }
}
