//! Sixteen pairs side by side: the same tests, at the machine's width.
//!
//! A test here is the one-pair test, from the same source, on vectors of lanes. Its verdicts are **the same, bit for
//! bit**, for every instruction set: each operation rounds on its own, and nothing is fused or reassociated.
//!
//! Pairs come either from a mesh, as indices into [`VertexRow`]s ([`culled_from_rows`]), or one by one
//! ([`culled`]). Any number of pairs will do, at any address. The answer is one [`Mask`] for every sixteen pairs: a set bit
//! says that the pair is culled.
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

mod rows;
mod simd;

pub use fearless_simd::Level;
pub use rows::VertexRow;

use crate::boxes;
use crate::filter;
use crate::lanes::Lanes;
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape, Shape};
use crate::scalar::Scalar;
pub(crate) use simd::BatchScalar;

/// How many pairs go side by side.
pub const LANES: usize = 16;

/// One bit for each of sixteen pairs, the first pair's lowest. Bits past the last pair are zero.
pub type Mask = u16;

/// A culling test that runs on batches. See [`boxes`] and [`filter`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Test {
    /// [`boxes::swept_boxes`].
    SweptBoxes,
    /// [`boxes::relative::three_axes`].
    RelativeBoxes,
    /// [`boxes::relative::nine_directions`].
    RelativeBoxesNine,
    /// [`filter::certified::non_coplanarity`].
    CertifiedNonCoplanarity,
}

impl Test {
    #[inline(always)]
    fn on<P: PairShape, L: Lanes>(self, points: &PairPoints<L>) -> L::Mask {
        match self {
            Self::SweptBoxes => boxes::have_disjoint_swept_boxes::<P, L>(points),
            Self::RelativeBoxes => boxes::relative::are_apart_along_three_axes::<P, L>(points),
            Self::RelativeBoxesNine => {
                boxes::relative::are_apart_along_nine_directions::<P, L>(points)
            }
            Self::CertifiedNonCoplanarity => {
                filter::certified::is_never_coplanar(&points.tetrahedron::<P>())
            }
        }
    }
}

/// Which of `pairs` `test` culls, sixteen to a mask. Masks past the last pair are not touched; pairs past the last mask
/// are not looked at.
pub fn culled<S: Scalar, P: PrimitivePair<S>>(
    level: Level,
    test: Test,
    pairs: &[P],
    masks: &mut [Mask],
) {
    for (pairs, mask) in pairs.chunks(LANES).zip(masks) {
        let mut rows = [[VertexRow::unknown(); 4]; LANES];
        for (row, pair) in rows.iter_mut().zip(pairs) {
            *row = pair.motions().map(VertexRow::new);
        }
        let sixteen = rows.each_ref().map(<[_; 4]>::each_ref);
        *mask = S::sixteen(level, P::Shape::SHAPE, test, &sixteen);
    }
}

/// Which of the pairs that `indices` name `test` culls. An index that is not in `rows` keeps the pair.
///
/// The four indices of a pair are those of its vertices: vertex, face; or first edge, second edge. Pairs that follow
/// one another should name rows that are close in memory.
pub fn culled_from_rows<S: Scalar>(
    level: Level,
    shape: Shape,
    test: Test,
    rows: &[VertexRow<S>],
    indices: &[[u32; 4]],
    masks: &mut [Mask],
) {
    let unknown = VertexRow::unknown();
    for (indices, mask) in indices.chunks(LANES).zip(masks) {
        let mut sixteen = [[&unknown; 4]; LANES];
        for (pair, indices) in sixteen.iter_mut().zip(indices) {
            for (row, &index) in pair.iter_mut().zip(indices) {
                *row = rows.get(index as usize).unwrap_or(&unknown);
            }
        }
        *mask = S::sixteen(level, shape, test, &sixteen);
    }
}
