//! Directions to try if sets slide past one another. All of this is heuristic: the [proofs](super::directions) hold for any
//! direction, and decide.
//!
//! Between two times the corners move from `from` to `to`, and a direction turns from w₀ to w₁. Three ways to turn are tried:
//! * straight, where the lengths of w₀ and w₁ [balance](balanced);
//! * from and to the [middle](in_the_middle) of the directions that keep the pair apart. Next to a side, the direction of the
//!   closest point is perpendicular to that side, up to an angle as small as the distance. It leaves no room to turn;
//! * on a curve that stays [perpendicular to a side](along_side). Where two corners on opposite sides are far away, only
//!   directions perpendicular to the line between them keep the pair apart.
//!
//! # Overflow
//! Directions are of unit length up to rounding. [`balanced`] makes w₁ at most 2¹² times as long, and [`along_side`] returns
//! nothing that is longer than that along an axis. So a product with a corner is at most 3·2¹³ times the largest extent, 2²⁹ or
//! 2²⁵⁰. No sum of such products and bars comes near the largest number.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison is false with NaN, which must then take the side that finds no direction"
)]

use super::closest::{Closest, Feature, closest};
use crate::lanes::Number;
use crate::vector::Vector;

/// Returns the greatest length of a direction.
fn longest<S: Number>() -> S {
    S::small(64) * S::small(64)
}

/// Returns the vector at unit length, up to rounding; NaN if its squares vanish.
#[inline(always)]
pub(crate) fn unit<S: Number>(v: Vector<S>) -> Vector<S> {
    v.scaled(S::ONE / v.dot(v).sqrt())
}

/// Returns the direction in which the hull is farthest from the origin, of unit length up to rounding. It tries the directions
/// of all corners, those perpendicular to all sides and to the face, and `w`.
///
/// The closest point of a hull that is nearly a line may be wrong by far more than a rounding error, and tilts its direction. One
/// of these directions belongs to the true closest feature, and each is perpendicular to its feature up to a few u.
#[cold]
pub(crate) fn farthest<S: Number, const N: usize>(positions: &[Vector<S>; N], w: Vector<S>) -> Vector<S> {
    let &[a, b, c, ref rest @ ..] = positions.as_slice() else {
        return w;
    };
    let least = |w: Vector<S>| positions.iter().map(|corner| w.dot(*corner)).fold(S::INFINITY, S::smaller);
    let (mut best, mut distance) = (w, -S::INFINITY);
    let mut consider = |w: Vector<S>| {
        let w = unit(w);
        let at = least(w);
        if at > distance {
            (best, distance) = (w, at);
        }
    };
    consider(w);
    let sides = match *rest {
        [d] => [[a, b], [a, c], [d, b], [d, c]],
        _ => [[a, b], [b, c], [c, a], [c, a]],
    };
    let mut longest = b - a;
    for [from, to] in sides {
        let side = to - from;
        consider(from);
        consider(from.without(side).without(side));
        if side.dot(side) > longest.dot(longest) {
            longest = side;
        }
    }
    let normal = (b - a).cross(c - a);
    let normal = unit(normal.scaled(S::ONE / normal.abs().largest()));
    let normal = normal.without(longest).without(longest);
    consider(normal);
    consider(normal.scaled(-S::ONE));
    best
}

/// Returns the middle of the directions that keep the pair apart, if one corner is at most an eighth as far as its two
/// neighbours. It is the closest point of the three, each moved to distance one.
pub(crate) fn in_the_middle<S: Number, const N: usize>(positions: &[Vector<S>; N]) -> Option<Vector<S>> {
    let &[a, b, c, ref rest @ ..] = positions.as_slice() else {
        return None;
    };
    let nearer = |v: Vector<S>, w: Vector<S>| if v.dot(v) <= w.dot(w) { [v, w] } else { [w, v] };
    // These are the nearest corner, and the two that its sides lead to.
    let [corner, first, second] = if let &[d] = rest {
        let ([inner, _], [outer, _]) = (nearer(a, d), nearer(b, c));
        let [least, _] = nearer(inner, outer);
        if least == inner { [inner, b, c] } else { [outer, a, d] }
    } else {
        let [least, other] = nearer(a, b);
        let [least, another] = nearer(least, c);
        [least, other, another]
    };
    let neighbours = first.dot(first).smaller(second.dot(second));
    if !(S::small(64) * corner.dot(corner) < neighbours) {
        return None;
    }
    let w = closest(&[unit(corner), unit(first), unit(second)]).point;
    (w.dot(w) > S::ZERO).then(|| unit(w))
}

