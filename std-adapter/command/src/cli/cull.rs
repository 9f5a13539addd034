//! `selvedge cull`.

use super::options::{MemoryLimit, ScalarChoice, Simd, Threads, preset_parser};
use super::output::{self, OutputFiles};
use super::progress::Progress;
use super::witnesses::Step;
use super::{Failure, NOT_READ_WHOLE};
use selvedge::PairKind;
use selvedge::Topology;
use selvedge::core::Scalar;
use selvedge::core::elementary::Limits;
use selvedge::glam::DVec3;
use selvedge::{CandidateBoxes, CollisionDetector, Criterion};
use selvedge_files::mesh::{self, CacheFormat, MeshFile, MeshStep};
use selvedge_laboratory::methods::Preset;
use selvedge_laboratory::pipeline::{Contact, Pipeline, StepReport};
use selvedge_laboratory::report::{StepQuestion, StepSummary, contacts_csv, json, pairs_csv, tables};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Finds the pairs of a mesh that may collide during one time step
///
/// Reads the mesh at the start and at the end of the step (OBJ, PLY, STL, OFF or glTF, the same vertices and triangles in the
/// same order), or a mesh and two frames of its animation: a point cache (MDD or PC2), a glTF animation or numbered files.
/// Vertices move on straight lines. Runs one method and prints the pairs after each stage.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge cull frame-92.ply frame-93.ply
  selvedge cull a.obj b.obj --pipeline lv_2014 --threads 0 --json
  selvedge cull a.ply b.ply --pairs contacts.csv --candidates candidates.csv
  selvedge cull a.ply b.ply --earliest
  selvedge cull cloth.obj cloth.pc2 --frame 12

Pairs are written as kind,i0,i1,i2,i3: the vertex and the face's three vertices,
or the two edges' vertices, numbered from 0 in the order of the file. Times are
in [0, 1] of the step.

Exit status: 0 done, 4 something that may have an area was not read and so may
have contacts besides, 1 the input is at fault, 2 the command line is at fault.")]
pub(crate) struct Cull {
    /// The mesh at the start of the step
    start: PathBuf,
    /// The mesh at the end of the step; with --frame an animation
    end: PathBuf,
    /// Take the step from this frame to the next, numbered from 0: of a point cache (.mdd, .pc2), of numbered files
    /// (frame-####.ply), or from key to key of a glTF animation
    #[arg(long, value_name = "N")]
    frame: Option<usize>,
    /// Run this method: an author and year, or ours
    #[arg(long, value_name = "NAME", default_value_t = Preset::Selvedge, value_parser = preset_parser())]
    pipeline: Preset,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    simd: Simd,
    #[command(flatten)]
    memory_limit: MemoryLimit,
    /// Compute in this format
    #[arg(long, value_enum, default_value_t = ScalarChoice::F64)]
    scalar: ScalarChoice,
    /// Write the contacts, with their times, to this file
    #[arg(long, value_name = "OUT.csv")]
    pairs: Option<PathBuf>,
    /// Write the pairs that reach the elementary test to this file. With --candidates-only or --swept-boxes, write those of the
    /// broad phase
    #[arg(long, value_name = "OUT.csv")]
    candidates: Option<PathBuf>,
    /// Stop after the broad phase, with the pairs that moving boxes leave (pipeline selvedge only)
    #[arg(long, conflicts_with_all = ["earliest", "pairs"])]
    candidates_only: bool,
    /// Start from the pairs whose swept boxes overlap, which other systems count. They are more than those of moving boxes
    /// (pipelines selvedge and selvedge_exact only)
    #[arg(long, conflicts_with = "earliest")]
    swept_boxes: bool,
    /// Find only the earliest contact (pipeline selvedge only)
    #[arg(long, conflicts_with = "candidates")]
    earliest: bool,
    /// Write the answer for each pair whose swept boxes overlap, with its proof, to this file (pipeline selvedge only). See
    /// docs/witnesses.md
    #[arg(long, value_name = "FILE", conflicts_with_all = ["earliest", "pairs", "candidates", "candidates_only", "swept_boxes", "json", "repeat"])]
    witnesses: Option<PathBuf>,
    /// Run the step this often and print the fastest run's times. The first run builds the hierarchy and allocates buffers
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    /// Print one JSON document instead of a table
    #[arg(long)]
    json: bool,
}

