//! Coplanarity and contact of primitive pairs in motion.

use super::algebraic::AlgebraicTime;
use super::geometry::{
    AtRest, EDGES, Point, Ring, Signs, coplanar_point_in_triangle, coplanar_segments_meet, cross, dot, normal, point_in_triangle,
    segments_meet, subtract, volume,
};
use super::motion::{Motion, Pair, PairKind};
use super::polynomial::{Polynomial, SturmSequence};
use rug::{Integer, Rational};

/// Returns whether four points, each moving linearly from `start` to `end`, are coplanar at some time in [0, 1].
///
/// # Panics
/// Panics if a coordinate is NaN or infinite.
pub fn are_ever_coplanar(start: &[[f64; 3]; 4], end: &[[f64; 3]; 4]) -> bool {
    let [a, b, c, d] = Motion::new(start, end).trajectories();
    let volume = volume(&a, &b, &c, &d);
    if volume.is_zero() {
        return true;
    }
    let [at_start, at_end] = [0, 1].map(|t| volume.sign_at_dyadic(&Integer::from(t), 0));
    if at_start.is_eq() || at_start != at_end {
        return true;
    }
    let roots = SturmSequence::new(&volume);
    roots.variations(&Integer::from(0), 0) != roots.variations(&Integer::from(1), 0)
}

/// Returns the earliest time in [0, 1] at which the closed vertex and face, or the two closed edges, share a point. `None`: they
/// never do.
///
/// A rational time is known as such.
///
/// # Panics
/// Panics if a coordinate is NaN or infinite.
pub fn collides(pair: &Pair) -> Option<AlgebraicTime> {
    let motion = Motion::new(&pair.start, &pair.end);
    if motion.apart_along_an_axis(pair.kind, &Integer::new()) {
        return None;
    }
    let start = Rational::from(0);
    if touches(pair.kind, &motion, &start) {
        return Some(AlgebraicTime::rational(start));
    }
    let points = motion.trajectories();
    let [a, b, c, d] = &points;
    let volume = volume(a, b, c, d);

    // Whether they touch at t is a combination of signs of polynomials at t, and the times of contact are a closed set. So its
    // first element is 0 or a root of one of these polynomials.
    if !volume.is_zero() {
        // Contact makes the points coplanar.
        let mut times = AlgebraicTime::roots(&volume).into_iter();
        return times.find_map(|mut time| touches_when_coplanar(pair.kind, &mut time, &points).then(|| time.settled()));
    }
    let mut earliest: Option<AlgebraicTime> = None;
    for polynomial in predicates_in_the_plane(pair.kind, &points) {
        if polynomial.is_zero() {
            continue;
        }
        for mut time in AlgebraicTime::roots(&polynomial) {
            let earlier = earliest.as_ref().is_none_or(|known| time < *known);
            if earlier && touches_when_coplanar(pair.kind, &mut time, &points) {
                earliest = Some(time);
            }
        }
    }
    earliest.map(AlgebraicTime::settled)
}

/// Returns whether the closed vertex and face, or the two closed edges, share a point at time `t`.
///
/// # Panics
/// Panics if a coordinate is NaN or infinite.
pub fn touches_at(pair: &Pair, t: &Rational) -> bool {
    touches(pair.kind, &Motion::new(&pair.start, &pair.end), t)
}

fn touches(kind: PairKind, motion: &Motion, t: &Rational) -> bool {
    let [a, b, c, d] = &motion.at(t);
    match kind {
        PairKind::VertexFace => point_in_triangle(&mut AtRest, a, [b, c, d]),
        PairKind::EdgeEdge => segments_meet(&mut AtRest, [a, b], [c, d]),
    }
}

/// Decides whether the sets touch at a time when the four points are coplanar.
fn touches_when_coplanar<R: Ring>(kind: PairKind, signs: &mut impl Signs<R>, [a, b, c, d]: &[Point<R>; 4]) -> bool {
    match kind {
        PairKind::VertexFace => coplanar_point_in_triangle(signs, a, [b, c, d]),
        PairKind::EdgeEdge => coplanar_segments_meet(signs, [a, b], [c, d]),
    }
}

/// Returns every polynomial whose sign [`touches_when_coplanar`] may need, some with the other sign.
fn predicates_in_the_plane(kind: PairKind, [a, b, c, d]: &[Point<Polynomial>; 4]) -> Vec<Polynomial> {
    // Each end or vertex with the segments that it is tested against.
    let (normal, tests) = match kind {
        PairKind::VertexFace => {
            let face = [b, c, d];
            (normal(b, c, d), EDGES.map(|[i, j]| (a, face[i], face[j])).to_vec())
        }
        PairKind::EdgeEdge => (
            cross(&subtract(b, a), &subtract(d, c)),
            vec![(a, c, d), (b, c, d), (c, a, b), (d, a, b)],
        ),
    };
    let mut predicates = normal.to_vec();
    for (x, p, q) in tests {
        let (from_p, from_q) = (subtract(x, p), subtract(x, q));
        predicates.extend(cross(&from_p, &from_q));
        predicates.push(dot(&from_p, &from_q));
    }
    predicates
}
