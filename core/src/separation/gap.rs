//! The gap of a pair along a direction: a lower bound of its distance, and a proof that lasts as long as the direction separates.
//!
//! For a fixed direction d and any points p of the first set and q of the second, d·(p(t) − q(t)) is linear in t. The gap is the
//! least of these: the distance by which the first set is ahead of the second. If it exceeds m·|d| at the start and at the end of
//! a step, the sets are more than m apart throughout. d may have any origin and rounding; directions longer than 1 + 2⁻²¹ are
//! rejected.
//!
//! # Rounding
//! An operation errs by ε = 2u in any rounding direction. Let no coordinate exceed B, and no component of d exceed 1.01. A dot
//! product passes each term through at most 3 roundings, so its error is at most 3ε·3·1.01B to first order. A gap is the
//! difference of two of them, itself rounded: 18.2εB + 6.1εB ≤ 49uB. [`GapError`] allows 64u·B.
//!
//! **σ = 1 + 2⁻²⁰** (`slack`) covers the length of d and later roundings:
//! * An accepted length: fl(d·d) < 1 + 2⁻²⁰ shows that |d| ≤ 1 + 2⁻²⁰·0.8 in both formats.
//! * A lower bound of the distance: fl(gap/σ − 64uB) is at most (gap − 49uB)/|d|.
//! * A stored gap, fl₃₂((gap − 64uB)/σ), is also a lower bound: `f32` rounds by 2⁻²³. Below 2⁻¹⁰⁰, where it might round up by
//!   more, zero is stored instead, and 2¹⁰⁰ above that.
//! * A threshold: gap > fl(m·σ² + 64uB) shows that the exact gap is more than m·|d|. The same holds for a stored gap.
//!
//! **Underflow.** Where subnormal numbers are flushed, a dot product loses at most 3 operands times 1.01 and 5 results, 3 of B's
//! and 3 of d's, each λ or λB. Twice that and the difference is less than 20λ(1 + B), which 64uB and η ≥ 512λ cover for every B
//! (λ ≤ u²). **Overflow.** If B exceeds [`Rounding::LARGEST_EDGE`], the error is infinite, and no gap exceeds it.
//! [`largest_coordinate`](super::largest_coordinate) is infinite if a coordinate is NaN or infinite. NaN in a direction or a
//! separation proves nothing either: comparisons are ordered.

use crate::kernels::gap as kernel;
use crate::kind::PairKind;
use crate::lanes::Rounding;
use crate::scalar::{Position, Scalar};
use crate::vector::Vector;

/// A bound of the rounding error of a gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GapError<S>(S);

impl<S: Scalar> GapError<S> {
    /// Computes the error for points whose coordinates do not exceed `largest` in magnitude
    /// ([`largest_coordinate`](super::largest_coordinate)), in the unit of the positions. It is infinite, so that nothing is
    /// proven, if `largest` is NaN or too large.
    #[inline]
    #[must_use]
    pub fn from_largest_coordinate(largest: S) -> Self {
        if largest <= S::LARGEST_EDGE {
            Self(kernel::error(largest))
        } else {
            Self(S::INFINITY)
        }
    }

    /// Returns the larger of two errors, for points that belong to either.
    #[inline]
    #[must_use]
    pub fn larger(self, other: Self) -> Self {
        Self(self.0.larger(other.0))
    }

    /// Returns the error as a length, in the unit of the positions.
    #[inline(always)]
    #[must_use]
    pub const fn length(self) -> S {
        self.0
    }
}

/// Returns the factor σ that covers the length of directions and later roundings.
#[inline(always)]
fn slack<S: Scalar>() -> S {
    S::from_f64(1.0 + 1.0 / 1_048_576.0)
}

/// Returns the threshold that a gap must exceed to prove that two sets are more than `separation` apart.
#[inline(always)]
pub(super) fn threshold<S: Scalar>(separation: S, error: GapError<S>) -> S {
    kernel::threshold(separation, error.0, slack())
}

