//! What effects ask of contact.

/// What the effects ask for: each with its index among the scene's effects.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactSettings {
    /// Cloth with itself.
    pub(crate) cloth: Option<(usize, Thickness)>,
    /// Cloth with bodies.
    pub(crate) bodies: Option<(usize, Thickness)>,
    /// The largest thickness of [neighbours](super::neighbours), in metres, if they have one of their own.
    pub(crate) neighbours: Option<f64>,
}

/// Two distances: one that contacts aim at, and a smaller one that every step is certified to keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thickness {
    /// In metres.
    pub thickness: f64,
    /// In metres, at most nine tenths of the thickness. The gap between the two is what keeps repairs of a step rare.
    pub separation: f64,
}

impl Thickness {
    /// A thickness in metres, of which every step is certified to keep a tenth.
    #[must_use]
    pub const fn of(thickness: f64) -> Self {
        Self {
            thickness,
            separation: 0.1 * thickness,
        }
    }
}

impl ContactSettings {
    /// What pairs with bodies have to keep, or those of cloth with itself.
    pub(super) fn of(&self, with_body: bool) -> Option<Thickness> {
        let settings = if with_body { self.bodies } else { self.cloth };
        settings.map(|(_, thickness)| thickness)
    }

    pub(super) fn all(&self) -> impl Iterator<Item = Thickness> {
        [self.cloth, self.bodies]
            .into_iter()
            .flatten()
            .map(|(_, thickness)| thickness)
    }
}

/// Pairs that start this much farther apart than their thickness get a constraint too if they come near.
pub(super) const MARGIN: f64 = 2.0 / 3.0;
/// How fast what is too near comes apart, in m/s.
pub(crate) const RECOVERY: f64 = 1.0;

/// Pairs of cloth are neighbours if their boxes are nearer at rest than this, in thicknesses: among them are all whose thickness is
/// half their distance at rest.
pub(super) const NEIGHBOURS_AT_REST: f64 = 2.0;
