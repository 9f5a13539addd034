//! One step of one method, with what a reader needs to know about it.

use crate::methods::Preset;
use crate::pipeline::{Pipeline, StepReport};
use selvedge::CollisionDetector;
use selvedge::Topology;
use selvedge_core::Scalar;

/// What was asked of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StepQuestion {
    /// All contacts.
    #[default]
    Contacts,
    /// The pairs that the broad phase leaves, and nothing after it.
    Candidates,
    /// The earliest contact alone.
    Earliest,
}

/// The last step of a [`Pipeline`] or a [`CollisionDetector`], ready to be reported.
#[derive(Clone, Debug, PartialEq)]
pub struct StepSummary {
    /// What was asked.
    pub question: StepQuestion,
    /// The method.
    pub preset: Preset,
    /// `"f32"` or `"f64"`.
    pub scalar: &'static str,
    /// Threads that the step used.
    pub threads: usize,
    /// The mesh's vertices.
    pub vertices: usize,
    /// The mesh's edges.
    pub edges: usize,
    /// The mesh's triangles.
    pub triangles: usize,
    /// What the step counted.
    pub report: StepReport,
    /// The earliest contact, in [0, 1] of the step.
    pub earliest: Option<f64>,
    /// Seconds of the first run of the step, which builds hierarchies and makes buffers; the report's may be a later run's.
    pub first_run_seconds: f64,
}

impl StepSummary {
    /// The last step of `pipeline`, which runs `preset`.
    #[must_use]
    pub fn new<S: Scalar>(preset: Preset, pipeline: &Pipeline<S>) -> Self {
        let topology: &Topology = pipeline.topology();
        let times = pipeline.contacts().iter().map(|contact| contact.time.to_f64());
        Self {
            earliest: times.min_by(f64::total_cmp),
            first_run_seconds: pipeline.report().seconds,
            report: pipeline.report().clone(),
            preset,
            ..Self::of_mesh::<S>(topology, pipeline.threads())
        }
    }

    /// A step of `detector` with what it counted, and the time of its earliest contact.
    #[must_use]
    pub fn of_detector<S: Scalar>(
        question: StepQuestion,
        detector: &CollisionDetector<S>,
        report: StepReport,
        earliest: Option<f64>,
    ) -> Self {
        Self {
            question,
            first_run_seconds: report.seconds,
            report,
            earliest,
            ..Self::of_mesh::<S>(detector.topology(), detector.threads())
        }
    }

    fn of_mesh<S: Scalar>(topology: &Topology, threads: usize) -> Self {
        Self {
            question: StepQuestion::Contacts,
            preset: Preset::Selvedge,
            scalar: S::NAME,
            threads,
            vertices: topology.vertex_count(),
            edges: topology.edges().len(),
            triangles: topology.triangles().len(),
            report: StepReport::default(),
            earliest: None,
            first_run_seconds: 0.0,
        }
    }
}
