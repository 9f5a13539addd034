//! Named hard cases with their exact answers.

use rug::Rational;
use selvedge_core::PairKind;
use selvedge_verification::oracle::{AlgebraicTime, Pair, collides, within};
use std::cmp::Ordering;
use std::f64::consts::FRAC_1_SQRT_2;

type Positions = [[f64; 3]; 4];

fn vertex_face(start: Positions, end: Positions) -> Pair {
    Pair {
        kind: PairKind::VertexFace,
        start,
        end,
    }
}

fn edge_edge(start: Positions, end: Positions) -> Pair {
    Pair {
        kind: PairKind::EdgeEdge,
        start,
        end,
    }
}

#[track_caller]
fn contact_at(pair: &Pair, numerator: i32, denominator: i32) {
    let time = collides(pair).expect("a contact");
    assert_eq!(time.as_rational(), Some(&Rational::from((numerator, denominator))));
    assert!(within(pair, 0.0), "at distance zero");
}

#[track_caller]
fn no_contact(pair: &Pair) {
    assert_eq!(collides(pair), None);
    assert!(!within(pair, 0.0), "not at distance zero");
}

const FACE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];

/// A vertex that moves over a face at rest.
fn over_face(start: [f64; 3], end: [f64; 3]) -> Pair {
    let with = |vertex| [vertex, FACE[0], FACE[1], FACE[2]];
    vertex_face(with(start), with(end))
}

#[test]
fn vertex_through_a_face() {
    contact_at(&over_face([1.0, 1.0, 1.0], [1.0, 1.0, -2.0]), 1, 3);
}

#[test]
fn vertex_reaches_the_face_at_the_end_of_the_step() {
    contact_at(&over_face([1.0, 1.0, 1.0], [1.0, 1.0, 0.0]), 1, 1);
    no_contact(&over_face([1.0, 1.0, 1.0], [1.0, 1.0, 5e-324]));
}

#[test]
fn vertex_leaves_the_face_at_the_start_of_the_step() {
    contact_at(&over_face([1.0, 1.0, 0.0], [1.0, 1.0, 1.0]), 0, 1);
    no_contact(&over_face([1.0, 1.0, 5e-324], [1.0, 1.0, 1.0]));
}

#[test]
fn vertex_through_an_edge_of_the_face_and_one_ulp_beside_it() {
    contact_at(&over_face([1.0, 0.0, 1.0], [1.0, 0.0, -1.0]), 1, 2);
    no_contact(&over_face([1.0, -5e-324, 1.0], [1.0, -5e-324, -1.0]));
}

#[test]
fn vertex_through_a_corner_of_the_face_and_one_ulp_beside_it() {
    contact_at(&over_face([3.0, 0.0, 1.0], [3.0, 0.0, -1.0]), 1, 2);
    let beside = 3.0_f64.next_up();
    no_contact(&over_face([beside, 0.0, 1.0], [beside, 0.0, -1.0]));
}

#[test]
fn vertex_at_rest_on_a_face_at_rest() {
    contact_at(&over_face([1.0, 1.0, 0.0], [1.0, 1.0, 0.0]), 0, 1);
    no_contact(&over_face([1.0, 1.0, 1.0], [1.0, 1.0, 1.0]));
}

#[test]
fn vertex_slides_into_a_face_in_its_plane() {
    contact_at(&over_face([-1.0, 1.0, 0.0], [3.0, 1.0, 0.0]), 1, 4);
}

#[test]
fn vertex_passes_a_face_in_its_plane() {
    no_contact(&over_face([-1.0, 1.0, 0.0], [1.0, -1.0 - 1e-15, 0.0]));
    contact_at(&over_face([-1.0, 1.0, 0.0], [1.0, -1.0, 0.0]), 1, 2);
}

#[test]
fn vertex_meets_a_face_without_area() {
    // The face is the segment from (0, 0, 0) to (2, 0, 0), then a point.
    let segment = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let meet = |face: [[f64; 3]; 3], from, to| {
        let with = |vertex| [vertex, face[0], face[1], face[2]];
        vertex_face(with(from), with(to))
    };
    contact_at(&meet(segment, [0.5, 0.0, 1.0], [0.5, 0.0, -3.0]), 1, 4);
    no_contact(&meet(segment, [2.5, 0.0, 1.0], [2.5, 0.0, -3.0]));
    no_contact(&meet(segment, [0.5, 5e-324, 1.0], [0.5, 5e-324, -3.0]));
    contact_at(&meet([[0.0; 3]; 3], [0.0, 0.0, 1.0], [0.0, 0.0, -3.0]), 1, 4);
    no_contact(&meet([[0.0; 3]; 3], [0.0, 5e-324, 1.0], [0.0, 5e-324, -3.0]));
}

