//! Exact signs of the signed volume's control values, exact comparison with a separation, and the exact verdict of contact.
//!
//! This is for pairs that floating point leaves undecided, and for comparison with everything else. [`touches`] decides contact;
//! its file (`contact`) explains how. The other functions decide whether the control values k₀, 3k₁, 3k₂, k₃ of
//! [`coplanarity`](crate::coplanarity) have one strict sign. Then the four points are never coplanar in [0, 1]. The converse does
//! not hold: the volume may have no root although signs differ.
//!
//! # Whole numbers
//! A finite floating-point number is a whole number times a power of two. Each monomial of the volume has one factor along x, one
//! along y and one along z. So the eight coordinates along an axis can have their own unit, the largest power of two that divides
//! all of them, and no sign changes. The rest is addition and multiplication of whole numbers. It takes the narrowest of a few
//! fixed widths for which `kernel` shows that nothing overflows:
//!
//! | 64-bit words a coordinate | bits along an axis, from the highest set in any of the eight coordinates to the lowest set | serves |
//! |---|---|---|
//! | 1 | 61 | `f32` and `f64` of everyday sizes |
//! | 2 | 125 | `f64` with some coordinates near zero |
//! | 5 | 317 | all of `f32`, which has 277 |
//! | 33 | 2,109 | all of `f64`, which has 2,098 |
//!
//! A call takes time and stack only for the width that its pair needs. On x86-64 that is at most 7 kB of stack for the first
//! three, and 35 kB for all of `f64`. There numbers are slices of one space, each of as many words as it needs.
//!
//! No operation is in floating point. So the answers are exact for every finite input, subnormal and largest numbers included, in
//! every floating-point environment. (The usual method, Shewchuk's expansions, is exact only when rounding to nearest. In `f64`
//! it also needs products that neither underflow nor overflow.)
//!
//! # Separation
//! With p, b, c as below and n = b × c, the distance of the vertex from the face's plane, or of the two edges' lines, is
//! |K| / |n|:
//!
//! | | b | c | p |
//! |---|---|---|---|
//! | VF | second corner − first | third corner − first | vertex − first corner |
//! | EE, (u, v) and (k, l) | v − u | l − k | u − k |
//!
//! (For EE this is the volume of `coplanarity`: p · ((v − u) × (l − k)) = (l − k) · ((u − k) × (v − k)).) K = p · n is a cubic, n
//! is quadratic with the control points n₀, h/2, n₁; as a cubic it has n₀, (n₀ + h)/3, (h + n₁)/3, n₁. The Bernstein polynomials
//! Bᵢ are not negative, so K − s·|n| ≥ Σ Bᵢ·(kᵢ − s·|nᵢ|), and four conditions prove the distance greater than s throughout:
//!
//! ```text
//!  |k₀| > s·|n₀|,   |3k₁| > s·|n₀ + h|,   |3k₂| > s·|h + n₁|,   |k₃| > s·|n₁|,   all four k of one sign
//! ```
//!
//! |n₀ + h| is at most 3·max(|n₀|, |h|/2), so each condition is at least as easily met as with the largest normal for all four.
//!
//! Both sides are squared, which leaves sums and products. These are bounded with 64 bits and a separate exponent (`magnitude`),
//! again without floating point: kᵢ² from below, s²·|nᵢ|² from above. Each step is off by less than 2⁻⁶³ of its value. To cut and
//! square kᵢ costs 3 · 2⁻⁶³ of its square. To round a component of nᵢ, square it and add twice costs 5 · 2⁻⁶³ (a square counts
//! its operand's step twice). To square s and multiply costs 2 · 2⁻⁶³. So a pair is culled whenever |kᵢ| > s·|nᵢ|·(1 + 2⁻⁶⁰), and
//! never when |kᵢ| ≤ s·|nᵢ| for some i. With s = 0 the answer is exact.

mod aligned;
mod contact;
mod integer;
mod kernel;
mod magnitude;

pub use contact::touches;

use crate::coplanarity::ControlValues;
use crate::motion::PrimitivePair;
use crate::scalar::Scalar;
use aligned::{AlignedPair, Units};
use core::cmp::Ordering;
use core::ops::ControlFlow;
use integer::{Space, Whole, Words};
use kernel::{Arithmetic, Fixed, Judge, Width, control_values};
use magnitude::{Bound, Magnitude};

/// The evidence of an exact verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Evidence {
    /// The floating-point proof of the time of impact that the sets stay apart.
    Separation,
    /// The floating-point proof that one set passes through the other.
    Crossing,
    /// Arithmetic in whole numbers.
    WholeNumbers,
    /// There is no evidence, since the input is not finite.
    Nothing,
}

