//! Answers of the time of impact that carry their proof.
//!
//! A checker that shares no code with this crate can verify it in exact numbers. `docs/witnesses.md` of the project states what
//! each proof requires.

use super::{Impact, Limits, ROUNDS, advanced, normal};
use crate::lanes::Number;
use crate::motion::PrimitivePair;
use crate::scalar::Scalar;
use crate::vector::Vector;
use arrayvec::ArrayVec;

/// The largest number of parts of a [`Witness`]: a constant and a turning direction in each round.
pub const WITNESS_PARTS: usize = 2 * ROUNDS as usize;

/// A proof that a pair is apart from the start of the step until some time: consecutive parts, each with its own proof.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness<S> {
    parts: ArrayVec<WitnessPart<S>, WITNESS_PARTS>,
}

/// A part of the step, from the end of the part before, and why the pair is apart in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WitnessPart<S> {
    /// The end of the part, a time in [0, 1].
    pub until: S,
    /// The proof.
    pub proof: Proof<S>,
}

/// Why a pair stays farther apart than the separation s during a part of the step.
///
/// A corner is a difference of two points, one of each set, and |w| the length of w. Each product is a polynomial in time whose
/// Bernstein coefficients exceed those of s·|w|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Proof<S> {
    /// The signed volume of the first three corners, less s times the length of their normal, keeps its sign.
    Volume,
    /// The product of each corner with this direction exceeds s·|w|.
    Held([S; 3]),
    /// As `Held`, for a direction that moves linearly from the first to the second.
    Turning([[S; 3]; 2]),
    /// As `Held`, for a direction that moves on a quadratic curve. Its control points are the first, half of the second, and the
    /// third.
    Curving([[S; 3]; 3]),
}

impl<S> Witness<S> {
    /// The parts, in the order of time. The first begins at time zero.
    #[inline]
    #[must_use]
    pub fn parts(&self) -> &[WitnessPart<S>] {
        &self.parts
    }
}

/// Returns the time from which the pair may be within the separation, and a proof that it is farther apart before.
///
/// For [`Impact::Never`] the proof lasts to the end of the step, otherwise to the time returned. The answer is that of
/// [`time_of_impact`](super::time_of_impact), except in two cases, where that asks other arithmetic: if it takes more than
/// [`ROUNDS`] rounds, this is [`LastResort`](super::Reason::LastResort) with the time that so many rounds prove; if coordinates
/// differ too much, it is [`OutOfRange`](super::Reason::OutOfRange) at time zero.
///
/// ```
/// use selvedge_core::elementary::{Impact, Limits, advance::{Proof, witness}};
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// let at = |height| DVec3::new(0.2, 0.2, height);
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(at(2.0), at(1.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// let (impact, witness) = witness(&pair, &Limits::default());
/// assert_eq!(impact, Impact::Never);
/// // One direction, upwards, keeps the vertex above the face during the whole step.
/// assert_eq!(witness.parts().len(), 1);
/// assert_eq!(witness.parts()[0].until, 1.0);
/// assert_eq!(witness.parts()[0].proof, Proof::Held([0.0, 0.0, 1.0]));
/// ```
pub fn witness<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>) -> (Impact<S>, Witness<S>) {
    let limits = normal(limits);
    let mut witness = Witness { parts: ArrayVec::new() };
    let span = [S::ZERO, S::ONE];
    let (impact, _) = of_kind!(pair.kind, P => advanced::<P, S, _>(&pair.into(), &limits, span, ROUNDS, &mut witness));
    (impact, witness)
}

/// Receives the proofs that advancing finds.
pub(super) trait Record<S> {
    /// Adds a part that ends at `until`, or at the end of the step.
    fn add(&mut self, until: S, proof: Proof<S>);

    /// Replaces the last part by one that begins at the same time.
    fn replace(&mut self, until: S, proof: Proof<S>);

    /// Adds a part to the end of the step for the axis along which all `corners` are beyond `bar` on one side. Returns false if
    /// there is none.
    fn add_axis<I: Iterator<Item = Vector<S>>>(&mut self, corners: impl Fn() -> I, bar: S) -> bool;
}

pub(super) struct Unrecorded;

impl<S> Record<S> for Unrecorded {
    #[inline(always)]
    fn add(&mut self, _: S, _: Proof<S>) {}

    #[inline(always)]
    fn replace(&mut self, _: S, _: Proof<S>) {}

    #[inline(always)]
    fn add_axis<I: Iterator<Item = Vector<S>>>(&mut self, _: impl Fn() -> I, _: S) -> bool {
        true
    }
}

impl<S: Number> Record<S> for Witness<S> {
    fn add(&mut self, until: S, proof: Proof<S>) {
        let until = until.smaller(S::ONE);
        // There is room for two parts in each round.
        let _ = self.parts.try_push(WitnessPart { until, proof });
    }

    fn replace(&mut self, until: S, proof: Proof<S>) {
        self.parts.pop();
        self.add(until, proof);
    }

    fn add_axis<I: Iterator<Item = Vector<S>>>(&mut self, corners: impl Fn() -> I, bar: S) -> bool {
        for axis in 0..3 {
            for sign in [S::ONE, -S::ONE] {
                let mut along = corners().map(|corner| sign * <[S; 3]>::from(corner)[axis]);
                if along.all(|x| x > bar) {
                    let mut w = [S::ZERO; 3];
                    w[axis] = sign;
                    self.add(S::ONE, Proof::Held(w));
                    return true;
                }
            }
        }
        false
    }
}
