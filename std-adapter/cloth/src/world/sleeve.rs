//! The paper's sleeve: a tube of rings that taper from the shoulder to the cuff.
//!
//! A tube of rings n₁ … n_m, triangulated between neighbours, has Σnᵢ vertices and 2Σnᵢ − n₁ − n_m triangles. With 34 rings that
//! taper from 25 points to 16 it has 693 vertices and 1,345 triangles. So has the arm clothing in Lv et al., whose own mesh is
//! not published.

use libm::{cos, sin};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use std::f64::consts::TAU;

/// The length from the shoulder at x = 0 to the cuff, in metres.
pub const LENGTH: f64 = 0.6;
/// The radius at the shoulder, in metres.
pub const SHOULDER_RADIUS: f64 = 0.075;
/// The radius at the cuff, in metres.
pub const CUFF_RADIUS: f64 = 0.048;

const SHOULDER_POINTS: f64 = 25.0;
const CUFF_POINTS: f64 = 16.0;
/// The number of steps from ring to ring in the paper's sleeve.
const RING_STEPS: f64 = 33.0;
/// Four times the number of points by which a straight taper exceeds the ring halfway down. A straight taper has 697 vertices;
/// any value from 0.8 to 0.9 gives 693.
const BOW: f64 = 0.85;

/// The largest refinement of [`sleeve`]. It gives 134 million triangles.
pub const MAX_REFINEMENT: u32 = 100_000;

/// A refinement that is zero or above [`MAX_REFINEMENT`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the sleeve's refinement is {0}, but must be a number from 1 to {MAX_REFINEMENT}")]
pub struct RefinementError(pub u32);

/// Returns the number of points of each ring of [`sleeve`], from shoulder to cuff.
///
/// # Errors
/// Returns an error if `refinement` is zero or above [`MAX_REFINEMENT`].
pub fn ring_sizes(refinement: u32) -> Result<Vec<u32>, RefinementError> {
    if refinement == 0 || refinement > MAX_REFINEMENT {
        return Err(RefinementError(refinement));
    }
    let scale = f64::from(refinement).sqrt();
    let steps = (RING_STEPS * scale).round() as u32;
    let size = |ring| {
        let s = f64::from(ring) / f64::from(steps);
        let points = SHOULDER_POINTS + (CUFF_POINTS - SHOULDER_POINTS) * s - BOW * s * (1.0 - s);
        (points * scale).round() as u32
    };
    Ok((0..=steps).map(size).collect())
}

/// Makes a sleeve along the x axis, of 1,345 triangles times `refinement`, to within 1 %. A refinement of 1 has exactly 693
/// vertices and 1,345 triangles.
///
/// It is 0.6 m long and open at both ends. Its triangles turn anticlockwise seen from outside. Vertices are numbered ring by ring
/// from the shoulder, each ring from the y axis towards the z axis. Rings, and points of a ring, grow with the square root of
/// `refinement`, so that triangles stay nearly equilateral.
///
/// Positions have the same bits on every platform, since the `libm` crate computes sine and cosine.
///
/// ```
/// let sleeve = selvedge_cloth::sleeve::sleeve(1)?;
/// assert_eq!((sleeve.positions.len(), sleeve.triangles.len()), (693, 1345));
/// # Ok::<(), selvedge_cloth::sleeve::RefinementError>(())
/// ```
///
/// # Errors
/// Returns an error if `refinement` is zero or above [`MAX_REFINEMENT`].
pub fn sleeve(refinement: u32) -> Result<Mesh, RefinementError> {
    let sizes = ring_sizes(refinement)?;
    let steps = (sizes.len() - 1) as f64;
    let mut mesh = Mesh::default();
    for (ring, &size) in sizes.iter().enumerate() {
        let s = ring as f64 / steps;
        let radius = SHOULDER_RADIUS + (CUFF_RADIUS - SHOULDER_RADIUS) * s;
        for point in 0..size {
            let angle = TAU * f64::from(2 * point + phase(ring)) / f64::from(2 * size);
            let position = DVec3::new(LENGTH * s, radius * cos(angle), radius * sin(angle));
            mesh.positions.push(position);
        }
    }
    let mut first = 0;
    for (ring, pair) in sizes.windows(2).enumerate() {
        join(&mut mesh.triangles, ring, first, [pair[0], pair[1]]);
        first += pair[0];
    }
    Ok(mesh)
}

/// Returns the turn of a ring in units of half a point. Every other ring is turned, so that triangles are nearly equilateral.
fn phase(ring: usize) -> u32 {
    ring as u32 % 2
}

