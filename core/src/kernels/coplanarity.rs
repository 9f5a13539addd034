//! The signed volume of four moving points as a cubic, and a bound of its rounding error.
//!
//! # The cubic
//! Four points a, b, c, p move linearly. With B = b − a, C = c − a, P = p − a, the signed volume K(t) = P(t) · (B(t) × C(t)) is
//! zero exactly when they are coplanar. It is a cubic in t, in Bernstein form k₀(1−t)³ + 3k₁(1−t)²t + 3k₂(1−t)t² + k₃t³. With n₀
//! = B₀×C₀, n₁ = B₁×C₁ and h = B₀×C₁ + B₁×C₀
//!
//! ```text
//!  k₀ = P₀·n₀          3k₁ = P₀·h + P₁·n₀
//!  k₃ = P₁·n₁          3k₂ = P₁·h + P₀·n₁
//! ```
//!
//! This is the polar form (blossom) of the triple product. The paper's equation (14) has n₀ + n₁ − (v_b − v_a)×(v_c − v_a) in
//! place of h. In exact arithmetic they are equal, but that form cancels, and the magnitudes that bound our rounding error do not
//! bound its error.
//!
//! K lies in the convex hull of its control values: if all four are positive, or all four negative, K has no root in [0, 1]. VF
//! and EE share one kernel because the volume does not depend on the choice of the base point.
//!
//! # Rounding
//! u is the unit roundoff. An operation rounds by at most 2u times its result (u to nearest, but any direction is allowed). Let
//! P̂ᵢ be the *permanent* of kᵢ: its expression in the same order, with magnitudes for components and additions for subtractions.
//! A monomial of k₀ or k₃ passes through 3 differences, a product, a subtraction, a product and 2 additions: 8 roundings. One of
//! 3k₁ or 3k₂ passes through one more addition in h and one at the end: 10.
//!
//! The last rounding does not count for the sign. Rounding is monotone, so a computed kᵢ = fl(x) above Eᵢ, a floating-point
//! number, proves x > Eᵢ. That leaves 7 and 9 roundings of 2u. Another 2u covers the second order, the powers of 1 + 2u, and the
//! rounding of P̂ᵢ and Eᵢ: 16u(1 − 2u)¹⁰ ≥ (1 + 2u)⁷ − 1 holds for u ≤ 2⁻⁸, and 20u(1 − 2u)¹³ ≥ (1 + 2u)⁹ − 1 for u ≤ 2⁻⁹. Hence
//!
//! ```text
//!  kᵢ (computed) > Eᵢ proves kᵢ > 0,   Eᵢ = Cᵢ·P̂ᵢ + (1 + M)²·η,   C₀ = C₃ = 16u,   C₁ = C₂ = 20u (for 3k₁, 3k₂)
//! ```
//!
//! The same holds below −Eᵢ. M is the largest magnitude of a component of B, C and P. Gappa proves these constants, and those of
//! all other bounds, for both formats, and Coq accepts the proofs: `verification/gappa`.
//!
//! **Without the permanent.** Each monomial is at most Mx·My·Mz, the product of the largest magnitudes along each axis
//! ([`largest_by_axis`](MovingTetrahedron::largest_by_axis)). There are 6 monomials in k₀ and 18 in 3k₁. So 96u or 384u times the
//! product may replace Cᵢ·P̂ᵢ: 96u(1 − 2u)⁵ ≥ 6((1 + 2u)⁷ − 1)/(1 − 2u)³ and 384u(1 − 2u)⁵ ≥ 18((1 + 2u)⁹ − 1)/(1 − 2u)³ hold for
//! u ≤ 2⁻¹⁰. (The quotients: the product is one of computed differences, and the error's monomials are those of exact ones.)
//!
//! **Underflow.** Let λ be the smallest normal number. Where a thread flushes subnormal numbers to zero, an operation loses at
//! most λ, and operands below λ vanish. A difference is then off by at most 3λ (two operands and the result). The two other
//! factors of each of 18 monomials multiply it: 162·M²·λ. Products and sums in n and h lose 30·M·λ, those of the dot products
//! 11·λ. Together this is at most 162·(1 + M)²·λ in 3k₁, and less in the others. η ([`Rounding::UNDERFLOW`]) is at least 512·λ,
//! which also covers the second order and the loss of the bound itself. Where subnormal numbers are kept, sums with a subnormal
//! result are exact, and products lose far less.
//!
//! **Overflow and NaN.** Only pairs with M < [`Rounding::LARGEST_EDGE`] are culled, so no intermediate result overflows. NaN
//! makes a control value NaN, and the ordered comparisons that decide are then false.
//!
//! # Distance
//! |K(t)| is the distance of p from the plane of a, b, c times |n(t)|, n = B × C. For edges (b, c) and (a, p), it is the distance
//! of their lines times |n(t)|, n = (C − B) × P. In Bernstein form n has the control points n₀, h/2, n₁, built from the two
//! factors, and lies in their hull: |n(t)| ≤ N, the largest of their lengths. If all kᵢ > s·N, or all are below −s·N, the pair
//! stays farther apart than s throughout.
//!
//! The computed length becomes a bound of N as follows. A component of C − B, rounded twice from rounded differences, is off by
//! at most 8u·M; for VF a factor is off by less. A component of n₀ is off by 2·(8u + 4u + 8u)·M² = 40u·M². One of h/2 is off by
//! as much and 8u·M² for one more sum. That is 64u·M² with second order, times √3 < 2 for the vector: 128u·M². Squares that
//! underflow lose less than η together, which is added under the root. 1 + 32u covers the dozen roundings from there to the
//! comparison.

