//! Primitive pairs in motion that come within a distance of each other.

use super::algebraic::AlgebraicTime;
use super::geometry::{AtRest, EDGES, Point, Ring, Signs, cross, dot, subtract};
use super::motion::{Motion, Pair, PairKind};
use super::polynomial::Polynomial;
use rug::{Integer, Rational};

/// Returns whether the distance of the closed vertex and face, or of the two closed edges, is at most `separation` at some time.
///
/// With a separation of zero this decides the same as [`collides`](super::collides), in another way.
///
/// # Panics
/// Panics if a coordinate or the separation is NaN or infinite, or the separation is negative.
pub fn within(pair: &Pair, separation: f64) -> bool {
    let question = Question::new(pair, separation);
    question.cannot_be_ruled_out()
        && (question.is_near_at(&Rational::from(0)) || question.find_approach(|feature, mut time| feature.is_near(&mut time)))
}

/// Returns the earliest time in [0, 1] at which the distance is `separation` or less, or `None` if it never is.
///
/// This can take minutes if coordinates and separation differ by hundreds of powers of ten: the times to be compared are then
/// nearly equal. [`within`] does not compare times.
///
/// # Panics
/// Panics as [`within`] does.
pub fn first_within(pair: &Pair, separation: f64) -> Option<AlgebraicTime> {
    let question = Question::new(pair, separation);
    if !question.cannot_be_ruled_out() {
        return None;
    }
    let start = Rational::from(0);
    if question.is_near_at(&start) {
        return Some(AlgebraicTime::rational(start));
    }
    let mut earliest: Option<AlgebraicTime> = None;
    question.find_approach(|feature, mut time| {
        let earlier = earliest.as_ref().is_none_or(|known| time < *known);
        if earlier && feature.is_near(&mut time) {
            earliest = Some(time);
        }
        false
    });
    earliest
}

/// Returns whether the distance is `separation` or less at time `t`.
///
/// # Panics
/// Panics as [`within`] does.
pub fn within_at(pair: &Pair, t: &Rational, separation: f64) -> bool {
    Question::new(pair, separation).is_near_at(t)
}

/// Returns whether the distance of the vertex and the face, or of the two edges, is `separation` or less at these positions.
///
/// # Panics
/// Panics if the separation is NaN, infinite or negative.
pub fn within_at_rest(kind: PairKind, points: &[[Rational; 3]; 4], separation: f64) -> bool {
    assert!(separation >= 0.0, "the separation must not be negative, but is {separation}");
    let separation = Rational::from_f64(separation).expect("a finite separation");
    let mut scale = separation.denom().clone();
    for x in points.iter().flatten() {
        scale.lcm_mut(x.denom());
    }
    let scaled = |x: &Rational| (x * Rational::from(&scale)).into_numer_denom().0;
    let points = points.each_ref().map(|point| point.each_ref().map(scaled));
    is_near_at_rest(kind, &points, &scaled(&separation).square())
}

fn is_near_at_rest(kind: PairKind, points: &[Point<Integer>; 4], squared: &Integer) -> bool {
    features(kind, points, squared)
        .iter()
        .any(|feature| feature.is_near(&mut AtRest))
}

/// A pair and a distance, at a common scale.
struct Question {
    kind: PairKind,
    motion: Motion,
    separation: Integer,
}

impl Question {
    fn new(pair: &Pair, separation: f64) -> Self {
        assert!(separation >= 0.0, "the separation must not be negative, but is {separation}");
        let (motion, separation) = Motion::with_separation(pair, separation);
        let kind = pair.kind;
        Self {
            kind,
            motion,
            separation,
        }
    }

    fn cannot_be_ruled_out(&self) -> bool {
        !self.motion.apart_along_an_axis(self.kind, &self.separation)
    }

    fn is_near_at(&self, t: &Rational) -> bool {
        // The positions are those at `t` times its denominator, so the separation is scaled by it, too.
        let squared = Integer::from(&self.separation * t.denom()).square();
        is_near_at_rest(self.kind, &self.motion.at(t), &squared)
    }

