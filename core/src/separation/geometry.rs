//! The geometry of a contact: the points of both sides, their weights, and the normal between them.
//!
//! A contact's time lies a little before the pair touches. So its closest points are near each other, and the vector between them
//! is mostly rounding. The normal does not come from that vector alone: directions perpendicular to the features are tried as
//! well. A direction is taken only if it **certainly kept the pair apart** at the time of contact, or shortly before
//! ([`gap`](super::gap)). So up to the first contact, a normal points from the second side to the first as they were before, in
//! any numbering of vertices. At a time after a pair has passed through each other, it points as they lie then.
//!
//! # Guarantees
//! These hold for positions of at most 2¹⁰²⁰ in magnitude and a time in [0, 1], in every floating-point environment. B is the
//! largest magnitude of a coordinate at both ends of the step. D is that of a coordinate's difference between the first of the
//! four points and another. All results but the points are computed from such differences, so a pair's distance from the origin
//! does not matter.
//! * Weights are in [0, 1]; those of each side add up to 1 within 4u.
//! * Each point is within 96u·B of the exact point of its side with these weights at that time. Along each axis a difference is
//!   within 2u·D, and at a time within another 6u·D ([`Motion::at`](crate::Motion::at)); products and two sums add 6u·D; D ≤ 2B.
//!   The place of the first point adds 6u·B, the error of the weights' sum 4u·B, the last sum 2u·B: 40u·B, times √3. Numbers too
//!   small for the format add at most η = [`Rounding::UNDERFLOW`].
//! * [`Geometry::distance`] encloses the distance of the two sides at that time. From above: the closest points are the nearest,
//!   whatever the weights. Both sides' 18u·D along each axis, 62.4u·D, are covered by 96u·D, and η and 16u of the length are
//!   added. From below: by the normal.
//! * The speed is within 256u·D of that of the points with these weights along this normal. Along each axis a path is within
//!   8u·D, and weighing adds 12u·D. The difference of the two sides makes 48u·D of it, and the product with the normal at most
//!   125u·D in all.
//! * A normal has length one within 16u, and **the two sides were certainly apart along it** at [`Geometry::separated_at`]. There
//!   is no normal if none can be shown. This is so for a pair that touches when the step begins, or is then nearer than rounding
//!   can resolve.
//!
//! A time outside of [0, 1], or NaN, and positions that are not finite prove nothing: there is no normal, and the distance is
//! unbounded.
//!
//! The conditioning of the closest points depends on the pair, for example with nearly parallel edges: the enclosure shows it.
//!
//! # Rounding
//! A gap is computed from positions that are off by 8u·D along each axis, 13.9u·D each: 28u·D more than the 49u·D for which
//! [`GapError`] of D allows 64u·D. So the error is taken for 2D. Gappa proves all of these (`verification/gappa/geometry.g`).

use super::closest::ClosestPoints;
use super::gap::{GapError, distance_from_below};
use super::largest_coordinate;
use crate::kind::PairKind;
use crate::lanes::Rounding;
use crate::motion::{Motion, PrimitivePair};
use glam::DVec3;

/// The geometry of a contact: see the [module](self). Lengths are in the unit of the positions, speeds in lengths per step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// The barycentric weights of each side: of the vertex and the face's three corners, or of the ends of both edges.
    pub weights: [f64; 4],
    /// The points of the first and the second side with these weights.
    pub points: [DVec3; 2],
    /// The normal, from the second side to the first.
    pub normal: Option<DVec3>,
    /// A time in [0, time] at which the sides were certainly apart along the normal: the time of contact itself, or a little
    /// before it. It is 0 without a normal.
    pub separated_at: f64,
    /// A lower and an upper bound of the distance of the two sides at the time of contact.
    pub distance: [f64; 2],
    /// The speed at which the first point moves away from the second along the normal. It is negative if they approach each
    /// other, zero without a normal.
    pub speed: f64,
}

/// The times before the contact at which the pair may have been apart, as shares of the time since the step began. Each is about
/// a thousand times the one before, and the last is all of it.
const BEFORE: [f64; 5] = [0.0, 1.0 / 1_073_741_824.0, 1.0 / 1_048_576.0, 1.0 / 1024.0, 1.0];

