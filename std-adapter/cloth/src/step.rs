//! One time step as its phases see it: forces, then constraints, on positions of all vertices.
//!
//! Vertices of bodies and pinned ones are **kinematic**: they follow a given motion, as if their mass were infinite.

use super::energy::{Configuration, StoredEnergy};
use super::world::Pose;
use selvedge_core::glam::DVec3;
use std::fmt::Debug;

/// What all phases of a step, or of a part of one, read.
#[derive(Clone, Copy, Debug)]
pub struct TimeStep<'a> {
    /// The time at the start of the step, in seconds.
    pub time: f64,
    /// Its length in seconds: a step may be done in parts.
    pub h: f64,
    /// Positions at the start, in metres: the cloth's vertices, then the bodies'.
    pub start: &'a [DVec3],
    /// Per vertex, in 1/kg; zero where it is kinematic. For constraints it is less where something [holds](Memory::hold) the vertex.
    pub inverse_masses: &'a [f64],
    /// Vertices that something holds, and by how much heavier each is, in kg. `inverse_masses` has it.
    pub(crate) held: &'a [(u32, f64)],
    /// Of each kinematic motion, at the start and at the end.
    pub(crate) poses: &'a [[Pose; 2]],
}

/// Changes velocities before positions are predicted.
///
/// A step that cannot be made is tried again in parts: what a force does must depend on its arguments alone.
pub trait Force: Debug + Send + Sync {
    /// Adds to `velocities`, in m/s, of all vertices; those of kinematic ones are not looked at.
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]);

    /// The energy that it holds; `None` if it holds none. Asked when somebody wants to know, never in a step.
    fn energy(&self, _: &Configuration<'_>) -> Option<StoredEnergy> {
        None
    }

    /// Takes a new wind, in m/s; false: it knows of no wind.
    #[doc(hidden)]
    fn set_wind(&mut self, _velocity: DVec3) -> bool {
        false
    }
}

/// Moves predicted positions towards where they should be.
///
/// A step that cannot be made is tried again in parts: what a constraint does must depend on its arguments alone.
pub trait Constraint: Debug + Send + Sync {
    /// Moves `positions`, in metres, of all vertices whose inverse mass is not zero. `touches` is for effects that push things
    /// apart.
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches);

    /// The energy that it holds; `None` if it holds none. Asked when somebody wants to know, never in a step.
    fn energy(&self, _: &Configuration<'_>) -> Option<StoredEnergy> {
        None
    }

    /// What it remembers from step to step, on which its projections then depend as well; `None`, always, if it remembers nothing.
    fn memory(&self) -> Option<&dyn Memory> {
        None
    }

    /// The same, to be changed.
    fn memory_mut(&mut self) -> Option<&mut dyn Memory> {
        None
    }
}

/// What a constraint remembers from step to step. It changes only when a step, or a part of one, was made: those that could not be made leave no
/// trace. It is in checkpoints.
pub trait Memory {
    /// Adds the vertices that it holds, and by how many kg each is heavier for all constraints of a step of `h` seconds.
    fn hold(&self, _h: f64, _held: &mut Vec<(u32, f64)>) {}

    /// A step was made, from `step.start`, and this is where everything came to.
    fn settle(&mut self, step: &TimeStep<'_>, positions: &[DVec3]);

    /// All of it: always as many numbers, all finite.
    fn numbers(&self) -> Vec<f64>;

    /// Takes back what [`numbers`](Self::numbers) were once.
    fn recall(&mut self, numbers: &[f64]);

    /// What each of its [`numbers`](Self::numbers) is about, in terms that do not change when cloth tears. Then effects register anew, and what they put
    /// there takes back the numbers of the keys that it has as well. None, as here: it always has as many numbers, about the same things.
    fn keys(&self) -> Vec<[u32; 4]> {
        Vec::new()
    }

    /// What has let go of its vertices so far.
    fn released(&self) -> Vec<Release> {
        Vec::new()
    }
}

/// A vertex that was held and is free now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Release {
    /// The group that it was in, in the order of the scene.
    pub group: usize,
    /// Of the cloth.
    pub vertex: u32,
    /// When the step began in which it let go, in seconds.
    pub time: f64,
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
pub struct Touches {
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
