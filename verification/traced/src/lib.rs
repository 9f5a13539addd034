//! What core's kernels compute, from the kernels themselves, for those who prove something of it; never published.
//!
//! | module | what it is |
//! |---|---|
//! | [`symbols`] | core's kernels on symbols: what they compute, in which steps |
//! | [`gappa`] | scripts for Gappa written from such traces |
//! | [`coq`] | terms for Coq written from such traces |
//! | [`accepted`] | whether what is written is what somebody has accepted |

pub mod accepted;
pub mod coq;
pub mod gappa;
pub mod symbols;

/// A file that a prover reads: its name, and what stands in it.
pub type Text = (String, String);

/// Who reads what is written here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Prover {
    /// The scripts of [`gappa`], for `verification/gappa/check.sh`.
    Gappa,
    /// The terms of [`coq`], for `verification/proofs/check.sh`.
    Coq,
}

impl Prover {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Gappa, Self::Coq];

    /// As it is called on the command line, and in the list of what is accepted.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gappa => "gappa",
            Self::Coq => "coq",
        }
    }

    /// What the code gives it to read now.
    #[must_use]
    pub fn texts(self) -> Vec<Text> {
        match self {
            Self::Gappa => gappa::scripts(),
            Self::Coq => coq::files(),
        }
    }
}
