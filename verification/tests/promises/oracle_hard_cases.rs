//! Named hard cases with their exact answers.

use crate::support::prelude::*;
use selvedge_verification::conformance::Case;
use selvedge_verification::oracle::AlgebraicTime;
use std::cmp::Ordering;
use std::f64::consts::FRAC_1_SQRT_2;

type Positions = [[f64; 3]; 4];

fn vertex_face(start: Positions, end: Positions) -> Pair {
    Pair::new(PairKind::VertexFace, start, end)
}

fn edge_edge(start: Positions, end: Positions) -> Pair {
    Pair::new(PairKind::EdgeEdge, start, end)
}

const FACE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];

/// A vertex that moves from one place to another, and a face at rest.
fn over([a, b, c]: [[f64; 3]; 3], [start, end]: [[f64; 3]; 2]) -> Pair {
    vertex_face([start, a, b, c], [end, a, b, c])
}

fn over_face(start: [f64; 3], end: [f64; 3]) -> Pair {
    over(FACE, [start, end])
}

/// Two crossing edges, the second at height z.
fn crossed(z_start: f64, z_end: f64) -> Pair {
    let at = |z| [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, z], [0.0, 1.0, z]];
    edge_edge(at(z_start), at(z_end))
}

/// Two edges along x, the second from one place to another.
fn parallel(start: [f64; 2], end: [f64; 2]) -> Pair {
    let at = |[x, y]: [f64; 2]| [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [x, y, 0.0], [x + 1.0, y, 0.0]];
    edge_edge(at(start), at(end))
}

/// A face that shrinks to its corners times `factor`, around a vertex at rest. For −1 the volume is (1 − 2t)³: a triple root.
fn collapsing(factor: f64) -> Pair {
    let with = |x: f64| [[0.0; 3], [x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x]];
    vertex_face(with(1.0), with(factor))
}

fn huge_face(z_start: f64, z_end: f64) -> Pair {
    let at = |z| [[0.0, 0.0, z], [-1e308, -1e308, 0.0], [1e308, -1e308, 0.0], [0.0, 1e308, 0.0]];
    vertex_face(at(z_start), at(z_end))
}

/// The smallest number.
const TINY: f64 = 5e-324;

#[test]
fn one_unit_in_the_last_place_decides() {
    let beside = |x: f64, y: f64| over_face([x, y, 1.0], [x, y, -1.0]);
    for (pair, time) in [
        (over_face([1.0, 1.0, 1.0], [1.0, 1.0, TINY]), None),
        (over_face([1.0, 1.0, TINY], [1.0, 1.0, 1.0]), None),
        (beside(1.0, 0.0), Some((1, 2))),
        (beside(1.0, -TINY), None),
        (beside(3.0, 0.0), Some((1, 2))),
        (beside(3.0_f64.next_up(), 0.0), None),
        (over_face([-1.0, 1.0, 0.0], [1.0, -1.0, 0.0]), Some((1, 2))),
        (over_face([-1.0, 1.0, 0.0], [1.0, -1.0 - 1e-15, 0.0]), None),
        (collapsing(-1.0), Some((1, 2))),
        (collapsing(TINY), None),
        (crossed(1.0, -2.0), Some((1, 3))),
        (crossed(1.0, TINY), None),
        (parallel([2.0, 0.0], [1.0, 0.0]), Some((1, 1))),
        (parallel([2.0, 0.0], [1.0 + 1e-15, 0.0]), None),
        (huge_face(TINY, -TINY), Some((1, 2))),
        (huge_face(TINY, 1e308), None),
    ] {
        let found = collides(&pair).map(|time| time.as_rational().cloned());
        assert_eq!(found, time.map(|time| Some(Rational::from(time))), "{pair:?}");
        assert_eq!(within(&pair, 0.0), time.is_some(), "{pair:?} at distance zero");
    }
}

/// The suite's exact answers are confirmed by a second program that shares no code with the oracle.
#[test]
fn pairs_of_the_conformance_suite_have_their_exact_times() {
    let mut exact = 0;
    for case in Case::read_all().expect("the suite's files") {
        let [pair] = case.questions()[..] else { continue };
        let Some(touches) = case.touches else { continue };
        let found = collides(&pair);
        assert_eq!((found.is_some(), within(&pair, 0.0)), (touches, touches), "{}", case.id);
        if let Some(time) = case.exact {
            let time: Rational = time.parse().expect("a quotient");
            assert_eq!(found.expect("a contact").as_rational(), Some(&time), "{}", case.id);
            exact += 1;
        } else if let (Some(found), Some([from, to])) = (found, case.first) {
            assert!(found.cmp_f64(from.0).is_ge() && found.cmp_f64(to.0).is_le(), "{}", case.id);
        }
    }
    assert!(exact > 200, "{exact} exact times");
}

