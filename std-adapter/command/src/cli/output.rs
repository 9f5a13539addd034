//! Writes results to standard output and files, completely or not at all.

use super::Failure;
use super::progress::Progress;
use selvedge::glam::DVec3;
use selvedge_files::mesh::{self, CacheFormat, FileFormat, MeshSequence, MeshStep};
use selvedge_files::{FileSource, animation, temporary_file};
use std::fmt;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Prints a result. A reader that closes the pipe early (`| head`) causes no error.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(format!("standard output cannot be written: {error}").into()),
        _ => Ok(()),
    }
}

pub(crate) fn print_json(value: &serde_json::Value) -> Result<(), Failure> {
    print(&format!("{value:#}\n"))
}

pub(crate) fn answer(
    as_json: bool,
    json: impl FnOnce() -> serde_json::Value,
    text: impl FnOnce() -> String,
) -> Result<(), Failure> {
    if as_json { print_json(&json()) } else { print(&text()) }
}

/// Reads the two meshes of a step, and reports repairs.
pub(crate) fn read_step(start: &Path, end: &Path) -> Result<MeshStep, Failure> {
    let step = {
        let _progress = Progress::spinner("reading");
        mesh::read_step(start, end)?
    };
    say(format_args!("{}: {}", start.display(), step.notes));
    Ok(step)
}

/// Reads an animation of a mesh with so many vertices: a point cache, the keys of a glTF animation, or numbered files. Returns
/// the name and the positions of each frame.
pub(crate) fn read_frames(path: &Path, vertex_count: usize) -> Result<Vec<(String, Vec<DVec3>)>, Failure> {
    let _progress = Progress::spinner("reading");
    let name = path.display();
    let frames: Vec<(String, Vec<DVec3>)> = if FileFormat::from_path(path) == Some(FileFormat::Gltf) {
        let figure = animation::read(path, &animation::Choice::default())?;
        let frame = |time| {
            let mut positions = Vec::new();
            figure.positions_at(time, &mut positions);
            (format!("{name} at {time} s"), positions)
        };
        figure.key_times().into_iter().map(frame).collect()
    } else if CacheFormat::from_path(path).is_some() {
        let frames = mesh::read_point_cache(&FileSource::Disk, path, vertex_count)?
            .into_iter()
            .enumerate();
        frames
            .map(|(frame, positions)| (format!("{name} frame {frame}"), positions))
            .collect()
    } else {
        let MeshSequence { frames, files, .. } = mesh::read_sequence(path)?;
        files.iter().map(|file| file.display().to_string()).zip(frames).collect()
    };
    match frames.iter().find(|(_, positions)| positions.len() != vertex_count) {
        None => Ok(frames),
        Some((name, positions)) => Err(format!(
            "{name}: there are {} vertices, but the mesh has {vertex_count}; export both from one mesh",
            positions.len()
        )
        .into()),
    }
}

/// Writes a message to standard error. A closed standard error causes no error.
pub(crate) fn say(message: fmt::Arguments<'_>) {
    let _ = writeln!(io::stderr().lock(), "{message}");
}

/// Writes `1 coordinate was` or `2 coordinates were`.
pub(crate) fn coordinates_were(count: usize) -> String {
    match count {
        1 => "1 coordinate was".to_owned(),
        count => format!("{count} coordinates were"),
    }
}

/// Files that appear together once all of them are complete. Until then none is visible.
#[derive(Debug, Default)]
pub(crate) struct OutputFiles {
    complete: Vec<(NamedTempFile, PathBuf)>,
}

impl OutputFiles {
    /// Refuses a path that cannot be written, before long work.
    pub(crate) fn check(path: &Path) -> Result<(), Failure> {
        if path.is_dir() {
            return Err(unwritable(path, "it is a folder"));
        }
        temporary(path).map(drop)
    }

    /// Creates `folder` if it does not exist, and refuses one that cannot be written to.
    pub(crate) fn check_folder(folder: &Path) -> Result<(), Failure> {
        std::fs::create_dir_all(folder).map_err(|error| unwritable(folder, error))?;
        Self::check(&folder.join("file"))
    }

    /// Writes a file under a temporary name.
    pub(crate) fn add(
        &mut self,
        path: PathBuf,
        write: impl FnOnce(&mut BufWriter<NamedTempFile>) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let mut out = BufWriter::new(temporary(&path)?);
        let written = write(&mut out).and_then(|()| out.flush());
        let file = written
            .and_then(|()| out.into_inner().map_err(io::IntoInnerError::into_error))
            .map_err(|error| unwritable(&path, error))?;
        self.complete.push((file, path));
        Ok(())
    }

    /// Writes the bytes of a file under a temporary name.
    pub(crate) fn add_bytes(&mut self, path: PathBuf, bytes: &[u8]) -> Result<(), Failure> {
        self.add(path, |out| out.write_all(bytes))
    }

    pub(crate) fn publish(self) -> Result<(), Failure> {
        self.publish_and(|path| say(format_args!("wrote {}", path.display())))
    }

    pub(crate) fn publish_quietly(self) -> Result<(), Failure> {
        self.publish_and(|_| {})
    }

    fn publish_and(self, then: impl Fn(&Path)) -> Result<(), Failure> {
        for (file, path) in self.complete {
            file.persist(&path).map_err(|error| unwritable(&path, error.error))?;
            then(&path);
        }
        Ok(())
    }
}

fn temporary(path: &Path) -> Result<NamedTempFile, Failure> {
    temporary_file::beside(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => unwritable(path, "there is no such folder"),
        // The error does not contain the temporary file's name, which would not help the user.
        kind => unwritable(path, io::Error::from(kind)),
    })
}

fn unwritable(path: &Path, reason: impl fmt::Display) -> Failure {
    format!("{}: cannot be written: {reason}", path.display()).into()
}
