//! Counts and times of contact, and reasons why a step failed.

use selvedge::PairKind;
use serde::{Deserialize, Serialize};

/// Counts of one step's contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ContactCounts {
    /// The number of pairs whose moving boxes come within the distance that an effect requests.
    pub candidates: u64,
    /// The number of candidates that the direction stored in the step before did not decide.
    pub looked_at: u64,
    /// The number of contacts that pushed.
    pub pushed: u64,
    /// The number of pairs that were not free on the motion that the solver wanted.
    pub violated: u64,
    /// The number of rounds with zones, after a relaxation that was not enough.
    pub zone_rounds: u64,
    /// The number of vertices that lost more than a tenth of their motion.
    pub held: u64,
    /// The number of times that the step was cut in half.
    pub cuts: u64,
}

impl ContactCounts {
    /// The number of pairs that are left after each stage, in the order of the data flow.
    #[must_use]
    pub fn pairs(&self) -> [(&'static str, u64); 3] {
        [
            ("candidate pairs", self.candidates),
            ("not settled by remembered directions", self.looked_at),
            ("not free, repaired", self.violated),
        ]
    }

    /// The other counts.
    #[must_use]
    pub fn events(&self) -> [(&'static str, u64); 4] {
        [
            ("pairs pushed apart", self.pushed),
            ("rounds with zones", self.zone_rounds),
            ("vertices held back", self.held),
            ("times cut in half", self.cuts),
        ]
    }
}

/// Why a step could not be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Blocker {
    /// The time in the simulation, in seconds.
    pub(crate) time: f64,
    /// The kind of the pair that is in the way.
    pub(crate) kind: PairKind,
    /// The vertices of the pair, those of bodies after the cloth's.
    pub(crate) vertices: [u32; 4],
    /// The body in the way; `None` if it is a pin, or the cloth itself.
    pub(crate) body: Option<usize>,
}

/// The processor time of the parts of contact that effects share, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ContactSeconds {
    /// The time to find candidate pairs.
    pub candidates: f64,
    /// The time to find the pairs that may need a push; the pushes count as time of the solve.
    pub constraints: f64,
    /// The time to prove pairs free.
    pub certificates: f64,
    /// The time to repair steps that are not free.
    pub repairs: f64,
}

impl Blocker {
    /// The pair that is in the way, in words.
    pub(crate) fn pair(&self) -> String {
        described(self.kind, self.vertices)
    }
}

impl ContactSeconds {
    /// The time of each stage, in the order of the data flow.
    #[must_use]
    pub fn stages(&self) -> [(&'static str, f64); 4] {
        [
            ("candidate pairs", self.candidates),
            ("contact set-up", self.constraints),
            ("certificates", self.certificates),
            ("repairs", self.repairs),
        ]
    }
}

/// Formats a pair, as in `the vertex-face pair of vertices 1, 2, 3, 4`.
pub(super) fn described(kind: PairKind, vertices: [u32; 4]) -> String {
    let [a, b, c, d] = vertices;
    format!("the {kind} pair of vertices {a}, {b}, {c}, {d}")
}
