//! Sixteen pairs side by side: the same tests, at the machine's width.
//!
//! A test here is the one-pair test, from the same source, on vectors of lanes. Its verdicts are **the same, bit for
//! bit**, for every instruction set: each operation rounds on its own, and nothing is fused or reassociated.
//!
//! Pairs come from a mesh, as indices into [`VertexRow`]s ([`culled_from_rows`]), or one by one ([`culled`]), or side by
//! side as [`Tile`]s ([`culled_from_tiles`]). Any number of pairs will do, at any address. The answer is one [`Mask`] for
//! every sixteen pairs: a set bit says that the pair is culled.
//!
//! Pairs that tests leave go on side by side as well: [`advance_from_rows`] is one round of the certified
//! [time of impact](crate::elementary::advance) for each.
//!
//! The caller names the instruction set by a [`Level`]; `selvedge` detects the best one at run time.
//!
//! ```
//! use selvedge_core::batch::{culled, Level, Test};
//! use selvedge_core::{glam::Vec3, Motion, VertexFace};
//!
//! let pairs: Vec<_> = (1..=20)
//!     .map(|k| VertexFace {
//!         // The first nineteen stay above the triangle; the last falls through.
//!         vertex: Motion::new(Vec3::new(0.2, 0.2, 2.0), Vec3::new(0.2, 0.2, 19.5 - k as f32)),
//!         face: [Vec3::ZERO, Vec3::X, Vec3::Y].map(Motion::resting),
//!     })
//!     .collect();
//! let mut masks = [0; 2];
//! culled(Level::baseline(), Test::CertifiedNonCoplanarity, &pairs, &mut masks);
//! assert_eq!(masks, [0xFFFF, 0b0111]);
//! ```

mod advance;
mod chunk;
mod kernels;
mod lane_test;
mod rows;
#[cfg(not(unoptimised))]
mod simd;
mod tile;

pub use advance::{Round, RoundQuestion, advance_from_rows};
pub use fearless_simd::{Level, Simd};
#[cfg(feature = "verification")]
pub use lane_test::{ByPoints, ByVolume, PointsTest, VolumeTest};
#[cfg(not(feature = "verification"))]
use lane_test::{PointsTest, VolumeTest};
pub use rows::VertexRow;
pub use tile::Tile;

use crate::PairKind;
use crate::boxes;
use crate::coplanarity::MovingTetrahedron;
use crate::filter::certified::{Bound, Decision, decide};
use crate::filter::{Filter, inside};
use crate::lanes::Lanes;
use crate::motion::PrimitivePair;
use crate::points::{EdgeAndEdge, PairPoints, PairShape, VertexAndFace};
use crate::scalar::Scalar;
pub(crate) use kernels::{BatchScalar, Sixteen};

/// How many pairs go side by side.
pub const LANES: usize = 16;

/// One bit for each of sixteen pairs, the first pair's lowest. Bits past the last pair are zero.
pub type Mask = u16;

/// A culling test that runs on batches. See [`boxes`] and [`filter`](crate::filter).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Test {
    /// [`boxes::swept_boxes`].
    SweptBoxes,
    /// [`boxes::segment::vertex_face`]; for EE, [`boxes::swept_boxes`].
    SegmentBox,
    /// [`boxes::relative::three_axes`].
    RelativeBoxes,
    /// [`boxes::relative::nine_directions`].
    RelativeBoxesNine,
    /// [`boxes::direction::normal`].
    NormalDirection,
    /// [`inside::never_inside`].
    InsideFunctions,
    /// [`non_coplanarity`](crate::filter::certified::non_coplanarity).
    CertifiedNonCoplanarity,
}

