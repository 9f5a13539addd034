//! What a simulation measures of itself.

/// An effect that the scene calls for, and the time that it has taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectTime {
    /// As in the scene.
    pub name: &'static str,
    /// Seconds, so far.
    pub seconds: f64,
}

/// How long the edges of the cloth are, over their lengths at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeStretch {
    /// No more than one in a hundred edges is longer.
    pub percentile_99: f64,
    /// Of the longest.
    pub largest: f64,
}
