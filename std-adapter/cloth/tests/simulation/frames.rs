//! A frame has as many steps as what is about to happen in it needs.

use crate::common::*;

/// A sheet of edges of 25 to 36 mm, and a ball beside it with this motion.
fn beside(motion: BodyMotion) -> Simulation {
    let cloth = Cloth::sheet(DVec3::ZERO, [0.2 * DVec3::X, 0.2 * DVec3::Z], [8, 8], 0.2).unwrap();
    let mut scene = Scene::new(cloth, 1e-3);
    let mut ball = Body::ball("ball", 0.15 * DVec3::Y, 0.1, 16).unwrap();
    ball.motion = motion;
    scene.bodies.push(ball);
    scene.add(Stretch::isotropic(400.0));
    scene.add(BodyContact(Thickness::new(3e-3)));
    Simulation::new(scene, 1).unwrap()
}

const FRAME: f64 = 1.0 / 60.0;
/// A way in a frame, in m, and the steps that it takes if no step goes farther than half of the longest edge.
const WAY: f64 = 0.2;
const STEPS: u32 = 12;

#[test]
fn a_body_that_the_caller_starts_with_a_jerk_has_short_steps_from_the_first_one_on() {
    let mut simulation = beside(BodyMotion::Driven(Placement::default()));
    let at_rest = simulation.advance(FRAME).unwrap();
    simulation.place_body(0, Placement::at(WAY * DVec3::X)).unwrap();
    let at_start = simulation.advance(FRAME).unwrap();
    let after_stop = (0..2).map(|_| simulation.advance(FRAME).unwrap().steps).last();
    assert!(at_start.steps >= STEPS && at_start.steps == at_start.needed, "{at_start:?}");
    assert_eq!(after_stop, Some(at_rest.steps));
}

#[test]
fn a_body_that_keyframes_start_with_a_jerk_has_short_steps_from_the_first_one_on() {
    let key = |frame: f64, way: f64| Keyframe {
        time: frame * FRAME,
        translation: way * DVec3::X,
        angle: 0.0,
    };
    // Also within a frame.
    for [start, stop] in [[1.0, 2.0], [1.3, 1.7]] {
        let keys = vec![key(0.0, 0.0), key(start, 0.0), key(stop, WAY), key(3.0, WAY)];
        let motion = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, keys).unwrap();
        let mut simulation = beside(motion.into());
        let steps: Vec<_> = (0..3).map(|_| simulation.advance(FRAME).unwrap().steps).collect();
        assert!(steps[0] < STEPS / 2 && steps[1] >= STEPS && steps[2] < STEPS / 2, "{steps:?}");
    }
}
