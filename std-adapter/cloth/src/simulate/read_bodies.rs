//! The motion of free bodies, for callers.

use super::simulation::Simulation;
use selvedge_core::glam::DVec3;

/// The motion of a [free](crate::BodyMotion::Free) body: [`Simulation::body_motion`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeBodyState {
    /// The mass, in kg.
    pub mass: f64,
    /// The centre of mass, in m.
    pub centre: DVec3,
    /// The velocity of the centre of mass, in m/s.
    pub velocity: DVec3,
    /// The angular velocity, in rad/s.
    pub spin: DVec3,
    /// The angular momentum about the centre of mass, in kg·m²/s.
    pub angular_momentum: DVec3,
}

impl Simulation {
    /// Returns the mass and the present motion of a [free](crate::BodyMotion::Free) body; `None` for any other body.
    /// [`placement`](Self::placement) says where its mesh is.
    #[must_use]
    pub fn body_motion(&self, body: usize) -> Option<FreeBodyState> {
        let is_body = body < self.body_names.len();
        let free = is_body.then(|| self.made.motions[body].free()).flatten()?;
        Some(FreeBodyState {
            mass: free.mass.mass,
            centre: free.state.centre,
            velocity: free.state.velocity,
            spin: free.spin_of(&free.state),
            angular_momentum: free.state.momentum,
        })
    }
}
