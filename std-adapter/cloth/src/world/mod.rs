//! What a scene is about: cloths at rest, bodies, and the motions that bodies and pins follow.

mod animation;
mod body;
pub(crate) mod cloth;
mod driven;
mod incidence;
mod material;
mod motion;
mod placement;
mod rope;
mod runs;
pub(crate) mod shapes;
pub mod sleeve;

use crate::input::ValueError;
use std::ops::Range;

pub use animation::Animation;
pub use body::Body;
pub use cloth::Cloth;
pub use material::Material;
pub use motion::{BodyMotion, Keyframe, KeyframeMotion};
pub use placement::Placement;

pub(crate) use animation::FASTEST_VERTEX;
pub(crate) use driven::{Driven, Kinematic};
pub(crate) use incidence::Incidence;
pub(crate) use motion::{KEY_TIME, Pose, check_key_time};
pub(crate) use runs::runs;
#[cfg(test)]
pub(crate) use shapes::{capsule, sheet, tube};

/// What effects act on: a scene but for its effects.
#[derive(Clone, Copy, Debug)]
pub struct SceneParts<'a> {
    /// At rest: the one that the effect acts on, the first if it acts on the whole scene.
    pub cloth: &'a Cloth,
    /// All of them, at rest. Vertices of a scene are numbered through them, and then through bodies.
    pub cloths: &'a [Cloth],
    /// What it meets.
    pub bodies: &'a [Body],
    /// In seconds.
    pub time_step: f64,
}

impl<'a> SceneParts<'a> {
    /// Of a scene with these.
    pub(crate) fn new(cloths: &'a [Cloth], bodies: &'a [Body], time_step: f64) -> Result<Self, ValueError> {
        let none = || ValueError::new("cloth", "the scene has no cloth, but needs one or more");
        Ok(Self {
            cloth: cloths.first().ok_or_else(none)?,
            cloths,
            bodies,
            time_step,
        })
    }

    /// The same for an effect that acts on one of the cloths.
    pub(crate) fn of_cloth(self, cloth: Option<usize>) -> Self {
        Self {
            cloth: cloth.map_or(self.cloth, |cloth| &self.cloths[cloth]),
            ..self
        }
    }

    /// Of each cloth, its vertices among the scene's.
    pub(crate) fn vertices_of_cloths(self) -> impl Iterator<Item = Range<usize>> + use<'a> {
        self.cloths.iter().scan(0, |end, cloth| {
            let first = *end;
            *end += cloth.mesh.positions.len();
            Some(first..*end)
        })
    }

    /// The same as the scene was made, of which tears have made more: so effects' settings number them.
    pub(crate) fn vertices_as_made(self) -> impl Iterator<Item = Range<usize>> + use<'a> {
        self.cloths.iter().scan(0, |end, cloth| {
            let first = *end;
            *end += cloth.vertices_as_made();
            Some(first..*end)
        })
    }

    /// Where vertices are now that effects' settings name.
    pub(crate) fn numbered(self, named: &[u32]) -> Vec<u32> {
        let now = |&vertex: &u32| {
            let mut cloths = self.vertices_as_made().zip(self.vertices_of_cloths());
            let own = cloths.find(|(made, _)| made.contains(&(vertex as usize)));
            own.map_or(vertex, |(made, now)| vertex - made.start as u32 + now.start as u32)
        };
        named.iter().map(now).collect()
    }

    /// Of each vertex as the scene was made, whether it is among the `named`.
    pub(crate) fn named(self, named: &[u32]) -> Vec<bool> {
        let mut is_named = vec![false; self.vertices_as_made().map(|own| own.len()).sum()];
        named.iter().for_each(|&vertex| is_named[vertex as usize] = true);
        is_named
    }

    /// How many vertices all cloths have.
    pub(crate) fn cloth_vertices(self) -> usize {
        self.cloths.iter().map(|cloth| cloth.mesh.positions.len()).sum()
    }
}
