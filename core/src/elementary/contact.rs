//! The exact verdict: does a pair touch at some time in [0, 1], yes or no.
//!
//! [`contact`] never errs on either side, and has no tolerance. It asks, one after the other:
//! 1. the [certified time of impact](super::advance) with tolerance zero, whose "never" is a proof;
//! 2. [`certain_contact`], a proof of contact around the time that came of it;
//! 3. for `f32` positions, which `f64` holds exactly, both again in `f64`, whose errors are half a billion times smaller;
//! 4. whole numbers, [`exact::touches`], for what floating point leaves open: contacts at the very start or end, touching
//!    without passing through, coplanar motion, distances of a rounding error.
//!
//! ```
//! use selvedge_core::elementary::{Contact, contact};
//! use selvedge_core::{glam::DVec3, Motion, VertexFace};
//!
//! // A vertex that comes down onto a face until it is 1e-300 above it, or touches it at the last moment.
//! let lands_at = |height| VertexFace {
//!     vertex: Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, height)),
//!     face: [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
//! };
//! assert_eq!(contact(&lands_at(1e-300)), Contact::Never);
//! assert_eq!(contact(&lands_at(0.0)), Contact::Happens);
//! ```
//!
//! # What is promised
//! * **The truth, for every finite input**, `f32` and `f64`, subnormal and largest numbers included, in every floating-point environment.
//!   NaN and infinity have no truth: [`Contact::Undefined`].
//! * **A bounded amount of work**: that of the [time of impact](super::advance), at most 18 attempts at confirmation, and in
//!   whole numbers what `exact::touches` states: nothing is refined until it is good enough. Time grows with the square of the
//!   number of bits from a coordinate's highest to another's lowest along an axis: microseconds with everyday coordinates, some milliseconds
//!   where `f64` coordinates of 1e300 and 1e-300 come together along one axis, which also take up to 100 kB of stack (x86-64, optimised).

use super::advance::confirm::certain_contact;
use super::advance::{time_of_impact, time_of_impact_within};
use super::{Impact, Limits};
use crate::PairKind;
use crate::exact;
use crate::motion::{EdgeEdge, Motion, PrimitivePair, VertexFace};
use crate::points::PairShape;
use crate::scalar::Scalar;
use glam::DVec3;

/// Whether two moving sets share a point at some time in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[must_use = "a contact has to be dealt with"]
pub enum Contact {
    /// At no time.
    Never,
    /// At some time.
    Happens,
    /// A coordinate is NaN or infinite, so there is no answer. To be on the safe side, take it for contact.
    Undefined,
}

/// What an exact verdict rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Evidence {
    /// The time of impact's proof that the sets stay apart, in floating point.
    Separation,
    /// The proof that one set passes through the other, in floating point.
    Crossing,
    /// Arithmetic in whole numbers.
    WholeNumbers,
    /// Nothing: the input is not finite.
    Nothing,
}

/// Whether the pair touches at some time in [0, 1]. Exact: see the [module](self).
#[inline]
pub fn contact<S: Scalar, P: PrimitivePair<S>>(pair: &P) -> Contact {
    contact_and_evidence(pair).0
}

/// [`contact`], and what the answer rests on.
#[inline]
pub fn contact_and_evidence<S: Scalar, P: PrimitivePair<S>>(pair: &P) -> (Contact, Evidence) {
    let limits = Limits {
        tolerance: S::ZERO,
        separation: S::ZERO,
    };
    settled(pair, &time_of_impact(pair, &limits))
}

/// The same for a pair whose time of impact is known already, for separation zero and any tolerance: the answer to it makes a
/// verdict of `impact`, which must be this pair's.
///
/// ```
/// use selvedge_core::elementary::{Contact, Limits, advance::time_of_impact, contact::settled};
/// use selvedge_core::{glam::DVec3, Motion, VertexFace};
/// // It comes to rest above an inclined face, by less than the errors of rounding.
/// let pair = VertexFace {
///     vertex: Motion::new(DVec3::new(0.2, 0.0, 1.0), DVec3::new(0.2, 0.0, 1e-18)),
///     face: [DVec3::ZERO, DVec3::X, DVec3::new(0.0, 1.0, 1.0)].map(Motion::resting),
/// };
/// let impact = time_of_impact(&pair, &Limits { tolerance: 1e-6, separation: 0.0 });
/// assert!(impact.time().is_some());
/// assert_eq!(settled(&pair, &impact).0, Contact::Never);
/// ```
#[inline]
pub fn settled<S: Scalar, P: PrimitivePair<S>>(pair: &P, impact: &Impact<S>) -> (Contact, Evidence) {
    match *impact {
        Impact::Never => (Contact::Never, Evidence::Separation),
        Impact::Possible { time, .. } => settled_from(pair, time),
    }
}

/// Where contact from `time` on is not excluded.
#[inline(never)]
fn settled_from<S: Scalar, P: PrimitivePair<S>>(pair: &P, time: S) -> (Contact, Evidence) {
    if certain_contact(pair, time).is_some() {
        return (Contact::Happens, Evidence::Crossing);
    }
    if let Some(answer) = settled_in_f64(pair, time) {
        return answer;
    }
    match exact::touches::<P::Shape, S>(&pair.points()) {
        Some(false) => (Contact::Never, Evidence::WholeNumbers),
        Some(true) => (Contact::Happens, Evidence::WholeNumbers),
        None => (Contact::Undefined, Evidence::Nothing),
    }
}

/// What `f64` proves of a narrower format's pair, for which contact from `time` on is not excluded.
fn settled_in_f64<S: Scalar, P: PrimitivePair<S>>(pair: &P, time: S) -> Option<(Contact, Evidence)> {
    if S::FRACTION_BITS + 1 >= f64::MANTISSA_DIGITS {
        return None;
    }
    let exactly = |position: S::Vector| {
        let [x, y, z]: [S; 3] = position.into();
        DVec3::new(x.to_f64(), y.to_f64(), z.to_f64())
    };
    let [a, b, c, d] = pair
        .motions()
        .map(|point| Motion::new(exactly(point.start), exactly(point.end)));
    let from = time.to_f64();
    match P::Shape::KIND {
        PairKind::VertexFace => {
            let face = [b, c, d];
            proven(&VertexFace { vertex: a, face }, from)
        }
        PairKind::EdgeEdge => {
            let (first, second) = ([a, b], [c, d]);
            proven(&EdgeEdge { first, second }, from)
        }
    }
}

/// What floating point proves of a pair that is known to be apart before `from`.
fn proven<P: PrimitivePair<f64>>(pair: &P, from: f64) -> Option<(Contact, Evidence)> {
    let limits = Limits {
        tolerance: 0.0,
        separation: 0.0,
    };
    let Some(time) = time_of_impact_within(pair, &limits, from, 1.0).time() else {
        return Some((Contact::Never, Evidence::Separation));
    };
    certain_contact(pair, time).map(|_| (Contact::Happens, Evidence::Crossing))
}
