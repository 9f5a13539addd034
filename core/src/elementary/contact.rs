//! The exact verdict: whether a pair touches at some time in [0, 1].
//!
//! [`contact`] errs on neither side, and has no tolerance. It tries in order:
//! 1. the first three rounds of the [certified time of impact](super::advance) with tolerance zero, whose "never" is a proof;
//! 2. [`certain_contact`], a proof of contact around the resulting time;
//! 3. whole numbers, [`exact::touches`], for pairs that floating point leaves open. Examples are contacts at the very start or
//!    end, touching without passing through, coplanar motion, slivers, distances of a rounding error. For everyday
//!    coordinates they take less time than further rounds.
//!
//! ```
//! use selvedge_core::elementary::{ContactVerdict, contact};
//! use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
//!
//! // A vertex that comes down onto a face until it is 1e-300 above it, or touches it at the last moment.
//! let lands_at = |height| PrimitivePair::vertex_face(
//!     Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, height)),
//!     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
//! );
//! assert_eq!(contact(&lands_at(1e-300)), ContactVerdict::Never);
//! assert_eq!(contact(&lands_at(0.0)), ContactVerdict::Happens);
//! ```
//!
//! # Guarantees
//! * **Exact for every finite input**, `f32` and `f64`, subnormal and largest numbers included, in every floating-point
//!   environment. NaN and infinity give [`ContactVerdict::Undefined`].
//! * **Bounded work**: three rounds, at most 18 attempts at confirmation, and in whole numbers what `exact::touches` states.
//!   Nothing iterates until it converges. Time grows with the square of the number of bits between a coordinate's highest and
//!   another's lowest along an axis. Everyday coordinates take microseconds. `f64` coordinates of 1e300 and 1e-300 along one axis
//!   take some milliseconds, and up to 100 kB of stack (x86-64, optimised).

use super::Impact;
use super::advance::{certain_contact, easy_impact};
use crate::exact::{self, Evidence};
use crate::motion::PrimitivePair;
use crate::scalar::Scalar;

/// The exact answer to contact of two moving sets during the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[must_use = "a contact has to be dealt with"]
pub enum ContactVerdict {
    /// The sets share no point at any time.
    Never,
    /// The sets share a point at some time.
    Happens,
    /// A coordinate is NaN or infinite, so there is no answer. The safe choice is to treat it as contact.
    Undefined,
}

/// Returns whether the pair touches at some time in [0, 1]. The result is exact: see the [module](self).
#[inline]
pub fn contact<S: Scalar>(pair: &PrimitivePair<S>) -> ContactVerdict {
    answer(pair, &easy_impact(pair)).0
}

/// Returns [`contact`] and the evidence for it.
#[inline]
pub fn contact_and_evidence<S: Scalar>(pair: &PrimitivePair<S>) -> (ContactVerdict, Evidence) {
    answer(pair, &easy_impact(pair))
}

/// Returns [`contact`] of a pair whose time of impact is already known. `impact` must be this pair's, for separation zero and any
/// tolerance.
///
/// ```
/// use selvedge_core::elementary::{ContactVerdict, Limits, advance::time_of_impact, contact::contact_given_impact};
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// // It comes to rest above an inclined face, by less than the errors of rounding.
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.0, 1.0), DVec3::new(0.2, 0.0, 1e-18)),
///     [DVec3::ZERO, DVec3::X, DVec3::new(0.0, 1.0, 1.0)].map(Motion::resting),
/// );
/// let impact = time_of_impact(&pair, &Limits { tolerance: 1e-6, separation: 0.0 });
/// assert!(impact.time().is_some());
/// assert_eq!(contact_given_impact(&pair, &impact), ContactVerdict::Never);
/// ```
#[cfg(feature = "batch")]
#[inline]
pub fn contact_given_impact<S: Scalar>(pair: &PrimitivePair<S>, impact: &Impact<S>) -> ContactVerdict {
    answer(pair, impact).0
}

#[inline(always)]
fn answer<S: Scalar>(pair: &PrimitivePair<S>, impact: &Impact<S>) -> (ContactVerdict, Evidence) {
    match *impact {
        Impact::Never => (ContactVerdict::Never, Evidence::Separation),
        Impact::Possible { time, .. } => settled_from(pair, time),
    }
}

/// Decides a pair for which contact from `time` on is not excluded.
#[inline(never)]
fn settled_from<S: Scalar>(pair: &PrimitivePair<S>, time: S) -> (ContactVerdict, Evidence) {
    if certain_contact(pair, time).is_some() {
        return (ContactVerdict::Happens, Evidence::Crossing);
    }
    match exact::touches(pair) {
        Some(false) => (ContactVerdict::Never, Evidence::WholeNumbers),
        Some(true) => (ContactVerdict::Happens, Evidence::WholeNumbers),
        None => (ContactVerdict::Undefined, Evidence::Nothing),
    }
}
