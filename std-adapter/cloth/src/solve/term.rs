//! A term of the energy that a step minimises.

use super::loads::Pull;
use super::matrix::Matrix;
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::{Memory, TimeStep};
use selvedge_core::glam::DVec3;
use std::fmt::Debug;

/// The positions that inertia and constant forces lead to, for each vertex of cloth.
#[derive(Clone, Debug, Default)]
pub struct Prediction {
    /// The positions y, in metres.
    pub goal: Vec<DVec3>,
    /// The weight M of ½M|x − y|², in N/m: the mass over h², or 9/4 of it in steps of second order; zero for kinematic vertices.
    pub masses: Vec<f64>,
    /// The velocity at the end of the step is (x − base)/rate.
    pub base: Vec<DVec3>,
    /// The rate of each vertex, in seconds.
    pub rate: Vec<f64>,
}

/// The result of [`Term::renew`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Renewed {
    /// The change of the energy at the same positions, in J.
    pub energy: f64,
    /// The largest change of a multiplier over the change that does not matter. The solve goes on while it is above one.
    pub error: f64,
}

/// A term of the energy of a step, with its gradient and second derivative.
///
/// The step finds the positions x with the least sum of ½Σ M|x − y|² and all terms. So a term says what it stores, and never
/// moves anything. Vertices are numbered as in the scene: cloths', then bodies', which are where they are at the end of the step.
///
/// A step may be repeated in parts, so a term must depend on its arguments, and on what it stores as its [`Memory`], alone.
pub trait Term: Debug + Send + Sync {
    /// Prepares for a step whose solve begins at `x`.
    fn begin(&mut self, _step: &TimeStep<'_>, _prediction: &Prediction, _x: &[DVec3]) {}

    /// Adds the gradient at `x`, in N, to that of the cloth's vertices, and returns the energy, in J.
    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64;

    /// Adds the second derivative at the positions of the last gradient. It must be positive semidefinite; an approximation slows
    /// the solve down and does not change its result.
    fn curvature(&mut self, x: &[DVec3], matrix: &mut Matrix);

    /// Adds the second derivative of multipliers, after [`weigh`](Self::weigh) has seen everything else.
    #[doc(hidden)]
    fn curvature_of_multipliers(&mut self, _x: &[DVec3], _matrix: &mut Matrix) {}

    /// Chooses the stiffness of multipliers at `x` from that of everything else. Returns true if it has changed.
    #[doc(hidden)]
    fn weigh(&mut self, _matrix: &Matrix, _x: &[DVec3]) -> bool {
        false
    }

    /// Renews what is constant within a Newton step, such as multipliers, at the positions of the last gradient, and changes
    /// `gradient` accordingly.
    fn renew(&mut self, _x: &[DVec3], _gradient: &mut [DVec3]) -> Renewed {
        Renewed::default()
    }

    /// Forgets all multipliers, as after a checkpoint.
    fn forget(&mut self) {}

    /// Returns the multipliers after the last accepted step, for checkpoints. Their number never changes.
    #[doc(hidden)]
    fn multipliers(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Sets the multipliers that [`multipliers`](Self::multipliers) returned.
    #[doc(hidden)]
    fn set_multipliers(&mut self, _numbers: &[f64]) {}

    /// Takes note of an accepted step. `is_moved` says of each vertex of the scene whether the certificate has moved it away from
    /// where the solve left it.
    fn accept(&mut self, _is_moved: &[bool]) {}

    /// Returns true if the term consists of inner forces between vertices of cloth, whose sum and moment are zero. A step then
    /// keeps the momentum of the pieces that [`joints`](Self::joints) and the edges of the cloth connect.
    fn is_inner(&self) -> bool {
        false
    }

    /// Returns true if the term pushes the cloth from outside, as wind and pressure do.
    fn is_load(&self) -> bool {
        false
    }

    /// Returns the pairs of vertices between which inner forces act, apart from those that edges of the cloth connect.
    fn joints(&self) -> Vec<[u32; 2]> {
        Vec::new()
    }

    /// Returns the stored energy of each effect that the term is made of, by the effect's index; `own` is the effect that has
    /// registered the term. It is called on request, never in a step.
    fn energy(&self, _now: &Configuration<'_>, _own: usize) -> Vec<(usize, StoredEnergy)> {
        Vec::new()
    }

    /// Visits the springs between the cloth and what holds it, at the positions `x` where a solve has ended.
    #[doc(hidden)]
    #[expect(private_interfaces, reason = "no effect outside of this crate holds cloth")]
    fn visit_pulls(&self, _x: &[DVec3], _visit: &mut dyn FnMut(Pull)) {}

    /// Sets a new wind, in m/s. Returns false if the term is no wind.
    #[doc(hidden)]
    fn set_wind(&mut self, _velocity: DVec3) -> bool {
        false
    }

    /// Returns the largest ratio of an edge to its limit at these positions of all vertices; `None` without a limit.
    fn over_limit(&self, _positions: &[DVec3]) -> Option<f64> {
        None
    }

    /// Returns the state that the term keeps from step to step, or `None` if it has none.
    fn memory(&self) -> Option<&dyn Memory> {
        None
    }

    /// Returns the state for changes.
    fn memory_mut(&mut self) -> Option<&mut dyn Memory> {
        None
    }
}
