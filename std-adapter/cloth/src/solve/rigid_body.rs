//! A free rigid body in a step: its six unknowns, and its inertia.
//!
//! **Unknowns.** The way of the centre of mass since the start of the step, and the turn since then, as a rotation vector θ.
//!
//! **Inertia.** ½M|c − y|² for the centre, as for a vertex. For the turn ½(θ − θ*)ᵀÎ(θ − θ*), where θ* is the free motion, and Î
//! the inertia there over the square of the rate. The gradient for small rotations from the left is J⁻ᵀÎ(θ − θ*), and the second
//! derivative J⁻ᵀÎJ⁻¹, with the left Jacobian J of exp. The free motion keeps the angular momentum: θ* = θ₀ + r·I(θ*)⁻¹L*, so
//! that gyroscopic moments cost nothing in the solve. Steps are of first and second order as those of
//! [vertices](super::prediction), with L in the place of v.

use crate::model::length::shortened;
use crate::model::rigid::{Freedom, RigidMotion, RigidState, outer, rotation_by, trace, turned, vector_of};
use crate::world::Free;
use selvedge_core::glam::{DMat3, DVec3};
use std::ops::Range;

/// The rounds of the fixed-point iteration for the free turn. Each gains a factor of about the turn in the step.
const ROUNDS: usize = 8;
/// The least turn, in radians, whose Jacobian differs from its series up to the first order by more than rounding.
const SMALL_TURN: f64 = 1e-4;
/// The start of a solve follows the acceleration of the last step up to so many m/s²: twice the Earth's gravity. What rests needs
/// no more, and a blow does not last.
const FOLLOWED: f64 = 20.0;

/// A free body in a step.
#[derive(Clone, Debug)]
pub(crate) struct RigidBody {
    /// Its number in the scene.
    pub(crate) carrier: usize,
    /// The motion so far: where the solve is.
    pub(crate) motion: RigidMotion,
    pub(super) freedom: Freedom,
    /// The inertia in the axes of the body.
    pub(super) inertia: DMat3,
    /// The rotation since the start of the step.
    pub(super) rotated: DMat3,
    /// M, the way that leads to y, and its base and rate: see [`Prediction`](super::Prediction).
    pub(super) weight: f64,
    pub(super) goal: DVec3,
    pub(super) base: DVec3,
    pub(crate) rate: f64,
    /// θ*, Î, θ₀ and L*.
    pub(super) goal_turn: DVec3,
    pub(super) of_turn: DMat3,
    pub(super) momentum: DVec3,
    /// The velocity and the angular momentum after gravity, or after what an engine applies to a proxy.
    pub(super) forced: DVec3,
    pub(super) started: DVec3,
    /// The velocity and the angular velocity to add to those of the step's motion: corrections of momentum, less the speeds that
    /// rows which started too near have made.
    pub(super) correction: [DVec3; 2],
}

/// The data with which a step begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepOfBody {
    pub(crate) h: f64,
    pub(crate) gravity: DVec3,
    /// True if the last step was as long as this one, and steps may be of second order.
    pub(crate) may_be_second: bool,
    /// The length of the last step in seconds; `None` in the first step.
    pub(crate) before: Option<f64>,
}

impl RigidBody {
    /// Makes a body at its first guess.
    pub(crate) fn new(carrier: usize, vertices: Range<usize>, free: &Free, step: StepOfBody) -> Self {
        let h = step.h;
        let [acceleration, torque] = match &free.proxy {
            Some(proxy) => proxy.applied,
            None => [step.gravity, DVec3::ZERO],
        };
        let RigidState {
            rotation,
            centre,
            velocity,
            momentum,
        } = free.state;
        let before = &free.before;
        let is_second = step.may_be_second && !free.is_first_order;
        let freedom = free.freedom;
        let change = acceleration * freedom.translation * h;
        let momentum = momentum + torque * h;
        let (base, displacement, rate, base_turn, momentum) = if is_second {
            let displacement = (velocity * 8.0 - before.velocity * 2.0 + change * 4.0) * (h / 9.0);
            let last_turn = vector_of(rotation * before.rotation.inverse());
            let base = (centre - before.centre) / 3.0;
            (
                base,
                displacement,
                h * 2.0 / 3.0,
                last_turn / 3.0,
                (momentum * 4.0 - before.momentum - torque * (2.0 * h)) / 3.0,
            )
        } else {
            (DVec3::ZERO, (velocity + change) * h, h, DVec3::ZERO, momentum)
        };
        let at_start = free.state.turned(&free.mass.inertia);
        let inertia_after = |turn: DVec3| turned(&DMat3::from_quat(rotation_by(turn)), &at_start);
        let mut goal_turn = base_turn;
        for _ in 0..ROUNDS {
            goal_turn = base_turn + freedom.inverse_inertia(&inertia_after(goal_turn)) * momentum * rate;
        }
        let mut body = Self {
            carrier,
            motion: RigidMotion {
                vertices,
                riders: free.riders.clone(),
                points: free.points.clone(),
                mass: free.mass.mass,
                rotation,
                centre,
                displacement: base + displacement,
                turn: goal_turn,
            },
            freedom,
            inertia: free.mass.inertia,
            rotated: DMat3::IDENTITY,
            weight: free.mass.mass / (rate * rate),
            goal: base + displacement,
            base,
            rate,
            goal_turn,
            of_turn: inertia_after(goal_turn) * (rate * rate).recip(),
            momentum,
            forced: velocity + change,
            started: free.state.momentum + torque * h,
            correction: [DVec3::ZERO; 2],
        };
        body.find_rotation();
        let motion = body.guess(free, step);
        body.place(motion);
        body
    }

