//! The file that a run's state is kept in.

use super::{Findings, Progress};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// What is wrong with a state file.
#[derive(Debug, Error)]
pub enum FileError {
    /// The system says no.
    #[error("{file}: {error}", file = .file.display())]
    System {
        /// The file.
        file: PathBuf,
        /// What it says.
        error: io::Error,
    },
    /// It is no state of this campaign.
    #[error("{file}: no state of this campaign ({why}); delete it, or name another file", file = .file.display())]
    NotAState {
        /// The file.
        file: PathBuf,
        /// What in it is wrong.
        why: String,
    },
}

/// The state in a file, if there is such a file.
///
/// # Errors
/// If it cannot be read, or is no state of this campaign.
pub fn read<F: Findings>(file: &Path) -> Result<Option<Progress<F>>, FileError> {
    let progress: Option<Progress<F>> = read_as(file)?;
    match progress.as_ref().and_then(Progress::contradiction) {
        Some(why) => Err(not_a_state(file, why)),
        None => Ok(progress),
    }
}

/// What [`StateFile::keep`] wrote, whatever it was, if there is such a file.
///
/// # Errors
/// If it cannot be read, or is nothing of the kind.
pub fn read_as<S: DeserializeOwned>(file: &Path) -> Result<Option<S>, FileError> {
    let bytes = match fs::read(file) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(system(file)(error)),
    };
    let state = serde_json::from_slice(&bytes).map_err(|error| not_a_state(file, &error.to_string()))?;
    Ok(Some(state))
}

/// A state file that this process alone writes.
#[derive(Debug)]
pub struct StateFile {
    file: PathBuf,
    /// Of a file beside it, as the file itself is replaced; let go when the process ends, however it does.
    _lock: File,
}

impl StateFile {
    /// Waits while another process has it: one that was started twice, say by a cluster that thought it dead. `waits` is told
    /// so before that.
    ///
    /// # Errors
    /// If the lock beside it cannot be written.
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

    /// Replaces the state in one step: whatever is killed, process or machine, the file holds the old state or the new one.
    ///
    /// # Errors
    /// If it cannot be written.
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
