//! The code that is compiled for each instruction set: loops over the chunks of sixteen pairs.
//!
//! One function for each level, format, kind of pair and kind of work, and in each a loop at the width of the machine's registers. So
//! the crate is compiled in seconds: with all of it in one function, sixteen lanes wide, it took more than a minute and gigabytes.

use super::advance::{Round, RoundQuestion, round};
use super::chunk::{Chunk, edge, points, some};
use super::lane_test::VolumeTest;
use super::{LANES, Level, Mask, VertexRow};
#[cfg(feature = "verification")]
use super::{PointsTest, Test, Tile};
use crate::PairKind;
use crate::coplanarity::{Decision, MovingTetrahedron};
use crate::filter::Filter;
use crate::lanes::Lanes;
use crate::motion::PrimitivePair;
use crate::points::PairShape;
use crate::scalar::Scalar;
#[cfg(not(unoptimised))]
use fearless_simd::{Simd, f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};

/// What [`Scalar`](crate::Scalar) needs to go sixteen at a time.
///
/// None of it is generic but what the feature `verification` adds, so that its many kernels (for each instruction set and kind) are
/// compiled once, in this crate, and not in every crate that calls them.
pub trait BatchScalar: Copy {
    /// Decides sixteen pairs by the certified filter. Pairs that are not `wanted` may stay undecided. Returns `None` if an index is
    /// not in the rows.
    #[doc(hidden)]
    fn by_filter(
        level: Level,
        kind: PairKind,
        separation: Option<Self>,
        pairs: Sixteen<'_, Self>,
        wanted: Mask,
    ) -> Option<Decision<Mask>>;

    /// What the filter does with one pair that its bound leaves open.
    #[doc(hidden)]
    fn culls_open(filter: &Filter<Self>, pair: &PrimitivePair<Self>) -> bool
    where
        Self: Scalar;

