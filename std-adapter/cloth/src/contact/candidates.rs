//! The pairs that contact looks at: [near pairs](NearPairs) of cloth with itself and with bodies, valid for several steps.

use super::candidate::{Aim, OfPair};
use super::crossing::{Crossing, CrossingFinder, PairKey};
use super::neighbours::{are_many, at_rest};
use super::settings::{ContactSettings, MARGIN, Thickness};
use crate::model::step::{Carrier, FREE};
use selvedge::broad_phase::Neighbours;
use selvedge::coherent::{CLASSES, Class, Interest, NearPairs, Reach};
use selvedge::{Intersection, PairKind, Topology};
use selvedge_core::glam::DVec3;
use std::array;
use std::sync::Arc;

/// Pairs near the state.
pub(super) type Candidates = NearPairs<OfContact>;

/// The distance beyond the thickness to which the search for candidates goes, in thicknesses. A larger value makes longer lists
/// that last
/// longer. Most of the work of a step is what it does with each candidate, unless vertices move far because steps are long. The
/// processor times with 0.3 and 0.2 are: a sleeve of 40 thousand triangles 77 and 68 s (73 s with 0.13), sheets of 10 and 50
/// thousand that land on a ball 6.8 and 6.7 s, 24 and 22 s. A shirt on a figure that walks in steps of 4 ms takes 6.0 and 6.9 s.
const REACH: f64 = 0.2;
/// The value of [`REACH`] in steps that are longer than [`SHORT`].
const REACH_OF_LONG: f64 = 0.3;
/// The longest of short steps, in seconds; it lies between the measured steps of 1 ms and of 4 ms.
const SHORT: f64 = 2.5e-3;
/// The distance beyond the thickness to which the search goes along other directions than the axes, in thicknesses. The values
/// are for
/// neighbours, other pairs of cloth, and pairs with a body. Pairs of cloth that come that [near](MARGIN) are pushed apart before
/// they are within the thickness. With a smaller value, tightly folded cloth slipped more. The cloth between neighbours holds
/// them apart. With zero for them a sheet of 130 thousand triangles that lands on a ball has half as many candidates, and takes
/// as long. With zero for bodies the arm sleeve has 9 to 15 % fewer, and repairs take as long as before.
const MARGINS: [f64; CLASSES] = [0.0, MARGIN, 0.0];
/// The largest number of steps to look ahead.
const FARTHEST: u32 = 4;
/// The value of [`FARTHEST`] on a fine mesh, where few candidates pass the sieve.
const FARTHEST_OF_FINE: u32 = 8;
/// The cost of a candidate in a step (constraints and certificate), in units of the cost to find a candidate that boxes let
/// through. These were 30 and 50 ns on a sheet of 130 thousand triangles that lands on a ball, before the search became faster.
/// With 1.0 a sleeve of 40 thousand takes 79 s, with 0.6 77 s.
const UPKEEP: f64 = 0.6;

/// The pairs that contact keeps apart.
#[derive(Debug)]
pub(super) struct OfContact {
    topology: Arc<Topology>,
    /// The distance to keep, if any.
    settings: ContactSettings,
    /// Whose motion each vertex follows.
    carriers: Vec<Carrier>,
    /// The number of the cloth's vertices; bodies' vertices come after them.
    cloth_vertices: usize,
    /// True for each body that the solve alone moves: not for proxies, since their engine keeps bodies apart.
    are_free: Vec<bool>,
    /// The neighbours, if they have a thickness of their own.
    neighbours: Option<Arc<Neighbours>>,
}

