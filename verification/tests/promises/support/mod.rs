//! Checks that several modules share. This file has a second way to decide contact at rest: convex sets clipped by half-spaces in
//! rational arithmetic.
//!
//! The oracle decides by signs and never constructs a point; this constructs every corner of the common part.

pub(crate) mod bounds;
pub(crate) mod digest;
pub(crate) mod distance;
pub(crate) mod environment;
pub(crate) mod geometry;
pub(crate) mod prelude;
pub(crate) mod rationals;
pub(crate) mod sweeps;
pub(crate) mod widths;
pub(crate) mod worlds;

use rug::Rational;

pub(crate) type Point = [Rational; 3];

pub(crate) fn determinant([a, b, c]: [[i128; 3]; 3]) -> i128 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

pub(crate) fn point(coordinates: [f64; 3]) -> Point {
    coordinates.map(|x| Rational::from_f64(x).expect("finite"))
}

/// Returns the position at time `t` of a point that moves linearly.
pub(crate) fn at(start: [f64; 3], end: [f64; 3], t: &Rational) -> Point {
    let (start, end) = (point(start), point(end));
    std::array::from_fn(|i| Rational::from(&end[i] - &start[i]) * t + &start[i])
}

pub(crate) fn minus(a: &Point, b: &Point) -> Point {
    std::array::from_fn(|i| Rational::from(&a[i] - &b[i]))
}

pub(crate) fn dot(a: &Point, b: &Point) -> Rational {
    a.iter().zip(b).map(|(x, y)| Rational::from(x * y)).sum()
}

pub(crate) fn cross(a: &Point, b: &Point) -> Point {
    let minor = |i: usize, j: usize| Rational::from(&a[i] * &b[j]) - Rational::from(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn is_zero(v: &Point) -> bool {
    v.iter().all(Rational::is_zero)
}

/// The half-space `{ x : direction · (x − through) ≥ 0 }`, by its direction and `through`.
type HalfSpace = (Point, Point);

fn height(x: &Point, (direction, through): &HalfSpace) -> Rational {
    dot(direction, &minus(x, through))
}

/// Returns half-spaces whose common part is the hull of one, two or three points.
fn half_spaces(hull: &[Point]) -> Vec<HalfSpace> {
    let mut half_spaces = Vec::new();
    let mut both_sides = |direction: &Point, through: &Point| {
        let opposite = direction.clone().map(|x| -x);
        for direction in [direction.clone(), opposite] {
            half_spaces.push((direction, through.clone()));
        }
    };
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(point);
    if let [a, b, c] = hull {
        let normal = cross(&minus(b, a), &minus(c, a));
        if !is_zero(&normal) {
            both_sides(&normal, a);
            for (p, q) in [(a, b), (b, c), (c, a)] {
                half_spaces.push((cross(&normal, &minus(q, p)), p.clone()));
            }
            return half_spaces;
        }
    }
    // The points are on one line: the two ends are farthest apart.
    let pairs = hull.iter().flat_map(|p| hull.iter().map(move |q| (p, q)));
    let squared = |p: &Point, q: &Point| dot(&minus(q, p), &minus(q, p));
    let (p, q) = pairs.max_by_key(|(p, q)| squared(p, q)).expect("a hull of something");
    let along = minus(q, p);
    if is_zero(&along) {
        axes.iter().for_each(|axis| both_sides(axis, p));
        return half_spaces;
    }
    axes.iter().for_each(|axis| both_sides(&cross(&along, axis), p));
    half_spaces.extend([(minus(p, q), q.clone()), (along, p.clone())]);
    half_spaces
}

/// Returns points whose hull is the common part of two hulls of one, two or three points each. There are none if the hulls have
/// no point in common.
pub(crate) fn common_part(a: &[Point], b: &[Point]) -> Vec<Point> {
    let mut polygon = a.to_vec();
    for half_space in half_spaces(b) {
        let mut clipped = Vec::new();
        for (i, p) in polygon.iter().enumerate() {
            let q = &polygon[(i + 1) % polygon.len()];
            let (above_p, above_q) = (height(p, &half_space), height(q, &half_space));
            if !above_p.is_negative() {
                clipped.push(p.clone());
            }
            if above_p.is_negative() != above_q.is_negative() {
                let part = &above_p / Rational::from(&above_p - &above_q);
                clipped.push(std::array::from_fn(|i| Rational::from(&q[i] - &p[i]) * &part + &p[i]));
            }
        }
        polygon = clipped;
    }
    polygon
}

/// Returns whether x is in the hull of one, two or three points.
pub(crate) fn contains(hull: &[Point], x: &Point) -> bool {
    half_spaces(hull)
        .iter()
        .all(|half_space| !height(x, half_space).is_negative())
}
