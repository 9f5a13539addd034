use super::table::table;
use super::{Ask, MeasuredFilter, WithLanes, WithTest};
use crate::baselines::nine_directions::{self, Dop18, NineDirections};
use selvedge_core::batch::{ByPoints, Test};
use selvedge_core::boxes;
use selvedge_core::filter::certified;
use selvedge_core::{PrimitivePair, Scalar};

table! {
    /// A culling test on primitive pairs. See [`selvedge_core::boxes`] and [`selvedge_core::filter`].
    pub enum CullingTest of Stage {
        /// Swept axis-aligned boxes of the two primitives, made for each pair. The test is exact.
        SweptBoxes = "swept_boxes": Stage::Boxes,
        /// Swept 18-DOPs, stored for every vertex, edge and face and refitted each step. The test is exact.
        StoredDop18 = "dop_18": Stage::Boxes,
        /// The vertex's path against the face's swept box for VF, and swept boxes for EE. The test is certified.
        SegmentBox = "segment_box": Stage::Boxes,
        /// One of three coordinate axes keeps the two primitives in the same order. The test is exact.
        RelativeBoxes = "relative_boxes": Stage::RelativeBoxes,
        /// [`RelativeBoxes`](Self::RelativeBoxes) with the six diagonals as well. The test is exact.
        RelativeBoxesNine = "relative_boxes_nine": Stage::RelativeBoxes,
        /// The three-axis subspace filter of Tang, Li, Wang 2010 as reconstructed. It is the computation of
        /// [`RelativeBoxes`](Self::RelativeBoxes), counted as a filter.
        SubspaceThree = "subspace_three": Stage::Subspace,
        /// The subspace filter of Tang, Li, Wang 2011 as reconstructed: nine fixed directions.
        SubspaceNine = "subspace_nine": Stage::Subspace,
        /// Four control values of one sign, as printed in the paper. **Not certified.**
        PlainNonCoplanarity = "non_coplanarity_plain": Stage::NonCoplanarity,
        /// Four control values certainly of one sign. The test is certified.
        CertifiedNonCoplanarity = "non_coplanarity": Stage::NonCoplanarity,
    }
}

table! {
    /// A place in the data flow where pairs are counted, and whether boxes are compared there.
    pub enum Stage of bool {
        /// The candidate triangle pairs.
        BroadPhase = "broad-phase": false,
        /// The primitive pairs of the candidates.
        Distribution = "distribution": false,
        /// The pairs after the primitive box test.
        Boxes = "boxes": true,
        /// The pairs after relative boxes.
        RelativeBoxes = "relative-boxes": true,
        /// The pairs after the subspace filter.
        Subspace = "subspace": false,
        /// The pairs after the non-coplanarity filter.
        NonCoplanarity = "non-coplanarity": false,
        /// The contacts, after the elementary test.
        Elementary = "elementary": false,
    }
}

impl Stage {
    /// Returns whether the stage compares boxes (the paper's first stage) rather than planes or directions (its second).
    pub const fn is_box_test(self) -> bool {
        self.row()
    }
}

impl CullingTest {
    /// Returns the stage of this test.
    pub const fn stage(self) -> Stage {
        self.row()
    }

    /// Returns whether it never culls a pair that touches, rounding included.
    pub const fn is_certified(self) -> bool {
        !matches!(self, Self::PlainNonCoplanarity)
    }

    /// Returns whether the test culls the pair. Volumes that a pipeline stores are made from the pair.
    #[inline(always)]
    pub fn culls<S: Scalar>(self, pair: &PrimitivePair<S>) -> bool {
        self.run(Ask(pair))
    }

    /// Passes the test to `with`: whether a pair is culled.
    #[inline(always)]
    pub(crate) fn run<S: Scalar, W: WithTest<S, bool>>(self, with: W) -> W::Outcome {
        match self {
            Self::SweptBoxes => with.with(|pair| boxes::swept_boxes(pair).is_culled()),
            Self::StoredDop18 => with.with(have_disjoint_dops),
            Self::SegmentBox => with.with(|pair| boxes::segment::primitive_boxes(pair).is_culled()),
            Self::RelativeBoxes | Self::SubspaceThree => with.with(|pair| boxes::relative::three_axes(pair).is_culled()),
            Self::RelativeBoxesNine | Self::SubspaceNine => with.with(|pair| nine_directions::separated(pair).is_culled()),
            Self::PlainNonCoplanarity => MeasuredFilter::Paper.run(S::ZERO, with),
            // Core's function for one pair without a separation is faster than its filter, with the same verdicts.
            Self::CertifiedNonCoplanarity => with.with(|pair| certified::non_coplanarity(pair).is_culled()),
        }
    }

    /// Passes the test to `with`, on lanes. [`StoredDop18`](Self::StoredDop18) has no lanes and culls nothing here.
    #[inline(always)]
    pub(crate) fn run_lanes<S: Scalar>(self, with: impl WithLanes<S>) {
        match self {
            Self::SweptBoxes => with.with(Test::SweptBoxes),
            Self::SegmentBox => with.with(Test::SegmentBox),
            Self::RelativeBoxes | Self::SubspaceThree => with.with(Test::RelativeBoxes),
            Self::RelativeBoxesNine | Self::SubspaceNine => with.with(ByPoints(NineDirections)),
            Self::PlainNonCoplanarity => MeasuredFilter::Paper.run_lanes(S::ZERO, with),
            Self::CertifiedNonCoplanarity => MeasuredFilter::Permanent.run_lanes(S::ZERO, with),
            Self::StoredDop18 => {}
        }
    }
}

fn have_disjoint_dops<S: Scalar>(pair: &PrimitivePair<S>) -> bool {
    let [first, second] = pair.sets().map(|set| {
        let dops = set.iter().map(Dop18::swept);
        dops.reduce(|all, dop| all.merged(&dop)).expect("a set has points")
    });
    !first.overlaps(&second)
}
