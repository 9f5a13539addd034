//! Traces of core's kernels, for proofs about their computations. This crate is never published.
//!
//! | module | contents |
//! |---|---|
//! | [`symbols`] | core's kernels on symbols: what they compute, in which steps |
//! | [`gappa`] | scripts for Gappa, written from such traces |
//! | [`coq`] | terms for Coq, written from such traces |
//! | [`accepted`] | the comparison of these texts with the accepted ones |

#![allow(clippy::must_use_candidate, reason = "what traces and texts return is all that they do")]

pub mod accepted;
mod beyond;
pub mod coq;
pub mod gappa;
mod kernels;
mod narrowed;
mod programs;
mod runs;
pub mod symbols;

/// A file that a prover reads: its name and its text.
pub type Text = (String, String);

/// A prover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Prover {
    /// The scripts of [`gappa`], for `verification/gappa/check.sh`.
    Gappa,
    /// The terms of [`coq`], for `verification/proofs/check.sh`.
    Coq,
}

impl Prover {
    /// All provers.
    pub const ALL: [Self; 2] = [Self::Gappa, Self::Coq];

    /// Returns its name on the command line and in the list of accepted terms.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gappa => "gappa",
            Self::Coq => "coq",
        }
    }

    /// Returns the texts that the current code gives the prover.
    pub fn texts(self) -> Vec<Text> {
        match self {
            Self::Gappa => gappa::scripts(),
            Self::Coq => [coq::files(), beyond::files()].concat(),
        }
    }

    /// Returns the texts that the prover checks itself, so that nobody has to accept them: programs of the terms, and runs.
    pub fn checked_texts(self) -> Vec<Text> {
        match self {
            Self::Gappa => Vec::new(),
            Self::Coq => vec![programs::file(), runs::file()],
        }
    }
}
