//! Tests of lanes for batches. The feature `verification` adds tests of boxes, and tests of the caller's own.
//!
//! `selvedge` itself uses only the filter and the rounds of advancing.

#[cfg(feature = "verification")]
pub use shown::{ByPoints, ByVolume, Test};

use crate::coplanarity::{Decision, MovingTetrahedron};
use crate::lanes::Lanes;
use crate::points::PairShape;
use crate::scalar::Scalar;

/// A test of the pairs' points, on any number of lanes.
#[cfg(feature = "verification")]
pub trait PointsTest: Copy {
    /// Returns the lanes whose pairs it culls.
    fn on<P: PairShape, L: Lanes>(self, points: &crate::points::PairPoints<L>) -> L::Mask;
}

/// A test of the pairs' signed volumes, on any number of lanes.
#[cfg_attr(not(feature = "verification"), allow(unreachable_pub))]
pub trait VolumeTest: Copy {
    /// Decides the lanes' pairs. A caller's test may leave [`settled`](Decision::settled) false.
    fn on<P: PairShape, L: Lanes<Scalar: Scalar>>(self, tetrahedron: &MovingTetrahedron<L>) -> Decision<L::Mask>;
}

#[cfg(feature = "verification")]
mod shown {
    use super::{PointsTest, VolumeTest};
    use crate::batch::culled::BatchTest;
    use crate::batch::kernels;
    use crate::batch::mask::Mask;
    use crate::batch::sixteen::Sixteen;
    use crate::kind::PairKind;
    use crate::lanes::Lanes;
    use crate::points::{PairPoints, PairShape};
    use crate::scalar::Scalar;
    use fearless_simd::Level;

    /// A culling test of the pairs' points that runs on batches. See [`boxes`](crate::boxes) and [`filter`](crate::filter).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    #[non_exhaustive]
    pub enum Test {
        /// [`boxes::swept_boxes`](crate::boxes::swept_boxes).
        SweptBoxes,
        /// [`boxes::segment::primitive_boxes`](crate::boxes::segment::primitive_boxes).
        SegmentBox,
        /// [`boxes::relative::three_axes`](crate::boxes::relative::three_axes).
        RelativeBoxes,
    }

    impl PointsTest for Test {
        #[inline(always)]
        fn on<P: PairShape, L: Lanes>(self, points: &PairPoints<L>) -> L::Mask {
            match self {
                Self::SweptBoxes => points.have_disjoint_swept_boxes::<P>(),
                Self::SegmentBox => points.have_disjoint_primitive_boxes::<P>(),
                Self::RelativeBoxes => points.are_apart_along_three_axes::<P>(),
            }
        }
    }

    impl<S: Scalar> BatchTest<S> for Test {
        #[inline(always)]
        fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, _: Mask) -> Option<Mask> {
            kernels::by_test(level, kind, self, pairs)
        }
    }

    /// A caller's test of points as a [`BatchTest`], run by the code that runs [`Test`]: for a fair comparison of times.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub struct ByPoints<T>(pub T);

    /// A caller's test of volumes as a [`BatchTest`], run by the code that runs [`Filter`](crate::filter::Filter).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub struct ByVolume<T>(pub T);

    impl<S: Scalar, T: PointsTest> BatchTest<S> for ByPoints<T> {
        #[inline(always)]
        fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, _: Mask) -> Option<Mask> {
            kernels::by_points(level, kind, self.0, pairs)
        }
    }

    impl<S: Scalar, T: VolumeTest> BatchTest<S> for ByVolume<T> {
        #[inline(always)]
        fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, _: Mask) -> Option<Mask> {
            Some(kernels::by_volume(level, kind, self.0, pairs)?.culled)
        }
    }
}
