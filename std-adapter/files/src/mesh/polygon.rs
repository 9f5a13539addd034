//! Splits polygons into triangles that do not overlap.
//!
//! A polygon is projected along the largest component of its normal: a coordinate is left out, which rounds nothing. If all
//! triangles of the fan from its first corner turn the right way within half a turn, the fan covers it without overlap. Otherwise
//! ears are clipped: a corner is one if its triangle turns the right way and has no other corner inside or on it. All signs are
//! exact (`robust`, after Shewchuk 1997), except for underflow. A wrong sign could only choose worse triangles: intersections are
//! decided elsewhere, on the triangles.

use robust::{Coord, orient2d};
use selvedge_core::glam::DVec3;

/// The largest number of corners of a polygon that is clipped, since time grows with their square.
const MOST_CLIPPED: usize = 10_000;

/// Splits polygons into triangles, and keeps its memory from one to the next.
#[derive(Default)]
pub(super) struct Triangulator {
    ring: Vec<u32>,
    points: Vec<Coord<f64>>,
    links: Vec<[usize; 2]>,
}

impl Triangulator {
    /// Appends the triangles of a polygon of four corners or more, with its winding. Returns whether they cover it without
    /// overlap in its projection. If no such triangles were found, they are the fan from the first corner.
    pub(super) fn triangulate(&mut self, positions: &[DVec3], corners: &[u32], triangles: &mut Vec<[u32; 3]>) -> bool {
        self.ring.clear();
        self.ring.extend_from_slice(corners);
        // An edge from a vertex to itself has no length, and the polygon has the same shape without it.
        self.ring.dedup();
        while self.ring.len() > 1 && self.ring.first() == self.ring.last() {
            self.ring.pop();
        }
        if self.ring.len() < 3 {
            triangles.extend(fan(corners));
            return true;
        }
        if self.ring.len() == 3 {
            triangles.extend(fan(&self.ring));
            return true;
        }
        let normal = normal(positions, &self.ring);
        let mut axes = [0, 1, 2];
        axes.sort_by(|&a, &b| normal[b].abs().total_cmp(&normal[a].abs()));
        let before = triangles.len();
        for axis in axes {
            self.project(positions, axis, normal[axis] < 0.0);
            if self.fan_is_free() {
                triangles.extend(fan(&self.ring));
                return true;
            }
            if self.ring.len() <= MOST_CLIPPED && self.clip(triangles) && self.is_simple() {
                return true;
            }
            triangles.truncate(before);
        }
        triangles.extend(fan(&self.ring));
        false
    }

    /// Leaves out a coordinate, and mirrors the polygon if it would turn clockwise.
    fn project(&mut self, positions: &[DVec3], axis: usize, is_mirrored: bool) {
        let (mut first, mut second) = ((axis + 1) % 3, (axis + 2) % 3);
        if is_mirrored {
            std::mem::swap(&mut first, &mut second);
        }
        let scale = scale(positions, &self.ring);
        self.points.clear();
        let points = self.ring.iter().map(|&vertex| positions[vertex as usize] * scale);
        self.points.extend(points.map(|point| Coord {
            x: point[first],
            y: point[second],
        }));
    }

    fn turns_left(&self, a: usize, b: usize, c: usize) -> bool {
        orient2d(self.points[a], self.points[b], self.points[c]) > 0.0
    }

    fn fan_is_free(&self) -> bool {
        let count = self.points.len();
        (2..count).all(|k| self.turns_left(0, 1, k) && self.turns_left(0, k - 1, k))
    }

    fn clip(&mut self, triangles: &mut Vec<[u32; 3]>) -> bool {
        let count = self.points.len();
        self.links.clear();
        self.links
            .extend((0..count).map(|k| [(k + count - 1) % count, (k + 1) % count]));
        let (mut corner, mut remaining, mut misses) = (0, count, 0);
        while remaining >= 3 {
            let [before, after] = self.links[corner];
            if self.is_ear([before, corner, after]) {
                triangles.push([before, corner, after].map(|k| self.ring[k]));
                self.links[before][1] = after;
                self.links[after][0] = before;
                remaining -= 1;
                misses = 0;
                // Clipping neighbours in turn would make one corner the tip of many slivers.
                corner = self.links[after][1];
                if remaining == 2 {
                    return true;
                }
            } else {
                misses += 1;
                if misses > remaining {
                    return false;
                }
                corner = after;
            }
        }
        false
    }

