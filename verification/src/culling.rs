//! The culling tests of `selvedge-core` by name, one pair at a time: so that a property can go through all of them, and
//! what the pipeline does in batches can be done again by hand.

use crate::generator::{Format, PairCase};
use selvedge_core::PairKind;
use selvedge_core::boxes::{Aabb, Dop18, relative, segment, swept_boxes};
use selvedge_core::{PrimitivePair, Verdict, filter};
use selvedge_laboratory::baselines::plain;
use selvedge_laboratory::pipeline::CullingTest;

/// Every test there is.
pub const ALL: [CullingTest; 10] = [
    CullingTest::SweptBoxes,
    CullingTest::StoredSweptBoxes,
    CullingTest::StoredDop18,
    CullingTest::SegmentBox,
    CullingTest::RelativeBoxes,
    CullingTest::RelativeBoxesNine,
    CullingTest::SubspaceThree,
    CullingTest::SubspaceNine,
    CullingTest::PlainNonCoplanarity,
    CullingTest::CertifiedNonCoplanarity,
];

/// Those that must never cull a pair that touches, rounding included.
pub fn certified() -> impl Iterator<Item = CullingTest> {
    ALL.into_iter().filter(|test| test.is_certified())
}

/// What `test` says of `case`.
pub fn verdict<S: Format>(test: CullingTest, case: &PairCase<S>) -> Verdict {
    match case.kind {
        PairKind::VertexFace if test == CullingTest::SegmentBox => segment::vertex_face(&case.vertex_face()),
        PairKind::VertexFace => of_either_kind(test, &case.vertex_face(), 1),
        PairKind::EdgeEdge => of_either_kind(test, &case.edge_edge(), 2),
    }
}

/// `first` is how many of the four points are the first set's.
fn of_either_kind<S: Format>(test: CullingTest, pair: &impl PrimitivePair<S>, first: usize) -> Verdict {
    match test {
        CullingTest::SweptBoxes | CullingTest::SegmentBox => swept_boxes(pair),
        CullingTest::StoredSweptBoxes => {
            let motions = pair.motions();
            let (first, second) = motions.split_at(first);
            Verdict::culled_if(!Aabb::swept(first).overlaps(&Aabb::swept(second)))
        }
        CullingTest::StoredDop18 => {
            let dops = pair.motions().map(|motion| Dop18::swept(&motion));
            let (first, second) = dops.split_at(first);
            let [first, second] = [first, second].map(|dops| {
                let merge = |all: Dop18<S>, dop: &Dop18<S>| all.merged(dop);
                dops[1..].iter().fold(dops[0], merge)
            });
            Verdict::culled_if(!first.overlaps(&second))
        }
        CullingTest::RelativeBoxes | CullingTest::SubspaceThree => relative::three_axes(pair),
        CullingTest::RelativeBoxesNine | CullingTest::SubspaceNine => relative::nine_directions(pair),
        CullingTest::PlainNonCoplanarity => plain::non_coplanarity(pair),
        CullingTest::CertifiedNonCoplanarity => filter::certified::non_coplanarity(pair),
    }
}
