//! A step in parts, each free of contact by itself: halved up to four times.
//!
//! The control values of half a step follow from those of the whole by de Casteljau's rule, and enclose the volume four
//! times as closely. A part is clear if they all have one sign there, or if a coordinate axis separates the two sets at
//! both of its ends in the same order (their differences are linear in time). A part that is not clear is halved.
//!
//! A culled pair does not *touch* in [0, 1] (or come within the separation). It may well be coplanar at a time at which an
//! axis separates it: that is the one tier that culls coplanar pairs.
//!
//! # Rounding
//! (Any direction: 2u an operation.) The values are bᵢ = 3k₀, 3k₁, 3k₂, 3k₃. Let E be three times the largest bound of
//! [`coplanarity`](crate::coplanarity#rounding). E bounds the error of bᵢ but for the last addition of kᵢ, which adds 2u·K, and the
//! factor 3, which adds as much, K the largest |bᵢ|. De Casteljau's rule takes means, which keep an error at most; each of its
//! three levels adds 2u·K, halving being exact: 6u·K for one halving, 24u·K for four, 28u·K in all. The test asks for
//! E + 32u·K + η, the rest for second order; a level loses 2λ where subnormal numbers are flushed.
//!
//! A difference of coordinates at time t = i/2ᵈ is (1 − t)·e₀ + t·e₁ of two rounded differences: 3 roundings, 6u of the
//! larger. It must exceed the separation, and the bound's own two sums lose 4u of that; the test asks for 12u, plus the
//! separation, plus η.

use crate::coplanarity::is_in_range;
use crate::lanes::Lanes;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::vector::Vector;

/// How often a step may be halved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Depth {
    /// Into 2 parts.
    One = 1,
    /// Into 4 parts.
    Two = 2,
    /// Into 8 parts.
    Three = 3,
    /// Into 16 parts.
    Four = 4,
}

/// Whether the pair is certainly farther apart than `separation` (or does not touch, if that is zero) in each part of the
/// step. False with NaN, infinite or huge coordinates.
pub(super) fn never_touches<P: PairShape, S: Scalar>(points: &PairPoints<S>, separation: S, depth: Depth) -> bool {
    let tetrahedron = points.tetrahedron::<P>();
    let largest = tetrahedron.largest_by_axis().largest();
    let [k0, k1, k2, k3] = tetrahedron.control_values().0;
    let [e0, e1, e2, e3] = tetrahedron.error_bounds();
    let three = S::small(3);
    let volumes = [three * k0, k1, k2, three * k3];
    let error = (three * e0.larger(e3)).larger(e1.larger(e2));
    let [b0, b1, b2, b3] = volumes.map(Lanes::abs);
    let size = b0.larger(b1).larger(b2.larger(b3));
    let clearance = if separation > S::ZERO {
        three * (separation * tetrahedron.largest_normal(P::KIND))
    } else {
        S::ZERO
    };
    let roundoff = S::small(32) * S::UNIT_ROUNDOFF;
    let step = Step {
        corners: [P::corners(points.start), P::corners(points.end)],
        volume_bound: error + roundoff * size + S::UNDERFLOW + clearance,
        separation,
    };
    // NaN anywhere makes a control value NaN, whose size may drop it: hence the second condition.
    is_in_range(largest)
        && volumes.iter().all(|volume| volume.is_finite())
        && step.is_clear(volumes, [S::ZERO, S::ONE], depth as u8)
}

/// What does not change from part to part.
struct Step<S> {
    corners: [[Vector<S>; 4]; 2],
    volume_bound: S,
    separation: S,
}

impl<S: Scalar> Step<S> {
    /// Whether the part of the step between two times is clear, if need be in its halves. `volumes` are the control values
    /// there.
    fn is_clear(&self, volumes: [S; 4], [from, to]: [S; 2], halvings: u8) -> bool {
        if self.is_flat_nowhere(volumes) || self.an_axis_separates([from, to]) {
            return true;
        }
        let Some(halvings) = halvings.checked_sub(1) else {
            return false;
        };
        let mean = |a: S, b: S| S::HALF * (a + b);
        let [b0, b1, b2, b3] = volumes;
        let (c0, c1, c2) = (mean(b0, b1), mean(b1, b2), mean(b2, b3));
        let (d0, d1) = (mean(c0, c1), mean(c1, c2));
        let middle = mean(d0, d1);
        let half = mean(from, to);
        self.is_clear([b0, c0, d0, middle], [from, half], halvings) && self.is_clear([middle, d1, c2, b3], [half, to], halvings)
    }

    fn is_flat_nowhere(&self, volumes: [S; 4]) -> bool {
        let bound = self.volume_bound;
        volumes.iter().all(|&volume| volume > bound) || volumes.iter().all(|&volume| volume < -bound)
    }

    /// Whether the sets are apart, in the same order, along an axis, at both ends of a part.
    fn an_axis_separates(&self, times: [S; 2]) -> bool {
        self.separates(times, |corner| corner.x)
            || self.separates(times, |corner| corner.y)
            || self.separates(times, |corner| corner.z)
    }

    fn separates(&self, times: [S; 2], along: impl Fn(&Vector<S>) -> S) -> bool {
        let [starts, ends] = &self.corners;
        let (mut ahead, mut behind) = (true, true);
        for (start, end) in starts.iter().zip(ends) {
            let (start, end) = (along(start), along(end));
            let roundoff = S::small(12) * S::UNIT_ROUNDOFF * start.abs().larger(end.abs());
            let bound = roundoff + self.separation + S::UNDERFLOW;
            for time in times {
                let value = (S::ONE - time) * start + time * end;
                ahead &= value > bound;
                behind &= value < -bound;
            }
        }
        ahead || behind
    }
}
