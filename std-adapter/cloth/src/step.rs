//! One time step as its phases see it: forces, then constraints, on positions of all vertices.
//!
//! Vertices of bodies and pinned ones are **kinematic**: they follow a given motion, as if their mass were infinite.

use super::world::Pose;
use selvedge_core::glam::DVec3;
use std::fmt::Debug;

/// What all phases of a step, or of a part of one, read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TimeStep<'a> {
    /// The time at the start of the step, in seconds.
    pub(crate) time: f64,
    /// Its length in seconds.
    pub(crate) h: f64,
    /// Positions at the start.
    pub(crate) start: &'a [DVec3],
    /// Per vertex, in 1/kg; zero where it is kinematic.
    pub(crate) inverse_masses: &'a [f64],
    /// Of each kinematic motion, at the start and at the end.
    pub(crate) poses: &'a [[Pose; 2]],
}

/// Changes velocities before positions are predicted.
pub(crate) trait Force: Debug + Send {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]);
}

/// Moves predicted positions towards where they should be.
pub(crate) trait Constraint: Debug + Send {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches);
}

/// One contact that pushed, for friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    pub(crate) vertices: [u32; 4],
    /// Of each vertex in the relative motion; their sum over both sides is zero if both are vertices.
    pub(crate) weights: [f64; 4],
    pub(crate) normal: DVec3,
    /// By how much the contact moved its two sides apart.
    pub(crate) push: f64,
    /// How far the other side moves in this step, if it is no vertex.
    pub(crate) drift: DVec3,
}

/// The contacts that pushed in this step, in order, if anybody wants to know.
#[derive(Debug, Default)]
pub(crate) struct Touches {
    /// Whether friction asks for them.
    pub(crate) wanted: bool,
    pub(crate) list: Vec<Touch>,
}

impl Touches {
    #[inline]
    pub(crate) fn record(&mut self, touch: impl FnOnce() -> Touch) {
        if self.wanted {
            self.list.push(touch());
        }
    }
}

/// Which kinematic motion carries a vertex: its index among them.
pub(crate) type Carrier = u32;
/// None: the solver moves the vertex.
pub(crate) const FREE: Carrier = u32::MAX;
