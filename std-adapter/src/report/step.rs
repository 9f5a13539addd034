//! One step of one method, with what a reader needs to know about it.

use crate::mesh::Topology;
use crate::pipeline::{Pipeline, Preset, StepReport};
use selvedge_core::Scalar;

/// The last step of a [`Pipeline`], ready to be reported.
#[derive(Clone, Debug, PartialEq)]
pub struct StepSummary {
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
}

impl StepSummary {
    /// The last step of `pipeline`, which runs `preset`.
    #[must_use]
    pub fn new<S: Scalar>(preset: Preset, pipeline: &Pipeline<S>) -> Self {
        let topology: &Topology = pipeline.topology();
        let times = pipeline
            .contacts()
            .iter()
            .map(|contact| contact.time.to_f64());
        Self {
            preset,
            scalar: S::NAME,
            threads: pipeline.threads(),
            vertices: topology.vertex_count(),
            edges: topology.edges().len(),
            triangles: topology.triangles().len(),
            report: pipeline.report().clone(),
            earliest: times.min_by(f64::total_cmp),
        }
    }
}
