//! A contact in the solve: C = n·Σw·x − r ≥ 0, with friction.
//!
//! **Contact.** The augmented Lagrangian is t²/2κ with the push t = max(0, λ − κC), and λ ← t after each Newton step. It is exact
//! when it converges, for any κ. n and w are those of the closest points at the start of the step; on capsules and balls, n
//! follows each Newton step.
//!
//! **Where there is no room**, as between two pads, no position satisfies both sides, and their multipliers would grow without
//! end. But no contact carries more than all that inertia and terms pull: what is beyond can only be pads that press on each
//! other. So λ is at most the sum of those forces. (In a narrow wedge a contact may carry more. Then it gives way a little.)
//! Law of the pinched cloth's speed.
//!
//! **Friction** is bounded by μ times the push that the *last* solve found: the depth of something that lands is not yet a force.
//! With the sliding u since the start of the step and the multiplier f, it sticks with f − κu as long as this is within the
//! bound. Otherwise it slips with the bound in the direction of f − κu. What turns round sticks again.

use super::constants::RECOVERY;
use super::matrix::{Matrix, outer};
use super::rigid::RigidBodies;
use crate::contact::PairKey;
use crate::model::length::{larger, length, shortened, turned_into_plane};
use selvedge_core::glam::{DVec3, Mat3A, Vec3A};
use serde::{Deserialize, Serialize};

/// The name of a contact from step to step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) enum RowKey {
    /// A vertex and a smooth body, by its number.
    Smooth(u32, u32),
    Pair(PairKey),
}

/// What a contact that pushed leaves for the next step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Remembered {
    push: f64,
    grip: DVec3,
    /// The distance at the start, and by how much it was to grow.
    distance: f64,
    asked: f64,
    share: f64,
}

impl Remembered {
    pub(super) fn is_finite(&self) -> bool {
        self.grip.is_finite()
            && [self.push, self.distance, self.asked, self.share]
                .iter()
                .all(|x| x.is_finite())
    }
}

/// The share of what a row asks for that it has to gain. A heavy pile comes apart more slowly than a layer alone.
const LEAST_GAIN: f64 = 0.1;
/// The least share of the recovery, with which a row tries again.
const LEAST_RECOVERY: f64 = 1.0 / 64.0;
/// The share at which a row counts as jammed.
const JAMMED: f64 = 1.0 / 8.0;

/// A contact of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactRow {
    pub(crate) key: RowKey,
    /// The cloth's vertices and those of bodies, with their weights in the distance. Positive weights are on one side.
    pub(crate) vertices: [u32; 4],
    pub(crate) weights: [f64; 4],
    /// n: the direction from the second side to the first.
    pub(crate) normal: DVec3,
    /// r, in m.
    pub(crate) rest: f64,
    /// The thickness, in m.
    pub(crate) thickness: f64,
    pub(crate) is_with_body: bool,
    /// The distance of both sides at the start of the step, in m: with bodies at the start, and at the end of the step.
    pub(crate) distance: f64,
    pub(crate) left: f64,
    /// The share of the [recovery](super::RECOVERY) that a row that starts too near asks for.
    pub(crate) share: f64,
    /// On a smooth body: the radius, and the distance of the vertex from its axis at which the row is at rest, in m.
    pub(crate) radius: f64,
    pub(crate) reach: f64,
    /// Σw·x at the start of the step, and the motion of a smooth body since then.
    pub(crate) start: DVec3,
    pub(crate) drift: DVec3,
    /// The first of its [touches](super::rigid) with free bodies, and their number.
    pub(crate) touches: [u32; 2],
    /// The coefficient of friction.
    pub(crate) friction: f64,
    /// The push λ and the friction, in N.
    pub(crate) push: f64,
    pub(crate) grip: DVec3,
    /// κ, in N/m; zero before it is known.
    pub(crate) stiffness: f64,
    /// True if the row takes part in the linear problem, and the bound of its friction.
    pub(crate) is_active: bool,
    pub(crate) bound: f64,
    /// The direction in which it slips.
    pub(crate) slips: Option<DVec3>,
    /// The impulse of the push that is not motion, in N·s: [`remove_recovery`](Self::remove_recovery).
    pub(crate) removed: f64,
}

/// The forces of a row: the push, the friction, and the energy.
struct Forces {
    push: f64,
    grip: DVec3,
    energy: f64,
}

