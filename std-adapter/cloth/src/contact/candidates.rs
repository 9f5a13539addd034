//! Which pairs contact looks at: [near pairs](NearPairs) of cloth with itself and with bodies, good for several steps.

use super::candidate::OfPair;
use super::crossing::{Crossing, CrossingFinder, PairKey};
use super::neighbours::{Neighbours, are_many, at_rest};
use super::settings::{ContactSettings, MARGIN, Thickness};
use crate::step::{Carrier, FREE};
use selvedge::verification::{Class, Interest, NearPairs, Reach};
use selvedge::{Intersection, PairKind, Topology, TopologyError};
use selvedge_core::glam::DVec3;
use std::sync::Arc;

/// Pairs near the state.
pub(super) type Candidates = NearPairs<OfContact>;

/// How far beyond the thickness candidates are looked for, in thicknesses: more makes longer lists that last longer. Measured on the
/// arm sleeve: from 0.2 to 0.7 a step costs the same within a tenth.
const REACH: f64 = 0.3;
/// The same on a fine mesh. Measured on the sleeve with 134 thousand triangles where the elbow pinches (18 steps from the 1,000th): 15.0 s of
/// processor time with 0.3, 20.5 s with 0.6; with 13 thousand triangles the same within a tenth from 0.15 to 0.6.
const REACH_OF_FINE: f64 = 0.3;
/// How much more than the thickness is asked for along directions that are no axes, of a pair with a body, in thicknesses.
const MARGIN_OF_BODIES: f64 = 0.0;
/// Most steps to look ahead.
const FARTHEST: u32 = 4;
/// The same on a fine mesh, of whose candidates a sieve leaves few.
const FARTHEST_OF_FINE: u32 = 8;
/// What a candidate costs in a step, constraints and certificate, in units of what finding one costs that boxes leave: 30 and 50 ns on a sheet of 130
/// thousand triangles that lands on a ball.
const UPKEEP: f64 = 0.6;

/// What is to be kept apart.
#[derive(Debug)]
pub(super) struct OfContact {
    topology: Arc<Topology>,
    /// Whether cloth and cloth are, and cloth and bodies.
    cloth: bool,
    bodies: bool,
    /// Of each vertex: whose motion it follows.
    carriers: Vec<Carrier>,
    /// Vertices from here on are bodies'.
    cloth_vertices: usize,
    neighbours: Neighbours,
}

/// `rest` and `carriers` are of all vertices, the cloth's first. Gives neighbours in `settings` a thickness of their own if they are
/// many.
///
/// Of cloth and cloth more than the thickness is asked for along directions that are no axes: what comes that [near](MARGIN) is pushed apart before
/// it is within the thickness. With less, cloth that is folded tightly was seen to slip more.
pub(super) fn candidates(
    settings: &mut ContactSettings,
    triangles: &[[u32; 3]],
    rest: &[DVec3],
    carriers: &[Carrier],
    cloth_vertices: usize,
) -> Result<Candidates, TopologyError> {
    let topology = Arc::new(Topology::new(rest.len(), triangles.to_vec())?);
    let [cloth, bodies] = [false, true].map(|with_body| settings.largest(with_body));
    let mut neighbours = Neighbours::none();
    let mut of_neighbours = cloth;
    let (mut reach, mut farthest) = (REACH, FARTHEST);
    if are_many(&topology, rest, cloth_vertices, settings) {
        settings.has_neighbours = true;
        neighbours = Neighbours::new(
            rest,
            settings.ends().zip(settings.of_cloths().iter().map(|own| at_rest(*own))),
        );
        let smaller = settings.of_cloths().iter().map(|own| own.of_neighbours()).fold(0.0, f64::max);
        of_neighbours = cloth.map(|cloth| Thickness {
            thickness: smaller,
            ..cloth
        });
        (reach, farthest) = (REACH_OF_FINE, FARTHEST_OF_FINE);
    }
    let class = |thickness: Option<Thickness>, margin: f64| Class {
        distance: thickness.map_or(0.0, |thickness| thickness.thickness),
        margin: margin as f32,
    };
    let asked = [of_neighbours, cloth, bodies];
    let spare = asked.iter().flatten().map(|asked| asked.thickness - asked.separation);
    let thickest = asked.iter().flatten().map(|asked| asked.thickness).fold(0.0, f64::max);
    let reach = Reach {
        classes: [
            class(of_neighbours, MARGIN),
            class(cloth, MARGIN),
            class(bodies, MARGIN_OF_BODIES),
        ],
        beyond: thickest * reach,
        spare: spare.fold(f64::INFINITY, f64::min),
        farthest,
        upkeep: UPKEEP,
        is_graded: false,
    };
    let interest = OfContact {
        topology: Arc::clone(&topology),
        cloth: settings.asks(false),
        bodies: settings.asks(true),
        carriers: carriers.to_vec(),
        cloth_vertices,
        neighbours,
    };
    // Bodies among themselves are of no interest.
    let wanted = (0..rest.len()).map(|vertex| vertex < cloth_vertices).collect();
    let candidates = NearPairs::new(topology, interest, wanted, reach);
    Ok(candidates.expect("scenes give a positive thickness"))
}

