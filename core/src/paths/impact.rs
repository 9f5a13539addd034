//! When a pair on paths that are not straight may be closer than it should.
//!
//! From time t on, a part of the step is asked about at a time: on the straight pieces of its four points, with the larger deviation of each side
//! added to the separation. If the pair keeps that, it keeps the separation on its paths, and the next part is twice as long. If not, it does so
//! until a certified time; from there on the part is half as long. When the deviations are no more than the tolerance, that time is the answer.
//!
//! # Rounding
//! The [sum of separation and deviations](separation_of_pieces) is rounded up. A time t within the part, found for the straight pieces in
//! [0, 1], is the time from + (to − from)·t of the step: three operations, and one to take 16u off; never less than `from`.

use super::{Path, u};
use crate::elementary::{Impact, Limits, Reason, advance};
use crate::kind::PairKind;
use crate::motion::PrimitivePair;

/// Most parts that are asked about, of one pair.
const PARTS: u32 = 4096;
/// A part that is no longer is not cut.
const SHORTEST: f64 = 1.0 / 1_073_741_824.0;

/// From when on a pair on these paths may be within the separation. Certified: no contact is earlier, rounding and the bend of the paths
/// included, as long as each path's [deviation](super::Piece::deviation) is what it says.
///
/// `paths` are the points of the one set, then those of the other, as in a [`PrimitivePair`]. With [`Reason::WithinTolerance`] the distance at
/// that time is at most s + 3δ, but for [what is rounded](crate::elementary::advance#what-is-promised). At most 4096 straight tests.
///
/// ```
/// use selvedge_core::{Motion, PairKind, glam::DVec3, elementary::{Impact, Limits}, paths::{Path, RigidMotion, time_of_impact}};
/// // The tip of a plank makes half a turn about the origin, through a wall at x = 0 that its straight way would pass behind.
/// let plank = RigidMotion::new(DVec3::ZERO, DVec3::Z, core::f64::consts::PI, DVec3::ZERO).unwrap();
/// let tip = plank.path(DVec3::X);
/// let wall = [DVec3::new(0.0, 0.9, -1.0), DVec3::new(0.0, 0.9, 1.0), DVec3::new(0.0, 1.5, 0.0)].map(Motion::resting);
/// let paths: [&dyn Path; 4] = [&tip, &wall[0], &wall[1], &wall[2]];
/// let time = time_of_impact(PairKind::VertexFace, paths, &Limits::default()).time().expect("a contact");
/// assert!(time <= 0.5 && time > 0.499_999);
/// ```
pub fn time_of_impact(kind: PairKind, paths: [&dyn Path; 4], limits: &Limits<f64>) -> Impact<f64> {
    between(kind, paths, limits, [0.0, 1.0])
}

/// The distance that points are to keep on straight pieces, so that they keep `separation` on their paths, rounding included.
///
/// `deviation` is what the paths of the two sides [deviate](super::Piece::deviation) at most, added up: within that sum of it are the ways
/// between two points, one of each side, on pieces and on paths. Three operations, each within 2u: 16u of it is added.
#[must_use]
pub fn separation_of_pieces(separation: f64, deviation: f64) -> f64 {
    (separation + deviation) * (1.0 + 16.0 * u())
}

/// The largest of what the points of each side deviate, added up; NaN if one is.
pub(super) fn of_both_sides(kind: PairKind, [a, b, c, d]: [f64; 4]) -> f64 {
    // A maximum may drop NaN.
    let unknown = 0.0 * (a + b + c + d);
    let (first, second) = match kind {
        PairKind::VertexFace => (a, b.max(c).max(d)),
        PairKind::EdgeEdge => (a.max(b), c.max(d)),
    };
    first + second + unknown
}

/// The same of a part of the step, from its first time to its second: [`Impact::Never`] is said of that part only.
///
/// Not in [0, 1], or not ascending: nothing is excluded from time 0 on.
pub(super) fn between(kind: PairKind, paths: [&dyn Path; 4], limits: &Limits<f64>, [mut from, end]: [f64; 2]) -> Impact<f64> {
    let possible = |time, reason| Impact::Possible { time, reason };
    if !(from >= 0.0 && from < end && end <= 1.0) {
        return possible(0.0, Reason::NotFinite);
    }
    let mut length = end - from;
    for _ in 0..PARTS {
        let to = (from + length).min(end);
        if to <= from {
            return possible(from, Reason::WithinError);
        }
        let pieces = paths.map(|path| path.piece(from, to));
        let deviation = of_both_sides(kind, pieces.map(|piece| piece.deviation));
        let straight = Limits {
            separation: separation_of_pieces(limits.separation, deviation),
            ..*limits
        };
        let motions = pieces.map(|piece| piece.motion);
        match advance::time_of_impact(&PrimitivePair { kind, motions }, &straight) {
            Impact::Never if to >= end => return Impact::Never,
            Impact::Never => {
                from = to;
                length *= 2.0;
            }
            Impact::Possible { time, reason } => {
                from = ((from + (to - from) * time) * (1.0 - 16.0 * u())).max(from);
                let is_cut = deviation > limits.tolerance && length > SHORTEST;
                if !is_cut {
                    return possible(from, reason);
                }
                length *= 0.5;
            }
        }
    }
    possible(from, Reason::OutOfRounds)
}