/// Returns the distance by which the first set is ahead of the second along a direction, as computed. It proves nothing by
/// itself.
#[inline(always)]
#[must_use]
pub fn gap<P: Position>(kind: PairKind, points: [P; 4], direction: [P::Scalar; 3]) -> P::Scalar {
    kernel::gap(kind, points.map(|point| Vector::from(point.into())), Vector::from(direction))
}

/// Returns whether a direction is no longer than σ allows. It is false with NaN.
#[inline(always)]
fn is_short<S: Scalar>(direction: [S; 3]) -> bool {
    kernel::is_short(Vector::from(direction), slack())
}

/// Returns a lower bound of the distance of two sets at rest, by a direction of length one from the second to the first. It is
/// zero if the direction proves none.
///
/// The result is certified, in every floating-point environment, for any direction.
///
/// ```
/// use selvedge_core::{PairKind, glam::DVec3, separation::gap::{GapError, distance_from_below}};
/// let points = [DVec3::new(0.2, 0.2, 0.5), DVec3::ZERO, DVec3::X, DVec3::Y];
/// let bound = distance_from_below(PairKind::VertexFace, points, DVec3::Z, GapError::from_largest_coordinate(1.0));
/// assert!(bound <= 0.5 && bound > 0.499_999);
/// ```
#[inline]
#[must_use]
pub fn distance_from_below<P: Position>(kind: PairKind, points: [P; 4], direction: P, error: GapError<P::Scalar>) -> P::Scalar {
    let zero = P::Scalar::ZERO;
    let direction = direction.into();
    let bound = kernel::distance(gap(kind, points, direction), slack(), error.0);
    if bound > zero && is_short(direction) { bound } else { zero }
}

/// The direction that last kept a pair apart, and its gap: 16 bytes for a caller to keep with the pair.
///
/// ```
/// use selvedge_core::{PairKind, glam::DVec3, separation::gap::{GapError, SeparatingDirection}};
/// let kind = PairKind::VertexFace;
/// let at = |height| [DVec3::new(0.2, 0.2, height), DVec3::ZERO, DVec3::X, DVec3::Y];
/// let error = GapError::from_largest_coordinate(1.0);
/// let found = SeparatingDirection::for_step(kind, DVec3::Z, [at(0.5), at(0.4)], 0.1, error).unwrap();
/// assert!(found.gap() <= 0.4);
/// // The next step, to 0.2, costs four dot products. The one to 0.05 is not proven.
/// let later = found.lasts(kind, at(0.2), 0.1, error).unwrap();
/// assert!(later.lasts(kind, at(0.05), 0.1, error).is_none());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeparatingDirection {
    /// The direction, no longer than σ allows.
    direction: [f32; 3],
    /// The gap, at most the distance.
    gap: f32,
}

impl SeparatingDirection {
    /// The value without a known direction.
    pub const NONE: Self = Self {
        direction: [0.0; 3],
        gap: f32::NEG_INFINITY,
    };

    /// Returns a lower bound of the distance at the last positions at which the direction certainly kept the pair apart; −∞
    /// without such positions.
    #[inline(always)]
    #[must_use]
    pub const fn gap(&self) -> f32 {
        self.gap
    }

    /// Returns the direction without its gap, for a pair that has moved on.
    #[inline(always)]
    #[must_use]
    pub const fn without_gap(self) -> Self {
        Self {
            gap: f32::NEG_INFINITY,
            ..self
        }
    }

    /// Returns the direction, which has length one up to rounding, or is zero.
    #[inline(always)]
    #[must_use]
    pub fn direction<P: Position>(&self) -> P {
        P::from(self.components())
    }

    #[inline(always)]
    fn components<S: Scalar>(&self) -> [S; 3] {
        let [x, y, z] = self.direction;
        [S::from_f64(x.into()), S::from_f64(y.into()), S::from_f64(z.into())]
    }