impl Test {
    #[inline(always)]
    fn kernel<S>(self) -> Kernel<S> {
        let test = match self {
            Self::SweptBoxes => PointTest::Swept,
            Self::SegmentBox => PointTest::Segment,
            Self::RelativeBoxes => PointTest::ThreeAxes,
            Self::RelativeBoxesNine => PointTest::NineDirections,
            Self::NormalDirection => PointTest::Normal,
            Self::InsideFunctions => PointTest::Inside,
            Self::CertifiedNonCoplanarity => {
                return Kernel::Bounded(Bounded {
                    bound: Bound::Permanent,
                    separation: None,
                });
            }
        };
        Kernel::Points(test)
    }
}

/// What the instruction sets have code for.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum Kernel<S> {
    /// Tests of points.
    Points(PointTest),
    /// Control values and their bound, with a separation if there is one.
    Bounded(Bounded<S>),
}

#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Bounded<S> {
    bound: Bound,
    separation: Option<S>,
}

impl<S: Scalar> VolumeTest<S> for Bounded<S> {
    #[inline(always)]
    fn on<P: PairShape, L: Lanes<Scalar = S>>(self, tetrahedron: &MovingTetrahedron<L>) -> Decision<L::Mask> {
        let separation = self.separation.map(
            #[inline(always)]
            |separation| tetrahedron.p[0].x.splat(separation),
        );
        decide::<P, L>(self.bound, tetrahedron, separation)
    }
}

#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum PointTest {
    Swept,
    Segment,
    ThreeAxes,
    NineDirections,
    Normal,
    Inside,
}

impl PointsTest for PointTest {
    #[inline(always)]
    fn on<P: PairShape, L: Lanes>(self, points: &PairPoints<L>) -> L::Mask {
        match self {
            Self::Segment if matches!(P::KIND, PairKind::VertexFace) => boxes::segment::misses_face(points),
            Self::Swept | Self::Segment => boxes::have_disjoint_swept_boxes::<P, L>(points),
            Self::ThreeAxes => boxes::relative::are_apart_along_three_axes::<P, L>(points),
            Self::NineDirections => boxes::relative::are_apart_along_nine_directions::<P, L>(points),
            Self::Normal => boxes::direction::are_apart_along_normal::<P, L>(points),
            Self::Inside => inside::is_outside_of_one_side::<P, L>(points),
        }
    }
}

