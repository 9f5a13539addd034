//! One time step as its phases see it: forces, then constraints, on positions of all vertices.
//!
//! Vertices of bodies and pinned ones are **kinematic**: they follow a given motion, as if their mass were infinite.

use super::energy::{Configuration, StoredEnergy};
use crate::world::Pose;
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

/// Σ wᵢ²/mᵢ: how far weighted vertices give way along a direction to a push of one that is shared out by their weights and masses. Zero if
/// none of them can move.
///
/// A push of p moves vertex i by p·wᵢ/mᵢ over that. If what is pinned, or heavy, has nearly all of the weight, a vertex with next to none would have to
/// go far to make up for it: then this is as large as it has to be for none to go farther than twice the push. Free vertices of a face never do
/// if none is more than four times as heavy as another: with r for that, w²·r + (1 − w)²/2 ≥ w·r/2 for all w.
pub(crate) fn mobility<const N: usize>(inverse_masses: &[f64], vertices: [u32; N], weights: [f64; N]) -> f64 {
    let (mut mobility, mut fastest) = (0.0, 0.0_f64);
    for (vertex, weight) in vertices.into_iter().zip(weights) {
        let speed = inverse_masses[vertex as usize] * weight;
        mobility += speed * weight;
        fastest = fastest.max(speed.abs());
    }
    mobility.max(0.5 * fastest)
}

/// Which kinematic motion carries a vertex: its index among them.
pub(crate) type Carrier = u32;
/// None: the solver moves the vertex.
pub(crate) const FREE: Carrier = u32::MAX;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Of a vertex and a point of a face, which may be as near to a corner or a side as rounding leaves it.
    fn weights() -> impl Strategy<Value = [f64; 4]> {
        let share = || prop_oneof![0.0..=1.0, Just(0.0), (-60..0).prop_map(|e| 2.0_f64.powi(e))];
        (share(), share()).prop_map(|(s, t): (f64, f64)| [1.0, -s, -(1.0 - s) * t, -(1.0 - s) * (1.0 - t)])
    }

    proptest! {
        #[test]
        fn no_vertex_goes_farther_than_twice_the_push(
            weights in weights(),
            inverse_masses in prop::array::uniform4(prop_oneof![Just(0.0), 1e-3..1e3_f64]),
        ) {
            let mobility = mobility(&inverse_masses, [0, 1, 2, 3], weights);
            for (inverse_mass, weight) in inverse_masses.into_iter().zip(weights) {
                let way = inverse_mass * weight / mobility;
                prop_assert!(inverse_mass * weight == 0.0 || way.abs() <= 2.0, "{way}");
            }
        }

        /// So that a push does all that it is to do where something can give way.
        #[test]
        fn free_vertices_of_like_masses_share_a_push_by_mass_and_weight_alone(
            weights in weights(),
            inverse_masses in prop::array::uniform4(1.0..4.0_f64),
            is_kinematic in any::<bool>(),
        ) {
            let mut inverse_masses = inverse_masses;
            if is_kinematic {
                inverse_masses[0] = 0.0;
            }
            let all: f64 = inverse_masses.into_iter().zip(weights).map(|(inverse_mass, weight)| inverse_mass * weight * weight).sum();
            let mobility = mobility(&inverse_masses, [0, 1, 2, 3], weights);
            prop_assert!((mobility - all).abs() <= 1e-12 * all, "{mobility} instead of {all}");
        }
    }
}
