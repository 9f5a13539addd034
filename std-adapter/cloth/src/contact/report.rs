//! What contact says of itself: what it counted, what it took, what was in the way.

use selvedge::PairKind;

/// What one step's contacts were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ContactCounts {
    /// Pairs that moving boxes leave, as far as an effect asks for them.
    pub candidates: u64,
    /// Those that the direction remembered from the step before did not settle.
    pub looked_at: u64,
    /// Contacts that pushed.
    pub pushed: u64,
    /// Pairs that were not free on the motion that the solver wanted.
    pub violated: u64,
    /// Rounds in which zones were carried, where relaxation was not enough.
    pub zone_rounds: u64,
    /// Vertices that were held back: of their motion they lost more than a tenth.
    pub held: u64,
    /// Times the step was cut in half.
    pub cuts: u64,
}

impl ContactCounts {
    /// Pairs that are left after each stage, in the order of the data flow.
    #[must_use]
    pub fn pairs(&self) -> [(&'static str, u64); 3] {
        [
            ("candidate pairs", self.candidates),
            ("not settled by remembered directions", self.looked_at),
            ("not free, repaired", self.violated),
        ]
    }

    /// What else happened.
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
    /// In seconds.
    pub(crate) time: f64,
    /// Of the pair that is in the way.
    pub(crate) kind: PairKind,
    /// Its vertices, those of bodies after the cloth's.
    pub(crate) vertices: [u32; 4],
    /// The body in the way; `None` if it is a pin, or the cloth itself.
    pub(crate) body: Option<usize>,
}

/// Seconds of what effects share.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactSeconds {
    /// Finding candidate pairs.
    pub candidates: f64,
    /// Finding the pairs that may have to be pushed; what pushes them is counted with the effects.
    pub constraints: f64,
    /// Proving pairs free.
    pub certificates: f64,
    /// Repairing steps that are not free.
    pub repairs: f64,
}

impl Blocker {
    /// The pair that is in the way, in words.
    pub(crate) fn pair(&self) -> String {
        described(self.kind, self.vertices)
    }
}

impl ContactSeconds {
    /// Each stage's, in the order of the data flow.
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

/// `the vertex-face pair of vertices 1, 2, 3, 4`.
pub(super) fn described(kind: PairKind, vertices: [u32; 4]) -> String {
    let [a, b, c, d] = vertices;
    format!("the {kind} pair of vertices {a}, {b}, {c}, {d}")
}
