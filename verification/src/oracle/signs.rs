//! Decides whether two triangles intersect by exact signs of volumes alone, where these suffice.
//!
//! The sign of a tetrahedron's volume comes from Shewchuk's adaptive predicates (the crate `robust`). It is exact for `f64`
//! without overflow and underflow, and about a thousand times as fast as integers of any length. A few signs decide unless one
//! that matters is zero. In that case, and outside the range below, the functions return `None`, and integers decide.
//!
//! **Nothing overflows or underflows** between [`SMALLEST`] = 2⁻²⁴⁷ and [`LARGEST`] = 2³⁰⁰, or at zero. Such numbers are
//! multiples of 2⁻²⁹⁹, and so are differences, rounded or not, and their tails. Products of three, and all sums of such products,
//! are multiples of 2⁻⁸⁹⁷. So they are rounded as if exponents had no limit, and none of their tails is lost. Error bounds are
//! products of a number that is zero or at least 2⁻⁸⁹⁷ and a constant of at least u² = 2⁻¹⁰⁶, so they are normal numbers. The
//! largest values are sums of at most 192 products of three numbers below 2³⁰², one of them times the splitter 2²⁷ + 1: below
//! 2⁹⁴².

use robust::{Coord3D, orient3d};
use std::cmp::Ordering;

type Triangle = [[f64; 3]; 3];

/// 2⁻²⁴⁷.
const SMALLEST: f64 = f64::from_bits((1023 - 247) << 52);
/// 2³⁰⁰.
const LARGEST: f64 = f64::from_bits((1023 + 300) << 52);

/// Decides [`triangles_intersect`](super::triangles_intersect) by exact signs of volumes. Returns `None` if a zero among them, or
/// the range of the numbers, leaves it open. Triangles with all three corners in common do not intersect.
pub fn triangles_intersect_by_signs(a: &Triangle, b: &Triangle, shared: &[[usize; 2]]) -> Option<bool> {
    if !a.iter().chain(b).flatten().copied().all(is_in_range) {
        return None;
    }
    match *shared {
        [] => apart_from_each_other(a, b),
        [[i, j]] => from_a_common_corner(a[i], [a[(i + 1) % 3], a[(i + 2) % 3]], [b[(j + 1) % 3], b[(j + 2) % 3]]),
        // Triangles with a common edge intersect only if they are folded flat.
        [[i, k], [j, l]] => side([a[i], a[j], a[3 - i - j]], b[3 - k - l]).map(|_| false),
        _ => Some(false),
    }
}

fn is_in_range(x: f64) -> bool {
    x == 0.0 || (SMALLEST..=LARGEST).contains(&x.abs())
}

/// Returns the side of the plane on which the point is, or `None` if it is on the plane.
fn side([a, b, c]: Triangle, point: [f64; 3]) -> Option<Ordering> {
    let [a, b, c, d] = [a, b, c, point].map(|[x, y, z]| Coord3D { x, y, z });
    let volume = orient3d(a, b, c, d);
    volume.partial_cmp(&0.0).filter(|sign| sign.is_ne())
}

/// Returns whether all points are strictly on one side of the triangle's plane, or `None` if one is on it.
fn on_one_side<const N: usize>(triangle: Triangle, points: [[f64; 3]; N]) -> Option<bool> {
    let first = side(triangle, points[0])?;
    let mut all = true;
    for point in &points[1..] {
        all &= side(triangle, *point)? == first;
    }
    Some(all)
}

/// Two triangles without a common corner meet if an edge of one passes through the other.
fn apart_from_each_other(a: &Triangle, b: &Triangle) -> Option<bool> {
    // Even if one of these is undecided, the other may decide.
    let sides = [on_one_side(*b, *a), on_one_side(*a, *b)];
    if sides.contains(&Some(true)) {
        return Some(false);
    }
    let [Some(_), Some(_)] = sides else {
        return None;
    };
    for (edges, face) in [(a, b), (b, a)] {
        for corner in 0..3 {
            if passes_through([edges[corner], edges[(corner + 1) % 3]], *face)? {
                return Some(true);
            }
        }
    }
    Some(false)
}

/// Two triangles with one common corner meet elsewhere if the opposite edge of one passes through the other.
fn from_a_common_corner(apex: [f64; 3], a: [[f64; 3]; 2], b: [[f64; 3]; 2]) -> Option<bool> {
    let [first, second] = [(a, b), (b, a)].map(|(edge, opposite)| passes_through(edge, [apex, opposite[0], opposite[1]]));
    Some(first? || second?)
}

/// Returns whether an edge passes through a triangle, from one side of its plane to the other. Returns `None` if an end of the
/// edge is in the plane, or the edge meets the line of an edge of the triangle.
fn passes_through([p, q]: [[f64; 3]; 2], face: Triangle) -> Option<bool> {
    if on_one_side(face, [p, q])? {
        return Some(false);
    }
    let [a, b, c] = face;
    let turns = [side([p, q, a], b)?, side([p, q, b], c)?, side([p, q, c], a)?];
    Some(turns[0] == turns[1] && turns[1] == turns[2])
}
