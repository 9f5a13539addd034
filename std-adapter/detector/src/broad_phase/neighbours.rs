//! Pairs that are near each other at rest already: nearly all that boxes leave on a fine mesh.
//!
//! Their caller may ask less of them than of other pairs. A hierarchy of boxes that holds who lies where at rest tells them many at a time,
//! and leaves out those that keep what is asked of them.

use crate::PairKind;
use selvedge_core::glam::{DVec3, Vec3A};
use selvedge_core::separation::clearance::{are_boxes_within, nearness};
use selvedge_core::separation::largest_coordinate;

/// Which pairs are neighbours: those within a part of a mesh whose boxes come within a distance of that part's at rest.
#[derive(Debug)]
pub struct Neighbours {
    /// Where vertices are at rest, in `f32`, NaN for those that have no neighbours.
    rest: Vec<Vec3A>,
    /// Of each part: the vertex after its last one, and how near boxes of neighbours are at rest, rounded down.
    parts: Vec<(u32, f32)>,
}

/// What makes neighbours of a vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AtRest {
    pub(crate) position: [f32; 3],
    pub(crate) part: u32,
    /// How near boxes of neighbours are in its part.
    pub(crate) within: f32,
}

impl Neighbours {
    /// Pairs in one of the parts, of each of which is told the vertex after its last one, whose boxes come within its distance at rest.
    /// Vertices after those of the last part have no neighbours.
    #[must_use]
    pub fn new(rest: &[DVec3], parts: impl Iterator<Item = (u32, f64)>) -> Self {
        let largest = largest_coordinate(rest);
        let parts: Vec<_> = parts.map(|(end, distance)| (end, nearness(distance, largest))).collect();
        let end_of_all = parts.last().map_or(0, |&(end, _)| end);
        let at_rest = |(vertex, rest): (usize, &DVec3)| {
            if vertex < end_of_all as usize {
                rest.as_vec3a()
            } else {
                Vec3A::NAN
            }
        };
        Self {
            rest: rest.iter().enumerate().map(at_rest).collect(),
            parts,
        }
    }

    /// Whether two primitives of these vertices are neighbours.
    ///
    /// # Panics
    /// If one of the vertices is none of those at rest.
    #[inline(always)]
    #[must_use]
    pub fn are(&self, kind: PairKind, vertices: [u32; 4]) -> bool {
        // Written out: `map` would not be inlined here.
        let rest = |corner: usize| self.rest[vertices[corner] as usize];
        let rest = [rest(0), rest(1), rest(2), rest(3)];
        are_boxes_within(kind, rest, self.within(vertices[0], vertices[3]))
    }

    /// How near two vertices' boxes are if they are neighbours': of no distance in different parts.
    #[inline(always)]
    fn within(&self, one: u32, other: u32) -> f32 {
        if let [(_, only)] = self.parts.as_slice() {
            return *only;
        }
        let own = self.part_of(one);
        let own = self.parts.get(own).filter(|_| own == self.part_of(other));
        own.map_or(f32::NEG_INFINITY, |&(_, within)| within)
    }

    #[inline(always)]
    fn part_of(&self, vertex: u32) -> usize {
        self.parts.partition_point(|&(end, _)| end <= vertex)
    }

    /// What makes neighbours of a vertex.
    ///
    /// # Panics
    /// If it is none of those at rest.
    pub(crate) fn at_rest(&self, vertex: u32) -> AtRest {
        let part = self.part_of(vertex);
        AtRest {
            position: self.rest[vertex as usize].to_array(),
            part: part as u32,
            within: self.parts.get(part).map_or(f32::NEG_INFINITY, |&(_, within)| within),
        }
    }
}
