//! What acts on cloth, one file each: settings as scene files have them, in SI units, for [`Scene::add`](crate::Scene::add), and for
//! [`Cloth::add`](crate::Cloth::add) where one of several cloths has its own.
//!
//! An effect of a caller's own implements [`Effect`], and puts [`Force`]s and [`Constraint`]s into the [`Plan`] of a step; they run after
//! ours and before contact, so that every step is certified whatever they do. `examples/own_effect.rs` has one.
// Adding one of ours takes its own file, a `mod` line, a `pub use` and a line of `REGISTRY`.

mod air;
mod air_drag;
mod anchor;
mod attachments;
mod bend;
mod body_contact;
mod enclosed;
mod friction;
mod gravity;
mod inflation;
mod levels;
mod list;
mod of_cloth;
mod pins;
pub(crate) mod plan;
mod plastic_folds;
mod pressure;
mod registration;
mod rope_bend;
mod rope_stretch;
mod seams;
mod selection;
mod self_collision;
mod shear;
mod strain_limit;
mod stretch;
mod tearing;
mod thickness;
mod vertices;

pub use crate::contact::Thickness;
pub use crate::model::energy::{Configuration, StoredEnergy};
pub use crate::model::step::{Constraint, Force, Memory, Release, TimeStep, Touches};
pub use crate::world::SceneParts;
pub use air::{Air, AirSource, Fan, Vortex, Wind, WindField};
pub use air_drag::AirDrag;
pub use attachments::{AttachmentGroup, Attachments};
pub use bend::Bend;
pub use body_contact::BodyContact;
pub use friction::Friction;
pub use gravity::Gravity;
pub use inflation::{Inflation, PressureKey};
pub use pins::{PinGroup, PinMotion, Pins};
pub use plan::Plan;
pub use plastic_folds::PlasticFolds;
pub use pressure::InternalPressure;
pub use registration::{ActsOn, Effect, Scope};
pub use rope_bend::{RopeBend, RopeShape};
pub use rope_stretch::RopeStretch;
pub use seams::{Seam, Seams};
pub use self_collision::SelfCollision;
pub use shear::Shear;
pub use strain_limit::StrainLimit;
pub use stretch::Stretch;
pub use tearing::{Perforation, Tearing};

use crate::input::{SceneError, Table, suggestion};
use registration::Registration;

pub(crate) use list::{Called, Effects, Wrong};

/// Every effect, in the order in which they run.
const REGISTRY: &[(&str, Registration)] = &[
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

/// Reads the effects that `[effects]` names, and constructs no other; [`Called::check`] follows.
pub(crate) fn read(table: &Table<'_>, world: &SceneParts<'_>) -> Result<Effects, SceneError> {
    for (name, place) in table.keys() {
        if registration_of(name).is_none() {
            let message = format!("there is no effect '{name}'{}", suggestion(name, effect_names()));
            return Err(table.complain(place, message));
        }
    }
    read_known(table, world)
}

/// The same from a table that has other keys as well: a cloth's own.
pub(crate) fn read_known(table: &Table<'_>, world: &SceneParts<'_>) -> Result<Effects, SceneError> {
    let mut effects = Effects::default();
    for (name, registration) in REGISTRY {
        let Some(settings) = table.table(name)? else {
            continue;
        };
        settings.expect_keys(registration.keys)?;
        let effect = (registration.read)(&settings, world)?;
        assert_eq!(effect.name(), *name, "the table of effects names each as it names itself");
        effects.add_shared(effect.into());
    }
    Ok(effects)
}

fn registration_of(name: &str) -> Option<&'static Registration> {
    let (_, registration) = REGISTRY.iter().find(|(known, _)| *known == name)?;
    Some(registration)
}

/// Its place in the order in which effects run; a caller's own come after ours.
fn rank(name: &str) -> usize {
    let place = REGISTRY.iter().position(|(known, _)| *known == name);
    place.unwrap_or(REGISTRY.len())
}

/// The names of all effects.
#[must_use]
pub fn effect_names() -> Vec<&'static str> {
    REGISTRY.iter().map(|(name, _)| *name).collect()
}
