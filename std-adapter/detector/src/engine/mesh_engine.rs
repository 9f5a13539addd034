//! The stages joined for one mesh.

use super::findings::{StageCounts, by_time_and_pair};
use super::listed_pairs::PrimitiveBoxes;
use super::pair_engine::{PairEngine, in_format_of_positions};
use super::question::Question;
use super::rest::RestTasks;
use super::source::Source;
use super::statistics::StepStatistics;
use crate::broad_phase::{BoxFit, MovingBroadPhase, Rows};
use crate::buffer::reserve_headroom;
use crate::clock::Clock;
use crate::coherent::{ENORMOUS, Followed, NearStatistics};
use crate::mesh::{Hinges, Topology};
use crate::pair_counts::PairCounts;
use crate::parallel::Workers;
use crate::simd::Level;
use crate::step::{CollisionFilter, Contact, Motions, StepError, check_pair};
use selvedge_core::elementary::Limits;
use selvedge_core::{PairKind, Scalar};
use std::sync::Arc;

/// The first part of a step. The earliest contact is looked for there first if a whole step has many candidates.
///
/// A shorter part finds about as few candidates; a longer one finds more of them.
const EARLY: f64 = 1.0 / 16.0;

/// The number of candidates for each edge from which on a search of the [early part](EARLY) alone may pay. A traversal takes
/// about six box tests for each edge in any part of the step. A candidate takes about one test in the stages after it. With this
/// number the traversal is a small part of the whole step, and one that finds nothing is no great loss.
const MANY_CANDIDATES: u64 = 8;

/// Finds the contacts of one mesh: a world of one mesh, whose pairs can also be listed or followed.
#[derive(Debug)]
pub(crate) struct MeshEngine {
    pub(crate) broad_phase: MovingBroadPhase,
    pub(crate) pairs: PairEngine,
    /// The followed pairs, in the mode for coherent motion.
    followed: Option<Box<Followed>>,
    /// For each vertex, whether it moves; `None` if all do.
    moving: Option<Vec<bool>>,
    /// The pairs that are excluded.
    pub(super) filter: Option<Arc<CollisionFilter>>,
    /// The motion of each vertex as the mesh numbers them, for listed pairs.
    pub(super) rows: Rows,
    boxes: PrimitiveBoxes,
    /// The hinges, made when a mesh at rest is first searched.
    pub(super) hinges: Option<Hinges>,
    pub(super) rest_tasks: RestTasks,
    statistics: StepStatistics,
}

impl MeshEngine {
    pub(crate) fn new(topology: Arc<Topology>) -> Self {
        Self {
            broad_phase: MovingBroadPhase::new(topology),
            pairs: PairEngine::new(),
            followed: None,
            moving: None,
            filter: None,
            rows: Rows::default(),
            boxes: PrimitiveBoxes::default(),
            hinges: None,
            rest_tasks: RestTasks::default(),
            statistics: StepStatistics::default(),
        }
    }

    pub(crate) const fn set_level(&mut self, level: Level) {
        self.broad_phase.set_level(level);
    }

    pub(crate) fn set_moving(&mut self, moving: Option<Vec<bool>>) {
        self.moving.clone_from(&moving);
        self.broad_phase.hierarchies.set_moving(moving);
        self.set_coherent(self.followed.is_some());
    }

    /// Sets whether each step starts where the last ended. Forgets earlier steps.
    pub(crate) fn set_coherent(&mut self, coherent: bool) {
        self.followed = coherent.then(|| Box::new(Followed::new(self.moving.clone(), self.filter.clone())));
    }

    /// Excludes pairs from here on.
    pub(crate) fn set_filter(&mut self, filter: CollisionFilter) {
        self.filter = (!filter.excludes_nothing()).then(|| Arc::new(filter));
        self.broad_phase.set_filter(self.filter.clone());
        self.set_coherent(self.followed.is_some());
    }

    pub(crate) fn near_statistics(&self) -> NearStatistics {
        self.followed.as_ref().map_or_else(Default::default, |f| f.statistics())
    }

    pub(crate) fn topology(&self) -> &Topology {
        self.broad_phase.hierarchies.topology()
    }

    pub(crate) const fn statistics(&self) -> &StepStatistics {
        &self.statistics
    }

    /// Finds the contacts of a step.
    pub(crate) fn run(&mut self, threads: &Workers, motions: &dyn Motions, question: &Question) {
        threads.run(|| {
            if !self.run_followed(motions, question) {
                self.run_until(1.0, motions, question);
            }
        });
    }

