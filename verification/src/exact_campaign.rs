//! A billion pairs: every cull of the certified filters and box tests, and every "never" of the time of impact, checked by exact
//! arithmetic that is fast enough for it.
//!
//! Like [`false_culls`](crate::false_culls) this comes in chunks with random numbers of their own, so that the result depends on
//! neither threads nor interruptions; but it is made for speed, a microsecond a pair: tests run in batches, and pairs come from
//! three [`Source`]s that cost little.
//!
//! # Who judges
//! A cull by the volume's signs is right if the exact control values ([`control_value_signs`]) have one strict sign. A claim that the
//! sets stay apart is right if so; or if one axis keeps them in the same order at both ends, which comparisons of coordinates tell;
//! or if [`touches`] says so, in whole numbers. Nothing else counts: what none of these proves is decided by the [`oracle`], and
//! every [`SAMPLE`]th claim that they do prove is put before the oracle as well.

use crate::generator::{Choices, Format, PairCase};
use crate::oracle::{self, Kind};
use selvedge_core::batch::{LANES, Level, Test, culled};
use selvedge_core::elementary::advance::time_of_impact;
use selvedge_core::elementary::{Impact, Limits};
use selvedge_core::exact::{control_value_signs, touches};
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::{EdgeEdge, PrimitivePair, VertexFace};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering::{Greater, Less};
use std::collections::BTreeSet;
use std::fmt;
use std::sync::Mutex;

/// Of the claims that are proven, every this many the oracle confirms one.
pub const SAMPLE: u64 = 20_000;

/// What claims that a pair need not be looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Claim {
    /// [`Tier::Permanent`]: never coplanar.
    Filter,
    /// [`Test::RelativeBoxesNine`]: never touches, as all below.
    RelativeBoxes,
    /// [`Test::NormalDirection`].
    NormalDirection,
    /// [`Test::SegmentBox`].
    SegmentBox,
    /// [`time_of_impact`] without a separation, tolerance zero or the default.
    TimeOfImpact,
    /// [`Test::PlainNonCoplanarity`]: **not certified**, to show that false culls are found.
    Plain,
}

impl Claim {
    /// Those that are certified.
    pub const CERTIFIED: [Self; 5] = [
        Self::Filter,
        Self::RelativeBoxes,
        Self::NormalDirection,
        Self::SegmentBox,
        Self::TimeOfImpact,
    ];

    /// Whether it says that the points are never coplanar; else, that the sets never touch.
    const fn is_of_the_volume(self) -> bool {
        matches!(self, Self::Filter | Self::Plain)
    }
}

/// Where pairs come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Random coordinates, half of the pairs nearly coplanar.
    Random,
    /// Pairs of the tests' [generator](crate::generator), each in many variants a few units in the last place away.
    Adversarial,
    /// Pairs of real motion, as they are, nudged, far from the origin, or moved onto one another's plane.
    Scene,
}

impl Source {
    const ALL: [Self; 3] = [Self::Random, Self::Adversarial, Self::Scene];
}

/// Four moving points.
pub type Points = [[[f64; 3]; 2]; 4];

/// The pairs of real motion.
#[derive(Clone, Debug, Default)]
pub struct Scenes {
    /// Vertex and face.
    pub vertex_face: Vec<Points>,
    /// Two edges.
    pub edge_edge: Vec<Points>,
}

/// What was seen of one claim.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// How often it was made.
    pub claims: u64,
    /// Of these, proven by exact signs.
    pub by_signs: u64,
    /// By an axis.
    pub by_axis: u64,
    /// By whole numbers.
    pub by_whole_numbers: u64,
    /// Decided or confirmed by the oracle.
    pub by_oracle: u64,
    /// Wrong.
    pub wrong: u64,
    /// The first wrong one, by chunk.
    pub example: Option<(u64, String)>,
}

impl Tally {
    fn add(&mut self, other: Self) {
        self.claims += other.claims;
        self.by_signs += other.by_signs;
        self.by_axis += other.by_axis;
        self.by_whole_numbers += other.by_whole_numbers;
        self.by_oracle += other.by_oracle;
        self.wrong += other.wrong;
        self.example = self.example.take().into_iter().chain(other.example).min();
    }
}

