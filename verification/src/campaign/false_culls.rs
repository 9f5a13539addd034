//! False culls counted over many pairs, random and adversarial, every cull checked exactly.
//!
//! # Who judges
//! A cull without separation is proven right by the exact signs of the control values
//! ([`control_value_signs`], itself checked against rationals in the tests); one
//! with a separation by [`is_never_within`]. What that does not prove, the [`oracle`] decides, and of what
//! it does prove the oracle confirms every 10,000th. A cull is false if the pair is coplanar, or is within the separation.

use crate::campaign::{self, Findings};
use crate::generator::{Choices, Format, PairCase};
use crate::oracle::{self, PairKind};
use proptest::prelude::Rng;
use selvedge_core::PrimitivePair;
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::verification::exact::{UNKNOWN, control_value_signs, is_never_within};
use selvedge_laboratory::baselines::as_computed::AsComputed;
use selvedge_laboratory::baselines::plain;
use serde::{Deserialize, Serialize};
use std::cell::OnceCell;
use std::cmp::Ordering::{Greater, Less};
use std::fmt;

/// Every this many culls of a rule the oracle confirms one that is proven already.
const SAMPLE: u64 = 10_000;

/// What culls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The paper's filter.
    Plain,
    /// Signs as computed.
    Uncertified,
    /// A tier, without a separation or with one.
    Tier(Tier, bool),
}

impl Rule {
    /// Every rule, in the order of a [`Progress`]'s rows.
    #[must_use]
    pub fn all() -> Vec<Self> {
        [Self::Plain, Self::Uncertified]
            .into_iter()
            .chain(Tier::ALL.map(|tier| Self::Tier(tier, false)))
            .chain(Tier::ALL.map(|tier| Self::Tier(tier, true)))
            .collect()
    }

    /// Whether a false cull is an error.
    #[must_use]
    pub const fn is_certified(self) -> bool {
        matches!(self, Self::Tier(..))
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Plain => f.pad("plain (the paper)"),
            Self::Uncertified => f.pad("Uncertified"),
            Self::Tier(tier, false) => f.pad(&format!("{tier:?}")),
            Self::Tier(tier, true) => f.pad(&format!("{tier:?}, separation")),
        }
    }
}

/// What was seen of one rule on one number format.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Pairs that it was asked about.
    pub pairs: u64,
    /// Those that it culled.
    pub culled: u64,
    /// Culls that the oracle decided or confirmed.
    pub by_oracle: u64,
    /// Culls of pairs that it must keep.
    pub false_culls: u64,
    /// Those of them that even touch.
    pub touching: u64,
    /// The first of them (preferably one that touches), as Rust, by chunk.
    pub example: Option<Example>,
}

/// A false cull.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Example {
    /// Whether it merely is coplanar, or within the separation.
    pub does_not_touch: bool,
    /// The chunk.
    pub chunk: u64,
    /// The pair.
    pub pair: String,
}

impl Tally {
    fn add(&mut self, other: &Self) {
        self.pairs += other.pairs;
        self.culled += other.culled;
        self.by_oracle += other.by_oracle;
        self.false_culls += other.false_culls;
        self.touching += other.touching;
        let examples = self.example.iter().chain(&other.example);
        self.example = examples.min().cloned();
    }
}

/// What a run found, by rule.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Found {
    /// A row for each of [`Rule::all`], for `f32` and for `f64`.
    pub rows: [Vec<Tally>; 2],
}

/// How far a run has come. Chunks of an even index are of `f32`, the others of `f64`.
pub type Progress = campaign::Progress<Found>;

impl Progress {
    /// Nothing done yet. Whole chunks: at least `pairs` pairs for each of the two number formats.
    #[must_use]
    pub fn new(seed: u64, pairs: u64, pairs_per_chunk: u64) -> Self {
        let rows = || vec![Tally::default(); Rule::all().len()];
        let found = Found { rows: [rows(), rows()] };
        let of_format = pairs.next_multiple_of(pairs_per_chunk);
        let rules: Vec<String> = Rule::all().iter().map(Rule::to_string).collect();
        let depends_on = [("rules", rules.join("; "))];
        Self::with_nothing_done(seed, 2 * of_format, pairs_per_chunk, &depends_on, found)
    }
}

