//! The gap of a pair along a direction: a lower bound of its distance, and a proof that lasts as long as the direction does.
//!
//! For a fixed direction d and any points p of the first set and q of the second, d·(p(t) − q(t)) is linear in t. The gap is the least
//! of these: by how much the first set is ahead of the second. If it exceeds m·|d| at the start and at the end of a step, the sets
//! are more than m apart throughout. d may come from anywhere, rounded as it likes: directions longer than 1 + 2⁻²¹ are refused.
//!
//! # Rounding
//! (Any direction: ε = 2u an operation.) Let no coordinate exceed B, and no component of d exceed 1.01. A dot product passes each of
//! its terms through at most 3 roundings; its error is at most 3ε·3·1.01B to first order. A gap is the difference of two of them, itself
//! rounded: 18.2εB + 6.1εB ≤ 49uB. [`GapError`] allows 64u·B.
//!
//! **σ = 1 + 2⁻²⁰** (`slack`) makes up for the length of d and for what is rounded after that:
//! * The length that is accepted: fl(d·d) ≤ 1 + 2⁻²⁰ shows that |d| ≤ 1 + 2⁻²⁰·0.8 in both formats.
//! * A lower bound of the distance: fl(gap/σ − 64uB) is at most (gap − 49uB)/|d|.
//! * What is stored, fl₃₂((gap − 64uB)/σ), is as well: `f32` rounds by 2⁻²³. Below 2⁻¹⁰⁰, where it might round up by more, zero is
//!   stored in place of it, and 2¹⁰⁰ beyond that.
//! * A threshold: gap > fl(m·σ² + 64uB) shows that the exact gap is more than m·|d|; so does a stored one.
//!
//! **Underflow.** Where subnormal numbers are flushed a dot product loses at most 3 operands times 1.01 and 5 results, 3 of B's and 3 of
//! d's, each λ or λB: twice that and the difference is less than 20λ(1 + B), which 64uB and η ≥ 512λ cover for every B (λ ≤ u²).
//! **Overflow.** B must not exceed [`Rounding::LARGEST_EDGE`], or the error is infinite: then no gap exceeds
//! it. [`largest_coordinate`](super::largest_coordinate) is infinite if a coordinate is NaN or infinite. NaN in a direction or a separation
//! proves nothing either: comparisons are ordered.

use crate::kind::PairKind;
use crate::lanes::Rounding;
use crate::points::PairShape;
use crate::scalar::{Position, Scalar};
use crate::vector::Vector;

/// How far rounding can move a gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GapError<S>(S);

impl<S: Scalar> GapError<S> {
    /// Of points none of whose coordinates exceeds `largest`, in the unit of the positions: see
    /// [`largest_coordinate`](super::largest_coordinate). Infinite, so that nothing is proven, if that is NaN or too large.
    #[inline]
    #[must_use]
    pub fn from_largest_coordinate(largest: S) -> Self {
        if largest <= S::LARGEST_EDGE {
            Self(S::small(64) * S::UNIT_ROUNDOFF * largest + S::UNDERFLOW)
        } else {
            Self(S::INFINITY)
        }
    }

    /// The larger of two: of points that belong to either.
    #[inline]
    #[must_use]
    pub fn larger(self, other: Self) -> Self {
        Self(self.0.larger(other.0))
    }

    /// As a length.
    #[inline(always)]
    pub(super) const fn length(self) -> S {
        self.0
    }
}

/// σ of the module's documentation.
#[inline(always)]
fn slack<S: Scalar>() -> S {
    S::from_f64(1.0 + 1.0 / 1_048_576.0)
}

/// What a gap must exceed to prove that two sets are more than `separation` apart.
#[inline(always)]
pub(super) fn threshold<S: Scalar>(separation: S, error: GapError<S>) -> S {
    separation * (slack::<S>() * slack::<S>()) + error.0
}

/// By how much the first set is ahead of the second along a direction, as computed. Proves nothing by itself.
#[inline(always)]
#[must_use]
pub fn gap<P: Position>(kind: PairKind, points: [P; 4], direction: [P::Scalar; 3]) -> P::Scalar {
    let direction = Vector::from(direction);
    let [a, b, c, d] = points;
    // Written out: `map` with a closure is not always inlined.
    let values = [
        direction.dot(Vector::from(a.into())),
        direction.dot(Vector::from(b.into())),
        direction.dot(Vector::from(c.into())),
        direction.dot(Vector::from(d.into())),
    ];
    let [[low, _], [_, high]] = of_kind!(kind, K => K::ranges(values));
    low - high
}

