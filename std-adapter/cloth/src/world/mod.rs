//! What a scene is about: the cloth at rest, bodies, and the motions that bodies and pins follow.

mod animation;
mod body;
mod cloth;
mod driven;
mod motion;
mod placement;
mod shapes;

pub use animation::Animation;
pub use body::Body;
pub use cloth::Cloth;
pub use motion::{Keyframe, Motion, RigidMotion};
pub use placement::Placement;

pub(crate) use driven::{Driven, Kinematic};
pub(crate) use motion::Pose;
#[cfg(test)]
pub(crate) use shapes::{capsule, sheet, tube};

/// What effects act on: a scene but for its effects.
#[derive(Clone, Copy, Debug)]
pub struct SceneParts<'a> {
    /// At rest.
    pub cloth: &'a Cloth,
    /// What it meets.
    pub bodies: &'a [Body],
    /// In seconds.
    pub time_step: f64,
}
