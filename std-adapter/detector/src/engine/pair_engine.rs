//! Decides the candidates of sources, share by share: the one loop behind detector and world.

use super::chunk::{Chunk, ChunkSink, StepInput};
use super::findings::Findings;
use super::hinge_chunk::HingeChunk;
use super::question::{Bound, Wanted};
use super::source::{Candidates, Source};
use super::stop::Stop;
use crate::broad_phase::{BlockPair, CHUNK, Scratch, Sink};
use crate::buffer::reserve_headroom;
use crate::clock::Clock;
use crate::parallel;
use crate::step::Contact;
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

#[derive(Debug)]
pub(crate) struct PairEngine {
    pub(super) workers: Vec<Worker>,
    pub(super) spaces: Vec<Mutex<Space>>,
    work: Vec<Work>,
    tasks: Vec<BlockPair>,
    stack: Vec<BlockPair>,
    pub(crate) stop: Stop,
}

/// The work of a source: tasks of a traversal, or pairs of a list.
#[derive(Clone, Copy, Debug)]
struct Work {
    /// The place of the source among the work of all sources.
    begin: usize,
    end: usize,
    /// The first of the source's tasks.
    first_task: usize,
    /// The number of box tests that found the tasks.
    tests: u64,
}

/// The buffers of a thread.
#[derive(Debug)]
pub(super) struct Space {
    pub(super) scratch: Scratch,
    pub(super) chunk: Chunk,
    /// Selected pairs of a list.
    pub(super) near: Vec<[u32; 2]>,
    pub(super) hinges: HingeChunk,
}

/// One share of the work.
#[derive(Debug, Default)]
pub(super) struct Worker {
    pub(super) findings: Findings,
    visits: Vec<Visit>,
    pub(super) tests: u64,
    pub(super) seconds: f64,
}

/// The result of a share for one source.
#[derive(Clone, Copy, Debug)]
struct Visit {
    source: usize,
    end: usize,
    tests: u64,
    candidates: u64,
}

/// Returns the time of a contact of the source with this number, or `None` if it is not a contact after all.
pub(crate) type Refine<'a> = dyn Fn(usize, &Contact<f64>) -> Option<f64> + Sync + 'a;

impl PairEngine {
    pub(crate) fn new() -> Self {
        Self {
            workers: Vec::new(),
            spaces: Vec::new(),
            work: Vec::new(),
            tasks: Vec::new(),
            stack: Vec::new(),
            stop: Stop::new(),
        }
    }

