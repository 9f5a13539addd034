//! Sixteen pairs at a time get the verdicts that they get one by one, bit for bit, on every instruction set of this machine.

use proptest::prelude::*;
use selvedge::dispatch::available_levels;
use selvedge::pipeline::{CullingTest, Pipeline, Preset};
use selvedge_core::batch::{LANES, Mask, Test, VertexRow, culled, culled_from_rows};
use selvedge_core::points::Shape;
use selvedge_core::{EdgeEdge, VertexFace};
use selvedge_verification::culling::verdict;
use selvedge_verification::generator::{Choices, Format, PairCase, check, from_choices, meshes};
use selvedge_verification::oracle::Kind;

const TESTS: [(Test, CullingTest); 4] = [
    (Test::SweptBoxes, CullingTest::SweptBoxes),
    (Test::RelativeBoxes, CullingTest::RelativeBoxes),
    (Test::RelativeBoxesNine, CullingTest::RelativeBoxesNine),
    (
        Test::CertifiedNonCoplanarity,
        CullingTest::CertifiedNonCoplanarity,
    ),
];

/// Pairs of one kind, now and then with coordinates that are NaN, infinite or huge.
fn some_pairs<S: Format>(kind: Kind) -> impl Strategy<Value = Vec<PairCase<S>>> {
    let pair = from_choices(move |choices: &mut Choices<'_>| {
        if choices.once_in(8) {
            PairCase::choose_any(kind, choices)
        } else {
            PairCase::choose(kind, choices)
        }
    });
    prop::collection::vec(pair, 0..40)
}

fn bits(masks: &[Mask], count: usize) -> Vec<bool> {
    (0..count)
        .map(|k| masks[k / LANES] >> (k % LANES) & 1 == 1)
        .collect()
}

fn verdicts_agree<S: Format>(kind: Kind) {
    let config = ProptestConfig {
        cases: 400,
        ..ProptestConfig::default()
    };
    proptest!(config, |(pairs in some_pairs::<S>(kind))| {
        let rows: Vec<_> = pairs.iter().flat_map(|pair| pair.motions().map(VertexRow::new)).collect();
        let indices: Vec<[u32; 4]> = (0..pairs.len() as u32).map(|k| [0, 1, 2, 3].map(|point| 4 * k + point)).collect();
        for (test, one_by_one) in TESTS {
            let expected: Vec<_> = pairs.iter().map(|pair| verdict(one_by_one, pair).is_culled()).collect();
            for (name, level) in available_levels() {
                // One mask more than needed: it must be left alone.
                let mut masks = vec![0xABCD; pairs.len().div_ceil(LANES) + 1];
                let mut from_rows = masks.clone();
                match kind {
                    Kind::VertexFace => {
                        let pairs: Vec<VertexFace<S>> = pairs.iter().map(PairCase::vertex_face).collect();
                        culled(level, test, &pairs, &mut masks);
                        culled_from_rows(level, Shape::VertexFace, test, &rows, &indices, &mut from_rows);
                    }
                    Kind::EdgeEdge => {
                        let pairs: Vec<EdgeEdge<S>> = pairs.iter().map(PairCase::edge_edge).collect();
                        culled(level, test, &pairs, &mut masks);
                        culled_from_rows(level, Shape::EdgeEdge, test, &rows, &indices, &mut from_rows);
                    }
                }
                prop_assert_eq!(&masks, &from_rows, "{} {:?}", name, test);
                prop_assert_eq!(masks.last(), Some(&0xABCD));
                prop_assert_eq!(bits(&masks, pairs.len()), &expected[..], "{} {:?}", name, test);
                if pairs.len() % LANES != 0 {
                    prop_assert_eq!(masks[pairs.len() / LANES] >> (pairs.len() % LANES), 0, "bits past the last pair");
                }
            }
        }
    });
}

#[test]
fn vertex_face_f32() {
    verdicts_agree::<f32>(Kind::VertexFace);
}

#[test]
fn vertex_face_f64() {
    verdicts_agree::<f64>(Kind::VertexFace);
}

#[test]
fn edge_edge_f32() {
    verdicts_agree::<f32>(Kind::EdgeEdge);
}

#[test]
fn edge_edge_f64() {
    verdicts_agree::<f64>(Kind::EdgeEdge);
}

#[test]
fn an_index_that_names_no_vertex_keeps_its_pair_and_no_other() {
    // Two resting pairs far apart; the second names a vertex that is not there.
    let far = |z: f64| VertexRow::new(([0.0, 0.0, z], [0.0, 0.0, z]).into());
    let rows = [far(9.0), far(0.0)];
    for (name, level) in available_levels() {
        for (test, _) in &TESTS[..3] {
            let mut masks = [0];
            let indices = [[0, 1, 1, 1], [0, 1, 1, 2]];
            culled_from_rows(level, Shape::VertexFace, *test, &rows, &indices, &mut masks);
            assert_eq!(masks, [0b01], "{name} {test:?}");
        }
    }
}

#[test]
fn a_step_has_the_same_candidates_on_every_instruction_set() {
    check(200, meshes::<f64>(), |mesh| {
        let mut results = available_levels().into_iter().map(|(_, level)| {
            let mut pipeline =
                Pipeline::<f64>::new(mesh.topology(), Preset::Selvedge.stages(), 1).unwrap();
            pipeline.set_level(level);
            pipeline.keep_candidates(true);
            pipeline.step(&mesh.frame(0), &mesh.frame(1)).unwrap();
            use selvedge::PairKind::{EdgeEdge, VertexFace};
            [VertexFace, EdgeEdge].map(|kind| pipeline.candidates(kind).to_vec())
        });
        let first = results.next().unwrap();
        prop_assert!(results.all(|result| result == first));
        Ok(())
    });
}
