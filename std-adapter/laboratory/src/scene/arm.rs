//! A sleeve on an arm that bends at the elbow until the inner side folds onto itself.
//!
//! The motion is a formula, not a simulation: where a point is depends on where it was at rest and
//! on the time, on nothing else. So any frame can be had without the ones before it, and every
//! refinement of the sleeve moves alike. Nothing keeps the cloth from passing through itself: once
//! the folds have met, late in the bend, the prescribed motion goes on into the cloth.
//!
//! All lengths are in metres. At rest the sleeve lies along the x axis and the inner side of the
//! elbow faces y; the forearm turns in the x-y plane.

use libm::{cos, sin};
use selvedge::{Mesh, Topology};
use selvedge_cloth::sleeve::{RefinementError, sleeve};
use selvedge_core::glam::DVec3;
use std::f64::consts::TAU;

/// How far the elbow bends, in radians: 143°, about as far as a person can.
const BEND: f64 = 2.5;
/// Where the middle of the elbow is along the sleeve.
const ELBOW: f64 = 0.29;
/// The bend is spread over this length of the sleeve on either side of the elbow. Its radius at
/// the end, 2 × 0.06 / 2.5 = 0.048, is less than the sleeve's there, 0.062: the inner side has no
/// room left and must meet itself.
const BEND_REACH: f64 = 0.06;
/// How much wider than deep the sleeve becomes at the elbow.
const FLATTENING: f64 = 0.12;

/// The folds on the inner side of the elbow, in between which it closes.
const FOLDS: Waves = Waves {
    height: 0.017,
    length: 0.075,
    reach: 0.14,
    slant: 0.9,
};
/// Slighter wrinkles that run around the whole sleeve.
const WRINKLES: Waves = Waves {
    height: 0.006,
    length: 0.11,
    reach: 0.3,
    slant: 1.5,
};

/// A sleeve on a bending arm, over [`STEPS`](Self::STEPS) time steps.
///
/// The first frame is the plain [`sleeve`], free of self-intersection, and so is about the first
/// two thirds of the bend; in the last quarter vertices, edges and faces of the folds collide. At
/// the paper's size, that is a few tens of contacts in a step.
///
/// Positions are the same bits on every platform: they are made of additions, multiplications,
/// divisions and square roots, which IEEE 754 fixes, and of sine and cosine from the `libm` crate
/// instead of the system's.
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
    /// How many steps the whole bend is usually run in; one more than that are its frames.
    pub const STEPS: usize = 60;

    /// The scene with a sleeve of 1,345 triangles times `refinement`.
    ///
    /// # Errors
    /// Those of [`sleeve`].
    pub fn new(refinement: u32) -> Result<Self, RefinementError> {
        let rest = sleeve(refinement)?;
        let topology = rest.topology().expect("the limit on refinement keeps a sleeve countable");
        Ok(Self { rest, topology })
    }

    /// The sleeve before the arm bends.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.rest
    }

    /// The sleeve's topology.
    #[must_use]
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// How many frames there are: [`STEPS`](Self::STEPS) + 1.
    #[must_use]
    pub fn frame_count(&self) -> usize {
        Self::STEPS + 1
    }

    /// Positions in a frame, counted from 0.
    ///
    /// # Panics
    /// If there is no such frame.
    #[must_use]
    pub fn frame(&self, frame: usize) -> Vec<DVec3> {
        assert!(frame <= Self::STEPS, "frame {frame} of {}", self.frame_count());
        self.positions(frame as f64 / Self::STEPS as f64)
    }

    /// Positions at a time from 0, the arm straight, to 1, fully bent.
    ///
    /// # Panics
    /// If `time` is not from 0 to 1.
    #[must_use]
    pub fn positions(&self, time: f64) -> Vec<DVec3> {
        let mut positions = vec![DVec3::ZERO; self.rest.positions.len()];
        self.write_positions(time, &mut positions);
        positions
    }

    /// Like [`positions`](Self::positions), into a slice that the caller keeps.
    ///
    /// # Panics
    /// If `time` is not from 0 to 1, or `out` has not one place for each vertex.
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
    /// From the middle to the crest.
    height: f64,
    /// From crest to crest.
    length: f64,
    /// They end at this distance from the elbow.
    reach: f64,
    /// By how much of a radian they run ahead on one flank of the sleeve and behind on the other.
    slant: f64,
}

