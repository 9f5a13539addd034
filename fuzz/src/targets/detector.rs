use selvedge::core::Scalar;
use selvedge::core::boxes::Aabb;
use selvedge::{CandidateBoxes, CollisionDetector, Contact, PairKind, Threads};
use selvedge_verification::generator::{Format, MeshCase, MeshPair, PairCase, all_pairs, with_kinds};
use selvedge_verification::oracle::collides;
use std::collections::BTreeSet;

/// Every vertex–face and edge–edge pair without a common vertex whose swept boxes overlap is a candidate exactly once. No pair
/// with a common vertex is one. The detector's contacts lack no pair that touches. Two threads change nothing.
pub fn detector(data: &[u8]) {
    let (&first, rest) = data.split_first().unwrap_or((&0, &[]));
    let threads = if first & 0b1110 == 0b1110 { 2 } else { 1 };
    if first & 1 == 0 {
        check(&MeshCase::<f64>::from_bytes(rest), threads);
    } else {
        check(&MeshCase::<f32>::from_bytes(rest), threads);
    }
}

fn check<S: Format>(case: &MeshCase<S>, threads: usize) {
    let topology = case.topology();
    let step = Step::new(case, 1);
    let all: BTreeSet<MeshPair> = with_kinds(all_pairs(&topology)).into_iter().collect();
    let once = |pairs: &[MeshPair]| {
        let once: BTreeSet<_> = pairs.iter().copied().map(in_order).collect();
        assert_eq!(once.len(), pairs.len(), "a pair twice in {case:?}");
        assert!(once.is_subset(&all), "{:?} of {case:?}", once.difference(&all).next());
        once
    };
    // Boxes are compared in single precision, so there may be more candidates than pairs whose boxes overlap.
    let overlapping: BTreeSet<MeshPair> = all
        .iter()
        .copied()
        .filter(|&pair| boxes_overlap(&case.pair(&topology, pair)))
        .collect();
    let candidates = once(&step.candidates);
    let missing: Vec<_> = overlapping.difference(&candidates).collect();
    assert!(missing.is_empty(), "no candidates: {missing:?} of {case:?}");

    let found: Vec<_> = step.contacts.iter().map(|contact| (contact.kind, contact.pair)).collect();
    let found = once(&found);
    // The oracle is slow, so it decides 16 pairs of a mesh. Other targets test single pairs.
    let excluded: Vec<_> = overlapping.difference(&found).collect();
    for &&pair in excluded.iter().step_by(1 + excluded.len() / 16) {
        let contact = collides(&case.pair(&topology, pair).question());
        assert!(contact.is_none(), "{pair:?} of {case:?}");
    }
    if threads > 1 {
        assert_eq!(Step::new(case, threads), step, "{threads} threads, {case:?}");
    }
}

/// Puts the smaller edge of two first.
fn in_order((kind, mut pair): MeshPair) -> MeshPair {
    if kind == PairKind::EdgeEdge {
        pair.sort_unstable();
    }
    (kind, pair)
}

#[derive(Debug, PartialEq)]
struct Step<S: Scalar> {
    candidates: Vec<MeshPair>,
    contacts: Vec<Contact<S>>,
}

impl<S: Format> Step<S> {
    fn new(case: &MeshCase<S>, threads: usize) -> Self {
        let mut detector = CollisionDetector::<S>::new(case.topology());
        let started = detector.set_threads(Threads::from_count(threads));
        started.expect("threads can be started");
        let [start, end] = [0, 1].map(|end| case.frame(end));
        let (mut vertex_face, mut edge_edge, mut contacts) = (Vec::new(), Vec::new(), Vec::new());
        let found = detector.candidates(&start, &end, CandidateBoxes::Swept, &mut vertex_face, &mut edge_edge);
        found.expect("finite positions");
        detector.contacts(&start, &end, &mut contacts).expect("finite positions");
        Self {
            candidates: with_kinds([vertex_face, edge_edge]),
            contacts,
        }
    }
}

fn boxes_overlap<S: Format>(pair: &PairCase<S>) -> bool {
    let [first, second] = pair.pair().sets().map(Aabb::swept);
    first.overlaps(&second)
}