    /// Returns the motion at which the solve begins: that of the last step with all of its acceleration. What a heavy body still
    /// has to gain would be a false force.
    pub(super) fn guess(&self, free: &Free, StepOfBody { h, before, .. }: StepOfBody) -> RigidMotion {
        let Some(last) = before else {
            return RigidMotion {
                displacement: free.state.velocity * h,
                ..self.motion.clone()
            };
        };
        let acceleration = (free.state.velocity - free.before.velocity) / last;
        let acceleration = shortened(acceleration, FOLLOWED);
        let change = free.spin_of(&free.state) - free.spin_of(&free.before);
        RigidMotion {
            displacement: (free.state.velocity + acceleration * h) * h,
            turn: self.goal_turn + change * (h / last * h),
            ..self.motion.clone()
        }
    }

    /// The goal, where everything but contact leads.
    pub(crate) fn goal(&self) -> RigidMotion {
        RigidMotion {
            displacement: self.goal,
            turn: self.goal_turn,
            ..self.motion.clone()
        }
    }

    /// Moves the body to where another motion ends.
    pub(crate) fn place(&mut self, motion: RigidMotion) {
        self.motion = motion;
        self.find_rotation();
    }

    pub(super) fn find_rotation(&mut self) {
        self.rotated = DMat3::from_quat(rotation_by(self.motion.turn));
    }

    /// Maps a point that moves with the body from the start of the step to where the solve is.
    pub(crate) fn carry(&self, point: DVec3) -> DVec3 {
        self.rotated * (point - self.motion.centre) + self.motion.end_centre()
    }

    /// Returns the inertia about the centre of mass, in the axes of the scene, where the solve is.
    pub(super) fn inertia_now(&self) -> DMat3 {
        turned(&DMat3::from_quat(self.motion.end_rotation()), &self.inertia)
    }

    /// Returns J⁻¹ of the turn, for small rotations from the left.
    pub(super) fn inverse_jacobian(&self) -> DMat3 {
        let turn = self.motion.turn;
        let squared = turn.length_squared();
        let cross = cross(turn);
        let second = if squared > SMALL_TURN * SMALL_TURN {
            let angle = squared.sqrt();
            let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
            squared.recip() - (1.0 + cosine) / (2.0 * angle * sine)
        } else {
            1.0 / 12.0
        };
        DMat3::IDENTITY - cross * 0.5 + cross * cross * second
    }

    /// Returns the gradient of inertia, for both slots.
    pub(super) fn gradient(&self) -> [DVec3; 2] {
        let of_displacement = (self.motion.displacement - self.goal) * self.weight;
        let of_turn = self.inverse_jacobian().transpose() * (self.of_turn * (self.motion.turn - self.goal_turn));
        [of_displacement, of_turn]
    }

    /// Returns the energy of inertia, in J.
    pub(super) fn energy(&self) -> f64 {
        let (displacement, turn) = (self.motion.displacement - self.goal, self.motion.turn - self.goal_turn);
        0.5 * self.weight * displacement.length_squared() + 0.5 * turn.dot(self.of_turn * turn)
    }

    /// Returns M, and the second derivative for the slot of the turn.
    pub(super) fn curvature(&self) -> (f64, DMat3) {
        let jacobian = self.inverse_jacobian();
        (self.weight, jacobian.transpose() * self.of_turn * jacobian)
    }

    /// Returns the state at the end of a step, of first order if something presses the body.
    pub(crate) fn end(&self, h: f64, is_pressed: bool) -> RigidState {
        let inertia = self.inertia_now();
        let (velocity, momentum) = if is_pressed {
            (self.motion.displacement / h, inertia * self.motion.turn / h)
        } else {
            let [_, torque] = self.gradient();
            (
                (self.motion.displacement - self.base) / self.rate,
                self.momentum + torque * self.rate,
            )
        };
        let [speed, spin] = self.correction;
        RigidState {
            rotation: self.motion.end_rotation(),
            centre: self.motion.end_centre(),
            velocity: velocity + speed,
            momentum: momentum + inertia * spin,
        }
    }

