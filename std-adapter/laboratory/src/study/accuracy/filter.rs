use selvedge_core::filter::{Depth, Tier};
use std::fmt;

/// A non-coplanarity filter whose accuracy and time are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MeasuredFilter {
    /// [`plain`](crate::baselines::plain), as printed in the paper. **Not certified.**
    Paper,
    /// [`AsComputed`](crate::baselines::as_computed::AsComputed): signs as computed. **Not certified.**
    Uncertified,
    /// [`selvedge_core::filter::Filter`] of this tier.
    Tier(Tier),
}

impl MeasuredFilter {
    /// The paper's filter, signs as computed, then every tier in the order of [`Tier::ALL`].
    pub const ALL: [Self; 11] = {
        let mut all = [Self::Paper; 11];
        all[1] = Self::Uncertified;
        let mut index = 0;
        while index < Tier::ALL.len() {
            all[index + 2] = Self::Tier(Tier::ALL[index]);
            index += 1;
        }
        all
    };

    /// The name in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Uncertified => "uncertified",
            Self::Tier(Tier::MagnitudesByEdge) => "by_edge",
            Self::Tier(Tier::MagnitudesByAxis) => "by_axis",
            Self::Tier(Tier::Permanent) => "permanent",
            Self::Tier(Tier::Widened) => "widened",
            Self::Tier(Tier::Exact) => "exact",
            Self::Tier(Tier::Subdivided(Depth::One)) => "subdivided_1",
            Self::Tier(Tier::Subdivided(Depth::Two)) => "subdivided_2",
            Self::Tier(Tier::Subdivided(Depth::Three)) => "subdivided_3",
            Self::Tier(Tier::Subdivided(Depth::Four)) => "subdivided_4",
        }
    }

    /// Whether a pair that it culls is proven to be free of contact.
    #[must_use]
    pub const fn is_certified(self) -> bool {
        matches!(self, Self::Tier(_))
    }

    /// Whether all that it culls must be culled by exact signs as well. [`Tier::Subdivided`] culls coplanar pairs that do
    /// not touch.
    #[must_use]
    pub const fn decides_by_whole_step(self) -> bool {
        !matches!(self, Self::Tier(Tier::Subdivided(_)))
    }
}

impl fmt::Display for MeasuredFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
