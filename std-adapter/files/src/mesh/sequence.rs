//! Numbered files as the frames of one mesh.

use super::error::{MeshError, SequenceProblem};
use super::format::FileFormat;
use super::frame_difference::FrameDifference;
use super::load;
use super::options::ReadOptions;
use super::parsed::Parsed;
use crate::FileSource;
use selvedge::Topology;
use selvedge_core::glam::DVec3;
use std::path::{Path, PathBuf};

/// The frames of one mesh, in the order of their numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshSequence {
    /// The triangles of all frames.
    pub triangles: Vec<[u32; 3]>,
    /// The positions of all vertices, frame by frame; there is at least one frame.
    pub frames: Vec<Vec<DVec3>>,
    /// The file of each frame.
    pub files: Vec<PathBuf>,
}

/// Reads numbered OBJ or PLY files as the frames of one mesh. `pattern` is a path whose file name has one run of `#` in place of
/// the number (`body-####.ply`). The number has at least as many digits as there are `#`. It may also be a folder whose mesh
/// files are one such sequence. Frames go from the lowest number to the highest without a gap.
///
/// # Errors
/// Returns the errors of [`read`](super::read) for any of the files. Also returns an error if a file has parts with an area that
/// the reader leaves out. It needs at least one file, and each number once. A frame may not differ from the first in its
/// triangles or its number of vertices; the message then names both files and the first difference.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// for (number, height) in [(9, 0.0), (10, 0.1)] {
///     let text = format!("v 0 0 {height}\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
///     std::fs::write(folder.path().join(format!("leaf-{number:03}.obj")), text)?;
/// }
/// let leaf = selvedge_files::mesh::read_sequence(&folder.path().join("leaf-###.obj"))?;
/// assert_eq!((leaf.triangles.len(), leaf.frames.len()), (1, 2));
/// assert_eq!(leaf.frames[1][0].z, 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_sequence(pattern: &Path) -> Result<MeshSequence, MeshError> {
    read_sequence_from(&FileSource::Disk, pattern)
}

/// Reads numbered files of any source, like [`read_sequence`].
///
/// # Errors
/// Those of [`read_sequence`].
pub fn read_sequence_from(source: &FileSource, pattern: &Path) -> Result<MeshSequence, MeshError> {
    let found = if source.is_folder(pattern) {
        of_folder(source, pattern)
    } else {
        of_pattern(source, pattern)
    };
    let files = found.map_err(|problem| MeshError::Sequence {
        pattern: pattern.to_owned(),
        problem,
    })?;
    let read = |path: &Path| {
        let whole = load(source, path, &ReadOptions::default()).and_then(Parsed::whole);
        whole.map_err(|problem| MeshError::file(path, problem))
    };
    // There is a first file, since empty sequences were refused.
    let mut first = read(&files[0])?;
    let triangles = first.triangles().triangles;
    let topology = Topology::new(first.positions.len(), triangles).map_err(|error| MeshError::file(&files[0], error.into()))?;
    let mut frames = vec![Vec::new()];
    for file in &files[1..] {
        let frame = read(file)?;
        if let Some(difference) = FrameDifference::find(&first, &frame) {
            return Err(MeshError::Frames {
                start: files[0].clone(),
                end: file.clone(),
                difference,
            });
        }
        frames.push(frame.positions);
    }
    frames[0] = std::mem::take(&mut first.positions);
    Ok(MeshSequence {
        triangles: topology.triangles().to_vec(),
        frames,
        files,
    })
}

/// The text before and after a number, and its least number of digits.
#[derive(Clone, Copy)]
struct Names<'a> {
    before: &'a str,
    digits: usize,
    after: &'a str,
}

impl Names<'_> {
    /// Returns the number of a file with such a name.
    fn number(&self, name: &str) -> Option<u64> {
        let digits = name.strip_prefix(self.before)?.strip_suffix(self.after)?;
        let is_number = digits.len() >= self.digits && digits.bytes().all(|byte| byte.is_ascii_digit());
        digits.parse().ok().filter(|_| is_number)
    }
}

fn of_pattern(source: &FileSource, pattern: &Path) -> Result<Vec<PathBuf>, SequenceProblem> {
    let name = pattern.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let first = name.find('#').ok_or(SequenceProblem::Pattern)?;
    let digits = name[first..].bytes().take_while(|&byte| byte == b'#').count();
    let names = Names {
        before: &name[..first],
        digits,
        after: &name[first + digits..],
    };
    if names.after.contains('#') {
        return Err(SequenceProblem::Pattern);
    }
    let folder = match pattern.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    in_order(folder, &listing(source, folder)?, names)
}

fn of_folder(source: &FileSource, folder: &Path) -> Result<Vec<PathBuf>, SequenceProblem> {
    let mut all = listing(source, folder)?;
    all.retain(|name| FileFormat::from_path(Path::new(name)).is_some());
    let Some(one) = all.first() else {
        return Err(SequenceProblem::NoFiles {
            folder: folder.to_owned(),
        });
    };
    // The number is the last run of digits, not the 4 of `v4-body-001.ply`.
    let end = one.rfind(|c: char| c.is_ascii_digit()).map_or(0, |last| last + 1);
    let start = one[..end]
        .rfind(|c: char| !c.is_ascii_digit())
        .map_or(0, |before| before + one[before..].chars().next().map_or(0, char::len_utf8));
    let names = Names {
        before: &one[..start],
        digits: 1,
        after: &one[end..],
    };
    match all.iter().find(|name| names.number(name).is_none()) {
        None => in_order(folder, &all, names),
        Some(other) => Err(SequenceProblem::SeveralSequences {
            one: one.clone(),
            other: other.clone(),
        }),
    }
}

/// Returns the names of all files in a folder, in order.
fn listing(source: &FileSource, folder: &Path) -> Result<Vec<String>, SequenceProblem> {
    source.names(folder).map_err(|error| SequenceProblem::Folder {
        folder: folder.to_owned(),
        error,
    })
}

/// Returns the files with such names in the order of their numbers, without a gap.
fn in_order(folder: &Path, all: &[String], names: Names<'_>) -> Result<Vec<PathBuf>, SequenceProblem> {
    let numbered = all.iter().filter_map(|name| Some((names.number(name)?, name)));
    let mut numbered: Vec<(u64, &String)> = numbered.collect();
    numbered.sort_unstable();
    if numbered.is_empty() {
        return Err(SequenceProblem::NoFiles {
            folder: folder.to_owned(),
        });
    }
    for pair in numbered.windows(2) {
        let [(before, one), (after, other)] = [pair[0], pair[1]];
        if before == after {
            return Err(SequenceProblem::TwiceThere {
                frame: before,
                one: one.clone(),
                other: other.clone(),
            });
        }
        if after - before > 1 {
            return Err(SequenceProblem::MissingFrame {
                missing: before + 1,
                before,
                after,
            });
        }
    }
    Ok(numbered.into_iter().map(|(_, name)| folder.join(name)).collect())
}
