//! The triangles between seeds: one wherever three of their cells meet, at a triangle of the cloth with three owners.
//!
//! Coarse triangles respect holes, notches and slits, since cells that do not touch have no triangle in common.

use super::grouped::Grouped;
use super::seeds::Seeds;
use super::surface::Surface;
use selvedge_core::glam::DVec2;
use std::collections::BTreeSet;

/// The least height of a triangle over its longest side.
const THINNEST: f64 = 0.05;
/// The largest ratio of the path over the cloth to the straight distance in a chart. If it is larger, there is no cloth along the
/// straight line. A path through both cells is longer by up to 1.15, at an obtuse triangle. One over edges and across hinges is
/// longer by up to 1.08.
const DETOUR: f64 = 1.3;
/// The largest inverse ratio. If it is larger, the chart has gone the wrong way round.
const SHORTCUT: f64 = 1.05;

#[derive(Debug)]
pub(super) struct Dual {
    /// The seeds of each triangle, oriented like the cloth's triangles, the smallest first.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The triangles of each seed.
    pub(super) around: Grouped<u32>,
    /// Pairs of seeds whose cells touch, the smaller number first, and the length of the shortest path through both cells;
    /// sorted.
    ways: Vec<([u32; 2], f64)>,
}

impl Dual {
    pub(super) fn new(surface: &Surface<'_>, seeds: &Seeds) -> Self {
        let mut triangles = BTreeSet::new();
        for triangle in &surface.cloth.mesh.triangles {
            let [a, b, c] = triangle.map(|v| seeds.owner[v as usize]);
            if a != b && b != c && c != a {
                triangles.insert(if a < b && a < c {
                    [a, b, c]
                } else if b < c {
                    [b, c, a]
                } else {
                    [c, a, b]
                });
            }
        }
        let triangles: Vec<_> = triangles.into_iter().collect();
        let corners = triangles.iter().enumerate();
        let corners: Vec<_> = corners.flat_map(|(index, t)| t.map(|seed| (seed, index as u32))).collect();
        let mut ways = Vec::new();
        for vertex in 0..seeds.owner.len() as u32 {
            let own = seeds.owner[vertex as usize];
            for &(other, way) in &surface.ways[vertex] {
                let theirs = seeds.owner[other as usize];
                if own < theirs && theirs != Seeds::NONE {
                    let [before, after] = [vertex, other].map(|v| seeds.distance[v as usize]);
                    ways.push(([own, theirs], before + way + after));
                }
            }
        }
        ways.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        ways.dedup_by_key(|way| way.0);
        Self {
            around: Grouped::new(seeds.vertices.len(), &corners),
            triangles,
            ways,
        }
    }

    /// Returns whether the triangle is well shaped, and its sides in the chart are as long as the cloth between its corners.
    pub(super) fn fits(&self, triangle: u32, places: [DVec2; 3]) -> bool {
        let corners = self.triangles[triangle as usize];
        let mut longest: f64 = 0.0;
        for (k, l) in [(0, 1), (1, 2), (2, 0)] {
            let straight = places[k].distance_squared(places[l]).sqrt();
            let ends = [corners[k].min(corners[l]), corners[k].max(corners[l])];
            let Ok(found) = self.ways.binary_search_by(|way| way.0.cmp(&ends)) else {
                return false;
            };
            let way = self.ways[found].1;
            if !(straight * DETOUR >= way && straight <= way * SHORTCUT) {
                return false;
            }
            longest = longest.max(straight);
        }
        let [a, b, c] = places;
        (b - a).perp_dot(c - a) > THINNEST * longest * longest
    }
}