impl Interest for OfContact {
    type Data = OfPair;

    /// Neighbours in cloth, other pairs of cloth, pairs with a body.
    #[inline(always)]
    fn class(&self, kind: PairKind, vertices: [u32; 4]) -> usize {
        let [one, .., other] = vertices;
        if one.max(other) as usize >= self.cloth_vertices {
            return 2;
        }
        usize::from(!self.neighbours.are(kind, vertices))
    }

    /// `None` also if all of the pair follows one motion, which never changes it.
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
        Some(OfPair { thickness: 0.0, body })
    }
}

impl OfContact {
    /// Of all primitives, the cloth's first.
    pub(super) fn topology(&self) -> &Arc<Topology> {
        &self.topology
    }

    /// Whether there is such a pair.
    pub(super) fn has(&self, (kind, [first, second]): &PairKey) -> bool {
        let edges = self.topology.edges().len();
        let [firsts, seconds] = match kind {
            PairKind::VertexFace => [self.topology.vertex_count(), self.topology.triangles().len()],
            PairKind::EdgeEdge => [edges, edges],
        };
        (*first as usize) < firsts && (*second as usize) < seconds
    }

    /// What two primitives are that meet.
    pub(super) fn crossing(&self, intersection: &Intersection, positions: &[DVec3]) -> Crossing {
        let crossing = Crossing::new(&self.topology, intersection, positions);
        let body = self.body_of_pair(crossing.edge[0], crossing.face[0]);
        Crossing {
            body: body.filter(|&body| body != FREE).map(|body| body as usize),
            ..crossing
        }
    }

    /// Whether an edge of the cloth passes through a face of a body, or the other way round.
    pub(super) fn passes_through(&self, body: Carrier, positions: &[DVec3]) -> bool {
        let found = CrossingFinder::new(&self.topology);
        let is_of_body = |a, b| self.body_of_pair(a, b) == Some(body);
        // Where that cannot be asked, nothing is known to be apart.
        { found }.find(positions, is_of_body).map_or(true, |found| !found.is_empty())
    }

    /// The body of two vertices that are to be kept apart, [`FREE`] for cloth and cloth; `None` if nobody asked for that.
    #[inline(always)]
    pub(super) fn body_of_pair(&self, one: u32, other: u32) -> Option<Carrier> {
        match (self.body(one), self.body(other)) {
            (FREE, FREE) if self.cloth => Some(FREE),
            (FREE, body) | (body, FREE) if body != FREE && self.bodies => Some(body),
            _ => None,
        }
    }

    /// The body of a vertex; [`FREE`] for cloth, pinned or not.
    pub(super) fn body(&self, vertex: u32) -> Carrier {
        match vertex as usize {
            vertex if vertex < self.cloth_vertices => FREE,
            vertex => self.carriers[vertex],
        }
    }
}
