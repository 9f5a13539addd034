//! The intersections of a mesh at rest.

use super::chunk::StepInput;
use super::mesh_engine::MeshEngine;
use super::numbering::Numbering;
use super::pair_engine::{own_space, shares, spaces_for_threads};
use super::question::{Bound, Question, Wanted};
use super::rest::{Part, RestSearch};
use crate::broad_phase::{BoxFit, Hierarchies, Rows};
use crate::mesh::Hinges;
use crate::parallel::{self, Workers};
use crate::step::{Intersection, Motions};
use selvedge_core::Motion;
use selvedge_core::batch::VertexRow;
use selvedge_core::elementary::Limits;

impl MeshEngine {
    /// Replaces `found` by the intersections of a mesh at rest, or by some of them if the caller needs only one.
    pub(crate) fn intersections(
        &mut self,
        threads: &Workers,
        motions: &dyn Motions,
        wanted: Wanted,
        found: &mut Vec<Intersection>,
    ) {
        // The collision filter does not decide whether a state is free.
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
        hierarchies.fit_boxes(motions, &BoxFit::default());
        let hierarchies = &*hierarchies;
        set_rows(&mut self.rows, hierarchies);
        let hinges = self.hinges.get_or_insert_with(|| Hinges::new(hierarchies.topology()));
        let mut tests = self.rest_tasks.find(hierarchies, hinges);

        spaces_for_threads(&mut self.pairs.spaces);
        let bound = Bound::new(1.0);
        let search = RestSearch {
            step: StepInput {
                level: hierarchies.level(),
                numbering: Numbering::FacesAndEdges(hierarchies),
                rows: self.rows.slices(),
                question: Question {
                    // The sweeps stop at this distance, and the exact verdict decides. The limits change no result.
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
        // The place where a traversal ends early depends on which thread is first.
        if !search.has_enough() {
            self.broad_phase.hierarchies.observe_face_edge(tests, candidates as usize);
        }
        found.sort_unstable();
        found.dedup();
    }
}

/// The number of rows that one thread makes at a time.
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
        for (offset, written) in rows.iter_mut().enumerate() {
            *written = row(chunk * ROWS + offset);
        }
    });
    drop(chunks);
    rows.narrow();
}
