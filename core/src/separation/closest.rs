//! The closest points of a pair at rest, in plain floating point.
//!
//! No certificate relies on their accuracy (Ericson, Real-Time Collision Detection, 2005, 5.1.5 and 5.1.9). One source serves one
//! pair and [many side by side](crate::batch::closest_points).

use crate::kind::PairKind;
use crate::lanes::Lanes;
use crate::points::PairShape;
use crate::vector::Vector;
use glam::DVec3;

/// The shortest vector from the second set of a pair to the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClosestPoints {
    /// The weights of the four points in [`offset`](Self::offset): those of the first set add up to 1, those of the second to −1.
    pub weights: [f64; 4],
    /// The shortest vector, Σ weightᵢ·xᵢ.
    pub offset: DVec3,
    /// The direction of that vector, of length one, perpendicular to the features of the closest points as far as rounding
    /// allows. It is zero if the sets touch.
    pub direction: DVec3,
}

impl ClosestPoints {
    /// Computes the closest points of the pair with these four vertices. The result has no meaning if a point is not finite, or
    /// if products of four lengths overflow. [`closest_points`](crate::batch::closest_points) computes the same for many pairs.
    #[must_use]
    pub fn from_points(kind: PairKind, [p, q, r, s]: [DVec3; 4]) -> Self {
        let points = [vector(p), vector(q), vector(r), vector(s)];
        let found = of_kind!(kind, P => ClosestInLanes::of::<P>(points));
        let [offset, direction] = [found.offset, found.direction].map(|Vector { x, y, z }| DVec3::new(x, y, z));
        Self {
            weights: found.weights,
            offset,
            direction,
        }
    }

    /// Returns the length of that vector.
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.offset.length_squared().sqrt()
    }
}

#[inline(always)]
const fn vector(point: DVec3) -> Vector<f64> {
    Vector::new(point.x, point.y, point.z)
}

/// [`ClosestPoints`] of one pair, or of one in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClosestInLanes<L> {
    pub(crate) weights: [L; 4],
    pub(crate) offset: Vector<L>,
    pub(crate) direction: Vector<L>,
}

impl<L: Lanes<Scalar = f64>> ClosestInLanes<L> {
    #[inline(always)]
    pub(crate) fn of<P: PairShape>(points: [Vector<L>; 4]) -> Self {
        let [p, q, r, s] = points;
        // Differences come first: they are small and nearly exact, wherever the pair is.
        let (weights, offset, sides, count) = match P::KIND {
            PairKind::VertexFace => {
                let weights = of_vertex_face(points);
                let offset = ((q - p).scaled(weights[1]) + (r - p).scaled(weights[2])) + (s - p).scaled(weights[3]);
                let sides = [r - q, s - q];
                (weights, offset, sides, 3)
            }
            PairKind::EdgeEdge => {
                let weights = of_edge_edge(points);
                let offset = ((p - r) + (q - p).scaled(weights[1])) + (s - r).scaled(weights[3]);
                (weights, offset, [q - p, s - r], 2)
            }
        };
        Self {
            weights,
            offset,
            direction: upright(offset, sides, count),
        }
    }
}

/// Returns a direction of length one, perpendicular to `count` sides: the two given, and their difference.
///
/// Where the sets are near each other, the difference of the closest points has lost its digits. Then the features themselves
/// give the normal.
#[inline(always)]
fn upright<L: Lanes<Scalar = f64>>(offset: Vector<L>, [first, second]: [Vector<L>; 2], count: usize) -> Vector<L> {
    let zero = offset.x.splat(0.0);
    let straight = normalized(offset);
    let squared = offset.dot(offset);
    let near = zero.splat(NEAR);
    let is_near = !(squared.greater(first.dot(first) * near) & squared.greater(second.dot(second) * near));
    if !L::any(is_near) {
        return straight;
    }
    let normal = normalized(first.cross(second));
    let along = normal.dot(offset);
    let is_level = (along * along).greater(squared * zero.splat(0.999_998));
    let sign = L::select(zero.greater(along), zero.splat(-1.0), zero.splat(1.0));
    let mut direction = chosen(is_near, normal.scaled(sign), straight);
    let is_on_side = is_near & !is_level;
    if L::any(is_on_side) {
        // This removes the rest along each side.
        let mut left = offset;
        let sides = [first, second, second - first];
        for place in 0..count {
            let side = sides[place];
            let squared = side.dot(side);
            let part = left.dot(side) / squared;
            let is_small = (left.dot(left) * zero.splat(1e-6)).greater((part * part) * squared);
            left = chosen(is_finite(part) & is_small, left - side.scaled(part), left);
        }
        direction = chosen(is_on_side, normalized(left), direction);
    }
    direction
}

/// The square of a thousandth of the pair's size.
const NEAR: f64 = 1e-6;

