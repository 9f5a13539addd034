//! What an effect is to the rest: how its table is read, and what it puts into the plan.

use crate::effects::plan::{Fabric, Plan};
use crate::input::{SceneError, Table, ValueError};
use crate::world::{Cloth, SceneParts};
use std::fmt::Debug;

/// Something that acts on the cloth: one of [`effects`](crate::effects), or a caller's own.
///
/// `Debug` is to show every setting: checkpoints tell scenes apart by it.
pub trait Effect: Debug + Send + Sync {
    /// As scene files and reports call it.
    fn name(&self) -> &'static str;

    /// Whether its settings make sense, alone and with this cloth and these bodies.
    ///
    /// # Errors
    /// Which of them does not, and what would.
    fn check(&self, _world: &SceneParts<'_>) -> Result<(), ValueError> {
        Ok(())
    }

    /// Says what effects that register before it must know.
    #[doc(hidden)]
    fn announce(&self, _fabric: &mut Fabric) {}

    /// On what it acts at a time: how often it registers in a scene of several cloths.
    fn scope(&self) -> Scope {
        Scope::Cloth
    }

    /// Of what of a cloth it acts: on a cloth without that it does not register.
    fn acts_on(&self) -> ActsOn {
        ActsOn::Vertices
    }

    /// Whether its settings make sense with what all cloths' effects have announced.
    #[doc(hidden)]
    fn check_fabrics(&self, _world: &SceneParts<'_>, _fabrics: &[Fabric]) -> Result<(), ValueError> {
        Ok(())
    }

    /// Puts what the effect does into the plan of a step: once for each cloth on which it acts, or once for the scene. And again, of other meshes,
    /// whenever cloth has torn.
    fn register(&self, plan: &mut Plan<'_>);

    /// What it says of the fabric, for people to read: each property in words, and its value with its unit.
    fn fabric(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// What trades time for accuracy, with its unit.
    fn settings(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }
}

/// On what an effect acts at a time, where a scene has several cloths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// On each cloth by itself: what it puts into the plan sees the vertices of that cloth alone, numbered as in its mesh. A cloth may
    /// have [its own](crate::Cloth::add), and one that has none, in a scene that has none either, is left alone.
    Cloth,
    /// The same, but it has to do with what cloths do to each other: all have one, or none.
    AllCloths,
    /// On the whole scene: it sees the vertices of all cloths, one after the other in the order of the scene, then those of bodies.
    Scene,
}

/// What an effect needs of a cloth to have something to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActsOn {
    /// Its vertices, which all have.
    Vertices,
    /// Its triangles, which ropes do not have.
    Triangles,
    /// Its loose edges: ropes, laces, fringes.
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

    /// What is told where there is none of it: in a cloth, or in all cloths.
    pub(super) fn complaint(self, effect: &str, cloth: Option<&Cloth>) -> String {
        let (what, instead) = match self {
            Self::Vertices => ("vertices", ""),
            Self::Triangles => ("triangles", "; what ropes resist is `rope_stretch` and `rope_bend`"),
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

/// An effect that scenes can call for.
pub(crate) struct Registration {
    /// The keys of its table.
    pub(crate) keys: &'static [&'static str],
    /// It makes no sense unless one of these is there too; if any are named.
    pub(crate) needs: &'static [&'static str],
    pub(crate) read: Read,
}

impl Registration {
    /// Whether the effect `name` has something to act on, among the effects that are there.
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
