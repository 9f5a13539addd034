//! The stages joined, on the threads of whoever calls.

use super::chunk::{Chunk, ChunkSink, Found, Numbers, StepInput, Tally};
use super::given::PrimitiveBoxes;
use super::question::{Bound, Question, Wanted};
use super::rest::HingeChunk;
use super::stop::Stop;
use crate::PairKind;
use crate::broad_phase::{CHUNK, Fit, MovingBroadPhase, Rows, Scratch};
use crate::buffer::settle;
use crate::clock::Clock;
use crate::coherent::{ENORMOUS, Followed};
use crate::mesh::{Hinges, Topology};
use crate::pair_counts::PairCounts;
use crate::parallel::{self, Workers};
use crate::simd::Level;
use crate::step::{CollisionFilter, Contact, Motions, StepError, check_pair};
use selvedge_core::Scalar;
use selvedge_core::elementary::Limits;
use selvedge_core::narrowing::rounded_down;
use std::cmp::Ordering;
use std::sync::atomic::{self, AtomicBool};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A part of the step from its start, in which contacts are looked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Probe {
    /// Its end, in (0, 1].
    until: f64,
}

impl Probe {
    /// The whole step.
    pub(crate) const WHOLE: Self = Self { until: 1.0 };
}

/// Where the earliest contact is looked for: few pairs come near each other in a short part of the step.
///
/// Measured: on cloth-ball, with a contact at 7e-6 of the step, a probe of 1/128 to 1/16 takes 36 ms and one of 1/4 42, where
/// the whole step takes three times as long; on cloth-funnel, with a contact at 0.045, the traversal is nearly all of the time and
/// takes as long for any part, so that a second probe would double it.
const PROBES: [Probe; 2] = [Probe { until: 1.0 / 16.0 }, Probe::WHOLE];

/// What a step counted, and its seconds. With several threads the seconds of stages are sums over them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepStatistics {
    /// The caller's own pairs, if it has brought some.
    pub given: PairCounts,
    /// Pairs that moving boxes leave, of a caller's pairs as well.
    pub candidates: PairCounts,
    /// Those that may become coplanar.
    pub filtered: PairCounts,
    /// Contacts.
    pub contacts: PairCounts,
    /// Pairs that are followed, in the mode for coherent motion.
    pub followed: u64,
    /// Seconds are counted with the feature `timing`; without it they are zero. Boxes, refit or build, traversal; for a caller's pairs, boxes and their comparison.
    pub broad_phase_seconds: f64,
    /// The certified non-coplanarity filter.
    pub filter_seconds: f64,
    /// The time of impact.
    pub elementary_seconds: f64,
    /// The whole step by the clock on the wall.
    pub seconds: f64,
}

/// See the [module](super).
#[derive(Debug)]
pub(crate) struct Engine {
    pub(crate) broad_phase: MovingBroadPhase,
    /// In the mode for coherent motion.
    followed: Option<Box<Followed>>,
    /// Which vertices move, if not all.
    moving: Option<Vec<bool>>,
    /// Which pairs are looked at, if not all.
    pub(super) filter: Option<Arc<CollisionFilter>>,
    /// One for each share of the work.
    pub(super) workers: Vec<Worker>,
    /// One for each thread.
    pub(super) spaces: Vec<Mutex<Space>>,
    /// The motion of each vertex as the mesh numbers them, for pairs of the caller's.
    pub(super) rows: Rows,
    boxes: PrimitiveBoxes,
    /// Once a mesh at rest was asked about.
    pub(super) hinges: Option<Hinges>,
    pub(crate) stop: Stop,
    statistics: StepStatistics,
}

/// What a thread works in.
#[derive(Debug)]
pub(super) struct Space {
    pub(super) scratch: Scratch,
    pub(super) chunk: Chunk,
    /// A caller's pairs that boxes leave.
    pub(super) near: Vec<[u32; 2]>,
    pub(super) hinges: HingeChunk,
}

/// One share of the work.
#[derive(Debug)]
pub(super) struct Worker {
    pub(super) found: Found,
    kind: PairKind,
    pub(super) tests: u64,
    seconds: f64,
}

impl Worker {
    pub(super) fn new() -> Self {
        Self {
            found: Found::nothing(),
            kind: PairKind::VertexFace,
            tests: 0,
            seconds: 0.0,
        }
    }
}

impl Engine {
    pub(crate) fn new(topology: Arc<Topology>) -> Self {
        Self {
            broad_phase: MovingBroadPhase::new(topology),
            followed: None,
            moving: None,
            filter: None,
            workers: Vec::new(),
            spaces: Vec::new(),
            rows: Rows::default(),
            boxes: PrimitiveBoxes::default(),
            hinges: None,
            stop: Stop::new(),
            statistics: StepStatistics::default(),
        }
    }

