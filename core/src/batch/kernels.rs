//! The loops of tests over the chunks of sixteen pairs.
//!
//! There is one function for each level, format, kind of pair and kind of work. Each has a loop at the width of the machine's
//! registers. So the crate is compiled in seconds. One function with all of them, sixteen lanes wide, takes minutes and
//! gigabytes. None of them is generic, except for tests of the caller, so they are compiled once, in this crate.

use super::chunk::{Chunk, edge, points};
use super::lane_test::VolumeTest;
use super::lane_test::{PointsTest, Test};
use super::mask::{LANES, Mask};
use super::sixteen::{InEitherFormat, Sixteen};
use crate::coplanarity::{Decision, MovingTetrahedron};
use crate::filter::Filter;
use crate::kind::PairKind;
use crate::lanes::Lanes;
use crate::motion::PrimitivePair;
use crate::points::PairShape;
use crate::scalar::{Family, InFormat, Scalar};
use crate::separation_lanes::SeparationLanes;
use fearless_simd::Level;
#[cfg(not(unoptimised))]
use fearless_simd::{Simd, f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};

/// Calls a function of `single` or of `double` with sixteen pairs in their format.
macro_rules! in_format {
    ($pairs:expr, $function:ident($level:expr, $kind:expr, $argument:expr)) => {
        match S::in_format::<InEitherFormat<'_>>($pairs) {
            InFormat::Single(pairs) => single::$function($level, $kind, $argument, pairs),
            InFormat::Double(pairs) => double::$function($level, $kind, $argument, pairs),
        }
    };
}

/// Decides sixteen pairs by the certified filter. Returns `None` if an index is not in the rows.
#[inline(always)]
pub(super) fn by_filter<S: Scalar>(level: Level, kind: PairKind, separation: S, pairs: Sixteen<'_, S>) -> Option<Decision<Mask>> {
    in_format!(pairs, by_filter(level, kind, NonCoplanarity(separation.to_f64())))
}

/// Returns the pairs that a test culls, or `None` if an index is not in the rows.
#[inline(always)]
pub(super) fn by_test<S: Scalar>(level: Level, kind: PairKind, test: Test, pairs: Sixteen<'_, S>) -> Option<Mask> {
    in_format!(pairs, by_test(level, kind, test))
}

/// Returns the pairs that a test of points culls. The test is compiled where it is called.
#[inline(always)]
pub(super) fn by_points<S: Scalar>(level: Level, kind: PairKind, test: impl PointsTest, pairs: Sixteen<'_, S>) -> Option<Mask> {
    in_format!(pairs, by_points(level, kind, test))
}

/// Returns the pairs that a test of volumes culls. The test is compiled where it is called.
#[inline(always)]
pub(super) fn by_volume<S: Scalar>(
    level: Level,
    kind: PairKind,
    test: impl VolumeTest,
    pairs: Sixteen<'_, S>,
) -> Option<Decision<Mask>> {
    in_format!(pairs, by_volume(level, kind, test))
}

/// Returns whether the filter culls one pair that its bound leaves open.
#[inline(always)]
pub(super) fn culls_open<S: Scalar>(filter: Filter<S>, pair: PrimitivePair<S>) -> bool {
    struct FilterAndPair;
    impl Family for FilterAndPair {
        type Of<S: Scalar> = (Filter<S>, PrimitivePair<S>);
    }
    match S::in_format::<FilterAndPair>((filter, pair)) {
        InFormat::Single((filter, pair)) => single::culls_open(filter, &pair),
        InFormat::Double((filter, pair)) => double::culls_open(filter, &pair),
    }
}

/// The certified filter, with a separation that its format holds exactly, or zero.
#[derive(Clone, Copy)]
struct NonCoplanarity(f64);

impl VolumeTest for NonCoplanarity {
    #[inline(always)]
    fn on<P: PairShape, L: Lanes<Scalar: Scalar>>(self, tetrahedron: &MovingTetrahedron<L>) -> Decision<L::Mask> {
        let separation = SeparationLanes::new(L::Scalar::from_f64(self.0), tetrahedron.p[0].x);
        tetrahedron.decide::<P>(separation)
    }
}

#[inline(always)]
fn test_points<P: PairShape, L: Chunk>(token: L::Token, test: impl PointsTest, pairs: Sixteen<'_, L::Scalar>) -> Option<Mask> {
    let mut culled = 0;
    for chunk in 0..LANES / L::WIDTH {
        let first = chunk * L::WIDTH;
        culled |= L::bits(test.on::<P, L>(&points(token, pairs, first)?)) << first;
    }
    Some(culled)
}

#[inline(always)]
fn test_volume<P: PairShape, L: Chunk>(
    token: L::Token,
    test: impl VolumeTest,
    pairs: Sixteen<'_, L::Scalar>,
) -> Option<Decision<Mask>> {
    let (mut culled, mut settled) = (0, 0);
    for chunk in 0..LANES / L::WIDTH {
        let first = chunk * L::WIDTH;
        let tetrahedron = match pairs {
            Sixteen::Tile(_) => points::<L>(token, pairs, first)?.tetrahedron::<P>(),
            Sixteen::Mesh { rows, indices } => {
                // The edge from the volume's first point to another.
                macro_rules! to {
                    ($point:literal) => {
                        edge(
                            token,
                            rows,
                            indices,
                            first,
                            #[inline(always)]
                            |pair| {
                                let points = P::volume_points(pair);
                                [points[0], points[$point]]
                            },
                        )?
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
    }
    Some(Decision { culled, settled })
}

/// The functions of one format.
macro_rules! kernels {
    ($format:ident, $scalar:ident, $lanes:tt) => {
        mod $format {
            use super::*;

            pub(super) fn by_filter(
                level: Level,
                kind: PairKind,
                test: NonCoplanarity,
                pairs: Sixteen<'_, $scalar>,
            ) -> Option<Decision<Mask>> {
                of_kind!(kind, P => vectorized!(level, $lanes, test_volume::<P>(test, pairs)))
            }

            #[cold]
            pub(super) fn culls_open(filter: Filter<$scalar>, pair: &PrimitivePair<$scalar>) -> bool {
                filter.culls_open(pair)
            }

            pub(super) fn by_test(level: Level, kind: PairKind, test: Test, pairs: Sixteen<'_, $scalar>) -> Option<Mask> {
                by_points(level, kind, test, pairs)
            }

            #[inline]
            pub(super) fn by_points(
                level: Level,
                kind: PairKind,
                test: impl PointsTest,
                pairs: Sixteen<'_, $scalar>,
            ) -> Option<Mask> {
                of_kind!(kind, P => vectorized!(level, $lanes, test_points::<P>(test, pairs)))
            }

            #[inline]
            pub(super) fn by_volume(
                level: Level,
                kind: PairKind,
                test: impl VolumeTest,
                pairs: Sixteen<'_, $scalar>,
            ) -> Option<Decision<Mask>> {
                of_kind!(kind, P => vectorized!(level, $lanes, test_volume::<P>(test, pairs)))
            }
        }
    };
}

kernels!(single, f32, [f32x16, f32x8, f32x4, f32]);
kernels!(double, f64, [f64x8, f64x4, f64x2, f64]);
