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
use crate::lanes::{Lanes, Rounding, roundoffs};
use crate::points::{PairPoints, PairShape};
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

impl<L: Lanes> PairPoints<L> {
    /// Whether the pair is certainly farther apart than `separation` (or does not touch, without one) in each part of the step, on any
    /// number of lanes. False with NaN, infinite or huge coordinates.
    #[must_use]
    pub fn never_touch_in_parts<P: PairShape>(&self, separation: Option<L>, depth: Depth) -> L::Mask {
        let tetrahedron = self.tetrahedron::<P>();
        let largest = tetrahedron.largest_by_axis().largest();
        let constant = |value| largest.splat(value);
        let [k0, k1, k2, k3] = tetrahedron.control_values().0;
        let [e0, e1, e2, e3] = tetrahedron.error_bounds();
        let three = constant(L::Scalar::small(3));
        let volumes = [three * k0, k1, k2, three * k3];
        let error = (three * e0.larger(e3)).larger(e1.larger(e2));
        let [b0, b1, b2, b3] = [volumes[0].abs(), volumes[1].abs(), volumes[2].abs(), volumes[3].abs()];
        let size = b0.larger(b1).larger(b2.larger(b3));
        let bound = error + roundoffs(size, 32) * size + constant(L::Scalar::UNDERFLOW);
        let step = Step {
            corners: [P::corners(self.start), P::corners(self.end)],
            volume_bound: match separation {
                Some(separation) => bound + three * (separation * tetrahedron.largest_normal(P::KIND)),
                None => bound,
            },
            separation,
        };
        // NaN anywhere makes a control value NaN, whose size may drop it: hence the second condition.
        let infinity = constant(L::Scalar::INFINITY);
        let finite = (infinity.greater(b0) & infinity.greater(b1)) & (infinity.greater(b2) & infinity.greater(b3));
        let whole_step = [constant(L::Scalar::ZERO), constant(L::Scalar::ONE)];
        and_then::<L>(is_in_range(largest) & finite, || {
            step.is_clear(volumes, whole_step, depth as u8)
        })
    }
}

/// Both, where the second is only asked if some lane needs it.
#[inline(always)]
fn and_then<L: Lanes>(mask: L::Mask, second: impl FnOnce() -> L::Mask) -> L::Mask {
    if L::any(mask) { mask & second() } else { mask }
}

/// One of them or both, where the second is only asked if some lane needs it.
#[inline(always)]
fn or_else<L: Lanes>(mask: L::Mask, second: impl FnOnce() -> L::Mask) -> L::Mask {
    if L::any(!mask) { mask | second() } else { mask }
}

/// What does not change from part to part.
struct Step<L> {
    corners: [[Vector<L>; 4]; 2],
    volume_bound: L,
    separation: Option<L>,
}

impl<L: Lanes> Step<L> {
    /// Whether the part of the step between two times is clear, if need be in its halves. `volumes` are the control values
    /// there.
    fn is_clear(&self, volumes: [L; 4], [from, to]: [L; 2], halvings: u8) -> L::Mask {
        let clear = or_else::<L>(self.is_flat_nowhere(volumes), || self.an_axis_separates([from, to]));
        let Some(halvings) = halvings.checked_sub(1) else {
            return clear;
        };
        or_else::<L>(clear, || {
            let mean = |a: L, b: L| a.splat(L::Scalar::HALF) * (a + b);
            let [b0, b1, b2, b3] = volumes;
            let (c0, c1, c2) = (mean(b0, b1), mean(b1, b2), mean(b2, b3));
            let (d0, d1) = (mean(c0, c1), mean(c1, c2));
            let middle = mean(d0, d1);
            let half = mean(from, to);
            let first = self.is_clear([b0, c0, d0, middle], [from, half], halvings);
            and_then::<L>(first, || self.is_clear([middle, d1, c2, b3], [half, to], halvings))
        })
    }

    fn is_flat_nowhere(&self, [b0, b1, b2, b3]: [L; 4]) -> L::Mask {
        let (above, below) = (self.volume_bound, -self.volume_bound);
        ((b0.greater(above) & b1.greater(above)) & (b2.greater(above) & b3.greater(above)))
            | ((below.greater(b0) & below.greater(b1)) & (below.greater(b2) & below.greater(b3)))
    }

    /// Whether the sets are apart, in the same order, along an axis, at both ends of a part.
    fn an_axis_separates(&self, times: [L; 2]) -> L::Mask {
        let along_x = self.separates(times, |corner| corner.x);
        let along_x_or_y = or_else::<L>(along_x, || self.separates(times, |corner| corner.y));
        or_else::<L>(along_x_or_y, || self.separates(times, |corner| corner.z))
    }

    fn separates(&self, times: [L; 2], along: impl Fn(&Vector<L>) -> L) -> L::Mask {
        let [starts, ends] = &self.corners;
        let sides = |corner: usize| self.sides_of(along(&starts[corner]), along(&ends[corner]), times);
        let [a, b, c, d] = [sides(0), sides(1), sides(2), sides(3)];
        let on_side = |side: usize| (a[side] & b[side]) & (c[side] & d[side]);
        on_side(0) | on_side(1)
    }

    /// Whether a corner's component is certainly ahead at both times, or behind.
    fn sides_of(&self, start: L, end: L, [from, to]: [L; 2]) -> [L::Mask; 2] {
        let roundoff = roundoffs(start, 12) * start.abs().larger(end.abs());
        let bound = match self.separation {
            Some(separation) => roundoff + separation,
            None => roundoff,
        };
        let bound = bound + bound.splat(L::Scalar::UNDERFLOW);
        let at = |time: L| (time.splat(L::Scalar::ONE) - time) * start + time * end;
        let (first, last) = (at(from), at(to));
        [
            first.greater(bound) & last.greater(bound),
            (-bound).greater(first) & (-bound).greater(last),
        ]
    }
}
