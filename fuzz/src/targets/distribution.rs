use selvedge::PairKind;
use selvedge::Topology;
use selvedge::core::boxes::Aabb;
use selvedge::core::{Motion, Scalar};
use selvedge_laboratory::methods::{Preset, Stages};
use selvedge_laboratory::pipeline::{Contact, Pipeline};
use selvedge_verification::generator::{Format, MeshCase};
use selvedge_verification::oracle::{Pair, collides};
use std::collections::BTreeSet;

/// Every vertex–face and edge–edge pair without a common vertex whose swept boxes overlap is distributed exactly once, with
/// representative triangles and with hash sets, and no pair that has a common vertex ever is; the `selvedge` preset drops only
/// pairs that do not touch; and two threads change nothing.
pub fn distribution(data: &[u8]) {
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
    let must_be_there = overlapping_pairs(case, &topology);

    let once = |name: Preset, pairs: Vec<PrimitivePair>| {
        let once: BTreeSet<_> = pairs.iter().copied().collect();
        assert_eq!(once.len(), pairs.len(), "{name} has a pair twice in {case:?}");
        for &(kind, pair) in &once {
            let touch = share_vertex(kind, pair, &topology);
            assert!(!touch, "{name} has {kind:?} {pair:?} of {case:?}");
        }
        once
    };
    // Without culling tests, what the pipeline keeps is what it has distributed. Boxes are compared in single precision, so
    // there may be more; and more with hash sets, where any triangle of a feature will do.
    let distributed = |preset: Preset| {
        let stages = Stages {
            tests: &[],
            ..preset.stages()
        };
        let once = once(preset, Step::new(case, stages, 1).candidates());
        let missing: Vec<_> = must_be_there.difference(&once).collect();
        assert!(missing.is_empty(), "{preset} lacks {missing:?} of {case:?}");
        once
    };
    let representative = distributed(Preset::Curtis2008);
    let hashed = distributed(Preset::Basic);
    assert!(representative.is_subset(&hashed), "{case:?}");

    // It finds pairs by itself, by boxes that are rounded in another way.
    let culled = Step::new(case, Preset::Selvedge.stages(), 1);
    let kept = once(Preset::Selvedge, culled.candidates());
    // Exact answers take their time; other targets are after single pairs.
    let dropped: Vec<_> = representative.difference(&kept).collect();
    for &&(kind, pair) in dropped.iter().step_by(1 + dropped.len() / 16) {
        let contact = collides(&question(case, &topology, kind, pair));
        assert!(contact.is_none(), "{kind:?} {pair:?} of {case:?}");
    }

    if threads > 1 {
        let several = Step::new(case, Preset::Selvedge.stages(), threads);
        assert_eq!(several, culled, "{threads} threads, {case:?}");
    }
}

type PrimitivePair = (PairKind, [u32; 2]);

/// What a step of a pipeline leaves.
#[derive(Debug, PartialEq)]
struct Step<S: Scalar> {
    candidates: Vec<PrimitivePair>,
    contacts: Vec<Contact<S>>,
}

impl<S: Format> Step<S> {
    fn new(case: &MeshCase<S>, stages: Stages, threads: usize) -> Self {
        let mut pipeline = Pipeline::<S>::new(case.topology(), stages, threads).expect("threads can be started");
        pipeline.keep_candidates(true);
        let [start, end] = [0, 1].map(|end| case.frame(end));
        pipeline.step(&start, &end).expect("finite positions");
        let candidates = [PairKind::VertexFace, PairKind::EdgeEdge]
            .into_iter()
            .flat_map(|kind| pipeline.candidates(kind).iter().map(move |&pair| (kind, pair)))
            .collect();
        Self {
            candidates,
            contacts: pipeline.contacts().to_vec(),
        }
    }

    /// In order, the smaller edge of two first.
    fn candidates(&self) -> Vec<PrimitivePair> {
        let mut pairs = self.candidates.clone();
        for (kind, pair) in &mut pairs {
            if *kind == PairKind::EdgeEdge {
                pair.sort_unstable();
            }
        }
        pairs.sort_unstable();
        pairs
    }
}

/// By trying all of them.
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
