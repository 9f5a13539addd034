//! Keeps a pair at a distance: culling and time of impact with a separation.

use selvedge_core::elementary::{Limits, advance::time_of_impact};
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::{Motion, PrimitivePair, glam::DVec3};

fn main() {
    // A vertex sinks from 0.3 to 0.1 above a triangle.
    let pair = PrimitivePair::vertex_face(
        Motion::new(DVec3::new(0.2, 0.2, 0.3), DVec3::new(0.2, 0.2, 0.1)),
        [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
    );
    for separation in [0.09, 0.15] {
        let filter = Filter::new(Tier::Permanent).with_separation(separation).expect("a length");
        let limits = Limits::within(separation);
        let keeps = filter.verdict(&pair).is_culled();
        let time = time_of_impact(&pair, &limits).time();
        println!("keeps {separation}: {keeps}; within it from {time:?}");
        assert_eq!(keeps, time.is_none());
    }
}
