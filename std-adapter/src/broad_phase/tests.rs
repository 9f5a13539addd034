use proptest::prelude::*;

use super::*;

/// The definition of the result.
fn overlapping_pairs(boxes: &[SweptBox]) -> Vec<[u32; 2]> {
    let separated = |a: &SweptBox, b: &SweptBox| {
        (0..3).any(|axis| a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis])
    };
    let mut pairs = Vec::new();
    for (i, a) in boxes.iter().enumerate() {
        for (j, b) in boxes.iter().enumerate().skip(i + 1) {
            if !separated(a, b) {
                pairs.push([i as u32, j as u32]);
            }
        }
    }
    pairs
}

fn step(broad_phase: &mut BroadPhase, boxes: &[SweptBox]) -> Vec<[u32; 2]> {
    let mut pairs = vec![[7, 7]; 3];
    broad_phase.update(boxes);
    broad_phase.candidate_triangle_pairs(&mut pairs);
    pairs
}

fn with_threads<T: Send>(threads: usize, action: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap()
        .install(action)
}

/// Boxes on a coarse grid, so that many are equal, touch, or have no extent along an axis.
fn grid_box() -> impl Strategy<Value = SweptBox> {
    (
        prop::array::uniform3(-20i8..20),
        prop::array::uniform3(0i8..4),
    )
        .prop_map(|(lower, extent)| SweptBox {
            lower: lower.map(f32::from),
            upper: std::array::from_fn(|axis| f32::from(lower[axis] + extent[axis])),
        })
}

/// Any bounds at all, in any order.
fn lawless_box() -> impl Strategy<Value = SweptBox> {
    let bound = || {
        prop_oneof![
            any::<f32>(),
            Just(f32::NAN),
            Just(f32::INFINITY),
            Just(f32::NEG_INFINITY),
            Just(f32::MAX),
            Just(f32::MIN),
            Just(0.0),
            Just(-0.0),
            -2.0f32..2.0,
        ]
    };
    (
        prop::array::uniform3(bound()),
        prop::array::uniform3(bound()),
    )
        .prop_map(|(lower, upper)| SweptBox { lower, upper })
}

fn boxes(count: usize) -> impl Strategy<Value = Vec<SweptBox>> {
    prop_oneof![
        prop::collection::vec(grid_box(), 0..count),
        prop::collection::vec(prop_oneof![20 => grid_box(), 1 => lawless_box()], 0..count),
        prop::collection::vec(lawless_box(), 0..count.min(300)),
        (grid_box(), 0..count.min(300)).prop_map(|(swept, count)| vec![swept; count]),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn finds_the_overlapping_pairs_in_order(boxes in boxes(1200)) {
        prop_assert_eq!(step(&mut BroadPhase::new(), &boxes), overlapping_pairs(&boxes));
    }

    #[test]
    fn finds_them_after_any_earlier_steps(steps in prop::collection::vec(boxes(400), 1..6)) {
        let mut broad_phase = BroadPhase::new();
        for boxes in &steps {
            prop_assert_eq!(step(&mut broad_phase, boxes), overlapping_pairs(boxes));
        }
    }

    #[test]
    fn finds_them_after_a_refit(
        (before, after) in (1usize..600).prop_flat_map(|count| {
            let boxes = || prop::collection::vec(prop_oneof![20 => grid_box(), 1 => lawless_box()], count);
            (boxes(), boxes())
        })
    ) {
        let mut broad_phase = BroadPhase::new();
        broad_phase.update(&before);
        prop_assert_eq!(step(&mut broad_phase, &after), overlapping_pairs(&after));
        prop_assert_eq!(broad_phase.rebuilds(), 0);
    }

    #[test]
    fn gives_the_same_for_any_number_of_threads(boxes in boxes(1200)) {
        let with = |threads| with_threads(threads, || step(&mut BroadPhase::new(), &boxes));
        let one = with(1);
        prop_assert_eq!(&with(2), &one);
        prop_assert_eq!(&with(5), &one);
    }
}
