//! Finds the primitives of a mesh at rest that meet.
//!
//! An edge is the path of a vertex from one of its ends to the other. So an edge and a face are tested like a vertex and a face
//! during a step, by the same filter, sweeps and exact verdict:
//!
//! ```text
//! edges and faces without a common vertex     traversal of their hierarchies
//! triangles with a common edge ("hinges")     not wide open, perhaps coplanar: their four pairs without a common vertex
//! ends of loose edges, points                 vertices and faces that the edge connects; all faces with a point
//!   │  chunk by chunk, as in a step           filter, sweeps, exact verdict
//!   ▼
//! intersections
//! ```
//!
//! # Why these are enough
//! Two triangles have a point in common, besides the vertices that they share, exactly if one of these pairs meets:
//! * **No common vertex.** A triangle without area is the union of its edges. Otherwise two triangles meet in a segment that ends
//!   where an edge of one meets the other. Or they are coplanar and overlap in a polygon whose corners lie on edges.
//! * **One common vertex v**, and x another common point. The ray from v through x leaves each triangle on the edge opposite to
//!   v, or in an end of it. Where it first leaves a triangle, it is still in the other, which is convex.
//! * **A common edge, v u**, and x a common point beside it. Then both triangles lie in one plane, on one side of v u, with
//!   corners a and b. By the angles at v and at u, one of the corners is in the other triangle, or v a crosses u b, or u a
//!   crosses v b. Every edge of one triangle has a vertex of the other, so these four pairs are tested separately.
//!
//! This also finds a vertex that touches a face, and two edges that touch: as an edge and a face, or as a pair of a hinge. Loose
//! features are the exception. A triangle that names a vertex twice is an edge, whose end may touch a face that contains its
//! other end. A triangle that names one vertex only is a point without edges, so it is tested with every face.

use super::chunk::{Chunk, ChunkSink, StepInput, drop_never_coplanar};
use super::findings::Findings;
use super::numbering::Numbering;
use super::pair_engine::Space;
use super::question::Wanted;
use crate::broad_phase::{BlockPair, CHUNK, FacesAndEdges, Hierarchies, Pairing, Sink};
use crate::mesh::Hinges;
use crate::step::{Contact, Intersection};
use selvedge_core::PairKind;
use selvedge_core::separation::hinge::is_wide_open;

/// The tasks of traversals for pairs at rest.
#[derive(Debug, Default)]
pub(super) struct RestTasks {
    faces_and_edges: Vec<BlockPair>,
    /// The tasks for vertices and faces, if there are loose edges or points.
    vertices_and_faces: Vec<BlockPair>,
    stack: Vec<BlockPair>,
}

impl RestTasks {
    /// Finds the tasks. Returns the number of box tests for faces and edges.
    pub(super) fn find(&mut self, hierarchies: &Hierarchies, hinges: &Hinges) -> u64 {
        self.vertices_and_faces.clear();
        if hinges.has_loose_features() {
            let [vertex_face, _] = Pairing::all_within(hierarchies);
            vertex_face.find_tasks(&mut self.stack, &mut self.vertices_and_faces);
        }
        self.faces_and_edges.clear();
        FacesAndEdges(hierarchies).find_tasks(&mut self.stack, &mut self.faces_and_edges)
    }
}

/// Returns one of several equal shares of a list.
fn part_of<T>(list: &[T], [share, shares]: [usize; 2]) -> &[T] {
    let place = |share: usize| list.len() * share / shares;
    &list[place(share)..place(share + 1)]
}

/// The parts of a search, one after the other.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    FacesAndEdges,
    Hinges,
    LooseFeatures,
}

impl Part {
    pub(super) fn intersection(self, contact: &Contact<f64>) -> Intersection {
        let [first, second] = contact.pair;
        match (self, contact.kind) {
            (Self::FacesAndEdges, _) => Intersection::EdgeFace {
                face: first,
                edge: second,
            },
            (_, PairKind::VertexFace) => Intersection::VertexFace {
                vertex: first,
                face: second,
            },
            (_, PairKind::EdgeEdge) => Intersection::EdgeEdge { edges: contact.pair },
        }
    }
}

/// The input of all threads.
pub(super) struct RestSearch<'a> {
    /// The input for edges and faces.
    pub(super) step: StepInput<'a>,
    pub(super) hierarchies: &'a Hierarchies,
    pub(super) hinges: &'a Hinges,
    pub(super) tasks: &'a RestTasks,
}

