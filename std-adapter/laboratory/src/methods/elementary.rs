use super::{Ask, WithTest};
use crate::baselines::{additive, bernstein_sign, cubic, tight_inclusion, uncertified};
use selvedge_core::elementary::{ContactVerdict, Limits, advance, contact::contact_given_impact};
use selvedge_core::{PrimitivePair, Scalar};
use std::fmt;

/// A test that decides whether, and when, a pair first touches. Variants with several tolerances carry theirs, in units of
/// length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ElementaryTest {
    /// The test [`selvedge_core::elementary::advance`] with the default tolerance. It is certified: a contact's time is not after
    /// the exact one. A pair within the tolerance, or too close for rounding to decide, may count as a contact.
    TimeOfImpact,
    /// The test of [`TimeOfImpact`](Self::TimeOfImpact), then [`selvedge_core::elementary::contact()`]: exactly the pairs that
    /// touch are contacts, and their times
    /// are certified.
    Exact,
    /// [`TimeOfImpact`](Self::TimeOfImpact) with this tolerance.
    Certified(f64),
    /// [`Certified`](Self::Certified) without error bounds. **Not certified.**
    Uncertified(f64),
    /// [`tight_inclusion`], the bisection of Wang et al. 2021. It never misses.
    TightInclusion(f64),
    /// [`additive`](crate::baselines::additive), Li et al. 2021. **Not certified.**
    Additive,
    /// [`bernstein_sign`], Tang et al. 2014 without exact arithmetic, which returns no times. **Not certified**: it misses
    /// contacts.
    BernsteinSign,
    /// [`cubic`], Provot's test. **Not certified**: it misses contacts.
    Cubic,
}

impl ElementaryTest {
    /// Returns the name in reports, without the tolerance.
    pub const fn name(self) -> &'static str {
        match self {
            Self::TimeOfImpact => "time_of_impact",
            Self::Exact => "exact",
            Self::Certified(_) => "certified",
            Self::Uncertified(_) => "without_bounds",
            Self::TightInclusion(_) => "tight_inclusion",
            Self::Additive => "additive",
            Self::BernsteinSign => "bernstein_sign",
            Self::Cubic => "cubic",
        }
    }

    /// Returns the tolerance, in units of length; `None` for the format's default, and for tests without one.
    pub const fn tolerance(self) -> Option<f64> {
        match self {
            Self::Certified(tolerance) | Self::Uncertified(tolerance) | Self::TightInclusion(tolerance) => Some(tolerance),
            Self::TimeOfImpact | Self::Exact | Self::Additive | Self::BernsteinSign | Self::Cubic => None,
        }
    }

    /// Returns whether it never misses a contact and never returns a time that is too late, rounding included.
    pub const fn is_certified(self) -> bool {
        match self {
            Self::TimeOfImpact | Self::Exact | Self::Certified(_) | Self::TightInclusion(_) => true,
            Self::Uncertified(_) | Self::Additive | Self::BernsteinSign | Self::Cubic => false,
        }
    }

    /// Returns the time from which contact is not excluded, NaN if the test has no times, and `None` if there is no contact.
    #[inline(always)]
    pub fn time<S: Scalar>(self, pair: &PrimitivePair<S>) -> Option<S> {
        self.run(Ask(pair))
    }

    /// Passes the test to `with`: the [time](Self::time) of a pair.
    #[inline(always)]
    pub(crate) fn run<S: Scalar, W: WithTest<S, Option<S>>>(self, with: W) -> W::Outcome {
        let limits = match self.tolerance() {
            None => Limits::default(),
            Some(tolerance) => Limits::accurate_to(S::from_f64(tolerance)),
        };
        match self {
            Self::TimeOfImpact | Self::Certified(_) => with.with(|pair| advance::time_of_impact(pair, &limits).time()),
            Self::Exact => with.with(|pair| {
                let impact = advance::time_of_impact(pair, &limits);
                impact
                    .time()
                    .filter(|_| contact_given_impact(pair, &impact) != ContactVerdict::Never)
            }),
            Self::Uncertified(_) => with.with(|pair| uncertified::time_of_impact(pair, &limits).time()),
            Self::TightInclusion(_) => with.with(|pair| tight_inclusion::time_of_impact(pair, &limits).time()),
            Self::Additive => with.with(|pair| additive::time_of_impact(pair, S::ZERO).time()),
            Self::BernsteinSign => with.with(|pair| bernstein_sign::touches(pair).then(|| S::from_f64(f64::NAN))),
            Self::Cubic => with.with(cubic::time_of_impact),
        }
    }
}

impl fmt::Display for ElementaryTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.tolerance() {
            Some(tolerance) => f.pad(&format!("{} {tolerance:e}", self.name())),
            None => f.pad(self.name()),
        }
    }
}
