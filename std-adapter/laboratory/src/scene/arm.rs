//! A sleeve on an arm that bends at the elbow until the inner side folds onto itself.
//!
//! The motion is a formula, not a simulation. A position depends only on the position at rest and on the time. So any frame is
//! available without earlier ones, and every refinement of the sleeve moves alike. The cloth may pass through itself: late in the
//! bend, the prescribed motion takes the folds into each other.
//!
//! All lengths are in metres. At rest the sleeve lies along the x axis and the inner side of the
//! elbow faces y; the forearm turns in the x-y plane.

use libm::{cos, sin};
use selvedge::{Mesh, Topology};
use selvedge_cloth::sleeve::{RefinementError, sleeve};
use selvedge_core::glam::DVec3;
use std::f64::consts::TAU;

/// The angle of the elbow's bend, in radians: 143°, about as far as a person can.
const BEND: f64 = 2.5;
/// The place of the elbow's middle along the sleeve.
const ELBOW: f64 = 0.29;
/// The bend is spread over this length of the sleeve on either side of the elbow. At the end its radius is 2 × 0.06 / 2.5 =
/// 0.048, less than the sleeve's there, 0.062. So the inner side must meet itself.
const BEND_REACH: f64 = 0.06;
/// The relative excess of the sleeve's width over its depth at the elbow.
const FLATTENING: f64 = 0.12;

/// The folds on the inner side of the elbow, between which it closes.
const FOLDS: Waves = Waves {
    height: 0.017,
    length: 0.075,
    reach: 0.14,
    slant: 0.9,
};
/// The wrinkles that run around the whole sleeve, lower than the folds.
const WRINKLES: Waves = Waves {
    height: 0.006,
    length: 0.11,
    reach: 0.3,
    slant: 1.5,
};

/// A sleeve on a bending arm, over [`STEPS`](Self::STEPS) time steps.
///
/// The first frame is the plain [`sleeve`], free of self-intersection. So are about the first two thirds of the bend. In the last
/// quarter vertices, edges and faces of the folds collide: at the paper's size, a few tens of contacts in a step.
///
/// Positions are the same bits on every platform. They consist of additions, multiplications, divisions and square roots, which
/// IEEE 754 fixes, and of sine and cosine from the `libm` crate.
///
/// ```
/// use selvedge_laboratory::scene::ArmScene;
///
/// let scene = ArmScene::new(1)?;
/// let mut start = scene.frame(0);
/// let mut end = start.clone();
/// for frame in 1..=ArmScene::STEPS {
///     scene.write_positions(frame as f64 / ArmScene::STEPS as f64, &mut end);
///     // … whatever collides between start and end …
///     std::mem::swap(&mut start, &mut end);
/// }
/// assert_eq!(start, scene.frame(ArmScene::STEPS));
/// # Ok::<(), selvedge_cloth::sleeve::RefinementError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ArmScene {
    rest: Mesh,
    topology: Topology,
}

impl ArmScene {
    /// The usual number of steps of the whole bend. There is one more frame.
    pub const STEPS: usize = 60;

    /// Makes the scene with a sleeve of 1,345 triangles times `refinement`.
    ///
    /// # Errors
    /// Returns the errors of [`sleeve`].
    pub fn new(refinement: u32) -> Result<Self, RefinementError> {
        let rest = sleeve(refinement)?;
        let topology = rest.topology().expect("the limit on refinement keeps a sleeve countable");
        Ok(Self { rest, topology })
    }

    /// Returns the sleeve before the arm bends.
    pub fn mesh(&self) -> &Mesh {
        &self.rest
    }

    /// Returns the sleeve's topology.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Returns the number of frames: [`STEPS`](Self::STEPS) + 1.
    pub fn frame_count(&self) -> usize {
        Self::STEPS + 1
    }

    /// Returns positions in a frame, counted from 0.
    ///
    /// # Panics
    /// Panics if there is no such frame.
    pub fn frame(&self, frame: usize) -> Vec<DVec3> {
        assert!(frame <= Self::STEPS, "frame {frame} of {}", self.frame_count());
        self.positions(frame as f64 / Self::STEPS as f64)
    }

