//! Finds the primitives of a mesh at rest that meet.
//!
//! An edge is the way of a vertex from one of its ends to the other. So an edge and a face are tested like a vertex and a face during a step, by the
//! same filter, sweeps and exact verdict:
//!
//! ```text
//! edges and faces without a common vertex     traversal of their hierarchies
//! triangles with a common edge ("hinges")     those that are not wide open, and may be coplanar: their four pairs without a common vertex
//! ends of loose edges, points                 vertices and faces that the edge connects; all faces with a point
//!   │  chunk by chunk, as in a step           filter, sweeps, exact verdict
//!   ▼
//! intersections
//! ```
//!
//! # Why these are enough
//! Two triangles have a point in common, besides the vertices that they share, exactly if one of these pairs meets:
//! * **No common vertex.** A triangle without area is the union of its edges. Otherwise two triangles meet in a segment that ends where an edge of one
//!   meets the other, or they are coplanar and overlap in a polygon whose corners lie on edges.
//! * **One common vertex v**, and x another common point. The ray from v through x leaves each triangle on the edge opposite to v, or in an end of it.
//!   Where it first leaves a triangle, it is still in the other, which is convex.
//! * **A common edge, v u**, and x a common point beside it. Then both triangles lie in one plane, on one side of v u, with corners a and b. By the
//!   angles at v and at u, one of the corners is in the other triangle, or v a crosses u b, or u a crosses v b. Every edge of one triangle has a
//!   vertex of the other, so these four pairs are tested separately.
//!
//! This also finds a vertex that touches a face, and two edges that touch: as an edge and a face, or as a pair of a hinge. Loose features are the
//! exception. A triangle that names a vertex twice is an edge, whose end may touch a face that contains its other end. A triangle that names one
//! vertex only is a point without edges, so it is tested with every face.

use super::chunk::{Chunk, ChunkSink, Numbers, StepInput, drop_never_coplanar};
use super::findings::Findings;
use super::mesh_engine::MeshEngine;
use super::pair_engine::{Space, own_space, shares, spaces_for_threads};
use super::question::{Bound, Question, Wanted};
use crate::PairKind;
use crate::broad_phase::{BlockPair, CHUNK, FacesAndEdges, Fit, Hierarchies, Pairing, Rows, Sink};
use crate::mesh::{Hinge, Hinges};
use crate::parallel::{self, Workers};
use crate::step::{Contact, Intersection, Motions};
use selvedge_core::Motion;
use selvedge_core::batch::{Mask, VertexRow};
use selvedge_core::elementary::Limits;
use selvedge_core::separation::hinge::is_wide_open;

/// The tasks of traversals for pairs at rest.
#[derive(Debug, Default)]
pub(super) struct RestTasks {
    faces_and_edges: Vec<BlockPair>,
    /// If there are loose edges or points.
    vertices_and_faces: Vec<BlockPair>,
    stack: Vec<BlockPair>,
}

impl MeshEngine {
    /// Replaces `found` by the intersections of a mesh at rest, or by some of them if any will do.
    pub(crate) fn intersections(
        &mut self,
        threads: &Workers,
        motions: &dyn Motions,
        wanted: Wanted,
        found: &mut Vec<Intersection>,
    ) {
        // Whether a state is free does not depend on the collision filter.
        let filter = self.filter.take();
        if filter.is_some() {
            self.broad_phase.set_filter(None);
        }
        threads.run(|| self.intersections_here(motions, wanted, found));
        if filter.is_some() {
            self.broad_phase.set_filter(filter.clone());
            self.filter = filter;
        }
    }

    fn intersections_here(&mut self, motions: &dyn Motions, wanted: Wanted, found: &mut Vec<Intersection>) {
        found.clear();
        self.pairs.stop.begin();
        let hierarchies = &mut self.broad_phase.hierarchies;
        hierarchies.fit_boxes(motions, &Fit::default());
        let hierarchies = &*hierarchies;
        set_rows(&mut self.rows, hierarchies);
        let hinges = self.hinges.get_or_insert_with(|| Hinges::new(hierarchies.topology()));
        let mut tests = self.rest_tasks.find(hierarchies, hinges);

        spaces_for_threads(&mut self.pairs.spaces);
        let bound = Bound::new(1.0);
        let search = RestSearch {
            step: StepInput {
                level: hierarchies.level(),
                numbers: Numbers::FacesAndEdges(hierarchies),
                rows: self.rows.slices(),
                question: Question {
                    // The sweeps stop this near to contact, and the exact verdict decides. The limits change no result.
                    limits: Limits::default(),
                    wanted,
                    keeps_filtered: false,
                    is_exact: true,
                },
                bound: &bound,
                stop: &self.pairs.stop,
            },
            hierarchies,
            hinges,
            tasks: &self.rest_tasks,
        };
        let mut candidates = 0;
        for part in [Part::FacesAndEdges, Part::Hinges, Part::LooseFeatures] {
            let shares = shares();
            self.pairs.workers.resize_with(shares, Default::default);
            let spaces = &self.pairs.spaces;
            parallel::for_each(&mut self.pairs.workers, |share, worker| {
                worker.findings.clear();
                worker.tests = 0;
                if !search.has_enough() {
                    worker.tests = search.share(part, [share, shares], &mut own_space(spaces), &mut worker.findings);
                }
            });
            for worker in &self.pairs.workers {
                if matches!(part, Part::FacesAndEdges) {
                    tests += worker.tests;
                    candidates += worker.findings.counts.candidates.total();
                }
                found.extend(worker.findings.contacts.iter().map(|contact| part.intersection(contact)));
            }
        }
        // Where a traversal ends early depends on which thread is first.
        if !search.has_enough() {
            self.broad_phase.hierarchies.observe_face_edge(tests, candidates as usize);
        }
        found.sort_unstable();
        found.dedup();
    }
}

