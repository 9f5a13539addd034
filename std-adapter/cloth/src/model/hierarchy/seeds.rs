//! The vertices of a coarse level, by farthest-point sampling over the cloth (Eldar et al. 1997; Moenning and Dodgson 2003).
//!
//! Pins and corners come first, then the border, so that a level has the cloth's outline and its held vertices.

use super::surface::Surface;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The least distance, in spacings, of a pin or corner from earlier seeds.
const FIRST: f64 = 0.3;
/// The largest distance, in spacings, of a border vertex from a seed. Every other vertex is within one spacing.
const BORDER: f64 = 0.6;
const INNER: f64 = 0.7;

#[derive(Debug)]
pub(super) struct Seeds {
    pub(super) vertices: Vec<u32>,
    /// The nearest seed of each vertex, with its distance; unset in parts that are left out.
    pub(super) owner: Vec<u32>,
    pub(super) distance: Vec<f64>,
}

impl Seeds {
    pub(super) const NONE: u32 = u32::MAX;

    /// Samples the parts of the cloth that are `wanted`.
    pub(super) fn new(surface: &Surface<'_>, is_pinned: &[bool], wanted: &[bool], spacing: f64) -> Self {
        let count = is_pinned.len();
        let mut seeds = Self {
            vertices: Vec::new(),
            owner: vec![Self::NONE; count],
            distance: vec![f64::INFINITY; count],
        };
        let is_wanted = |vertex: usize| wanted[surface.part[vertex] as usize];
        for first in [is_pinned, &surface.is_corner] {
            for vertex in 0..count {
                if first[vertex] && is_wanted(vertex) && seeds.distance[vertex] > FIRST * spacing {
                    seeds.add(surface, vertex as u32);
                }
            }
        }
        seeds.fill(surface, BORDER * spacing, |vertex| {
            is_wanted(vertex) && surface.is_border[vertex]
        });
        seeds.fill(surface, INNER * spacing, is_wanted);
        seeds
    }

    /// Adds seeds until no selected vertex is as far as `reach` from all seeds.
    fn fill(&mut self, surface: &Surface<'_>, reach: f64, is_meant: impl Fn(usize) -> bool) {
        // Lengths are not negative, so their bits have the same order.
        let meant = (0..self.owner.len()).filter(|&vertex| is_meant(vertex));
        let mut farthest: BinaryHeap<(u64, u32)> = meant.map(|v| (self.distance[v].to_bits(), v as u32)).collect();
        while let Some((bits, vertex)) = farthest.pop() {
            let distance = self.distance[vertex as usize];
            if distance < reach {
                continue;
            }
            if distance.to_bits() < bits {
                farthest.push((distance.to_bits(), vertex));
            } else {
                self.add(surface, vertex);
            }
        }
    }

    /// Adds a seed, and gives it all vertices that are nearer to it than to all others (Dijkstra).
    fn add(&mut self, surface: &Surface<'_>, seed: u32) {
        let own = self.vertices.len() as u32;
        self.vertices.push(seed);
        let mut nearest = BinaryHeap::from([(Reverse(0_u64), seed)]);
        self.distance[seed as usize] = 0.0;
        self.owner[seed as usize] = own;
        while let Some((Reverse(bits), vertex)) = nearest.pop() {
            if self.distance[vertex as usize].to_bits() < bits {
                continue;
            }
            for &(other, way) in &surface.ways[vertex] {
                let distance = f64::from_bits(bits) + way;
                if distance < self.distance[other as usize] {
                    self.distance[other as usize] = distance;
                    self.owner[other as usize] = own;
                    nearest.push((Reverse(distance.to_bits()), other));
                }
            }
        }
    }
}
