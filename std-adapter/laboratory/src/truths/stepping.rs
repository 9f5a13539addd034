//! What the time stepping gives for motions of one degree of freedom, from the lengths of its steps.
//!
//! With the velocity v, and x₋ and v₋ one step before, a step of h has x′ = b + r·v′ and v′ = c + r·f(x′, v′), where f is the
//! acceleration. Steps of first order (implicit Euler) have b = x, c = v and r = h. Steps of second order (BDF2) have b = (4x −
//! x₋)/3, c = (4v − v₋)/3 and r = ⅔h. The first step, and one after a step of another length, is of first order. So is every step
//! of what something presses.

use selvedge_cloth::Accuracy;

/// The largest share by which steps of one length differ, from rounding.
const EQUAL: f64 = 1e-9;

/// A motion with the acceleration a − k·v − ω²·x.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    /// The velocity at the start, in m/s. The position is zero.
    pub(super) velocity: f64,
    /// The constant acceleration a, in m/s².
    pub(super) acceleration: f64,
    /// The rate of drag k, in 1/s.
    pub(super) drag: f64,
    /// The frequency ω, in rad/s.
    pub(super) frequency: f64,
}

impl Motion {
    /// Returns position and velocity after steps of these lengths in seconds, at an accuracy.
    pub(super) fn after(&self, steps: &[f64], accuracy: Accuracy) -> [f64; 2] {
        self.run(steps, accuracy.is_of_second_order())
    }

    /// Returns position and velocity after steps of these lengths in seconds, if something presses.
    pub(super) fn pressed(&self, steps: &[f64]) -> [f64; 2] {
        self.run(steps, false)
    }

    fn run(&self, steps: &[f64], is_second_order: bool) -> [f64; 2] {
        let (mut now, mut last) = ([0.0, self.velocity], None);
        let stiffness = self.frequency * self.frequency;
        for &h in steps {
            let known = last.filter(|&(_, length): &([f64; 2], f64)| is_second_order && (h - length).abs() <= EQUAL * h);
            let ([base, kept], r) = match known {
                Some((before, _)) => ([0, 1].map(|k: usize| (4.0 * now[k] - before[k]) / 3.0), 2.0 * h / 3.0),
                None => (now, h),
            };
            let velocity = (kept + r * (self.acceleration - stiffness * base)) / (1.0 + r * self.drag + r * r * stiffness);
            last = Some((now, h));
            now = [base + r * velocity, velocity];
        }
        now
    }
}

/// Returns the fall from rest with an acceleration in m/s².
pub(super) fn falling(acceleration: f64) -> Motion {
    Motion {
        acceleration,
        ..Motion::default()
    }
}
