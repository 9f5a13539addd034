//! Summarises one step of one method for reports.

use crate::methods::Preset;
use crate::pipeline::{Pipeline, StepReport};
use selvedge::CollisionDetector;
use selvedge::Topology;
use selvedge_core::Scalar;

/// The question that a step answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StepQuestion {
    /// All contacts.
    #[default]
    Contacts,
    /// The pairs that the broad phase leaves.
    Candidates,
    /// The earliest contact alone.
    Earliest,
}

/// The last step of a [`Pipeline`] or a [`CollisionDetector`], ready for a report.
#[derive(Clone, Debug, PartialEq)]
pub struct StepSummary {
    /// The question.
    pub question: StepQuestion,
    /// The method.
    pub preset: Preset,
    /// `"f32"` or `"f64"`.
    pub scalar: &'static str,
    /// The number of threads that the step used.
    pub threads: usize,
    /// The number of the mesh's vertices.
    pub vertices: usize,
    /// The number of the mesh's edges.
    pub edges: usize,
    /// The number of the mesh's triangles.
    pub triangles: usize,
    /// The counts and times of the step.
    pub report: StepReport,
    /// The earliest contact, in [0, 1] of the step.
    pub earliest: Option<f64>,
    /// The seconds of the first run of the step, which builds hierarchies and allocates buffers. The report may belong to a later
    /// run.
    pub first_run_seconds: f64,
}

impl StepSummary {
    /// Summarises the last step of `pipeline`, which runs `preset`.
    pub fn from_pipeline<S: Scalar>(preset: Preset, pipeline: &Pipeline<S>) -> Self {
        let topology: &Topology = pipeline.topology();
        let times = pipeline.contacts().iter().map(|contact| contact.time.to_f64());
        Self {
            earliest: times.min_by(f64::total_cmp),
            first_run_seconds: pipeline.report().seconds,
            report: pipeline.report().clone(),
            preset,
            ..Self::empty::<S>(topology, pipeline.threads())
        }
    }

    /// Summarises a step of `detector` with its counts and the time of its earliest contact.
    pub fn from_detector<S: Scalar>(
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
            ..Self::empty::<S>(detector.topology(), detector.threads())
        }
    }

    fn empty<S: Scalar>(topology: &Topology, threads: usize) -> Self {
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
