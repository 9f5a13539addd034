//! Makes pairs whose four points are coplanar at some time, up to a few units in the last place.
//!
//! There are three kinds in turn, in the format of the set:
//!
//! 1. in one plane at the start, then apart: one control value is next to zero, the others are not;
//! 2. the same, ending in one plane;
//! 3. in one plane at both ends, the two planes parallel: all control values are next to zero.
//!
//! The last bits decide whether exact arithmetic culls such a pair, and rounded arithmetic does not see them.

use super::PairSet;
use fastrand::Rng;
use selvedge::glam::DVec3;
use selvedge_core::Scalar;

/// The largest distance from the plane, in units in the last place.
const NUDGE: i32 = 4;
/// The largest exponent of the sizes, which are powers of two; the smallest is its negative.
const LARGEST_EXPONENT: i32 = 10;

impl PairSet {
    /// Makes nearly coplanar pairs in the format `S`, half of them vertex–face. The same seed gives the same pairs.
    pub fn near_coplanar<S: Scalar>(seed: u64, pairs: usize) -> Self {
        let mut random = Rng::with_seed(seed);
        let mut set = Self::new("Nearly coplanar pairs".to_owned());
        set.drawn_from = pairs;
        for index in 0..pairs {
            let first = set.points.len() as u32;
            let [a, b, c, p] = [first, first + 1, first + 2, first + 3];
            let points = match index % 3 {
                0 => flat_at_start::<S>(&mut random),
                1 => flat_at_start::<S>(&mut random).map(|[start, end]| [end, start]),
                _ => flat_at_both_ends::<S>(&mut random),
            };
            set.points.extend(points);
            if index % 2 == 0 {
                set.vertex_face.push([p, a, b, c]);
            } else {
                set.edge_edge.push([b, c, a, p]);
            }
        }
        set
    }
}

/// Makes four points a, b, c, p; at the start, p is nearly in the plane of the others.
fn flat_at_start<S: Scalar>(random: &mut Rng) -> [[DVec3; 2]; 4] {
    let size = size(random);
    let corners = [(); 3].map(|()| rounded::<S>(size * in_cube(random)));
    let [a, b, c] = corners;
    let p = a + between(random, -1.0, 2.0) * (b - a) + between(random, -1.0, 2.0) * (c - a);
    let start = [a, b, c, nudged::<S>(p, random)];
    // The corners hardly turn, and p leaves the plane to one side.
    let translation = size * in_cube(random);
    let normal = (b - a).cross(c - a).normalize_or(DVec3::Z);
    let rise = size * between(random, 0.2, 1.0) * if random.bool() { 1.0 } else { -1.0 };
    let mut end = start.map(|point| point + translation + 0.05 * size * in_cube(random));
    end[3] += rise * normal;
    [0, 1, 2, 3].map(|k| [start[k], rounded::<S>(end[k])])
}

/// Makes four points of one plane that moves.
fn flat_at_both_ends<S: Scalar>(random: &mut Rng) -> [[DVec3; 2]; 4] {
    let size = size(random);
    let [origin, along, across, translation] = [(); 4].map(|()| size * in_cube(random));
    [(); 4].map(|()| {
        [origin, origin + translation].map(|origin| {
            let [u, v] = [(); 2].map(|()| between(random, -1.0, 1.0));
            nudged::<S>(origin + u * along + v * across, random)
        })
    })
}

fn size(random: &mut Rng) -> f64 {
    libm::ldexp(1.0, random.i32(-LARGEST_EXPONENT..=LARGEST_EXPONENT))
}

fn in_cube(random: &mut Rng) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| between(random, -1.0, 1.0)))
}

fn between(random: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * random.f64()
}

/// Returns the nearest point with coordinates in the format `S`.
fn rounded<S: Scalar>(point: DVec3) -> DVec3 {
    DVec3::from_array(point.to_array().map(|number| S::from_f64(number).to_f64()))
}

/// Moves one coordinate by a few units in the last place, and rounds all.
fn nudged<S: Scalar>(point: DVec3, random: &mut Rng) -> DVec3 {
    let units = f64::from(random.i32(-NUDGE..=NUDGE));
    let mut coordinates = point.to_array();
    // A unit in the last place is between one and two unit roundoffs of the number.
    coordinates[random.usize(..3)] *= 1.0 + units * 2.0 * S::UNIT_ROUNDOFF.to_f64();
    rounded::<S>(DVec3::from_array(coordinates))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the volume at an end of the step relative to that of a box around the points.
    fn flatness([a, b, c, p]: [DVec3; 4]) -> f64 {
        let size = [b - a, c - a, p - a].map(|edge| edge.abs().max_element());
        let size = size.into_iter().fold(0.0, f64::max);
        ((p - a).dot((b - a).cross(c - a)) / size.powi(3)).abs()
    }

    fn check<S: Scalar>() {
        let set = PairSet::near_coplanar::<S>(3, 3000);
        assert_eq!((set.vertex_face.len(), set.edge_edge.len()), (1500, 1500));
        // The error of a point is at most 5 units in the last place of a coordinate. That coordinate may be about 7 times as
        // large as an edge's largest component: 2⁸ roundoffs. In `f64` the check's own rounding is of that size.
        let next_to_zero = 4096.0 * S::UNIT_ROUNDOFF.to_f64();
        for (index, points) in set.points.chunks_exact(4).enumerate() {
            let at = |end: usize| flatness([0, 1, 2, 3].map(|k| points[k][end]));
            let flat: &[usize] = [&[0][..], &[1], &[0, 1]][index % 3];
            for &end in flat {
                assert!(at(end) < next_to_zero, "{index}: {}", at(end));
            }
            let on_grid = points.iter().flatten().all(|&p| rounded::<S>(p) == p);
            assert!(on_grid, "{index}");
        }
    }

    #[test]
    fn pairs_are_flat_at_the_end_that_is_promised() {
        check::<f32>();
        check::<f64>();
    }

    #[test]
    fn a_seed_gives_the_same_pairs_again_and_another_gives_others() {
        let set = |seed| PairSet::near_coplanar::<f32>(seed, 30);
        assert_eq!(set(1), set(1));
        assert_ne!(set(1).points, set(2).points);
    }
}
