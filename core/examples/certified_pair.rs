//! Proves that one pair is free of contact throughout a step.

use selvedge_core::{Motion, PrimitivePair, boxes, filter::certified, glam::DVec3};

fn main() {
    // A vertex falls from 2 to 1 above a triangle that moves with it.
    let fall = |point: DVec3| Motion::new(point, point - DVec3::Z);
    let pair = PrimitivePair::vertex_face(fall(DVec3::new(0.2, 0.2, 2.0)), [DVec3::ZERO, DVec3::X, DVec3::Y].map(fall));

    // Each test is certified: if one culls the pair, it does not touch at any time of the step.
    let boxes = boxes::swept_boxes(&pair).or(boxes::relative::three_axes(&pair));
    let verdict = boxes.or(certified::non_coplanarity(&pair));
    println!("{verdict:?}");
    assert!(verdict.is_culled());
}
