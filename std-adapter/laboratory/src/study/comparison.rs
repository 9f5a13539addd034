//! Runs every method on the same steps: the paper's Table 1.

use super::Frames;
use crate::methods::{Preset, Stage};
use crate::pipeline::{Contact, Pipeline, StepReport};
use selvedge::PairCounts;
use selvedge::PairKind;
use std::error::Error;

/// The mean numbers of pairs per step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeanCounts {
    /// The vertex–face pairs per step.
    pub vertex_face: f64,
    /// The edge–edge pairs per step.
    pub edge_edge: f64,
}

/// One stage of one method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanStage {
    /// The stage, after the broad phase.
    pub stage: Stage,
    /// The pairs that it passes on.
    pub survivors: MeanCounts,
    /// The seconds per step, in the fastest round, summed over threads.
    pub seconds: f64,
}

/// One method.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparisonRow {
    /// The method.
    pub preset: Preset,
    /// The candidate triangle pairs per step: the same for every method that has them, otherwise zero.
    pub triangle_pairs: f64,
    /// True if it has triangle pairs. Otherwise its broad phase finds primitive pairs: those of
    /// [`after_boxes`](Self::after_boxes).
    pub has_triangle_pairs: bool,
    /// The seconds of the broad phase per step, in the fastest round.
    pub broad_phase_seconds: f64,
    /// The stages after the broad phase, up to the elementary test.
    pub stages: Vec<MeanStage>,
    /// The pairs after the last box test. Without one, these are the pairs as distributed, or as the broad phase finds them.
    pub after_boxes: MeanCounts,
    /// The pairs that reach the elementary test: the paper's *candidate primitive pairs*.
    pub candidates: MeanCounts,
    /// The contacts that the elementary test finds.
    pub contacts: MeanCounts,
    /// The pairs that touch by the exact verdict, and are not among the contacts.
    pub missed: MeanCounts,
    /// The steps per second, culling and elementary tests together, in the fastest round.
    pub frames_per_second: f64,
}

/// Every method on the same steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The name of the motion.
    pub name: String,
    /// The number of the mesh's vertices.
    pub vertices: usize,
    /// The number of the mesh's edges.
    pub edges: usize,
    /// The number of the mesh's triangles.
    pub triangles: usize,
    /// Returns the number of steps.
    pub steps: usize,
    /// The number of threads that each method used.
    pub threads: usize,
    /// The number of times that each method ran each step.
    pub rounds: usize,
    /// One row for each method.
    pub rows: Vec<ComparisonRow>,
}

/// Runs every step of `frames` through each of `presets`.
///
/// All methods run a step before any runs the next, `rounds` times, so that a change in the machine's speed meets all of them.
/// The fastest round of each step counts. [`Preset::SelvedgeExact`] decides which pairs truly touch, once a step and untimed.
/// `progress` is called after each step of each round with the share that is done.
///
/// # Errors
/// Returns an error if threads cannot be started or a frame is not finite.
pub fn compare(
    frames: &dyn Frames,
    presets: &[Preset],
    threads: usize,
    rounds: usize,
    progress: &mut dyn FnMut(f64),
) -> Result<Comparison, Box<dyn Error + Send + Sync>> {
    let topology = frames.topology();
    let rounds = rounds.max(1);
    let mut methods = Vec::with_capacity(presets.len());
    for &preset in presets {
        let pipeline = Pipeline::<f64>::new(topology.clone(), preset.stages(), threads)?;
        methods.push(Method {
            preset,
            pipeline,
            total: StepReport::default(),
            missed: PairCounts::default(),
        });
    }
    let mut exact = Pipeline::<f64>::new(topology.clone(), Preset::SelvedgeExact.stages(), threads)?;
    let (mut start, mut end) = (Vec::new(), Vec::new());
    let steps = frames.step_count();
    for step in 0..steps {
        frames.step(step, &mut start, &mut end);
        let mut fastest: Vec<Option<StepReport>> = vec![None; methods.len()];
        for round in 0..rounds {
            for (method, fastest) in methods.iter_mut().zip(&mut fastest) {
                let report = method.pipeline.step(&start, &end)?;
                if fastest.as_ref().is_none_or(|fastest| report.seconds < fastest.seconds) {
                    *fastest = Some(report.clone());
                }
            }
            progress((step * rounds + round + 1) as f64 / (steps * rounds) as f64);
        }
        exact.step(&start, &end)?;
        let touching = touching_pairs(exact.contacts());
        for (method, report) in methods.iter_mut().zip(fastest) {
            method.total.add(&report.unwrap_or_default());
            method.missed += missing(&touching, &touching_pairs(method.pipeline.contacts()));
        }
    }
    Ok(Comparison {
        name: frames.name(),
        vertices: topology.vertex_count(),
        edges: topology.edges().len(),
        triangles: topology.triangles().len(),
        steps,
        threads: methods.first().map_or(threads, |method| method.pipeline.threads()),
        rounds,
        rows: methods.into_iter().map(|method| method.row(steps)).collect(),
    })
}

struct Method {
    preset: Preset,
    pipeline: Pipeline<f64>,
    total: StepReport,
    missed: PairCounts,
}

/// Returns contacts in a canonical order, each once, with the edges of a pair in ascending order.
fn touching_pairs(contacts: &[Contact<f64>]) -> Vec<(PairKind, [u32; 2])> {
    let pairs = contacts.iter().map(|contact| {
        let [first, second] = contact.pair;
        match contact.kind {
            PairKind::VertexFace => (contact.kind, [first, second]),
            PairKind::EdgeEdge => (contact.kind, [first.min(second), first.max(second)]),
        }
    });
    let mut pairs: Vec<_> = pairs.collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// Counts the items of `wanted` that are not in `found`; both are in order.
fn missing(wanted: &[(PairKind, [u32; 2])], found: &[(PairKind, [u32; 2])]) -> PairCounts {
    let mut missing = PairCounts::default();
    for pair in wanted.iter().filter(|pair| found.binary_search(pair).is_err()) {
        match pair.0 {
            PairKind::VertexFace => missing.vertex_face += 1,
            PairKind::EdgeEdge => missing.edge_edge += 1,
        }
    }
    missing
}

impl Method {
    fn row(self, steps: usize) -> ComparisonRow {
        let total = self.total;
        let mean = |sum: f64| sum / steps as f64;
        let counts = |counts: PairCounts| MeanCounts {
            vertex_face: mean(counts.vertex_face as f64),
            edge_edge: mean(counts.edge_edge as f64),
        };
        let stages = total.stages.iter().map(|report| MeanStage {
            stage: report.stage,
            survivors: counts(report.survivors),
            seconds: mean(report.seconds),
        });
        ComparisonRow {
            preset: self.preset,
            triangle_pairs: mean(total.triangle_pairs as f64),
            has_triangle_pairs: total.broad_phase_pairs.is_none(),
            broad_phase_seconds: mean(total.broad_phase_seconds),
            stages: stages.collect(),
            after_boxes: counts(total.after_boxes()),
            candidates: counts(total.candidates()),
            contacts: counts(total.contacts()),
            missed: counts(self.missed),
            frames_per_second: steps as f64 / total.seconds,
        }
    }
}