/// Whether a direction is no longer than σ allows. False with NaN.
#[inline(always)]
fn is_short<S: Scalar>(direction: [S; 3]) -> bool {
    let direction = Vector::from(direction);
    direction.dot(direction) <= slack()
}

/// A lower bound of the distance of two sets at rest, by a direction of length one from the second to the first; zero if it proves
/// none.
///
/// Certified, in every floating-point environment, whatever the direction.
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
    let bound = gap(kind, points, direction) / slack() - error.0;
    if bound > zero && is_short(direction) { bound } else { zero }
}

/// The direction that last kept a pair apart, and by how much: 16 bytes for a caller to keep with the pair.
///
/// ```
/// use selvedge_core::{PairKind, glam::DVec3, separation::gap::{GapError, SeparatingDirection}};
/// let kind = PairKind::VertexFace;
/// let at = |height| [DVec3::new(0.2, 0.2, height), DVec3::ZERO, DVec3::X, DVec3::Y];
/// let error = GapError::from_largest_coordinate(1.0);
/// let found = SeparatingDirection::for_step(kind, DVec3::Z, [at(0.5), at(0.4)], 0.1, error).unwrap();
/// assert!(found.gap() <= 0.4);
/// // The next step, on to 0.2, costs four dot products; the one to 0.05 is no longer proven.
/// let later = found.lasts(kind, at(0.2), 0.1, error).unwrap();
/// assert!(later.lasts(kind, at(0.05), 0.1, error).is_none());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeparatingDirection {
    /// No longer than σ allows.
    direction: [f32; 3],
    /// Not more than the distance.
    gap: f32,
}

impl SeparatingDirection {
    /// No direction is known.
    pub const NONE: Self = Self {
        direction: [0.0; 3],
        gap: f32::NEG_INFINITY,
    };

    /// A lower bound of the distance where the direction was last shown to keep the pair apart; −∞ if there is none.
    #[inline(always)]
    #[must_use]
    pub const fn gap(&self) -> f32 {
        self.gap
    }

    /// The direction without its gap: the pair has moved on.
    #[inline(always)]
    #[must_use]
    pub const fn without_gap(self) -> Self {
        Self {
            gap: f32::NEG_INFINITY,
            ..self
        }
    }

    /// The direction. Of length one but for rounding, or zero.
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

    /// By how much the direction keeps the pair apart there, as computed: for what needs no proof.
    #[inline(always)]
    #[must_use]
    pub fn gap_at<P: Position>(&self, kind: PairKind, points: [P; 4]) -> P::Scalar {
        gap(kind, points, self.components())
    }

    /// This direction with another gap, from which the error is taken off already.
    #[inline(always)]
    fn with_gap<S: Scalar>(self, gap: S) -> Self {
        let least = S::from_f64(1.0 / LARGEST_GAP);
        let gap = gap / slack();
        let gap = if gap > least {
            gap.smaller(S::from_f64(LARGEST_GAP))
        } else {
            gap.smaller(S::ZERO)
        };
        Self {
            direction: self.direction,
            gap: f32::from_f64(gap.to_f64()),
        }
    }

    /// Another direction, in the digits that are kept of it, without a gap. Zero if it is longer than one.
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

    /// Whichever proves more at `points`: this one, whose gap must be right there, or `direction`, from the second set to the first.
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

    /// `direction` with its gap at the end, if it certainly keeps the pair more than `separation` apart on straight ways from the start
    /// to the end. It is rounded first: what is returned is what proves it.
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

    /// The same for this direction, whatever its gap says.
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
        (gap > threshold && self.gap_at(kind, start) > threshold).then(|| self.with_gap(gap - error.0))
    }

    /// The same where the gap is right at the start: only the end is looked at.
    #[inline(always)]
    #[must_use]
    pub fn lasts<P: Position>(
        self,
        kind: PairKind,
        end: [P; 4],
        separation: P::Scalar,
        error: GapError<P::Scalar>,
    ) -> Option<Self> {
        let threshold = threshold(separation, error);
        if f64::from(self.gap) > threshold.to_f64() {
            let gap = self.gap_at(kind, end) - error.0;
            return (gap > threshold).then(|| self.with_gap(gap));
        }
        None
    }
}

/// 2¹⁰⁰; its inverse is the least that is stored.
const LARGEST_GAP: f64 = 1_267_650_600_228_229_401_496_703_205_376.0;