/// How far a run has come.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Progress {
    /// Where random numbers come from.
    pub seed: u64,
    /// Chunks; they go round formats, sources and kinds of pair.
    pub chunks: u64,
    /// Pairs a chunk.
    pub pairs_per_chunk: u64,
    /// How many pairs of either kind the scenes have: with others the run would be another.
    pub scene_pairs: [u64; 2],
    /// What is looked at.
    pub claims: Vec<Claim>,
    /// Finished chunks.
    pub done: BTreeSet<u64>,
    /// By format, source and claim.
    pub tallies: [[Vec<Tally>; 3]; 2],
}

impl Progress {
    /// Nothing done yet; at least `pairs` pairs.
    #[must_use]
    pub fn new(
        seed: u64,
        pairs: u64,
        pairs_per_chunk: u64,
        scenes: &Scenes,
        claims: &[Claim],
    ) -> Self {
        let nothing = || vec![Tally::default(); claims.len()];
        let of_format = || [nothing(), nothing(), nothing()];
        Self {
            seed,
            chunks: pairs.div_ceil(pairs_per_chunk),
            pairs_per_chunk,
            scene_pairs: [
                scenes.vertex_face.len() as u64,
                scenes.edge_edge.len() as u64,
            ],
            claims: claims.to_vec(),
            done: BTreeSet::new(),
            tallies: [of_format(), of_format()],
        }
    }

    /// Whether it is the same run as `other`, however far either has come.
    #[must_use]
    pub fn is_of_the_same_run(&self, other: &Self) -> bool {
        let key = |run: &Self| {
            (
                run.seed,
                run.chunks,
                run.pairs_per_chunk,
                run.scene_pairs,
                run.claims.clone(),
            )
        };
        key(self) == key(other)
    }

    /// Claims that are wrong.
    #[must_use]
    pub fn wrong(&self) -> u64 {
        self.tallies
            .iter()
            .flatten()
            .flatten()
            .map(|tally| tally.wrong)
            .sum()
    }
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:16} {:6} {:12} {:>13} {:>13} {:>13} {:>13} {:>9} {:>6}",
            "claim",
            "scalar",
            "source",
            "claims",
            "by signs",
            "by axis",
            "whole numbers",
            "by oracle",
            "wrong"
        )?;
        let mut examples = Vec::new();
        for (by_source, scalar) in self.tallies.iter().zip(["f32", "f64"]) {
            for (tallies, source) in by_source.iter().zip(Source::ALL) {
                for (tally, claim) in tallies.iter().zip(&self.claims) {
                    writeln!(
                        f,
                        "{:16} {scalar:6} {:12} {:13} {:13} {:13} {:13} {:9} {:6}",
                        format!("{claim:?}"),
                        format!("{source:?}"),
                        tally.claims,
                        tally.by_signs,
                        tally.by_axis,
                        tally.by_whole_numbers,
                        tally.by_oracle,
                        tally.wrong
                    )?;
                    if let Some((_, pair)) = &tally.example {
                        examples.push(format!("{claim:?}, {scalar}, is wrong of\n{pair}"));
                    }
                }
            }
        }
        let pairs = self.done.len() as u64 * self.pairs_per_chunk;
        writeln!(f, "{pairs} pairs, {} wrong claims", self.wrong())?;
        examples
            .iter()
            .try_for_each(|example| writeln!(f, "\n{example}"))
    }
}

/// Does what is left, on as many threads, until `stops` says so. `after_chunk` sees each state that may be kept, one at a time.
///
/// # Panics
/// If a thread panics.
pub fn run(
    progress: Progress,
    scenes: &Scenes,
    level: Level,
    threads: usize,
    after_chunk: impl Fn(&Progress) + Sync,
    stops: impl Fn() -> bool + Sync,
) -> Progress {
    let (seed, pairs, claims) = (
        progress.seed,
        progress.pairs_per_chunk,
        progress.claims.clone(),
    );
    let left: Vec<u64> = (0..progress.chunks)
        .filter(|chunk| !progress.done.contains(chunk))
        .collect();
    let left = Mutex::new(left.into_iter());
    let progress = Mutex::new(progress);
    let take = || left.lock().expect("no panic").next();
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while !stops() {
                    let Some(index) = take() else {
                        break;
                    };
                    let chunk = Chunk {
                        index,
                        seed,
                        pairs,
                        scenes,
                        level,
                        claims: &claims,
                    };
                    let tallies = chunk.run();
                    let (format, source) = (chunk.format(), chunk.source() as usize);
                    let mut progress = progress.lock().expect("no panic");
                    for (sum, tally) in progress.tallies[format][source].iter_mut().zip(tallies) {
                        sum.add(tally);
                    }
                    progress.done.insert(index);
                    after_chunk(&progress);
                }
            });
        }
    });
    progress.into_inner().expect("no panic")
}