    pub(crate) const fn set_level(&mut self, level: Level) {
        self.broad_phase.set_level(level);
    }

    pub(crate) fn set_moving(&mut self, moving: Option<Vec<bool>>) {
        self.moving.clone_from(&moving);
        self.broad_phase.hierarchies.set_moving(moving);
        if self.is_coherent() {
            self.set_coherent(true);
        }
    }

    /// Whether steps go on from one another. Forgets those before.
    pub(crate) fn set_coherent(&mut self, coherent: bool) {
        self.followed = coherent.then(|| Box::new(Followed::new(self.moving.clone(), self.filter.clone())));
    }

    /// Only pairs that the filter allows are found from here on.
    pub(crate) fn set_filter(&mut self, filter: CollisionFilter) {
        self.filter = (!filter.excludes_nothing()).then(|| Arc::new(filter));
        self.broad_phase.set_filter(self.filter.clone());
        if self.is_coherent() {
            self.set_coherent(true);
        }
    }

    pub(crate) fn near_statistics(&self) -> crate::coherent::NearStatistics {
        self.followed.as_ref().map_or_else(Default::default, |f| f.statistics())
    }

    pub(crate) const fn is_coherent(&self) -> bool {
        self.followed.is_some()
    }

    pub(crate) fn topology(&self) -> &Topology {
        self.broad_phase.hierarchies.topology()
    }

    pub(crate) const fn statistics(&self) -> &StepStatistics {
        &self.statistics
    }

    /// Finds the contacts of a step, or of a part of it.
    pub(crate) fn run(&mut self, threads: &Workers, motions: &dyn Motions, question: &Question, probe: Probe) {
        threads.run(|| self.run_here(motions, question, probe));
    }

    fn run_here(&mut self, motions: &dyn Motions, question: &Question, probe: Probe) {
        self.stop.begin();
        let Limits { separation, tolerance } = question.limits;
        // Pairs within the tolerance are contacts too; twice of it are so with all rounding.
        let distance = separation + 2.0 * tolerance;
        if distance < ENORMOUS && self.is_coherent() {
            self.run_followed(motions, question, distance);
            return;
        }
        let begin = Clock::now();
        let fit = Fit {
            separation: question.limits.separation,
            until: probe.until,
            ..Fit::default()
        };
        self.broad_phase.hierarchies.update(motions, &fit);
        self.broad_phase.hierarchies.narrow();
        let update = begin.elapsed().as_secs_f64();

        let hierarchies = &self.broad_phase.hierarchies;
        self.workers.resize_with(hierarchies.shares(), Worker::new);
        let spaces = spaces_for_threads(&mut self.spaces);
        let bound = Bound::new(probe.until);
        let step = StepInput {
            level: hierarchies.level(),
            numbers: Numbers::Positions(hierarchies),
            rows: hierarchies.rows().slices(),
            question: *question,
            bound: &bound,
            stop: &self.stop,
        };
        parallel::for_each(&mut self.workers, |index, worker| {
            let begin = Clock::now();
            let share = hierarchies.share(index);
            worker.kind = share.kind;
            worker.found.clear();
            worker.tests = 0;
            let has_enough = question.wanted == Wanted::Any && bound.is_lowered();
            if !has_enough && step.stop.goes_on(0) {
                let Space { scratch, chunk, .. } = &mut *own_space(spaces);
                chunk.clear();
                let mut sink = ChunkSink {
                    chunk,
                    found: &mut worker.found,
                    step: &step,
                    kind: share.kind,
                };
                let tests = hierarchies.visit(share, scratch, &mut sink);
                if let Some(tests) = tests {
                    worker.tests = tests;
                    chunk.finish(&step, share.kind, &mut worker.found);
                }
            }
            worker.seconds = begin.elapsed().as_secs_f64();
        });
        self.count(begin, update);
        let tests = self.workers.iter().map(|worker| worker.tests).sum();
        let candidates = self.statistics.candidates.total() as usize;
        // Where a traversal ends early depends on which thread is first.
        let is_whole = question.wanted != Wanted::Any || !bound.is_lowered();
        if is_whole && !self.stop.has_stopped() {
            self.broad_phase.hierarchies.observe(tests, candidates);
        }
    }

    /// Finds the contacts of a step that goes on from the one before.
    fn run_followed(&mut self, motions: &dyn Motions, question: &Question, distance: f64) {
        let Some(followed) = &mut self.followed else {
            return;
        };
        let begin = Clock::now();
        let hierarchies = &self.broad_phase.hierarchies;
        let topology = hierarchies.topology();
        followed.find(topology, motions, distance, question.limits.separation);
        let vertices = [PairKind::VertexFace, PairKind::EdgeEdge].into_iter().flat_map(|kind| {
            let pairs = followed.open[kind as usize].iter();
            pairs.flat_map(move |&pair| topology.vertices_of(kind, pair))
        });
        self.rows.set_some(motions, vertices, followed.is_single);
        let update = begin.elapsed().as_secs_f64();
        let bound = Bound::new(1.0);
        let step = StepInput::of_mesh(hierarchies, self.rows.slices(), question, &bound, &self.stop);
        let pairs = followed.open.each_ref().map(Vec::as_slice);
        decide(&mut self.workers, &mut self.spaces, &step, pairs, |_, pairs, _| Some(pairs));
        let count = followed.count() as u64;
        self.count(begin, update);
        self.statistics.followed = count;
    }

