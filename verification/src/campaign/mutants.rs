//! Changes of core, and whether a test notices them: what `verification/mutants/hunt.py` finds, shard by shard. A chunk is one
//! mutant.

use crate::campaign::{self, Findings};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// What became of a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// A test noticed it. (Which one may differ from run to run: not the fastest is asked first, but the one that noticed most.)
    Noticed,
    /// None did.
    Missed,
    /// It does not compile.
    Unviable,
    /// The rewriting of sources has no place for it.
    Unplaced,
}

/// One mutant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mutant {
    /// As cargo-mutants has it: file, line and what is changed.
    pub name: String,
    /// What became of it.
    pub outcome: Outcome,
}

/// What a run found, by chunk.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Found {
    /// The mutants of finished chunks.
    pub mutants: BTreeMap<u64, Mutant>,
}

/// How far a run has come.
pub type Progress = campaign::Progress<Found>;

impl Findings for Found {
    const CAMPAIGN: &'static str = "mutants";
    type OfChunk = Mutant;

    fn add(&mut self, chunk: u64, mutant: Mutant) {
        self.mutants.insert(chunk, mutant);
    }

    fn join(&mut self, other: Self) {
        self.mutants.extend(other.mutants);
    }

    /// A mutant that no test notices breaks no promise: it is to be looked at.
    fn wrong(&self) -> u64 {
        0
    }
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mutants = || self.found.mutants.values();
        let count = |outcome| mutants().filter(|mutant| mutant.outcome == outcome).count();
        let [noticed, missed, unviable, unplaced] =
            [Outcome::Noticed, Outcome::Missed, Outcome::Unviable, Outcome::Unplaced].map(count);
        let tried = noticed + missed;
        writeln!(
            f,
            "{noticed} of {tried} noticed, {unviable} do not compile, {unplaced} have no place"
        )?;
        let mut names: Vec<_> = mutants().filter(|mutant| mutant.outcome == Outcome::Missed).collect();
        names.sort_by_key(|mutant| &mutant.name);
        names.iter().try_for_each(|mutant| writeln!(f, "missed: {}", mutant.name))
    }
}
