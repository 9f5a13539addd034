//! The start of a solve: where inertia and constant forces lead, and where the solve begins.
//!
//! **Order.** With the velocity v, the change Δv by constant forces, and v₋ and x₋ one step before, a step of second order (BDF2)
//! has
//!
//! ```text
//! y = 4/3·x − 1/3·x₋ + h(8/9·v − 2/9·v₋ + 4/9·Δv),   M = 9/4·m/h²,   v′ = (3x′ − 4x + x₋)/2h,
//! ```
//!
//! and a step of first order (implicit Euler) y = x + h(v + Δv), M = m/h², v′ = (x′ − x)/h. The second order throws back what
//! stops: x′ = x gives v′ = −v₀/2. So a vertex that a contact presses takes steps of first order, and so does a vertex that the
//! certificate has moved. The others take steps of second order, if the step is as long as the last one.
//!
//! **Drag.** Still air that slows a vertex at the rate k adds ½k·r·M|x − b|² with b and r of v′ = (x′ − b)/r. So cloth at rest
//! does not feel it, and any rate is stable.
//!
//! **The first guess.** Cloth at rest should have no force left at the first guess, or conjugate gradients that end early would
//! leave some of it as speed. Cloth in motion should begin where it goes. So the guess is x + h·v, with as much of the constant
//! force as the last step let the vertex follow. What something presses begins where it is, moved with what presses it; what
//! slides begins without its motion along the normal.

use super::Prediction;
use super::contact_row::ContactRow;
use crate::model::step::TimeStep;
use selvedge_core::glam::DVec3;
use serde::{Deserialize, Serialize};

/// Two steps are equally long if their lengths differ by no more than this share, which is rounding.
const EQUAL: f64 = 1e-9;

/// The motion before the present step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct MotionHistory {
    /// The positions and velocities one step before; empty before the second step.
    pub(crate) positions: Vec<DVec3>,
    pub(crate) velocities: Vec<DVec3>,
    /// The length of the last step, in seconds.
    pub(crate) h: f64,
    /// True for vertices that take a step of first order.
    pub(crate) is_first_order: Vec<bool>,
}

impl MotionHistory {
    pub(crate) fn forget(&mut self) {
        self.positions.clear();
        self.velocities.clear();
    }

    /// Moves the earlier motion of some vertices with them: points by one function, directions by the other.
    pub(crate) fn teleport(&mut self, moved: &[bool], point: impl Fn(DVec3) -> DVec3, direction: impl Fn(DVec3) -> DVec3) {
        let vectors = self.positions.iter_mut().zip(&mut self.velocities);
        for ((position, velocity), _) in vectors.zip(moved).filter(|(_, moves)| **moves) {
            (*position, *velocity) = (point(*position), direction(*velocity));
        }
    }

    /// Returns the length of the last step in seconds, if it is known.
    pub(crate) fn last_step_seconds(&self) -> Option<f64> {
        self.is_known().then_some(self.h)
    }

    /// Returns whether the last step was as long as one of `h` seconds.
    pub(crate) fn was_as_long_as(&self, h: f64) -> bool {
        self.is_known() && (self.h - h).abs() <= EQUAL * h
    }

    fn is_known(&self) -> bool {
        !self.positions.is_empty()
    }

    /// Records an accepted step of `h` seconds that began with these positions and velocities.
    pub(crate) fn record(&mut self, positions: &[DVec3], velocities: &[DVec3], h: f64) {
        for (own, new) in [(&mut self.positions, positions), (&mut self.velocities, velocities)] {
            own.clear();
            own.extend_from_slice(new);
        }
        self.h = h;
    }
}

/// The prediction of one vertex: its base, the way from there without drag, k·r for a drag of the rate k, and the rate r.
struct Own {
    base: DVec3,
    displacement: DVec3,
    slowing: f64,
    rate: f64,
}

