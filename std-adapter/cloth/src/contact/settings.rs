//! The distances of contact that effects request.

use super::candidate::Candidate;

/// The requests of all effects.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactSettings {
    /// The distances that each cloth keeps from itself and from other cloths; empty without such a request.
    cloth: Vec<Thickness>,
    /// The distances that each cloth keeps from bodies; empty without such a request.
    bodies: Vec<Thickness>,
    /// True if [neighbours](super::neighbours) have a smaller thickness.
    pub(super) has_neighbours: bool,
    /// The vertex after the last one of each cloth.
    ends: Vec<u32>,
    /// The distances that the first cloth has to keep from cloth, and from bodies.
    of_first: [Option<Thickness>; 2],
}

/// Two distances: one that contacts aim at, and a smaller one that every step is certified to keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thickness {
    /// The distance at which contacts aim, in metres.
    pub thickness: f64,
    /// The distance that steps certify, in metres; at most nine tenths of the thickness. The gap between the two is the reason
    /// that steps rarely need repairs.
    pub separation: f64,
}

crate::identify!(Thickness { thickness, separation });

/// The position of the largest thickness of neighbours between the separation (0) and the thickness (1). On a sleeve of 134,000
/// triangles three quarters of the pairs within reach are neighbours farther apart than their own thickness.
const NEIGHBOURS: f64 = 0.2;

impl Thickness {
    /// A thickness in metres, of which every step is certified to keep a tenth.
    #[must_use]
    pub const fn new(thickness: f64) -> Self {
        Self {
            thickness,
            separation: 0.1 * thickness,
        }
    }

    /// The distances between two cloths: half of each, as if each had its own around its middle.
    pub(crate) const fn between(self, other: Self) -> Self {
        Self {
            thickness: 0.5 * (self.thickness + other.thickness),
            separation: 0.5 * (self.separation + other.separation),
        }
    }

    /// The largest thickness of neighbours, in metres.
    pub(super) fn of_neighbours(self) -> f64 {
        self.separation + NEIGHBOURS * (self.thickness - self.separation)
    }
}

impl ContactSettings {
    /// Makes settings without requests, for cloths with so many vertices each.
    pub(crate) fn new(vertex_counts: impl Iterator<Item = usize>) -> Self {
        let mut end = 0;
        let ends = vertex_counts.map(|count| {
            end += count as u32;
            end
        });
        Self {
            ends: ends.collect(),
            ..Self::default()
        }
    }

    /// Requests that the next cloth, in the order of the scene, keeps this distance from itself and from other cloths.
    pub(crate) fn keep_from_cloth(&mut self, thickness: Thickness) {
        self.cloth.push(thickness);
        self.of_first[0].get_or_insert(thickness);
    }

    /// Requests that the next cloth, in the order of the scene, keeps this distance from bodies.
    pub(crate) fn keep_from_bodies(&mut self, thickness: Thickness) {
        self.bodies.push(thickness);
        self.of_first[1].get_or_insert(thickness);
    }

    fn asked(&self, with_body: bool) -> &[Thickness] {
        if with_body { &self.bodies } else { &self.cloth }
    }

    /// The vertex after the last one of each cloth.
    pub(super) fn ends(&self) -> impl Iterator<Item = u32> {
        self.ends.iter().copied()
    }

    /// The cloth of one of its vertices.
    pub(super) fn cloth_of(&self, vertex: u32) -> usize {
        self.ends.partition_point(|&end| end <= vertex)
    }

    /// Returns whether both are vertices of one cloth.
    pub(super) fn are_of_one_cloth(&self, one: u32, other: u32) -> bool {
        self.ends.len() == 1 || self.cloth_of(one) == self.cloth_of(other)
    }

    /// The distances that a pair has to keep.
    pub(super) fn of(&self, pair: &Candidate) -> Option<Thickness> {
        let [one, .., other] = pair.vertices;
        self.of_vertices(pair.data.is_with_body(), one, other)
    }

    /// The distances that a pair with these vertices, one of each of its sets, has to keep. This is called for every pair that a
    /// search finds.
    #[inline(always)]
    pub(super) fn of_vertices(&self, is_with_body: bool, one: u32, other: u32) -> Option<Thickness> {
        if self.ends.len() > 1 {
            return self.of_several(is_with_body, one, other);
        }
        self.of_first[usize::from(is_with_body)]
    }

    /// The distances that each pair of cloth, and each pair with a body, has to keep. Only with one cloth are they the same for
    /// all pairs.
    pub(super) fn of_all(&self) -> Option<[Option<Thickness>; 2]> {
        (self.ends.len() == 1).then_some(self.of_first)
    }

    /// The distances that a pair has to keep if there are several cloths.
    #[cold]
    #[inline(never)]
    fn of_several(&self, is_with_body: bool, one: u32, other: u32) -> Option<Thickness> {
        let of_cloths = self.asked(is_with_body);
        // Bodies' vertices come after the cloths'.
        let Some(&own) = of_cloths.get(self.cloth_of(one.min(other))) else {
            // Two bodies.
            return self.largest(is_with_body);
        };
        if is_with_body {
            return Some(own);
        }
        Some(own.between(of_cloths[self.cloth_of(one.max(other))]))
    }

    /// The distances that each cloth has to keep from others and from itself; empty without such a request.
    pub(super) fn of_cloths(&self) -> &[Thickness] {
        &self.cloth
    }

    /// Returns whether an effect requests contacts with bodies, or those of cloth.
    pub(super) fn asks(&self, with_body: bool) -> bool {
        !self.asked(with_body).is_empty()
    }

    /// Returns whether an effect requests contacts.
    pub(crate) fn asks_for_any(&self) -> bool {
        self.asks(false) || self.asks(true)
    }

    /// The largest distances that any cloth has to keep from bodies, or from cloth; `None` without such a request.
    pub(super) fn largest(&self, with_body: bool) -> Option<Thickness> {
        let of_cloths = self.asked(with_body).iter().copied();
        of_cloths.reduce(|one, other| Thickness {
            thickness: one.thickness.max(other.thickness),
            separation: one.separation.max(other.separation),
        })
    }
}

/// Pairs that start this much farther apart than their thickness also get a constraint if they come near.
pub(super) const MARGIN: f64 = 2.0 / 3.0;

/// Pairs of cloth are neighbours if their boxes are nearer at rest than this, in thicknesses. They include all pairs with a
/// thickness of half their distance at rest, and all that would stay candidates while the cloth lies flat. Other pairs are
/// candidates within 1 + [`MARGIN`] thicknesses and the reach beyond, 1.95 in all along a diagonal. A pair that is no neighbour
/// is an eighth farther apart. With 2.0 a sheet of 130 thousand triangles that lands on a ball has a fifth more candidates.
pub(super) const NEIGHBOURS_AT_REST: f64 = 2.25;
