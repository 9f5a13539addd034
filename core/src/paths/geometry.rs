//! The geometry of a contact on paths.

use super::impact::{of_both_sides, separation_of_pieces};
use super::{Moment, Path};
use crate::kind::PairKind;
use crate::separation::geometry::{Geometry, Instant, of_instants};
use crate::separation::largest_coordinate;

/// Computes the geometry of a pair on its paths at a time in [0, 1], as for a [contact](super::time_of_impact).
///
/// `paths` are the points of one set, then those of the other, as in a [`PrimitivePair`](crate::PrimitivePair).
///
/// The [guarantees for straight motion](crate::separation::geometry) hold with B and D of the positions at that time, plus the
/// errors that the paths state. Each point is off by the largest [position error](Moment::position_error) of its side in
/// addition. The range of the distance is wider by those of both sides, and the speed is off by those of
/// [velocities](Moment::velocity_error). There is a normal if, despite rounding and these errors, the sides were certainly apart
/// along it.
///
/// ```
/// use selvedge_core::{Motion, PairKind, glam::DVec3, paths::{Path, RigidMotion, geometry}};
/// // The tip of a plank makes half a turn about the origin, and passes the side of a wall at half of the step.
/// let plank = RigidMotion::new(DVec3::ZERO, DVec3::Z, core::f64::consts::PI, DVec3::ZERO).unwrap();
/// let tip = plank.path(DVec3::X);
/// let wall = [DVec3::new(-0.5, 0.0, -1.0), DVec3::new(-0.5, 0.0, 1.0), DVec3::new(-0.5, 4.0, 0.0)].map(Motion::resting);
/// let paths: [&dyn Path; 4] = [&tip, &wall[0], &wall[1], &wall[2]];
/// let found = geometry(PairKind::VertexFace, paths, 0.5);
/// assert_eq!(found.normal, Some(DVec3::X));
/// assert!(found.distance[0] <= 0.5 && found.distance[1] >= 0.5 && found.distance[1] < 0.5 + 1e-12);
/// assert!((found.speed + core::f64::consts::PI).abs() < 1e-12);
/// ```
#[must_use]
pub fn geometry(kind: PairKind, paths: [&dyn Path; 4], time: f64) -> Geometry {
    let is_time = (0.0..=1.0).contains(&time);
    let at = |time: f64| {
        let moments = paths.map(|path| path.moment(time));
        let [first, ..] = moments;
        let points = moments.map(|moment| moment.position - first.position);
        let error = of_both_sides(kind, moments.map(|moment: Moment| moment.position_error));
        Instant {
            origin: first.position,
            points,
            velocities: moments.map(|moment| moment.velocity - first.velocity),
            largest: largest_coordinate(&points),
            // The error is rounded up.
            error: separation_of_pieces(0.0, error),
        }
    };
    of_instants(kind, is_time.then_some(time), at)
}