impl RestTasks {
    /// Finds where to look. Returns the box tests for faces and edges.
    fn find(&mut self, hierarchies: &Hierarchies, hinges: &Hinges) -> u64 {
        self.vertices_and_faces.clear();
        if hinges.has_loose_features() {
            let [vertex_face, _] = Pairing::all_within(hierarchies);
            vertex_face.find_tasks(&mut self.stack, &mut self.vertices_and_faces);
        }
        self.faces_and_edges.clear();
        FacesAndEdges(hierarchies).find_tasks(&mut self.stack, &mut self.faces_and_edges)
    }
}

/// Returns one share of a list, of so many.
fn part_of<T>(list: &[T], [share, shares]: [usize; 2]) -> &[T] {
    let place = |share: usize| list.len() * share / shares;
    &list[place(share)..place(share + 1)]
}

/// The hinges of one thread.
#[derive(Debug, Default)]
pub(super) struct HingeChunk {
    hinges: Vec<Hinge>,
    /// For each hinge that may be coplanar, its index twice, and the rows of its vertices.
    indices: Vec<[u32; 2]>,
    rows: Vec<[u32; 4]>,
    masks: Vec<Mask>,
}

impl HingeChunk {
    fn clear(&mut self) {
        self.hinges.clear();
        self.indices.clear();
        self.rows.clear();
    }
}

/// The parts of a search, one after the other.
#[derive(Clone, Copy, Debug)]
enum Part {
    FacesAndEdges,
    Hinges,
    LooseFeatures,
}

impl Part {
    fn intersection(self, contact: &Contact<f64>) -> Intersection {
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
struct RestSearch<'a> {
    /// For edges and faces.
    step: StepInput<'a>,
    hierarchies: &'a Hierarchies,
    hinges: &'a Hinges,
    tasks: &'a RestTasks,
}

impl RestSearch<'_> {
    /// Returns whether the search is complete, or was cut short.
    fn has_enough(&self) -> bool {
        let is_answered = self.step.question.wanted == Wanted::Any && self.step.bound.is_lowered();
        is_answered || !self.step.stop.continues(0)
    }

    /// Searches one share of a part. Returns the number of box tests.
    fn share(&self, part: Part, [share, shares]: [usize; 2], space: &mut Space, findings: &mut Findings) -> u64 {
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
            numbers: Numbers::Placed(self.hierarchies),
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
            // Each gives two pairs of a kind.
            for (hinge, places) in hinges.by_ref().take(CHUNK / 2) {
                own.indices.push([own.hinges.len() as u32; 2]);
                own.hinges.push(hinge);
                own.rows.push(places);
            }
            // All four pairs have the same volume.
            drop_never_coplanar(&step, PairKind::EdgeEdge, 0, &mut own.indices, &mut own.rows, &mut own.masks);
            for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
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
            numbers: Numbers::Positions(self.hierarchies),
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

/// Takes the vertices and faces that no edge and face show.
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
        let must_be_looked_at = |&pair: &[u32; 2]| {
            let [vertex, face] = hierarchies.in_mesh(PairKind::VertexFace, pair);
            hinges.must_be_looked_at(vertex, hierarchies.topology().triangles()[face as usize])
        };
        self.tied.clear();
        self.tied.extend(pairs.iter().copied().filter(must_be_looked_at));
        self.chunk.take(self.step, PairKind::VertexFace, self.tied, self.findings)
    }
}

/// Rows that one thread makes at a time.
const ROWS: usize = 4096;

/// Makes a row for each vertex, at rest, and then one for each edge, from one end to the other.
fn set_rows(rows: &mut Rows, hierarchies: &Hierarchies) {
    let vertices = hierarchies.rows().double();
    let edges = hierarchies.edge_ends();
    let point = |position: u32| vertices[position as usize].motion().start;
    let row = |index: usize| match index.checked_sub(vertices.len()) {
        None => VertexRow::new(Motion::resting(point(index as u32))),
        Some(edge) => {
            let [from, to] = edges[edge].map(point);
            VertexRow::new(Motion::new(from, to))
        }
    };
    let all = rows.resize(vertices.len() + edges.len());
    let mut chunks: Vec<_> = all.chunks_mut(ROWS).collect();
    parallel::for_each(&mut chunks, |chunk, rows| {
        for (offset, own) in rows.iter_mut().enumerate() {
            *own = row(chunk * ROWS + offset);
        }
    });
    drop(chunks);
    rows.narrow();
}