/// A chunk: one format, one source, one kind of pair.
struct Chunk<'a> {
    index: u64,
    seed: u64,
    pairs: u64,
    scenes: &'a Scenes,
    level: Level,
    claims: &'a [Claim],
}

impl Chunk<'_> {
    const fn format(&self) -> usize {
        (self.index % 2) as usize
    }

    const fn source(&self) -> Source {
        Source::ALL[(self.index / 2 % 3) as usize]
    }

    const fn kind(&self) -> Kind {
        if (self.index / 6).is_multiple_of(2) {
            Kind::VertexFace
        } else {
            Kind::EdgeEdge
        }
    }

    fn run(&self) -> Vec<Tally> {
        match (self.format(), self.kind()) {
            (0, Kind::VertexFace) => self.look_at::<f32, VertexFace<f32>>(PairCase::vertex_face),
            (0, Kind::EdgeEdge) => self.look_at::<f32, EdgeEdge<f32>>(PairCase::edge_edge),
            (_, Kind::VertexFace) => self.look_at::<f64, VertexFace<f64>>(PairCase::vertex_face),
            (_, Kind::EdgeEdge) => self.look_at::<f64, EdgeEdge<f64>>(PairCase::edge_edge),
        }
    }

    fn look_at<S: Format, P: PrimitivePair<S>>(&self, pair: fn(&PairCase<S>) -> P) -> Vec<Tally> {
        const BLOCK: u64 = 1024;
        let mut random = Random::new(self.seed, self.index);
        let mut tallies = vec![Tally::default(); self.claims.len()];
        let mut cases = Vec::new();
        let mut masks = vec![[0; BLOCK as usize / LANES]; self.claims.len()];
        let mut left = self.pairs;
        while left > 0 {
            let count = left.min(BLOCK);
            left -= count;
            cases.clear();
            self.make(&mut random, count as usize, &mut cases);
            let pairs: Vec<P> = cases.iter().map(pair).collect();
            for (claim, masks) in self.claims.iter().zip(&mut masks) {
                let test = match claim {
                    Claim::Filter => {
                        culled::<S, P>(self.level, Filter::new(Tier::Permanent), &pairs, masks);
                        continue;
                    }
                    Claim::RelativeBoxes => Test::RelativeBoxesNine,
                    Claim::NormalDirection => Test::NormalDirection,
                    Claim::SegmentBox => Test::SegmentBox,
                    Claim::Plain => Test::PlainNonCoplanarity,
                    Claim::TimeOfImpact => continue,
                };
                culled::<S, P>(self.level, test, &pairs, masks);
            }
            for (index, (case, pair)) in cases.iter().zip(&pairs).enumerate() {
                let mut judge = Judge::<S, P>::new(case, pair);
                for ((claim, masks), tally) in self.claims.iter().zip(&masks).zip(&mut tallies) {
                    let is_claimed = match claim {
                        Claim::TimeOfImpact => {
                            let limits = if index % 2 == 0 {
                                Limits::default()
                            } else {
                                Limits {
                                    tolerance: S::ZERO,
                                    separation: S::ZERO,
                                }
                            };
                            time_of_impact(pair, &limits) == Impact::Never
                        }
                        _ => masks[index / LANES] >> (index % LANES) & 1 != 0,
                    };
                    if is_claimed {
                        judge.judge(*claim, tally, self.index);
                    }
                }
            }
        }
        tallies
    }

    /// `count` pairs.
    fn make<S: Format>(&self, random: &mut Random, count: usize, cases: &mut Vec<PairCase<S>>) {
        let kind = self.kind();
        let of_scene = match kind {
            Kind::VertexFace => &self.scenes.vertex_face,
            Kind::EdgeEdge => &self.scenes.edge_edge,
        };
        let mut base = PairCase::new(kind, [[[S::ZERO; 3]; 2]; 4]);
        let mut variants = 0;
        for _ in 0..count {
            let case = match self.source() {
                Source::Scene if !of_scene.is_empty() => {
                    let points = of_scene[random.below(of_scene.len() as u64) as usize];
                    of_motion(
                        PairCase::new(kind, points.map(|ends| ends.map(|x| x.map(S::from_f64)))),
                        random,
                    )
                }
                Source::Adversarial => {
                    if variants == 0 {
                        base = PairCase::choose(kind, &mut Choices::new(&random.bytes()));
                        variants = if is_wide(&base) { 1 } else { 32 };
                    }
                    variants -= 1;
                    nudged(base, 1 + random.below(3), random)
                }
                Source::Random | Source::Scene => at_random(kind, random),
            };
            cases.push(case.map(S::made_finite));
        }
    }
}

