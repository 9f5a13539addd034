//! Exact predicates on points, segments and triangles, all of them closed and possibly degenerate.
//!
//! They are written once over a ring with signs. It is instantiated with integers, for points at rest, and with polynomials in
//! the time, for points in motion. Their signs are taken at one algebraic time.

use super::polynomial::Polynomial;
use rug::Integer;
use std::cmp::Ordering;

/// Addition, subtraction and multiplication. The first two work in place, since numbers are long.
pub(crate) trait Ring: Clone {
    fn sum(self, other: &Self) -> Self;
    fn difference(self, other: &Self) -> Self;
    fn product(&self, other: &Self) -> Self;
}

/// Determines the signs of ring elements.
pub(crate) trait Signs<R> {
    fn sign(&mut self, value: &R) -> Ordering;
}

pub(crate) struct AtRest;

impl Signs<Integer> for AtRest {
    fn sign(&mut self, value: &Integer) -> Ordering {
        value.cmp0()
    }
}

impl Ring for Integer {
    fn sum(self, other: &Self) -> Self {
        self + other
    }
    fn difference(self, other: &Self) -> Self {
        self - other
    }
    fn product(&self, other: &Self) -> Self {
        Integer::from(self * other)
    }
}

impl Ring for Polynomial {
    fn sum(self, other: &Self) -> Self {
        self.combined(other, |own, c| *own += c)
    }
    fn difference(self, other: &Self) -> Self {
        self.combined(other, |own, c| *own -= c)
    }
    fn product(&self, other: &Self) -> Self {
        let (a, b) = (self.coefficients(), other.coefficients());
        let mut product = vec![Integer::new(); (a.len() + b.len()).saturating_sub(1)];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                product[i + j] += x * y;
            }
        }
        Self::new(product)
    }
}

pub(crate) type Point<R> = [R; 3];

/// The corners (0, 1), (1, 2), (2, 0) of a triangle's edges.
pub(crate) const EDGES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

pub(crate) fn subtract<R: Ring>(a: &Point<R>, b: &Point<R>) -> Point<R> {
    [0, 1, 2].map(|axis| a[axis].clone().difference(&b[axis]))
}

pub(crate) fn dot<R: Ring>(a: &Point<R>, b: &Point<R>) -> R {
    a[0].product(&b[0]).sum(&a[1].product(&b[1])).sum(&a[2].product(&b[2]))
}

/// Returns one component of the cross product: the signed area spanned by the projections along `axis`.
pub(crate) fn cross_component<R: Ring>(a: &Point<R>, b: &Point<R>, axis: usize) -> R {
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    a[i].product(&b[j]).difference(&a[j].product(&b[i]))
}

pub(crate) fn cross<R: Ring>(a: &Point<R>, b: &Point<R>) -> Point<R> {
    [0, 1, 2].map(|axis| cross_component(a, b, axis))
}

/// Returns twice the area vector of the triangle a b c.
pub(crate) fn normal<R: Ring>(a: &Point<R>, b: &Point<R>, c: &Point<R>) -> Point<R> {
    cross(&subtract(b, a), &subtract(c, a))
}

/// Returns six times the signed volume of the tetrahedron a b c d.
pub(crate) fn volume<R: Ring>(a: &Point<R>, b: &Point<R>, c: &Point<R>, d: &Point<R>) -> R {
    dot(&normal(a, b, c), &subtract(d, a))
}

/// Returns the first axis along which the vector is not zero, and its sign there.
fn first_nonzero<R>(signs: &mut impl Signs<R>, vector: &Point<R>) -> Option<(usize, Ordering)> {
    (0..3)
        .map(|axis| (axis, signs.sign(&vector[axis])))
        .find(|(_, sign)| sign.is_ne())
}

pub(crate) fn is_zero<R>(signs: &mut impl Signs<R>, vector: &Point<R>) -> bool {
    first_nonzero(signs, vector).is_none()
}

/// Returns whether x is on the closed segment p q. If p = q, this means that x is that point.
pub(crate) fn point_on_segment<R: Ring>(signs: &mut impl Signs<R>, x: &Point<R>, [p, q]: [&Point<R>; 2]) -> bool {
    // This means that x is not outside the ball with diameter p q, and that it is on the line.
    let (from_p, from_q) = (subtract(x, p), subtract(x, q));
    signs.sign(&dot(&from_p, &from_q)).is_le() && is_zero(signs, &cross(&from_p, &from_q))
}