impl Findings for Found {
    const CAMPAIGN: &'static str = "false_culls";
    type OfChunk = Vec<Tally>;

    fn add(&mut self, chunk: u64, tallies: Vec<Tally>) {
        for (row, tally) in self.rows[format(chunk)].iter_mut().zip(&tallies) {
            row.add(tally);
        }
    }

    fn join(&mut self, other: Self) {
        for (row, tally) in self.rows.iter_mut().flatten().zip(other.rows.iter().flatten()) {
            row.add(tally);
        }
    }

    /// False culls of rules that promise that there are none.
    fn wrong(&self) -> u64 {
        let of = |rows: &Vec<Tally>| {
            let certified = Rule::all().into_iter().zip(rows);
            let certified = certified.filter(|(rule, _)| rule.is_certified());
            certified.map(|(_, tally)| tally.false_culls).sum::<u64>()
        };
        self.rows.iter().map(of).sum()
    }
}

/// Of a chunk: 0 is `f32`, 1 is `f64`.
const fn format(chunk: u64) -> usize {
    (chunk % 2) as usize
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:24} {:6} {:>12} {:>12} {:>10} {:>12} {:>10}",
            "tier", "scalar", "pairs", "culled", "by oracle", "false culls", "touching"
        )?;
        for (rows, scalar) in self.found.rows.iter().zip(["f32", "f64"]) {
            for (rule, tally) in Rule::all().into_iter().zip(rows) {
                let Tally {
                    pairs,
                    culled,
                    by_oracle,
                    false_culls,
                    touching,
                    ..
                } = tally;
                writeln!(
                    f,
                    "{rule:24} {scalar:6} {pairs:12} {culled:12} {by_oracle:10} {false_culls:12} {touching:10}"
                )?;
            }
        }
        for (rows, scalar) in self.found.rows.iter().zip(["f32", "f64"]) {
            for (rule, tally) in Rule::all().into_iter().zip(rows) {
                if let Some(example) = &tally.example {
                    writeln!(f, "\n{rule}, {scalar}, culls\n{}", example.pair)?;
                }
            }
        }
        Ok(())
    }
}

/// Does what is left, on as many threads, until `stops` says so. `after_chunk` sees each state that may be kept, one at a time.
///
/// # Panics
/// If a thread panics.
pub fn run(
    progress: Progress,
    threads: usize,
    after_chunk: impl Fn(&Progress) + Sync,
    stops: impl Fn() -> bool + Sync,
) -> Progress {
    let (seed, pairs) = (progress.settings.seed, progress.settings.cases_per_chunk);
    let look_at = |chunk| match format(chunk) {
        0 => look_at_chunk::<f32>(seed, chunk, pairs),
        _ => look_at_chunk::<f64>(seed, chunk, pairs),
    };
    campaign::run(progress, threads, look_at, after_chunk, stops)
}

fn look_at_chunk<S: Format>(seed: u64, chunk: u64, pairs: u64) -> Vec<Tally> {
    let mut random = campaign::random(seed, chunk);
    let mut bytes = [0; Choices::ENOUGH];

    let rules = Rule::all();
    let mut tallies = vec![Tally::default(); rules.len()];
    for _ in 0..pairs {
        random.fill_bytes(&mut bytes);
        let mut choices = Choices::new(&bytes);
        let kind = choices.pick(&[PairKind::VertexFace, PairKind::EdgeEdge]);
        let pair = match choices.below(16) {
            0 => PairCase::<S>::choose_graze_of_a_box(&mut choices),
            1 => PairCase::choose_any(kind, &mut choices),
            _ => PairCase::choose(kind, &mut choices),
        };
        // Of the pair's own size, or smaller.
        let [[x, ..], _] = pair.points[choices.below(4) as usize];
        let separation = (x.abs() * S::exact(1, -(choices.below(32) as i32))).made_finite();
        Judged::new(&pair, separation).by(&rules, &mut tallies, chunk);
    }
    tallies
}

