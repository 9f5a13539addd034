//! What acts on cloth, one file each: settings as scene files have them, in SI units, for [`Scene::add`](crate::Scene::add), and for
//! [`Cloth::add`](crate::Cloth::add) where one of several cloths has its own.
//!
//! An effect of a caller's own implements [`Effect`], and puts [`Force`]s and [`Constraint`]s into the [`Plan`] of a step; they run after
//! ours and before contact, so that every step is certified whatever they do. `examples/own_effect.rs` has one.
// Adding one of ours takes its own file, a `mod` line, a `pub use` and a line of `REGISTRY`.

mod air_drag;
mod air_sources;
mod anchor;
mod attachments;
mod bend;
mod body_contact;
mod cords;
mod enclosed;
mod friction;
mod gravity;
mod in_air;
mod inflation;
mod levels;
mod list;
mod panels;
mod pins;
mod plastic_folds;
mod pressure;
mod registration;
mod rope_bend;
mod rope_stretch;
mod seams;
mod selection;
mod self_collision;
mod shear;
mod stitches;
mod strain_limit;
mod stretch;
mod tearing;
mod thickness;
mod vertices;
mod wind;
mod wind_field;

pub use super::contact::Thickness;
pub use super::energy::{Configuration, StoredEnergy};
pub use super::plan::Plan;
pub use super::step::{Constraint, Force, Memory, Release, TimeStep, Touches};
pub use super::world::SceneParts;
pub use air_drag::AirDrag;
pub use air_sources::{AirSource, Fan, Vortex};
pub use attachments::{AttachmentGroup, Attachments};
pub use bend::Bend;
pub use body_contact::BodyContact;
pub use friction::Friction;
pub use gravity::Gravity;
pub use inflation::{Inflation, PressureKey};
pub use pins::{PinGroup, PinMotion, Pins};
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
pub use wind::Wind;
pub use wind_field::{Air, WindField};

use super::input::{SceneError, Table, suggestion};
use registration::Registration;

pub(crate) use list::{Called, Effects, Wrong};
pub(crate) use stitches::length_at_end;

/// The registrations of these modules, but for those that `--cfg without_effect="NAME"` leaves out of the program: with it
/// `std-adapter/cloth/instruction-counts/run.sh` shows that an effect costs nothing where it is not named.
macro_rules! registry {
    ($($module:ident $name:literal)*) => {
        &[$(
            #[cfg(not(without_effect = $name))]
            ($name, $module::REGISTRATION),
        )*]
    };
}

/// Every effect, in the order in which they run.
#[rustfmt::skip]
const REGISTRY: &[(&str, Registration)] = registry![
    gravity "gravity"
    wind "wind"
    wind_field "wind_field"
    inflation "inflation"
    air_drag "air_drag"
    pins "pins"
    attachments "attachments"
    stretch "stretch"
    shear "shear"
    bend "bend"
    plastic_folds "plastic_folds"
    pressure "internal_pressure"
    strain_limit "strain_limit"
    seams "seams"
    rope_bend "rope_bend"
    rope_stretch "rope_stretch"
    body_contact "body_contact"
    self_collision "self_collision"
    friction "friction"
    tearing "tearing"
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