    /// Returns positions at a time from 0, the arm straight, to 1, fully bent.
    ///
    /// # Panics
    /// Panics if `time` is not from 0 to 1.
    pub fn positions(&self, time: f64) -> Vec<DVec3> {
        let mut positions = vec![DVec3::ZERO; self.rest.positions.len()];
        self.write_positions(time, &mut positions);
        positions
    }

    /// Writes [`positions`](Self::positions) into the caller's slice.
    ///
    /// # Panics
    /// Panics if `time` is not from 0 to 1, or the length of `out` is not the number of vertices.
    pub fn write_positions(&self, time: f64, out: &mut [DVec3]) {
        assert!((0.0..=1.0).contains(&time), "time {time} is not from 0 to 1");
        assert_eq!(out.len(), self.rest.positions.len(), "one place for each vertex");
        for (place, rest) in out.iter_mut().zip(&self.rest.positions) {
            *place = bend(wrinkle(*rest, time), time);
        }
    }
}

/// Waves along the sleeve that fade out on either side of the elbow.
struct Waves {
    /// The height from the middle to the crest.
    height: f64,
    /// The distance from crest to crest.
    length: f64,
    /// The distance from the elbow at which the waves end.
    reach: f64,
    /// The phase by which they run ahead on one flank of the sleeve and behind on the other, in radians.
    slant: f64,
}

impl Waves {
    /// Returns the height of a wave and its phase at a point that is `along` from the elbow and `flank` (from −1 to 1) around the
    /// sleeve.
    fn at(&self, along: f64, flank: f64) -> (f64, f64) {
        let phase = TAU * along / self.length + self.slant * flank;
        (self.height * fade(along / self.reach), phase)
    }
}

/// Returns 1 at 0, and falls smoothly to 0 at ±1 and beyond.
fn fade(distance: f64) -> f64 {
    let inside = (1.0 - distance * distance).max(0.0);
    inside * inside
}

/// Returns the sleeve's surface before the arm is bent, with the folds and wrinkles of the given time.
fn wrinkle(rest: DVec3, time: f64) -> DVec3 {
    let along = rest.x - ELBOW;
    let radius = (rest.y * rest.y + rest.z * rest.z).sqrt();
    // This is the point's place around the sleeve, as cosine and sine: 1 and 0 on the inner side.
    let (inner, flank) = (rest.y / radius, rest.z / radius);

    let on_inner_side = 0.25 * (1.0 + inner) * (1.0 + inner);
    let (height, phase) = FOLDS.at(along, flank);
    // There is a valley in the middle of the elbow, and a crest on either side. The folds lag behind the bend, because cloth
    // gives way only when there is no other room.
    let folds = -time * time * height * on_inner_side * cos(phase);
    let (height, phase) = WRINKLES.at(along, flank);
    let wrinkles = time * height * (0.65 + 0.35 * inner) * sin(phase);
    let outward = folds + wrinkles;

    let flattening = FLATTENING * time * fade(along / FOLDS.reach);
    DVec3::new(
        rest.x,
        (rest.y + outward * inner) * (1.0 - flattening),
        (rest.z + outward * flank) * (1.0 + flattening),
    )
}

/// Bends the x axis into a straight line, an arc about the elbow, and a straight line. Every cross-section stays upright on it.
/// At time 0 nothing changes, exactly.
fn bend(point: DVec3, time: f64) -> DVec3 {
    let along = point.x - ELBOW;
    let arc = (along + BEND_REACH).clamp(0.0, 2.0 * BEND_REACH);
    let beyond = (along - BEND_REACH).max(0.0);
    let angle = BEND * time * arc / (2.0 * BEND_REACH);
    let (sine, cosine) = (sin(angle), cos(angle));
    // An arc of this length and angle ends at arc · (sin a / a, (1 − cos a) / a), in a form that holds for an angle of zero as
    // well. The first is kept as a difference from the straight sleeve.
    let x = point.x + arc * (sinc(angle) - 1.0) + beyond * (cosine - 1.0);
    let y = arc * sin(0.5 * angle) * sinc(0.5 * angle) + beyond * sine;
    DVec3::new(x - sine * point.y, y + cosine * point.y, point.z)
}

