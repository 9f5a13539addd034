//! Computes from two frames of a mesh the primitive pairs that may collide, and those that do.
//!
//! ```text
//! triangles, positions at the start and at the end of the step
//!   │  once per mesh    feature assignment: each vertex and edge gets one representative triangle
//!   │  every step       broad phase over swept triangle boxes
//!   ▼
//! candidate triangle pairs
//!   │  distribution     at most 6 VF and 9 EE pairs each
//!   │  culling tests    boxes, relative boxes, non-coplanarity: a method's choice
//!   ▼
//! candidate primitive pairs
//!   │  elementary test
//!   ▼
//! contacts
//! ```
//!
//! A published method is a [`Preset`]: a choice of stages ([`Stages`]), never another loop. All of them run the same code on the
//! same broad phase, so that their times compare. Every test runs on sixteen pairs at a time ([`selvedge_core::batch`]). Only the
//! presets `selvedge` and `selvedge_exact` have no triangle pairs ([`PairSource::MovingBoxes`]): they run [`CollisionDetector`],
//! with the same counts.
//!
//! ```
//! use selvedge::{glam::DVec3, Topology};
//! use selvedge_laboratory::{methods::Preset, pipeline::Pipeline};
//!
//! // A small triangle falls through a large one.
//! let topology = Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?;
//! let mut start = vec![DVec3::new(-5.0, -5.0, 0.0), DVec3::new(5.0, -5.0, 0.0), DVec3::new(0.0, 5.0, 0.0)];
//! start.extend([DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.1), DVec3::new(0.0, 1.0, 1.2)]);
//! let mut end = start.clone();
//! for vertex in &mut end[3..] {
//!     vertex.z -= 4.0;
//! }
//!
//! let mut pipeline = Pipeline::<f64>::new(topology, Preset::Selvedge.stages(), 1)?;
//! let report = pipeline.step(&start, &end)?;
//! assert_eq!((report.candidates().vertex_face, report.contacts().vertex_face), (3, 3));
//! let time = pipeline.contacts()[0].time;
//! assert!(time <= 0.25 && time > 0.25 - 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assignment;
mod batch;
mod pairs;
mod report;
mod stored;
mod swept;

pub use assignment::FeatureAssignment;
pub use report::{StageReport, StepReport};
pub use selvedge::Contact;
pub use selvedge::StepError;
pub use selvedge::ThreadError;

use crate::broad_phase::{BroadPhase, SweptBox};
#[cfg(doc)]
use crate::methods::Preset;
use crate::methods::{CullingTest, ElementaryTest, PairSource, Redundancy, Stages};
use batch::{Batch, Distributed, StepInput};
use pairs::MovingMesh;
use selvedge::PairKind;
use selvedge::Topology;
use selvedge::check_frames;
use selvedge::clock::Clock;
use selvedge::parallel::{self, Workers};
use selvedge::simd::{Level, best_level};
use selvedge::{CollisionDetector, Criterion, Threads};
use selvedge_core::batch::VertexRow;
use selvedge_core::boxes::Aabb;
use selvedge_core::elementary::Limits;
use selvedge_core::{Motion, Scalar};
use std::sync::Arc;
use stored::StoredDops;

/// The number of candidate triangle pairs in a batch. Their primitive pairs take at most a quarter of a megabyte, so that a batch
/// stays in a core's own cache through all stages. Smaller batches gain nothing and read the clock more often.
const BATCH: usize = 2048;

/// A method, set up for one mesh. [`step`](Self::step) runs it on one time step after another.
///
/// Contacts and counts are the same, in the same order, for any number of threads. Buffers grow with some room to spare and never
/// shrink. After the first step nothing is allocated unless some part of the mesh has more pairs than ever. With several threads,
/// rayon may still allocate for its queues.
#[derive(Debug)]
pub struct Pipeline<S: Scalar> {
    topology: Arc<Topology>,
    stages: Stages,
    route: Route<S>,
    /// The threads for methods with triangle pairs; a detector has its own.
    threads: Workers,
    buffers: Buffers<S>,
    report: StepReport,
}

/// The source of primitive pairs.
#[derive(Debug)]
enum Route<S: Scalar> {
    TrianglePairs(Redundancy, FeatureAssignment),
    MovingBoxes(Box<CollisionDetector<S>>),
}

/// Buffers that each step fills again.
#[derive(Debug)]
struct Buffers<S: Scalar> {
    keep_candidates: bool,
    level: Level,
    rows: Vec<VertexRow<S>>,
    swept: Vec<SweptBox>,
    broad_phase: BroadPhase,
    triangle_pairs: Vec<[u32; 2]>,
    boxes: Vec<Aabb<S>>,
    dops: StoredDops<S>,
    batches: Vec<Batch<S>>,
    distributed: Distributed,
    candidates: [Vec<[u32; 2]>; 2],
    contacts: Vec<Contact<S>>,
}

