//! Computes a time of impact that is never too late.

use selvedge_core::elementary::{Impact, Limits, advance::time_of_impact};
use selvedge_core::{Motion, PrimitivePair, glam::DVec3};

fn main() {
    // Two crossing edges: the upper one falls from 1 above the other to 1 below it.
    let fall = |point: DVec3| Motion::new(point + DVec3::Z, point - DVec3::Z);
    let pair = PrimitivePair::edge_edge(
        [DVec3::NEG_X, DVec3::X].map(Motion::resting),
        [DVec3::NEG_Y, DVec3::Y].map(fall),
    );

    match time_of_impact(&pair, &Limits::default()) {
        Impact::Never => println!("certainly no contact"),
        Impact::Possible { time, reason } => {
            println!("certainly no contact before {time} ({reason:?})");
            assert!(time <= 0.5 && time > 0.499_999);
        }
    }
}
