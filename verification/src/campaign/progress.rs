//! The state of a run.

use super::{Chunks, Digest, Findings, Shard};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;
use thiserror::Error;

/// The settings of a run. Two runs with equal settings examine the same cases in the same way, and find the same.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// The campaign: [`Findings::CAMPAIGN`].
    pub campaign: String,
    /// The commit that the program was built from, if known.
    pub commit: Option<String>,
    pub seed: u64,
    /// The number of chunks of all shards.
    pub chunks: u64,
    /// The number of cases in a chunk.
    pub cases_per_chunk: u64,
    /// Everything else that the findings depend on, by name.
    pub depends_on: BTreeMap<String, String>,
}

impl Settings {
    /// Returns the first setting that differs: its name, its value here and in `other`.
    pub fn difference(&self, other: &Self) -> Option<[String; 3]> {
        let (ours, theirs) = (self.by_name(), other.by_name());
        let value = |of: &BTreeMap<String, String>, name: &String| of.get(name).cloned().unwrap_or_default();
        let mut names = ours.keys().chain(theirs.keys());
        let name = names.find(|name| ours.get(*name) != theirs.get(*name))?;
        Some([name.clone(), value(&ours, name), value(&theirs, name)])
    }

    fn by_name(&self) -> BTreeMap<String, String> {
        let own = [
            ("campaign", self.campaign.clone()),
            ("commit", self.commit.clone().unwrap_or_else(|| "unknown".to_owned())),
            ("seed", self.seed.to_string()),
            ("number of chunks", self.chunks.to_string()),
            ("cases a chunk", self.cases_per_chunk.to_string()),
        ];
        let own = own.map(|(name, value)| (name.to_owned(), value));
        own.into_iter().chain(self.depends_on.clone()).collect()
    }
}

/// The reason why a run cannot be resumed from a state.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum AnotherRun {
    #[error("the state of another run, whose {name} is {was}, not {is}")]
    Setting { name: String, was: String, is: String },
    /// The state is of another shard of the same run.
    #[error("the state of another shard, of chunks {} to {}, not {} to {}", .was.start, .was.end, .is.start, .is.end)]
    Shard {
        /// The chunks of the state.
        was: Range<u64>,
        /// The chunks of the command line.
        is: Range<u64>,
    },
}

/// The state of a run, or of one shard of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Progress<F> {
    #[serde(flatten)]
    pub settings: Settings,
    /// The command that it was last started with, for the reader. Nothing depends on it.
    pub command: String,
    pub range: Range<u64>,
    pub done: Chunks,
    pub digest: Digest,
    pub found: F,
}

impl<F: Findings> Progress<F> {
    /// Starts a run over whole chunks, of at least `cases` cases in all. Nothing is done or found yet.
    pub fn with_nothing_done(seed: u64, cases: u64, cases_per_chunk: u64, depends_on: &[(&str, String)], nothing: F) -> Self {
        let chunks = cases.div_ceil(cases_per_chunk);
        let depends_on = depends_on.iter().map(|(name, value)| ((*name).to_owned(), value.clone()));
        Self {
            settings: Settings {
                campaign: F::CAMPAIGN.to_owned(),
                commit: None,
                seed,
                chunks,
                cases_per_chunk,
                depends_on: depends_on.collect(),
            },
            command: String::new(),
            range: 0..chunks,
            done: Chunks::default(),
            digest: Digest::default(),
            found: nothing,
        }
    }

    /// Returns the same state of one shard, for a program that was built from that commit and started with that command.
    pub fn of_shard(mut self, shard: Shard, commit: Option<&str>, command: &str) -> Self {
        self.range = shard.range(self.settings.chunks);
        self.settings.commit = commit.map(str::to_owned);
        command.clone_into(&mut self.command);
        self
    }

    /// Resumes the kept state `self` as the run `asked`, under its command.
    ///
    /// # Errors
    /// Returns an error if `asked` is another run or another shard.
    pub fn resume(self, asked: Self) -> Result<Self, AnotherRun> {
        if let Some([name, was, is]) = self.settings.difference(&asked.settings) {
            return Err(AnotherRun::Setting { name, was, is });
        }
        if self.range != asked.range {
            return Err(AnotherRun::Shard {
                was: self.range,
                is: asked.range,
            });
        }
        Ok(Self {
            command: asked.command,
            ..self
        })
    }

    /// Returns whether all chunks of the shard are done.
    pub fn is_finished(&self) -> bool {
        self.done.len() == self.range.end - self.range.start
    }

    /// Returns the number of cases in finished chunks.
    pub fn cases(&self) -> u64 {
        self.done.len() * self.settings.cases_per_chunk
    }

    /// Adds a chunk: its findings, its number, and both to the digest.
    ///
    /// # Panics
    /// Panics if the chunk was added before, since it would count twice.
    pub(super) fn add(&mut self, chunk: u64, found: F::OfChunk) {
        assert!(self.done.insert(chunk), "chunk {chunk} twice");
        self.digest += Digest::of_chunk(chunk, &found);
        self.found.add(chunk, found);
    }

    /// Returns what is inconsistent in the state, if anything is. No program writes such a state.
    pub(super) fn contradiction(&self) -> Option<&'static str> {
        let Range { start, end } = self.range;
        let done = self.done.runs();
        let is_inside = |&[first, last]: &[u64; 2]| start <= first && last <= end;
        if self.settings.campaign != F::CAMPAIGN {
            Some("the state of another campaign")
        } else if start > end || end > self.settings.chunks {
            Some("a range that is not one of the run's chunks")
        } else if !done.iter().all(is_inside) {
            Some("chunks are done that are outside of its range")
        } else {
            None
        }
    }
}
