//! What effects ask of contact.

use super::candidate::Candidate;

/// What the effects ask for.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactSettings {
    /// Of cloth, itself and others.
    cloth: Option<Asked>,
    /// Of cloth and bodies.
    bodies: Option<Asked>,
    /// Whether [neighbours](super::neighbours) have a smaller thickness.
    pub(super) has_neighbours: bool,
    /// Of each cloth: the vertex after its last one.
    ends: Vec<u32>,
    /// What the first cloth is to keep from cloth, and from bodies.
    of_first: [Option<Thickness>; 2],
}

/// What one effect asks for.
#[derive(Clone, Debug)]
struct Asked {
    /// Its index among the scene's effects.
    effect: usize,
    /// Of each cloth.
    of_cloths: Vec<Thickness>,
}

/// Two distances: one that contacts aim at, and a smaller one that every step is certified to keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thickness {
    /// In metres.
    pub thickness: f64,
    /// In metres, at most nine tenths of the thickness. The gap between the two is what keeps repairs of a step rare.
    pub separation: f64,
}

/// Where the largest thickness of neighbours lies, between the separation and the thickness. On a sleeve of 134,000 triangles
/// three quarters of the pairs within the reach are neighbours that are not within theirs.
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

    /// What two cloths keep from each other: half of each, as if each had its own around its middle.
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

impl Asked {
    fn add(asked: &mut Option<Self>, effect: usize, thickness: Thickness) {
        let new = || Self {
            effect,
            of_cloths: Vec::new(),
        };
        asked.get_or_insert_with(new).of_cloths.push(thickness);
    }
}

impl ContactSettings {
    /// Of cloths with so many vertices each.
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

    /// The next cloth, in the order of the scene, is to keep this from itself and from other cloths.
    pub(crate) fn keep_from_cloth(&mut self, effect: usize, thickness: Thickness) {
        Asked::add(&mut self.cloth, effect, thickness);
        self.of_first[0].get_or_insert(thickness);
    }

    /// The next cloth, in the order of the scene, is to keep this from bodies.
    pub(crate) fn keep_from_bodies(&mut self, effect: usize, thickness: Thickness) {
        Asked::add(&mut self.bodies, effect, thickness);
        self.of_first[1].get_or_insert(thickness);
    }

    fn asked(&self, with_body: bool) -> Option<&Asked> {
        if with_body { &self.bodies } else { &self.cloth }.as_ref()
    }

    /// The effect that asks for contacts with bodies, or for those of cloth.
    pub(crate) fn effect(&self, with_body: bool) -> Option<usize> {
        self.asked(with_body).map(|asked| asked.effect)
    }

    /// Of each cloth: the vertex after its last one.
    pub(super) fn ends(&self) -> impl Iterator<Item = u32> {
        self.ends.iter().copied()
    }

    /// The cloth of one of its vertices.
    pub(super) fn cloth_of(&self, vertex: u32) -> usize {
        self.ends.partition_point(|&end| end <= vertex)
    }

    /// Whether both are vertices of one cloth.
    pub(super) fn are_of_one_cloth(&self, one: u32, other: u32) -> bool {
        self.ends.len() == 1 || self.cloth_of(one) == self.cloth_of(other)
    }

    /// What a pair has to keep.
    pub(super) fn of(&self, pair: &Candidate) -> Option<Thickness> {
        let [one, .., other] = pair.vertices;
        self.of_vertices(pair.data.is_with_body(), one, other)
    }

    /// What a pair with these vertices, one of each of its sets, has to keep. Asked of every pair that a search finds.
    #[inline(always)]
    pub(super) fn of_vertices(&self, is_with_body: bool, one: u32, other: u32) -> Option<Thickness> {
        if self.ends.len() > 1 {
            return self.of_several(is_with_body, one, other);
        }
        self.of_first[usize::from(is_with_body)]
    }

    /// What each pair of cloth, and each pair with a body, has to keep where there is one cloth, so that it is the same for all of them.
    pub(super) fn of_all(&self) -> Option<[Option<Thickness>; 2]> {
        (self.ends.len() == 1).then_some(self.of_first)
    }

    /// What a pair has to keep where there are several cloths.
    #[cold]
    #[inline(never)]
    fn of_several(&self, is_with_body: bool, one: u32, other: u32) -> Option<Thickness> {
        let of_cloths = &self.asked(is_with_body)?.of_cloths;
        // Bodies' vertices come after the cloths'.
        let own = of_cloths[self.cloth_of(one.min(other))];
        if is_with_body {
            return Some(own);
        }
        Some(own.between(of_cloths[self.cloth_of(one.max(other))]))
    }

    /// What each cloth is to keep from others and from itself; none if nobody asks for that.
    pub(super) fn of_cloths(&self) -> &[Thickness] {
        self.cloth.as_ref().map_or(&[], |asked| &asked.of_cloths)
    }

    /// Whether anybody asks for contacts with bodies, or for those of cloth.
    pub(super) fn asks(&self, with_body: bool) -> bool {
        self.asked(with_body).is_some()
    }

    /// Whether anybody asks for contacts at all.
    pub(crate) fn asks_for_any(&self) -> bool {
        self.asks(false) || self.asks(true)
    }

    /// The largest of what any cloth is to keep from bodies, or from cloth; `None` if nobody asks for that.
    pub(super) fn largest(&self, with_body: bool) -> Option<Thickness> {
        let of_cloths = self.asked(with_body)?.of_cloths.iter().copied();
        of_cloths.reduce(|one, other| Thickness {
            thickness: one.thickness.max(other.thickness),
            separation: one.separation.max(other.separation),
        })
    }
}

/// Pairs that start this much farther apart than their thickness get a constraint too if they come near.
pub(super) const MARGIN: f64 = 2.0 / 3.0;

/// Pairs of cloth are neighbours if their boxes are nearer at rest than this, in thicknesses: among them are all whose thickness is
/// half their distance at rest, and all that would be candidates for good where cloth lies flat. Of other pairs 1 + [`MARGIN`] thicknesses and what is
/// looked for beyond are asked, 1.95 in all along a diagonal: what is not a neighbour is an eighth farther. With 2.0 a sheet of 130 thousand triangles that lands on
/// a ball has a fifth more candidates.
pub(super) const NEIGHBOURS_AT_REST: f64 = 2.25;
