//! The frames of a [proxy](super::proxy), with the cloth that is pinned to it.

use super::free::Free;
use super::proxy::Frame;
use super::rigid_mass::RigidMass;
use crate::model::rigid::RigidState;
use selvedge_core::glam::DVec3;

impl Free {
    /// Begins a frame of a proxy of so many seconds. Returns the state at the mean velocity and the mean spin that lead to its
    /// goal; `None` unless it is a proxy.
    pub(crate) fn begin_frame(&mut self, seconds: f64, gravity: DVec3) -> Option<RigidState> {
        let at = self.placement();
        let [velocity, spin] = self.proxy.as_mut()?.begin(seconds, at, gravity);
        Some(RigidState {
            velocity,
            momentum: self.state.turned(&self.mass.inertia) * spin,
            ..self.state
        })
    }

    /// Lets a proxy leave in a frame of so many equal steps. The last step took `last_step` seconds. The last argument has the
    /// positions and the velocities of all vertices.
    pub(crate) fn leave(&mut self, steps: u32, last_step: Option<f64>, [positions, velocities]: [&[DVec3]; 2]) {
        let Some(proxy) = &mut self.proxy else { return };
        let Frame {
            seconds,
            gravity,
            accelerations,
            leaves,
            ..
        } = &mut proxy.frame;
        // In n steps of first order an acceleration leads T²·(n + 1)/2n far.
        let count = f64::from(steps);
        let mean = *seconds * (count + 1.0) / (2.0 * count);
        *leaves = [0, 1].map(|slot| leaves[slot] - accelerations[slot] * mean);
        let riders = self.riders.iter().zip(&proxy.rider_masses);
        let riders = riders.map(|(&rider, &mass)| (positions[rider as usize], rider as usize, mass));
        let joined = |own, of_rider: &dyn Fn(usize) -> DVec3| {
            let riders = riders
                .clone()
                .map(|(position, rider, mass)| (position, of_rider(rider), mass));
            joined([&proxy.own, &self.mass], &self.state, own, riders)
        };
        let [velocity, momentum] = joined(*leaves, &|rider| velocities[rider]);
        proxy.applied = joined(*accelerations, &|_| *gravity);
        (self.state.velocity, self.state.momentum) = (velocity, momentum);
        // The solve begins with the acceleration of the last frame's load.
        let [impulse, moment] = proxy.impulses.map(|impulse| impulse / *seconds);
        let last = last_step.unwrap_or(0.0);
        self.before = RigidState {
            velocity: velocity - (proxy.applied[0] + impulse / self.mass.mass) * last,
            momentum: momentum - (proxy.applied[1] + moment) * last,
            ..self.state
        };
        self.is_first_order = true;
    }

    /// Ends a frame of a proxy.
    pub(crate) fn end_frame(&mut self) {
        let (at, spin) = (self.placement(), self.spin_of(&self.state));
        if let Some(proxy) = &mut self.proxy {
            let arm = at.rotation * (proxy.own.centre - self.mass.centre);
            proxy.end(at, [self.state.velocity + spin.cross(arm), spin]);
        }
    }

    /// Returns the largest speed that a vertex may have in a state, in m/s.
    pub(crate) fn fastest(&self, state: &RigidState) -> f64 {
        state.velocity.length() + self.spin_of(state).length() * self.radius()
    }
}

/// Joins the riders of a body, each with its position, velocity and mass, with the part of the engine, which has another velocity
/// and a spin, as if they stuck together. Returns the velocity of the common centre of mass, and the angular momentum about it.
/// The same for accelerations: it then returns that of the common centre, and the torque about it.
fn joined(
    [own, all]: [&RigidMass; 2],
    state: &RigidState,
    [velocity, spin]: [DVec3; 2],
    riders: impl Iterator<Item = (DVec3, DVec3, f64)>,
) -> [DVec3; 2] {
    let arm = state.rotation * (own.centre - all.centre);
    let mut impulse = velocity * own.mass;
    let mut momentum = state.turned(&own.inertia) * spin + arm.cross(impulse);
    for (position, velocity, mass) in riders {
        impulse += velocity * mass;
        momentum += (position - state.centre).cross(velocity * mass);
    }
    [impulse / all.mass, momentum]
}