    /// Returns whether `accept` returns true for a time at which the distance, which is larger at first, may have come down to
    /// the separation. Each time is a root, and comes with the features concerned.
    fn find_approach(&self, mut accept: impl FnMut(&FeaturePair<Polynomial>, AlgebraicTime) -> bool) -> bool {
        // The distance is continuous and larger than the separation at first. When it has come down to the separation, the
        // features that hold the closest points are at exactly that distance: their `excess` is zero and the closest points are
        // within them. If the excess is zero at all times, the closest points have just come within them, and one of `inside` is
        // zero.
        let constant = Polynomial::new(vec![self.separation.clone().square()]);
        features(self.kind, &self.motion.trajectories(), &constant)
            .iter()
            .any(|feature| {
                let events = match feature.excess.is_zero() {
                    false => std::slice::from_ref(&feature.excess),
                    true => feature.inside.as_slice(),
                };
                let events = events.iter().filter(|event| !event.is_zero());
                events.flat_map(AlgebraicTime::roots).any(|time| accept(feature, time))
            })
    }
}

/// A point, line or plane of one side against one of the other. They are near if the closest points of their hulls are unique,
/// within the two features, and not farther apart than the separation.
struct FeaturePair<R> {
    /// A number with the sign of the distance of the hulls minus the separation.
    excess: R,
    /// Numbers that are all nonnegative if and only if the closest points are within the features.
    inside: Vec<R>,
    /// A number that is positive if the hulls have their full dimension (a line has two points, …), otherwise zero.
    extent: Option<R>,
}

impl<R> FeaturePair<R> {
    fn is_near(&self, signs: &mut impl Signs<R>) -> bool {
        self.extent.as_ref().is_none_or(|extent| signs.sign(extent).is_gt())
            && signs.sign(&self.excess).is_le()
            && self.inside.iter().all(|value| signs.sign(value).is_ge())
    }
}

/// Returns all pairs of features. Two closed sets of their kind are within the separation exactly if one of these pairs is near.
fn features<R: Ring>(kind: PairKind, points: &[Point<R>; 4], squared: &R) -> Vec<FeaturePair<R>> {
    let [a, b, c, d] = points;
    let point_point = |x: &Point<R>, y: &Point<R>| {
        let between = subtract(x, y);
        let excess = dot(&between, &between).difference(squared);
        FeaturePair {
            excess,
            inside: Vec::new(),
            extent: None,
        }
    };
    let point_line = |x: &Point<R>, p: &Point<R>, q: &Point<R>| {
        let (along, from_p) = (subtract(q, p), subtract(x, p));
        let area = cross(&along, &from_p);
        let extent = dot(&along, &along);
        FeaturePair {
            // The area is length · height.
            excess: dot(&area, &area).difference(&squared.product(&extent)),
            inside: vec![dot(&along, &from_p), dot(&along, &subtract(q, x))],
            extent: Some(extent),
        }
    };
    // For two lines, or a plane and a point, `normal` is perpendicular to both, and `between` joins them.
    let across = |normal: &Point<R>, between: &Point<R>, inside: &dyn Fn(&R) -> Vec<R>| {
        let extent = dot(normal, normal);
        let height = dot(normal, between);
        let excess = height.product(&height).difference(&squared.product(&extent));
        FeaturePair {
            excess,
            inside: inside(&extent),
            extent: Some(extent),
        }
    };
    let mut features = Vec::new();
    match kind {
        PairKind::VertexFace => {
            let face = [b, c, d];
            for [i, j] in EDGES {
                features.push(point_point(a, face[i]));
                features.push(point_line(a, face[i], face[j]));
            }
            let normal = cross(&subtract(c, b), &subtract(d, b));
            features.push(across(&normal, &subtract(a, b), &|_| {
                let inward = EDGES.map(|[i, j]| cross(&normal, &subtract(face[j], face[i])));
                let height = |i: usize| dot(&inward[i], &subtract(a, face[i]));
                vec![height(0), height(1), height(2)]
            }));
        }
        PairKind::EdgeEdge => {
            for (x, y) in [(a, c), (a, d), (b, c), (b, d)] {
                features.push(point_point(x, y));
            }
            for (x, p, q) in [(a, c, d), (b, c, d), (c, a, b), (d, a, b)] {
                features.push(point_line(x, p, q));
            }
            let (along_first, along_second) = (subtract(b, a), subtract(d, c));
            let (normal, between) = (cross(&along_first, &along_second), subtract(c, a));
            features.push(across(&normal, &between, &|extent| {
                // The closest points are at these parts of the edges, times `extent`.
                let first = dot(&normal, &cross(&between, &along_second));
                let second = dot(&normal, &cross(&between, &along_first));
                vec![
                    extent.clone().difference(&first),
                    extent.clone().difference(&second),
                    first,
                    second,
                ]
            }));
        }
    }
    features
}