    /// Finds the work of these sources. [`run`](Self::run) must follow, with the same ones.
    pub(crate) fn prepare(&mut self, sources: &[Source<'_>]) {
        self.work.clear();
        self.tasks.clear();
        for source in sources {
            let begin = self.work.last().map_or(0, |work| work.end);
            let first_task = self.tasks.len();
            let (count, tests) = match &source.candidates {
                Candidates::Traversed(pairing) => {
                    let tests = pairing.find_tasks(&mut self.stack, &mut self.tasks);
                    (self.tasks.len() - first_task, tests)
                }
                Candidates::Listed { pairs, .. } => (pairs.len(), 0),
            };
            self.work.push(Work {
                begin,
                end: begin + count,
                first_task,
                tests,
            });
        }
        reserve_headroom(&mut self.tasks);
    }

    /// Estimates how many candidates the traversals of these prepared sources will find, from some of their tasks.
    pub(crate) fn estimated_candidates(&mut self, sources: &[Source<'_>]) -> u64 {
        let mut count = Count(0);
        let space = &mut *own_space(spaces_for_threads(&mut self.spaces));
        let step = self.tasks.len() / SAMPLES + 1;
        for (source, work) in sources.iter().zip(&self.work) {
            if let Candidates::Traversed(pairing) = &source.candidates {
                let own = &self.tasks[work.first_task..][..work.end - work.begin];
                for task in own.iter().step_by(step) {
                    pairing.visit(std::slice::from_ref(task), &mut space.scratch, &mut count);
                }
            }
        }
        count.0 * step as u64
    }

    /// Finds the contacts until a time, all or those that are `wanted`. `refine` replaces the time of each, or rejects it. If it
    /// may reject contacts of a source, the question of that source must want all of them, since a rejected contact hides no
    /// other.
    ///
    /// Returns false if it has ended early because one contact is enough. The place where it ends then depends on which thread is
    /// first.
    pub(crate) fn run(&mut self, sources: &[Source<'_>], wanted: Wanted, until: f64, refine: Option<&Refine<'_>>) -> bool {
        self.stop.begin();
        let total = self.work.last().map_or(0, |work| work.end);
        let shares = shares();
        self.workers.resize_with(shares, Worker::default);
        let run = Run {
            sources,
            work: &self.work,
            tasks: &self.tasks,
            stop: &self.stop,
            bound: &Bound::new(until),
            wanted,
            refine,
        };
        let spaces = spaces_for_threads(&mut self.spaces);
        parallel::for_each(&mut self.workers, |index, worker| {
            let begin = Clock::now();
            worker.clear();
            let place = |share: usize| total * share / shares;
            run.share(place(index)..place(index + 1), &mut own_space(spaces), worker);
            worker.seconds = begin.elapsed().as_secs_f64();
        });
        let is_whole = !run.has_enough();
        if self.stop.has_stored_too_much() && wanted != Wanted::Any {
            self.workers.clear();
        }
        is_whole
    }

    /// Ends a question that would need more memory than allowed, without contacts.
    pub(super) fn refuse_memory(&mut self) {
        self.stop.begin();
        self.stop.exceed_memory();
        self.workers.clear();
    }

    /// Returns the contacts of the last run with their sources, in order.
    pub(crate) fn contacts(&self) -> impl Iterator<Item = (usize, &[Contact<f64>])> {
        self.workers.iter().flat_map(|worker| {
            let mut begin = 0;
            worker.visits.iter().map(move |visit| {
                let own = &worker.findings.contacts[begin..visit.end];
                begin = visit.end;
                (visit.source, own)
            })
        })
    }

    /// Returns the box tests and candidates of the last run for each source, in one part or several.
    pub(crate) fn efforts(&self) -> impl Iterator<Item = (usize, u64, u64)> {
        let of_tasks = self.work.iter().enumerate();
        let of_tasks = of_tasks.map(|(source, work)| (source, work.tests, 0));
        let visits = self.workers.iter().flat_map(|worker| &worker.visits);
        of_tasks.chain(visits.map(|visit| (visit.source, visit.tests, visit.candidates)))
    }
}

impl Worker {
    fn clear(&mut self) {
        self.findings.clear();
        self.visits.clear();
        self.tests = 0;
    }
}

/// The input of all shares of a run.
struct Run<'a> {
    sources: &'a [Source<'a>],
    work: &'a [Work],
    tasks: &'a [BlockPair],
    stop: &'a Stop,
    bound: &'a Bound,
    wanted: Wanted,
    refine: Option<&'a Refine<'a>>,
}

impl Run<'_> {
    /// Returns whether one contact is found, and the caller wants no more.
    fn has_enough(&self) -> bool {
        self.wanted == Wanted::Any && self.bound.is_lowered()
    }

    fn share(&self, range: Range<usize>, space: &mut Space, worker: &mut Worker) {
        let mut begin = range.start;
        while begin < range.end && !self.has_enough() && self.stop.continues(0) {
            let number = self.work.partition_point(|work| work.end <= begin);
            let end = range.end.min(self.work[number].end);
            if !self.visit(number, begin..end, space, worker) {
                return;
            }
            begin = end;
        }
    }