impl ContactRow {
    pub(crate) fn new(key: RowKey, vertices: [u32; 4], weights: [f64; 4], normal: DVec3, x: &[DVec3]) -> Self {
        let mut row = Self {
            key,
            vertices,
            weights,
            normal,
            rest: 0.0,
            thickness: 0.0,
            is_with_body: false,
            distance: f64::INFINITY,
            left: f64::INFINITY,
            share: 1.0,
            radius: 0.0,
            reach: 0.0,
            start: DVec3::ZERO,
            drift: DVec3::ZERO,
            touches: [0; 2],
            friction: 0.0,
            push: 0.0,
            grip: DVec3::ZERO,
            stiffness: 0.0,
            is_active: false,
            bound: 0.0,
            slips: None,
            removed: 0.0,
        };
        row.start = row.image(x);
        row
    }

    /// Chooses r for a step of `h` seconds, and `reach` from it.
    ///
    /// It is the thickness. A pair that starts nearer comes apart at a [rate](super::RECOVERY), as long as it gains something by
    /// that. Where there is no room, as between two pads, it asks for less and less, down to the distance that it has: no
    /// position satisfies both sides, and their forces would grow without end. Nor does it then resist bodies that come nearer.
    pub(crate) fn choose_rest(&mut self, before: Option<&Remembered>, h: f64) {
        if let Some(before) = before {
            // Friction turns with the surface. What slips stays at its bound.
            (self.push, self.grip) = (before.push, turned_into_plane(before.grip, self.normal));
            let asked = before.asked;
            let has_gained = !(asked > 0.0) || self.distance - before.distance >= LEAST_GAIN * asked;
            self.share = if has_gained {
                (2.0 * before.share).min(1.0)
            } else {
                (0.5 * before.share).max(LEAST_RECOVERY)
            };
        }
        self.rest = self.thickness.min(self.distance) + self.asked(h);
        if self.share <= JAMMED {
            self.rest = self.rest.min(self.left).max(0.0);
        }
        self.reach = self.radius + self.rest;
    }

    /// The distance by which a pair that starts too near is to come apart in a step of `h` seconds.
    fn asked(&self, h: f64) -> f64 {
        (self.thickness - self.distance).max(0.0) * (RECOVERY * h).min(1.0) * self.share
    }

    /// Returns what the next step needs to know of the row.
    pub(crate) fn remembered(&self, h: f64) -> Remembered {
        Remembered {
            push: self.push,
            grip: self.grip,
            distance: self.distance,
            asked: self.asked(h),
            share: self.share,
        }
    }

    /// Removes from velocities the speed at which the row has taken its sides apart because they started too near: a step of `h`
    /// seconds has moved them, but that is not motion (Guendelman, Bridson and Fedkiw 2003 separate the two in the same way).
    pub(crate) fn remove_recovery(&mut self, h: f64, inverse_masses: &[f64], velocities: &mut [DVec3], bodies: &mut RigidBodies) {
        self.removed = 0.0;
        let asked = self.asked(h);
        if !(self.push > 0.0 && asked > 0.0) {
            return;
        }
        let parts = || self.parts().map(|(vertex, weight)| (vertex, weight, inverse_masses[vertex]));
        let mut moved = -self.drift / h;
        let mut mobility = 0.0;
        for (vertex, weight, inverse_mass) in parts() {
            moved += velocities[vertex] * weight;
            mobility += weight * weight * inverse_mass;
        }
        let (of_bodies, removed) = bodies.mobility(self.touches, self.normal);
        mobility += of_bodies;
        let apart = moved.dot(self.normal) + removed;
        if !(apart > 0.0 && mobility > 0.0) {
            return;
        }
        let removed = apart.min(asked / h) / mobility;
        let by = self.normal * removed;
        for (vertex, weight, inverse_mass) in parts() {
            velocities[vertex] -= by * (weight * inverse_mass);
        }
        bodies.remove(self.touches, by);
        self.removed = removed;
    }

    /// Returns whether the row is one of a vertex and a smooth body, whose normal follows the solve.
    pub(crate) const fn is_smooth(&self) -> bool {
        matches!(self.key, RowKey::Smooth(..))
    }

    /// Returns the number of its smooth body, if it is a row of one.
    pub(crate) const fn smooth_body(&self) -> Option<usize> {
        match self.key {
            RowKey::Smooth(_, body) => Some(body as usize),
            RowKey::Pair(_) => None,
        }
    }

    /// Returns whether one of its sides is a free body.
    pub(crate) const fn is_on_free_body(&self) -> bool {
        self.touches[1] > 0
    }

    /// Takes where its free bodies are in the solve.
    pub(crate) fn refresh(&mut self, bodies: &RigidBodies) {
        if !self.is_on_free_body() {
            return;
        }
        if !self.is_smooth() {
            self.drift = bodies.drift(self.touches);
        } else if let Some((drift, on_axis)) = bodies.of_smooth(self.touches) {
            self.drift = drift;
            if let Some(on_axis) = on_axis {
                self.rest = self.normal.dot(on_axis) + self.reach;
            }
        }
    }