    fn is_ear(&self, [a, b, c]: [usize; 3]) -> bool {
        if !self.turns_left(a, b, c) {
            return false;
        }
        let [pa, pb, pc] = [a, b, c].map(|k| self.points[k]);
        let (left, right) = (pa.x.min(pb.x).min(pc.x), pa.x.max(pb.x).max(pc.x));
        let (low, high) = (pa.y.min(pb.y).min(pc.y), pa.y.max(pb.y).max(pc.y));
        let mut other = self.links[c][1];
        while other != a {
            let p = self.points[other];
            let is_near = left <= p.x && p.x <= right && low <= p.y && p.y <= high;
            // A bridge to a hole names its ends twice.
            if is_near
                && ![pa, pb, pc].contains(&p)
                && orient2d(pa, pb, p) >= 0.0
                && orient2d(pb, pc, p) >= 0.0
                && orient2d(pc, pa, p) >= 0.0
            {
                return false;
            }
            other = self.links[other][1];
        }
        true
    }

    /// Returns whether no two edges of the polygon cross.
    fn is_simple(&self) -> bool {
        let count = self.points.len();
        let edge = |k: usize| [self.points[k], self.points[(k + 1) % count]];
        (0..count).all(|k| (k + 1..count).all(|l| !cross(edge(k), edge(l))))
    }
}

/// Returns whether two edges cross at a point inside both.
fn cross([a, b]: [Coord<f64>; 2], [c, d]: [Coord<f64>; 2]) -> bool {
    let apart = |a: f64, b: f64, c: f64, d: f64| a.max(b) < c.min(d) || c.max(d) < a.min(b);
    if apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y) {
        return false;
    }
    let differ = |s: f64, t: f64| s < 0.0 && t > 0.0 || s > 0.0 && t < 0.0;
    differ(orient2d(a, b, c), orient2d(a, b, d)) && differ(orient2d(c, d, a), orient2d(c, d, b))
}

fn fan(ring: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    ring.windows(2).skip(1).map(|pair| [ring[0], pair[0], pair[1]])
}

/// Returns Newell's normal: twice the areas of the polygon's projections on the coordinate planes, rounded.
fn normal(positions: &[DVec3], ring: &[u32]) -> DVec3 {
    let scale = scale(positions, ring);
    let at = |k: usize| positions[ring[k % ring.len()] as usize] * scale;
    // Differences from the first corner lose fewer digits.
    (1..ring.len() - 1).map(|k| (at(k) - at(0)).cross(at(k + 1) - at(0))).sum()
}