    /// Returns what a step of first order of `h` seconds has made of the body's momentum.
    pub(super) fn balance(&self, h: f64, correction: Correction) -> Balance {
        let RigidState { velocity, momentum, .. } = self.end(h, true);
        let end = self.motion.end_centre();
        Balance {
            mass: self.motion.mass,
            start: self.motion.centre,
            base: match correction {
                Correction::Motion => end - velocity * h,
                Correction::Velocity => end,
            },
            end,
            velocities: [self.forced, velocity],
            momenta: [self.started, momentum],
            inertia: self.inertia_now(),
        }
    }

    /// Returns the square of a displacement and a turn, in the norm of the inertia.
    pub(super) fn norm_squared(&self, displacement: DVec3, turn: DVec3) -> f64 {
        self.weight * displacement.length_squared() + turn.dot(self.of_turn * turn)
    }

    /// Returns what the body yields to a push of 1 N in a direction at an arm, in m/N.
    pub(super) fn compliance(&self, arm: DVec3, direction: DVec3) -> f64 {
        let moment = arm.cross(direction);
        let along = (direction * self.freedom.translation).length_squared();
        along / self.weight + moment.dot(self.freedom.inverse_inertia(&self.of_turn) * moment)
    }

    /// Returns what it yields to an impulse, in m/s per N·s.
    pub(super) fn mobility(&self, arm: DVec3, direction: DVec3) -> f64 {
        let moment = arm.cross(direction);
        let along = (direction * self.freedom.translation).length_squared();
        along / self.motion.mass + moment.dot(self.freedom.inverse_inertia(&self.inertia_now()) * moment)
    }
}

/// The part of a motion that a correction of momentum changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Correction {
    /// Positions and velocities.
    Motion,
    /// Velocities alone: positions are certified.
    Velocity,
}

/// The momentum of a body before a step, with what gravity adds to it, and after it.
pub(crate) struct Balance {
    mass: f64,
    /// The centre of mass at the start.
    start: DVec3,
    /// The centre of mass at the end, without the part of the way that the velocity after the step makes and a correction moves.
    base: DVec3,
    end: DVec3,
    velocities: [DVec3; 2],
    /// The angular momenta about the centre of mass.
    momenta: [DVec3; 2],
    /// The inertia about it, at the end.
    inertia: DMat3,
}

/// The sums of bodies for a correction. Velocities change by its displacements over so many seconds.
pub(crate) struct Sums {
    /// The masses over these seconds.
    pub(crate) total: f64,
    /// The centres of mass, each times that.
    pub(crate) centre: DVec3,
    /// The momentum that a displacement adds over the step, in N/m.
    pub(crate) yields: f64,
    /// The momentum that the step has added besides gravity, over its length.
    pub(crate) added: DVec3,
}

/// Returns the sums of bodies after a step of `h` seconds.
pub(crate) fn sums_of_bodies(bodies: &[Balance], h: f64, seconds: f64) -> Sums {
    let mut sums = Sums {
        total: 0.0,
        centre: DVec3::ZERO,
        yields: 0.0,
        added: DVec3::ZERO,
    };
    for body in bodies {
        let [before, after] = body.velocities;
        let weight = body.mass / seconds;
        sums.total += weight;
        sums.centre += body.end * weight;
        sums.yields += weight / h;
        sums.added += (after - before) * (body.mass / h);
    }
    sums
}

/// Returns the moment about `centre` that bodies lack once all are displaced by `shift`, and Σ m/s·q·aᵀ of the arms q at the end
/// and a at the base, with what gives the bodies' inertia.
pub(crate) fn moments_of_bodies(bodies: &[Balance], centre: DVec3, shift: DVec3, seconds: f64) -> (DVec3, DMat3) {
    let (mut moment, mut arms) = (DVec3::ZERO, DMat3::ZERO);
    for body in bodies {
        let arm = body.base - centre;
        let [before, after] = body.velocities;
        let [kept, found] = body.momenta;
        moment += (body.start - centre).cross(before * body.mass) + kept;
        moment -= arm.cross((after + shift / seconds) * body.mass) + found;
        // The inertia is the trace of the arms without them.
        let of_body = DMat3::from_diagonal(DVec3::splat(0.5 * trace(body.inertia))) - body.inertia;
        arms += (outer((body.end - centre) * body.mass, arm) + of_body) * seconds.recip();
    }
    (moment, arms)
}

/// Returns the matrix of v × x.
pub(super) fn cross(v: DVec3) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(0.0, v.z, -v.y),
        DVec3::new(-v.z, 0.0, v.x),
        DVec3::new(v.y, -v.x, 0.0),
    )
}
