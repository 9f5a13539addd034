//! The stages joined for several meshes: candidates of many pairings, one after the other.

use super::chunk::{ChunkSink, Found, Numbers, StepInput};
use super::engine::{Space, own_space, shares, spaces_for_threads};
use super::question::{Bound, Question, Wanted};
use super::stop::Stop;
use crate::broad_phase::{BlockPair, Pairing, RowSlices};
use crate::buffer::settle;
use crate::parallel;
use crate::step::Contact;
use std::sync::Mutex;

/// Where candidates come from, and what is to be known of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source<'a> {
    pub(crate) pairing: Pairing<'a>,
    /// Of both meshes, that begin at these; `None` within a mesh, which has its own.
    pub(crate) rows: Option<(RowSlices<'a>, [u32; 2])>,
    /// Whose tests these are.
    pub(crate) question: Question,
}

/// Decides the candidates of sources.
#[derive(Debug)]
pub(crate) struct SourceEngine {
    workers: Vec<SourceWorker>,
    spaces: Vec<Mutex<Space>>,
    tasks: Vec<BlockPair>,
    /// For each source where its tasks end, and in how many tests they were found.
    task_ends: Vec<(usize, u64)>,
    stack: Vec<BlockPair>,
    pub(crate) stop: Stop,
}

/// One share of the work.
#[derive(Debug)]
struct SourceWorker {
    found: Found,
    visits: Vec<Visit>,
}

/// What a share has found of a source.
#[derive(Clone, Copy, Debug)]
struct Visit {
    source: usize,
    /// Where its contacts end.
    end: usize,
    tests: u64,
    candidates: u64,
}

impl SourceEngine {
    pub(crate) fn new() -> Self {
        Self {
            workers: Vec::new(),
            spaces: Vec::new(),
            tasks: Vec::new(),
            task_ends: Vec::new(),
            stack: Vec::new(),
            stop: Stop::new(),
        }
    }

    /// Finds the contacts of all sources, or those of them that are `wanted`. `refine` is asked about each, and says when it is, or that it is
    /// none; the question of a source of which it may say none is to want them all, as contacts that are none hide no other. Returns false if
    /// it has ended early, as one contact was enough: where depends on which thread was first.
    pub(crate) fn run(
        &mut self,
        sources: &[Source<'_>],
        wanted: Wanted,
        refine: &(dyn Fn(usize, &Contact<f64>) -> Option<f64> + Sync),
    ) -> bool {
        self.stop.begin();
        self.tasks.clear();
        self.task_ends.clear();
        for source in sources {
            let tests = source.pairing.find_tasks(&mut self.stack, &mut self.tasks);
            self.task_ends.push((self.tasks.len(), tests));
        }
        settle(&mut self.tasks);
        let shares = shares();
        self.workers.resize_with(shares, || SourceWorker {
            found: Found::nothing(),
            visits: Vec::new(),
        });
        let (tasks, task_ends, stop) = (&self.tasks[..], &self.task_ends[..], &self.stop);
        let spaces = spaces_for_threads(&mut self.spaces);
        let bound = Bound::new(1.0);
        let has_enough = || wanted == Wanted::Any && bound.is_lowered();
        parallel::for_each(&mut self.workers, |index, worker| {
            let SourceWorker { found, visits } = worker;
            found.clear();
            visits.clear();
            let Space { scratch, chunk, .. } = &mut *own_space(spaces);
            let place = |share: usize| tasks.len() * share / shares;
            let (mut begin, end) = (place(index), place(index + 1));
            while begin < end && !has_enough() && stop.goes_on(0) {
                let number = task_ends.partition_point(|&(of_source, _)| of_source <= begin);
                let own = begin..end.min(task_ends[number].0);
                begin = own.end;
                let source = &sources[number];
                let [hierarchies, _] = source.pairing.meshes;
                let (rows, numbers) = match source.rows {
                    None => (hierarchies.rows().slices(), Numbers::Positions(hierarchies)),
                    Some((rows, first_rows)) => (rows, Numbers::Between(source.pairing, first_rows)),
                };
                let step = StepInput {
                    level: hierarchies.level(),
                    numbers,
                    rows,
                    question: source.question,
                    bound: &bound,
                    stop,
                };
                let kind = source.pairing.kind;
                let (first, before) = (found.contacts.len(), found.tally.candidates.total());
                chunk.clear();
                let mut sink = ChunkSink {
                    chunk,
                    found,
                    step: &step,
                    kind,
                };
                let tests = source.pairing.visit(&tasks[own], scratch, &mut sink);
                if tests.is_some() {
                    chunk.finish(&step, kind, found);
                }
                let mut kept = first;
                for read in first..found.contacts.len() {
                    let contact = found.contacts[read];
                    if let Some(time) = refine(number, &contact) {
                        bound.lower(wanted, time);
                        found.contacts[kept] = Contact { time, ..contact };
                        kept += 1;
                    }
                }
                found.contacts.truncate(kept);
                visits.push(Visit {
                    source: number,
                    end: kept,
                    tests: tests.unwrap_or_default(),
                    candidates: found.tally.candidates.total() - before,
                });
                if tests.is_none() {
                    return;
                }
            }
        });
        !has_enough()
    }

    /// The contacts of the last run with their sources, in order.
    pub(crate) fn contacts(&self) -> impl Iterator<Item = (usize, &[Contact<f64>])> {
        self.workers.iter().flat_map(|worker| {
            let mut begin = 0;
            worker.visits.iter().map(move |visit| {
                let own = &worker.found.contacts[begin..visit.end];
                begin = visit.end;
                (visit.source, own)
            })
        })
    }

    /// Of the last run, for each source in ascending order the tests and candidates, in one part or several.
    pub(crate) fn efforts(&self) -> impl Iterator<Item = (usize, u64, u64)> {
        let of_tasks = self.task_ends.iter().enumerate();
        let of_tasks = of_tasks.map(|(source, &(_, tests))| (source, tests, 0));
        let visits = self.workers.iter().flat_map(|worker| &worker.visits);
        of_tasks.chain(visits.map(|visit| (visit.source, visit.tests, visit.candidates)))
    }
}