    /// Finds the contacts of a step until a time.
    fn run_until(&mut self, until: f64, motions: &dyn Motions, question: &Question) {
        let begin = Clock::now();
        self.fit(until, motions, question);
        let sources = Source::within(&self.broad_phase.hierarchies, *question);
        self.pairs.prepare(&sources);
        let update = begin.elapsed().as_secs_f64();
        let is_whole = self.pairs.run(&sources, question.wanted, until, None);
        self.finish(begin, update, is_whole);
    }

    fn fit(&mut self, until: f64, motions: &dyn Motions, question: &Question) {
        let fit = BoxFit {
            separation: question.limits.separation,
            until,
            ..BoxFit::default()
        };
        self.broad_phase.hierarchies.fit_boxes(motions, &fit);
        self.broad_phase.hierarchies.narrow();
    }

    /// Counts the findings, and their cost unless the run ended early.
    fn finish(&mut self, begin: Clock, update: f64, is_whole: bool) {
        self.count(begin, update);
        if is_whole && !self.pairs.stop.has_stopped() {
            let tests = self.pairs.efforts().map(|(_, tests, _)| tests).sum();
            let candidates = self.statistics.candidates.total() as usize;
            self.broad_phase.hierarchies.observe(tests, candidates);
        }
    }

    /// Finds the contacts of a step among the pairs that are followed. Returns false if no pairs are.
    fn run_followed(&mut self, motions: &dyn Motions, question: &Question) -> bool {
        let Limits { separation, tolerance } = question.limits;
        // Pairs within the tolerance are contacts too. Twice the tolerance holds all rounding.
        let distance = separation + 2.0 * tolerance;
        let Some(followed) = self.followed.as_mut().filter(|_| distance < ENORMOUS) else {
            return false;
        };
        let begin = Clock::now();
        let hierarchies = &self.broad_phase.hierarchies;
        let topology = hierarchies.topology();
        let memory_limit = self.pairs.stop.memory_limit();
        if !followed.find(topology, motions, [distance, separation], memory_limit) {
            self.pairs.refuse_memory();
            self.statistics = StepStatistics::default();
            return true;
        }
        let vertices = PairKind::ALL.into_iter().flat_map(|kind| {
            let pairs = followed.open[kind as usize].iter();
            pairs.flat_map(move |&pair| topology.vertices_of(kind, pair))
        });
        self.rows.set_some(motions, vertices, followed.is_single);
        let update = begin.elapsed().as_secs_f64();
        let pairs = followed.open.each_ref().map(Vec::as_slice);
        let sources = Source::listed(hierarchies, self.rows.slices(), *question, pairs, None);
        self.pairs.prepare(&sources);
        self.pairs.run(&sources, question.wanted, 1.0, None);
        let count = followed.count() as u64;
        self.count(begin, update);
        self.statistics.followed = count;
        true
    }

    /// Finds the contacts of listed pairs: VF, EE.
    pub(crate) fn run_on(
        &mut self,
        threads: &Workers,
        motions: &dyn Motions,
        question: &Question,
        pairs: [&[[u32; 2]]; 2],
    ) -> Result<(), StepError> {
        let topology = self.broad_phase.hierarchies.topology();
        for (kind, pairs) in PairKind::ALL.into_iter().zip(pairs) {
            pairs.iter().try_for_each(|&pair| check_pair(topology, kind, pair))?;
        }
        threads.run(|| {
            let begin = Clock::now();
            let hierarchies = &self.broad_phase.hierarchies;
            self.rows.set(motions);
            self.rows.narrow();
            self.boxes.fit(hierarchies.topology(), motions, question.limits.separation);
            let update = begin.elapsed().as_secs_f64();
            let sources = Source::listed(hierarchies, self.rows.slices(), *question, pairs, Some(&self.boxes));
            self.pairs.prepare(&sources);
            self.pairs.run(&sources, question.wanted, 1.0, None);
            self.count(begin, update);
        });
        let [vertex_face, edge_edge] = pairs.map(|pairs| pairs.len() as u64);
        self.statistics.given = PairCounts { vertex_face, edge_edge };
        Ok(())
    }

