//! Pairs that are near each other at rest: nearly all candidates of a fine mesh.
//!
//! The caller may give neighbours a smaller separation than other pairs. Hierarchies know the shapes at rest, so they leave out
//! many neighbours at a time that keep that separation.

use selvedge_core::PairKind;
use selvedge_core::glam::{DVec3, Vec3A};
use selvedge_core::separation::clearance::{are_boxes_within, nearness};
use selvedge_core::separation::largest_coordinate;

/// Decides which pairs are neighbours: pairs within a part of the mesh whose boxes at rest are within that part's distance.
#[derive(Debug)]
pub struct Neighbours {
    /// Positions at rest, in `f32`; NaN for vertices without neighbours.
    rest: Vec<Vec3A>,
    /// For each part the vertex after its last one, and its distance, rounded down.
    parts: Vec<(u32, f32)>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct AtRest {
    pub(crate) position: [f32; 3],
    pub(crate) part: u32,
    /// The distance of neighbours in its part.
    pub(crate) within: f32,
}

impl Neighbours {
    /// Makes neighbours from positions at rest and parts of consecutive vertices. Each part has the vertex after its last one,
    /// and the distance of its neighbours at rest. Vertices after the last part have no neighbours.
    ///
    /// # Panics
    /// Panics if a part ends beyond the positions.
    #[must_use]
    pub fn new(rest: &[DVec3], parts: impl Iterator<Item = (u32, f64)>) -> Self {
        let parts: Vec<_> = parts.collect();
        let end_of_all = parts.last().map_or(0, |&(end, _)| end);
        let largest = largest_coordinate(&rest[..end_of_all as usize]);
        let parts = parts.into_iter().map(|(end, distance)| (end, nearness(distance, largest)));
        let at_rest = |(vertex, rest): (usize, &DVec3)| {
            if vertex < end_of_all as usize {
                rest.as_vec3a()
            } else {
                Vec3A::NAN
            }
        };
        Self {
            rest: rest.iter().enumerate().map(at_rest).collect(),
            parts: parts.collect(),
        }
    }

    /// Returns whether two primitives with these vertices are neighbours.
    ///
    /// # Panics
    /// Panics if a vertex has no position at rest.
    #[inline(always)]
    #[must_use]
    pub fn are(&self, kind: PairKind, vertices: [u32; 4]) -> bool {
        // The calls are written out, since `map` is not inlined here.
        let rest = |corner: usize| self.rest[vertices[corner] as usize];
        let rest = [rest(0), rest(1), rest(2), rest(3)];
        are_boxes_within(kind, rest, self.within(vertices[0], vertices[3]))
    }

    /// Returns the distance of neighbours for two vertices. In different parts no distance is small enough.
    #[inline(always)]
    fn within(&self, one: u32, other: u32) -> f32 {
        if let [(_, only)] = self.parts.as_slice() {
            return *only;
        }
        let part = self.part_of(one);
        let part = self.parts.get(part).filter(|_| part == self.part_of(other));
        part.map_or(f32::NEG_INFINITY, |&(_, within)| within)
    }

    #[inline(always)]
    fn part_of(&self, vertex: u32) -> usize {
        self.parts.partition_point(|&(end, _)| end <= vertex)
    }

    /// Returns a vertex at rest.
    ///
    /// # Panics
    /// Panics if the vertex has no position at rest.
    pub(crate) fn at_rest(&self, vertex: u32) -> AtRest {
        let part = self.part_of(vertex);
        AtRest {
            position: self.rest[vertex as usize].to_array(),
            part: part as u32,
            within: self.parts.get(part).map_or(f32::NEG_INFINITY, |&(_, within)| within),
        }
    }
}