/// Whether exact arithmetic takes a hundred times as long as with coordinates of one size: then one variant is enough.
fn is_wide<S: Format>(case: &PairCase<S>) -> bool {
    let sizes = case
        .coordinates()
        .map(|x| x.to_f64().abs())
        .filter(|&x| x > 0.0);
    let (low, high) = sizes.fold((f64::MAX, 0.0_f64), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    high / low > 1e60
}

/// Three in four pairs have coordinates of few enough bits for whole numbers of one word, which takes a fraction of the time.
fn at_random<S: Format>(kind: Kind, random: &mut Random) -> PairCase<S> {
    let bits = if random.below(4) > 0 { 26 } else { 52 };
    let motion = [1.0, 0.5, 1.0 / 16.0, 1.0 / 4096.0, 1.0 / 4_194_304.0][random.below(5) as usize];
    let points = std::array::from_fn(|_| {
        let start: [f64; 3] = std::array::from_fn(|_| random.fraction(bits));
        let end = start.map(|x| x + motion * random.fraction(bits));
        [start, end].map(|x| x.map(S::from_f64))
    });
    let case = PairCase::new(kind, points);
    if random.below(2) == 0 {
        case
    } else {
        onto_the_plane(case, random)
    }
}

/// As it is; or nudged; or far from the origin, where coordinates are rounded; or onto one another's plane.
fn of_motion<S: Format>(case: PairCase<S>, random: &mut Random) -> PairCase<S> {
    match random.below(4) {
        0 => case,
        1 => nudged(case, 8, random),
        2 => {
            let by: [S; 3] = std::array::from_fn(|_| {
                S::from_f64(
                    random.fraction(52) * [16.0, 1024.0, 65536.0, 1e7][random.below(4) as usize],
                )
            });
            case.with_positions(|x| std::array::from_fn(|axis| x[axis] + by[axis]))
        }
        _ => nudged(onto_the_plane(case, random), 2, random),
    }
}

/// The first point moved into the plane of the others, but for rounding, at the start, at the end or at both.
fn onto_the_plane<S: Format>(mut case: PairCase<S>, random: &mut Random) -> PairCase<S> {
    let ends = 1 + random.below(3);
    let [p, a, b, c] = &mut case.points;
    for end in (0..2).filter(|end| ends >> end & 1 != 0) {
        let (s, t) = (
            S::from_f64(random.fraction(20)),
            S::from_f64(random.fraction(20)),
        );
        p[end] = std::array::from_fn(|axis| {
            let from = a[end][axis];
            from + (s * (b[end][axis] - from) + t * (c[end][axis] - from))
        });
    }
    case
}

/// Some coordinates one or two units in the last place up or down. Zeros seldom: next to numbers of everyday size the smallest
/// subnormal ones make exact arithmetic take a hundred times as long.
fn nudged<S: Format>(mut case: PairCase<S>, count: u64, random: &mut Random) -> PairCase<S> {
    for _ in 0..count {
        let index = random.below(24) as usize;
        let number = &mut case.points[index / 6][index / 3 % 2][index % 3];
        if *number == S::ZERO && random.below(64) > 0 {
            continue;
        }
        *number = match random.below(4) {
            0 => number.down(),
            1 => number.down().down(),
            2 => number.up(),
            _ => number.up().up(),
        };
    }
    case
}

/// Small and fast (`SplitMix64`): most of the time is to go to the tests.
struct Random(u64);

impl Random {
    const fn new(seed: u64, chunk: u64) -> Self {
        let mut random = Self(seed);
        let seed = random.next();
        Self(seed ^ chunk.wrapping_mul(0xd134_2543_de82_ef95))
    }

    const fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    const fn below(&mut self, count: u64) -> u64 {
        ((self.next() >> 32) * count) >> 32
    }

    /// From −1 to 1, in steps of 2^-`bits`; at most 52.
    const fn fraction(&mut self, bits: u32) -> f64 {
        (self.next().cast_signed() >> (63 - bits)) as f64 * (1.0 / (1_u64 << bits) as f64)
    }

    fn bytes(&mut self) -> [u8; Choices::ENOUGH] {
        let mut bytes = [0; Choices::ENOUGH];
        for word in bytes.chunks_exact_mut(8) {
            word.copy_from_slice(&self.next().to_le_bytes());
        }
        bytes
    }
}

/// One pair, and what is proven of it so far.
struct Judge<'a, S: Format, P> {
    case: &'a PairCase<S>,
    pair: &'a P,
    has_one_sign: Option<bool>,
    is_apart: Option<By>,
}

