//! The pipeline agrees with its definition on small degenerate meshes. No pair is lost or found twice, and every preset ends with
//! the pairs that its own tests leave.

use proptest::prelude::*;
use selvedge::PairCounts;
use selvedge::PairKind::{self, EdgeEdge, VertexFace};
use selvedge::broad_phase::MovingBroadPhase;
use selvedge_core::elementary::advance::time_of_impact;
use selvedge_core::elementary::{ContactVerdict, Limits, contact};
use selvedge_core::filter::{Filter, Tier};
use selvedge_laboratory::baselines::cubic;
use selvedge_laboratory::methods::{ElementaryTest, PairSource, Preset, Redundancy, Stage, Stages};
use selvedge_laboratory::pipeline::Pipeline;
use selvedge_verification::formats;
use selvedge_verification::generator::{Format, MeshCase, MeshPair, PairCase, all_pairs, check, meshes, with_kinds};
use selvedge_verification::oracle::collides;
use std::collections::{BTreeMap, BTreeSet};

const KINDS: [PairKind; 2] = [VertexFace, EdgeEdge];

fn in_order(kind: PairKind, [a, b]: [u32; 2]) -> MeshPair {
    match kind {
        VertexFace => (kind, [a, b]),
        EdgeEdge => (kind, [a.min(b), a.max(b)]),
    }
}

/// Returns whether the closed boxes that the two primitives sweep have a point in common, by definition.
fn swept_boxes_overlap<S: Format>(pair: &PairCase<S>) -> bool {
    let [one, other] = pair.sets();
    (0..3).all(|axis| {
        let apart = |low: &[[[S; 3]; 2]], high: &[[[S; 3]; 2]]| {
            let all = |points: &[[[S; 3]; 2]]| -> Vec<S> { points.iter().flatten().map(|x| x[axis]).collect() };
            all(low).iter().all(|low| all(high).iter().all(|high| low < high))
        };
        !apart(one, other) && !apart(other, one)
    })
}

/// A pipeline after a step.
struct Run<S: Format> {
    pipeline: Pipeline<S>,
}

impl<S: Format> Run<S> {
    fn new(mesh: &MeshCase<S>, stages: Stages, threads: usize) -> Self {
        let mut pipeline = Pipeline::new(mesh.topology(), stages, threads).expect("threads");
        pipeline.keep_candidates(true);
        let mut run = Self { pipeline };
        run.step(mesh);
        run
    }

    fn step(&mut self, mesh: &MeshCase<S>) {
        let step = self.pipeline.step(&mesh.frame(0), &mesh.frame(1));
        step.expect("finite positions, one for each vertex");
    }

    fn candidates(&self) -> Vec<MeshPair> {
        let of_kind = |kind| {
            let pairs = self.pipeline.candidates(kind).iter();
            pairs.map(move |&pair| (kind, pair))
        };
        KINDS.into_iter().flat_map(of_kind).collect()
    }

    fn contacts(&self) -> BTreeSet<MeshPair> {
        let contacts = self.pipeline.contacts().iter();
        contacts.map(|contact| in_order(contact.kind, contact.pair)).collect()
    }

    /// Returns candidates and contacts in order of their numbers.
    fn in_order(&mut self) -> (BTreeSet<MeshPair>, BTreeMap<MeshPair, String>) {
        let contacts = self.pipeline.contacts().iter();
        let contacts = contacts.map(|contact| ((contact.kind, contact.pair), contact.time.to_string()));
        (as_set(&self.candidates()), contacts.collect())
    }

    /// Returns everything but the seconds.
    fn result(&self) -> impl PartialEq + std::fmt::Debug + use<S> {
        let report = self.pipeline.report();
        let survivors: Vec<(Stage, PairCounts)> = report.stages.iter().map(|stage| (stage.stage, stage.survivors)).collect();
        let contacts = self.pipeline.contacts().to_vec();
        (report.triangle_pairs, survivors, self.candidates(), contacts)
    }
}

fn distributed<S: Format>(mesh: &MeshCase<S>, redundancy: Redundancy) -> Vec<MeshPair> {
    let stages = Stages {
        source: PairSource::TrianglePairs(redundancy),
        tests: &[],
        elementary: ElementaryTest::Cubic,
    };
    Run::new(mesh, stages, 1).candidates()
}

fn as_set(pairs: &[MeshPair]) -> BTreeSet<MeshPair> {
    pairs.iter().map(|&(kind, pair)| in_order(kind, pair)).collect()
}

