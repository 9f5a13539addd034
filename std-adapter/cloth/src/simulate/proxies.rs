//! Proxies in a frame: bodies that another physics engine moves, and that yield to cloth.

use super::drive::DriveError;
use super::errors::Blocked;
use super::loads::Wrench;
use super::simulation::Simulation;
use crate::world::{BroughtBody, FASTEST_VERTEX, Free, Kinematic};

impl Simulation {
    /// Says where another physics engine has brought the body of a [proxy](crate::FreeMotion::proxy) in the time of the next
    /// [`advance`](Self::advance), [`run`](Self::run) or [`step`](Self::step). In that time the proxy goes there, and yields to
    /// cloth on the way by the mass of the body. Without a call it stays, and yields.
    ///
    /// Afterwards move the engine's body to [`placement`](Self::placement), and add [`proxy_load`](Self::proxy_load) to its next
    /// step. So the engine's gravity, contacts and joints act on the body, and so does the cloth, which may be much heavier than
    /// the body. Both steps must have the same length.
    ///
    /// ```
    /// use selvedge_cloth::effects::{BodyContact, Gravity, PinGroup, Pins, SelfCollision, Stretch, Thickness};
    /// use selvedge_cloth::glam::{DQuat, DVec3};
    /// use selvedge_cloth::{Body, BodyMass, BroughtBody, Cloth, FreeMotion, Scene, Simulation};
    ///
    /// // A ball of 0.5 kg falls into a sheet of 20 g that is held at its border.
    /// let sheet = Cloth::sheet(DVec3::new(-0.25, -0.25, 0.0), [DVec3::X * 0.5, DVec3::Y * 0.5], [10, 10], 0.08)?;
    /// let border = |point: &DVec3| point.x.abs().max(point.y.abs()) > 0.249;
    /// let vertices = sheet.mesh().positions.iter().zip(0..).filter(|(point, _)| border(point));
    /// let border: Vec<u32> = vertices.map(|(_, vertex)| vertex).collect();
    /// let pins = Pins { groups: vec![PinGroup::resting(border)] };
    /// let mut scene = Scene::new(sheet, 4e-3);
    /// let mut ball = Body::ball("ball", DVec3::ZERO, 0.08, 16)?;
    /// let mut motion = FreeMotion { proxy: true, ..FreeMotion::new(BodyMass::Mass(0.5)) };
    /// motion.placement.translation = DVec3::Z * 0.1;
    /// ball.motion = motion.into();
    /// scene.bodies.push(ball);
    /// scene.add(Gravity::default()).add(Stretch::isotropic(1000.0)).add(pins);
    /// scene.add(BodyContact(Thickness::new(4e-3))).add(SelfCollision(Thickness::new(4e-3)));
    /// let mut simulation = Simulation::new(scene, 1)?;
    ///
    /// // The engine of this example knows gravity alone.
    /// let (mut at, mut velocity) = (motion.placement, DVec3::ZERO);
    /// let seconds = 1.0 / 60.0;
    /// for _ in 0..120 {
    ///     velocity += DVec3::NEG_Z * (9.81 * seconds);
    ///     at.translation += velocity * seconds;
    ///     simulation.bring_body(0, BroughtBody { placement: at, velocity, spin: DVec3::ZERO })?;
    ///     simulation.advance(seconds)?;
    ///     at = simulation.placement(0).expect("it is a proxy");
    ///     velocity += simulation.proxy_load(0).expect("it is a proxy").force * (seconds / 0.5);
    /// }
    /// assert!(velocity.length() < 1.0 && at.translation.z > -0.1, "the sheet holds the ball");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if there is no such body, it is not a proxy, or a number is out of range.
    pub fn bring_body(&mut self, body: usize, to: BroughtBody) -> Result<(), DriveError> {
        let bodies = self.body_names.len();
        if body >= bodies {
            return Err(DriveError::NoBody { body, bodies });
        }
        let proxy = self.made.motions[body].free_mut().and_then(|free| free.proxy.as_mut());
        let proxy = proxy.ok_or_else(|| DriveError::NoProxy {
            name: self.body_names[body].clone(),
        })?;
        Ok(proxy.bring(to)?)
    }

    /// Returns the mean force of cloth and ropes on a [proxy](crate::FreeMotion::proxy) in the last frame or step, with the mean
    /// torque about its centre of mass; `None` if the body is not a proxy. Cloth that is pinned to it is part of the load.
    #[must_use]
    pub fn proxy_load(&self, body: usize) -> Option<Wrench> {
        let is_body = body < self.body_names.len();
        let free = is_body.then(|| self.made.motions[body].free()).flatten()?;
        let [force, torque] = free.proxy.as_ref()?.load();
        Some(Wrench { force, torque })
    }

    /// Lets proxies begin a frame of so many seconds. Returns the first whose body was brought too far for that time; then
    /// nothing moves, and what was brought is forgotten.
    pub(super) fn begin_proxies(&mut self, seconds: f64) -> Option<Blocked> {
        for body in 0..self.body_names.len() {
            let gravity = self.made.of_free_bodies.gravity;
            let Some(free) = self.made.motions[body].free_mut() else {
                continue;
            };
            let Some(state) = free.begin_frame(seconds, gravity) else {
                continue;
            };
            let speed = free.fastest(&state);
            if speed > FASTEST_VERTEX {
                let name = self.body_names[body].clone();
                return Some(Blocked {
                    time: self.time(),
                    what: format!("the body '{name}'"),
                    body: Some(name),
                    speed: Some(speed),
                });
            }
            let spin = free.spin_of(&state);
            for (vertex, &point) in self.made.body_vertices[body].clone().zip(&*free.points) {
                self.state.velocities[vertex] = state.velocity + spin.cross(state.rotation * point);
            }
        }
        None
    }

    /// Lets proxies leave, in a frame of so many steps.
    pub(super) fn leave_proxies(&mut self, steps: u32) {
        let last_step = self.work.substep.history.last_step_seconds();
        for free in self.made.motions.iter_mut().filter_map(Kinematic::free_mut) {
            free.leave(steps, last_step, [&self.state.positions, &self.state.velocities]);
        }
    }

    /// Lets proxies end a frame.
    pub(super) fn end_proxies(&mut self) {
        let free = self.made.motions.iter_mut().filter_map(Kinematic::free_mut);
        free.for_each(Free::end_frame);
    }
}
