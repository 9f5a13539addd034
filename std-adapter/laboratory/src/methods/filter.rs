use super::table::table;
use super::{WithLanes, WithTest};
use crate::baselines::as_computed::AsComputed;
use crate::baselines::plain::{self, Plain};
use selvedge_core::Scalar;
use selvedge_core::batch::{ByPoints, ByVolume};
use selvedge_core::filter::{Filter, Tier};

table! {
    /// A non-coplanarity filter whose accuracy and time are measured: two without proof, then every [`Tier`].
    pub enum MeasuredFilter of Option<Tier> {
        /// [`plain`](crate::baselines::plain), as printed in the paper. **Not certified.**
        Paper = "paper": None,
        /// [`AsComputed`](crate::baselines::as_computed::AsComputed): signs as computed. **Not certified.**
        Uncertified = "uncertified": None,
        /// [`Tier::Permanent`].
        Permanent = "permanent": Some(Tier::Permanent),
        /// [`Tier::Widened`].
        Widened = "widened": Some(Tier::Widened),
        /// [`Tier::Exact`].
        Exact = "exact": Some(Tier::Exact),
    }
}

impl MeasuredFilter {
    /// Returns the tier of the certified filter, if it is one.
    pub const fn tier(self) -> Option<Tier> {
        self.row()
    }

    /// Returns whether a pair that it culls is proven to be free of contact.
    pub const fn is_certified(self) -> bool {
        self.tier().is_some()
    }

    /// Passes the filter to `with`: whether it culls a pair that stays farther apart than `separation`. [`Paper`](Self::Paper)
    /// ignores the separation.
    #[inline(always)]
    pub(crate) fn run<S: Scalar, W: WithTest<S, bool>>(self, separation: S, with: W) -> W::Outcome {
        match self.tier() {
            Some(tier) => {
                let filter = tier_of(tier, separation);
                with.with(|pair| filter.verdict(pair).is_culled())
            }
            None if self == Self::Paper => with.with(|pair| plain::non_coplanarity(pair).is_culled()),
            None => {
                let filter = as_computed(separation);
                with.with(|pair| filter.verdict(pair).is_culled())
            }
        }
    }

    /// Passes the filter to `with`, on lanes.
    #[inline(always)]
    pub(crate) fn run_lanes<S: Scalar>(self, separation: S, with: impl WithLanes<S>) {
        match self.tier() {
            Some(tier) => with.with(tier_of(tier, separation)),
            None if self == Self::Paper => with.with(ByPoints(Plain)),
            None => with.with(ByVolume(as_computed(separation))),
        }
    }
}

/// Makes the filter, without the separation if that is invalid.
fn as_computed<S: Scalar>(separation: S) -> AsComputed<S> {
    let filter = AsComputed::new();
    filter.with_separation(separation).unwrap_or(filter)
}

/// Makes the filter, without the separation if that is invalid.
fn tier_of<S: Scalar>(tier: Tier, separation: S) -> Filter<S> {
    let filter = Filter::new(tier);
    filter.with_separation(separation).unwrap_or(filter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tier_is_measured_in_its_order() {
        let tiers: Vec<_> = MeasuredFilter::ALL.into_iter().filter_map(MeasuredFilter::tier).collect();
        assert_eq!(tiers, Tier::ALL);
    }
}