    /// Finds the contacts of pairs that the caller has: VF, EE.
    pub(crate) fn run_on(
        &mut self,
        threads: &Workers,
        motions: &dyn Motions,
        question: &Question,
        pairs: [&[[u32; 2]]; 2],
    ) -> Result<(), StepError> {
        threads.run(|| self.run_here_on(motions, question, pairs))
    }

    fn run_here_on(&mut self, motions: &dyn Motions, question: &Question, pairs: [&[[u32; 2]]; 2]) -> Result<(), StepError> {
        self.stop.begin();
        let begin = Clock::now();
        let hierarchies = &self.broad_phase.hierarchies;
        let topology = hierarchies.topology();
        self.rows.set(motions);
        self.rows.narrow();
        self.boxes.fit(topology, motions, question.limits.separation);
        let update = begin.elapsed().as_secs_f64();

        let bound = Bound::new(1.0);
        let step = StepInput::of_mesh(hierarchies, self.rows.slices(), question, &bound, &self.stop);
        let boxes = &self.boxes;
        let are_of_mesh = decide(&mut self.workers, &mut self.spaces, &step, pairs, |kind, pairs, near| {
            boxes.keep_near(step.level, kind, pairs, near)?;
            Some(near)
        });
        if are_of_mesh.is_none() {
            check_pairs(topology, pairs)?;
        }
        self.count(begin, update);
        self.statistics.given = PairCounts {
            vertex_face: pairs[0].len() as u64,
            edge_edge: pairs[1].len() as u64,
        };
        Ok(())
    }

    /// The pairs that moving boxes leave.
    pub(crate) fn candidates(
        &mut self,
        threads: &Workers,
        motions: &dyn Motions,
        separation: f64,
        are_swept: bool,
        vertex_face: &mut Vec<[u32; 2]>,
        edge_edge: &mut Vec<[u32; 2]>,
    ) {
        let begin = Clock::now();
        self.stop.begin();
        let stop = &self.stop;
        let fit = Fit {
            separation,
            is_swept: are_swept,
            ..Fit::default()
        };
        let broad_phase = &mut self.broad_phase;
        threads.run(|| {
            broad_phase.hierarchies.update(motions, &fit);
            broad_phase.candidates_until(&|pairs| stop.goes_on(pairs), vertex_face, edge_edge);
        });
        let seconds = begin.elapsed().as_secs_f64();
        self.statistics = StepStatistics {
            candidates: PairCounts {
                vertex_face: vertex_face.len() as u64,
                edge_edge: edge_edge.len() as u64,
            },
            broad_phase_seconds: seconds,
            seconds,
            ..StepStatistics::default()
        };
    }

    /// Replaces both by the pairs that were kept for the caller in the last run.
    pub(crate) fn collect_kept(&mut self, vertex_face: &mut Vec<[u32; 2]>, edge_edge: &mut Vec<[u32; 2]>) {
        vertex_face.clear();
        edge_edge.clear();
        for worker in &mut self.workers {
            match worker.kind {
                PairKind::VertexFace => vertex_face.extend_from_slice(&worker.found.kept),
                PairKind::EdgeEdge => edge_edge.extend_from_slice(&worker.found.kept),
            }
            settle(&mut worker.found.kept);
        }
        settle(vertex_face);
        settle(edge_edge);
    }

    /// Replaces `contacts` by those of the last run.
    pub(crate) fn collect_contacts<S: Scalar>(&mut self, contacts: &mut Vec<Contact<S>>) {
        let begin = Clock::now();
        contacts.clear();
        for worker in &mut self.workers {
            let found = &worker.found.contacts;
            contacts.extend(found.iter().map(in_format_of_positions));
            settle(&mut worker.found.contacts);
        }
        settle(contacts);
        self.statistics.seconds += begin.elapsed().as_secs_f64();
    }

    /// The earliest contact of a step: of its beginning first, then of all of it.
    pub(crate) fn earliest(&mut self, threads: &Workers, motions: &dyn Motions, question: &Question) -> Option<Contact<f64>> {
        let begin = Clock::now();
        self.stop.begin();
        // Of pairs that are followed few are left to look at, in any part of the step.
        let probes = if self.is_coherent() { &PROBES[1..] } else { &PROBES };
        let earliest = probes.iter().find_map(|&probe| {
            if self.stop.result().is_ok() {
                self.run(threads, motions, question, probe);
            }
            self.earliest_found()
        });
        self.statistics.seconds = begin.elapsed().as_secs_f64();
        earliest
    }

