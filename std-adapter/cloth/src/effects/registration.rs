//! What an effect is to the rest: how its table is read, and what it puts into the plan.

use crate::input::{SceneError, Table};
use crate::plan::{Fabric, Plan};
use crate::world::World;
use std::fmt::Debug;

/// What a scene's `[effects.NAME]` has been read into.
pub(crate) trait Effect: Debug + Send {
    /// Says what effects that register before it must know.
    fn announce(&self, _fabric: &mut Fabric) {}

    /// Puts what the effect does into the plan.
    fn register(self: Box<Self>, plan: &mut Plan<'_>);

    /// What trades time for accuracy, with its unit.
    fn settings(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }
}

/// Reads an effect's table.
type Read = fn(&Table<'_>, &World<'_>) -> Result<Box<dyn Effect>, SceneError>;

/// An effect that scenes can call for.
pub(crate) struct Registration {
    /// The keys of its table.
    pub(crate) keys: &'static [&'static str],
    /// It makes no sense unless one of these is there too; if any are named.
    pub(crate) needs: &'static [&'static str],
    pub(crate) read: Read,
}
