//! The interface of an effect: how its table is read, and what it registers.

use crate::Identify;
use crate::effects::plan::{Fabric, Plan};
use crate::input::{SceneError, Table, ValueError};
use crate::world::{Cloth, SceneParts};
use std::fmt::Debug;

/// An effect on cloth: one of [`effects`](crate::effects), or your own. An effect of your own needs a line
/// [`identify!`](crate::identify), since checkpoints must know its settings.
pub trait Effect: Debug + Identify + Send + Sync {
    /// Returns the name in scene files and reports.
    fn name(&self) -> &'static str;

    /// Checks the settings, alone and with the scene's cloths and bodies.
    ///
    /// # Errors
    /// Returns an error if a setting is invalid. The message says which values are valid.
    fn check(&self, _world: &SceneParts<'_>) -> Result<(), ValueError> {
        Ok(())
    }

    /// Announces properties that effects need before any of them registers.
    #[doc(hidden)]
    fn announce(&self, _fabric: &mut Fabric) {}

    /// Returns whether the effect registers for each cloth or for the whole scene.
    fn scope(&self) -> Scope {
        Scope::Cloth
    }

    /// Returns the part of a cloth on which the effect acts. It does not register for a cloth without that part.
    fn acts_on(&self) -> ActsOn {
        ActsOn::Vertices
    }

    /// Checks the settings with the announced properties of all cloths.
    #[doc(hidden)]
    fn check_fabrics(&self, _world: &SceneParts<'_>, _fabrics: &[Fabric]) -> Result<(), ValueError> {
        Ok(())
    }

    /// Registers forces and terms with the plan of a step: once for each cloth, or once for the scene. It is called again,
    /// with new meshes, whenever cloth has torn.
    fn register(&self, plan: &mut Plan<'_>);

    /// Returns properties of the fabric for display, each with its value and unit.
    fn fabric(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// Returns the settings that trade time for accuracy, each with its value and unit.
    fn settings(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }
}

/// The extent of an effect in a scene of several cloths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Each cloth by itself. The forces of the effect see the vertices of that cloth alone, numbered as in its mesh. Its terms
    /// number vertices as the scene does, from the first of [`Plan::vertices`] on. A cloth may have [its
    /// own](crate::Scene::add_to) effect.
    Cloth,
    /// Each cloth by itself. The effect concerns pairs of cloths, so all cloths must have it if one has.
    AllCloths,
    /// The whole scene. The effect sees the vertices of all cloths in the order of the scene, then those of bodies.
    Scene,
}

/// The part of a cloth on which an effect acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActsOn {
    /// Vertices, which all cloths have.
    Vertices,
    /// Triangles, which ropes do not have.
    Triangles,
    /// Loose edges: ropes, laces, fringes.
    LooseEdges,
}

impl ActsOn {
    pub(super) fn is_in(self, cloth: &Cloth) -> bool {
        match self {
            Self::Vertices => true,
            Self::Triangles => cloth.has_triangles(),
            Self::LooseEdges => cloth.has_loose_edges(),
        }
    }

    /// Returns the message for a cloth, or a scene, without that part.
    pub(super) fn complaint(self, effect: &str, cloth: Option<&Cloth>) -> String {
        let (what, instead) = match self {
            Self::Vertices => ("vertices", ""),
            Self::Triangles => ("triangles", "; ropes use `rope_stretch` and `rope_bend`"),
            Self::LooseEdges => (
                "loose edges",
                "; those of shape \"rope\" do, and those of a file with lines `l` for which `linear_density` is given",
            ),
        };
        let none = cloth.map_or_else(
            || format!("no cloth has {what}"),
            |cloth| format!("the cloth '{}' has no {what}", cloth.name),
        );
        format!("'{effect}' has nothing to act on: {none}{instead}")
    }
}

/// Reads an effect's table; [`check`](Effect::check) follows.
type Read = fn(&Table<'_>, &SceneParts<'_>) -> Result<Box<dyn Effect>, SceneError>;

/// An effect that scene files may name.
pub(crate) struct Registration {
    pub(crate) keys: &'static [&'static str],
    /// Effects of which at least one must be present; empty if it needs none.
    pub(crate) needs: &'static [&'static str],
    pub(crate) read: Read,
}

impl Registration {
    pub(super) const fn new(keys: &'static [&'static str], read: Read) -> Self {
        let needs = &[];
        Self { keys, needs, read }
    }

    pub(super) const fn needing(self, needs: &'static [&'static str]) -> Self {
        Self { needs, ..self }
    }

    /// Checks that one of the effects that `name` needs is present.
    pub(crate) fn check_needs(&self, name: &str, is_there: impl Fn(&str) -> bool) -> Result<(), ValueError> {
        if self.needs.is_empty() || self.needs.iter().any(|other| is_there(other)) {
            return Ok(());
        }
        let message = format!(
            "'{name}' has nothing to act on: it needs [effects.{}] in the scene",
            self.needs.join("] or [effects.")
        );
        Err(ValueError::new("", message))
    }
}