impl RestSearch<'_> {
    /// Returns whether the search is complete, or was cut short.
    pub(super) fn has_enough(&self) -> bool {
        let is_answered = self.step.question.wanted == Wanted::Any && self.step.bound.is_lowered();
        is_answered || !self.step.stop.continues(0)
    }

    /// Searches one share of a part. Returns the number of box tests.
    pub(super) fn share(&self, part: Part, [share, shares]: [usize; 2], space: &mut Space, findings: &mut Findings) -> u64 {
        space.chunk.clear();
        match part {
            Part::FacesAndEdges => return self.faces_and_edges([share, shares], space, findings),
            Part::Hinges => {
                let edges = self.hierarchies.topology().edges().len();
                let bound = |share: usize| (edges * share / shares) as u32;
                self.hinges(bound(share)..bound(share + 1), space, findings);
            }
            Part::LooseFeatures if self.hinges.has_loose_features() => self.loose_features([share, shares], space, findings),
            Part::LooseFeatures => {}
        }
        0
    }

    fn faces_and_edges(&self, [share, shares]: [usize; 2], space: &mut Space, findings: &mut Findings) -> u64 {
        let Space { scratch, chunk, .. } = space;
        let kind = PairKind::VertexFace;
        let step = &self.step;
        let mut sink = ChunkSink {
            chunk,
            findings,
            step,
            kind,
        };
        let tasks = part_of(&self.tasks.faces_and_edges, [share, shares]);
        let tests = FacesAndEdges(self.hierarchies).visit(tasks, scratch, &mut sink);
        if tests.is_some() {
            chunk.finish(step, kind, findings);
        }
        tests.unwrap_or_default()
    }

    /// Tests the hinges of some edges.
    fn hinges(&self, edges: impl Iterator<Item = u32>, space: &mut Space, findings: &mut Findings) {
        let topology = self.hierarchies.topology();
        let step = StepInput {
            numbering: Numbering::Placed(self.hierarchies),
            ..self.step
        };
        let moves = |vertices: [u32; 4]| vertices.into_iter().any(|vertex| self.hierarchies.moves(vertex));
        let rows = self.hierarchies.rows().double();
        let is_folded = |places: [u32; 4]| !is_wide_open(places.map(|place| rows[place as usize].motion().start));
        let mut hinges = edges
            .flat_map(|edge| self.hinges.at(edge))
            .filter_map(|hinge| Some((hinge, hinge.vertices(topology)?)))
            .filter(|&(_, vertices)| moves(vertices))
            .map(|(hinge, vertices)| (hinge, vertices.map(|vertex| self.hierarchies.position_of(vertex))))
            .filter(|&(_, places)| is_folded(places))
            .peekable();
        let Space {
            chunk,
            near,
            hinges: own,
            ..
        } = space;
        while hinges.peek().is_some() && !self.has_enough() {
            own.clear();
            // Each hinge gives two pairs of a kind.
            for (hinge, places) in hinges.by_ref().take(CHUNK / 2) {
                own.indices.push([own.hinges.len() as u32; 2]);
                own.hinges.push(hinge);
                own.rows.push(places);
            }
            // All four pairs have the same volume.
            drop_never_coplanar(&step, PairKind::EdgeEdge, 0, &mut own.indices, &mut own.rows, &mut own.masks);
            for kind in PairKind::ALL {
                near.clear();
                for &[index, _] in &own.indices {
                    if let Some(pairs) = own.hinges[index as usize].pairs(topology) {
                        near.extend(pairs[kind as usize]);
                    }
                }
                if chunk.take(&step, kind, near, findings) {
                    chunk.finish(&step, kind, findings);
                }
            }
        }
    }

    fn loose_features(&self, [share, shares]: [usize; 2], space: &mut Space, findings: &mut Findings) {
        let Space {
            scratch, chunk, near, ..
        } = space;
        let step = StepInput {
            numbering: Numbering::Positions(self.hierarchies),
            ..self.step
        };
        let mut sink = TiedSink {
            search: self,
            step: &step,
            tied: near,
            chunk,
            findings,
        };
        let tasks = part_of(&self.tasks.vertices_and_faces, [share, shares]);
        let [vertex_face, _] = Pairing::all_within(self.hierarchies);
        if vertex_face.visit(tasks, scratch, &mut sink).is_some() {
            chunk.finish(&step, PairKind::VertexFace, findings);
        }
    }
}

/// A sink that takes the vertices and faces that touch without an edge and a face that meet.
struct TiedSink<'a> {
    search: &'a RestSearch<'a>,
    step: &'a StepInput<'a>,
    tied: &'a mut Vec<[u32; 2]>,
    chunk: &'a mut Chunk,
    findings: &'a mut Findings,
}

impl Sink for TiedSink<'_> {
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool {
        let RestSearch { hierarchies, hinges, .. } = self.search;
        let may_touch_unseen = |&pair: &[u32; 2]| {
            let [vertex, face] = hierarchies.in_mesh(PairKind::VertexFace, pair);
            hinges.may_touch_unseen(vertex, hierarchies.topology().triangles()[face as usize])
        };
        self.tied.clear();
        self.tied.extend(pairs.iter().copied().filter(may_touch_unseen));
        self.chunk.take(self.step, PairKind::VertexFace, self.tied, self.findings)
    }
}