impl Cull {
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let step = self.read()?;
        let is_whole = step.notes.is_complete();
        match self.scalar {
            ScalarChoice::F32 => self.run_in::<f32>(step)?,
            ScalarChoice::F64 => self.run_in::<f64>(step)?,
        }
        Ok(if is_whole {
            ExitCode::SUCCESS
        } else {
            ExitCode::from(NOT_READ_WHOLE)
        })
    }

    fn read(&self) -> Result<MeshStep, Failure> {
        if self.frame.is_none() && CacheFormat::from_path(&self.end).is_none() {
            return output::read_step(&self.start, &self.end);
        }
        let MeshFile { mesh, notes } = mesh::read(&self.start)?;
        let mut frames = output::read_frames(&self.end, mesh.positions.len())?;
        output::say(format_args!("{}: {notes}", self.start.display()));
        let Some(frame) = self.frame.filter(|frame| frames.len() > frame.saturating_add(1)) else {
            let file = self.end.display();
            return Err(match frames.len() {
                0 | 1 => format!("{file}: there is one frame, but a step needs two").into(),
                count => format!(
                    "{file}: there are {count} frames; name the first of the step: --frame 0 to {}",
                    count - 2
                )
                .into(),
            });
        };
        let (_, end) = frames.swap_remove(frame + 1);
        let (_, start) = frames.swap_remove(frame);
        Ok(MeshStep {
            topology: mesh.topology()?,
            start,
            end,
            notes,
        })
    }

    fn run_in<S: Scalar>(&self, step: MeshStep) -> Result<(), Failure> {
        let start = positions::<S>(&step.start, &self.start)?;
        let end = positions::<S>(&step.end, &self.end)?;
        for (exact, rounded, file) in [(&step.start, &start, &self.start), (&step.end, &end, &self.end)] {
            let collapsed = collapsed_edges::<S>(&step.topology, exact, rounded);
            if collapsed > 0 {
                output::say(format_args!(
                    "{}: rounding to {} gives both ends of {collapsed} edge{} one position; use --scalar f64, or move the mesh nearer to the origin",
                    file.display(),
                    S::NAME,
                    if collapsed == 1 { "" } else { "s" },
                ));
            }
        }
        for path in [&self.pairs, &self.candidates].into_iter().flatten() {
            OutputFiles::check(path)?;
        }
        if self.pairs.is_some() && self.pairs == self.candidates {
            return Err("--pairs and --candidates name the same file".into());
        }

        if let Some(path) = &self.witnesses {
            return self.write_witnesses::<S>(path, step.topology, &start, &end);
        }
        if let Some((question, option)) = self.question() {
            let is_exact = self.pipeline == Preset::SelvedgeExact && self.swept_boxes;
            if !(self.pipeline == Preset::Selvedge || is_exact) {
                return Err(format!("only the pipeline selvedge supports {option}, not {}", self.pipeline).into());
            }
            return self.ask::<S>(question, step.topology, &start, &end);
        }
        let mut pipeline = Pipeline::<S>::new(step.topology, self.pipeline.stages(), self.threads.get())?;
        pipeline.set_level(self.simd.level());
        pipeline.set_memory_limit(self.memory_limit.get());
        pipeline.keep_candidates(self.candidates.is_some());
        let mut fastest = Fastest::default();
        {
            let _progress = Progress::spinner("culling");
            for _ in 0..self.repeat {
                fastest.meet(pipeline.step(&start, &end)?);
            }
        }
        let summary = StepSummary::from_pipeline(self.pipeline, &pipeline);
        let candidates = PairKind::ALL.map(|kind| pipeline.candidates(kind));
        self.report(summary, &fastest, pipeline.topology(), pipeline.contacts(), candidates)
    }

    /// Writes the requested files, and prints the counts of the fastest run.
    fn report<S: Scalar>(
        &self,
        mut summary: StepSummary,
        fastest: &Fastest,
        topology: &Topology,
        contacts: &[Contact<S>],
        [vertex_face, edge_edge]: [&[[u32; 2]]; 2],
    ) -> Result<(), Failure> {
        let mut files = OutputFiles::default();
        if let Some(path) = &self.pairs {
            files.add(path.clone(), |out| contacts_csv(topology, contacts, out))?;
        }
        if let Some(path) = &self.candidates {
            files.add(path.clone(), |out| pairs_csv(topology, vertex_face, edge_edge, out))?;
        }
        files.publish()?;
        summary.report.clone_from(&fastest.report);
        summary.first_run_seconds = fastest.first_run_seconds.unwrap_or_default();
        output::answer(self.json, || json::step(&summary), || tables::step(&summary))
    }
}

/// The fastest of several runs of a step, and the time of the first one.
#[derive(Default)]
struct Fastest {
    report: StepReport,
    first_run_seconds: Option<f64>,
}

impl Fastest {
    fn meet(&mut self, report: &StepReport) {
        if self.first_run_seconds.is_none() || report.seconds < self.report.seconds {
            self.report.clone_from(report);
        }
        self.first_run_seconds.get_or_insert(report.seconds);
    }
}

impl Cull {
    /// Returns the question that only a detector answers, and its option.
    fn question(&self) -> Option<(StepQuestion, &'static str)> {
        match (self.candidates_only, self.earliest, self.swept_boxes) {
            (true, ..) => Some((StepQuestion::Candidates, "--candidates-only")),
            (_, true, _) => Some((StepQuestion::Earliest, "--earliest")),
            (_, _, true) => Some((StepQuestion::Contacts, "--swept-boxes")),
            _ => None,
        }
    }

