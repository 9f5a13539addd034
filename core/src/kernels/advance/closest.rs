//! The point of the corners' hull that is closest to the origin, in plain floating point.
//!
//! No certificate relies on the accuracy of this point: they hold for any direction. Up to a few roundings the vector is a point
//! of the hull, so its length is no less than the distance. Each weight lies in [0, 1] by the comparisons that precede it. The
//! method is Ericson's (Real-Time Collision Detection, 2005, 5.1.5 and 5.1.9).
//!
//! There are two versions. [`closest`] serves one pair: it returns at the first feature that has the point, and names it.
//! `closest_by_selects` serves many pairs side by side: it computes all features with one quotient, and does not name the
//! feature.

use crate::lanes::{Lanes, Number, Rounding};
use crate::vector::Vector;

/// The feature of the hull that has the closest point. The first three corners are a, b, c.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// A corner.
    Corner,
    /// A side parallel to the one between a and b.
    SideAb,
    /// A side parallel to the one between a and c.
    SideAc,
    /// The side between b and c.
    SideBc,
    /// The interior.
    Interior,
}

/// The closest point and its feature.
#[derive(Clone, Copy, Debug)]
pub struct Closest<S> {
    /// The closest point of the hull.
    pub point: Vector<S>,
    /// Its squared distance from the origin.
    pub squared_distance: S,
    /// The feature that has it.
    pub feature: Feature,
}

impl<S: Number> Closest<S> {
    /// Returns a direction along which the whole hull, with corners at `positions`, is beyond the closest point. `extent` is
    /// their largest coordinate.
    ///
    /// The closest point itself is such a direction unless it is very near. Then its error, a few u times the extent h, tilts it
    /// against its side or face by uh/d, where d/h is all the room there is. So if d² is below 2⁶uh², the direction is made
    /// perpendicular to the side, or replaced by the face's normal.
    #[inline(always)]
    pub fn direction<const N: usize>(&self, positions: &[Vector<S>; N], extent: S) -> Vector<S> {
        let tilted = S::small(64) * S::UNIT_ROUNDOFF * (extent * extent);
        match positions.as_slice() {
            &[a, b, c, ..] if self.squared_distance < tilted => self.upright(a, b, c),
            _ => self.point,
        }
    }

    #[cold]
    fn upright(&self, a: Vector<S>, b: Vector<S>, c: Vector<S>) -> Vector<S> {
        let perpendicular_to = |side| self.point.without(side);
        match self.feature {
            Feature::Corner => self.point,
            Feature::SideAb => perpendicular_to(b - a),
            Feature::SideAc => perpendicular_to(c - a),
            Feature::SideBc => perpendicular_to(c - b),
            Feature::Interior => {
                let normal = (b - a).cross(c - a);
                // Its size does not matter, as long as products do not underflow.
                let normal = normal.scaled(S::ONE / normal.abs().largest());
                if normal.dot(self.point) < S::ZERO {
                    normal.scaled(-S::ONE)
                } else {
                    normal
                }
            }
        }
    }
}

/// Finds the closest point of the triangle of three corners, or of the parallelogram of four. Its last two given corners are
/// opposite to each other.
#[inline(always)]
pub fn closest<S: Number, const N: usize>(corners: &[Vector<S>; N]) -> Closest<S> {
    let &[a, b, c, ..] = corners.as_slice() else {
        // There are at least three corners.
        let nothing = Vector::new(S::ZERO, S::ZERO, S::ZERO);
        return at(nothing, Feature::Corner);
    };
    if N == 3 {
        in_triangle(a, b, c)
    } else {
        in_parallelogram(a, b, c)
    }
}

#[inline(always)]
fn at<S: Number>(point: Vector<S>, feature: Feature) -> Closest<S> {
    Closest {
        point,
        squared_distance: point.dot(point),
        feature,
    }
}

#[inline(always)]
fn in_triangle<S: Number>(a: Vector<S>, b: Vector<S>, c: Vector<S>) -> Closest<S> {
    let zero = S::ZERO;
    let (to_a_from_b, to_a_from_c) = (a - b, a - c);
    let (ab_a, ac_a) = (to_a_from_b.dot(a), to_a_from_c.dot(a));
    if ab_a <= zero && ac_a <= zero {
        return at(a, Feature::Corner);
    }
    let (ab_b, ac_b) = (to_a_from_b.dot(b), to_a_from_c.dot(b));
    if ab_b >= zero && ac_b <= ab_b {
        return at(b, Feature::Corner);
    }
    let area_c = ab_a * ac_b - ab_b * ac_a;
    if area_c <= zero && ab_a >= zero && ab_b <= zero {
        let weight = ab_a / (ab_a - ab_b);
        return at(a - to_a_from_b.scaled(weight), Feature::SideAb);
    }
    let (ab_c, ac_c) = (to_a_from_b.dot(c), to_a_from_c.dot(c));
    if ac_c >= zero && ab_c <= ac_c {
        return at(c, Feature::Corner);
    }
    let area_b = ab_c * ac_a - ab_a * ac_c;
    if area_b <= zero && ac_a >= zero && ac_c <= zero {
        let weight = ac_a / (ac_a - ac_c);
        return at(a - to_a_from_c.scaled(weight), Feature::SideAc);
    }
    let area_a = ab_b * ac_c - ab_c * ac_b;
    let (from_b, from_c) = (ac_b - ab_b, ab_c - ac_c);
    if area_a <= zero && from_b >= zero && from_c >= zero {
        let weight = from_b / (from_b + from_c);
        return at(b - (b - c).scaled(weight), Feature::SideBc);
    }
    let scale = S::ONE / ((area_a + area_b) + area_c);
    let inwards = to_a_from_b.scaled(area_b * scale) + to_a_from_c.scaled(area_c * scale);
    at(a - inwards, Feature::Interior)
}

