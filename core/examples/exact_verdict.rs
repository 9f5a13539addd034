//! Decides contact exactly, where rounding errors hide the answer.

use selvedge_core::elementary::{ContactVerdict, contact};
use selvedge_core::{Motion, PrimitivePair, glam::DVec3};

fn main() {
    // A vertex comes down onto a face until it is 1e-300 above it, or touches it at the last moment.
    for (height, expected) in [(1e-300, ContactVerdict::Never), (0.0, ContactVerdict::Happens)] {
        let pair = PrimitivePair::vertex_face(
            Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, height)),
            [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
        );
        let verdict = contact(&pair);
        println!("down to {height:e}: {verdict:?}");
        assert_eq!(verdict, expected);
    }
}
