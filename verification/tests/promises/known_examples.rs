//! Well-known examples with their exact results: every certified test keeps pairs that touch, in `f32` and `f64`.

use rug::Rational;
use selvedge::PairKind::{EdgeEdge, VertexFace};
use selvedge::{CollisionDetector, Topology};
use selvedge_core::PairKind;
use selvedge_core::glam::DVec3;
use selvedge_verification::culling::CullingTest::{self, CertifiedNonCoplanarity};
use selvedge_verification::culling::{certified, verdict};
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::collides;

type Ends = [[f32; 3]; 2];

fn resting(position: [f32; 3]) -> Ends {
    [position; 2]
}

/// Corners (0, 0, 0), (1, 0, 0), (0, 1, 0).
const FLOOR: [Ends; 3] = [
    [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]],
    [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
    [[0.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
];

fn vertex_face(vertex: Ends, [a, b, c]: [Ends; 3]) -> PairCase<f32> {
    PairCase::new(PairKind::VertexFace, [vertex, a, b, c])
}

fn edge_edge([u, v]: [Ends; 2], [k, l]: [Ends; 2]) -> PairCase<f32> {
    PairCase::new(PairKind::EdgeEdge, [u, v, k, l])
}

fn culling<S: Format>(pair: &PairCase<S>) -> Vec<CullingTest> {
    let culls = |test: &CullingTest| verdict(*test, pair).is_culled();
    CullingTest::ALL.into_iter().filter(culls).collect()
}

/// Checks every order of roles and time that is the same contact, in both formats.
fn touches_first_at(pair: &PairCase<f32>, time: (i32, i32)) {
    let earliest = collides(&pair.question()).expect("a contact");
    assert_eq!(earliest.as_rational(), Some(&Rational::from(time)));
    let orders: &[[usize; 4]] = match pair.kind {
        PairKind::VertexFace => &[[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [0, 1, 3, 2]],
        PairKind::EdgeEdge => &[[0, 1, 2, 3], [2, 3, 0, 1], [1, 0, 2, 3], [0, 1, 3, 2]],
    };
    for &order in orders {
        for pair in [pair.reordered(order), pair.reordered(order).reversed()] {
            for test in certified() {
                assert!(!verdict(test, &pair).is_culled(), "{test:?} in f32: {pair:?}");
                assert!(!verdict(test, &pair.widened()).is_culled(), "{test:?} in f64: {pair:?}");
            }
        }
    }
}

/// Checks that the pair never touches, and that the certified filter culls it.
fn is_culled_by_the_filter(pair: &PairCase<f32>) {
    assert!(collides(&pair.question()).is_none());
    assert!(culling(pair).contains(&CertifiedNonCoplanarity));
    assert!(culling(&pair.widened()).contains(&CertifiedNonCoplanarity));
}

#[test]
fn a_vertex_falls_through_a_face() {
    let vertex = [[0.25, 0.25, 1.0], [0.25, 0.25, -3.0]];
    touches_first_at(&vertex_face(vertex, FLOOR), (1, 4));
}

#[test]
fn a_vertex_that_falls_and_stops_above_the_face_is_culled() {
    let vertex = [[0.25, 0.25, 1.0], [0.25, 0.25, 0.001]];
    is_culled_by_the_filter(&vertex_face(vertex, FLOOR));
}

#[test]
fn a_vertex_falls_onto_a_side_and_onto_a_corner_of_a_face() {
    for [x, y] in [[0.5, 0.5], [0.5, 0.0], [0.0, 0.0], [1.0, 0.0]] {
        let vertex = [[x, y, 1.0], [x, y, -1.0]];
        touches_first_at(&vertex_face(vertex, FLOOR), (1, 2));
    }
}

#[test]
fn two_edges_cross() {
    let first = [resting([-1.0, 0.0, 0.0]), resting([1.0, 0.0, 0.0])];
    let second = [[[0.0, -1.0, 1.0], [0.0, -1.0, -1.0]], [[0.0, 1.0, 1.0], [0.0, 1.0, -1.0]]];
    touches_first_at(&edge_edge(first, second), (1, 2));
}

#[test]
fn two_edges_that_pass_each_other_at_a_distance_are_culled() {
    let first = [resting([-1.0, 0.0, 0.0]), resting([1.0, 0.0, 0.0])];
    let second = [[[0.0, -1.0, 1.0], [0.5, -1.0, 0.25]], [[0.0, 1.0, 1.0], [0.5, 1.0, 0.25]]];
    is_culled_by_the_filter(&edge_edge(first, second));
}

#[test]
fn two_edges_meet_end_to_end() {
    let first = [resting([-1.0, 0.0, 0.0]), resting([0.0, 0.0, 0.0])];
    let second = [[[0.0, 0.0, 1.0], [0.0, 0.0, 0.0]], [[0.0, 1.0, 2.0], [0.0, 1.0, 1.0]]];
    touches_first_at(&edge_edge(first, second), (1, 1));
}

#[test]
fn a_vertex_slides_into_a_face_within_its_plane() {
    let vertex = [[-1.0, 0.25, 0.0], [1.0, 0.25, 0.0]];
    touches_first_at(&vertex_face(vertex, FLOOR), (1, 2));
}

#[test]
fn parallel_edges_slide_into_each_other_on_their_common_line() {
    let first = [resting([0.0, 0.0, 0.0]), resting([1.0, 0.0, 0.0])];
    let second = [[[3.0, 0.0, 0.0], [0.0, 0.0, 0.0]], [[5.0, 0.0, 0.0], [2.0, 0.0, 0.0]]];
    touches_first_at(&edge_edge(first, second), (2, 3));
}

#[test]
fn parallel_edges_fall_onto_each_other() {
    let first = [resting([0.0, 0.0, 0.0]), resting([2.0, 0.0, 0.0])];
    let second = [[[1.0, 0.0, 1.0], [1.0, 0.0, -1.0]], [[3.0, 0.0, 1.0], [3.0, 0.0, -1.0]]];
    touches_first_at(&edge_edge(first, second), (1, 2));
}

#[test]
fn a_vertex_leaves_the_face_that_it_touches_at_the_start() {
    let vertex = [[0.25, 0.25, 0.0], [0.25, 0.25, 1.0]];
    touches_first_at(&vertex_face(vertex, FLOOR), (0, 1));
}

#[test]
fn a_vertex_reaches_the_face_at_the_very_end() {
    let vertex = [[0.25, 0.25, 1.0], [0.25, 0.25, 0.0]];
    touches_first_at(&vertex_face(vertex, FLOOR), (1, 1));
}

#[test]
fn a_vertex_that_stops_one_subnormal_short_of_the_face_may_be_kept_and_does_not_touch() {
    let short = f32::from_bits(1);
    let vertex = [[0.25, 0.25, 1.0], [0.25, 0.25, short]];
    let pair = vertex_face(vertex, FLOOR);
    assert!(collides(&pair.question()).is_none());
    // Box tests are exact, so they cull it.
    assert!(culling(&pair).contains(&CullingTest::SweptBoxes));
}

#[test]
fn a_vertex_rests_on_the_face() {
    touches_first_at(&vertex_face(resting([0.25, 0.25, 0.0]), FLOOR), (0, 1));
}

#[test]
fn vertex_and_face_move_together_in_contact() {
    let moved = |[x, y, z]: [f32; 3]| [[x, y, z], [x + 3.0, y - 1.0, z + 0.5]];
    let [a, b, c] = FLOOR.map(|[start, _]| moved(start));
    touches_first_at(&vertex_face(moved([0.25, 0.25, 0.0]), [a, b, c]), (0, 1));
}

#[test]
fn a_vertex_falls_onto_a_face_of_no_area() {
    // The segment goes from (0, 0, 0) to (2, 0, 0).
    let segment = [0.0, 1.0, 2.0].map(|x| resting([x, 0.0, 0.0]));
    let vertex = [[0.5, 0.0, 1.0], [0.5, 0.0, -1.0]];
    touches_first_at(&vertex_face(vertex, segment), (1, 2));
}

#[test]
fn a_vertex_falls_onto_a_face_that_is_a_point() {
    let vertex = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    touches_first_at(&vertex_face(vertex, [resting([0.0; 3]); 3]), (1, 2));
}

#[test]
fn a_face_closes_upon_a_vertex_as_its_area_becomes_zero() {
    let face = [
        resting([0.0, 0.0, 0.0]),
        resting([2.0, 0.0, 0.0]),
        [[0.0, 2.0, 0.0], [0.0, 0.0, 0.0]],
    ];
    let vertex = [[1.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    touches_first_at(&vertex_face(vertex, face), (1, 1));
}

#[test]
fn an_edge_of_no_length_falls_onto_an_edge() {
    let point = [[0.5, 0.0, 1.0], [0.5, 0.0, -1.0]];
    let edge = [resting([0.0, 0.0, 0.0]), resting([1.0, 0.0, 0.0])];
    touches_first_at(&edge_edge([point; 2], edge), (1, 2));
}

#[test]
fn two_edges_of_no_length_meet() {
    let one = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let other = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
    touches_first_at(&edge_edge([one; 2], [other; 2]), (1, 2));
}

/// The face tips to and fro through the vertex: K = 8(t − ½)².
#[test]
fn a_vertex_grazes_the_face_at_a_double_root() {
    let face = [
        resting([0.0, 0.0, 0.0]),
        [[4.0, 0.0, -1.0], [4.0, 0.0, 1.0]],
        resting([0.0, 4.0, 0.0]),
    ];
    let vertex = [[0.5, 0.5, 0.0], [-0.5, 0.5, 0.0]];
    touches_first_at(&vertex_face(vertex, face), (1, 2));
}

/// All four points meet in the origin: K is a multiple of (t − ½)³.
#[test]
fn four_points_gather_in_one_at_a_triple_root() {
    let through_the_origin = |[x, y, z]: [f32; 3]| [[x, y, z], [-x, -y, -z]];
    let [p, a, b, c] = [[1.0, 2.0, 3.0], [-2.0, 1.0, 0.5], [0.25, -1.0, 4.0], [3.0, 3.0, -1.0]].map(through_the_origin);
    touches_first_at(&vertex_face(p, [a, b, c]), (1, 2));
    touches_first_at(&edge_edge([p, a], [b, c]), (1, 2));
}

/// A vertex of one triangle lies on a vertex of another, and they are different vertices. So they are a pair like any other, in
/// contact throughout.
#[test]
fn a_position_in_common_is_no_vertex_in_common() {
    let topology = Topology::new(6, vec![[0, 1, 2], [3, 4, 5]]).expect("a mesh");
    let corner = DVec3::new(0.1, 0.2, 0.3);
    let frame = [
        corner,
        corner + DVec3::X,
        corner + DVec3::Y,
        corner,
        corner - DVec3::X + DVec3::Z,
        corner - DVec3::Y + DVec3::Z,
    ];
    let mut contacts = Vec::new();
    let mut detector = CollisionDetector::<f64>::new(topology.clone());
    detector.contacts(&frame, &frame, &mut contacts).expect("finite positions");
    let has = |kind, pair| contacts.iter().any(|contact| (contact.kind, contact.pair) == (kind, pair));
    assert!(has(VertexFace, [0, 1]) && has(VertexFace, [3, 0]));
    let meet = |ends: [u32; 2]| topology.edges().iter().position(|&edge| edge == ends).expect("an edge") as u32;
    let [first, second] = [meet([0, 1]), meet([3, 4])];
    assert!(has(EdgeEdge, [first, second]) || has(EdgeEdge, [second, first]));
}