    /// Which of sixteen pairs a test culls.
    #[cfg(feature = "verification")]
    #[doc(hidden)]
    fn by_test(level: Level, kind: PairKind, test: Test, pairs: Sixteen<'_, Self>) -> Option<Mask>;

    /// The same of one test, compiled where it is called.
    #[cfg(feature = "verification")]
    #[doc(hidden)]
    fn by_points(level: Level, kind: PairKind, test: impl PointsTest, pairs: Sixteen<'_, Self>) -> Option<Mask>;

    /// The same of one test, compiled where it is called.
    #[cfg(feature = "verification")]
    #[doc(hidden)]
    fn by_volume(
        level: Level,
        kind: PairKind,
        test: impl VolumeTest<Self>,
        pairs: Sixteen<'_, Self>,
        wanted: Mask,
    ) -> Option<Decision<Mask>>;

    /// One round of advancing for sixteen pairs, from their times on, or none for those that are not `wanted`. `None` if an index is not in
    /// the rows.
    #[doc(hidden)]
    fn round(
        level: Level,
        kind: PairKind,
        question: &RoundQuestion<Self>,
        rows: &[VertexRow<Self>],
        indices: &[[u32; 4]; LANES],
        times: &mut [Self; LANES],
        wanted: Mask,
    ) -> Option<Round>;
}

/// Sixteen pairs' four points.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum Sixteen<'a, S> {
    /// Indices of rows.
    Mesh {
        rows: &'a [VertexRow<S>],
        indices: &'a [[u32; 4]; LANES],
    },
    #[cfg(feature = "verification")]
    Tile(&'a Tile<S>),
}

impl<S: Scalar> Sixteen<'_, S> {
    /// One pair; not a number if there is no such pair.
    #[inline(always)]
    pub(super) fn pair(self, kind: PairKind, lane: usize) -> PrimitivePair<S> {
        let motions = match self {
            #[cfg(feature = "verification")]
            Self::Tile(tile) => tile.motions(lane),
            Self::Mesh { rows, indices } => {
                let unknown = VertexRow([S::INFINITY * S::ZERO; 8]);
                let indices = indices.get(lane).copied().unwrap_or([u32::MAX; 4]);
                indices.map(|index| rows.get(index as usize).unwrap_or(&unknown).motion())
            }
        };
        PrimitivePair { kind, motions }
    }
}

#[cfg(feature = "verification")]
#[inline(always)]
fn test_points<P: PairShape, L: Chunk>(token: L::Token, test: impl PointsTest, pairs: Sixteen<'_, L::Scalar>) -> Option<Mask> {
    let (mut culled, mut first) = (0, 0);
    while first < LANES {
        culled |= L::bits(test.on::<P, L>(&points(token, pairs, first)?)) << first;
        first += L::WIDTH;
    }
    Some(culled)
}

/// The certified filter, with a separation or without.
#[derive(Clone, Copy)]
struct NonCoplanarity<S>(Option<S>);

impl<S: Scalar> VolumeTest<S> for NonCoplanarity<S> {
    #[inline(always)]
    fn on<P: PairShape, L: Lanes<Scalar = S>>(self, tetrahedron: &MovingTetrahedron<L>) -> Decision<L::Mask> {
        let separation = self.0.map(
            #[inline(always)]
            |separation| tetrahedron.p[0].x.splat(separation),
        );
        tetrahedron.decide::<P>(separation)
    }
}

/// Whether one pair alone is not among the `wanted`. Several at a time are cheaper than asking.
#[inline(always)]
const fn may_skip<L: Chunk>(wanted: Mask, first: usize) -> bool {
    L::WIDTH == 1 && wanted >> (first % LANES) & 1 == 0
}

#[inline(always)]
fn test_volume<P: PairShape, L: Chunk>(
    token: L::Token,
    test: impl VolumeTest<L::Scalar>,
    pairs: Sixteen<'_, L::Scalar>,
    wanted: Mask,
) -> Option<Decision<Mask>> {
    let (mut culled, mut settled, mut first) = (0, 0, 0);
    while first < LANES {
        if may_skip::<L>(wanted, first) {
            first += 1;
            continue;
        }
        let tetrahedron = match pairs {
            #[cfg(feature = "verification")]
            Sixteen::Tile(_) => points::<L>(token, pairs, first)?.tetrahedron::<P>(),
            Sixteen::Mesh { rows, indices } => {
                // The edge from the volume's first point to another.
                macro_rules! to {
                    ($point:literal) => {
                        some!(edge(
                            token,
                            rows,
                            indices,
                            first,
                            #[inline(always)]
                            |pair| {
                                let points = P::volume_points(pair);
                                [points[0], points[$point]]
                            },
                        ))
                    };
                }
                MovingTetrahedron {
                    b: to!(1),
                    c: to!(2),
                    p: to!(3),
                }
            }
        };
        let decision = test.on::<P, L>(&tetrahedron);
        culled |= L::bits(decision.culled) << first;
        settled |= L::bits(decision.settled) << first;
        first += L::WIDTH;
    }
    Some(Decision { culled, settled })
}

/// Times are written only when all of the pairs are known to be in the rows, so that they are the same for each width.
#[inline(always)]
fn advance<P: PairShape, L: Chunk>(
    token: L::Token,
    question: &RoundQuestion<L::Scalar>,
    rows: &[VertexRow<L::Scalar>],
    indices: &[[u32; 4]; LANES],
    times: &mut [L::Scalar; LANES],
    wanted: Mask,
) -> Option<Round> {
    let (mut all, mut new, mut first) = (Round::default(), *times, 0);
    while first < LANES {
        if may_skip::<L>(wanted, first) {
            first += 1;
            continue;
        }
        let points = some!(points::<L>(token, Sixteen::Mesh { rows, indices }, first));
        let found = round::<P, L>(&points, L::load(token, times, first), question);
        found.time.store(&mut new, first);
        all.apart |= L::bits(found.apart) << first;
        all.near |= L::bits(found.near) << first;
        all.stuck |= L::bits(found.stuck) << first;
        first += L::WIDTH;
    }
    *times = new;
    Some(all)
}

/// Calls a function of lanes and a token as code for `$level`, its lanes being the first of four types with AVX-512, the second with
/// AVX2, the third on machines whose registers hold 128 bits, else the last.
///
/// On x86 without code of its own for SSE4.2, which has next to nothing over SSE2 for these kernels.
#[cfg(not(unoptimised))]
macro_rules! vectorized {
    ($level:expr, [$wide:ident, $middle:ident, $narrow:ident, $one:ident], $function:ident::<$pair:ty>($($argument:expr),*)) => {{
        macro_rules! run {
            ($token:expr, $lanes:ident) => {
                if let Some(token) = $token {
                    return token.vectorize(
                        #[inline(always)]
                        || $function::<$pair, $lanes<_>>(token, $($argument),*),
                    );
                }
            };
        }
        let level: Level = $level;
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            run!(level.as_avx512(), $wide);
            run!(level.as_avx2(), $middle);
            run!(level.as_sse2(), $narrow);
        }
        #[cfg(target_arch = "aarch64")]
        run!(level.as_neon(), $narrow);
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        run!(level.as_wasm_simd128(), $narrow);
        // Nothing that we have code for.
        let _ = level;
        $function::<$pair, $crate::batch::alone::Alone<$one>>((), $($argument),*)
    }};
}

