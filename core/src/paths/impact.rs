//! The time of impact of a pair on paths.
//!
//! From time t on, one part of the step is tested at a time, on the straight pieces of its four points. The larger deviation of
//! each side is added to the separation. If the pair keeps that distance, it keeps the separation on its paths, and the next part
//! is twice as long. Otherwise it does so until a certified time, and the next part, from there on, is half as long. When the
//! deviations are at most the tolerance, that time is the answer.
//!
//! # Rounding
//! The [sum of separation and deviations](separation_of_pieces) is rounded up. A time t in [0, 1] within the part, found for the
//! straight pieces, is the time from + (to − from)·t of the step. It takes three operations, and one that subtracts 16u, and is
//! never less than `from`.

use super::{Path, u};
use crate::elementary::{Impact, Limits, Reason, advance};
use crate::kind::PairKind;
use crate::motion::PrimitivePair;

/// The largest number of parts that are tested for one pair.
const PARTS: u32 = 4096;
/// The length below which parts are not cut.
const SHORTEST: f64 = 1.0 / 1_073_741_824.0;

/// Returns the time from which on a pair on these paths may be within the separation. It is certified: no contact is earlier,
/// rounding and the bend of the paths included, as long as each path's [deviation](super::Piece::deviation) is correct.
///
/// `paths` are the points of the one set, then those of the other, as in a [`PrimitivePair`]. Runs at most 4096 straight tests.
///
/// # No false alarms
/// All distances are up to [rounding](crate::elementary::advance#guarantees).
/// * [`Reason::WithinTolerance`]: at that time the distance is at most s + 3δ. Far from the origin, paths may deviate by D > δ
///   even in parts as short as 2⁻³⁰ of the step. Then it is at most s + δ + 2D.
/// * [`Reason::LastResort`]: the pair comes within s + δ + 2D at some time, with D the largest deviation in parts of a 512th of
///   the step. (Each test passes a part and doubles it, or halves it. Some 2000 of 4096 tests pass a part of the one step. So
///   parts of at most a 512th are halved, and there the pair comes so near.)
///
/// ```
/// use selvedge_core::{Motion, PairKind, glam::DVec3, elementary::{Impact, Limits}, paths::{Path, RigidMotion, time_of_impact}};
/// // The tip of a plank makes half a turn about the origin, through a wall at x = 0 that its straight path would pass behind.
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

/// Returns the distance that points must keep on straight pieces so that they keep `separation` on their paths, rounding
/// included.
///
/// `deviation` is the largest [deviation](super::Piece::deviation) of the paths of the two sides, added up. The offsets between
/// two points, one of each side, on pieces and on paths differ by at most that. Three operations, each within 2u: 16u of it is
/// added.
#[must_use]
pub fn separation_of_pieces(separation: f64, deviation: f64) -> f64 {
    (separation + deviation) * (1.0 + 16.0 * u())
}

/// Returns the sum of the largest values over the points of each side; NaN if a value is NaN.
pub(super) fn of_both_sides(kind: PairKind, [a, b, c, d]: [f64; 4]) -> f64 {
    // A maximum may drop NaN.
    let unknown = 0.0 * (a + b + c + d);
    let (first, second) = match kind {
        PairKind::VertexFace => (a, b.max(c).max(d)),
        PairKind::EdgeEdge => (a.max(b), c.max(d)),
    };
    first + second + unknown
}

/// Returns the time of impact in a part of the step, from its first time to its second: [`Impact::Never`] concerns that part
/// only.
///
/// If the times are not in [0, 1], or do not ascend, nothing is excluded from time 0 on.
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
    possible(from, Reason::LastResort)
}