use crate::PairKind;
use crate::lanes::{Lanes, Rounding};
use crate::vector::Vector;

/// A moving tetrahedron a b c p, given by its three edges from a, each at the start and at the end of the step.
#[derive(Clone, Copy, Debug)]
pub struct MovingTetrahedron<L> {
    /// The edge b − a at times 0 and 1.
    pub b: [Vector<L>; 2],
    /// The edge c − a at times 0 and 1.
    pub c: [Vector<L>; 2],
    /// The edge p − a at times 0 and 1.
    pub p: [Vector<L>; 2],
}

/// The control values k₀, 3k₁, 3k₂, k₃ of the signed volume. Tripling the middle ones saves a rounded division and changes no
/// sign.
#[derive(Clone, Copy, Debug)]
pub struct ControlValues<L>(pub [L; 4]);

/// The decision from control values and their error bounds, for each lane's pair. A pair in neither mask is undecided.
#[derive(Clone, Copy, Debug)]
pub struct Decision<M> {
    /// The pairs whose values are all beyond their bounds, with one sign.
    pub culled: M,
    /// The pairs that no sharper bound can cull. Two values are beyond their bounds with opposite signs, or all are zero since
    /// the pair has no extent along an axis.
    pub settled: M,
}

impl<L: Lanes> MovingTetrahedron<L> {
    /// Takes the differences of the four points a, b, c, p at the start and at the end; each is rounded once.
    #[inline(always)]
    #[must_use]
    pub fn from_points(start: [Vector<L>; 4], end: [Vector<L>; 4]) -> Self {
        let ([a0, b0, c0, p0], [a1, b1, c1, p1]) = (start, end);
        Self {
            b: [b0 - a0, b1 - a1],
            c: [c0 - a0, c1 - a1],
            p: [p0 - a0, p1 - a1],
        }
    }

    /// Returns the control values, in blossom form, rounded. [`error_bounds`](Self::error_bounds) bounds the error.
    #[inline(always)]
    #[must_use]
    pub fn control_values(&self) -> ControlValues<L> {
        let [p0, p1] = self.p;
        let [n0, h, n1] = products(self.b, self.c);
        ControlValues([p0.dot(n0), p0.dot(h) + p1.dot(n0), p1.dot(h) + p0.dot(n1), p1.dot(n1)])
    }

    /// Returns the largest magnitude along each axis, over the six differences. NaN may be dropped.
    #[inline(always)]
    #[must_use]
    pub fn largest_by_axis(&self) -> Vector<L> {
        let ([b0, b1], [c0, c1], [p0, p1]) = (self.b, self.c, self.p);
        let (b, c, p) = (
            b0.abs().larger(b1.abs()),
            c0.abs().larger(c1.abs()),
            p0.abs().larger(p1.abs()),
        );
        b.larger(c).larger(p)
    }

    /// Returns the error bound Eᵢ of control value i, by the permanent. A computed control value above Eᵢ (below −Eᵢ) proves that
    /// the exact one is positive (negative), provided that [`largest_by_axis`](Self::largest_by_axis) is [in range](is_in_range).
    #[inline(always)]
    #[must_use]
    pub fn error_bounds(&self) -> [L; 4] {
        let ([b0, b1], [c0, c1], [p0, p1]) = (self.b, self.c, self.p);
        let (b0, b1, c0, c1) = (b0.abs(), b1.abs(), c0.abs(), c1.abs());
        let (p0, p1) = (p0.abs(), p1.abs());
        let (n0, n1) = (b0.cross_permanent(c0), b1.cross_permanent(c1));
        let h = b0.cross_permanent(c1) + b1.cross_permanent(c0);

        let roundoff = p0.x.splat(L::Scalar::UNIT_ROUNDOFF);
        let outer = roundoff * p0.x.splat(L::Scalar::small(16));
        let inner = roundoff * p0.x.splat(L::Scalar::small(20));
        let underflow = underflow(self.largest_by_axis().largest());
        [
            outer * p0.dot(n0) + underflow,
            inner * (p0.dot(h) + p1.dot(n0)) + underflow,
            inner * (p1.dot(h) + p0.dot(n1)) + underflow,
            outer * p1.dot(n1) + underflow,
        ]
    }