/// The known signs of the control values k₀, 3k₁, 3k₂, k₃.
pub type KnownSigns = [Option<Ordering>; 4];

/// No sign is known.
pub const UNKNOWN: KnownSigns = [None; 4];

/// Returns the signs that rounded control values prove: those of values beyond `bounds`, their
/// [`error_bounds`](crate::coplanarity::MovingTetrahedron::error_bounds).
///
/// ```
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// use selvedge_core::kernels::{coplanarity::MovingTetrahedron, exact};
/// // A vertex that rests 2⁻⁶⁰ above the face at first: floating point sees only where it goes.
/// let height = DVec3::new(0.0, 0.0, 1.0 / (1_u64 << 60) as f64);
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(height, height + DVec3::Z),
///     [DVec3::new(-1.0, -1.0, -0.1), DVec3::new(1.0, 0.0, 0.1), DVec3::new(0.0, 1.0, 0.0)].map(Motion::resting),
/// );
/// let tetrahedron = MovingTetrahedron::from(&pair);
/// let known = exact::certain_signs(&tetrahedron.control_values(), tetrahedron.error_bounds());
/// assert_eq!(known.map(|sign| sign.is_some()), [false, true, true, true]);
/// assert!(exact::is_never_coplanar(&pair, known));
/// ```
#[inline(always)]
#[must_use]
pub fn certain_signs<S: Scalar>(values: &ControlValues<S>, bounds: [S; 4]) -> KnownSigns {
    let ([k0, k1, k2, k3], [e0, e1, e2, e3]) = (values.0, bounds);
    let certain = |value: S, bound: S| {
        if value > bound {
            Some(Ordering::Greater)
        } else if value < -bound {
            Some(Ordering::Less)
        } else {
            None
        }
    };
    [certain(k0, e0), certain(k1, e1), certain(k2, e2), certain(k3, e3)]
}

/// Compares the control values k₀, 3k₁, 3k₂, k₃ of the pair's signed volume with zero.
///
/// The result is exact, in every floating-point environment. It is `None` if a coordinate is NaN or infinite.
///
/// ```
/// use core::cmp::Ordering::{Equal, Greater, Less};
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// use selvedge_core::kernels::exact;
/// // A vertex that starts 1e-300 above a triangle and falls by 1e300.
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.2, 1e-300), DVec3::new(0.2, 0.2, -1e300)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// let signs = exact::control_value_signs(&pair);
/// assert_eq!(signs, Some([Greater, Less, Less, Less]));
/// ```
#[must_use]
pub fn control_value_signs<S: Scalar>(pair: &PrimitivePair<S>) -> Option<[Ordering; 4]> {
    AlignedPair::new(pair).map(|pair| signs(&pair))
}

fn signs(pair: &AlignedPair) -> [Ordering; 4] {
    match Width::of(pair) {
        Width::Words1 => signs_by(pair, &mut Fixed::<1, 2, 3>),
        Width::Words2 => signs_by(pair, &mut Fixed::<2, 4, 6>),
        Width::Words5 => signs_by(pair, &mut Fixed::<5, 10, 15>),
        Width::Words33 => signs_in_space(pair),
    }
}

/// It is out of line, so that a call pays for the stack of its own width only.
#[inline(never)]
fn signs_by<A: Arithmetic>(pair: &AlignedPair, arithmetic: &mut A) -> [Ordering; 4] {
    let coordinates = arithmetic.coordinates(pair);
    control_values(pair.kind, &coordinates, arithmetic).map(|value| value.sign())
}

#[inline(never)]
fn signs_in_space(pair: &AlignedPair) -> [Ordering; 4] {
    signs_by(pair, &mut Space::new(&mut [0; kernel::space(33)]))
}

/// Returns true exactly if all four control values are positive, or all four negative. True proves that the four points are not
/// coplanar at any time in [0, 1].
///
/// The result is exact, in every floating-point environment; false if a coordinate is NaN or infinite. Signs in `known` must be
/// right, and are not computed again; pass [`UNKNOWN`] if there are none. The computation stops as soon as two signs differ.
#[must_use]
pub fn is_never_coplanar<S: Scalar>(pair: &PrimitivePair<S>, known: KnownSigns) -> bool {
    one_sign(pair, known, Magnitude::ZERO)
}