#[inline(always)]
fn of_vertex_face<L: Lanes<Scalar = f64>>([p, a, b, c]: [Vector<L>; 4]) -> [L; 4] {
    let (zero, one) = (p.x.splat(0.0), p.x.splat(1.0));
    let mut weights = [one, -one, zero, zero];
    // One pair returns where it is settled; several side by side run through all cases.
    macro_rules! settled_if {
        ($is_here:expr, $open:expr, $weights:expr) => {{
            let is_here = $is_here & $open;
            if !L::may_leave(is_here) {
                weights = chosen_weights(is_here, $weights, weights);
            }
            let open = $open & !is_here;
            if L::may_leave(open) {
                return weights;
            }
            open
        }};
    }
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    let open = !(d1.at_most(zero) & d2.at_most(zero));
    if L::may_leave(open) {
        return weights;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    let is_here = zero.at_most(d3) & d4.at_most(d3);
    let open = settled_if!(is_here, open, [one, zero, -one, zero]);
    let vc = d1 * d4 - d3 * d2;
    let is_here = vc.at_most(zero) & zero.at_most(d1) & d3.at_most(zero);
    let open = settled_if!(is_here, open, {
        let v = share(d1, d1 - d3);
        [one, v - one, -v, zero]
    });
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    let is_here = zero.at_most(d6) & d5.at_most(d6);
    let open = settled_if!(is_here, open, [one, zero, zero, -one]);
    let vb = d5 * d2 - d1 * d6;
    let is_here = vb.at_most(zero) & zero.at_most(d2) & d6.at_most(zero);
    let open = settled_if!(is_here, open, {
        let w = share(d2, d2 - d6);
        [one, w - one, zero, -w]
    });
    let va = d3 * d6 - d5 * d4;
    let is_here = va.at_most(zero) & d3.at_most(d4) & d6.at_most(d5);
    let open = settled_if!(is_here, open, {
        let w = share(d4 - d3, (d4 - d3) + (d5 - d6));
        [one, zero, w - one, -w]
    });
    let all = (va + vb) + vc;
    let (v, w) = (share(vb, all), share(vc, all));
    chosen_weights(open, [one, (v + w) - one, -v, -w], weights)
}

#[inline(always)]
fn of_edge_edge<L: Lanes<Scalar = f64>>([a, b, c, d]: [Vector<L>; 4]) -> [L; 4] {
    let (zero, one) = (a.x.splat(0.0), a.x.splat(1.0));
    let (u, v, r) = (b - a, d - c, a - c);
    let (uu, vv, uv) = (u.dot(u), v.dot(v), u.dot(v));
    let (ur, vr) = (u.dot(r), v.dot(r));
    let mut s = clamped(share(uv * vr - ur * vv, uu * vv - uv * uv));
    let mut t = share(uv * s + vr, vv);
    let is_outside = zero.greater(t) | t.greater(one);
    if L::any(is_outside) {
        t = clamped(t);
        s = L::select(is_outside, clamped(share(uv * t - ur, uu)), s);
    }
    [one - s, s, t - one, -t]
}

/// Returns a quotient, or zero where it is not finite.
#[inline(always)]
fn share<L: Lanes<Scalar = f64>>(part: L, whole: L) -> L {
    let share = part / whole;
    L::select(is_finite(share), share, share.splat(0.0))
}

#[inline(always)]
fn is_finite<L: Lanes<Scalar = f64>>(number: L) -> L::Mask {
    number.splat(f64::INFINITY).greater(number.abs())
}

/// Returns the nearest of the numbers from zero to one.
#[inline(always)]
fn clamped<L: Lanes<Scalar = f64>>(number: L) -> L {
    let (zero, one) = (number.splat(0.0), number.splat(1.0));
    let not_less = L::select(zero.greater(number), zero, number);
    L::select(not_less.greater(one), one, not_less)
}

/// Normalises a vector. Returns zero if that is not possible.
#[inline(always)]
fn normalized<L: Lanes<Scalar = f64>>(offset: Vector<L>) -> Vector<L> {
    let zero = offset.x.splat(0.0);
    let factor = offset.x.splat(1.0) / offset.dot(offset).sqrt();
    let is_possible = is_finite(factor) & factor.greater(zero);
    chosen(is_possible, offset.scaled(factor), Vector::new(zero, zero, zero))
}

#[inline(always)]
fn chosen<L: Lanes>(mask: L::Mask, if_true: Vector<L>, if_false: Vector<L>) -> Vector<L> {
    Vector::new(
        L::select(mask, if_true.x, if_false.x),
        L::select(mask, if_true.y, if_false.y),
        L::select(mask, if_true.z, if_false.z),
    )
}

#[inline(always)]
fn chosen_weights<L: Lanes>(mask: L::Mask, [a, b, c, d]: [L; 4], [e, f, g, h]: [L; 4]) -> [L; 4] {
    [
        L::select(mask, a, e),
        L::select(mask, b, f),
        L::select(mask, c, g),
        L::select(mask, d, h),
    ]
}
