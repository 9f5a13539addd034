//! One time step: what all of its phases read, the forces, and the state that terms keep.
//!
//! Vertices of bodies and pinned vertices are **kinematic**: they follow a prescribed motion, as if their mass were infinite.

use super::energy::{Configuration, StoredEnergy};
use crate::world::{Kinematic, Pose};
use selvedge_core::glam::DVec3;
use std::fmt::Debug;

pub(crate) use crate::world::{Carrier, FREE};

/// The data that all phases of a step, or of a part of one, read.
#[derive(Clone, Copy, Debug)]
pub struct TimeStep<'a> {
    /// The time at the start of the step, in seconds.
    pub time: f64,
    /// The length in seconds. A step may be split into parts.
    pub h: f64,
    /// Positions at the start, in metres: the cloth's vertices, then the bodies'.
    pub start: &'a [DVec3],
    /// Inverse masses per vertex, in 1/kg; zero for kinematic vertices.
    pub inverse_masses: &'a [f64],
    /// The poses of each kinematic motion, at the start and at the end.
    pub(crate) poses: &'a [[Pose; 2]],
    /// These motions, where they are at the end.
    pub(crate) motions: &'a [Kinematic],
}

#[cfg(test)]
impl<'a> TimeStep<'a> {
    /// Makes the first step, in which nothing is carried.
    pub(crate) const fn first(h: f64, start: &'a [DVec3], inverse_masses: &'a [f64]) -> Self {
        let (time, poses, motions) = (0.0, &[] as &[_], &[] as &[_]);
        Self {
            time,
            h,
            start,
            inverse_masses,
            poses,
            motions,
        }
    }
}

/// Changes velocities before positions are predicted.
///
/// A failed step is repeated in parts, so a force must depend on its arguments alone.
pub trait Force: Debug + Send + Sync {
    /// Adds to the velocities of all vertices, in m/s. Those of kinematic vertices are ignored. It may be called several times
    /// for a step, also with the masses of pinned vertices, for the loads on pins. So the result must depend on `step` alone.
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]);

    /// Returns the stored energy, or `None` without any. It is called on request, never in a step.
    fn energy(&self, _: &Configuration<'_>) -> Option<StoredEnergy> {
        None
    }
}

/// The state that a [`Term`](crate::effects::Term) keeps from step to step. It changes only after an accepted step, or part of
/// one; failed steps leave no trace. Checkpoints contain it.
pub trait Memory {
    /// Records an accepted step from `step.start` to `positions`.
    fn settle(&mut self, step: &TimeStep<'_>, positions: &[DVec3]);

    /// Returns the state. The count of numbers never changes, and all are finite.
    fn numbers(&self) -> Vec<f64>;

    /// Restores the state that [`numbers`](Self::numbers) returned.
    fn recall(&mut self, numbers: &[f64]);

    /// Returns a key for each of its [`numbers`](Self::numbers) that does not change when cloth tears. After a tear effects
    /// register again, and the new terms restore the numbers whose keys they share. Without keys, as here, the numbers keep
    /// their meaning.
    fn keys(&self) -> Vec<[u32; 4]> {
        Vec::new()
    }

    /// Returns the vertices of cloth that it holds, each with a vertex of the body that holds it; `None` for something else.
    fn held_by(&self) -> Vec<(u32, Option<u32>)> {
        Vec::new()
    }

    /// Returns the anchors that follow [motions](TimeStep) of their own.
    #[doc(hidden)]
    #[expect(private_interfaces, reason = "no effect outside of this crate has such anchors")]
    fn anchors(&self) -> Vec<MovedAnchor> {
        Vec::new()
    }

    /// Moves what it remembers of those places that belong to moved vertices.
    fn teleport(&mut self, _is_moved: &[bool], _to: &dyn Fn(DVec3) -> DVec3) {}

    /// Returns the vertices released so far.
    fn released(&self) -> Vec<Release> {
        Vec::new()
    }
}

/// An anchor that follows a motion as a pinned vertex does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovedAnchor {
    /// The vertex that it pulls.
    pub(crate) vertex: u32,
    pub(crate) carrier: Carrier,
    /// Its index among the points of the motion; `None` on a body.
    pub(crate) index: Option<u32>,
    /// Where it is without any motion.
    pub(crate) rest: DVec3,
    /// Where it is now.
    pub(crate) place: DVec3,
}

impl MovedAnchor {
    /// Returns the place at the end of a step. It stays where it is if that body deforms, as pinned vertices do.
    pub(crate) fn end_position(&self, step: &TimeStep<'_>) -> DVec3 {
        let carrier = self.carrier as usize;
        let at = step.motions[carrier].point(&step.poses[carrier][1], self.index, self.rest);
        at.unwrap_or(self.place)
    }
}

/// A vertex that was held and has been released.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Release {
    /// Its group, in the order of the scene.
    pub group: usize,
    /// The vertex of the cloth.
    pub vertex: u32,
    /// The start of the step in which it was released, in seconds.
    pub time: f64,
}
