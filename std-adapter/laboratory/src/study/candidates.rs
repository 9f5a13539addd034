//! Finds the pairs that a method leaves for the elementary test in one step, as the paper's Figure 3 shows them.

use super::Frames;
use crate::methods::Preset;
use crate::pipeline::Pipeline;
use selvedge::PairKind;
use std::error::Error;

/// The candidate primitive pairs of one method in one step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepCandidates {
    /// The method.
    pub preset: Preset,
    /// The vertex and face of each pair, as numbered by the topology.
    pub vertex_face: Vec<[u32; 2]>,
    /// The two edges of each pair, as numbered by the topology.
    pub edge_edge: Vec<[u32; 2]>,
}

/// Returns the candidates of `preset` in a step of `frames`.
///
/// # Errors
/// Returns an error if threads cannot be started or a frame is not finite.
pub fn step_candidates(
    frames: &dyn Frames,
    step: usize,
    preset: Preset,
    threads: usize,
) -> Result<StepCandidates, Box<dyn Error + Send + Sync>> {
    let (mut start, mut end) = (Vec::new(), Vec::new());
    frames.step(step, &mut start, &mut end);
    let mut pipeline = Pipeline::<f64>::new(frames.topology().clone(), preset.stages(), threads)?;
    pipeline.keep_candidates(true);
    pipeline.step(&start, &end)?;
    Ok(StepCandidates {
        preset,
        vertex_face: pipeline.candidates(PairKind::VertexFace).to_vec(),
        edge_edge: pipeline.candidates(PairKind::EdgeEdge).to_vec(),
    })
}

/// Returns the step in which `preset` leaves the most candidates, or the earliest of several.
///
/// # Errors
/// Returns an error if threads cannot be started or a frame is not finite.
pub fn busiest_step(frames: &dyn Frames, preset: Preset, threads: usize) -> Result<usize, Box<dyn Error + Send + Sync>> {
    let mut pipeline = Pipeline::<f64>::new(frames.topology().clone(), preset.stages(), threads)?;
    let (mut start, mut end) = (Vec::new(), Vec::new());
    let mut busiest = (0, 0);
    for step in 0..frames.step_count() {
        frames.step(step, &mut start, &mut end);
        let candidates = pipeline.step(&start, &end)?.candidates().total();
        if candidates > busiest.1 {
            busiest = (step, candidates);
        }
    }
    Ok(busiest.0)
}