/// `rest` and `carriers` are of all vertices, the cloth's first; steps mostly take `time_step` seconds. Gives neighbours in
/// `settings` a thickness of their own if there are many.
pub(super) fn candidates(
    settings: &mut ContactSettings,
    topology: Topology,
    rest: &[DVec3],
    carriers: &[Carrier],
    (cloth_vertices, are_free): (usize, &[bool]),
    time_step: f64,
) -> Candidates {
    let topology = Arc::new(topology);
    let [cloth, bodies] = [false, true].map(|with_body| settings.largest(with_body));
    let mut neighbours = None;
    let mut of_neighbours = cloth;
    let beyond = if time_step <= SHORT { REACH } else { REACH_OF_LONG };
    let mut farthest = FARTHEST;
    if are_many(&topology, rest, cloth_vertices, settings) {
        settings.has_neighbours = true;
        let parts = settings.ends().zip(settings.of_cloths().iter().map(|own| at_rest(*own)));
        neighbours = Some(Arc::new(Neighbours::new(rest, parts)));
        let smaller = settings.of_cloths().iter().map(|own| own.of_neighbours()).fold(0.0, f64::max);
        of_neighbours = cloth.map(|cloth| Thickness {
            thickness: smaller,
            ..cloth
        });
        farthest = FARTHEST_OF_FINE;
    }
    // These are in the order of `OfContact::class`.
    let asked: [Option<Thickness>; CLASSES] = [of_neighbours, cloth, bodies];
    let distances = asked.map(|asked| asked.map_or(0.0, |asked| asked.thickness));
    let spare = asked.iter().flatten().map(|asked| asked.thickness - asked.separation);
    let reach = Reach {
        classes: array::from_fn(|class| Class {
            distance: distances[class],
            margin: MARGINS[class] as f32,
        }),
        beyond: beyond * distances.into_iter().fold(0.0, f64::max),
        spare: spare.fold(f64::INFINITY, f64::min),
        farthest,
        upkeep: UPKEEP,
        is_graded: false,
    };
    let interest = OfContact {
        topology: Arc::clone(&topology),
        settings: settings.clone(),
        carriers: carriers.to_vec(),
        cloth_vertices,
        are_free: are_free.to_vec(),
        neighbours,
    };
    let is_free = |body: Carrier| are_free.get(body as usize) == Some(&true);
    // Pairs of two bodies that the solve does not move are not needed.
    let wanted = (0..rest.len()).map(|vertex| vertex < cloth_vertices || is_free(carriers[vertex]));
    let wanted = wanted.collect();
    let candidates = NearPairs::new(topology, interest, wanted, reach);
    let mut candidates = candidates.expect("scenes give a positive thickness");
    // The vertices of a body follow each other.
    let mut end = cloth_vertices;
    let bodies = carriers[cloth_vertices..]
        .chunk_by(|one, other| one == other)
        .filter_map(|own| {
            end += own.len();
            (!is_free(own[0])).then(|| end - own.len()..end)
        });
    candidates.set_parts(bodies.collect());
    candidates
}

impl Interest for OfContact {
    type Data = OfPair;

    /// The classes are neighbours in cloth, other pairs of cloth, and pairs with a body.
    #[inline(always)]
    fn class(&self, kind: PairKind, vertices: [u32; 4]) -> usize {
        let [one, .., other] = vertices;
        if one.max(other) as usize >= self.cloth_vertices {
            return 2;
        }
        let neighbours = self.neighbours.as_ref();
        usize::from(!neighbours.is_some_and(|neighbours| neighbours.are(kind, vertices)))
    }

    fn neighbours(&self) -> Option<Arc<Neighbours>> {
        self.neighbours.clone()
    }

    /// `None` also if the whole pair follows one motion, which never changes its distance.
    #[inline(always)]
    fn about(&self, kind: PairKind, vertices: [u32; 4]) -> Option<OfPair> {
        let last_of_first = match kind {
            PairKind::VertexFace => vertices[0],
            PairKind::EdgeEdge => vertices[1],
        };
        let body = self.body_of_pair(last_of_first, vertices[3])?;
        let [a, b, c, d] = vertices.map(|v| self.carriers[v as usize]);
        if a != FREE && a == b && a == c && a == d {
            return None;
        }
        let asked = self.settings.of_vertices(body != FREE, vertices[0], vertices[3])?;
        Some(OfPair {
            aim: Aim::requested(asked.thickness),
            body,
        })
    }
}

impl OfContact {
    /// The topology of all primitives, the cloth's first.
    pub(super) fn topology(&self) -> &Arc<Topology> {
        &self.topology
    }

    /// Returns whether there is such a pair.
    pub(super) fn has(&self, (kind, [first, second]): &PairKey) -> bool {
        let edges = self.topology.edges().len();
        let [firsts, seconds] = match kind {
            PairKind::VertexFace => [self.topology.vertex_count(), self.topology.triangles().len()],
            PairKind::EdgeEdge => [edges, edges],
        };
        (*first as usize) < firsts && (*second as usize) < seconds
    }