/// Computes the geometry of a pair at a time in [0, 1], as for a contact.
///
/// ```
/// use selvedge_core::{Motion, PrimitivePair, glam::DVec3, separation::geometry::geometry};
/// // A vertex that falls onto a triangle, and touches it at half of the step.
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.25, 0.25, 1.0), DVec3::new(0.25, 0.25, -1.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// let found = geometry(&pair, 0.5);
/// assert_eq!(found.normal, Some(DVec3::Z));
/// assert_eq!(found.weights, [1.0, 0.5, 0.25, 0.25]);
/// assert_eq!(found.speed, -2.0);
/// ```
#[must_use]
pub fn geometry(pair: &PrimitivePair<f64>, time: f64) -> Geometry {
    let kind = pair.kind;
    let is_time = (0.0..=1.0).contains(&time);
    let time = if is_time { time } else { 0.0 };
    let [origin, ..] = pair.motions;
    let from_origin = |motion: Motion<f64>| Motion::new(motion.start - origin.start, motion.end - origin.end);
    let motions = pair.motions.map(from_origin);
    let ends = motions.map(|motion| [motion.start, motion.end]);
    let largest = largest_coordinate(ends.as_flattened());
    let at = |time: f64| Instant {
        origin: origin.at(time),
        points: motions.map(|motion| motion.at(time)),
        velocities: motions.map(|motion| motion.end - motion.start),
        largest,
        error: 0.0,
    };
    of_instants(kind, is_time.then_some(time), at)
}

/// Four points at some time.
pub(crate) struct Instant {
    /// The position of the first point.
    pub origin: DVec3,
    /// The points, relative to the first.
    pub points: [DVec3; 4],
    pub velocities: [DVec3; 4],
    /// The largest coordinate that any of `points` may have.
    pub largest: f64,
    /// The error of the two sides, added up, beyond the rounding of [straight motion](self).
    pub error: f64,
}

/// Computes the geometry of four points with any motion, at a time in [0, 1].
pub(crate) fn of_instants(kind: PairKind, time: Option<f64>, at: impl Fn(f64) -> Instant) -> Geometry {
    let (is_time, time) = (time.is_some(), time.unwrap_or(0.0));
    let now = at(time);
    let closest = ClosestPoints::from_points(kind, now.points);
    let weights = barycentric(kind, closest.weights);
    let met = both(kind, weights, now.points);

    let across = across(kind, now.points);
    // Without a gap nothing was found. There is no `Option`, whose numbers would be undefined.
    let (mut normal, mut separated_at, mut gap) = (DVec3::ZERO, 0.0, 0.0);
    for share in BEFORE.into_iter().filter(|_| is_time) {
        let earlier = time * (1.0 - share);
        let before = at(earlier);
        let own = if share == 0.0 {
            closest
        } else {
            ClosestPoints::from_points(kind, before.points)
        };
        let directions = [own.direction, across, -across].map(|direction| {
            // It is normalised again, since the length of a tiny vector is not known to its last digit.
            let direction = direction.normalize_or_zero();
            (direction, before.distance_from_below(kind, direction))
        });
        // This takes the direction with the largest gap.
        let farther = |a: (DVec3, f64), b: (DVec3, f64)| if b.1 > a.1 { b } else { a };
        (normal, gap) = directions.into_iter().fold((DVec3::ZERO, 0.0), farther);
        separated_at = earlier;
        if gap > 0.0 {
            break;
        }
    }
    let largest = now.largest;
    let apart = length(met[0] - met[1]) * (1.0 + 16.0 * u()) + (96.0 * u() * largest + <f64 as Rounding>::UNDERFLOW);
    let apart = if now.error == 0.0 {
        apart
    } else {
        (apart + now.error) * (1.0 + 8.0 * u())
    };
    let mut geometry = Geometry {
        weights,
        points: met.map(|point| now.origin + point),
        normal: None,
        separated_at: 0.0,
        distance: [0.0, if is_time && !apart.is_nan() { apart } else { f64::INFINITY }],
        speed: 0.0,
    };
    if gap > 0.0 {
        let [first, second] = both(kind, weights, now.velocities);
        geometry.normal = Some(normal);
        geometry.separated_at = separated_at;
        geometry.distance[0] = now.distance_from_below(kind, normal);
        geometry.speed = (first - second).dot(normal);
    }
    geometry
}

impl Instant {
    /// Returns a lower bound of the true distance of the two sides, by a direction from the second to the first, or zero.
    fn distance_from_below(&self, kind: PairKind, direction: DVec3) -> f64 {
        let error = GapError::from_largest_coordinate(2.0 * self.largest);
        let computed = distance_from_below(kind, self.points, direction, error);
        if self.error == 0.0 {
            computed
        } else if computed > self.error {
            // This has two roundings.
            (computed - self.error) * (1.0 - 8.0 * u())
        } else {
            0.0
        }
    }
}

/// Returns half the distance from 1 to the next number.
const fn u() -> f64 {
    <f64 as Rounding>::UNIT_ROUNDOFF
}

/// Returns the length of a vector whose square may be out of range.
fn length(vector: DVec3) -> f64 {
    let size = vector.abs().max_element();
    if size > 0.0 { size * (vector / size).length() } else { size }
}

/// Turns weights of the offset between the two into barycentric weights: none is negative, and those of each side add up to one.
fn barycentric(kind: PairKind, [_, b, c, d]: [f64; 4]) -> [f64; 4] {
    let part = |weight: f64| weight.abs().clamp(0.0, 1.0);
    match kind {
        PairKind::VertexFace => {
            let (c, d) = (part(c), part(d));
            // Rounding can lead beyond the far side.
            let sum = c + d;
            if sum > 1.0 {
                [1.0, 0.0, c / sum, d / sum]
            } else {
                [1.0, 1.0 - sum, c, d]
            }
        }
        PairKind::EdgeEdge => {
            let (b, d) = (part(b), part(d));
            [1.0 - b, b, 1.0 - d, d]
        }
    }
}

/// Returns the points of both sides with these weights.
fn both(kind: PairKind, [a, b, c, d]: [f64; 4], [p, q, r, s]: [DVec3; 4]) -> [DVec3; 2] {
    match kind {
        PairKind::VertexFace => [p, q * b + r * c + s * d],
        PairKind::EdgeEdge => [p * a + q * b, r * c + s * d],
    }
}

/// Returns a direction perpendicular to the face, or to both edges; zero if there is none.
fn across(kind: PairKind, [p, q, r, s]: [DVec3; 4]) -> DVec3 {
    let (first, second) = match kind {
        PairKind::VertexFace => (r - q, s - q),
        PairKind::EdgeEdge => (q - p, s - r),
    };
    // The sides are normalised first, so that their product is not zero if they are small.
    first
        .normalize_or_zero()
        .cross(second.normalize_or_zero())
        .normalize_or_zero()
}
