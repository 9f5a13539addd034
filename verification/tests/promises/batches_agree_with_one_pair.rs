//! Sixteen pairs at a time get the same verdicts, bit for bit, as one pair at a time, on every instruction set of this machine.

use crate::support::prelude::*;
use selvedge_core::batch::{
    BatchTest, Mask, Test, Tile, closest_points, culled, culled_from_rows, culled_from_tiles, largest_strays_from_rows,
};
use selvedge_core::glam::Vec3A;
use selvedge_core::separation::clearance::Clearance;

const TESTS: [(Test, CertifiedTest); 3] = [
    (Test::SweptBoxes, CertifiedTest::SweptBoxes),
    (Test::SegmentBox, CertifiedTest::SegmentBox),
    (Test::RelativeBoxes, CertifiedTest::RelativeBoxes),
];

/// Generates pairs of one kind. Some have coordinates that are NaN, infinite or huge.
fn some_pairs<S: Format>(kind: PairKind) -> impl Strategy<Value = Vec<PairCase<S>>> {
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
    (0..count).map(|k| masks[k / LANES] >> (k % LANES) & 1 == 1).collect()
}

/// Some pairs in three forms: as a list, as rows and as tiles.
struct Batch<S: Format> {
    kind: PairKind,
    pairs: Vec<PairCase<S>>,
    rows: Vec<VertexRow<S>>,
    indices: Vec<[u32; 4]>,
    tiles: Vec<Tile<S>>,
}

impl<S: Format> Batch<S> {
    fn new(kind: PairKind, pairs: &[PairCase<S>]) -> Self {
        let rows = pairs.iter().flat_map(|pair| pair.motions());
        let of_pair = |k: u32| [0, 1, 2, 3].map(|point| 4 * k + point);
        let mut tiles = vec![Tile::unknown(); pairs.len().div_ceil(LANES)];
        for (k, pair) in pairs.iter().enumerate() {
            tiles[k / LANES].set(k % LANES, pair.motions());
        }
        Self {
            kind,
            pairs: pairs.to_vec(),
            rows: rows.map(VertexRow::new).collect(),
            indices: (0..pairs.len() as u32).map(of_pair).collect(),
            tiles,
        }
    }

    /// Checks that `test` gives all of them together, on every instruction set and in every form, the verdicts of `one_by_one`.
    fn agrees(&self, test: impl BatchTest<S> + std::fmt::Debug, one_by_one: impl Fn(&PairCase<S>) -> Verdict) -> TestCaseResult {
        let count = self.pairs.len();
        let expected: Vec<_> = self.pairs.iter().map(|pair| one_by_one(pair).is_culled()).collect();
        for (name, level) in available_levels() {
            // There is one mask more than needed, which must not change.
            let untouched = vec![0xABCD; count.div_ceil(LANES) + 1];
            let [mut one_by_one, mut rows, mut tiles] = [(); 3].map(|()| untouched.clone());
            let pairs: Vec<_> = self.pairs.iter().map(PairCase::pair).collect();
            culled(level, test, &pairs, &mut one_by_one);
            culled_from_rows(level, self.kind, test, &self.rows, &self.indices, &mut rows);
            culled_from_tiles(level, self.kind, test, &self.tiles, &mut tiles);
            for (form, masks) in [("list", one_by_one), ("rows", rows), ("tiles", tiles)] {
                prop_assert_eq!(masks.last(), Some(&0xABCD), "{} {:?} {}", name, test, form);
                prop_assert_eq!(bits(&masks, count), &expected[..], "{} {:?} {}", name, test, form);
                if !count.is_multiple_of(LANES) {
                    prop_assert_eq!(masks[count / LANES] >> (count % LANES), 0, "past the last pair");
                }
            }
        }
        Ok(())
    }
}

fn verdicts_agree<S: Format>() {
    for kind in PairKind::ALL {
        proptest!(config(250), |(pairs in some_pairs::<S>(kind), scale in 0..24_i32)| {
            let batch = Batch::<S>::new(kind, &pairs);
            for (test, one_by_one) in TESTS {
                batch.agrees(test, |pair: &PairCase<S>| verdict(one_by_one, pair))?;
            }
            for filter in Tier::ALL.map(Filter::<S>::new) {
                let separated = filter.with_separation(S::exact(1, -scale)).expect("a length");
                for filter in [filter, separated] {
                    batch.agrees(filter, |pair: &PairCase<S>| filter.verdict(&pair.pair()))?;
                }
            }
        });
    }
}

