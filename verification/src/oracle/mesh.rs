//! Intersections of the triangles of a mesh at rest.
//!
//! [Signs of volumes](super::signs) decide nearly all pairs of a mesh in general position. Integers of any length decide the
//! rest.

use super::geometry::{
    AtRest, EDGES, Point, Signs, cross, dot, is_zero, normal, point_on_segment, segment_meets_triangle, subtract,
};
use super::motion::scale_to_integers;
use super::signs::triangles_intersect_by_signs;
use rug::Integer;
use std::cmp::Ordering;

type IntegerPoint = Point<Integer>;

/// Returns whether two triangles have a point in common, apart from the simplex that they share in the mesh.
///
/// `shared` names the vertices that both triangles have, as pairs of a corner of `a` and a corner of `b` (each 0, 1 or 2), which
/// must have equal positions. Their hull, a vertex or an edge, is no intersection; any other common point is. So two triangles
/// that are folded onto each other over their common edge intersect. Triangles that share all three vertices are one triangle
/// twice, and do not intersect. Vertices that merely have equal positions are not shared. A triangle of no area counts as a
/// segment or a point.
///
/// ```
/// use selvedge_verification::oracle::triangles_intersect;
/// let a = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// let b = [[0.0, 0.0, 0.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0]];
/// assert!(triangles_intersect(&a, &b, &[]));
/// assert!(!triangles_intersect(&a, &b, &[[0, 0]]));
/// ```
///
/// # Panics
/// Panics if a coordinate is NaN or infinite, or shared corners differ in position.
pub fn triangles_intersect(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], shared: &[[usize; 2]]) -> bool {
    for &[i, j] in shared {
        assert!(a[i] == b[j], "corner {i} of a and corner {j} of b are not the same vertex");
    }
    let points = scale_to_integers(&[*a, *b].concat());
    let [a0, a1, a2, b0, b1, b2] = points.as_slice() else {
        unreachable!("six points")
    };
    intersect([a0, a1, a2], [b0, b1, b2], shared)
}

/// Returns the pairs of triangles that intersect, in the sense of [`triangles_intersect`]; vertices are shared by index. The
/// smaller index comes first, and pairs are in ascending order.
///
/// # Panics
/// Panics if a coordinate is NaN or infinite, or an index is out of range.
pub fn mesh_self_intersections(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    mesh_intersections(positions, triangles, triangles.len())
}

/// Returns those pairs of [`mesh_self_intersections`] that have at least one triangle among the first `count`.
///
/// # Panics
/// Panics if a coordinate is NaN or infinite, or an index is out of range.
pub fn mesh_intersections(positions: &[[f64; 3]], triangles: &[[u32; 3]], count: usize) -> Vec<[u32; 2]> {
    assert!(positions.iter().flatten().all(|x| x.is_finite()), "positions are numbers");
    let mut found = overlapping_boxes(positions, triangles);
    found.retain(|&[i, j]| {
        if i as usize >= count {
            return false;
        }
        let pair = [i, j].map(|triangle| triangles[triangle as usize]);
        let [a, b] = pair.map(|corners| corners.map(|vertex| positions[vertex as usize]));
        let shared = shared_corners(pair);
        triangles_intersect_by_signs(&a, &b, &shared).unwrap_or_else(|| triangles_intersect(&a, &b, &shared))
    });
    found.sort_unstable();
    found
}

/// Returns the corners with the same vertex index, each vertex once.
fn shared_corners([a, b]: [[u32; 3]; 2]) -> Vec<[usize; 2]> {
    let mut shared = Vec::new();
    for (i, vertex) in a.iter().enumerate() {
        if a[..i].contains(vertex) {
            continue;
        }
        if let Some(j) = b.iter().position(|other| other == vertex) {
            shared.push([i, j]);
        }
    }
    shared
}

/// Returns pairs of triangles whose closed boxes overlap, by a sweep along the mesh's longest side.
fn overlapping_boxes(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let range = |points: &mut dyn Iterator<Item = f64>| {
        points.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    };
    let boxes: Vec<[[f64; 2]; 3]> = triangles
        .iter()
        .map(|corners| [0, 1, 2].map(|axis| range(&mut corners.iter().map(|&v| positions[v as usize][axis]))))
        .collect();
    let extent = |axis: usize| {
        let [low, high] = range(&mut positions.iter().map(|p| p[axis]));
        high - low
    };
    let sweep = (0..3).max_by(|&i, &j| extent(i).total_cmp(&extent(j))).expect("three axes");

    let index = |i: usize| u32::try_from(i).expect("a mesh has fewer than 2^32 triangles");
    let mut order: Vec<_> = (0..).map(index).zip(boxes).collect();
    order.sort_by(|(_, a), (_, b)| a[sweep][0].total_cmp(&b[sweep][0]));
    let mut pairs = Vec::new();
    for (place, (i, one)) in order.iter().enumerate() {
        let following = order[place + 1..].iter();
        for (j, other) in following.take_while(|(_, other)| other[sweep][0] <= one[sweep][1]) {
            let overlap = one.iter().zip(other).all(|(a, b)| a[0] <= b[1] && b[0] <= a[1]);
            if overlap {
                pairs.push([*i.min(j), *i.max(j)]);
            }
        }
    }
    pairs
}

