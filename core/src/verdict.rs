/// The result of a test of one primitive pair.
///
/// An enum rather than a `bool`, so that call sites show what they may skip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[must_use = "a verdict decides whether the pair still has to be tested"]
pub enum Verdict {
    /// The pair certainly does not touch at any time in [0, 1], as far as the test guarantees.
    Culled,
    /// Nothing is proven: the pair needs the next test.
    Kept,
}

impl Verdict {
    /// Returns [`Culled`](Self::Culled) if `proven`, otherwise [`Kept`](Self::Kept).
    pub const fn culled_if(proven: bool) -> Self {
        if proven { Self::Culled } else { Self::Kept }
    }

    /// Returns whether the pair needs no further test.
    #[must_use]
    pub const fn is_culled(self) -> bool {
        matches!(self, Self::Culled)
    }

    /// Returns `Culled` if either test culls: two sound tests one after the other.
    pub const fn or(self, other: Self) -> Self {
        Self::culled_if(self.is_culled() || other.is_culled())
    }
}