/// The corners are a + (b − a)·t + (c − a)·s for s and t of 0 and 1: the two edges' parameters.
#[inline(always)]
fn in_parallelogram<S: Number>(a: Vector<S>, b: Vector<S>, c: Vector<S>) -> Closest<S> {
    let (zero, one) = (S::ZERO, S::ONE);
    let (first, second) = (c - a, a - b);
    let (first_squared, second_squared) = (first.dot(first), second.dot(second));
    let (along_first, along_second) = (first.dot(a), second.dot(a));
    let place = |s: S, t: S, feature| at((a + first.scaled(s)) - second.scaled(t), feature);
    // Returns the quotient if it lies in [0, 1], otherwise the nearer end; and true for an end. NaN becomes an end.
    let clamped = |numerator: S, denominator: S| {
        if numerator > zero {
            if numerator < denominator {
                (numerator / denominator, false)
            } else {
                (one, true)
            }
        } else {
            (zero, true)
        }
    };
    let feature = |s_is_end: bool, t_is_end: bool| match (s_is_end, t_is_end) {
        (false, false) => Feature::Interior,
        (false, true) => Feature::SideAc,
        (true, false) => Feature::SideAb,
        (true, true) => Feature::Corner,
    };
    let across = first.dot(second);
    let scale = first_squared * second_squared - across * across;
    let (s, s_is_end) = clamped(across * along_second - along_first * second_squared, scale);
    let t_numerator = across * s + along_second;
    let (t, t_is_end) = clamped(t_numerator, second_squared);
    if !t_is_end {
        return place(s, t, feature(s_is_end, false));
    }
    // This is the closest point of the first line to an end of the second edge.
    let s_numerator = if t > zero { across - along_first } else { -along_first };
    let (s, s_is_end) = clamped(s_numerator, first_squared);
    place(s, t, feature(s_is_end, true))
}

/// Finds the closest point like [`closest`], accurately also for a hull that is nearly a line. It is the nearest of the closest
/// points of all sides and of the interior, whose height above the longest side is computed separately.
#[cold]
pub(crate) fn closest_of_thin<S: Number, const N: usize>(corners: &[Vector<S>; N]) -> Closest<S> {
    let &[a, b, c, ref rest @ ..] = corners.as_slice() else {
        return closest(corners);
    };
    let (zero, one) = (S::ZERO, S::ONE);
    let (sides, is_triangle) = match *rest {
        [d] => (
            [
                (a, b, Feature::SideAb),
                (a, c, Feature::SideAc),
                (b, d, Feature::SideAc),
                (c, d, Feature::SideAb),
            ],
            false,
        ),
        _ => (
            [
                (a, b, Feature::SideAb),
                (a, c, Feature::SideAc),
                (b, c, Feature::SideBc),
                (b, c, Feature::SideBc),
            ],
            true,
        ),
    };
    let mut best = at(a, Feature::Corner);
    let mut consider = |found: Closest<S>| {
        if found.squared_distance < best.squared_distance {
            best = found;
        }
    };
    for (from, to, feature) in sides {
        let side = to - from;
        let weight = -(from.dot(side) / side.dot(side));
        consider(at(to, Feature::Corner));
        if weight > zero && weight < one {
            consider(at(from + side.scaled(weight), feature));
        }
    }
    let (ab, ac) = (b - a, c - a);
    let (long, short) = if ab.dot(ab) < ac.dot(ac) { (ac, ab) } else { (ab, ac) };
    let [height, rise] = [short, a].map(|v| v.without(long).without(long));
    let across = -(rise.dot(height) / height.dot(height));
    let foot = a + short.scaled(across);
    let along = -(foot.dot(long) / long.dot(long));
    let most = if is_triangle { one - across } else { one };
    if across > zero && across < one && along > zero && along < most {
        consider(at(foot + long.scaled(along), Feature::Interior));
    }
    best
}

/// Returns the closest point of a hull in each lane, without branches; `otherwise` if there are not three or four corners. The
/// result is NaN for some degenerate pairs.
#[inline(always)]
pub(super) fn closest_by_selects<L: Lanes, const N: usize>(corners: &[Vector<L>; N], otherwise: Vector<L>) -> Vector<L> {
    match *corners.as_slice() {
        [a, b, c] => in_triangle_by_selects(a, b, c),
        [a, b, c, _] => in_parallelogram_by_selects(a, b, c),
        _ => otherwise,
    }
}

