use super::pair::{self, Numbers};
use selvedge::core::boxes::{Aabb, segment::misses};
use selvedge::core::{Motion, Verdict};
use selvedge_verification::culling::{self, CertifiedTest};
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::{collides, rational, segment_meets_box};

/// No certified test culls a pair that touches, or one with NaN or infinities. Every test culls at least what swept boxes cull,
/// and more directions cull more. The path of a vertex misses a box only if it does so exactly, and always then if nothing is
/// rounded.
pub fn box_tests(data: &[u8]) {
    match pair::numbers(data) {
        Numbers::Single(case) => check(&case),
        Numbers::Double(case) => check(&case),
    }
    let whole = pair::whole(data).map(|ends| ends.map(|position| position.map(f64::from)));
    let (missed, apart) = path_and_box(whole);
    assert_eq!(missed, apart, "{whole:?}");
}

fn check<S: Format>(case: &PairCase<S>) {
    use CertifiedTest::{RelativeBoxes, SegmentBox, StoredSweptBoxes, SweptBoxes};
    let culls = |test| culling::verdict(test, case).is_culled();

    if !case.is_finite() {
        for test in CertifiedTest::ALL {
            assert_eq!(culling::verdict(test, case), Verdict::Kept, "{test:?}: {case:?}");
        }
        return;
    }
    for (weaker, stronger) in [
        (SweptBoxes, StoredSweptBoxes),
        (SweptBoxes, SegmentBox),
        (SweptBoxes, RelativeBoxes),
    ] {
        assert!(
            !culls(weaker) || culls(stronger) || overflows(case),
            "{weaker:?} culls, {stronger:?} does not: {case:?}"
        );
    }
    if let Some(test) = CertifiedTest::ALL.into_iter().find(|&test| culls(test)) {
        let contact = collides(&case.question());
        assert!(contact.is_none(), "{test:?} at {contact:?}: {case:?}");
    }
    let (missed, apart) = path_and_box(case.points);
    assert!(!missed || apart, "{case:?}");
}

/// Returns whether sums of coordinates may be infinite. Then it is not promised which tests keep a pair.
fn overflows<S: Format>(case: &PairCase<S>) -> bool {
    let sum: f64 = case.coordinates().map(|x| x.to_f64().abs()).sum();
    sum >= S::LARGEST.to_f64()
}

/// Returns whether the test says that the first point's path misses the box that the others sweep, and whether it does.
fn path_and_box<S: Format>(points: [[[S; 3]; 2]; 4]) -> (bool, bool) {
    let [path, face @ ..] = points.map(|[start, end]| Motion {
        start: start.into(),
        end: end.into(),
    });
    let target = Aabb::<S>::swept(&face);
    let exact = |position: [S; 3]| position.map(rational);
    let bounds = [target.lower, target.upper].map(exact);
    (misses(&path, &target), !segment_meets_box(&points[0].map(exact), &bounds))
}
