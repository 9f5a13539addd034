use crate::baselines::{additive, bernstein_sign, cubic, tight_inclusion, uncertified};
use selvedge_core::elementary::{Contact, Limits, advance, contact::settled};
use selvedge_core::{PrimitivePair, Scalar};
use std::fmt;

/// An elementary test whose accuracy and time are measured, with its tolerance in units of length where it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ElementaryMethod {
    /// [`selvedge_core::elementary::advance`].
    Certified(f64),
    /// The same without its error bounds. **Not certified.**
    Uncertified(f64),
    /// [`selvedge_core::elementary::contact`](mod@selvedge_core::elementary::contact), with the certified time of the default tolerance.
    Exact,
    /// [`tight_inclusion`]. It never misses.
    TightInclusion(f64),
    /// [`additive`](crate::baselines::additive). **Not certified.**
    Additive,
    /// [`bernstein_sign`], which tells no times. **Not certified.**
    BernsteinSign,
    /// [`cubic`]. **Not certified.**
    Cubic,
}

/// The tolerances that tests are asked with, in units of length.
const TOLERANCES: [f64; 7] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12];

impl ElementaryMethod {
    /// Every method at every tolerance.
    pub const ALL: [Self; 3 * TOLERANCES.len() + 4] = {
        let mut all = [Self::Exact; 3 * TOLERANCES.len() + 4];
        let count = TOLERANCES.len();
        let mut index = 0;
        while index < count {
            let tolerance = TOLERANCES[index];
            all[index] = Self::Certified(tolerance);
            all[count + 1 + index] = Self::TightInclusion(tolerance);
            all[2 * count + 1 + index] = Self::Uncertified(tolerance);
            index += 1;
        }
        all[3 * count + 1] = Self::Additive;
        all[3 * count + 2] = Self::BernsteinSign;
        all[3 * count + 3] = Self::Cubic;
        all
    };

    /// The name in reports, without the tolerance.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Certified(_) => "certified",
            Self::Uncertified(_) => "without_bounds",
            Self::Exact => "exact",
            Self::TightInclusion(_) => "tight_inclusion",
            Self::Additive => "additive",
            Self::BernsteinSign => "bernstein_sign",
            Self::Cubic => "cubic",
        }
    }

    /// The tolerance, in units of length.
    #[must_use]
    pub const fn tolerance(self) -> Option<f64> {
        match self {
            Self::Certified(tolerance) | Self::Uncertified(tolerance) | Self::TightInclusion(tolerance) => Some(tolerance),
            Self::Exact | Self::Additive | Self::BernsteinSign | Self::Cubic => None,
        }
    }

    /// Whether it never misses a contact, and never says a time that is too late, rounding included.
    #[must_use]
    pub const fn is_certified(self) -> bool {
        matches!(self, Self::Certified(_) | Self::Exact | Self::TightInclusion(_))
    }

    /// From when on contact is not excluded, NaN if the test does not say; `None` if it is.
    pub(super) fn time<S: Scalar>(self, pair: &PrimitivePair<S>) -> Option<S> {
        let limits = |tolerance| Limits {
            tolerance: S::from_f64(tolerance),
            separation: S::ZERO,
        };
        match self {
            Self::Certified(tolerance) => advance::time_of_impact(pair, &limits(tolerance)).time(),
            Self::Uncertified(tolerance) => uncertified::time_of_impact(pair, &limits(tolerance)).time(),
            Self::TightInclusion(tolerance) => tight_inclusion::time_of_impact(pair, &limits(tolerance)).time(),
            Self::Additive => additive::time_of_impact(pair, S::ZERO).time(),
            Self::Exact => {
                let impact = advance::time_of_impact(pair, &Limits::default());
                match settled(pair, &impact) {
                    Contact::Never => None,
                    Contact::Happens | Contact::Undefined => impact.time(),
                }
            }
            Self::BernsteinSign => bernstein_sign::touches(pair).then(|| S::from_f64(f64::NAN)),
            Self::Cubic => cubic::time_of_impact(pair),
        }
    }
}

impl fmt::Display for ElementaryMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.tolerance() {
            Some(tolerance) => f.pad(&format!("{} {tolerance:e}", self.name())),
            None => f.pad(self.name()),
        }
    }
}