/// Returns `w1` at a length at which the middle coefficients w₀·e₁ + w₁·e₀ are positive for all corners, if there is one. It
/// becomes at most 2¹² times as long, or as short.
#[inline(always)]
pub(crate) fn balanced<S: Number, const N: usize>(
    w0: Vector<S>,
    from: &[Vector<S>; N],
    w1: Vector<S>,
    to: &[Vector<S>; N],
) -> Vector<S> {
    let limit = longest::<S>();
    let (mut least, mut most) = (S::ONE / limit, limit);
    for (from, to) in from.iter().zip(to) {
        let (x, y) = (w0.dot(*to), w1.dot(*from));
        if x < S::ZERO && y > S::ZERO {
            least = least.larger(-x / y);
        }
        if y < S::ZERO && x > S::ZERO {
            most = most.smaller(x / -y);
        }
    }
    // The scale is twice as far from the bounds as needed, or in the middle between them.
    let (double, half) = (S::small(2) * least, S::HALF * most);
    w1.scaled(if double > half {
        (least.smaller(limit) * most).sqrt()
    } else {
        S::ONE.larger(double).smaller(half)
    })
}

/// Returns the control points of a direction that moves quadratically and stays perpendicular to a side: the first, twice the
/// second, the third.
///
/// Let u(t) be the side, and a(t) a vector that also moves linearly. Then w = a × u is such a direction, and a = u × w/u² gives
/// the vector for a given w at one time. The side is that of the closest point at `to`, or the line between the two corners
/// farthest from each other.
pub(crate) fn along_side<S: Number, const N: usize>(
    [w0, w1]: [Vector<S>; 2],
    from: &[Vector<S>; N],
    to: &[Vector<S>; N],
    later: &Closest<S>,
) -> Option<[Vector<S>; 3]> {
    let [one, other] = side_of(to, later.feature)?;
    let side = |positions: &[Vector<S>; N]| Some(*positions.get(other)? - *positions.get(one)?);
    let (u0, u1) = (side(from)?, side(to)?);
    let across = |u: Vector<S>, w: Vector<S>| u.cross(w).scaled(S::ONE / u.dot(u));
    let (a0, a1) = (across(u0, w0), across(u1, w1));
    let points = [a0.cross(u0), a0.cross(u1) + a1.cross(u0), a1.cross(u1)];
    points.iter().all(is_short).then_some(points)
}

/// Returns the control points of a direction that stays perpendicular to the face, or to both edges: their normal moves
/// quadratically.
pub(crate) fn along_face<S: Number, const N: usize>(from: &[Vector<S>; N], to: &[Vector<S>; N]) -> Option<[Vector<S>; 3]> {
    let (&[a0, b0, c0, ..], &[a1, b1, c1, ..]) = (from.as_slice(), to.as_slice()) else {
        return None;
    };
    let ([u0, v0], [u1, v1]) = ([b0 - a0, c0 - a0], [b1 - a1, c1 - a1]);
    let points = [u0.cross(v0), u0.cross(v1) + u1.cross(v0), u1.cross(v1)];
    let [largest, middle, last] = points.map(|w| w.abs().largest());
    let largest = largest.larger(middle).larger(last);
    let towards = if points[0].dot(a0) < S::ZERO { -S::ONE } else { S::ONE };
    let points = points.map(|w| w.scaled(towards / largest));
    points.iter().all(is_short).then_some(points)
}

fn is_short<S: Number>(w: &Vector<S>) -> bool {
    w.abs().largest() <= longest()
}

/// Returns the corners at the ends of a feature that is a side, otherwise those that are farthest from each other.
fn side_of<S: Number, const N: usize>(positions: &[Vector<S>; N], feature: Feature) -> Option<[usize; 2]> {
    match feature {
        Feature::SideAb => return Some([0, 1]),
        Feature::SideAc => return Some([0, 2]),
        Feature::SideBc => return Some([1, 2]),
        Feature::Corner | Feature::Interior => {}
    }
    let (mut farthest, mut found) = (S::ZERO, None);
    for (one, from) in positions.iter().enumerate() {
        for (other, to) in positions.iter().enumerate().skip(one + 1) {
            let side = *to - *from;
            let squared = side.dot(side);
            if squared > farthest {
                (farthest, found) = (squared, Some([one, other]));
            }
        }
    }
    found
}
