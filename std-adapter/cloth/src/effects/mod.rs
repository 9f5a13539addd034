//! Effects: one file each. Adding one takes its own file, a `mod` line and a line of [`REGISTRY`].

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

use super::input::{SceneError, Table, suggestion};
use super::world::World;
use registration::{Effect, Registration};

/// An effect and its name in scenes.
pub(crate) type Named = (&'static str, Box<dyn Effect>);

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
pub(crate) fn read(table: &Table<'_>, world: &World<'_>) -> Result<Vec<Named>, SceneError> {
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
        let needs = registration.needs;
        if !needs.is_empty() && !needs.iter().any(|other| table.has(other)) {
            let message = format!(
                "'{name}' has nothing to act on: it needs [effects.{}] in the scene",
                needs.join("] or [effects.")
            );
            return Err(table.error(name, message));
        }
        settings.expect_keys(registration.keys)?;
        effects.push((*name, (registration.read)(&settings, world)?));
    }
    Ok(effects)
}

/// The names of all effects.
#[must_use]
pub fn effect_names() -> Vec<&'static str> {
    REGISTRY.iter().map(|(name, _)| *name).collect()
}
