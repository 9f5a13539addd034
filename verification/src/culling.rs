//! The culling tests of `selvedge-core` by name, one pair at a time: so that a property can go through all of them, and
//! what the pipeline does in batches can be done again by hand.

use crate::generator::{Format, PairCase};
use selvedge_core::boxes::{Aabb, relative, segment, swept_boxes};
use selvedge_core::{Verdict, filter};
use selvedge_laboratory::baselines::nine_directions::{self, Dop18};
use selvedge_laboratory::baselines::plain;
use selvedge_laboratory::methods::CullingTest;

/// Those that must never cull a pair that touches, rounding included.
pub fn certified() -> impl Iterator<Item = CullingTest> {
    CullingTest::ALL.into_iter().filter(|test| test.is_certified())
}

/// What `test` says of `case`.
pub fn verdict<S: Format>(test: CullingTest, case: &PairCase<S>) -> Verdict {
    let pair = &case.pair();
    match test {
        CullingTest::SweptBoxes => swept_boxes(pair),
        CullingTest::SegmentBox => segment::primitive_boxes(pair),
        CullingTest::StoredSweptBoxes => {
            let [first, second] = pair.sets().map(Aabb::swept);
            Verdict::culled_if(!first.overlaps(&second))
        }
        CullingTest::StoredDop18 => {
            let [first, second] = pair.sets().map(|set| {
                let dops = set.iter().map(Dop18::swept);
                dops.reduce(|all, dop| all.merged(&dop)).expect("a set has points")
            });
            Verdict::culled_if(!first.overlaps(&second))
        }
        CullingTest::RelativeBoxes | CullingTest::SubspaceThree => relative::three_axes(pair),
        CullingTest::RelativeBoxesNine | CullingTest::SubspaceNine => nine_directions::separated(pair),
        CullingTest::PlainNonCoplanarity => plain::non_coplanarity(pair),
        CullingTest::CertifiedNonCoplanarity => filter::certified::non_coplanarity(pair),
    }
}
