//! The culling tests of `selvedge-core` by name, one pair at a time, so that a property can go through all of them.

use crate::generator::{Format, PairCase};
use selvedge_core::boxes::{Aabb, relative, segment, swept_boxes};
use selvedge_core::{Verdict, filter};

/// A culling test. None of them culls a pair that touches, rounding included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CertifiedTest {
    SweptBoxes,
    /// Axis-aligned boxes that the two primitives sweep, merged from those of single points.
    StoredSweptBoxes,
    /// The vertex's path against the face's box; for two edges, their swept boxes.
    SegmentBox,
    /// One of three coordinate axes keeps the two primitives in the same order.
    RelativeBoxes,
    /// Four control values that certainly have one sign.
    CertifiedNonCoplanarity,
}

impl CertifiedTest {
    pub const ALL: [Self; 5] = [
        Self::SweptBoxes,
        Self::StoredSweptBoxes,
        Self::SegmentBox,
        Self::RelativeBoxes,
        Self::CertifiedNonCoplanarity,
    ];
}

pub fn verdict<S: Format>(test: CertifiedTest, case: &PairCase<S>) -> Verdict {
    let pair = &case.pair();
    match test {
        CertifiedTest::SweptBoxes => swept_boxes(pair),
        CertifiedTest::SegmentBox => segment::primitive_boxes(pair),
        CertifiedTest::StoredSweptBoxes => {
            let [first, second] = pair.sets().map(Aabb::swept);
            Verdict::culled_if(!first.overlaps(&second))
        }
        CertifiedTest::RelativeBoxes => relative::three_axes(pair),
        CertifiedTest::CertifiedNonCoplanarity => filter::certified::non_coplanarity(pair),
    }
}
