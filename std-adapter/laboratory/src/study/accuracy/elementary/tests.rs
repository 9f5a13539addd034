use super::*;
use selvedge_core::Motion;
use selvedge_core::glam::DVec3;
use std::sync::LazyLock;
use std::time::Duration;

/// The result that tests share, since it takes seconds of exact arithmetic.
static MEASURED: LazyLock<ElementaryAccuracy> = LazyLock::new(|| measured(2000, Duration::from_millis(50)));

fn measured(pairs: usize, budget: Duration) -> ElementaryAccuracy {
    let options = AccuracyOptions {
        pairs,
        repeat: 1,
        seed: 7,
        separation: 0.0,
        budget,
    };
    measure_elementary_accuracy(None, options, &mut |_| ()).unwrap()
}

#[test]
fn a_budget_cuts_pairs_but_leaves_a_time_of_some_however_short_it_is() {
    let sets = measured(100, Duration::ZERO).sets;
    for set in sets.iter().filter(|set| set.vertex_face + set.edge_edge > 0) {
        for row in &set.rows {
            assert!(
                (1..=16).contains(&row.asked) && row.nanoseconds > 0.0,
                "{}: {row:?}",
                set.name
            );
        }
    }
}

#[test]
fn certified_tests_miss_nothing_and_are_never_late_and_the_others_are_caught() {
    let sets = &MEASURED.sets;
    assert_eq!(sets.len(), 6);
    let (mut wrong, mut early) = (0, 0);
    for set in sets {
        assert!(set.with_time <= set.touching);
        for row in &set.rows {
            let name = format!("{}, {}, {}", set.name, set.scalar, row.method);
            assert!(row.asked > 0 && row.nanoseconds > 0.0, "{name}");
            // Such an answer would let a step pass through a contact.
            let is_wrong = row.missed > 0 || row.late > 0;
            assert!(!(is_wrong && row.method.is_certified()), "{name}: {row:?}");
            wrong += usize::from(is_wrong);
            if row.method == ElementaryTest::Exact {
                assert_eq!(row.false_alarms, 0, "{name}");
            }
            early += usize::from(row.early.is_some_and(|early| early > 0.0));
        }
    }
    assert!(wrong > 5 && early > 20, "{wrong} wrong, {early} early");
}

#[test]
fn a_finer_tolerance_gives_no_earlier_times() {
    for set in &MEASURED.sets {
        let of = |tolerance| {
            let method = ElementaryTest::Certified(tolerance);
            set.rows.iter().find(|row| row.method == method).unwrap()
        };
        let (coarse, fine) = (of(1e-2), of(1e-9));
        if (coarse.asked, fine.asked) == (set.vertex_face + set.edge_edge, coarse.asked) {
            assert!(fine.early <= coarse.early, "{}", set.name);
            assert!(fine.false_alarms <= coarse.false_alarms, "{}", set.name);
        }
    }
}

/// A vertex that falls from 1 to −3 reaches the plane at ¼. The triangle is below 0.2, 0.2, but not below 3, 3.
#[test]
fn exact_answers_are_right_and_enclose_the_time() {
    let fall = |x: f64, height: f64| {
        PrimitivePair::vertex_face(
            Motion::new(DVec3::new(x, x, 1.0), DVec3::new(x, x, height)),
            [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
        )
    };
    assert_eq!(exact_answer(&fall(3.0, -3.0)), ExactAnswer::Never);
    assert_eq!(exact_answer(&fall(0.2, 1e-300)), ExactAnswer::Never);
    let ExactAnswer::Touches { first: Some([from, to]) } = exact_answer(&fall(0.2, -3.0)) else {
        panic!("it touches, and passes through");
    };
    assert!((from..=to).contains(&0.25) && to - from < WIDEST);
    // It touches at the very end of the step, without passing through.
    let graze = exact_answer(&fall(0.2, 0.0));
    assert_eq!(graze, ExactAnswer::Touches { first: None });
}