impl<S: Scalar> Pipeline<S> {
    /// Prepares `stages` for a mesh, on `threads` threads; 0 means one for each core.
    ///
    /// With one thread everything runs on the calling thread, without a pool.
    ///
    /// # Errors
    /// Returns an error if the operating system refuses the threads.
    pub fn new(topology: impl Into<Arc<Topology>>, stages: Stages, threads: usize) -> Result<Self, ThreadError> {
        let topology = topology.into();
        let mut own_threads = Workers::default();
        let route = match stages.source {
            PairSource::MovingBoxes => {
                let mut detector = CollisionDetector::new(topology.clone());
                detector.set_threads(Threads::from_count(threads))?;
                if stages.elementary == ElementaryTest::Exact {
                    let tolerance = Limits::default().tolerance;
                    let touching = detector.set_criterion(Criterion::Touching { tolerance });
                    touching.expect("the default tolerance is one");
                }
                Route::MovingBoxes(Box::new(detector))
            }
            PairSource::TrianglePairs(redundancy) => {
                own_threads = Workers::new(Threads::from_count(threads))?;
                let assignment = match redundancy {
                    Redundancy::RepresentativeTriangles => FeatureAssignment::representative(&topology),
                    Redundancy::Kept | Redundancy::HashSets => FeatureAssignment::every_feature(&topology),
                };
                Route::TrianglePairs(redundancy, assignment)
            }
        };
        // A few batches for each thread keep the threads busy when batches differ in cost.
        let batches = match (&route, own_threads.count()) {
            (Route::MovingBoxes(_), _) => 0,
            (_, 1) => 1,
            (_, count) => 4 * count,
        };
        Ok(Self {
            buffers: Buffers {
                keep_candidates: false,
                level: best_level(),
                rows: Vec::new(),
                swept: Vec::new(),
                broad_phase: BroadPhase::default(),
                triangle_pairs: Vec::new(),
                boxes: Vec::new(),
                dops: StoredDops::new(),
                batches: vec![Batch::with_capacity(BATCH); batches],
                distributed: Distributed::default(),
                candidates: [Vec::new(), Vec::new()],
                contacts: Vec::new(),
            },
            report: StepReport::default(),
            topology,
            stages,
            route,
            threads: own_threads,
        })
    }

    /// Sets whether the pairs that reach the elementary test are kept for [`candidates`](Self::candidates). The default is false.
    pub const fn keep_candidates(&mut self, keep: bool) {
        self.buffers.keep_candidates = keep;
    }

    /// Forces the instruction set of the batched kernels. The default is the best that the machine has. The results do not
    /// change.
    pub const fn set_level(&mut self, level: Level) {
        self.buffers.level = level;
        if let Route::MovingBoxes(detector) = &mut self.route {
            detector.set_level(level);
        }
    }

    /// Sets the most memory that a detector's pairs and contacts may take, in bytes; see [`CollisionDetector::set_memory_limit`].
    /// Methods with triangle pairs have no limit.
    pub fn set_memory_limit(&mut self, limit: Option<u64>) {
        if let Route::MovingBoxes(detector) = &mut self.route {
            detector.set_memory_limit(limit);
        }
    }

    /// Runs the step from `start` to `end`, one position for each vertex, in any length unit.
    ///
    /// # Errors
    /// If a frame's length is not the mesh's number of vertices, a coordinate is NaN or infinite, or the memory limit is
    /// exceeded.
    pub fn step(&mut self, start: &[S::Vector], end: &[S::Vector]) -> Result<&StepReport, StepError> {
        check_frames(start, end, self.topology.vertex_count())?;
        let Self {
            topology,
            stages,
            route,
            threads,
            buffers,
            report,
        } = self;
        match route {
            Route::TrianglePairs(redundancy, assignment) => {
                let mesh = Distributor {
                    topology,
                    assignment,
                    redundancy: *redundancy,
                };
                threads.run(|| buffers.step(mesh, *stages, start, end, report));
            }
            Route::MovingBoxes(detector) => {
                buffers.ask(detector, start, end)?;
                *report = StepReport::from_detector(detector.statistics());
            }
        }
        Ok(report)
    }

    /// Returns the contacts of the last step. They come batch by batch in the order of candidate triangle pairs. Without triangle
    /// pairs, vertex–face contacts come first, in the order of the hierarchies.
    pub fn contacts(&self) -> &[Contact<S>] {
        &self.buffers.contacts
    }

    /// Returns the pairs of the last step that reached the elementary test, if they are [kept](Self::keep_candidates).
    pub fn candidates(&self, kind: PairKind) -> &[[u32; 2]] {
        &self.buffers.candidates[kind as usize]
    }

    /// Returns the counts and times of the last step.
    pub const fn report(&self) -> &StepReport {
        &self.report
    }