formats!(verdicts_agree);

/// Negative numbers and NaN both mean that there is no stray.
fn strays_agree(kind: PairKind) {
    proptest!(config(250), |(pairs in some_pairs::<f32>(kind))| {
        let batch = Batch::<f32>::new(kind, &pairs);
        let clearances =
            [(0.0, 0.0), (0.25, 0.5), (3.0, 2.0)].map(|(distance, margin)| Clearance::new(distance, 4.0, margin));
        let classes: Vec<u8> = (0..pairs.len()).map(|k| (k % 4) as u8).collect();
        let stray = |(pair, &class): (&PairCase<f32>, &u8)| {
            let [start, end] = [0, 1].map(|end| pair.points.map(|point| Vec3A::from_array(point[end])));
            let clearance = clearances.get(usize::from(class));
            clearance.map_or(f32::NEG_INFINITY, |clearance| clearance.largest_stray(kind, start, end))
        };
        let expected: Vec<_> = pairs.iter().zip(&classes).map(stray).collect();
        for (name, level) in available_levels() {
            let mut strays = vec![7.0; pairs.len()];
            largest_strays_from_rows(level, kind, &clearances, &batch.rows, &batch.indices, &classes, &mut strays);
            for (&stray, &expected) in strays.iter().zip(&expected) {
                let are_none = !(stray >= 0.0 || expected >= 0.0);
                prop_assert!(stray == expected || are_none, "{name} {stray} {expected}");
            }
        }
    });
}

#[test]
fn how_far_pairs_may_stray() {
    PairKind::ALL.into_iter().for_each(strays_agree);
}

/// All NaNs count as the same.
fn number_bits(closest: &ClosestPoints) -> [u64; 10] {
    let [a, b, c, d] = closest.weights;
    let ([e, f, g], [h, i, j]) = (closest.offset.to_array(), closest.direction.to_array());
    [a, b, c, d, e, f, g, h, i, j].map(|number| if number.is_nan() { f64::NAN } else { number }.to_bits())
}

fn closest_points_agree(kind: PairKind) {
    proptest!(config(250), |(pairs in some_pairs::<f64>(kind))| {
        let points: Vec<_> = pairs.iter().map(|pair| pair.points.map(|point| DVec3::from_array(point[0]))).collect();
        let expected: Vec<_> = points.iter().map(|&points| number_bits(&ClosestPoints::from_points(kind, points))).collect();
        for (name, level) in available_levels() {
            let mut closest = vec![ClosestPoints::default(); points.len()];
            closest_points(level, kind, &points, &mut closest);
            let found: Vec<_> = closest.iter().map(number_bits).collect();
            prop_assert_eq!(&found, &expected, "{}", name);
        }
    });
}

#[test]
fn where_pairs_are_closest() {
    PairKind::ALL.into_iter().for_each(closest_points_agree);
}

#[test]
fn an_index_or_a_class_that_is_none_leaves_no_stray() {
    let rows = [9.0, 0.0].map(|z| VertexRow::new(([0.0, 0.0, z], [0.0, 0.0, z]).into()));
    let clearance = [Clearance::new(1.0, 9.0, 0.0)];
    for (name, level) in available_levels() {
        let mut strays = [7.0; 4];
        let indices = [[0, 1, 1, 1], [0, 1, 1, 2], [0, 1, 1, 1], [u32::MAX; 4]];
        largest_strays_from_rows(
            level,
            PairKind::VertexFace,
            &clearance,
            &rows,
            &indices,
            &[0, 0, 1, 0],
            &mut strays,
        );
        assert!(
            strays[0] > 7.99 && strays[1..].iter().all(|&stray| stray < 0.0),
            "{name} {strays:?}"
        );
    }
}

#[test]
fn an_index_that_names_no_vertex_keeps_its_pair_and_no_other() {
    // Two resting pairs are far apart, and the second names a missing vertex.
    let far = |z: f64| VertexRow::new(([0.0, 0.0, z], [0.0, 0.0, z]).into());
    let rows = [far(9.0), far(0.0)];
    for (name, level) in available_levels() {
        for (test, _) in TESTS {
            let mut masks = [0];
            let indices = [[0, 1, 1, 1], [0, 1, 1, 2]];
            culled_from_rows(level, PairKind::VertexFace, test, &rows, &indices, &mut masks);
            assert_eq!(masks, [0b01], "{name} {test:?}");
        }
    }
}