    /// Returns a bound N of the length of the normal throughout the step, rounding included. For VF it is the normal of the plane
    /// through a, b, c, for EE that of the directions b–c and a–p. See [Distance](self#distance). Requires
    /// [`largest_by_axis`](Self::largest_by_axis) to be [in range](is_in_range).
    #[inline(always)]
    #[must_use]
    pub fn largest_normal(&self, kind: PairKind) -> L {
        let ([b0, b1], [c0, c1]) = (self.b, self.c);
        let [n0, h, n1] = match kind {
            PairKind::VertexFace => products(self.b, self.c),
            PairKind::EdgeEdge => products([c0 - b0, c1 - b1], self.p),
        };
        let largest = self.largest_by_axis().largest();
        let constant = |value| largest.splat(value);
        let half = constant(L::Scalar::HALF);
        let squared = n0.dot(n0).larger(half * (half * h.dot(h))).larger(n1.dot(n1));
        let roundoff = constant(L::Scalar::UNIT_ROUNDOFF);
        let length = (squared + constant(L::Scalar::UNDERFLOW)).sqrt();
        let slack = constant(L::Scalar::ONE) + constant(L::Scalar::small(32)) * roundoff;
        let rounding = constant(L::Scalar::small(128)) * roundoff;
        (length + rounding * (largest * largest)) * slack
    }
}

/// Returns the error bound of k₀ and k₃ without the permanent; the bound of 3k₁ and 3k₂ is four times that. `largest` is
/// [`MovingTetrahedron::largest_by_axis`].
#[inline(always)]
#[must_use]
pub fn error_bound_by_magnitudes<L: Lanes>(largest: Vector<L>) -> L {
    let constant = L::Scalar::small(96);
    let roundoff = largest.x.splat(L::Scalar::UNIT_ROUNDOFF) * largest.x.splat(constant);
    roundoff * (largest.x * largest.y * largest.z) + underflow(largest.largest())
}

/// Returns whether the largest magnitude `largest` is below [`Rounding::LARGEST_EDGE`], so that nothing overflows.
#[inline(always)]
#[must_use]
pub fn is_in_range<L: Lanes>(largest: L) -> L::Mask {
    largest.splat(L::Scalar::LARGEST_EDGE).greater(largest)
}

/// Returns zero, or NaN if a value is infinite or NaN; no value exceeds a bound to which NaN was added. The smallest and the
/// largest value do not show NaN, since the vector minimum of most machines drops it. Values near the largest number may count as
/// infinite, as their sum may be.
#[inline(always)]
pub(crate) fn zero_if_finite<L: Lanes>([a, b, c, d]: [L; 4]) -> L {
    let sum = (a + b) + (c + d);
    #[allow(clippy::eq_op, reason = "infinity minus infinity is not a number")]
    let zero = sum - sum;
    zero
}

/// Returns (1 + M)²·η.
#[inline(always)]
fn underflow<L: Lanes>(largest: L) -> L {
    let more = largest + largest.splat(L::Scalar::ONE);
    more * more * more.splat(L::Scalar::UNDERFLOW)
}

/// Returns the control points n₀, h, n₁ of the cross product of two moving vectors. The middle one is doubled.
#[inline(always)]
fn products<L: Lanes>([b0, b1]: [Vector<L>; 2], [c0, c1]: [Vector<L>; 2]) -> [Vector<L>; 3] {
    [b0.cross(c0), b0.cross(c1) + b1.cross(c0), b1.cross(c1)]
}

impl<L: Lanes> ControlValues<L> {
    /// Returns whether all four values are above `bounds`, or all four below their negatives. It is false with NaN.
    #[inline(always)]
    #[must_use]
    pub fn one_sign_beyond(&self, bounds: [L; 4]) -> L::Mask {
        let [k0, k1, k2, k3] = self.0;
        let [e0, e1, e2, e3] = bounds;
        // Eight ordered comparisons are used instead of a smallest and a largest value: a comparison is false on NaN, while the
        // vector minimum of most machines drops it.
        let above = (k0.greater(e0) & k1.greater(e1)) & (k2.greater(e2) & k3.greater(e3));
        let below = ((-e0).greater(k0) & (-e1).greater(k1)) & ((-e2).greater(k2) & (-e3).greater(k3));
        above | below
    }
}

#[cfg(test)]
mod tests {
    use super::zero_if_finite;

    #[test]
    fn whatever_is_not_finite_shows_and_what_is_does_not() {
        assert_eq!(zero_if_finite([1e300, -1e300, 1e-300, 1e300]), 0.0);
        assert_eq!(zero_if_finite([1e300_f64; 4]), 0.0);
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for place in 0..4 {
                let mut values = [1.0; 4];
                values[place] = value;
                assert!(zero_if_finite(values).is_nan(), "{value} in place {place}");
            }
        }
    }
}
