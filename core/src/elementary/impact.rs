//! The question and the answer of a time of impact.

use crate::lanes::power_of_two_f64;
use crate::scalar::Scalar;

/// What distance counts as contact, and how tight the answer is to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits<S> {
    /// δ, in units of length: the sets are taken to be in contact when they are that much more than `separation` apart. With
    /// zero, or less than the error of rounding, the answer is as tight as can be proven.
    pub tolerance: S,
    /// s, in units of length: the distance that the sets are to keep. Zero: they are not to touch. If it is negative or NaN
    /// nothing is excluded.
    pub separation: S,
}

impl<S: Scalar> Default for Limits<S> {
    /// Contact itself, with a tolerance of 2⁻³⁰ (`f64`, about 1e-9) or 2⁻²⁰ (`f32`, about 1e-6): for positions in metres, a
    /// nanometre or a micrometre. A finer tolerance costs hardly more.
    #[inline]
    fn default() -> Self {
        Self {
            tolerance: S::from_f64(power_of_two_f64(if S::FRACTION_BITS < 52 { -20 } else { -30 })),
            separation: S::ZERO,
        }
    }
}

/// When two moving sets may be closer than they should.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use = "what is not excluded has to be dealt with"]
pub enum Impact<S> {
    /// Certainly never: at all times in [0, 1] they are farther apart than the separation.
    Never,
    /// It is not excluded from `time` on. Certainly never before.
    Possible {
        /// In [0, 1]; no later than the first time, if there is one, at which they are within the separation.
        time: S,
        /// Why no later time is proven.
        reason: Reason,
    },
}

/// Why advancing stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reason {
    /// The sets are within the tolerance of the separation, at the time returned.
    WithinTolerance,
    /// The sets are so close that rounding errors hide whether they are apart.
    WithinError,
    /// The work that is allowed is used up.
    OutOfRounds,
    /// Coordinates differ too much, or the separation is too large, for products to be sure not to overflow.
    OutOfRange,
    /// A coordinate is NaN or infinite (or their sum is), or the separation is NaN or negative.
    NotFinite,
}

impl<S: Scalar> Impact<S> {
    /// The time from which on contact is not excluded; `None` if it is excluded throughout.
    #[inline]
    #[must_use]
    pub fn time(&self) -> Option<S> {
        match *self {
            Self::Never => None,
            Self::Possible { time, .. } => Some(time),
        }
    }
}