/// What proves that the sets stay apart.
#[derive(Clone, Copy, PartialEq)]
enum By {
    Axis,
    Signs,
    WholeNumbers,
    Nothing,
}

impl<'a, S: Format, P: PrimitivePair<S>> Judge<'a, S, P> {
    const fn new(case: &'a PairCase<S>, pair: &'a P) -> Self {
        Self {
            case,
            pair,
            has_one_sign: None,
            is_apart: None,
        }
    }

    fn judge(&mut self, claim: Claim, tally: &mut Tally, chunk: u64) {
        tally.claims += 1;
        let by = if claim.is_of_the_volume() {
            if self.has_one_sign() {
                By::Signs
            } else {
                By::Nothing
            }
        } else {
            self.is_apart()
        };
        match by {
            By::Axis => tally.by_axis += 1,
            By::Signs => tally.by_signs += 1,
            By::WholeNumbers => tally.by_whole_numbers += 1,
            By::Nothing => {}
        }
        if by != By::Nothing && tally.claims % SAMPLE != 1 {
            return;
        }
        tally.by_oracle += 1;
        let question = self.case.question();
        let is_wrong = if claim.is_of_the_volume() {
            oracle::coplanar(&question.start, &question.end)
        } else {
            oracle::collides(&question).is_some()
        };
        if is_wrong {
            tally.wrong += 1;
            let example = (chunk, format!("{:?}", self.case));
            tally.example = tally.example.take().into_iter().chain([example]).min();
        }
    }

    fn has_one_sign(&mut self) -> bool {
        *self.has_one_sign.get_or_insert_with(|| {
            let signs = control_value_signs::<P::Shape, S>(&self.pair.points());
            matches!(
                signs,
                Some([Less, Less, Less, Less] | [Greater, Greater, Greater, Greater])
            )
        })
    }

    fn is_apart(&mut self) -> By {
        if let Some(by) = self.is_apart {
            return by;
        }
        let by = if self.is_apart_along_an_axis() {
            By::Axis
        } else if self.has_one_sign() {
            By::Signs
        } else if touches::<P::Shape, S>(&self.pair.points()) == Some(false) {
            By::WholeNumbers
        } else {
            By::Nothing
        };
        self.is_apart = Some(by);
        by
    }

    /// One set ahead of the other along an axis, at both ends of the step.
    fn is_apart_along_an_axis(&self) -> bool {
        let of_first = match self.case.kind {
            Kind::VertexFace => 1,
            Kind::EdgeEdge => 2,
        };
        let (first, second) = self.case.points.split_at(of_first);
        let ahead = |one: &[[[S; 3]; 2]], other: &[[[S; 3]; 2]], axis: usize| {
            let all_ahead = |end: usize| {
                one.iter()
                    .all(|p| other.iter().all(|q| p[end][axis] > q[end][axis]))
            };
            all_ahead(0) && all_ahead(1)
        };
        (0..3).any(|axis| ahead(first, second, axis) || ahead(second, first, axis))
    }
}