    /// Decides a part of a source. Returns whether to continue.
    fn visit(&self, number: usize, range: Range<usize>, space: &mut Space, worker: &mut Worker) -> bool {
        let Worker { findings, visits, .. } = worker;
        let first = findings.contacts.len();
        let candidates_before = findings.counts.candidates.total();
        findings.first = first;
        space.chunk.clear();
        let tests = self.decide(number, range, space, findings);
        if let Some(refine) = self.refine {
            self.refine(refine, number, first, findings);
        }
        if self.wanted == Wanted::Earliest {
            findings.keep_earliest();
        }
        visits.push(Visit {
            source: number,
            end: findings.contacts.len(),
            tests: tests.unwrap_or_default(),
            candidates: findings.counts.candidates.total() - candidates_before,
        });
        worker.tests += tests.unwrap_or_default();
        tests.is_some()
    }

    /// Adds the contacts of a part of a source. Returns the number of box tests, or `None` if it ended early.
    fn decide(&self, number: usize, range: Range<usize>, space: &mut Space, findings: &mut Findings) -> Option<u64> {
        let source = &self.sources[number];
        let Work { begin, first_task, .. } = self.work[number];
        let step = StepInput::new(source, self.bound, self.stop);
        let own = range.start - begin..range.end - begin;
        let Space {
            scratch, chunk, near, ..
        } = space;
        let kind = source.kind();
        let tests = match &source.candidates {
            Candidates::Traversed(pairing) => {
                let tasks = &self.tasks[first_task..][own];
                let mut sink = ChunkSink {
                    chunk,
                    findings,
                    step: &step,
                    kind,
                };
                pairing.visit(tasks, scratch, &mut sink)?
            }
            Candidates::Listed { pairs, boxes, .. } => {
                for pairs in pairs[own].chunks(CHUNK) {
                    let selected = match boxes {
                        Some(boxes) => boxes.select_near(source.level, kind, pairs, near),
                        None => pairs,
                    };
                    chunk.take(&step, kind, selected, findings).then_some(())?;
                }
                0
            }
        };
        chunk.finish(&step, kind, findings).then_some(tests)
    }

    fn refine(&self, refine: &Refine<'_>, number: usize, first: usize, findings: &mut Findings) {
        let contacts = &mut findings.contacts;
        let mut kept = first;
        for read in first..contacts.len() {
            let contact = contacts[read];
            if let Some(time) = refine(number, &contact) {
                self.bound.lower(self.wanted, time);
                contacts[kept] = Contact { time, ..contact };
                kept += 1;
            }
        }
        contacts.truncate(kept);
    }
}

/// A sink that counts pairs.
struct Count(u64);

impl Sink for Count {
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool {
        self.0 += pairs.len() as u64;
        true
    }
}

/// The approximate number of tasks that an estimate samples.
const SAMPLES: usize = 32;

/// The number of shares for each thread. With many shares, a slow one does not keep the other threads waiting.
const SHARES: usize = 16;

/// Returns the number of shares of the work on the present threads.
pub(super) fn shares() -> usize {
    match parallel::threads() {
        1 => 1,
        threads => SHARES * threads,
    }
}

/// Makes a space for each thread where there is none yet.
pub(super) fn spaces_for_threads(spaces: &mut Vec<Mutex<Space>>) -> &[Mutex<Space>] {
    let new = || {
        Mutex::new(Space {
            scratch: Scratch::new(),
            chunk: Chunk::new(),
            near: Vec::with_capacity(CHUNK),
            hinges: HingeChunk::default(),
        })
    };
    if spaces.len() < parallel::threads() {
        spaces.resize_with(parallel::threads(), new);
    }
    spaces
}

/// Returns the space of the calling thread. No other thread uses it: a thread has one share at a time.
pub(super) fn own_space(spaces: &[Mutex<Space>]) -> MutexGuard<'_, Space> {
    let space = &spaces[parallel::own_index() % spaces.len()];
    // Buffers that a panic leaves are cleared before use.
    space.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns a contact in the format of the positions, with its time rounded down.
pub(crate) fn in_format_of_positions<S: selvedge_core::Scalar>(contact: &Contact<f64>) -> Contact<S> {
    let &Contact { kind, pair, time } = contact;
    Contact {
        kind,
        pair,
        time: selvedge_core::narrowing::rounded_down(time),
    }
}
