//! The cloth at rest as a hierarchy sees it: distances over it, triangles around a vertex, borders, connected parts.

use super::grouped::Grouped;
use crate::world::Cloth;
use libm::hypot;
use selvedge::Topology;
use selvedge_core::glam::DVec3;
use std::f64::consts::{FRAC_PI_4, PI};

#[derive(Debug)]
pub(super) struct Surface<'a> {
    pub(super) cloth: &'a Cloth,
    /// Neighbours with distances: along edges, and straight across a hinge from one tip to the other if both triangles are convex
    /// together. Paths along edges alone would be up to half again as long.
    pub(super) ways: Grouped<(u32, f64)>,
    pub(super) triangles: Grouped<u32>,
    /// True for ends of an edge without exactly two triangles: a boundary, or a seam of several panels.
    pub(super) is_border: Vec<bool>,
    /// True for vertices at which the border turns.
    pub(super) is_corner: Vec<bool>,
    /// The connected part of each vertex, numbered from 0.
    pub(super) part: Vec<u32>,
    /// The number of vertices of each part, and its area in m².
    pub(super) parts: Vec<(usize, f64)>,
}

impl<'a> Surface<'a> {
    pub(super) fn new(cloth: &'a Cloth) -> Self {
        let (topology, count) = (&cloth.topology, cloth.mesh.positions.len());
        let mut tips = vec![([u32::MAX; 2], 0_u32); topology.edges().len()];
        for (triangle, edges) in topology.proper_triangles().iter().zip(topology.triangle_edges()) {
            for (k, &edge) in edges.iter().enumerate() {
                if edge != Topology::NO_EDGE {
                    let (tips, found) = &mut tips[edge as usize];
                    if let Some(tip) = tips.get_mut(*found as usize) {
                        *tip = triangle[(k + 2) % 3];
                    }
                    *found += 1;
                }
            }
        }
        let at = |v: u32| cloth.mesh.positions[v as usize];
        let mut is_border = vec![false; count];
        let mut ways = Vec::new();
        let mut add = |a: u32, b: u32, length: f64| ways.extend([(a, (b, length)), (b, (a, length))]);
        for (&[a, b], &([c, d], found)) in topology.edges().iter().zip(&tips) {
            if found == 0 {
                // A loose edge is no part of the surface.
                continue;
            }
            add(a, b, at(a).distance(at(b)));
            if found != 2 {
                is_border[a as usize] = true;
                is_border[b as usize] = true;
            } else if let Some(length) = across([a, b, c, d].map(at)) {
                add(c, d, length);
            }
        }
        let ways = Grouped::new(count, &ways);
        let corners = topology.proper_triangles().iter().enumerate();
        let corners = corners.flat_map(|(index, triangle)| triangle.map(|v| (v, index as u32)));
        let triangles = Grouped::new(count, &corners.collect::<Vec<_>>());
        let mut surface = Self {
            cloth,
            ways,
            triangles,
            is_corner: vec![false; count],
            is_border,
            part: vec![u32::MAX; count],
            parts: Vec::new(),
        };
        for vertex in 0..count as u32 {
            let turns = || (surface.angle_around(vertex) - PI).abs() > FRAC_PI_4;
            surface.is_corner[vertex as usize] = surface.is_border[vertex as usize] && turns();
        }
        surface.find_parts();
        surface
    }

    pub(super) fn at(&self, vertex: u32) -> DVec3 {
        self.cloth.mesh.positions[vertex as usize]
    }

    /// Returns the triangle's vertices, rotated so that `vertex` comes first.
    pub(super) fn from(&self, vertex: u32, triangle: u32) -> [u32; 3] {
        let [a, b, c] = self.cloth.mesh.triangles[triangle as usize];
        if a == vertex {
            [a, b, c]
        } else if b == vertex {
            [b, c, a]
        } else {
            [c, a, b]
        }
    }

    fn angle_around(&self, vertex: u32) -> f64 {
        let angles = self.triangles[vertex].iter().map(|&triangle| {
            let [a, b, c] = self.from(vertex, triangle).map(|v| self.at(v));
            let (first, second) = (b - a, c - a);
            libm::atan2(first.cross(second).length(), first.dot(second))
        });
        angles.sum()
    }

    fn find_parts(&mut self) {
        let mut stack = Vec::new();
        for first in 0..self.part.len() as u32 {
            if self.part[first as usize] != u32::MAX {
                continue;
            }
            let own = self.parts.len() as u32;
            let mut vertices = 0;
            self.part[first as usize] = own;
            stack.push(first);
            while let Some(vertex) = stack.pop() {
                vertices += 1;
                for &(other, _) in &self.ways[vertex] {
                    if self.part[other as usize] == u32::MAX {
                        self.part[other as usize] = own;
                        stack.push(other);
                    }
                }
            }
            self.parts.push((vertices, 0.0));
        }
        for triangle in &self.cloth.mesh.triangles {
            let [a, b, c] = triangle.map(|v| self.at(v));
            self.parts[self.part[triangle[0] as usize] as usize].1 += 0.5 * (b - a).cross(c - a).length();
        }
    }
}

/// Returns the distance from `c` to `d` over the edge from `a` to `b`, with both triangles laid flat. Returns `None` if the path
/// would miss the edge.
fn across([a, b, c, d]: [DVec3; 4]) -> Option<f64> {
    let edge = b - a;
    let length = edge.length();
    let [[cx, cy], [dx, dy]] = [c, d].map(|tip| [(tip - a).dot(edge) / length, (tip - a).cross(edge).length() / length]);
    let crossing = cx + (dx - cx) * cy / (cy + dy);
    (0.0 < crossing && crossing < length).then(|| hypot(dx - cx, cy + dy))
}