impl Waves {
    /// The height of a wave, and its phase, where a point is `along` from the elbow and `flank`
    /// (from −1 to 1) round the sleeve.
    fn at(&self, along: f64, flank: f64) -> (f64, f64) {
        let phase = TAU * along / self.length + self.slant * flank;
        (self.height * fade(along / self.reach), phase)
    }
}

/// 1 at 0, falling smoothly to 0 at ±1 and beyond.
fn fade(distance: f64) -> f64 {
    let inside = (1.0 - distance * distance).max(0.0);
    inside * inside
}

/// The sleeve's surface before the arm is bent, with the folds and wrinkles of the given time.
fn wrinkle(rest: DVec3, time: f64) -> DVec3 {
    let along = rest.x - ELBOW;
    let radius = (rest.y * rest.y + rest.z * rest.z).sqrt();
    // Where the point is around the sleeve, as cosine and sine: 1 and 0 on the inner side.
    let (inner, flank) = (rest.y / radius, rest.z / radius);

    let on_inner_side = 0.25 * (1.0 + inner) * (1.0 + inner);
    let (height, phase) = FOLDS.at(along, flank);
    // A valley in the middle of the elbow, a crest on either side. The folds lag behind the bend:
    // cloth gives way only when there is no other room.
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

/// Bends the x axis into a straight line, an arc about the elbow, and a straight line, with every
/// cross-section staying upright on it. Bends by nothing, exactly, at time 0.
fn bend(point: DVec3, time: f64) -> DVec3 {
    let along = point.x - ELBOW;
    let arc = (along + BEND_REACH).clamp(0.0, 2.0 * BEND_REACH);
    let beyond = (along - BEND_REACH).max(0.0);
    let angle = BEND * time * arc / (2.0 * BEND_REACH);
    let (sine, cosine) = (sin(angle), cos(angle));
    // An arc of this length and angle ends at arc · (sin a / a, (1 − cos a) / a), written so that
    // it holds for no angle too. The first is kept as a difference from the straight sleeve.
    let x = point.x + arc * (sinc(angle) - 1.0) + beyond * (cosine - 1.0);
    let y = arc * sin(0.5 * angle) * sinc(0.5 * angle) + beyond * sine;
    DVec3::new(x - sine * point.y, y + cosine * point.y, point.z)
}

/// sin(x) / x, and 1 at 0.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { sin(x) / x }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether an edge meets a triangle, decided exactly; touching is meeting. They share no
    /// vertex and lie in no common plane (this is asserted), so the edge must have an end on
    /// either side, and pass the three sides of the triangle in one sense.
    fn meet([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
        let (above, below) = (side(a, b, c, p), side(a, b, c, q));
        assert!(above != 0.0 || below != 0.0, "coplanar");
        let around = [side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)];
        above * below <= 0.0 && (around.iter().all(|&s| s >= 0.0) || around.iter().all(|&s| s <= 0.0))
    }

    /// The side of the plane a, b, c on which d is: an exact sign.
    fn side(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
        let [a, b, c, d] = [a, b, c, d].map(|p| robust::Coord3D { x: p.x, y: p.y, z: p.z });
        let determinant = robust::orient3d(a, b, c, d);
        if determinant == 0.0 { 0.0 } else { determinant.signum() }
    }

    /// How many pairs of an edge and a triangle without a common vertex meet.
    fn intersections(topology: &Topology, positions: &[DVec3]) -> usize {
        let bounds = |vertices: &[u32]| {
            let points = vertices.iter().map(|&v| positions[v as usize]);
            points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
                (low.min(p), high.max(p))
            })
        };
        let mut edges: Vec<_> = topology.edges().iter().map(|edge| (bounds(edge), edge)).collect();
        edges.sort_by(|a, b| a.0.0.x.total_cmp(&b.0.0.x));
        let longest = edges.iter().map(|((low, high), _)| high.x - low.x).fold(0.0, f64::max);
        let mut count = 0;
        for triangle in topology.triangles() {
            let (low, high) = bounds(triangle);
            let first = edges.partition_point(|(edge, _)| edge.0.x < low.x - longest);
            count += edges[first..]
                .iter()
                .take_while(|(edge, _)| edge.0.x <= high.x)
                .filter(|(edge, _)| edge.0.cmple(high).all() && edge.1.cmpge(low).all())
                .filter(|(_, edge)| !edge.iter().any(|v| triangle.contains(v)))
                .filter(|(_, edge)| meet(edge.map(|v| positions[v as usize]), triangle.map(|v| positions[v as usize])))
                .count();
        }
        count
    }

    /// Whether an edge lies on a triangle with which it shares one end, `a`: it must be in the
    /// triangle's plane, and leave `a` between the two sides.
    fn lies_on([a, b, c]: [DVec3; 3], end: DVec3) -> bool {
        if side(a, b, c, end) != 0.0 {
            return false;
        }
        // In one of the three coordinate planes the triangle is no line.
        let turns = |i: usize, j: usize, [p, q, r]: [DVec3; 3]| {
            let [p, q, r] = [p, q, r].map(|p| robust::Coord { x: p[i], y: p[j] });
            robust::orient2d(p, q, r)
        };
        let (i, j) = [(0, 1), (1, 2), (2, 0)]
            .into_iter()
            .find(|&(i, j)| turns(i, j, [a, b, c]) != 0.0)
            .expect("a triangle with an area");
        let sense = turns(i, j, [a, b, c]).signum();
        turns(i, j, [a, b, end]) * sense >= 0.0 && turns(i, j, [a, c, end]) * sense <= 0.0
    }

    /// How many pairs of an edge and a triangle with one common vertex lie on one another.
    fn overlapping_neighbours(topology: &Topology, positions: &[DVec3]) -> usize {
        let mut corners_at = vec![Vec::new(); positions.len()];
        for &[a, b, c] in topology.triangles() {
            for corner in [[a, b, c], [b, c, a], [c, a, b]] {
                corners_at[corner[0] as usize].push(corner);
            }
        }
        let ends = topology.edges().iter().flat_map(|&[u, v]| [(u, v), (v, u)]);
        ends.flat_map(|(shared, end)| corners_at[shared as usize].iter().map(move |t| (t, end)))
            .filter(|(triangle, end)| !triangle.contains(end))
            .filter(|(triangle, end)| lies_on(triangle.map(|v| positions[v as usize]), positions[*end as usize]))
            .count()
    }

    fn is_free_of_intersections(scene: &ArmScene, frame: usize) -> bool {
        let positions = scene.frame(frame);
        overlapping_neighbours(scene.topology(), &positions) == 0 && intersections(scene.topology(), &positions) == 0
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
        assert!(intersections(scene.topology(), &end) > 50);
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
        assert_eq!(intersections(&rest_of_it, &end), 0);
    }

    #[test]
    fn no_point_moves_faster_than_the_forearm_swings_and_the_folds_rise() {
        let scene = ArmScene::new(1).unwrap();
        // The cuff swings on a radius of less than the sleeve's length; the folds rise at most at
        // twice their height a bend, wrinkles at once theirs, the flattening at its share of a
        // radius of less than 0.1.
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
        // A few roundings of numbers below 1.
        assert!(forearm.distance(expected) < 8.0 * f64::EPSILON, "{forearm}");
    }

    #[test]
    fn an_edge_and_a_triangle_meet_when_they_touch_or_cross_and_not_otherwise() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let at = |x, y| [DVec3::new(x, y, -1.0), DVec3::new(x, y, 1.0)];
        assert!(meet(at(0.25, 0.25), triangle));
        assert!(meet(at(0.5, 0.5), triangle), "through a side");
        assert!(meet([DVec3::new(0.25, 0.25, 0.0), DVec3::Z], triangle), "standing on it");
        assert!(!meet(at(0.75, 0.75), triangle));
        assert!(!meet([DVec3::new(0.25, 0.25, 1.0), DVec3::new(0.25, 0.25, 2.0)], triangle));
        assert!(lies_on(triangle, DVec3::new(2.0, 1.0, 0.0)));
        assert!(lies_on(triangle, DVec3::new(2.0, 0.0, 0.0)), "along a side");
        assert!(!lies_on(triangle, DVec3::new(2.0, -1.0, 0.0)));
        assert!(!lies_on(triangle, DVec3::new(2.0, 1.0, 1.0)));
    }

    #[test]
    fn positions_are_the_same_bits_on_every_platform() {
        // FNV-1a over the bits of all coordinates in the last frame, from x86-64.
        let scene = ArmScene::new(1).unwrap();
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        for coordinate in scene.frame(ArmScene::STEPS).iter().flat_map(DVec3::to_array) {
            for byte in coordinate.to_bits().to_le_bytes() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
        assert_eq!(hash, 0x4774_013d_fc3d_12cb, "{hash:#018x}");
    }

    #[test]
    #[should_panic(expected = "time 1.5 is not from 0 to 1")]
    fn a_time_after_the_bend_is_refused() {
        let _ = ArmScene::new(1).unwrap().positions(1.5);
    }
}
