//! Tests of lanes for batches: filters, boxes, and tests of the caller.
//!
//! `selvedge` itself uses only the filter and the rounds of advancing.

use crate::coplanarity::{Decision, MovingTetrahedron};
use crate::lanes::Lanes;
use crate::points::PairPoints;
use crate::points::PairShape;
use crate::scalar::Scalar;

/// A test of the pairs' signed volumes, on any number of lanes.
pub trait VolumeTest: Copy {
    /// Decides the lanes' pairs. A caller's test may leave [`settled`](Decision::settled) false.
    fn on<P: PairShape, L: Lanes<Scalar: Scalar>>(self, tetrahedron: &MovingTetrahedron<L>) -> Decision<L::Mask>;
}

/// A test of the pairs' points, on any number of lanes.
pub trait PointsTest: Copy {
    /// Returns the lanes whose pairs it culls.
    fn on<P: PairShape, L: Lanes>(self, points: &PairPoints<L>) -> L::Mask;
}

/// A culling test of the pairs' points that runs on batches. See [`boxes`](crate::boxes).
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

/// A caller's test of points for batches, run by the code that runs [`Test`], so that times compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ByPoints<T>(pub T);

/// A caller's test of volumes for batches, run by the code that runs [`Filter`](crate::filter::Filter).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ByVolume<T>(pub T);