    /// The vertices that take part, with their weights.
    pub(crate) fn parts(&self) -> impl Iterator<Item = (usize, f64)> + use<> {
        let all = self.vertices.into_iter().zip(self.weights);
        all.filter(|(_, weight)| *weight != 0.0)
            .map(|(vertex, weight)| (vertex as usize, weight))
    }

    /// Returns Σw·x.
    #[inline(always)]
    fn image(&self, x: &[DVec3]) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for k in 0..4 {
            if self.weights[k] != 0.0 {
                sum += x[self.vertices[k] as usize] * self.weights[k];
            }
        }
        sum
    }

    /// Returns C, in m.
    #[inline(always)]
    pub(crate) fn gap(&self, x: &[DVec3]) -> f64 {
        self.normal.dot(self.image(x)) - self.rest
    }

    /// Returns the sliding since the start of the step.
    #[inline(always)]
    fn sliding(&self, x: &[DVec3]) -> DVec3 {
        let moved = self.image(x) - self.start - self.drift;
        moved - self.normal * moved.dot(self.normal)
    }

    /// Returns whether friction is at its bound.
    pub(crate) fn is_at_bound(&self) -> bool {
        length(self.grip) >= 0.999 * self.friction * self.push
    }

    /// Chooses whether the row takes part in the linear problem. At the start of a solve, `goal` is where everything else wants
    /// to be; a row that pushes there, or pushed in the last step, takes part as well.
    pub(super) fn choose(&mut self, x: &[DVec3], goal: Option<&[DVec3]>) {
        let push = self.push - self.stiffness * self.gap(x);
        self.take_part(push > 0.0 || goal.is_some_and(|goal| self.push > 0.0 || self.gap(goal) < 0.0));
        if goal.is_some() && self.bound > 0.0 {
            let wanted = self.wanted(x);
            self.slips = (length(wanted) > self.bound).then(|| wanted.normalize_or_zero());
        }
    }

    /// The friction that would stop all sliding.
    fn wanted(&self, x: &[DVec3]) -> DVec3 {
        self.grip - self.sliding(x) * self.stiffness
    }

    /// Returns the forces at `x`. In the linear problem (`is_linear`) a row that takes part pulls as well.
    #[inline(always)]
    fn forces(&self, x: &[DVec3], is_linear: bool) -> Forces {
        let mut push = self.push - self.stiffness * self.gap(x);
        if !is_linear && !(push > 0.0) {
            push = 0.0;
        }
        let mut energy = 0.5 * push * push / self.stiffness;
        let mut grip = DVec3::ZERO;
        if self.bound > 0.0 {
            match self.slips {
                None => {
                    grip = self.wanted(x);
                    energy += 0.5 * grip.length_squared() / self.stiffness;
                }
                Some(direction) => {
                    grip = direction * self.bound;
                    energy -= grip.dot(self.sliding(x));
                }
            }
        }
        Forces { push, grip, energy }
    }

    /// Returns the push and the friction on the first side, in N, as the residual at `x` of a step of `h` seconds has
    /// them; `None` if there is none. The part of the push whose motion was [removed](Self::remove_recovery) does not count.
    pub(super) fn push_and_grip(&self, h: f64, x: &[DVec3]) -> Option<[DVec3; 2]> {
        let removed = self.normal * (self.removed / h);
        if self.is_active {
            let Forces { push, grip, .. } = self.forces(x, true);
            return Some([self.normal * push - removed, grip]);
        }
        (self.removed > 0.0).then_some([-removed, DVec3::ZERO])
    }

    /// Returns the energy at `x`.
    #[inline]
    pub(super) fn energy(&self, x: &[DVec3]) -> f64 {
        if !self.is_active && self.push - self.stiffness * self.gap(x) <= 0.0 {
            return 0.0;
        }
        self.forces(x, false).energy
    }

    /// Subtracts the force of an active row from the gradient: as it is, or as the linear problem has it.
    #[inline]
    pub(super) fn add_gradient(&self, x: &[DVec3], is_linear: bool, gradient: &mut [DVec3], bodies: &RigidBodies) {
        if !self.is_active {
            return;
        }
        let Forces { push, grip, .. } = self.forces(x, is_linear);
        let force = self.normal * push + grip;
        let (cloth, _) = gradient.split_at_mut(bodies.first_slot);
        for k in 0..4 {
            if let Some(own) = cloth.get_mut(self.vertices[k] as usize)
                && self.weights[k] != 0.0
            {
                *own -= force * self.weights[k];
            }
        }
        bodies.add_gradient(self.touches, force, gradient);
    }

    /// Adds the second derivative of an active row.
    pub(super) fn add_curvature(&self, x: &[DVec3], matrix: &mut Matrix, bodies: &RigidBodies) {
        if !self.is_active {
            return;
        }
        let normal = self.normal.as_vec3a();
        let mut stiffness = outer(normal * self.stiffness as f32, normal);
        if self.bound > 0.0 {
            let plane = Mat3A::IDENTITY - outer(normal, normal);
            match self.slips {
                None => stiffness += plane * self.stiffness as f32,
                Some(direction) => {
                    let wanted = larger(length(self.wanted(x)), self.bound);
                    let direction = direction.as_vec3a();
                    let across = plane - outer(direction, direction);
                    stiffness += across * (self.stiffness * self.bound / wanted) as f32;
                }
            }
        }
        if self.is_on_free_body() {
            let mut touches = Vec::with_capacity(2);
            bodies.visit(self.touches, &mut |slot, side, arm| touches.push((slot, side, arm)));
            matrix.add_contact_with_bodies(&self.vertices, &self.weights, stiffness, &touches);
        } else {
            matrix.add_contact(&self.vertices, &self.weights, stiffness);
        }
    }

    /// Returns the push after moves, as the linear problem has it.
    pub(super) fn push_after(&self, x: &[DVec3], moves: &[Vec3A], bodies: &RigidBodies) -> f64 {
        self.push - self.stiffness * (self.gap(x) + self.moved(moves, bodies).dot(self.normal))
    }

    /// Takes part in the linear problem, or no more.
    pub(super) fn take_part(&mut self, does: bool) {
        self.is_active = does;
        self.bound = if does { self.friction * self.push } else { 0.0 };
    }

    /// Returns Σ w·move.
    fn moved(&self, moves: &[Vec3A], bodies: &RigidBodies) -> DVec3 {
        let (cloth, _) = moves.split_at(bodies.first_slot);
        let of_cloth = self
            .parts()
            .filter_map(|(vertex, weight)| cloth.get(vertex).map(|own| own.as_dvec3() * weight));
        let of_cloth: DVec3 = of_cloth.sum();
        if self.is_on_free_body() {
            return of_cloth + bodies.moved(self.touches, moves);
        }
        of_cloth
    }

    /// Takes the forces at `x` as multipliers; inertia and terms pull by `all` in sum, in N. Returns the largest change, in m.
    pub(super) fn renew(&mut self, x: &[DVec3], all: f64) -> f64 {
        let gap = self.gap(x);
        if !self.is_active {
            // Its force comes from the next solve.
            (self.push, self.grip) = (0.0, DVec3::ZERO);
            return larger(-gap, 0.0);
        }
        let pressed = self.push - self.stiffness * gap;
        let push = larger(if pressed < all { pressed } else { all }, 0.0);
        let mut grip = DVec3::ZERO;
        if self.friction > 0.0 {
            let wanted = self.wanted(x);
            let has_turned = self.slips.is_some_and(|direction| direction.dot(wanted) <= 0.0);
            let is_slipping = length(wanted) > self.friction * push && !has_turned;
            self.slips = is_slipping.then(|| wanted.normalize_or_zero());
            if !has_turned {
                grip = shortened(wanted, self.friction * push);
            }
        }
        let change = larger((push - self.push).abs(), length(grip - self.grip)) / self.stiffness;
        (self.push, self.grip) = (push, grip);
        change
    }

    /// Prepares the line search along `moves`; returns what the row adds to the slope, and its pieces: the push, its fall along
    /// the whole way in N, and the way in m.
    pub(super) fn along(&self, x: &[DVec3], moves: &[Vec3A], bodies: &RigidBodies) -> Along {
        let moved = self.moved(moves, bodies);
        let apart = moved.dot(self.normal);
        let push = self.push - self.stiffness * self.gap(x);
        let fall = self.stiffness * apart;
        let mut along = Along {
            slope: 0.0,
            bend: if self.is_active { -fall * apart } else { 0.0 },
            piece: (push > 0.0 || push - fall > 0.0).then_some([push, fall, apart]),
        };
        if self.is_active && self.bound > 0.0 {
            along.slope = -self.forces(x, true).grip.dot(moved - self.normal * apart);
        }
        along
    }
}

/// What a row adds to the energy along a way.
pub(super) struct Along {
    /// To its slope.
    pub(super) slope: f64,
    /// To its second derivative: minus what the matrix has of the push.
    pub(super) bend: f64,
    /// The push at the start, its fall along the whole way, and the way.
    pub(super) piece: Option<[f64; 3]>,
}