fn every_overlapping_pair_is_distributed_exactly_once<S: Format>(mesh: &MeshCase<S>) -> Result<(), TestCaseError> {
    let topology = mesh.topology();
    let all = with_kinds(all_pairs(&topology));
    let overlapping: BTreeSet<MeshPair> = all
        .iter()
        .copied()
        .filter(|&pair| swept_boxes_overlap(&mesh.pair(&topology, pair)))
        .collect();
    let all = as_set(&all);
    let [in_full, once, represented] = [Redundancy::Kept, Redundancy::HashSets, Redundancy::RepresentativeTriangles]
        .map(|redundancy| (distributed(mesh, redundancy), redundancy));
    for (pairs, redundancy) in [&in_full, &once, &represented] {
        let set = as_set(pairs);
        prop_assert!(
            set.is_superset(&overlapping),
            "{:?} loses {:?}",
            redundancy,
            overlapping.difference(&set).next()
        );
        prop_assert!(set.is_subset(&all), "{:?}: {:?}", redundancy, set.difference(&all).next());
        if *redundancy != Redundancy::Kept {
            prop_assert_eq!(set.len(), pairs.len(), "{:?} repeats a pair", redundancy);
        }
    }
    // Hash sets drop duplicates and nothing else. Representatives also drop pairs whose representatives are apart.
    let [in_full, once, represented] = [in_full, once, represented].map(|(pairs, _)| as_set(&pairs));
    prop_assert_eq!(&in_full, &once);
    prop_assert!(represented.is_subset(&once));
    Ok(())
}

formats!(every_overlapping_pair_is_distributed_exactly_once(600, meshes()));

/// The mesh is ten million units from the origin, where the broad phase's `f32` has steps of 1.
#[test]
fn every_overlapping_pair_is_distributed_exactly_once_far_from_the_origin() {
    fn far<S: Format>(mesh: &MeshCase<S>) -> Result<(), TestCaseError> {
        every_overlapping_pair_is_distributed_exactly_once(&mesh.moved_by([1e7, -1e7, 1e7].map(S::from_f64)))
    }
    check(400, meshes::<f64>(), far);
    check(150, meshes::<f32>(), far);
}

/// One triangle names a vertex twice. It has two vertices and one edge, and each pair with the other triangle's features is met
/// once.
#[test]
fn a_degenerate_triangle_has_each_of_its_features_once() {
    let mesh = MeshCase::<f64> {
        triangles: vec![[0, 0, 1], [2, 3, 4]],
        positions: vec![[[0.0; 3]; 2]; 5],
    };
    for redundancy in [Redundancy::Kept, Redundancy::HashSets, Redundancy::RepresentativeTriangles] {
        let pairs = distributed(&mesh, redundancy);
        let faces = pairs.iter().filter(|(kind, _)| *kind == VertexFace);
        assert_eq!((faces.count(), pairs.len()), (5, 8), "{redundancy:?}");
    }
}

fn every_preset_ends_with_what_its_own_tests_leave<S: Format>(mesh: &MeshCase<S>) -> Result<(), TestCaseError> {
    let topology = mesh.topology();
    for preset in Preset::ALL {
        let stages = preset.stages();
        let PairSource::TrianglePairs(redundancy) = stages.source else {
            continue;
        };
        let mut left = distributed(mesh, redundancy);
        let run = Run::new(mesh, stages, 1);
        let report = run.pipeline.report();
        let counts = |left: &[MeshPair]| {
            let of_kind = |wanted| left.iter().filter(|(kind, _)| *kind == wanted).count() as u64;
            PairCounts {
                vertex_face: of_kind(VertexFace),
                edge_edge: of_kind(EdgeEdge),
            }
        };
        prop_assert_eq!(report.survivors(Stage::Distribution), Some(counts(&left)));
        for &test in stages.tests {
            left.retain(|&pair| !test.culls(&mesh.pair(&topology, pair).pair()));
            let found = report.survivors(test.stage());
            prop_assert_eq!(found, Some(counts(&left)), "{} after {:?}", preset, test);
        }
        prop_assert_eq!(report.candidates(), counts(&left));
        let mut candidates = run.candidates();
        prop_assert_eq!(&candidates, &left, "{}", preset);

        let time = |&pair: &MeshPair| {
            let pair = mesh.pair(&topology, pair).pair();
            let certified = time_of_impact(&pair, &Limits::default()).time();
            match stages.elementary {
                ElementaryTest::Cubic => cubic::time_of_impact(&pair),
                ElementaryTest::TimeOfImpact => certified,
                ElementaryTest::Exact => certified.filter(|_| contact(&pair) == ContactVerdict::Happens),
                other => panic!("{preset} ends with {other}"),
            }
        };
        candidates.retain(|pair| time(pair).is_some());
        prop_assert_eq!(run.contacts(), as_set(&candidates), "{}", preset);
        for contact in run.pipeline.contacts() {
            prop_assert_eq!(Some(contact.time), time(&(contact.kind, contact.pair)));
        }
    }
    Ok(())
}

formats!(every_preset_ends_with_what_its_own_tests_leave(150, meshes()));

