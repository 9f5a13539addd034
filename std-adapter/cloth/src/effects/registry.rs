//! The table of effects.

use super::registration::Registration;
use super::{
    air, air_drag, attachments, bend, body_contact, friction, gravity, inflation, pins, plastic_folds, pressure, rope_bend,
    rope_stretch, seams, self_collision, shear, strain_limit, stretch, tearing,
};

/// All effects, in the order in which they run.
pub(super) const REGISTRY: &[(&str, Registration)] = &[
    ("gravity", gravity::REGISTRATION),
    ("wind", air::wind::REGISTRATION),
    ("wind_field", air::wind_field::REGISTRATION),
    ("inflation", inflation::REGISTRATION),
    ("air_drag", air_drag::REGISTRATION),
    ("pins", pins::REGISTRATION),
    ("attachments", attachments::REGISTRATION),
    ("stretch", stretch::REGISTRATION),
    ("shear", shear::REGISTRATION),
    ("bend", bend::REGISTRATION),
    ("plastic_folds", plastic_folds::REGISTRATION),
    ("internal_pressure", pressure::REGISTRATION),
    ("strain_limit", strain_limit::REGISTRATION),
    ("seams", seams::REGISTRATION),
    ("rope_bend", rope_bend::REGISTRATION),
    ("rope_stretch", rope_stretch::REGISTRATION),
    ("body_contact", body_contact::REGISTRATION),
    ("self_collision", self_collision::REGISTRATION),
    ("friction", friction::REGISTRATION),
    ("tearing", tearing::REGISTRATION),
];

pub(super) fn registration_of(name: &str) -> Option<&'static Registration> {
    let (_, registration) = REGISTRY.iter().find(|(known, _)| *known == name)?;
    Some(registration)
}

/// Returns the place in the order in which effects run; other effects come after those of this crate.
pub(super) fn rank(name: &str) -> usize {
    let place = REGISTRY.iter().position(|(known, _)| *known == name);
    place.unwrap_or(REGISTRY.len())
}

/// Returns the names of all effects.
#[must_use]
pub fn effect_names() -> Vec<&'static str> {
    REGISTRY.iter().map(|(name, _)| *name).collect()
}
