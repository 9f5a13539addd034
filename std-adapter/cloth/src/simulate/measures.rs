//! Measurements of a simulation.

/// An effect of the scene, and its processor time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectTime {
    /// The name of the effect, as in the scene.
    pub name: &'static str,
    /// The seconds so far.
    pub seconds: f64,
}

/// The length of the cloth's edges over their length at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeStretch {
    /// The stretch that one in a hundred edges exceeds.
    pub percentile_99: f64,
    /// The stretch of the longest edge.
    pub largest: f64,
}