    /// Returns the mesh's vertices, edges and triangles.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Returns the number of threads that a step uses.
    pub fn threads(&self) -> usize {
        match &self.route {
            Route::MovingBoxes(detector) => detector.threads(),
            Route::TrianglePairs(..) => self.threads.count(),
        }
    }
}

/// The parts that turn triangle pairs into primitive pairs.
#[derive(Clone, Copy)]
struct Distributor<'a> {
    topology: &'a Topology,
    assignment: &'a FeatureAssignment,
    redundancy: Redundancy,
}

impl<S: Scalar> Buffers<S> {
    /// Runs our own detector, and keeps its candidates on request.
    fn ask(&mut self, detector: &mut CollisionDetector<S>, start: &[S::Vector], end: &[S::Vector]) -> Result<(), StepError> {
        let [vertex_face, edge_edge] = &mut self.candidates;
        if self.keep_candidates {
            detector.contacts_and_filtered(start, end, &mut self.contacts, vertex_face, edge_edge)
        } else {
            vertex_face.clear();
            edge_edge.clear();
            detector.contacts(start, end, &mut self.contacts)
        }
    }

    fn step(
        &mut self,
        distributor: Distributor<'_>,
        stages: Stages,
        start: &[S::Vector],
        end: &[S::Vector],
        report: &mut StepReport,
    ) {
        let begin = Clock::now();
        self.rows.clear();
        let moving = start.iter().zip(end).map(|(&start, &end)| Motion::new(start, end));
        self.rows.extend(moving.map(VertexRow::new));
        let mesh = MovingMesh {
            topology: distributor.topology,
            rows: &self.rows,
        };
        parallel::fill(&mut self.boxes, mesh.topology.triangles(), |corners| {
            Aabb::swept(&corners.map(|vertex| mesh.rows[vertex as usize].motion()))
        });
        swept::map_boxes(&mut self.swept, &self.boxes);
        self.broad_phase.overlapping_pairs(&self.swept, &mut self.triangle_pairs);
        report.broad_phase_seconds = begin.elapsed().as_secs_f64();
        report.triangle_pairs = self.triangle_pairs.len() as u64;

        self.primitive_stages(distributor, stages, report);
        report.seconds = begin.elapsed().as_secs_f64();
    }

    fn primitive_stages(&mut self, distributor: Distributor<'_>, stages: Stages, report: &mut StepReport) {
        let Distributor {
            topology,
            assignment,
            redundancy,
        } = distributor;
        report.broad_phase_pairs = None;
        report.stages = stages.names().map(StageReport::empty).collect();
        self.contacts.clear();
        self.candidates.iter_mut().for_each(Vec::clear);
        self.distributed.vertex_face.clear();
        self.distributed.edge_edge.clear();

        let mesh = MovingMesh {
            topology,
            rows: &self.rows,
        };
        // Volumes that only some methods store are refitted in the stage that uses them.
        for (test, report) in stages.tests.iter().zip(&mut report.stages[1..]) {
            if *test == CullingTest::StoredDop18 {
                let begin = Clock::now();
                self.dops.refit(mesh);
                report.seconds += begin.elapsed().as_secs_f64();
            }
        }
        let step = StepInput {
            level: self.level,
            mesh,
            dops: &self.dops,
            stages,
        };

        for pairs in self.triangle_pairs.chunks(BATCH * self.batches.len()) {
            let batches = &mut self.batches[..pairs.len().div_ceil(BATCH)];
            let distribute = |index: usize, batch: &mut Batch<S>| {
                let pairs = &pairs[index * BATCH..pairs.len().min((index + 1) * BATCH)];
                batch.distribute(pairs, assignment);
            };
            let finish = |batch: &mut Batch<S>| {
                batch.cull(&step);
                batch.find_contacts(&step);
            };
            if redundancy == Redundancy::HashSets {
                // One thread updates the sets in order, so that the first of equal pairs stays.
                parallel::for_each(batches, distribute);
                batches.iter_mut().for_each(|batch| batch.keep_new(&mut self.distributed));
                parallel::for_each(batches, |_, batch| finish(batch));
            } else {
                parallel::for_each(batches, |index, batch| {
                    distribute(index, batch);
                    finish(batch);
                });
            }
            for batch in batches {
                for (stage, &(survivors, seconds)) in report.stages.iter_mut().zip(&batch.tallies) {
                    stage.survivors += survivors;
                    stage.seconds += seconds;
                }
                if self.keep_candidates {
                    self.candidates[PairKind::VertexFace as usize].extend_from_slice(&batch.vertex_face);
                    self.candidates[PairKind::EdgeEdge as usize].extend_from_slice(&batch.edge_edge);
                }
                self.contacts.extend_from_slice(&batch.contacts);
            }
        }
    }
}