/// Fills the prediction for `count` vertices of cloth. `velocities` are those at the start of the step, `forced` those after
/// forces; `drag` is the rate at which still air slows each vertex, in 1/s, or empty, and comes with whether steps may be of
/// second order; `ends` has the positions of kinematic vertices at the end of the step.
pub(crate) fn predict(
    prediction: &mut Prediction,
    step: &TimeStep<'_>,
    history: &MotionHistory,
    [velocities, forced]: [&[DVec3]; 2],
    (drag, may_be_second): (&[f64], bool),
    ends: &[DVec3],
    count: usize,
) {
    let Prediction {
        goal,
        masses,
        base,
        rate,
    } = prediction;
    for all in [&mut *goal, &mut *base] {
        all.clear();
    }
    masses.clear();
    rate.clear();
    let h = step.h;
    let is_second = may_be_second && history.was_as_long_as(h);
    for vertex in 0..count {
        let (x, inverse_mass) = (step.start[vertex], step.inverse_masses[vertex]);
        if !(inverse_mass > 0.0) {
            goal.push(ends[vertex]);
            masses.push(0.0);
            base.push(x);
            rate.push(h);
            continue;
        }
        let mass = (inverse_mass * h * h).recip();
        let slowing = drag.get(vertex).map_or(0.0, |rate| rate * h);
        let own = if is_second && !history.is_first_order[vertex] {
            let (before, v, v_before) = (history.positions[vertex], velocities[vertex], history.velocities[vertex]);
            let change = forced[vertex] - v;
            Own {
                base: (x * 4.0 - before) / 3.0,
                displacement: (v * 8.0 - v_before * 2.0 + change * 4.0) * (h / 9.0),
                slowing: slowing * 2.0 / 3.0,
                rate: h * 2.0 / 3.0,
            }
        } else {
            Own {
                base: x,
                displacement: forced[vertex] * h,
                slowing,
                rate: h,
            }
        };
        // Drag pulls towards the base: m/r²·(|x − base − way|² + k·r·|x − base|²)/2.
        goal.push(own.base + own.displacement / (1.0 + own.slowing));
        masses.push(mass * (h / own.rate).powi(2) * (1.0 + own.slowing));
        base.push(own.base);
        rate.push(own.rate);
    }
    goal.extend_from_slice(&ends[count..]);
}

/// Fills the first guess.
pub(crate) fn guess(
    x: &mut Vec<DVec3>,
    step: &TimeStep<'_>,
    history: &MotionHistory,
    [velocities, forced]: [&[DVec3]; 2],
    ends: &[DVec3],
    count: usize,
) {
    let h = step.h;
    x.clear();
    for vertex in 0..count {
        if !(step.inverse_masses[vertex] > 0.0) {
            x.push(ends[vertex]);
            continue;
        }
        let v = velocities[vertex];
        let straight = step.start[vertex] + v * h;
        let pull = forced[vertex] - v;
        let squared = pull.length_squared();
        let followed = if history.is_known() && squared > 0.0 {
            let change = (v - history.velocities[vertex]) * (h / history.h);
            (change.dot(pull) / squared).clamp(0.0, 1.0)
        } else {
            0.0
        };
        x.push(straight + pull * (h * followed));
    }
    x.extend_from_slice(&ends[count..]);
}

/// Moves the guess of vertices that something presses.
pub(crate) fn hold_pressed(rows: &[ContactRow], step: &TimeStep<'_>, x: &mut [DVec3], count: usize) {
    let is_free = |vertex: usize| vertex < count && step.inverse_masses[vertex] > 0.0;
    for row in rows.iter().filter(|row| row.push > 0.0) {
        // The motion of the kinematic side.
        let mut drift = row.drift;
        for (vertex, weight) in row.parts().filter(|(vertex, _)| !is_free(*vertex)) {
            drift -= (x[vertex] - step.start[vertex]) * weight;
        }
        for (vertex, weight) in row.parts().filter(|(vertex, _)| is_free(*vertex)) {
            let drift = if row.is_with_body {
                drift * weight.signum()
            } else {
                DVec3::ZERO
            };
            let start = step.start[vertex];
            if !row.is_at_bound() {
                x[vertex] = start + drift;
            } else if row.is_with_body {
                let displacement = x[vertex] - start - drift;
                x[vertex] -= row.normal * displacement.dot(row.normal);
            }
        }
    }
}

/// Returns the velocity of each vertex of cloth at the end of a step.
pub(crate) fn velocities(prediction: &Prediction, step: &TimeStep<'_>, x: &[DVec3], is_pressed: &[bool], out: &mut Vec<DVec3>) {
    out.clear();
    for (vertex, x) in x.iter().enumerate() {
        let is_first_order = is_pressed.get(vertex).is_none_or(|pressed| *pressed);
        out.push(if is_first_order {
            (*x - step.start[vertex]) / step.h
        } else {
            (*x - prediction.base[vertex]) / prediction.rate[vertex]
        });
    }
}
