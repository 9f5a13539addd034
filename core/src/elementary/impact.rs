//! The parameters and the result of a time of impact.

use crate::lanes::power_of_two_f64;
use crate::scalar::Scalar;

/// The distance that counts as contact, and the tolerance of the answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits<S> {
    /// δ, a length: the sets count as in contact when they are at most that much more than `separation` apart. With zero, or less
    /// than the rounding error, the answer is as tight as the proof allows.
    pub tolerance: S,
    /// s, a length: the distance that the sets must keep. Zero means that they must not touch. A negative or NaN separation
    /// excludes nothing.
    pub separation: S,
}

impl<S: Scalar> Limits<S> {
    /// Returns limits with this separation and the [default](Self::default) tolerance.
    #[inline]
    #[must_use]
    pub fn within(separation: S) -> Self {
        Self {
            separation,
            ..Self::default()
        }
    }

    /// Returns limits without a separation, with this tolerance.
    #[inline]
    #[must_use]
    pub const fn accurate_to(tolerance: S) -> Self {
        let separation = S::ZERO;
        Self { tolerance, separation }
    }
}

impl<S: Scalar> Default for Limits<S> {
    /// Returns the limits of contact without a separation. The tolerance is 2⁻³⁰ (`f64`, about 1e-9) or 2⁻²⁰ (`f32`, about 1e-6):
    /// for positions in metres, a nanometre or a micrometre. A finer tolerance costs little more.
    #[inline]
    fn default() -> Self {
        Self {
            tolerance: S::from_f64(power_of_two_f64(if S::FRACTION_BITS < 52 { -20 } else { -30 })),
            separation: S::ZERO,
        }
    }
}

/// The time from which two moving sets may be within the separation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use = "what is not excluded has to be dealt with"]
pub enum Impact<S> {
    /// Contact is excluded: at all times in [0, 1] the sets are farther apart than the separation.
    Never,
    /// Contact cannot be ruled out from `time` on. It certainly does not happen before.
    Possible {
        /// A time in [0, 1], no later than the first time at which the sets are within the separation, if there is one.
        time: S,
        /// The reason why no later time is proven.
        reason: Reason,
    },
}

/// The reason why advancing stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reason {
    /// At the returned time, the sets are within the tolerance of the separation.
    WithinTolerance,
    /// The sets are so close at the time returned that rounding errors hide whether they are farther apart than the separation.
    WithinError,
    /// The allowed work is used up. Without a separation, the sets touch at the returned time or later, which whole numbers
    /// prove. With one, they come within a bound that the documentation of the function states.
    LastResort,
    /// With a separation, coordinates of `f64` differ too much, or it is too large, to be sure that products do not overflow.
    OutOfRange,
    /// A coordinate is NaN or infinite (or their sum is), or the separation is NaN or negative.
    NotFinite,
}

impl<S: Scalar> Impact<S> {
    /// Returns the time from which contact cannot be ruled out, or `None` if it is excluded throughout.
    #[inline]
    #[must_use]
    pub fn time(&self) -> Option<S> {
        match *self {
            Self::Never => None,
            Self::Possible { time, .. } => Some(time),
        }
    }
}