#[cfg(unoptimised)]
macro_rules! vectorized {
    ($level:expr, [$wide:ident, $middle:ident, $narrow:ident, $one:ident], $function:ident::<$pair:ty>($($argument:expr),*)) => {{
        let _: Level = $level;
        $function::<$pair, $crate::batch::alone::Alone<$one>>((), $($argument),*)
    }};
}

/// A format, with the lanes of its tests and those of its rounds.
macro_rules! batch_scalar {
    ($scalar:ident, $lanes:tt, rounds: $round_lanes:tt) => {
        impl BatchScalar for $scalar {
            fn by_filter(
                level: Level,
                kind: PairKind,
                separation: Option<Self>,
                pairs: Sixteen<'_, Self>,
                wanted: Mask,
            ) -> Option<Decision<Mask>> {
                of_kind!(kind, P => vectorized!(level, $lanes, test_volume::<P>(NonCoplanarity(separation), pairs, wanted)))
            }

            #[cold]
            fn culls_open(filter: &Filter<Self>, pair: &PrimitivePair<Self>) -> bool {
                filter.culls_open(pair)
            }

            #[cfg(feature = "verification")]
            fn by_test(level: Level, kind: PairKind, test: Test, pairs: Sixteen<'_, Self>) -> Option<Mask> {
                Self::by_points(level, kind, test, pairs)
            }

            #[cfg(feature = "verification")]
            #[inline]
            fn by_points(level: Level, kind: PairKind, test: impl PointsTest, pairs: Sixteen<'_, Self>) -> Option<Mask> {
                of_kind!(kind, P => vectorized!(level, $lanes, test_points::<P>(test, pairs)))
            }

            #[cfg(feature = "verification")]
            #[inline]
            fn by_volume(
                level: Level,
                kind: PairKind,
                test: impl VolumeTest<Self>,
                pairs: Sixteen<'_, Self>,
                wanted: Mask,
            ) -> Option<Decision<Mask>> {
                of_kind!(kind, P => vectorized!(level, $lanes, test_volume::<P>(test, pairs, wanted)))
            }

            fn round(
                level: Level,
                kind: PairKind,
                question: &RoundQuestion<Self>,
                rows: &[VertexRow<Self>],
                indices: &[[u32; 4]; LANES],
                times: &mut [Self; LANES],
                wanted: Mask,
            ) -> Option<Round> {
                of_kind!(kind, P => vectorized!(level, $round_lanes, advance::<P>(question, rows, indices, times, wanted)))
            }
        }
    };
}

// Rounds have long chains of dependent operations: two registers of `f32` at a time keep the machine busy.
batch_scalar!(f32, [f32x16, f32x8, f32x4, f32], rounds: [f32x16, f32x16, f32x8, f32]);
batch_scalar!(f64, [f64x8, f64x4, f64x2, f64], rounds: [f64x8, f64x4, f64x2, f64]);