/// What can be asked of a batch: a [`Test`], or a [`Filter`] of any tier and separation.
pub trait BatchTest<S: Scalar>: Copy + sealed::Sealed {
    /// Which of sixteen pairs of this kind it culls. `None` if an index is not in the rows.
    #[doc(hidden)]
    fn sixteen<P: PairShape>(self, level: Level, pairs: Sixteen<'_, S>) -> Option<Mask>;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Test {}
    impl<S> Sealed for super::Filter<S> {}
    #[cfg(feature = "verification")]
    impl<T> Sealed for super::ByPoints<T> {}
    #[cfg(feature = "verification")]
    impl<T> Sealed for super::ByVolume<T> {}
}

impl<S: Scalar> BatchTest<S> for Test {
    #[inline(always)]
    fn sixteen<P: PairShape>(self, level: Level, pairs: Sixteen<'_, S>) -> Option<Mask> {
        Some(S::sixteen(level, P::KIND, self.kernel(), pairs)?.culled)
    }
}

impl<S: Scalar> BatchTest<S> for Filter<S> {
    /// Side by side as far as the tier's bound goes, then one by one.
    #[inline(always)]
    fn sixteen<P: PairShape>(self, level: Level, pairs: Sixteen<'_, S>) -> Option<Mask> {
        let kernel = Kernel::Bounded(Bounded {
            bound: self.tier().bound(),
            separation: self.positive_separation(),
        });
        let Decision { mut culled, settled } = S::sixteen(level, P::KIND, kernel, pairs)?;
        // One by one, of those that the tier has more to say of.
        let mut open = self.tier().open(culled, settled);
        while open != 0 {
            let lane = open.trailing_zeros();
            open &= open - 1;
            if self.culls_open::<P>(&points(pairs, lane as usize)) {
                culled |= 1 << lane;
            }
        }
        Some(culled)
    }
}

/// Which of `pairs` `test` culls, sixteen to a mask. Masks past the last pair are not touched; pairs past the last mask
/// are not looked at.
pub fn culled<S: Scalar, P: PrimitivePair<S>>(level: Level, test: impl BatchTest<S>, pairs: &[P], masks: &mut [Mask]) {
    for (pairs, mask) in pairs.chunks(LANES).zip(masks) {
        let tile = Tile::new(pairs.iter().map(PrimitivePair::motions));
        *mask = of_tile::<S, P::Shape>(level, test, &tile);
    }
}

/// Which pairs of `tiles` `test` culls, a mask for each tile: the fastest form, for pairs that lie side by side already.
pub fn culled_from_tiles<S: Scalar>(
    level: Level,
    kind: PairKind,
    test: impl BatchTest<S>,
    tiles: &[Tile<S>],
    masks: &mut [Mask],
) {
    for (tile, mask) in tiles.iter().zip(masks) {
        *mask = match kind {
            PairKind::VertexFace => of_tile::<S, VertexAndFace>(level, test, tile),
            PairKind::EdgeEdge => of_tile::<S, EdgeAndEdge>(level, test, tile),
        };
    }
}

/// Which of the pairs that `indices` name `test` culls. An index that is not in `rows` keeps the pair.
///
/// The four indices of a pair are those of its vertices: vertex, face; or first edge, second edge. Pairs that follow
/// one another should name rows that are close in memory.
pub fn culled_from_rows<S: Scalar>(
    level: Level,
    kind: PairKind,
    test: impl BatchTest<S>,
    rows: &[VertexRow<S>],
    indices: &[[u32; 4]],
    masks: &mut [Mask],
) {
    match kind {
        PairKind::VertexFace => {
            of_mesh::<S, VertexAndFace>(level, test, rows, indices, masks);
        }
        PairKind::EdgeEdge => of_mesh::<S, EdgeAndEdge>(level, test, rows, indices, masks),
    }
}

#[inline(always)]
fn of_mesh<S: Scalar, P: PairShape>(
    level: Level,
    test: impl BatchTest<S>,
    rows: &[VertexRow<S>],
    indices: &[[u32; 4]],
    masks: &mut [Mask],
) {
    for (indices, mask) in indices.chunks(LANES).zip(masks) {
        let whole = indices
            .first_chunk()
            .and_then(|indices| test.sixteen::<P>(level, Sixteen::Mesh { rows, indices }));
        *mask = match whole {
            Some(mask) => mask,
            None => of_tile::<S, P>(level, test, &gathered(rows, indices)),
        };
    }
}

/// Fewer than sixteen pairs, or some whose indices are not in `rows`.
#[cold]
fn gathered<S: Scalar>(rows: &[VertexRow<S>], indices: &[[u32; 4]]) -> Tile<S> {
    let unknown = VertexRow::unknown();
    let motion = |index: u32| rows.get(index as usize).unwrap_or(&unknown).motion();
    Tile::new(indices.iter().map(|indices| indices.map(motion)))
}

#[inline(always)]
fn of_tile<S: Scalar, P: PairShape>(level: Level, test: impl BatchTest<S>, tile: &Tile<S>) -> Mask {
    // A tile has no indices that could be wrong.
    test.sixteen::<P>(level, Sixteen::Tile(tile)).unwrap_or(0)
}

/// The four points of one pair; not a number if there is no such pair.
#[inline(always)]
fn points<S: Scalar>(pairs: Sixteen<'_, S>, lane: usize) -> PairPoints<S> {
    let [[a, e], [b, f], [c, g], [d, h]] = match pairs {
        Sixteen::Tile(tile) => tile.positions(lane),
        Sixteen::Mesh { rows, indices } => {
            let unknown = VertexRow::unknown();
            let indices = indices.get(lane).copied().unwrap_or([u32::MAX; 4]);
            indices.map(|index| rows.get(index as usize).unwrap_or(&unknown).positions())
        }
    };
    PairPoints {
        start: [a, b, c, d],
        end: [e, f, g, h],
    }
}
