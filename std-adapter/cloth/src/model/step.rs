//! One time step as its phases see it: forces, then constraints, on positions of all vertices.
//!
//! Vertices of bodies and pinned vertices are **kinematic**: they follow a prescribed motion, as if their mass were infinite.

use super::energy::{Configuration, StoredEnergy};
use crate::world::Pose;
use selvedge_core::glam::DVec3;
use std::fmt::Debug;

/// The data that all phases of a step, or of a part of one, read.
#[derive(Clone, Copy, Debug)]
pub struct TimeStep<'a> {
    /// The time at the start of the step, in seconds.
    pub time: f64,
    /// The length in seconds. A step may be done in parts.
    pub h: f64,
    /// Positions at the start, in metres: the cloth's vertices, then the bodies'.
    pub start: &'a [DVec3],
    /// Per vertex, in 1/kg; zero for kinematic vertices. For constraints it is less where something [holds](Memory::hold) the
    /// vertex.
    pub inverse_masses: &'a [f64],
    /// Vertices that something holds, and their added mass in kg. `inverse_masses` includes it.
    pub(crate) held: &'a [(u32, f64)],
    /// Of each kinematic motion, at the start and at the end.
    pub(crate) poses: &'a [[Pose; 2]],
}

/// Changes velocities before positions are predicted.
///
/// A failed step is tried again in parts, so a force must depend on its arguments alone.
pub trait Force: Debug + Send + Sync {
    /// Adds to `velocities`, in m/s, of all vertices. Those of kinematic vertices are ignored.
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]);

    /// Returns the stored energy; `None` if there is none. It is called on request, never in a step.
    fn energy(&self, _: &Configuration<'_>) -> Option<StoredEnergy> {
        None
    }

    /// Sets a new wind, in m/s. Returns false if the force is no wind.
    #[doc(hidden)]
    fn set_wind(&mut self, _velocity: DVec3) -> bool {
        false
    }
}

/// Moves predicted positions towards the constraint.
///
/// A failed step is tried again in parts, so a constraint must depend on its arguments alone.
pub trait Constraint: Debug + Send + Sync {
    /// Moves `positions`, in metres, of vertices whose inverse mass is not zero. `touches` is for effects that push things apart.
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches);

    /// Returns the stored energy; `None` if there is none. It is called on request, never in a step.
    fn energy(&self, _: &Configuration<'_>) -> Option<StoredEnergy> {
        None
    }

    /// Returns the state that the constraint keeps from step to step, on which its projections depend as well; always `None` if
    /// it has none.
    fn memory(&self) -> Option<&dyn Memory> {
        None
    }

    /// Returns the same state for changes.
    fn memory_mut(&mut self) -> Option<&mut dyn Memory> {
        None
    }
}

/// The state that a constraint keeps from step to step. It changes only after an accepted step, or part of one; failed ones leave
/// no trace. Checkpoints contain it.
pub trait Memory {
    /// Adds the vertices that it holds, each with the mass in kg that it adds for all constraints of a step of `h` seconds.
    fn hold(&self, _h: f64, _held: &mut Vec<(u32, f64)>) {}

    /// Records an accepted step from `step.start` to `positions`.
    fn settle(&mut self, step: &TimeStep<'_>, positions: &[DVec3]);

    /// Returns the state: always as many numbers, all finite.
    fn numbers(&self) -> Vec<f64>;

    /// Restores the state that [`numbers`](Self::numbers) returned.
    fn recall(&mut self, numbers: &[f64]);

    /// Returns a key for each of its [`numbers`](Self::numbers) that does not change when cloth tears. After a tear effects
    /// register again, and the new constraints restore the numbers of the keys that they have as well. Without keys, as here, the
    /// numbers keep their meaning.
    fn keys(&self) -> Vec<[u32; 4]> {
        Vec::new()
    }

    /// Returns the vertices released so far.
    fn released(&self) -> Vec<Release> {
        Vec::new()
    }
}

/// A vertex that was held and has been released.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Release {
    /// Its group, in the order of the scene.
    pub group: usize,
    /// The vertex of the cloth.
    pub vertex: u32,
    /// The begin of the step in which it was released, in seconds.
    pub time: f64,
}

/// One contact that pushed, for friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    pub(crate) vertices: [u32; 4],
    /// The weight of each vertex in the relative motion. If both sides consist of vertices the weights sum to zero.
    pub(crate) weights: [f64; 4],
    pub(crate) normal: DVec3,
    /// The distance by which the contact moved its two sides apart.
    pub(crate) push: f64,
    /// The motion of the other side in this step, if it has no vertices.
    pub(crate) drift: DVec3,
}

/// The contacts that pushed in this step, in order, if friction needs them.
#[derive(Debug, Default)]
pub struct Touches {
    /// Whether friction needs them.
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

/// Returns Σ wᵢ²/mᵢ, the compliance of weighted vertices to a push along a direction that is shared by weight and mass. Zero if
/// none of them can move.
///
/// A push of p moves vertex i by p·wᵢ/mᵢ over that. If a pinned or heavy vertex has nearly all of the weight, a vertex with
/// little weight would move far to compensate. The result is then larger, so that no vertex moves farther than twice the push.
/// Free vertices of a face never do if none is more than four times as heavy as another: with that ratio r, w²·r + (1 − w)²/2 ≥
/// w·r/2 for all w.
pub(crate) fn mobility<const N: usize>(inverse_masses: &[f64], vertices: [u32; N], weights: [f64; N]) -> f64 {
    let (mut mobility, mut fastest) = (0.0, 0.0_f64);
    for (vertex, weight) in vertices.into_iter().zip(weights) {
        let speed = inverse_masses[vertex as usize] * weight;
        mobility += speed * weight;
        fastest = fastest.max(speed.abs());
    }
    mobility.max(0.5 * fastest)
}

/// The kinematic motion of a vertex: its index among the motions.
pub(crate) type Carrier = u32;
/// No motion: the solver moves the vertex.
pub(crate) const FREE: Carrier = u32::MAX;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Weights of a vertex and a point of a face, arbitrarily near to a corner or a side.
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

        /// A push has its full effect where something can move.
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
