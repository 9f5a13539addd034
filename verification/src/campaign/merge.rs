//! Joins the shards of a run.

use super::{Chunks, Findings, Progress};
use std::path::PathBuf;
use thiserror::Error;

/// The reason why shards cannot be joined.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Refusal {
    #[error("no shards: name the state file of each")]
    NoShards,
    /// The program that wrote the state does not know its commit, so it may be any program.
    #[error("{file}: written by a program that does not know its commit; build it with verification/cluster/build.sh", file = .0.display())]
    UnknownCommit(PathBuf),
    #[error("{first} and {other}: different runs, as {name} is {ours} in one and {theirs} in the other",
        first = .files[0].display(), other = .files[1].display())]
    Different {
        files: [PathBuf; 2],
        name: String,
        ours: String,
        theirs: String,
    },
    #[error("{file}: unfinished, {done} of {chunks} chunks; resume it: {command}", file = .file.display())]
    Unfinished {
        file: PathBuf,
        done: u64,
        chunks: u64,
        /// The command that it was last started with.
        command: String,
    },
    #[error("{first} and {second}: chunks {begin} to {last} are in both", first = .files[0].display(), second = .files[1].display())]
    Overlap {
        files: [PathBuf; 2],
        /// The first chunk of both.
        begin: u64,
        /// The last of the consecutive chunks that both have.
        last: u64,
    },
    #[error("chunks {begin} to {last} are in no shard: between {before} and {after}",
        before = name(.before.as_ref(), "the run's beginning"), after = name(.after.as_ref(), "its end"))]
    Gap {
        before: Option<PathBuf>,
        after: Option<PathBuf>,
        begin: u64,
        /// The last of the consecutive missing chunks.
        last: u64,
    },
}

fn name(file: Option<&PathBuf>, otherwise: &str) -> String {
    file.map_or(otherwise.to_owned(), |file| file.display().to_string())
}

/// Joins finished shards, in any order, to the state that a single run over all chunks would have, with the same digest. Shards
/// of different counts (`1/2`, `3/4`, `4/4`) can be joined if together they have each chunk once.
///
/// # Errors
/// Returns an error if a shard is unfinished, of another run or of an unknown commit. A chunk in no shard or in two is also an
/// error. The [`Refusal`] names the files.
pub fn merge<F: Findings>(mut shards: Vec<(PathBuf, Progress<F>)>) -> Result<Progress<F>, Refusal> {
    let (first, one) = shards.first().ok_or(Refusal::NoShards)?;
    for (file, shard) in &shards {
        if let Some([name, ours, theirs]) = one.settings.difference(&shard.settings) {
            return Err(Refusal::Different {
                files: [first.clone(), file.clone()],
                name,
                ours,
                theirs,
            });
        }
        if shard.settings.commit.is_none() {
            return Err(Refusal::UnknownCommit(file.clone()));
        }
        if !shard.is_finished() {
            return Err(Refusal::Unfinished {
                file: file.clone(),
                done: shard.done.len(),
                chunks: shard.range.end - shard.range.start,
                command: shard.command.clone(),
            });
        }
    }
    // Empty shards come first, of which several may begin at one place.
    shards.sort_by_key(|(_, shard)| (shard.range.start, shard.range.end));
    is_tiled(&shards)?;
    let mut shards = shards.into_iter().map(|(_, shard)| shard);
    let mut all = shards.next().ok_or(Refusal::NoShards)?;
    for shard in shards {
        all.digest += shard.digest;
        all.found.join(shard.found);
    }
    all.range = 0..all.settings.chunks;
    all.done = Chunks::from(all.range.clone());
    Ok(all)
}

/// Checks that each chunk of the run is in one shard. Shards are sorted by their first chunk.
fn is_tiled<F>(shards: &[(PathBuf, Progress<F>)]) -> Result<(), Refusal> {
    let chunks = shards.first().map_or(0, |(_, shard)| shard.settings.chunks);
    let mut before: Option<(&PathBuf, u64)> = None;
    let gap = |before: Option<(&PathBuf, u64)>, after: Option<&PathBuf>, end: u64| Refusal::Gap {
        before: before.map(|(file, _)| file.clone()),
        after: after.cloned(),
        begin: before.map_or(0, |(_, end)| end),
        last: end - 1,
    };
    for (file, shard) in shards.iter().filter(|(_, shard)| !shard.range.is_empty()) {
        let end_before = before.map_or(0, |(_, end)| end);
        if shard.range.start > end_before {
            return Err(gap(before, Some(file), shard.range.start));
        }
        if let Some((other, end)) = before.filter(|&(_, end)| shard.range.start < end) {
            return Err(Refusal::Overlap {
                files: [other.clone(), file.clone()],
                begin: shard.range.start,
                last: end.min(shard.range.end) - 1,
            });
        }
        before = Some((file, shard.range.end));
    }
    match before.map_or(0, |(_, end)| end) {
        end if end < chunks => Err(gap(before, None, chunks)),
        _ => Ok(()),
    }
}
