//! What acts on the cloth, one file each: settings as scene files have them, in SI units, for [`Scene::add`](crate::Scene::add).
//!
//! An effect of a caller's own implements [`Effect`], and puts [`Force`]s and [`Constraint`]s into the [`Plan`] of a step; they run after
//! ours and before contact, so that every step is certified whatever they do. `examples/own_effect.rs` has one.
// Adding one of ours takes its own file, a `mod` line, a `pub use` and a line of `REGISTRY`.

mod air_drag;
mod bend;
mod body_contact;
mod friction;
mod gravity;
mod levels;
mod pins;
mod pressure;
mod registration;
mod self_collision;
mod shear;
mod strain_limit;
mod stretch;
mod thickness;
mod wind;

pub use super::contact::Thickness;
pub use super::energy::{Configuration, StoredEnergy};
pub use super::plan::Plan;
pub use super::step::{Constraint, Force, TimeStep, Touches};
pub use super::world::SceneParts;
pub use air_drag::AirDrag;
pub use bend::Bend;
pub use body_contact::BodyContact;
pub use friction::Friction;
pub use gravity::Gravity;
pub use pins::{PinGroup, PinMotion, Pins};
pub use pressure::InternalPressure;
pub use registration::Effect;
pub use self_collision::SelfCollision;
pub use shear::Shear;
pub use strain_limit::StrainLimit;
pub use stretch::Stretch;
pub use wind::Wind;

use super::input::{SceneError, Table, ValueError, suggestion};
use registration::Registration;

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
    air_drag "air_drag"
    pins "pins"
    stretch "stretch"
    shear "shear"
    bend "bend"
    pressure "internal_pressure"
    strain_limit "strain_limit"
    body_contact "body_contact"
    self_collision "self_collision"
    friction "friction"
];

/// Reads the effects that `table` names, and constructs no other.
pub(crate) fn read(table: &Table<'_>, world: &SceneParts<'_>) -> Result<Vec<Box<dyn Effect>>, SceneError> {
    for (name, place) in table.keys() {
        if !REGISTRY.iter().any(|(known, _)| *known == name) {
            let names = REGISTRY.iter().map(|(name, _)| *name);
            let message = format!("there is no effect '{name}'{}", suggestion(name, names));
            return Err(table.complain(place, message));
        }
    }
    let mut effects = Vec::new();
    for (name, registration) in REGISTRY {
        let Some(settings) = table.table(name)? else {
            continue;
        };
        registration
            .check_needs(name, |other| table.has(other))
            .map_err(|error| table.error(name, error.message))?;
        settings.expect_keys(registration.keys)?;
        let effect = (registration.read)(&settings, world)?;
        debug_assert_eq!(effect.name(), *name);
        effect.check(world).map_err(|error| settings.placed(&error))?;
        effects.push(effect);
    }
    Ok(effects)
}

/// Whether the effects make sense, each alone and together.
pub(crate) fn check(effects: &[Box<dyn Effect>], world: &SceneParts<'_>) -> Result<(), ValueError> {
    for effect in effects {
        let name = effect.name();
        let is_there = |other: &str| effects.iter().any(|effect| effect.name() == other);
        let needs = REGISTRY.iter().find(|(known, _)| *known == name);
        needs.map_or(Ok(()), |(_, registration)| registration.check_needs(name, is_there))?;
        effect.check(world).map_err(|error| error.of(name))?;
    }
    Ok(())
}

/// Its place in the order in which effects run; a caller's own come after ours.
pub(crate) fn rank(name: &str) -> usize {
    let place = REGISTRY.iter().position(|(known, _)| *known == name);
    place.unwrap_or(REGISTRY.len())
}

/// The names of all effects.
#[must_use]
pub fn effect_names() -> Vec<&'static str> {
    REGISTRY.iter().map(|(name, _)| *name).collect()
}