    /// The earliest contact of the last run.
    fn earliest_found(&self) -> Option<Contact<f64>> {
        let contacts = self.workers.iter().flat_map(|worker| &worker.found.contacts);
        let earliest = contacts.min_by(|a, b| {
            let by_time = a.time.partial_cmp(&b.time).unwrap_or(Ordering::Equal);
            by_time.then((a.kind, a.pair).cmp(&(b.kind, b.pair)))
        });
        earliest.copied()
    }

    fn count(&mut self, begin: Clock, update: f64) {
        let mut tally = StepStatistics {
            broad_phase_seconds: update,
            ..StepStatistics::default()
        };
        for worker in &self.workers {
            let Tally {
                candidates,
                filtered,
                filter_time,
                elementary_time,
            } = worker.found.tally;
            tally.candidates += candidates;
            tally.filtered += filtered;
            let contacts = worker.found.contacts.len() as u64;
            match worker.kind {
                PairKind::VertexFace => tally.contacts.vertex_face += contacts,
                PairKind::EdgeEdge => tally.contacts.edge_edge += contacts,
            }
            let (filter, elementary) = (filter_time.as_secs_f64(), elementary_time.as_secs_f64());
            tally.filter_seconds += filter;
            tally.elementary_seconds += elementary;
            tally.broad_phase_seconds += worker.seconds - filter - elementary;
        }
        tally.seconds = begin.elapsed().as_secs_f64();
        self.statistics = tally;
    }
}

/// Decides pairs as the mesh numbers them, VF and EE, chunk by chunk: those of each that `pick` leaves, for which it has some room; `None`
/// if it has no answer for some.
fn decide(
    workers: &mut Vec<Worker>,
    spaces: &mut Vec<Mutex<Space>>,
    step: &StepInput<'_>,
    pairs: [&[[u32; 2]]; 2],
    pick: impl for<'a> Fn(PairKind, &'a [[u32; 2]], &'a mut Vec<[u32; 2]>) -> Option<&'a [[u32; 2]]> + Sync,
) -> Option<()> {
    let shares = shares();
    workers.resize_with(2 * shares, Worker::new);
    let spaces = spaces_for_threads(spaces);
    let is_strange = AtomicBool::new(false);
    parallel::for_each(workers, |index, worker| {
        let begin = Clock::now();
        let (kind, index) = match index.checked_sub(shares) {
            None => (PairKind::VertexFace, index),
            Some(index) => (PairKind::EdgeEdge, index),
        };
        let pairs = pairs[kind as usize];
        let place = |index: usize| pairs.len() * index / shares;
        worker.kind = kind;
        worker.found.clear();
        let Space { chunk, near, .. } = &mut *own_space(spaces);
        chunk.clear();
        for pairs in pairs[place(index)..place(index + 1)].chunks(CHUNK) {
            let Some(picked) = pick(kind, pairs, near) else {
                is_strange.store(true, atomic::Ordering::Relaxed);
                return;
            };
            if !chunk.take(step, kind, picked, &mut worker.found) {
                return;
            }
        }
        chunk.finish(step, kind, &mut worker.found);
        worker.seconds = begin.elapsed().as_secs_f64();
    });
    (!is_strange.into_inner()).then_some(())
}

/// Into how many parts work of one kind is split on the threads there are.
pub(super) fn shares() -> usize {
    match parallel::threads() {
        1 => 1,
        threads => 8 * threads,
    }
}

/// A contact with its time rounded down, so that it is no later.
pub(crate) fn in_format_of_positions<S: Scalar>(contact: &Contact<f64>) -> Contact<S> {
    let &Contact { kind, pair, time } = contact;
    Contact {
        kind,
        pair,
        time: rounded_down(time),
    }
}

/// Makes a space for each thread, if they are not there.
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

/// The space of the thread that calls. Nobody else asks for it: a thread has one share at a time.
pub(super) fn own_space(spaces: &[Mutex<Space>]) -> MutexGuard<'_, Space> {
    let space = &spaces[parallel::own_index() % spaces.len()];
    // What a panic has left behind is cleared before use.
    space.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Every pair must be of the mesh.
fn check_pairs(topology: &Topology, [vertex_face, edge_edge]: [&[[u32; 2]]; 2]) -> Result<(), StepError> {
    let check = |kind, pairs: &[[u32; 2]]| pairs.iter().try_for_each(|&pair| check_pair(topology, kind, pair));
    check(PairKind::VertexFace, vertex_face)?;
    check(PairKind::EdgeEdge, edge_edge)
}