    /// Answers a question that pipelines do not.
    fn ask<S: Scalar>(
        &self,
        question: StepQuestion,
        topology: Topology,
        start: &[S::Vector],
        end: &[S::Vector],
    ) -> Result<(), Failure> {
        let mut detector = CollisionDetector::<S>::new(topology);
        detector.set_threads(selvedge::Threads::from_count(self.threads.get()))?;
        if self.pipeline == Preset::SelvedgeExact {
            let tolerance = Limits::default().tolerance;
            detector.set_criterion(Criterion::Touching { tolerance })?;
        }
        detector.set_level(self.simd.level());
        detector.set_memory_limit(self.memory_limit.get());
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        let mut contacts = Vec::new();
        let boxes = if self.swept_boxes {
            CandidateBoxes::Swept
        } else {
            CandidateBoxes::Moving
        };
        let mut fastest = Fastest::default();
        {
            let _progress = Progress::spinner("culling");
            for _ in 0..self.repeat {
                if question == StepQuestion::Earliest {
                    contacts = detector.earliest(start, end)?.into_iter().collect();
                } else {
                    detector.candidates(start, end, boxes, &mut vertex_face, &mut edge_edge)?;
                }
                let mut report = StepReport::from_detector(detector.statistics());
                match question {
                    StepQuestion::Earliest => {}
                    StepQuestion::Candidates => report.stages.clear(),
                    StepQuestion::Contacts => {
                        let pairs = (&vertex_face, &edge_edge);
                        detector.contacts_of(start, end, pairs.0, pairs.1, &mut contacts)?;
                        report = StepReport::from_given_pairs(detector.statistics(), report.seconds);
                    }
                }
                fastest.meet(&report);
            }
        }
        let times = contacts.iter().map(|contact| contact.time.to_f64());
        let earliest = times.min_by(f64::total_cmp);
        let mut summary = StepSummary::from_detector(question, &detector, StepReport::default(), earliest);
        summary.preset = self.pipeline;
        let candidates = [&*vertex_face, &*edge_edge];
        self.report(summary, &fastest, detector.topology(), &contacts, candidates)
    }
}

impl Cull {
    /// Writes the answers with their proofs.
    fn write_witnesses<S: Scalar>(
        &self,
        path: &Path,
        topology: Topology,
        start: &[S::Vector],
        end: &[S::Vector],
    ) -> Result<(), Failure> {
        if self.pipeline != Preset::Selvedge {
            return Err(format!("only the pipeline selvedge supports --witnesses, not {}", self.pipeline).into());
        }
        OutputFiles::check(path)?;
        let mut detector = CollisionDetector::<S>::new(topology);
        detector.set_threads(selvedge::Threads::from_count(self.threads.get()))?;
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        detector.candidates(start, end, CandidateBoxes::Swept, &mut vertex_face, &mut edge_edge)?;
        let step = Step::<S> {
            topology: detector.topology(),
            frames: [start, end],
            pairs: [&vertex_face, &edge_edge],
        };
        let mut never = 0;
        let mut files = OutputFiles::default();
        {
            let _progress = Progress::spinner("writing proofs");
            files.add(path.to_path_buf(), |out| {
                never = step.write(out)?;
                Ok(())
            })?;
        }
        files.publish()?;
        let pairs = vertex_face.len() + edge_edge.len();
        output::print(&format!("{pairs} pairs: {never} never touch, {} may touch\n", pairs - never))
    }
}

/// Counts the edges whose ends are one position after rounding, but not before it.
fn collapsed_edges<S: Scalar>(topology: &Topology, exact: &[DVec3], rounded: &[S::Vector]) -> usize {
    let at = |vertex: u32| -> [S; 3] { rounded[vertex as usize].into() };
    let collapses = |&&[a, b]: &&[u32; 2]| at(a) == at(b) && exact[a as usize] != exact[b as usize];
    topology.edges().iter().filter(collapses).count()
}

/// Converts positions to the format `S`.
fn positions<S: Scalar>(positions: &[DVec3], file: &Path) -> Result<Vec<S::Vector>, Failure> {
    let mut rounded = 0_usize;
    let converted = positions.iter().enumerate().map(|(vertex, position)| {
        let coordinates = position.to_array();
        let narrow = coordinates.map(S::from_f64);
        for axis in 0..3 {
            if !narrow[axis].is_finite() {
                return Err(format!(
                    "{}: the {} coordinate of vertex {vertex} is {:e}, too large for {}; use --scalar f64",
                    file.display(),
                    ["x", "y", "z"][axis],
                    coordinates[axis],
                    S::NAME,
                )
                .into());
            }
            rounded += usize::from(narrow[axis].to_f64() != coordinates[axis]);
        }
        Ok(S::Vector::from(narrow))
    });
    let converted = converted.collect::<Result<Vec<_>, Failure>>()?;
    if rounded > 0 {
        output::say(format_args!(
            "{}: {} rounded to {}",
            file.display(),
            output::coordinates_were(rounded),
            S::NAME
        ));
    }
    Ok(converted)
}