    /// The primitives that meet.
    pub(super) fn crossing(&self, intersection: &Intersection, positions: &[DVec3]) -> Crossing {
        let crossing = Crossing::new(&self.topology, intersection, positions);
        let body = self.body_of_pair(crossing.edge[0], crossing.face[0]);
        Crossing {
            body: body.filter(|&body| body != FREE).map(|body| body as usize),
            ..crossing
        }
    }

    /// Returns whether an edge of the cloth passes through a face of a body, or the other way round.
    pub(super) fn passes_through(&self, body: Carrier, positions: &[DVec3]) -> bool {
        let found = CrossingFinder::new(&self.topology);
        let is_of_body = |a, b| self.body_of_pair(a, b) == Some(body);
        // If the search fails, nothing is known to be apart.
        { found }.find(positions, is_of_body).map_or(true, |found| !found.is_empty())
    }

    /// The body of two vertices to keep apart, [`FREE`] for cloth and cloth; `None` if no effect keeps them apart. Of two bodies
    /// it is one that the solve does not move, if there is one.
    #[inline(always)]
    pub(super) fn body_of_pair(&self, one: u32, other: u32) -> Option<Carrier> {
        match (self.body(one), self.body(other)) {
            (FREE, FREE) if self.settings.asks(false) => Some(FREE),
            (FREE, body) | (body, FREE) if body != FREE && self.settings.asks(true) => Some(body),
            (one, other) if one != other && self.settings.asks(true) => match [one, other].map(|body| self.is_free(body)) {
                [false, false] => None,
                [true, false] => Some(other),
                [false, true] => Some(one),
                [true, true] => Some(one.min(other)),
            },
            _ => None,
        }
    }

    fn is_free(&self, body: Carrier) -> bool {
        self.are_free.get(body as usize) == Some(&true)
    }

    /// The body of a vertex; [`FREE`] for cloth, pinned or not.
    pub(super) fn body(&self, vertex: u32) -> Carrier {
        match vertex as usize {
            vertex if vertex < self.cloth_vertices => FREE,
            vertex => self.carriers[vertex],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number of pairs of two layers of one cloth, and of pairs of the lower layer and a body below it, at these distances.
    fn found(of_cloth: f64, of_bodies: f64, [layers, body]: [f64; 2]) -> [usize; 2] {
        let triangle = |height: f64| [DVec3::ZERO, DVec3::X, DVec3::Y].map(|point| point + DVec3::Z * height);
        let at = |heights: [f64; 3]| heights.into_iter().flat_map(triangle).collect::<Vec<_>>();
        let mut settings = ContactSettings::new([6].into_iter());
        settings.keep_from_cloth(Thickness::new(of_cloth));
        settings.keep_from_bodies(Thickness::new(of_bodies));
        let topology = Topology::new(9, vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]]).unwrap();
        let carriers: Vec<Carrier> = [[FREE; 6].as_slice(), &[0; 3]].concat();
        let mut near = candidates(&mut settings, topology, &at([0.0, 1.0, -1.0]), &carriers, (6, &[]), 1e-3);
        let positions = at([0.0, layers, -body]);
        near.find(&positions, &positions, 1e-3);
        let with_body = near.list.iter().filter(|pair| pair.data.is_with_body()).count();
        [near.list.len() - with_body, with_body]
    }

    #[test]
    fn pairs_of_cloth_and_pairs_with_bodies_are_looked_for_within_their_own_thickness() {
        // Two triangles above each other: six vertices with the other face, nine pairs of edges.
        let of_cloth = found(5e-3, 1e-3, [4e-3, 4e-3]);
        assert!(of_cloth[0] >= 6 && of_cloth[1] == 0, "{of_cloth:?}");
        let of_bodies = found(1e-3, 5e-3, [4e-3, 4e-3]);
        assert!(of_bodies[0] == 0 && of_bodies[1] >= 6, "{of_bodies:?}");
        let of_both = found(5e-3, 1e-3, [4e-3, 0.9e-3]);
        assert!(of_both.iter().all(|&pairs| pairs >= 6), "{of_both:?}");
    }
}