#[test]
fn face_collapses_onto_the_vertex_in_one_instant() {
    let opened = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let turned = opened.map(|p| p.map(|x: f64| -x));
    let with = |face: [[f64; 3]; 3]| [[0.0; 3], face[0], face[1], face[2]];
    // The volume is (1 − 2t)³: a triple root.
    contact_at(&vertex_face(with(opened), with(turned)), 1, 2);
    // The face stops just before the vertex.
    let almost = opened.map(|p| p.map(|x: f64| x * 5e-324));
    no_contact(&vertex_face(with(opened), with(almost)));
}

/// Two crossing edges, the second at height z.
fn crossed(z_start: f64, z_end: f64) -> Pair {
    let at = |z| [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, z], [0.0, 1.0, z]];
    edge_edge(at(z_start), at(z_end))
}

#[test]
fn edge_through_an_edge() {
    contact_at(&crossed(1.0, -2.0), 1, 3);
    contact_at(&crossed(0.0, 1.0), 0, 1);
    contact_at(&crossed(-1.0, 0.0), 1, 1);
    no_contact(&crossed(1.0, 5e-324));
}

#[test]
fn edges_that_graze_in_a_double_root() {
    // The second edge turns about the x axis while it slides along y. With s = 1 − 2t it passes the first at height s² + gap.
    let at = |s: f64, gap: f64| {
        [
            [-1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, -1.0 - s, gap - s],
            [0.0, 1.0 - s, gap + s],
        ]
    };
    contact_at(&edge_edge(at(1.0, 0.0), at(-1.0, 0.0)), 1, 2);
    no_contact(&edge_edge(at(1.0, 1e-15), at(-1.0, 1e-15)));
    // A little lower it passes through, twice: s² = 1/4.
    contact_at(&edge_edge(at(1.0, -0.25), at(-1.0, -0.25)), 1, 4);
}

#[test]
fn parallel_edges_slide_into_touch() {
    let at = |x: f64, y: f64| [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [x, y, 0.0], [x + 1.0, y, 0.0]];
    contact_at(&edge_edge(at(3.0, 0.0), at(0.0, 0.0)), 2, 3);
    contact_at(&edge_edge(at(0.5, 2.0), at(0.5, -2.0)), 1, 2);
    contact_at(&edge_edge(at(2.0, 0.0), at(1.0, 0.0)), 1, 1);
    no_contact(&edge_edge(at(2.0, 0.0), at(1.0 + 1e-15, 0.0)));
    no_contact(&edge_edge(at(2.0, 1.0), at(1.5, -1.0)));
}

#[test]
fn edges_of_no_length() {
    let at = |point: [f64; 3]| [[0.0; 3], [2.0, 0.0, 0.0], point, point];
    contact_at(&edge_edge(at([1.0, 1.0, 0.0]), at([1.0, -3.0, 0.0])), 1, 4);
    no_contact(&edge_edge(at([3.0, 1.0, 0.0]), at([3.0, -3.0, 0.0])));
    let points = |x: f64| [[0.0; 3], [0.0; 3], [x, x, x], [x, x, x]];
    contact_at(&edge_edge(points(1.0), points(-2.0)), 1, 3);
    no_contact(&edge_edge(points(1.0), points(5e-324)));
}

#[test]
fn huge_and_tiny_coordinates_in_one_pair() {
    let at = |z| [[0.0, 0.0, z], [-1e308, -1e308, 0.0], [1e308, -1e308, 0.0], [0.0, 1e308, 0.0]];
    contact_at(&vertex_face(at(5e-324), at(-5e-324)), 1, 2);
    no_contact(&vertex_face(at(5e-324), at(1e308)));
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
fn times_next_to_one_another_at_the_end_of_the_step_are_told_apart() {
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
    // A vertex that passes at height 1 over the interior, over an edge, and over a corner.
    assert!(within(&over_face([-9.0, 1.0, 1.0], [9.0, 1.0, 1.0]), 1.0));
    assert!(!within(&over_face([-9.0, 1.0, 1.0], [9.0, 1.0, 1.0]), 1.0_f64.next_down()));
    assert!(within(&over_face([-9.0, -3.0, 4.0], [9.0, -3.0, 4.0]), 5.0));
    assert!(!within(&over_face([-9.0, -3.0, 4.0], [9.0, -3.0, 4.0]), 5.0_f64.next_down()));
    assert!(within(
        &over_face([-1.0, -2.0, -9.0], [-1.0, -2.0, 9.0]),
        5.0_f64.sqrt().next_up()
    ));
    assert!(!within(
        &over_face([-1.0, -2.0, -9.0], [-1.0, -2.0, 9.0]),
        5.0_f64.sqrt().next_down()
    ));
    // Edges that cross at distance 1, and parallel ones.
    assert!(within(&crossed(1.0, 1.0), 1.0));
    assert!(!within(&crossed(1.0, 1.0), 1.0_f64.next_down()));
    let parallel = |y: f64| [[0.0; 3], [1.0, 0.0, 0.0], [0.5, y, 0.0], [2.0, y, 0.0]];
    assert!(within(&edge_edge(parallel(3.0), parallel(1.0)), 1.0));
    assert!(!within(&edge_edge(parallel(3.0), parallel(1.0)), 1.0_f64.next_down()));
}