/// One pair, and what is known of it so far.
struct Judged<'a, S: Format> {
    case: &'a PairCase<S>,
    pair: PrimitivePair<S>,
    separation: S,
    has_one_sign: OnceCell<bool>,
    is_beyond: OnceCell<bool>,
    coplanar: OnceCell<bool>,
    touching: OnceCell<bool>,
    within: OnceCell<bool>,
}

impl<'a, S: Format> Judged<'a, S> {
    fn new(case: &'a PairCase<S>, separation: S) -> Self {
        Self {
            case,
            pair: case.pair(),
            separation,
            has_one_sign: OnceCell::new(),
            is_beyond: OnceCell::new(),
            coplanar: OnceCell::new(),
            touching: OnceCell::new(),
            within: OnceCell::new(),
        }
    }

    fn by(&self, rules: &[Rule], tallies: &mut [Tally], chunk: u64) {
        for (&rule, tally) in rules.iter().zip(tallies) {
            tally.pairs += 1;
            if !self.is_culled_by(rule) {
                continue;
            }
            tally.culled += 1;
            if self.is_proven(rule) && tally.culled % SAMPLE != 1 {
                continue;
            }
            tally.by_oracle += 1;
            if self.must_be_kept(rule) {
                tally.false_culls += 1;
                let touches = self.touches();
                tally.touching += u64::from(touches);
                let found = Example {
                    does_not_touch: !touches,
                    chunk,
                    pair: format!("{:?}", self.case),
                };
                tally.example = tally.example.take().into_iter().chain([found]).min();
            }
        }
    }

    fn is_culled_by(&self, rule: Rule) -> bool {
        match rule {
            Rule::Plain => plain::non_coplanarity(&self.pair),
            Rule::Uncertified => AsComputed::new().verdict(&self.pair),
            Rule::Tier(tier, false) => Filter::new(tier).verdict(&self.pair),
            Rule::Tier(tier, true) => {
                let filter = Filter::new(tier).with_separation(self.separation);
                filter.expect("a length").verdict(&self.pair)
            }
        }
        .is_culled()
    }

    /// Whether the exact parts of core prove the cull right.
    fn is_proven(&self, rule: Rule) -> bool {
        match rule {
            Rule::Tier(_, true) => *self
                .is_beyond
                .get_or_init(|| is_never_within(&self.pair, self.separation, UNKNOWN)),
            Rule::Plain | Rule::Uncertified | Rule::Tier(_, false) => self.has_one_sign(),
        }
    }

    fn has_one_sign(&self) -> bool {
        *self.has_one_sign.get_or_init(|| {
            let signs = control_value_signs(&self.pair);
            matches!(signs, Some([Less, Less, Less, Less] | [Greater, Greater, Greater, Greater]))
        })
    }

    fn must_be_kept(&self, rule: Rule) -> bool {
        if !self.case.is_finite() {
            return true;
        }
        match rule {
            Rule::Tier(_, true) => *self
                .within
                .get_or_init(|| oracle::within(&self.case.question(), self.separation.to_f64())),
            Rule::Plain | Rule::Uncertified | Rule::Tier(_, false) => self.is_coplanar(),
        }
    }

    fn is_coplanar(&self) -> bool {
        *self.coplanar.get_or_init(|| {
            let question = self.case.question();
            oracle::coplanar(&question.start, &question.end)
        })
    }

    /// What touches is coplanar, which takes the oracle less time to tell.
    fn touches(&self) -> bool {
        *self
            .touching
            .get_or_init(|| self.case.is_finite() && self.is_coplanar() && oracle::collides(&self.case.question()).is_some())
    }
}
