use selvedge::core::boxes::Aabb;
use selvedge::core::{Motion, Scalar};
use selvedge::{CandidateBoxes, CollisionDetector, Contact, PairKind, Threads, Topology};
use selvedge_verification::generator::{Format, MeshCase};
use selvedge_verification::oracle::{Pair, collides};
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
    let once = |pairs: &[PrimitivePair]| {
        let once: BTreeSet<_> = pairs.iter().copied().map(in_order).collect();
        assert_eq!(once.len(), pairs.len(), "a pair twice in {case:?}");
        for &(kind, pair) in &once {
            assert!(!share_vertex(kind, pair, &topology), "{kind:?} {pair:?} of {case:?}");
        }
        once
    };
    // Boxes are compared in single precision, so there may be more candidates than pairs whose boxes overlap.
    let overlapping = overlapping_pairs(case, &topology);
    let candidates = once(&step.candidates);
    let missing: Vec<_> = overlapping.difference(&candidates).collect();
    assert!(missing.is_empty(), "no candidates: {missing:?} of {case:?}");

    let found: Vec<_> = step.contacts.iter().map(|contact| (contact.kind, contact.pair)).collect();
    let found = once(&found);
    // The oracle is slow, so it decides 16 pairs of a mesh. Other targets test single pairs.
    let excluded: Vec<_> = overlapping.difference(&found).collect();
    for &&(kind, pair) in excluded.iter().step_by(1 + excluded.len() / 16) {
        let contact = collides(&question(case, &topology, kind, pair));
        assert!(contact.is_none(), "{kind:?} {pair:?} of {case:?}");
    }
    if threads > 1 {
        assert_eq!(Step::new(case, threads), step, "{threads} threads, {case:?}");
    }
}

type PrimitivePair = (PairKind, [u32; 2]);

/// Puts the smaller edge of two first.
fn in_order((kind, mut pair): PrimitivePair) -> PrimitivePair {
    if kind == PairKind::EdgeEdge {
        pair.sort_unstable();
    }
    (kind, pair)
}

/// The detector's results for a step.
#[derive(Debug, PartialEq)]
struct Step<S: Scalar> {
    candidates: Vec<PrimitivePair>,
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
        let of_kind = |kind, pairs: Vec<[u32; 2]>| pairs.into_iter().map(move |pair| (kind, pair));
        let candidates = of_kind(PairKind::VertexFace, vertex_face).chain(of_kind(PairKind::EdgeEdge, edge_edge));
        Self {
            candidates: candidates.collect(),
            contacts,
        }
    }
}

/// Returns the pairs whose swept boxes overlap, by trying all of them.
fn overlapping_pairs<S: Format>(case: &MeshCase<S>, topology: &Topology) -> BTreeSet<PrimitivePair> {
    let used: BTreeSet<u32> = topology.triangles().iter().flatten().copied().collect();
    let faces = 0..topology.triangles().len() as u32;
    let edges = 0..topology.edges().len() as u32;
    let vertex_face = used
        .iter()
        .flat_map(|&vertex| faces.clone().map(move |face| (PairKind::VertexFace, [vertex, face])));
    let edge_edge = edges
        .clone()
        .flat_map(|first| (0..first).map(move |second| (PairKind::EdgeEdge, [second, first])));
    vertex_face
        .chain(edge_edge)
        .filter(|&(kind, pair)| !share_vertex(kind, pair, topology))
        .filter(|&(kind, pair)| boxes_overlap(case, topology, kind, pair))
        .collect()
}

fn share_vertex(kind: PairKind, pair: [u32; 2], topology: &Topology) -> bool {
    let vertices = topology.vertices_of(kind, pair);
    let (first, second) = vertices.split_at(first_points(kind));
    first.iter().any(|vertex| second.contains(vertex))
}

const fn first_points(kind: PairKind) -> usize {
    match kind {
        PairKind::VertexFace => 1,
        PairKind::EdgeEdge => 2,
    }
}

fn boxes_overlap<S: Format>(case: &MeshCase<S>, topology: &Topology, kind: PairKind, pair: [u32; 2]) -> bool {
    let motions = topology.vertices_of(kind, pair).map(|vertex| {
        let [start, end] = case.positions[vertex as usize];
        Motion::<S> {
            start: start.into(),
            end: end.into(),
        }
    });
    let (first, second) = motions.split_at(first_points(kind));
    Aabb::swept(first).overlaps(&Aabb::swept(second))
}

fn question<S: Format>(case: &MeshCase<S>, topology: &Topology, kind: PairKind, pair: [u32; 2]) -> Pair {
    let vertices = topology.vertices_of(kind, pair);
    let at = |end: usize| vertices.map(|vertex| case.positions[vertex as usize][end].map(S::to_f64));
    Pair {
        kind,
        start: at(0),
        end: at(1),
    }
}