/// Returns true if all four control values have one sign and are far enough from zero. This proves that the vertex and the face's
/// plane, or the two edges' lines, are more than `separation` apart at every time in [0, 1].
///
/// The result is certified in every floating-point environment, and exact up to a relative 2⁻⁶⁰ of the separation (see the
/// module's documentation). With `separation` 0 it is the same as [`is_never_coplanar`]. It is false if a coordinate is NaN or
/// infinite, or if `separation` is NaN, infinite or negative.
///
/// A sign in `known` asserts that this control value has it and exceeds the separation times the length of its normal; it is not
/// computed again.
///
/// ```
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// use selvedge_core::kernels::exact;
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.2, 2.0), DVec3::new(0.2, 0.2, 1.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// let apart = |separation| exact::is_never_within(&pair, separation, exact::UNKNOWN);
/// assert!(apart(1.0_f64.next_down()));
/// assert!(!apart(1.0));
/// ```
#[must_use]
pub fn is_never_within<S: Scalar>(pair: &PrimitivePair<S>, separation: S, known: KnownSigns) -> bool {
    let Some(separation) = aligned::length(separation) else {
        return false;
    };
    one_sign(pair, known, separation.squared(Bound::Upper))
}

#[inline(always)]
fn one_sign<S: Scalar>(pair: &PrimitivePair<S>, known: KnownSigns, squared_separation: Magnitude) -> bool {
    let mut one_sign = OneSign {
        known,
        common: None,
        units: Units([0; 3]),
        squared_separation,
    };
    for sign in known.into_iter().flatten() {
        if one_sign.adopt(sign).is_break() {
            return false;
        }
    }
    AlignedPair::new(pair).is_some_and(|pair| one_sign.passes(&pair))
}

/// A judge that stops at the first control value that does not have the others' strict sign, or is not beyond the separation.
struct OneSign {
    known: KnownSigns,
    common: Option<Ordering>,
    units: Units,
    squared_separation: Magnitude,
}

impl OneSign {
    #[inline(always)]
    fn adopt(&mut self, sign: Ordering) -> ControlFlow<()> {
        if sign.is_eq() || self.common.is_some_and(|common| common != sign) {
            return ControlFlow::Break(());
        }
        self.common = Some(sign);
        ControlFlow::Continue(())
    }
}

impl OneSign {
    /// Returns whether it does not stop early.
    fn passes(&mut self, pair: &AlignedPair) -> bool {
        self.units = pair.units;
        match Width::of(pair) {
            Width::Words1 => self.passes_by(pair, &mut Fixed::<1, 2, 3>),
            Width::Words2 => self.passes_by(pair, &mut Fixed::<2, 4, 6>),
            Width::Words5 => self.passes_by(pair, &mut Fixed::<5, 10, 15>),
            Width::Words33 => self.passes_in_space(pair),
        }
    }

    /// It is out of line, so that a call pays for the stack of its own width only.
    #[inline(never)]
    fn passes_by<A: Arithmetic>(&mut self, pair: &AlignedPair, arithmetic: &mut A) -> bool {
        let coordinates = arithmetic.coordinates(pair);
        kernel::judge(pair.kind, &coordinates, arithmetic, self).is_continue()
    }

    #[inline(never)]
    fn passes_in_space(&mut self, pair: &AlignedPair) -> bool {
        self.passes_by(pair, &mut Space::new(&mut [0; kernel::space(33)]))
    }
}

impl<A: Arithmetic> Judge<A> for OneSign {
    #[inline(always)]
    fn wants(&self, index: usize) -> bool {
        matches!(self.known.get(index), Some(None))
    }

    #[inline(always)]
    fn judge(
        &mut self,
        arithmetic: &mut A,
        _: usize,
        value: &A::Three,
        normal: impl FnOnce(&mut A) -> [A::Two; 3],
    ) -> ControlFlow<()> {
        self.adopt(value.sign())?;
        if self.squared_separation.is_zero() {
            return ControlFlow::Continue(());
        }
        let normal = normal(arithmetic);
        if is_beyond(
            value.words(),
            normal.each_ref().map(Whole::words),
            self.units,
            self.squared_separation,
        ) {
            return ControlFlow::Continue(());
        }
        ControlFlow::Break(())
    }
}

/// Returns whether k² > s²·|n|², for whole numbers `value` and `normal` in units that differ between axes.
#[inline(never)]
fn is_beyond(value: Words<'_>, [x, y, z]: [Words<'_>; 3], Units([ux, uy, uz]): Units, squared_separation: Magnitude) -> bool {
    let squared = |component: Words<'_>, unit| Magnitude::of(component, unit, Bound::Upper).squared(Bound::Upper);
    let squared_normal = squared(x, uy + uz).plus(squared(y, uz + ux)).plus(squared(z, ux + uy));
    Magnitude::of(value, ux + uy + uz, Bound::Lower)
        .squared(Bound::Lower)
        .exceeds(squared_separation.times(squared_normal, Bound::Upper))
}