/// Another test is about the candidates of moving boxes; this one is about the later stages. Times differ in the last bits from
/// those of one pair alone, because several pairs advance side by side first.
fn moving_boxes_end_with_what_the_certified_tests_leave<S: Format>(mesh: &MeshCase<S>) -> Result<(), TestCaseError> {
    let topology = mesh.topology();
    let mut broad_phase = MovingBroadPhase::new(topology.clone());
    let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
    let update = broad_phase.update(&mesh.frame(0), &mesh.frame(1));
    update.expect("finite positions, one for each vertex");
    broad_phase.candidates(&mut vertex_face, &mut edge_edge);
    let mut left = with_kinds([vertex_face, edge_edge]);
    let run = Run::new(mesh, Preset::Selvedge.stages(), 1);
    let report = run.pipeline.report();
    prop_assert_eq!(report.broad_phase_pairs.map(PairCounts::total), Some(left.len() as u64));
    // The f64 filter decides what the f32 filter leaves open.
    let filter = Filter::<S>::new(Tier::Widened);
    left.retain(|&pair| !filter.verdict(&mesh.pair(&topology, pair).pair()).is_culled());
    prop_assert_eq!(&run.candidates(), &left);

    let mut contacts = BTreeMap::new();
    for contact in run.pipeline.contacts() {
        let twice = contacts.insert((contact.kind, contact.pair), contact.time);
        prop_assert!(twice.is_none(), "{:?} is found twice", contact);
    }
    for pair in contacts.keys() {
        prop_assert!(left.contains(pair), "{:?} was culled", pair);
    }
    for pair in left {
        if let Some(first) = collides(&mesh.pair(&topology, pair).question()) {
            let time = contacts.get(&pair).map(|time| time.to_f64());
            let is_in_time = time.is_some_and(|time| first.cmp_f64(time).is_ge());
            prop_assert!(is_in_time, "{:?} at {:?}, not {:?}", pair, time, first);
        }
    }
    Ok(())
}

formats!(moving_boxes_end_with_what_the_certified_tests_leave(150, meshes()));

/// Candidates and contacts agree with the exact oracle, from the mesh on: no certified preset loses a pair that collides, and the
/// exact one finds no other.
fn certified_presets_keep_the_pairs_that_collide<S: Format>(mesh: &MeshCase<S>) -> Result<(), TestCaseError> {
    let topology = mesh.topology();
    let mut colliding = with_kinds(all_pairs(&topology));
    colliding.retain(|&pair| collides(&mesh.pair(&topology, pair).question()).is_some());
    let colliding = as_set(&colliding);
    let is_certified = |preset: &Preset| preset.stages().tests.iter().all(|test| test.is_certified());
    for preset in Preset::ALL.into_iter().filter(is_certified) {
        let run = Run::new(mesh, preset.stages(), 1);
        let candidates = as_set(&run.candidates());
        let lost = colliding.difference(&candidates).next();
        prop_assert!(lost.is_none(), "{} loses {:?}", preset, lost);
        if preset == Preset::SelvedgeExact {
            prop_assert_eq!(run.contacts(), colliding.clone());
        }
    }
    Ok(())
}

formats!(certified_presets_keep_the_pairs_that_collide(150, meshes()));

#[test]
fn certified_presets_keep_the_pairs_that_collide_far_from_the_origin() {
    check(100, meshes::<f64>(), |mesh| {
        certified_presets_keep_the_pairs_that_collide(&mesh.moved_by([1e7, -1e7, 1e7]))
    });
}

fn threads_change_nothing<S: Format>(mesh: &MeshCase<S>) -> Result<(), TestCaseError> {
    for preset in Preset::ALL {
        let one = Run::new(mesh, preset.stages(), 1);
        for threads in [2, 3] {
            let several = Run::new(mesh, preset.stages(), threads);
            prop_assert!(several.result() == one.result(), "{} on {} threads", preset, threads);
        }
    }
    Ok(())
}

formats!(threads_change_nothing(40, meshes()));

/// Buffers are reused, but no data of a step may remain in the next.
#[test]
fn an_earlier_step_changes_nothing() {
    check(100, meshes::<f64>(), |mesh| {
        let elsewhere = MeshCase {
            triangles: mesh.triangles.clone(),
            positions: mesh.positions.iter().rev().copied().collect(),
        };
        for preset in Preset::ALL {
            let mut used = Run::new(&elsewhere, preset.stages(), 1);
            used.step(mesh);
            let mut fresh = Run::new(mesh, preset.stages(), 1);
            if preset.stages().source == PairSource::MovingBoxes {
                // The order is that of the hierarchies, which keep their shape.
                let [used, fresh] = [&mut used, &mut fresh].map(Run::in_order);
                prop_assert_eq!(used, fresh);
                continue;
            }
            prop_assert!(used.result() == fresh.result(), "{}", preset);
        }
        Ok(())
    });
}