/// Returns a power of two that keeps products of coordinates within the range of `f64`.
fn scale(positions: &[DVec3], ring: &[u32]) -> f64 {
    const FAR: f64 = 1e100;
    let largest = ring.iter().map(|&vertex| positions[vertex as usize].abs().max_element());
    match largest.fold(0.0, f64::max) {
        largest if largest > FAR => 2.0_f64.powi(-700),
        largest if largest < 1.0 / FAR => 2.0_f64.powi(700),
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns triangles of a polygon in the plane z = x + 2 y, and whether they do not overlap.
    fn triangulated(outline: &[[f64; 2]]) -> (Vec<[u32; 3]>, bool) {
        let positions: Vec<DVec3> = outline.iter().map(|&[x, y]| DVec3::new(x, y, x + 2.0 * y)).collect();
        let corners: Vec<u32> = (0..outline.len() as u32).collect();
        let mut triangles = Vec::new();
        let is_free = Triangulator::default().triangulate(&positions, &corners, &mut triangles);
        (triangles, is_free)
    }

    fn area(outline: &[[f64; 2]], corners: impl Iterator<Item = u32>) -> f64 {
        let corners: Vec<[f64; 2]> = corners.map(|k| outline[k as usize]).collect();
        let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
        0.5 * pairs.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
    }

    #[test]
    fn every_outline_is_covered_once_whichever_corner_comes_first() {
        let c_shape: &[[f64; 2]] = &[[0., 0.], [3., 0.], [3., 1.], [1., 1.], [1., 2.], [3., 2.], [3., 3.], [0., 3.]];
        let arrow: &[[f64; 2]] = &[[0., 0.], [2., -1.], [1., 0.], [2., 1.]];
        let straight: &[[f64; 2]] = &[[0., 0.], [1., 0.], [2., 0.], [1., 1.]];
        let comb: Vec<[f64; 2]> = (0..40)
            .map(|k| [f64::from(k), if k % 2 == 0 { 0.5 } else { 3.0 }])
            .chain([[39.0, 0.0], [0.0, 0.0]].map(|[x, y]: [f64; 2]| [x, y - 1.0]))
            .rev()
            .collect();
        let ring: &[[f64; 2]] = &[
            [0., 0.],
            [4., 0.],
            [4., 4.],
            [0., 4.],
            [0., 0.],
            [1., 1.],
            [1., 3.],
            [3., 3.],
            [3., 1.],
            [1., 1.],
        ];
        for outline in [c_shape, arrow, straight, &comb, ring] {
            for first in 0..outline.len() {
                for backwards in [false, true] {
                    let mut outline = outline.to_vec();
                    outline.rotate_left(first);
                    if backwards {
                        outline.reverse();
                    }
                    let (triangles, is_free) = triangulated(&outline);
                    assert!(is_free, "{outline:?}: {triangles:?}");
                    assert_eq!(triangles.len(), outline.len() - 2);
                    let whole = area(&outline, 0..outline.len() as u32);
                    let parts = triangles.iter().map(|triangle| area(&outline, triangle.iter().copied()));
                    assert!(parts.clone().all(|part| part * whole > 0.0), "{outline:?}: {triangles:?}");
                    assert!(
                        (parts.sum::<f64>() - whole).abs() < 1e-12 * whole.abs(),
                        "{outline:?}: {triangles:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn convex_polygons_are_fans_from_their_first_corner() {
        let outline: Vec<[f64; 2]> = [(5, 0), (4, 3), (3, 4), (0, 5), (-3, 4), (-5, 0), (0, -5)]
            .map(|(x, y)| [x.into(), y.into()])
            .to_vec();
        let (triangles, is_free) = triangulated(&outline);
        let corners: Vec<u32> = (0..7).collect();
        assert!(is_free && triangles.into_iter().eq(fan(&corners)));
    }

    #[test]
    fn outlines_that_cross_themselves_are_reported() {
        let bow: &[[f64; 2]] = &[[0., 0.], [1., 1.], [1., 0.], [0., 1.]];
        let star: Vec<[f64; 2]> = [0, 2, 4, 1, 3]
            .map(|k| [[0., 3.], [-3., 1.], [-2., -3.], [2., -3.], [3., 1.]][k])
            .to_vec();
        let touching: &[[f64; 2]] = &[[0., 0.], [4., 0.], [4., 4.], [2., 0.], [0., 4.]];
        let flat: &[[f64; 2]] = &[[0., 0.], [1., 0.], [2., 0.], [3., 0.]];
        for outline in [bow, &star, touching, flat] {
            let (triangles, is_free) = triangulated(outline);
            assert!(!is_free && triangles.len() == outline.len() - 2, "{outline:?}");
        }
    }

    #[test]
    fn extreme_and_repeated_corners_are_split() {
        for size in [1e-300, 1e-200, 1e300] {
            let positions = [[0., 0.], [2., -1.], [1., 0.], [2., 1.]].map(|[x, y]: [f64; 2]| DVec3::new(x, y, 0.0) * size);
            let mut triangles = Vec::new();
            assert!(
                Triangulator::default().triangulate(&positions, &[0, 1, 2, 3], &mut triangles),
                "{size}"
            );
            assert_eq!(triangles.len(), 2);
        }
        let positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let mut triangles = Vec::new();
        assert!(Triangulator::default().triangulate(&positions, &[0, 1, 1, 2, 0], &mut triangles));
        assert_eq!(triangles, [[0, 1, 2]]);
    }
}