fn intersect(a: [&IntegerPoint; 3], b: [&IntegerPoint; 3], shared: &[[usize; 2]]) -> bool {
    match shared {
        [] => triangles_meet(a, b),
        &[[i, j]] => meet_beyond_a_vertex(a[i], [a[(i + 1) % 3], a[(i + 2) % 3]], [b[(j + 1) % 3], b[(j + 2) % 3]]),
        &[[i, k], [j, l]] => meet_beyond_an_edge([a[i], a[j]], a[3 - i - j], b[3 - k - l]),
        _ => false,
    }
}

/// Two triangles meet if and only if an edge of one meets the other.
fn triangles_meet(a: [&IntegerPoint; 3], b: [&IntegerPoint; 3]) -> bool {
    if on_one_side(a, b) || on_one_side(b, a) {
        return false;
    }
    EDGES.iter().any(|&[i, j]| {
        segment_meets_triangle(&mut AtRest, [a[i], a[j]], b) || segment_meets_triangle(&mut AtRest, [b[i], b[j]], a)
    })
}

/// Returns whether all `points` are strictly on one side of the triangle's plane.
fn on_one_side<const N: usize>(points: [&IntegerPoint; N], triangle: [&IntegerPoint; 3]) -> bool {
    let [a, b, c] = triangle;
    let normal = normal(a, b, c);
    let side = points.map(|point| dot(&normal, &subtract(point, a)).cmp0());
    side[0].is_ne() && side.iter().all(|&s| s == side[0])
}

/// Returns whether the triangles apex, a0, a1 and apex, b0, b1 share more than the apex.
///
/// The common part is convex. A ray from the apex through another common point leaves one of the two triangles first. There it
/// meets a common point on the edge opposite to the apex. So one of these edges meets the other triangle outside the apex.
fn meet_beyond_a_vertex(apex: &IntegerPoint, a: [&IntegerPoint; 2], b: [&IntegerPoint; 2]) -> bool {
    edge_meets_beyond(apex, a, b) || edge_meets_beyond(apex, b, a)
}

/// Returns whether the segment `edge` meets the triangle apex, opposite outside the apex.
fn edge_meets_beyond(apex: &IntegerPoint, edge: [&IntegerPoint; 2], opposite: [&IntegerPoint; 2]) -> bool {
    if on_one_side(edge, [apex, opposite[0], opposite[1]]) {
        return false;
    }
    if point_on_segment(&mut AtRest, apex, edge) {
        // Each half of the edge begins in the apex and must lead into the triangle.
        let cone = opposite.map(|end| subtract(end, apex));
        return edge.iter().any(|end| points_into(&subtract(end, apex), &cone));
    }
    segment_meets_triangle(&mut AtRest, edge, [apex, opposite[0], opposite[1]])
}

/// Returns whether the direction, not zero, is a combination of the two others with nonnegative factors.
fn points_into(direction: &IntegerPoint, cone: &[IntegerPoint; 2]) -> bool {
    let signs = &mut AtRest;
    if is_zero(signs, direction) {
        return false;
    }
    let normal = cross(&cone[0], &cone[1]);
    if is_zero(signs, &normal) {
        return cone
            .iter()
            .any(|side| is_zero(signs, &cross(side, direction)) && dot(side, direction).is_positive());
    }
    signs.sign(&dot(&normal, direction)).is_eq()
        && signs.sign(&dot(&normal, &cross(direction, &cone[1]))).is_ge()
        && signs.sign(&dot(&normal, &cross(&cone[0], direction))).is_ge()
}

/// Returns whether the triangles p, q, a and p, q, b share more than the edge p q.
fn meet_beyond_an_edge([p, q]: [&IntegerPoint; 2], a: &IntegerPoint, b: &IntegerPoint) -> bool {
    let edge = subtract(q, p);
    let signs = &mut AtRest;
    if is_zero(signs, &edge) {
        // The edge has no length: these are two segments from one point.
        return points_into(&subtract(a, p), &[subtract(b, p), edge]);
    }
    let areas = [a, b].map(|x| cross(&edge, &subtract(x, p)));
    match areas.each_ref().map(|area| is_zero(signs, area)) {
        // The common part lies in the half-planes of a and of b: these are equal, or share only their border.
        [false, false] => is_zero(signs, &cross(&areas[0], &areas[1])) && dot(&areas[0], &areas[1]).is_positive(),
        // One of the triangles is a segment on the line p q, and the other meets that line only in p q.
        [true, false] | [false, true] => false,
        // Both are segments on the line. They share more if both extend beyond the same end.
        [true, true] => {
            let beyond = |end: &IntegerPoint, sign: Ordering| [a, b].iter().all(|x| dot(&edge, &subtract(x, end)).cmp0() == sign);
            beyond(q, Ordering::Greater) || beyond(p, Ordering::Less)
        }
    }
}
