//! `selvedge check`.

use super::options::{MemoryLimit, Threads};
use super::output::{self, OutputFiles};
use super::progress::Progress;
use super::{Failure, NOT_READ_WHOLE};
use selvedge::{CollisionDetector, Topology};
use selvedge_files::mesh::{self, Findings, ReadOptions};
use selvedge_laboratory::report::{FileReport, MeshCheck, coloured_ply, intersecting_triangles, mesh_checks, mesh_checks_json};
use selvedge_laboratory::report::{intersections_csv, intersections_json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

/// Finds out exactly whether meshes pass through themselves
///
/// Reads meshes (OBJ, PLY, STL, OFF or glTF) and checks each at rest. Finds edges that pass through faces or touch them, and
/// neighbours that are folded flat onto each other. Ropes and particles are checked as well: lines `l` and `p` of OBJ, the
/// element `edge` of PLY, and all vertices of a PLY file without faces. Frames of a sequence, with the same triangles, share
/// their hierarchies, which is faster. Features that share a vertex do not intersect there.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge check cloth.obj
  selvedge check frames/*.ply --threads 0 --list intersections.csv
  selvedge check frames/*.ply --any --json
  selvedge check tangled.ply --ply out/      writes out/tangled-intersections.ply
  selvedge check garment.obj --weld          merges split seams first
  selvedge check a.obj --frames a.mdd        each frame of a point cache

The list has mesh,kind,i0,i1,i2,i3,i4: the two vertices of the edge and the three of
the face, numbered from 0 in the order of the file. A loose edge is a face that
names its second vertex twice, a point one that names it three times.

Exit status: 0 all meshes are free, 3 there are intersections, 4 there are none in
what was read, but something that may have an area was not read, 1 the input is at
fault, 2 the command line is at fault.")]
pub(crate) struct Check {
    /// The meshes, or the frames of a sequence in order
    #[arg(required = true, value_name = "MESH")]
    meshes: Vec<PathBuf>,
    #[command(flatten)]
    threads: Threads,
    /// Stop at the first intersection of each mesh; report only whether there is one
    #[arg(long, conflicts_with_all = ["list", "ply"])]
    any: bool,
    /// Write all intersections to this file, as .csv or .json
    #[arg(long, value_name = "OUT.csv")]
    list: Option<PathBuf>,
    /// Write each mesh that intersects itself to this folder, with the place in red
    #[arg(long, value_name = "FOLDER")]
    ply: Option<PathBuf>,
    /// Merge vertices at most this far apart, in the file's unit, first: 0 those in the same place
    #[arg(long, value_name = "DISTANCE", num_args = 0..=1, default_missing_value = "0", require_equals = true, value_parser = distance)]
    weld: Option<f64>,
    /// Check the faces of this group or object of an OBJ file, or of this node of a glTF file, alone
    #[arg(long, value_name = "GROUP")]
    only: Option<String>,
    /// Check the mesh at each frame of this animation instead: a point cache (.mdd, .pc2), the keys of a glTF animation, or
    /// numbered files (frame-####.ply)
    #[arg(long, value_name = "FILE", conflicts_with = "ply")]
    frames: Option<PathBuf>,
    #[command(flatten)]
    memory_limit: MemoryLimit,
    /// Print one JSON document instead of a table
    #[arg(long)]
    json: bool,
}

fn distance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(distance) if (0.0..f64::INFINITY).contains(&distance) => Ok(distance),
        _ => Err("must be a number, 0 or more".to_owned()),
    }
}

/// The exit status if there are intersections.
const TANGLED: u8 = 3;

/// The format of a list.
#[derive(Clone, Copy)]
enum ListFormat {
    Csv,
    Json,
}

impl ListFormat {
    fn of(path: &Path) -> Result<Self, Failure> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some(extension) if extension.eq_ignore_ascii_case("csv") => Ok(Self::Csv),
            Some(extension) if extension.eq_ignore_ascii_case("json") => Ok(Self::Json),
            _ => Err(format!("{}: the name of the list must end in .csv or .json", path.display()).into()),
        }
    }
}

impl Check {
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let format = self.list.as_deref().map(ListFormat::of).transpose()?;
        if let Some(path) = &self.list {
            OutputFiles::check(path)?;
        }
        let coloured = self.coloured_files()?;
        let mut files = OutputFiles::default();
        let found = self.check_meshes(&coloured, &mut files)?;
        if let (Some(path), Some(format)) = (&self.list, format) {
            files.add(path.clone(), |out| match format {
                ListFormat::Csv => intersections_csv(&found, out),
                ListFormat::Json => serde_json::to_writer(out, &intersections_json(&found)).map_err(Into::into),
            })?;
        }
        files.publish()?;
        output::answer(self.json, || mesh_checks_json(&found), || mesh_checks(&found))?;
        Ok(if found.iter().all(|check| check.is_free) {
            ExitCode::SUCCESS
        } else if !found.iter().any(|check| check.is_tangled) {
            ExitCode::from(NOT_READ_WHOLE)
        } else {
            ExitCode::from(TANGLED)
        })
    }

    /// Checks one mesh after the other.
    fn check_meshes(&self, coloured: &[PathBuf], files: &mut OutputFiles) -> Result<Vec<MeshCheck>, Failure> {
        let progress = Progress::steps("checking", self.meshes.len() as u64);
        let mut before: Option<(Arc<Topology>, CollisionDetector<f64>)> = None;
        let mut found = Vec::with_capacity(self.meshes.len());
        let mut intersections = Vec::new();
        for (index, path) in self.meshes.iter().enumerate() {
            let options = ReadOptions {
                loose_features: true,
                only: self.only.as_deref(),
                weld: self.weld,
            };
            let mesh = mesh::read_with(path, &options)?;
            let is_next = |(topology, _): &(Arc<Topology>, _)| is_frame_of(topology, &mesh.topology);
            let (topology, mut detector) = match before.take().filter(is_next) {
                Some(before) => before,
                None => {
                    let topology = Arc::new(mesh.topology);
                    let mut detector = CollisionDetector::new(Arc::clone(&topology));
                    detector.set_threads(selvedge::Threads::from_count(self.threads.get()))?;
                    detector.set_memory_limit(self.memory_limit.get());
                    (topology, detector)
                }
            };
            let notes = mesh.notes;
            let frames = match &self.frames {
                None => vec![(path.display().to_string(), mesh.positions)],
                Some(frames) => output::read_frames(frames, topology.vertex_count())?,
            };
            for (name, positions) in frames {
                let file = FileReport {
                    notes: notes.clone(),
                    findings: Findings::of(&positions, &topology),
                };
                let begin = Instant::now();
                let check = if self.any {
                    let is_free = !detector.has_intersections(&positions)?;
                    MeshCheck::from_verdict(name, &topology, is_free, begin.elapsed().as_secs_f64())
                } else {
                    detector.intersections(&positions, &mut intersections)?;
                    MeshCheck::from_intersections(name, &topology, &intersections, begin.elapsed().as_secs_f64())
                };
                found.push(check.with_file(file));
                if let Some(path) = coloured.get(index).filter(|_| !intersections.is_empty()) {
                    let red = intersecting_triangles(&topology, &intersections);
                    files.add(path.clone(), |out| coloured_ply(&positions, topology.triangles(), &red, out))?;
                }
            }
            before = Some((topology, detector));
            progress.set_steps(index as u64 + 1);
        }
        Ok(found)
    }

    /// Returns the names of the coloured files on request, one for each mesh. Refuses files that could not be written, before
    /// long work.
    fn coloured_files(&self) -> Result<Vec<PathBuf>, Failure> {
        let Some(folder) = &self.ply else {
            return Ok(Vec::new());
        };
        let mut meshes = BTreeMap::new();
        let mut files = Vec::new();
        for path in &self.meshes {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let file = folder.join(format!("{stem}-intersections.ply"));
            if let Some(other) = meshes.insert(file.clone(), path) {
                return Err(format!(
                    "{} and {} would both be written to {}; check them separately, with two folders",
                    other.display(),
                    path.display(),
                    file.display()
                )
                .into());
            }
            files.push(file);
        }
        OutputFiles::check_folder(folder)?;
        Ok(files)
    }
}

/// Returns whether it is another frame of the mesh.
fn is_frame_of(topology: &Topology, frame: &Topology) -> bool {
    topology.vertex_count() == frame.vertex_count() && topology.triangles() == frame.triangles()
}