    /// Returns the distance by which the direction keeps the pair apart at `points`, as computed. It proves nothing.
    #[inline(always)]
    #[must_use]
    pub fn gap_at<P: Position>(&self, kind: PairKind, points: [P; 4]) -> P::Scalar {
        gap(kind, points, self.components())
    }

    /// Returns this direction with another gap, from which the error is already subtracted.
    #[inline(always)]
    fn with_gap<S: Scalar>(self, gap: S) -> Self {
        let limits = [1.0 / LARGEST_GAP, LARGEST_GAP].map(S::from_f64);
        let gap = kernel::stored(gap, slack(), limits);
        Self {
            direction: self.direction,
            gap: f32::from_f64(gap.to_f64()),
        }
    }

    /// Rounds a direction to the stored digits, without a gap. Returns zero if it is longer than one.
    #[inline(always)]
    fn rounded<P: Position>(direction: P) -> Self {
        let [x, y, z]: [P::Scalar; 3] = direction.into();
        let direction = [x, y, z].map(|component| f32::from_f64(component.to_f64()));
        let direction = if is_short(direction.map(f64::from)) {
            direction
        } else {
            [0.0; 3]
        };
        Self {
            direction,
            gap: f32::NEG_INFINITY,
        }
    }

    /// Returns the direction that proves more at `points`: this one, whose gap must be valid there, or `direction`, from the
    /// second set to the first.
    #[inline]
    #[must_use]
    pub fn or_better<P: Position>(self, kind: PairKind, direction: P, points: [P; 4], error: GapError<P::Scalar>) -> Self {
        let other = Self::rounded(direction);
        let gap = other.gap_at(kind, points) - error.0;
        if gap.to_f64() > f64::from(self.gap) {
            other.with_gap(gap)
        } else {
            self
        }
    }

    /// Returns `direction` with its gap at the end, if it certainly keeps the pair more than `separation` apart on straight
    /// paths. The direction is rounded first, so the returned one is the proof.
    #[inline]
    #[must_use]
    pub fn for_step<P: Position>(
        kind: PairKind,
        direction: P,
        [start, end]: [[P; 4]; 2],
        separation: P::Scalar,
        error: GapError<P::Scalar>,
    ) -> Option<Self> {
        Self::rounded(direction).keeps(kind, [start, end], separation, error)
    }

    /// Returns this direction with its gap at the end, if it certainly keeps the pair apart as in [`for_step`](Self::for_step).
    #[inline]
    #[must_use]
    pub fn keeps<P: Position>(
        self,
        kind: PairKind,
        [start, end]: [[P; 4]; 2],
        separation: P::Scalar,
        error: GapError<P::Scalar>,
    ) -> Option<Self> {
        let threshold = threshold(separation, error);
        let gap = self.gap_at(kind, end);
        kernel::keeps(gap, || self.gap_at(kind, start), threshold).then(|| self.with_gap(gap - error.0))
    }

    /// Returns this direction with its gap at the end, like [`keeps`](Self::keeps), if the stored gap is valid at the start. It
    /// computes only the gap at the end.
    #[inline(always)]
    #[must_use]
    pub fn lasts<P: Position>(
        self,
        kind: PairKind,
        end: [P; 4],
        separation: P::Scalar,
        error: GapError<P::Scalar>,
    ) -> Option<Self> {
        let stored = P::Scalar::from_f64(self.gap.into());
        let less_error = || self.gap_at(kind, end) - error.0;
        let (is_kept, gap) = kernel::lasts(stored, less_error, threshold(separation, error));
        is_kept.then(|| self.with_gap(gap))
    }
}

/// The number 2¹⁰⁰. Its inverse is the least stored gap.
const LARGEST_GAP: f64 = 1_267_650_600_228_229_401_496_703_205_376.0;
