//! Effects in scene files.

use super::called::Effects;
use super::registry::{REGISTRY, effect_names, registration_of};
use crate::input::{SceneError, Table, suggestion};
use crate::world::SceneParts;

/// Reads the effects that `[effects]` names, and constructs no other. [`Called::check`](super::Called::check) follows.
pub(crate) fn read(table: &Table<'_>, world: &SceneParts<'_>) -> Result<Effects, SceneError> {
    for (name, place) in table.keys() {
        if registration_of(name).is_none() {
            let message = format!("there is no effect '{name}'{}", suggestion(name, effect_names()));
            return Err(table.complain(place, message));
        }
    }
    read_known(table, world)
}

/// Reads the effects from a table with other keys as well: that of a cloth.
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
