//! Measures cost against size: the same scene at several refinements.

use super::Frames;
use crate::methods::Preset;
use crate::pipeline::{Pipeline, StepReport};
use std::error::Error;

/// One size.
#[derive(Clone, Debug, PartialEq)]
pub struct ScalingPoint {
    /// The number of the mesh's triangles.
    pub triangles: usize,
    /// The seconds of setting up the pipeline, with feature assignment.
    pub setup_seconds: f64,
    /// The seconds of the first step, which builds the hierarchy and allocates the buffers.
    pub first_step_seconds: f64,
    /// The fastest later run of the same step: counts, and time by stage.
    pub step: StepReport,
}

/// Runs one step of `frames`, `rounds` times after a first run that builds.
///
/// # Errors
/// Returns an error if threads cannot be started or a frame is not finite.
pub fn measure_size(
    frames: &dyn Frames,
    step: usize,
    preset: Preset,
    threads: usize,
    rounds: usize,
) -> Result<ScalingPoint, Box<dyn Error + Send + Sync>> {
    let (mut start, mut end) = (Vec::new(), Vec::new());
    frames.step(step, &mut start, &mut end);
    let begin = std::time::Instant::now();
    let mut pipeline = Pipeline::<f64>::new(frames.topology().clone(), preset.stages(), threads)?;
    let setup_seconds = begin.elapsed().as_secs_f64();
    let first_step_seconds = pipeline.step(&start, &end)?.seconds;
    let mut fastest: Option<StepReport> = None;
    for _ in 0..rounds.max(1) {
        let report = pipeline.step(&start, &end)?;
        if fastest.as_ref().is_none_or(|fastest| report.seconds < fastest.seconds) {
            fastest = Some(report.clone());
        }
    }
    Ok(ScalingPoint {
        triangles: frames.topology().triangles().len(),
        setup_seconds,
        first_step_seconds,
        step: fastest.unwrap_or_default(),
    })
}
