//! Tests of lanes, on batches: the crate's own, and with the feature `verification` a caller's, which promise nothing.

#[cfg(feature = "verification")]
use super::{BatchTest, Level, Mask, Sixteen};
use crate::coplanarity::MovingTetrahedron;
use crate::filter::certified::Decision;
use crate::lanes::Lanes;
use crate::points::{PairPoints, PairShape};
#[cfg(feature = "verification")]
use crate::scalar::Scalar;

/// A test of the pairs' points, on any number of lanes.
pub trait PointsTest: Copy {
    /// The lanes whose pairs it culls.
    fn on<P: PairShape, L: Lanes>(self, points: &PairPoints<L>) -> L::Mask;
}

/// A test of the pairs' signed volumes, on any number of lanes of the format `S`.
pub trait VolumeTest<S>: Copy {
    /// What it says of the lanes' pairs. Nothing is made of what it calls settled.
    fn on<P: PairShape, L: Lanes<Scalar = S>>(self, tetrahedron: &MovingTetrahedron<L>) -> Decision<L::Mask>;
}

/// A caller's test of points as a [`BatchTest`], by the code that runs [`Test`](super::Test): for a fair comparison of times.
#[cfg(feature = "verification")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ByPoints<T>(pub T);

/// A caller's test of volumes as a [`BatchTest`], by the code that runs [`Filter`](crate::filter::Filter).
#[cfg(feature = "verification")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ByVolume<T>(pub T);

#[cfg(feature = "verification")]
impl<S: Scalar, T: PointsTest> BatchTest<S> for ByPoints<T> {
    #[inline(always)]
    fn sixteen<P: PairShape>(self, level: Level, pairs: Sixteen<'_, S>) -> Option<Mask> {
        Some(S::by_points(level, P::KIND, self.0, pairs)?.culled)
    }
}

#[cfg(feature = "verification")]
impl<S: Scalar, T: VolumeTest<S>> BatchTest<S> for ByVolume<T> {
    #[inline(always)]
    fn sixteen<P: PairShape>(self, level: Level, pairs: Sixteen<'_, S>) -> Option<Mask> {
        Some(S::by_volume(level, P::KIND, self.0, pairs)?.culled)
    }
}