    /// Finds the pairs that boxes leave.
    pub(crate) fn candidates(
        &mut self,
        threads: &Workers,
        motions: &dyn Motions,
        separation: f64,
        is_swept: bool,
        [vertex_face, edge_edge]: [&mut Vec<[u32; 2]>; 2],
    ) {
        let begin = Clock::now();
        self.pairs.stop.begin();
        let stop = &self.pairs.stop;
        let continues = |pairs: usize| {
            stop.stores(pairs * size_of::<[u32; 2]>());
            stop.continues(pairs)
        };
        let fit = BoxFit {
            separation,
            is_swept,
            ..BoxFit::default()
        };
        let broad_phase = &mut self.broad_phase;
        threads.run(|| {
            broad_phase.fit_boxes(motions, &fit);
            broad_phase.candidates_until(&continues, vertex_face, edge_edge);
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

    /// Replaces both lists by the pairs that were kept for the caller in the last run.
    pub(crate) fn collect_kept(&mut self, mut lists: [&mut Vec<[u32; 2]>; 2]) {
        for (kind, list) in lists.iter_mut().enumerate() {
            list.clear();
            for worker in &mut self.pairs.workers {
                let kept = &mut worker.findings.kept[kind];
                list.extend_from_slice(kept);
                reserve_headroom(kept);
            }
            reserve_headroom(list);
        }
    }

    /// Replaces `contacts` by those of the last run.
    pub(crate) fn collect_contacts<S: Scalar>(&mut self, contacts: &mut Vec<Contact<S>>) {
        let begin = Clock::now();
        contacts.clear();
        for worker in &mut self.pairs.workers {
            let found = &mut worker.findings.contacts;
            contacts.extend(found.iter().map(in_format_of_positions));
            reserve_headroom(found);
        }
        reserve_headroom(contacts);
        self.statistics.seconds += begin.elapsed().as_secs_f64();
    }

    pub(crate) fn earliest(&mut self, threads: &Workers, motions: &dyn Motions, question: &Question) -> Option<Contact<f64>> {
        let begin = Clock::now();
        threads.run(|| {
            if !self.run_followed(motions, question) {
                self.run_for_earliest(motions, question);
            }
        });
        self.statistics.seconds = begin.elapsed().as_secs_f64();
        self.earliest_found()
    }

    /// Looks at the whole step, or at its [early part](EARLY) first if that has less than half of the candidates. If many boxes
    /// overlap from the start, as about one point, the early part would take as long as the whole step.
    fn run_for_earliest(&mut self, motions: &dyn Motions, question: &Question) {
        let begin = Clock::now();
        self.fit(1.0, motions, question);
        let sources = Source::within(&self.broad_phase.hierarchies, *question);
        self.pairs.prepare(&sources);
        let many = MANY_CANDIDATES * self.topology().edges().len() as u64;
        let whole = self.pairs.estimated_candidates(&sources);
        if whole < many {
            let update = begin.elapsed().as_secs_f64();
            let is_whole = self.pairs.run(&sources, question.wanted, 1.0, None);
            return self.finish(begin, update, is_whole);
        }
        self.fit(EARLY, motions, question);
        let sources = Source::within(&self.broad_phase.hierarchies, *question);
        self.pairs.prepare(&sources);
        if self.pairs.estimated_candidates(&sources) < whole / 2 {
            let update = begin.elapsed().as_secs_f64();
            let is_whole = self.pairs.run(&sources, question.wanted, EARLY, None);
            self.finish(begin, update, is_whole);
            if self.earliest_found().is_some() || self.result().is_err() {
                return;
            }
        }
        self.run_until(1.0, motions, question);
    }

    /// Returns an error if the last run was cut short: cancelled, or by a limit.
    pub(crate) fn result(&self) -> Result<(), StepError> {
        self.pairs.stop.result()
    }

    /// Returns the earliest contact of the last run.
    fn earliest_found(&self) -> Option<Contact<f64>> {
        let contacts = self.pairs.contacts().flat_map(|(_, contacts)| contacts);
        contacts.copied().min_by(by_time_and_pair)
    }

    fn count(&mut self, begin: Clock, update: f64) {
        let mut statistics = StepStatistics {
            broad_phase_seconds: update,
            ..StepStatistics::default()
        };
        for worker in &self.pairs.workers {
            let StageCounts {
                candidates,
                filtered,
                contacts,
                filter_time,
                elementary_time,
            } = worker.findings.counts;
            statistics.candidates += candidates;
            statistics.filtered += filtered;
            statistics.contacts += contacts;
            let (filter, elementary) = (filter_time.as_secs_f64(), elementary_time.as_secs_f64());
            statistics.filter_seconds += filter;
            statistics.elementary_seconds += elementary;
            statistics.broad_phase_seconds += worker.seconds - filter - elementary;
        }
        statistics.seconds = begin.elapsed().as_secs_f64();
        self.statistics = statistics;
    }
}
