//! When are four moving points coplanar? The signed volume as a cubic, and how far rounding can move it.
//!
//! # The cubic
//! Four points a, b, c, p move linearly. With B = b − a, C = c − a, P = p − a the signed volume
//! K(t) = P(t) · (B(t) × C(t)) is zero exactly when they are coplanar. It is a cubic in t, in Bernstein form
//! k₀(1−t)³ + 3k₁(1−t)²t + 3k₂(1−t)t² + k₃t³. With n₀ = B₀×C₀, n₁ = B₁×C₁ and h = B₀×C₁ + B₁×C₀
//!
//! ```text
//!  k₀ = P₀·n₀          3k₁ = P₀·h + P₁·n₀
//!  k₃ = P₁·n₁          3k₂ = P₁·h + P₀·n₁
//! ```
//!
//! the polar form (blossom) of the triple product. The paper's equation (14) has n₀ + n₁ − (v_b − v_a)×(v_c − v_a)
//! in place of h: the same in exact arithmetic, but it cancels, and its rounding error is not bounded by the
//! magnitudes that bound ours. Only [`filter::plain`](crate::filter::plain) uses it.
//!
//! K lies in the convex hull of its control values: if all four are positive, or all four negative, K has no root in [0, 1].
//! VF and EE share one kernel because the volume does not depend on which of the four points is the base.
//!
//! # Rounding
//! u is the unit roundoff. Let P̂ᵢ be the expression of kᵢ in the same order with magnitudes for components and
//! additions for subtractions (its *permanent*). A monomial of k₀ or k₃ passes through 3 differences, a product,
//! a subtraction, a product and 2 additions: 8 roundings. One of 3k₁ or 3k₂ passes through one addition more in h
//! and one more at the end: 10. The last of them does not count for the sign: rounding is monotone, so a computed
//! kᵢ = fl(x) above Eᵢ, a floating-point number, proves x > Eᵢ. That leaves 7 and 9, and one u for all that is of
//! second order, the powers of 1 + u and what P̂ᵢ and Eᵢ lose by being rounded as well:
//! 8u(1 − u)⁹ ≥ (1 + u)⁷ − 1 and 10u(1 − u)¹² ≥ (1 + u)⁹ − 1 hold for u ≤ 2⁻⁸. Hence
//!
//! ```text
//!  kᵢ (computed) > Eᵢ proves kᵢ > 0,   Eᵢ = Cᵢ·P̂ᵢ + (p_max + 1)·η,   C₀ = C₃ = 8u,   C₁ = C₂ = 10u (for 3k₁, 3k₂)
//! ```
//!
//! and the same below −Eᵢ.
//!
//! **Underflow.** Additions and subtractions are exact when their result is subnormal. Each product loses at most
//! half of the smallest subnormal, η₀ = 2⁻¹⁰⁷⁵ (`f64`) or 2⁻¹⁵⁰ (`f32`); with p_max the largest component of P₀ and
//! P₁ the sum is at most (6·p_max + 3)·η₀ for k₀ and (18·p_max + 6)·η₀ for 3k₁. 32·(p_max + 1)·η₀ covers it and the
//! rounding of E; η ([`Rounding::UNDERFLOW`]) is larger, for speed.
//!
//! **Overflow and NaN.** P̂ is at least as large as every intermediate result, so whatever overflows makes Eᵢ infinite
//! or NaN, and the ordered comparisons that decide are false.

use crate::lanes::{Lanes, Rounding};
use crate::vector::Vector;

/// A moving tetrahedron a b c p, as its three edges from a, each at the start and at the end of the step.
#[derive(Clone, Copy, Debug)]
pub struct MovingTetrahedron<L> {
    /// b − a at times 0 and 1.
    pub b: [Vector<L>; 2],
    /// c − a at times 0 and 1.
    pub c: [Vector<L>; 2],
    /// p − a at times 0 and 1.
    pub p: [Vector<L>; 2],
}

/// The control values k₀, 3k₁, 3k₂, k₃ of the signed volume (the middle ones tripled, which saves a rounded division
/// and changes no sign).
#[derive(Clone, Copy, Debug)]
pub struct ControlValues<L>(pub [L; 4]);

impl<L: Lanes> MovingTetrahedron<L> {
    /// Differences of the four points a, b, c, p at the start and at the end; each is rounded once.
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

    /// The control values, in blossom form, rounded. [`error_bounds`](Self::error_bounds) says by how much.
    #[inline(always)]
    #[must_use]
    pub fn control_values(&self) -> ControlValues<L> {
        let ([b0, b1], [c0, c1], [p0, p1]) = (self.b, self.c, self.p);
        let (n0, n1) = (b0.cross(c0), b1.cross(c1));
        let h = b0.cross(c1) + b1.cross(c0);
        ControlValues([
            p0.dot(n0),
            p0.dot(h) + p1.dot(n0),
            p1.dot(h) + p0.dot(n1),
            p1.dot(n1),
        ])
    }

    /// Eᵢ of the module's documentation: a computed control value above Eᵢ (below −Eᵢ) proves that the exact one is
    /// positive (negative). Infinite or NaN on overflow.
    #[inline(always)]
    #[must_use]
    pub fn error_bounds(&self) -> [L; 4] {
        let ([b0, b1], [c0, c1], [p0, p1]) = (self.b, self.c, self.p);
        let (b0, b1, c0, c1) = (b0.abs(), b1.abs(), c0.abs(), c1.abs());
        let (p0, p1) = (p0.abs(), p1.abs());
        let (n0, n1) = (b0.cross_permanent(c0), b1.cross_permanent(c1));
        let h = b0.cross_permanent(c1) + b1.cross_permanent(c0);

        let one = p0.x.splat(L::Scalar::ONE);
        let roundoff = p0.x.splat(L::Scalar::UNIT_ROUNDOFF);
        let outer = roundoff * p0.x.splat(L::Scalar::small(8));
        let inner = roundoff * p0.x.splat(L::Scalar::small(10));
        let p_max = p0.larger(p1).largest();
        let underflow = (p_max + one) * p0.x.splat(L::Scalar::UNDERFLOW);
        [
            outer * p0.dot(n0) + underflow,
            inner * (p0.dot(h) + p1.dot(n0)) + underflow,
            inner * (p1.dot(h) + p0.dot(n1)) + underflow,
            outer * p1.dot(n1) + underflow,
        ]
    }
}

impl<L: Lanes> ControlValues<L> {
    /// All four above `bounds`, or all four below their negatives. False with NaN.
    #[inline(always)]
    #[must_use]
    pub fn one_sign_beyond(&self, bounds: [L; 4]) -> L::Mask {
        let [k0, k1, k2, k3] = self.0;
        let [e0, e1, e2, e3] = bounds;
        // Eight ordered comparisons rather than a smallest and a largest value: a comparison is false on NaN,
        // while the vector minimum of most machines drops it.
        let above = (k0.greater(e0) & k1.greater(e1)) & (k2.greater(e2) & k3.greater(e3));
        let below =
            ((-e0).greater(k0) & (-e1).greater(k1)) & ((-e2).greater(k2) & (-e3).greater(k3));
        above | below
    }
}