/// A contact at t = 1/√2: the vertex (t, 1/2) meets the edge from (0, 0) to (1, t).
fn irrational() -> Pair {
    let at = |t: f64| [[t, 0.5, 0.0], [0.0; 3], [1.0, t, 0.0], [1.0, t, 0.0]];
    vertex_face(at(0.0), at(1.0))
}

#[test]
fn irrational_times_are_known_to_any_precision() {
    let mut time = collides(&irrational()).expect("a contact");
    assert_eq!(time.as_rational(), None);
    // 1/√2 rounds to the constant, and the true value is above it or below.
    let rounded = Rational::from_f64(FRAC_1_SQRT_2).expect("finite");
    let below = Rational::from(rounded.square_ref()) < Rational::from((1, 2));
    let expected = if below { FRAC_1_SQRT_2 } else { FRAC_1_SQRT_2.next_down() };
    assert_eq!(time.to_f64_down(), expected);
    assert_eq!(time.cmp_f64(expected), Ordering::Greater);
    assert_eq!(time.cmp_f64(expected.next_up()), Ordering::Less);
    assert_eq!(time.cmp_f64(f64::INFINITY), Ordering::Less);
    time.refine(1000);
    let [low, high] = time.interval();
    assert!(Rational::from(&high - &low) <= Rational::from(1) >> 1000);
    assert!(low.square() < Rational::from((1, 2)) && high.square() > Rational::from((1, 2)));
}

#[test]
fn times_have_the_order_of_their_numbers() {
    let root = collides(&irrational()).expect("a contact");
    let half = AlgebraicTime::rational(Rational::from((1, 2)));
    let three_quarters = AlgebraicTime::rational(Rational::from((3, 4)));
    let mut sorted = vec![three_quarters.clone(), root.clone(), half.clone()];
    sorted.sort();
    assert_eq!(sorted, [half, root, three_quarters]);
}

/// Two edges are in one plane, and one comes down from the largest number. The times that are compared are next to each other at
/// the end of the step. The search must not add the bits of one by one while those of the other double.
#[test]
fn neighbouring_times_at_the_end_of_the_step_are_distinguished() {
    let (x, y, z) = (-9_007_199_254_740_967.0, 4_503_599_627_370_484.0, -9_007_199_254_740_967.0);
    let pair = edge_edge(
        [[x, y, z + 8.0], [x, y, z - 8.0], [x, y + 8.0, f64::MAX], [x, y - 8.0, z]],
        [
            [x, y - 24.0, z + 8.0],
            [x, y - 8.0, z - 8.0],
            [x, y + 16.0, z],
            [x, y - 24.0, z],
        ],
    );
    let time = collides(&pair).expect("the second edge ends upright, in the middle of the first");
    assert_eq!(time.to_f64_down(), 1.0_f64.next_down());
    assert_eq!(time.cmp_f64(1.0), Ordering::Less);
}

#[test]
fn a_time_below_the_normal_numbers_is_rounded_down() {
    // The vertex falls from a height of 1e-20 by 1e300 in the step.
    let fall = over_face([1.0, 1.0, 1e-20], [1.0, 1.0, -1e300]);
    let time = collides(&fall).expect("a contact");
    let t = time.to_f64_down();
    assert!(t > 0.0 && t < f64::MIN_POSITIVE);
    assert_eq!(time.cmp_f64(t), Ordering::Greater);
    assert_eq!(time.cmp_f64(t.next_up()), Ordering::Less);
}

#[test]
fn separation_is_closed() {
    for (pair, [within_it, beyond]) in [
        // A vertex that passes at height 1 over the interior, over an edge, and over a corner.
        (over_face([-9.0, 1.0, 1.0], [9.0, 1.0, 1.0]), [1.0, 1.0_f64.next_down()]),
        (over_face([-9.0, -3.0, 4.0], [9.0, -3.0, 4.0]), [5.0, 5.0_f64.next_down()]),
        (
            over_face([-1.0, -2.0, -9.0], [-1.0, -2.0, 9.0]),
            [5.0_f64.sqrt().next_up(), 5.0_f64.sqrt().next_down()],
        ),
        // Edges that cross at distance 1, and parallel ones.
        (crossed(1.0, 1.0), [1.0, 1.0_f64.next_down()]),
        (parallel([0.5, 3.0], [0.5, 1.0]), [1.0, 1.0_f64.next_down()]),
    ] {
        assert!(within(&pair, within_it) && !within(&pair, beyond), "{pair:?}");
    }
}
