//! Paths of several straight pieces.

use super::{Moment, Path, Piece, largest, length_above, u};
use crate::lanes::Rounding;
use crate::motion::Motion;
use glam::DVec3;

/// A path from knot to knot, at constant velocity between two of them.
///
/// ```
/// use selvedge_core::{glam::DVec3, paths::{Path, Polyline}};
/// let knots = [DVec3::ZERO, DVec3::X, DVec3::ZERO];
/// let path = Polyline::new(&[0.0, 0.5, 1.0], &knots).unwrap();
/// // There and back: at rest, apart from the path to the knot.
/// let piece = path.piece(0.0, 1.0);
/// assert!(piece.motion.end == DVec3::ZERO && piece.deviation >= 1.0);
/// assert!(path.piece(0.0, 0.5).deviation < 1e-13);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polyline<'a> {
    times: &'a [f64],
    positions: &'a [DVec3],
    /// A bound of the rounding error of a position.
    rounding: f64,
}

impl<'a> Polyline<'a> {
    /// Makes a path through `positions` at these `times`.
    ///
    /// Returns `None` unless there are as many times as positions, times ascend strictly from 0 to 1, and all positions are
    /// finite.
    #[must_use]
    pub fn new(times: &'a [f64], positions: &'a [DVec3]) -> Option<Self> {
        let ascend = times.iter().zip(times.iter().skip(1)).all(|(before, after)| before < after);
        let span = times.first() == Some(&0.0) && times.last() == Some(&1.0);
        let are_finite = positions.iter().all(|position| position.is_finite());
        let size = positions.iter().copied().map(largest).fold(0.0, f64::max);
        (ascend && span && are_finite && times.len() == positions.len()).then_some(Self {
            times,
            positions,
            // The time within a piece takes three operations, of a path of at most 2B along each axis, and the place adds 8u of
            // B: 35u of it in all.
            rounding: 48.0 * u() * size + <f64 as Rounding>::UNDERFLOW,
        })
    }

    /// Returns the last knot for which `is_before` holds, and the one after it. `is_before` must hold for a first part of the
    /// knots only.
    fn knots(&self, is_before: impl Fn(f64) -> bool) -> [Option<(f64, DVec3)>; 2] {
        let after = self.times.partition_point(|&knot| is_before(knot));
        let knot = |index: usize| Some((*self.times.get(index)?, *self.positions.get(index)?));
        [after.checked_sub(1).and_then(knot), knot(after)]
    }

    fn at(&self, time: f64) -> DVec3 {
        match self.knots(|knot| knot <= time).into() {
            (Some((begin, from)), Some((end, to))) => {
                let share = ((time - begin) / (end - begin)).clamp(0.0, 1.0);
                Motion::<f64>::new(from, to).at(share)
            }
            // This is at the last knot.
            (Some((_, last)), None) => last,
            _ => DVec3::NAN,
        }
    }
}

impl Path for Polyline<'_> {
    fn piece(&self, from: f64, to: f64) -> Piece {
        let motion = Motion::new(self.at(from), self.at(to));
        let inner = self
            .times
            .iter()
            .zip(self.positions)
            .filter(|&(&time, _)| from < time && time < to);
        // Between knots both are straight, so they are farthest apart at a knot or at an end.
        let bent = inner.map(|(&time, &knot)| length_above(knot - motion.at((time - from) / (to - from))));
        let bent = bent.fold(0.0, f64::max);
        Piece {
            motion,
            // The ends are off by at most one rounding error, and so is the place at the time of a knot. There are two roundings.
            deviation: (bent + 2.0 * self.rounding) * (1.0 + 16.0 * u()),
        }
    }

    fn moment(&self, time: f64) -> Moment {
        // At a knot, the piece that leads to it counts.
        let (velocity, lasts) = match self.knots(|knot| knot < time || knot == 0.0).into() {
            (Some((begin, from)), Some((end, to))) => ((to - from) / (end - begin), end - begin),
            _ => (DVec3::NAN, f64::NAN),
        };
        Moment {
            position: self.at(time),
            position_error: self.rounding,
            velocity,
            // There are three operations, of a path of at most 2B along each axis: 21u of it over the time, and the quotient.
            velocity_error: self.rounding / lasts,
        }
    }
}