/// Returns sin(x) / x, and 1 at 0.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { sin(x) / x }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fnv::FnvHasher;
    use selvedge::CollisionDetector;
    use std::hash::Hasher;

    /// Counts exactly the places where the mesh passes through itself.
    fn intersections(topology: Topology, positions: &[DVec3]) -> usize {
        let mut intersections = Vec::new();
        let mut detector = CollisionDetector::<f64>::new(topology);
        detector.intersections(positions, &mut intersections).unwrap();
        intersections.len()
    }

    fn is_free_of_intersections(scene: &ArmScene, frame: usize) -> bool {
        intersections(scene.topology().clone(), &scene.frame(frame)) == 0
    }

    #[test]
    fn the_first_frame_is_the_plain_sleeve_to_the_last_bit() {
        for refinement in [1, 10] {
            let scene = ArmScene::new(refinement).unwrap();
            assert_eq!(scene.frame(0), sleeve(refinement).unwrap().positions);
        }
    }

    #[test]
    fn the_first_two_thirds_of_the_bend_are_free_of_intersections() {
        let scene = ArmScene::new(1).unwrap();
        for frame in 0..=40 {
            assert!(is_free_of_intersections(&scene, frame), "frame {frame}");
        }
        let fine = ArmScene::new(10).unwrap();
        for frame in [0, 20, 40] {
            assert!(is_free_of_intersections(&fine, frame), "refined, frame {frame}");
        }
    }

    #[test]
    fn the_inner_side_has_folded_onto_itself_at_the_end() {
        let scene = ArmScene::new(1).unwrap();
        let end = scene.frame(ArmScene::STEPS);
        assert!(intersections(scene.topology().clone(), &end) > 50);
    }

    #[test]
    fn the_folds_meet_on_the_inner_side_of_the_elbow_and_nowhere_else() {
        let scene = ArmScene::new(1).unwrap();
        let end = scene.frame(ArmScene::STEPS);
        let away = |vertex: &u32| {
            let rest = scene.mesh().positions[*vertex as usize];
            (rest.x - ELBOW).abs() > FOLDS.reach || rest.y < 0.0
        };
        let triangles = scene.topology().triangles();
        let elsewhere = triangles.iter().copied().filter(|t| t.iter().any(away)).collect();
        let rest_of_it = Topology::new(end.len(), elsewhere).unwrap();
        assert_eq!(intersections(rest_of_it, &end), 0);
    }

    #[test]
    fn no_point_moves_faster_than_the_forearm_swings_and_the_folds_rise() {
        let scene = ArmScene::new(1).unwrap();
        // The cuff swings on a radius of less than the sleeve's length. The folds rise at most at twice their height a bend, the
        // wrinkles at their height, and the flattening at its share of a radius of less than 0.1.
        let speed = BEND * 0.6 + 2.0 * FOLDS.height + WRINKLES.height + FLATTENING * 0.1;
        let mut before = scene.frame(0);
        for frame in 1..scene.frame_count() {
            let after = scene.frame(frame);
            for (a, b) in before.iter().zip(&after) {
                assert!(a.distance(*b) <= speed / ArmScene::STEPS as f64, "frame {frame}");
            }
            before = after;
        }
    }

    #[test]
    fn the_upper_arm_is_not_bent_and_the_forearm_not_stretched() {
        let (shoulder, elbow, cuff) = (DVec3::ZERO, DVec3::X * 0.4, DVec3::X * 0.6);
        assert_eq!(bend(shoulder, 1.0), shoulder);
        let forearm = bend(cuff, 1.0) - bend(elbow, 1.0);
        let expected = 0.2 * DVec3::new(BEND.cos(), BEND.sin(), 0.0);
        // The bound is a few roundings of numbers below 1.
        assert!(forearm.distance(expected) < 8.0 * f64::EPSILON, "{forearm}");
    }

    #[test]
    fn positions_are_the_same_bits_on_every_platform() {
        // The digest of the bits of all coordinates in the last frame is from x86-64.
        let scene = ArmScene::new(1).unwrap();
        let mut hash = FnvHasher::default();
        for coordinate in scene.frame(ArmScene::STEPS).iter().flat_map(DVec3::to_array) {
            hash.write(&coordinate.to_bits().to_le_bytes());
        }
        assert_eq!(hash.finish(), 0x4774_013d_fc3d_12cb, "{:#018x}", hash.finish());
    }

    #[test]
    #[should_panic(expected = "time 1.5 is not from 0 to 1")]
    fn a_time_after_the_bend_is_refused() {
        let _ = ArmScene::new(1).unwrap().positions(1.5);
    }
}
