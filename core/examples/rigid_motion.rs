//! Finds the contact of a rotating body along its true arc.

use selvedge_core::elementary::Limits;
use selvedge_core::paths::{Path, RigidMotion, time_of_impact};
use selvedge_core::{Motion, PairKind, glam::DVec3};
use std::f64::consts::PI;

fn main() {
    // The tip of a plank makes half a turn about the origin. Its straight way would pass behind the wall.
    let plank = RigidMotion::new(DVec3::ZERO, DVec3::Z, PI, DVec3::ZERO).expect("finite numbers");
    let tip = plank.path(DVec3::X);
    let wall = [
        DVec3::new(0.0, 0.9, -1.0),
        DVec3::new(0.0, 0.9, 1.0),
        DVec3::new(0.0, 1.5, 0.0),
    ]
    .map(Motion::resting);

    let paths: [&dyn Path; 4] = [&tip, &wall[0], &wall[1], &wall[2]];
    let time = time_of_impact(PairKind::VertexFace, paths, &Limits::default()).time();
    println!("certainly no contact before {time:?}");
    assert!(time.is_some_and(|time| time <= 0.5 && time > 0.499_999));
}
