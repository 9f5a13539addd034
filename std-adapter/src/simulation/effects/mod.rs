//! Effects: one file each. Adding one takes its own file, a `mod` line and a line of [`REGISTRY`].

mod air_drag;
mod bend;
mod body_contact;
mod friction;
mod gravity;
mod membrane;
mod pins;
mod pressure;
mod self_collision;
mod shear;
mod strain_limit;
mod stretch;
mod wind;

use super::plan::Plan;
use super::scene::table::Table;
use super::scene::{SceneError, World, suggestion};
use std::fmt::Debug;

/// What a scene's `[effects.NAME]` has been read into.
pub(crate) trait Effect: Debug + Send {
    /// Puts what the effect does into the plan.
    fn register(self: Box<Self>, plan: &mut Plan<'_>);

    /// What trades time for accuracy, with its unit.
    fn settings(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }
}

/// An effect and its name in scenes.
pub(crate) type Named = (&'static str, Box<dyn Effect>);

/// Reads an effect's table.
type Read = fn(&Table<'_>, &World<'_>) -> Result<Box<dyn Effect>, SceneError>;

/// An effect that scenes can call for.
pub(crate) struct Registration {
    pub(crate) name: &'static str,
    /// The keys of its table.
    pub(crate) keys: &'static [&'static str],
    /// It makes no sense unless one of these is there too; if any are named.
    pub(crate) needs: &'static [&'static str],
    pub(crate) read: Read,
}

/// Every effect, in the order in which they run.
const REGISTRY: [Registration; 12] = [
    gravity::REGISTRATION,
    wind::REGISTRATION,
    air_drag::REGISTRATION,
    pins::REGISTRATION,
    stretch::REGISTRATION,
    shear::REGISTRATION,
    bend::REGISTRATION,
    pressure::REGISTRATION,
    strain_limit::REGISTRATION,
    body_contact::REGISTRATION,
    self_collision::REGISTRATION,
    friction::REGISTRATION,
];

/// Reads the effects that `table` names, and constructs no other.
pub(crate) fn read(table: &Table<'_>, world: &World<'_>) -> Result<Vec<Named>, SceneError> {
    for (name, place) in table.keys() {
        if !REGISTRY.iter().any(|effect| effect.name == name) {
            let names = REGISTRY.iter().map(|effect| effect.name);
            let message = format!("there is no effect '{name}'{}", suggestion(name, names));
            return Err(table.complain(place, message));
        }
    }
    let mut effects = Vec::new();
    for registration in &REGISTRY {
        let name = registration.name;
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
        effects.push((name, (registration.read)(&settings, world)?));
    }
    Ok(effects)
}

/// The names of all effects.
#[must_use]
pub fn effect_names() -> Vec<&'static str> {
    REGISTRY.iter().map(|effect| effect.name).collect()
}
