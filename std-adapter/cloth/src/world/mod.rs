//! The things in a scene: cloths at rest, bodies, and the motions of bodies and pins.

mod animation;
mod body;
pub(crate) mod cloth;
mod driven;
pub(crate) mod file_mesh;
mod free;
mod keyframes;
mod material;
mod motion;
mod placement;
mod proxy;
mod proxy_frame;
pub(crate) mod read_mesh;
mod rigid_mass;
mod rope;
mod runs;
pub(crate) mod shapes;
pub mod sleeve;
mod start;

use crate::input::ValueError;
use selvedge_core::glam::DVec3;
use std::ops::Range;

pub use animation::Animation;
pub use body::Body;
pub use cloth::Cloth;
pub use free::{FreeMotion, LockedAxes};
pub use keyframes::{Interpolation, Keyframe, KeyframeMotion};
pub use material::Material;
pub use motion::BodyMotion;
pub use placement::Placement;
pub use proxy::BroughtBody;
pub use rigid_mass::BodyMass;

pub(crate) use animation::FASTEST_VERTEX;
pub(crate) use driven::{Driven, Kinematic, NO_VERTEX, put_kinematic};
pub(crate) use file_mesh::FileNumbering;
pub use file_mesh::MeshInFiles;
pub(crate) use free::{Free, KEPT};
pub(crate) use keyframes::{KEY_TIME, check_key_time};
pub(crate) use motion::{Carrier, FREE, Pose};
pub(crate) use runs::runs;
#[cfg(test)]
pub(crate) use shapes::{capsule, sheet, tube};

/// A scene without its effects: the input of an [`Effect`](crate::effects::Effect).
#[derive(Clone, Copy, Debug)]
pub struct SceneParts<'a> {
    /// The cloth on which the effect acts, at rest; the first cloth if the effect acts on the whole scene.
    pub cloth: &'a Cloth,
    /// All cloths, at rest. A scene numbers the vertices of all cloths in order, then those of the bodies.
    pub cloths: &'a [Cloth],
    /// All bodies.
    pub bodies: &'a [Body],
    /// The time step in seconds.
    pub time_step: f64,
}

impl<'a> SceneParts<'a> {
    pub(crate) fn new(cloths: &'a [Cloth], bodies: &'a [Body], time_step: f64) -> Result<Self, ValueError> {
        let none = || ValueError::new("cloth", "the scene has no cloth, but needs one or more");
        Ok(Self {
            cloth: cloths.first().ok_or_else(none)?,
            cloths,
            bodies,
            time_step,
        })
    }

    /// Returns these parts for an effect that acts on one of the cloths.
    pub(crate) fn of_cloth(self, cloth: Option<usize>) -> Self {
        Self {
            cloth: cloth.map_or(self.cloth, |cloth| &self.cloths[cloth]),
            ..self
        }
    }

    /// Returns the range of each cloth's vertices among the scene's.
    pub(crate) fn vertices_of_cloths(self) -> impl Iterator<Item = Range<usize>> + use<'a> {
        self.cloths.iter().scan(0, |end, cloth| {
            let first = *end;
            *end += cloth.mesh.positions.len();
            Some(first..*end)
        })
    }

    /// Returns the range of each cloth's vertices before any cloth tore. Settings of effects use these numbers.
    pub(crate) fn vertices_as_made(self) -> impl Iterator<Item = Range<usize>> + use<'a> {
        self.cloths.iter().scan(0, |end, cloth| {
            let first = *end;
            *end += cloth.vertices_as_made();
            Some(first..*end)
        })
    }

    /// Maps vertices of an effect's settings to their present numbers.
    pub(crate) fn numbered(self, named: &[u32]) -> Vec<u32> {
        let now = |&vertex: &u32| {
            let mut cloths = self.vertices_as_made().zip(self.vertices_of_cloths());
            let own = cloths.find(|(made, _)| made.contains(&(vertex as usize)));
            own.map_or(vertex, |(made, now)| vertex - made.start as u32 + now.start as u32)
        };
        named.iter().map(now).collect()
    }

    /// Returns for each vertex, as numbered before any cloth tore, whether it is in `named`.
    pub(crate) fn named(self, named: &[u32]) -> Vec<bool> {
        let mut is_named = vec![false; self.vertices_as_made().map(|own| own.len()).sum()];
        named.iter().for_each(|&vertex| is_named[vertex as usize] = true);
        is_named
    }

    /// Returns the positions at rest of vertices of an effect's settings. Vertices that do not exist are left out.
    pub(crate) fn positions_of(self, named: &[u32]) -> Vec<DVec3> {
        let at = |vertex: u32| {
            let mut cloths = self.vertices_of_cloths().zip(self.cloths);
            let (own, cloth) = cloths.find(|(own, _)| own.contains(&(vertex as usize)))?;
            Some(cloth.mesh.positions[vertex as usize - own.start])
        };
        self.numbered(named).into_iter().filter_map(at).collect()
    }

    pub(crate) fn cloth_vertices(self) -> usize {
        self.cloths.iter().map(|cloth| cloth.mesh.positions.len()).sum()
    }
}
