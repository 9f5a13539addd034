//! The generator of the tests' inputs is exact as promised, and varied.

use crate::support::prelude::*;
use selvedge_verification::culling::CertifiedTest::CertifiedNonCoplanarity;
use selvedge_verification::oracle::touches_at;
use selvedge_verification::random::Random;

fn touches_when_it_says<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    prop_assert!(touches_at(&moment.pair().question(), &moment.time()));
    Ok(())
}

formats!(a_touching_pair_touches_at_its_time is touches_when_it_says(4000, touching_pairs()));

fn is_coplanar<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    let pair = moment.pair().question();
    prop_assert!(are_ever_coplanar(&pair.start, &pair.end));
    Ok(())
}

formats!(a_coplanar_pair_is_coplanar is is_coplanar(4000, coplanar_pairs()));

#[test]
fn any_bytes_make_a_pair_of_finite_coordinates() {
    let bytes = prop::collection::vec(any::<u8>(), 0..700);
    proptest!(config(256), |(bytes in bytes)| {
        for kind in PairKind::ALL {
            prop_assert!(PairCase::<f32>::from_bytes(kind, &bytes).is_finite());
            prop_assert!(PairCase::<f64>::from_bytes(kind, &bytes).is_finite());
        }
        prop_assert!(!MeshCase::<f64>::from_bytes(&bytes).triangles.is_empty());
    });
}

/// Returns the share of `cases` pairs of either kind that `of` selects, in thousandths.
fn share<S: Format>(cases: u32, of: impl Fn(&PairCase<S>) -> bool) -> u32 {
    let (all, found) = (Cell::new(0), Cell::new(0));
    check(cases, pairs_of_any_kind::<S>(), |pair| {
        all.set(all.get() + 1);
        found.set(found.get() + u32::from(of(pair)));
        Ok(())
    });
    1000 * found.get() / all.get()
}

fn pairs_are_culled_coplanar_and_colliding_often_enough<S: Format>() {
    assert!(share::<S>(3000, |pair| verdict(CertifiedNonCoplanarity, pair).is_culled()) > 30);
    assert!(share::<S>(3000, |pair| collides(&pair.question()).is_some()) > 200);
}

formats!(pairs_are_culled_coplanar_and_colliding_often_enough);

#[test]
fn meshes_are_degenerate_non_manifold_and_incomplete_often_enough() {
    let counts = Cell::new([0; 4]);
    check(1000, meshes::<f64>(), |mesh| {
        let statistics = mesh.topology().statistics();
        let found = [
            statistics.degenerate_triangles,
            statistics.duplicate_triangles,
            statistics.non_manifold_edges,
            statistics.isolated_vertices,
        ];
        let mut sums = counts.get();
        for (sum, found) in sums.iter_mut().zip(found) {
            *sum += u32::from(found > 0);
        }
        counts.set(sums);
        Ok(())
    });
    assert!(counts.get().into_iter().all(|count| count > 50), "{counts:?}");
}

/// Follows every successful attempt to simplify, as proptest does.
fn simplest<T: Simplify>(mut case: T, fails: impl Fn(&T) -> bool) -> T {
    'again: loop {
        for attempt in 0..case.attempts() {
            if let Some(simpler) = case.simpler(attempt).filter(&fails) {
                case = simpler;
                continue 'again;
            }
        }
        return case;
    }
}

#[test]
fn shrinking_ends_in_a_pair_of_small_numbers() {
    let culled = |pair: &PairCase<f64>| verdict(CertifiedNonCoplanarity, pair).is_culled();
    let mut culled_pairs = 0;
    let mut random = Random(1);
    for _ in 0..2000 {
        let bytes: [u8; Choices::ENOUGH] = random.bytes();
        let pair = PairCase::from_bytes(PairKind::EdgeEdge, &bytes);
        if culled(&pair) {
            culled_pairs += 1;
            let simplest = simplest(pair, culled);
            let small = |x: f64| x == x.round() && x.abs() <= 4.0;
            let count = simplest.coordinates().filter(|&x| small(x)).count();
            assert!(count >= 20, "{simplest:?}");
        }
    }
    assert!(culled_pairs > 20, "{culled_pairs} are too few to tell");
}

#[test]
fn shrinking_a_meeting_keeps_it() {
    let strategy = from_choices(|choices| MeetingPair::<f32>::choose(PairKind::VertexFace, Meeting::Touching, choices));
    check(300, strategy, |moment| {
        for attempt in 0..moment.attempts() {
            if let Some(simpler) = moment.simpler(attempt) {
                prop_assert!(touches_at(&simpler.pair().question(), &simpler.time()));
            }
        }
        Ok(())
    });
}

#[test]
fn a_case_prints_as_the_rust_that_makes_it() {
    let points = [
        [[0.1, 0.0, -0.0], [5e-324, 1.0, f64::INFINITY]],
        [[0.0; 3], [0.0; 3]],
        [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
        [[0.0, 1.0, 0.0], [0.0, 1e300, f64::NAN]],
    ];
    let text = format!("{:?}", PairCase::new(PairKind::VertexFace, points));
    assert_eq!(
        text,
        "PrimitivePair::<f64>::vertex_face(
    Motion::from(([0.1, 0.0, -0.0], [5e-324, 1.0, f64::INFINITY])),
    [
        Motion::from(([0.0, 0.0, 0.0], [0.0, 0.0, 0.0])),
        Motion::from(([1.0, 0.0, 0.0], [1.0, 0.0, 0.0])),
        Motion::from(([0.0, 1.0, 0.0], [0.0, 1e300, f64::NAN])),
    ],
)"
    );
}
