use proptest::prelude::*;

use super::*;

/// The definition of the result.
fn overlapping_pairs(boxes: &[SweptBox]) -> Vec<[u32; 2]> {
    let separated =
        |a: &SweptBox, b: &SweptBox| (0..3).any(|axis| a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis]);
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
    (prop::array::uniform3(-20i8..20), prop::array::uniform3(0i8..4)).prop_map(|(lower, extent)| SweptBox {
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
    (prop::array::uniform3(bound()), prop::array::uniform3(bound())).prop_map(|(lower, upper)| SweptBox { lower, upper })
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

/// A square sheet of `side * side` boxes that touch their neighbours, in rows.
fn sheet(side: usize) -> Vec<SweptBox> {
    let boxes = (0..side * side).map(|index| {
        let lower = [(index % side) as f32, (index / side) as f32, 0.0];
        SweptBox {
            lower,
            upper: lower.map(|x| x + 1.0),
        }
    });
    boxes.collect()
}

#[test]
fn boxes_that_touch_overlap() {
    let boxes = [
        SweptBox {
            lower: [0.0; 3],
            upper: [1.0; 3],
        },
        SweptBox {
            lower: [1.0; 3],
            upper: [2.0; 3],
        },
    ];
    assert_eq!(step(&mut BroadPhase::new(), &boxes), [[0, 1]]);
}

#[test]
fn a_bound_that_is_not_a_number_separates_nothing() {
    let nan = SweptBox {
        lower: [f32::NAN; 3],
        upper: [f32::NAN; 3],
    };
    let mut boxes = sheet(10);
    boxes[37] = nan;
    let with_nan = step(&mut BroadPhase::new(), &boxes)
        .iter()
        .filter(|pair| pair.contains(&37))
        .count();
    assert_eq!(with_nan, 99);
}

#[test]
fn equal_boxes_are_all_paired() {
    let boxes = vec![
        SweptBox {
            lower: [1.0; 3],
            upper: [2.0; 3]
        };
        3000
    ];
    let pairs = step(&mut BroadPhase::new(), &boxes);
    assert_eq!(pairs.len(), 3000 * 2999 / 2);
    assert!(pairs.is_sorted());
}

#[test]
fn no_pairs_before_the_first_update() {
    let mut pairs = vec![[1, 2]];
    BroadPhase::new().candidate_triangle_pairs(&mut pairs);
    assert!(pairs.is_empty());
}

#[test]
fn large_meshes_give_the_same_for_any_number_of_threads() {
    let boxes = sheet(110);
    let with = |threads| with_threads(threads, || step(&mut BroadPhase::new(), &boxes));
    let one = with(1);
    assert_eq!(one.len(), 2 * 110 * 109 + 2 * 109 * 109);
    assert!(with(3) == one);
}

#[test]
fn a_motion_that_keeps_neighbours_together_never_rebuilds() {
    let mut broad_phase = BroadPhase::new();
    for time in 0..50 {
        let moved = sheet(40).into_iter().map(|swept| SweptBox {
            lower: swept.lower.map(|x| x + time as f32),
            upper: swept.upper.map(|x| x + time as f32),
        });
        step(&mut broad_phase, &moved.collect::<Vec<_>>());
    }
    assert_eq!(broad_phase.rebuilds(), 0);
}

#[test]
fn a_hierarchy_that_has_degraded_is_rebuilt_once_and_costs_as_before() {
    let ordered = sheet(40);
    // 7 has no divisor in common with 1600, so that this is a permutation, far from the identity.
    let mixed: Vec<_> = (0..ordered.len()).map(|index| ordered[index * 7 % ordered.len()]).collect();
    let fresh = {
        let mut broad_phase = BroadPhase::new();
        step(&mut broad_phase, &mixed);
        broad_phase.statistics().block_tests
    };
    let mut broad_phase = BroadPhase::new();
    step(&mut broad_phase, &ordered);
    step(&mut broad_phase, &mixed);
    assert!(broad_phase.statistics().block_tests > 2 * fresh);
    for _ in 0..20 {
        step(&mut broad_phase, &mixed);
    }
    assert_eq!(broad_phase.rebuilds(), 1);
    assert_eq!(broad_phase.statistics().block_tests, fresh);
}