/// Joins `ring`, whose points are numbered from `first`, and the next one by triangles. It always advances on the ring whose next
/// point has the smaller angle, until it has gone all the way round.
fn join(triangles: &mut Vec<[u32; 3]>, ring: usize, first: u32, [n, m]: [u32; 2]) {
    let (here, there) = (first, first + n);
    let (mut i, mut j) = (0, 0);
    while i < n || j < m {
        // The comparison is exact: fractions of the full turn, (2 (i + 1) + phase) / 2n against the same in j and m, are
        // multiplied out. 64 bits hold the product of any two ring sizes.
        let here_next = u64::from(2 * (i + 1) + phase(ring)) * u64::from(m);
        let there_next = u64::from(2 * (j + 1) + phase(ring + 1)) * u64::from(n);
        let advance_here = j == m || (i < n && here_next <= there_next);
        let (a, b) = (here + i % n, there + j % m);
        if advance_here {
            i += 1;
            triangles.push([a, here + i % n, b]);
        } else {
            j += 1;
            triangles.push([a, there + j % m, b]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_sleeve_has_693_vertices_and_1345_triangles() {
        let sizes = ring_sizes(1).unwrap();
        assert_eq!((sizes.len(), sizes[0], sizes[33]), (34, 25, 16));
        let sleeve = sleeve(1).unwrap();
        assert_eq!(sleeve.positions.len(), 693);
        assert_eq!(sleeve.triangles.len(), 1345);
    }

    #[test]
    fn rings_never_grow_towards_the_cuff() {
        for refinement in [1, 10, 1000] {
            assert!(ring_sizes(refinement).unwrap().is_sorted_by(|a, b| a >= b));
        }
    }

    #[test]
    fn refinement_multiplies_the_number_of_triangles_within_one_in_a_hundred() {
        for refinement in [2, 3, 10, 100, 1000] {
            let target = 1345.0 * f64::from(refinement);
            let found = sleeve(refinement).unwrap().triangles.len() as f64;
            assert!((found / target - 1.0).abs() < 0.01, "{refinement}: {found} of {target}");
        }
    }

    #[test]
    fn the_sleeve_is_one_manifold_tube_with_two_boundary_loops() {
        for refinement in [1, 7, 100] {
            let mesh = sleeve(refinement).unwrap();
            let topology = mesh.topology().unwrap();
            let sizes = ring_sizes(refinement).unwrap();
            let statistics = topology.statistics();
            assert_eq!(statistics.components, 1);
            assert_eq!(statistics.isolated_vertices, 0);
            assert_eq!(statistics.non_manifold_edges, 0);
            assert_eq!(statistics.duplicate_triangles, 0);
            assert_eq!(statistics.degenerate_triangles, 0);
            // Only the first and the last ring are loops…
            let ends = sizes[0] + sizes[sizes.len() - 1];
            assert_eq!(statistics.boundary_edges as u32, ends);
            // … and with V − E + F = 0 two loops make a tube.
            assert_eq!(topology.vertex_count() + topology.triangles().len(), topology.edges().len());
        }
    }

    #[test]
    fn triangles_turn_anticlockwise_seen_from_outside() {
        let mesh = sleeve(3).unwrap();
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
            let outward = (a + b + c) * DVec3::new(0.0, 1.0, 1.0);
            assert!((b - a).cross(c - a).dot(outward) > 0.0, "{triangle:?}");
        }
    }

    #[test]
    fn triangles_are_well_shaped_at_every_refinement() {
        for refinement in [1, 10, 100] {
            let mesh = sleeve(refinement).unwrap();
            let smallest = mesh.triangles.iter().flat_map(|t| angles(&mesh, *t)).fold(TAU, f64::min);
            assert!(smallest.to_degrees() > 30.0, "{refinement}: {}", smallest.to_degrees());
        }
    }

    fn angles(mesh: &Mesh, triangle: [u32; 3]) -> [f64; 3] {
        let p = triangle.map(|v| mesh.positions[v as usize]);
        [0, 1, 2].map(|k| (p[(k + 1) % 3] - p[k]).angle_between(p[(k + 2) % 3] - p[k]))
    }

    #[test]
    fn a_refinement_of_zero_or_beyond_the_limit_is_refused() {
        assert_eq!(sleeve(0).unwrap_err(), RefinementError(0));
        assert_eq!(sleeve(MAX_REFINEMENT + 1).unwrap_err(), RefinementError(MAX_REFINEMENT + 1));
    }
}