/// Returns whether x, known to be coplanar with them, is in the hull of a, b and c.
pub(crate) fn coplanar_point_in_triangle<R: Ring>(signs: &mut impl Signs<R>, x: &Point<R>, triangle: [&Point<R>; 3]) -> bool {
    let [a, b, c] = triangle;
    match first_nonzero(signs, &normal(a, b, c)) {
        // The projection along this axis is one to one. So x must not be on the wrong side of any edge.
        Some((axis, winding)) => EDGES.iter().all(|&[i, j]| {
            let (p, q) = (triangle[i], triangle[j]);
            let area = cross_component(&subtract(q, p), &subtract(x, p), axis);
            signs.sign(&area) != winding.reverse()
        }),
        // The three points are on a line, and their hull is the union of the edges.
        None => EDGES
            .iter()
            .any(|&[i, j]| point_on_segment(signs, x, [triangle[i], triangle[j]])),
    }
}

/// Returns whether x is in the hull of a, b and c.
pub(crate) fn point_in_triangle<R: Ring>(signs: &mut impl Signs<R>, x: &Point<R>, triangle: [&Point<R>; 3]) -> bool {
    let [a, b, c] = triangle;
    signs.sign(&volume(a, b, c, x)).is_eq() && coplanar_point_in_triangle(signs, x, triangle)
}

/// Returns whether two closed segments, known to be coplanar, share a point.
pub(crate) fn coplanar_segments_meet<R: Ring>(signs: &mut impl Signs<R>, a: [&Point<R>; 2], b: [&Point<R>; 2]) -> bool {
    let along_a = subtract(a[1], a[0]);
    let along_b = subtract(b[1], b[0]);
    match first_nonzero(signs, &cross(&along_a, &along_b)) {
        // The lines cross in one point. It is on both segments if the ends of each are not on the same side of the other's line.
        Some((axis, _)) => {
            let mut straddles = |line: &Point<R>, through: &Point<R>, ends: [&Point<R>; 2]| {
                let side = ends.map(|end| signs.sign(&cross_component(line, &subtract(end, through), axis)));
                side[0].is_eq() || side[0] != side[1]
            };
            straddles(&along_a, a[0], b) && straddles(&along_b, b[0], a)
        }
        // They are parallel or have no length. If they share a point, an end of one is on the other.
        None => b.iter().any(|end| point_on_segment(signs, end, a)) || a.iter().any(|end| point_on_segment(signs, end, b)),
    }
}

/// Returns whether two closed segments share a point.
pub(crate) fn segments_meet<R: Ring>(signs: &mut impl Signs<R>, a: [&Point<R>; 2], b: [&Point<R>; 2]) -> bool {
    signs.sign(&volume(a[0], a[1], b[0], b[1])).is_eq() && coplanar_segments_meet(signs, a, b)
}

/// Returns whether the closed segment p q meets the hull of three points.
pub(crate) fn segment_meets_triangle<R: Ring>(
    signs: &mut impl Signs<R>,
    [p, q]: [&Point<R>; 2],
    triangle: [&Point<R>; 3],
) -> bool {
    let [a, b, c] = triangle;
    let normal = normal(a, b, c);
    let meets_an_edge = |signs: &mut _| {
        EDGES
            .iter()
            .any(|&[i, j]| segments_meet(signs, [p, q], [triangle[i], triangle[j]]))
    };
    if is_zero(signs, &normal) {
        return meets_an_edge(signs);
    }
    let side = [p, q].map(|end| signs.sign(&dot(&normal, &subtract(end, a))));
    match side {
        [Ordering::Equal, Ordering::Equal] => coplanar_point_in_triangle(signs, p, triangle) || meets_an_edge(signs),
        [Ordering::Equal, _] => coplanar_point_in_triangle(signs, p, triangle),
        [_, Ordering::Equal] => coplanar_point_in_triangle(signs, q, triangle),
        [of_p, of_q] if of_p == of_q => false,
        // The segment pierces the plane in one point. The line must not pass two edges on different sides.
        _ => {
            let turns = EDGES.map(|[i, j]| signs.sign(&volume(p, q, triangle[i], triangle[j])));
            !(turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater))
        }
    }
}
