//! What a scene is about: the cloth at rest, bodies, and the motions that bodies and pins follow.

mod body;
mod cloth;
mod motion;
mod shapes;

pub use body::Body;
pub use cloth::Cloth;
pub use motion::RigidMotion;

pub(crate) use motion::Pose;
#[cfg(test)]
pub(crate) use shapes::{capsule, sheet, tube};

/// What effects are checked against.
#[derive(Clone, Copy, Debug)]
pub(crate) struct World<'a> {
    pub(crate) cloth: &'a Cloth,
    pub(crate) bodies: &'a [Body],
    /// Seconds.
    pub(crate) time_step: f64,
}
