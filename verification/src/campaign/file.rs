//! The file that holds a run's state.

use super::{Findings, Progress};
use serde::Serialize;
use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

#[derive(Debug, Error)]
pub enum FileError {
    #[error("{file}: {error}", file = .file.display())]
    System { file: PathBuf, error: io::Error },
    /// The file does not hold a state of this campaign.
    #[error("{file}: not a state of this campaign ({why}); delete it, or name another file", file = .file.display())]
    NotAState { file: PathBuf, why: String },
}

/// Reads the state in a file, if there is such a file.
///
/// # Errors
/// Returns an error if the file cannot be read, or does not hold a state of this campaign.
pub fn read<F: Findings>(file: &Path) -> Result<Option<Progress<F>>, FileError> {
    let bytes = match fs::read(file) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(system(file)(error)),
    };
    let progress: Progress<F> = serde_json::from_slice(&bytes).map_err(|error| not_a_state(file, &error.to_string()))?;
    match progress.contradiction() {
        Some(why) => Err(not_a_state(file, why)),
        None => Ok(Some(progress)),
    }
}

/// A state file that only this process writes.
#[derive(Debug)]
pub struct StateFile {
    file: PathBuf,
    /// The lock of a file beside it, since the file itself is replaced. The system releases it when the process ends.
    _lock: File,
}

impl StateFile {
    /// Opens the file. Waits while another process has it, for example one that a cluster wrongly considers dead, and calls
    /// `waits` with a message before that.
    ///
    /// # Errors
    /// Returns an error if the lock file cannot be written.
    pub fn open(file: &Path, waits: impl FnOnce(&str)) -> Result<Self, FileError> {
        let beside = with_ending(file, ".lock");
        let lock = File::create(&beside).map_err(system(&beside))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                waits(&format!("{}: another process has it; waiting for its end", file.display()));
                lock.lock().map_err(system(&beside))?;
            }
            Err(TryLockError::Error(error)) => return Err(system(&beside)(error)),
        }
        Ok(Self {
            file: file.to_owned(),
            _lock: lock,
        })
    }

    /// Replaces the state in one step. If the process or the machine is killed, the file holds the old state or the new one.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn keep(&self, state: &impl Serialize) -> Result<(), FileError> {
        let next = with_ending(&self.file, ".next");
        let write = || {
            let mut file = File::create(&next)?;
            file.write_all(&serde_json::to_vec(state)?)?;
            file.sync_all()?;
            fs::rename(&next, &self.file)
        };
        write().map_err(system(&self.file))
    }
}

fn with_ending(file: &Path, ending: &str) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

fn not_a_state(file: &Path, why: &str) -> FileError {
    FileError::NotAState {
        file: file.to_owned(),
        why: why.to_owned(),
    }
}

fn system(file: &Path) -> impl FnOnce(io::Error) -> FileError {
    let file = file.to_owned();
    |error| FileError::System { file, error }
}
