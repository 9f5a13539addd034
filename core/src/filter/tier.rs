//! One choice for all non-coplanarity filters.

use super::widened;
use crate::coplanarity::{MovingTetrahedron, is_in_range};
use crate::exact;
use crate::lanes::Rounding;
use crate::motion::PrimitivePair;
use crate::points::PairPoints;
use crate::scalar::Scalar;
use crate::separation_lanes::SeparationLanes;
use crate::verdict::Verdict;

/// The sharpness of a non-coplanarity filter. Every tier is certified.
///
/// `docs/accuracy.md` has the measured cost of each (`selvedge accuracy`). In short: take [`Permanent`](Self::Permanent) for
/// `f64` and [`Widened`](Self::Widened) for `f32` positions; take [`Exact`](Self::Exact) where every last pair counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tier {
    /// Bounds the rounding error by the permanent of each control value.
    #[default]
    Permanent,
    /// Decides like [`Permanent`](Self::Permanent) in the pair's own format, then in `f64` if that does not decide. For `f64`
    /// positions it is the same as `Permanent`.
    Widened,
    /// Decides by the exact signs of the control values: [`Permanent`](Self::Permanent) first, then integers if that does not
    /// decide.
    ///
    /// In a thread that flushes subnormal numbers it keeps a pair whose extent along an axis is subnormal.
    Exact,
}

impl Tier {
    /// Every tier, the least sharp first.
    pub const ALL: [Self; 3] = [Self::Permanent, Self::Widened, Self::Exact];

    /// Returns the pairs that the tier tests one by one, given those that its bound has culled or settled. There is one bit per
    /// pair.
    #[inline(always)]
    pub(crate) fn open(self, culled: u16, settled: u16) -> u16 {
        match self {
            Self::Permanent => 0,
            Self::Widened | Self::Exact => !(culled | settled),
        }
    }
}

/// A non-coplanarity filter: its [`Tier`], and the separation that pairs must keep.
///
/// The filter is certified in every floating-point environment ([`Rounding`](crate::lanes::Rounding)): a culled pair is at no
/// time in [0, 1] coplanar, or within the separation. NaN and infinities keep the pair. So do coordinates whose differences
/// exceed [`LARGEST_EDGE`](crate::lanes::Rounding::LARGEST_EDGE), except with [`Tier::Exact`].
///
/// ```
/// use selvedge_core::filter::{Filter, Tier};
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
///
/// // A vertex that sinks from 0.3 to 0.1 above a triangle.
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.2, 0.3), DVec3::new(0.2, 0.2, 0.1)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// let filter = Filter::new(Tier::Permanent);
/// assert!(filter.verdict(&pair).is_culled());
/// assert!(filter.with_separation(0.09).unwrap().verdict(&pair).is_culled());
/// assert!(!filter.with_separation(0.11).unwrap().verdict(&pair).is_culled());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filter<S> {
    tier: Tier,
    separation: S,
}

impl<S: Scalar> Filter<S> {
    /// Makes a filter of this tier with separation zero: it culls pairs that never touch.
    #[must_use]
    pub const fn new(tier: Tier) -> Self {
        Self {
            tier,
            separation: S::ZERO,
        }
    }

    /// Makes the same filter for pairs that must stay farther apart than `separation`, in the unit of the positions. Returns
    /// `None` if `separation` is negative, infinite or NaN.
    ///
    /// A subnormal separation is [raised](Scalar::raised_to_normal) to the smallest normal number, so that it also counts in
    /// threads that treat subnormal numbers as zero.
    #[must_use]
    pub fn with_separation(self, separation: S) -> Option<Self> {
        (separation >= S::ZERO && separation.is_finite()).then_some(Self {
            tier: self.tier,
            separation: separation.raised_to_normal(),
        })
    }

    /// Returns the filter's tier.
    #[must_use]
    pub const fn tier(&self) -> Tier {
        self.tier
    }

    /// Returns the distance that culled pairs exceed. If it is zero, they do not touch.
    #[must_use]
    pub const fn separation(&self) -> S {
        self.separation
    }

    /// Culls or keeps `pair`.
    #[inline]
    pub fn verdict(&self, pair: &PrimitivePair<S>) -> Verdict {
        let separation = SeparationLanes::new(self.separation, S::ZERO);
        let points = PairPoints::from(pair);
        let decision = of_kind!(pair.kind, P => points.tetrahedron::<P>().decide::<P>(separation));
        let culled = u16::from(decision.culled);
        let is_open = self.tier.open(culled, u16::from(decision.settled)) & 1 != 0;
        Verdict::culled_if(decision.culled || is_open && self.culls_open(pair))
    }

    /// Returns whether the tier culls one pair that is [open](Tier::open).
    #[cold]
    pub(crate) fn culls_open(&self, pair: &PrimitivePair<S>) -> bool {
        match self.tier {
            Tier::Permanent => false,
            Tier::Widened => S::UNIT_ROUNDOFF.to_f64() > f64::UNIT_ROUNDOFF && widened::culls(pair, self.separation),
            Tier::Exact => self.culls_exactly(pair),
        }
    }

    /// Decides by the exact signs. Signs that the rounded values prove are not computed again.
    fn culls_exactly(&self, pair: &PrimitivePair<S>) -> bool {
        if self.separation > S::ZERO {
            return exact::is_never_within(pair, self.separation, exact::UNKNOWN);
        }
        let tetrahedron = MovingTetrahedron::from(pair);
        let known = if is_in_range(tetrahedron.largest_by_axis().largest()) {
            exact::certain_signs(&tetrahedron.control_values(), tetrahedron.error_bounds())
        } else {
            exact::UNKNOWN
        };
        exact::is_never_coplanar(pair, known)
    }
}

#[cfg(test)]
mod tests {
    use super::{Filter, Tier};

    /// The lanes are one that is culled, one that is settled, one that is both and one that is neither.
    #[test]
    fn what_is_settled_or_culled_is_not_looked_at_again() {
        let open = |tier: Tier| tier.open(0b0101, 0b0110) & 0b1111;
        assert_eq!(open(Tier::Permanent), 0);
        assert_eq!(open(Tier::Widened), 0b1000);
        assert_eq!(open(Tier::Exact), 0b1000);
    }

    #[test]
    fn a_separation_is_a_length() {
        let filter = Filter::<f64>::new(Tier::Permanent);
        for wrong in [-1.0, -f64::MIN_POSITIVE, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            assert!(filter.with_separation(wrong).is_none(), "{wrong}");
        }
        for right in [0.0, -0.0, f64::MIN_POSITIVE, 1.0, f64::MAX] {
            let separation = filter.with_separation(right).map(|filter| filter.separation());
            assert_eq!(separation, Some(right));
        }
    }
}