/// Returns the weights of the interior, then those of each side and corner where it is closest.
#[inline(always)]
fn in_triangle_by_selects<L: Lanes>(a: Vector<L>, b: Vector<L>, c: Vector<L>) -> Vector<L> {
    let zero = a.x.splat(L::Scalar::ZERO);
    let one = a.x.splat(L::Scalar::ONE);
    macro_rules! not_above {
        ($x:expr, $y:expr) => {
            !$x.greater($y)
        };
    }
    let (ab, ac) = (a - b, a - c);
    let (ab_a, ac_a) = (ab.dot(a), ac.dot(a));
    let (ab_b, ac_b) = (ab.dot(b), ac.dot(b));
    let (ab_c, ac_c) = (ab.dot(c), ac.dot(c));
    let area_a = ab_b * ac_c - ab_c * ac_b;
    let area_b = ab_c * ac_a - ab_a * ac_c;
    let area_c = ab_a * ac_b - ab_b * ac_a;

    // One quotient serves all features: its terms are selected first. The weight of b is `to_b` times it, that of c `to_c` times.
    let (from_b, from_c) = (ac_b - ab_b, ab_c - ac_c);
    let mut divisor = (area_a + area_b) + area_c;
    let (mut to_b, mut to_c) = (area_b, area_c);
    macro_rules! choose {
        ($where:expr, $divisor:expr, $to_b:expr, $to_c:expr) => {
            let here = $where;
            divisor = L::select(here, $divisor, divisor);
            to_b = L::select(here, $to_b, to_b);
            to_c = L::select(here, $to_c, to_c);
        };
    }
    let side = not_above!(area_a, zero) & not_above!(zero, from_b) & not_above!(zero, from_c);
    choose!(side, from_b + from_c, from_c, from_b);
    let side = not_above!(area_b, zero) & not_above!(zero, ac_a) & not_above!(ac_c, zero);
    choose!(side, ac_a - ac_c, zero, ac_a);
    let corner = not_above!(zero, ac_c) & not_above!(ab_c, ac_c);
    choose!(corner, one, zero, one);
    let side = not_above!(area_c, zero) & not_above!(zero, ab_a) & not_above!(ab_b, zero);
    choose!(side, ab_a - ab_b, ab_a, zero);
    let corner = not_above!(zero, ab_b) & not_above!(ac_b, ab_b);
    choose!(corner, one, one, zero);
    let corner = not_above!(ab_a, zero) & not_above!(ac_a, zero);
    choose!(corner, one, zero, zero);
    let scale = one / divisor;
    a - (ab.scaled(to_b * scale) + ac.scaled(to_c * scale))
}

/// Returns the weights as in [`in_parallelogram`].
#[inline(always)]
fn in_parallelogram_by_selects<L: Lanes>(a: Vector<L>, b: Vector<L>, c: Vector<L>) -> Vector<L> {
    let zero = a.x.splat(L::Scalar::ZERO);
    let one = a.x.splat(L::Scalar::ONE);
    // The result is the quotient if it lies in [0, 1], otherwise the nearer end; NaN becomes an end.
    macro_rules! clamped {
        ($numerator:expr, $denominator:expr) => {{
            let (numerator, denominator) = ($numerator, $denominator);
            let quotient = numerator / denominator;
            let inside = L::select(denominator.greater(numerator), quotient, one);
            L::select(numerator.greater(zero), inside, zero)
        }};
    }
    let (first, second) = (c - a, a - b);
    let (first_squared, second_squared) = (first.dot(first), second.dot(second));
    let (along_first, along_second) = (first.dot(a), second.dot(a));
    let across = first.dot(second);
    let scale = first_squared * second_squared - across * across;
    let s = clamped!(across * along_second - along_first * second_squared, scale);
    let t = clamped!(across * s + along_second, second_squared);
    let s = clamped!(across * t - along_first, first_squared);
    (a + first.scaled(s)) - second.scaled(t)
}

#[cfg(test)]
mod tests {
    use super::{Feature, closest_of_thin};
    use crate::vector::Vector;

    /// The corners are on either side of the origin along x, 2⁻²⁸ high there, and 2⁻³⁴ above it.
    #[test]
    fn the_closest_point_of_a_thin_hull_is_found_to_the_last_digits() {
        let [thin, above] = [28, 34].map(|exponent| 0.5_f64.powi(exponent));
        let corner = |x: f64, y: f64| Vector::new(x, y, above);
        let triangle = closest_of_thin(&[corner(-1.0, -thin), corner(0.75, -thin), corner(0.5, 2.0 * thin)]);
        let parallelogram = closest_of_thin(&[
            corner(-1.0, -thin),
            corner(0.75, -thin),
            corner(-0.5, 2.0 * thin),
            corner(1.25, 2.0 * thin),
        ]);
        for found in [triangle, parallelogram] {
            assert_eq!(found.feature, Feature::Interior);
            assert!((found.squared_distance.sqrt() - above).abs() < 1e-15, "{found:?}");
        }
    }
}
