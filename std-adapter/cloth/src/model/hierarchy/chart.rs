//! The cloth around a vertex, laid flat triangle by triangle. Each triangle is put beside one that lies already, the nearest
//! first.
//!
//! This is exact where the cloth at rest is developable, like a sheet or a tube. Elsewhere a place depends on the triangles
//! through which it was reached first. A level leaves out triangles whose corners are not as far apart in the chart as over the
//! cloth (see [`dual`](super::dual)).

use super::surface::Surface;
use crate::model::membrane::warp_and_weft;
use selvedge_core::glam::{DVec2, DVec3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

#[derive(Debug)]
pub(super) struct Chart<'a> {
    surface: &'a Surface<'a>,
    /// The place of each vertex. The warp at the centre is along x.
    places: Vec<DVec2>,
    /// The number of the chart in which a vertex was placed last.
    placed_in: Vec<u32>,
    number: u32,
    nearest: BinaryHeap<(Reverse<u64>, u32)>,
}

impl<'a> Chart<'a> {
    pub(super) fn new(surface: &'a Surface<'a>) -> Self {
        let count = surface.part.len();
        Self {
            surface,
            places: vec![DVec2::ZERO; count],
            placed_in: vec![0; count],
            number: 0,
            nearest: BinaryHeap::new(),
        }
    }

    /// Returns the place of a vertex, if it lies in the chart.
    pub(super) fn at(&self, vertex: u32) -> Option<DVec2> {
        let is_placed = self.placed_in[vertex as usize] == self.number;
        is_placed.then(|| self.places[vertex as usize])
    }

    /// Clears the chart and lays the cloth around `middle` flat, over allowed triangles, until all `wanted` vertices lie.
    pub(super) fn lay(&mut self, middle: u32, wanted: &[u32], is_allowed: impl Fn(u32) -> bool) {
        self.number += 1;
        self.nearest.clear();
        let surface = self.surface;
        let Some(&first) = surface.triangles[middle].first() else {
            return;
        };
        let corners = surface.from(middle, first);
        let [a, b, c] = corners.map(|v| surface.at(v));
        let [along, across] = warp_and_weft(b - a, c - a, surface.cloth.warp);
        let flat = |way: DVec3| DVec2::new(way.dot(along), way.dot(across));
        for (vertex, place) in corners.into_iter().zip([DVec2::ZERO, flat(b - a), flat(c - a)]) {
            self.place(vertex, place);
        }
        let mut wanted = wanted.iter().peekable();
        loop {
            while wanted.next_if(|&&vertex| self.at(vertex).is_some()).is_some() {}
            if wanted.peek().is_none() {
                return;
            }
            let Some((_, vertex)) = self.nearest.pop() else { return };
            for &triangle in &surface.triangles[vertex] {
                let [u, p, q] = surface.from(vertex, triangle);
                let (known, new, side) = match (self.at(p), self.at(q)) {
                    (Some(_), None) => (p, q, 1.0),
                    (None, Some(_)) => (q, p, -1.0),
                    _ => continue,
                };
                if is_allowed(new) {
                    let [from, to, tip] = [u, known, new].map(|v| surface.at(v));
                    let (edge, way) = (to - from, tip - from);
                    let (from, to) = (self.places[u as usize], self.places[known as usize]);
                    let per_square = 1.0 / edge.length_squared();
                    let (along, aside) = (edge.dot(way) * per_square, edge.cross(way).length() * per_square * side);
                    self.place(new, from + (to - from) * along + (to - from).perp() * aside);
                }
            }
        }
    }

    fn place(&mut self, vertex: u32, place: DVec2) {
        self.places[vertex as usize] = place;
        self.placed_in[vertex as usize] = self.number;
        self.nearest.push((Reverse(place.length_squared().to_bits()), vertex));
    }
}
