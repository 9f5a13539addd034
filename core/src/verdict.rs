/// What a test says of one primitive pair.
///
/// Not a `bool`, so that what a caller may skip reads as such where it is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[must_use = "a verdict decides whether the pair still has to be tested"]
pub enum Verdict {
    /// The pair certainly does not touch at any time in [0, 1] (as far as the test that says so promises).
    Culled,
    /// Nothing is known: the pair must go on to the next test.
    Kept,
}

impl Verdict {
    /// [`Culled`](Self::Culled) if `proven`, else [`Kept`](Self::Kept).
    pub const fn culled_if(proven: bool) -> Self {
        if proven { Self::Culled } else { Self::Kept }
    }

    /// Whether the pair needs no further test.
    #[must_use]
    pub const fn is_culled(self) -> bool {
        matches!(self, Self::Culled)
    }

    /// Culled if either test culls: two sound tests one after the other.
    pub const fn or(self, other: Self) -> Self {
        Self::culled_if(self.is_culled() || other.is_culled())
    }
}
