//! Loads, as a caller reads them.

use super::loads::{BodyLoad, ContactLoad, Wrench};
use super::simulation::Simulation;
use selvedge_core::glam::DVec3;

impl Simulation {
    /// Returns the load of cloth and ropes on a body at the end of the last step, with torques about a point; `None` if there is
    /// no such body. It is zero before the first step, and after [`resume`](Self::resume).
    ///
    /// ```
    /// use selvedge_cloth::effects::{BodyContact, Friction, Gravity, SelfCollision, Stretch, Thickness};
    /// use selvedge_cloth::glam::DVec3;
    /// use selvedge_cloth::{Body, Cloth, Scene, Simulation};
    ///
    /// // A sheet of 9 g lies on a ball.
    /// let corner = DVec3::new(-0.15, -0.15, 0.105);
    /// let sheet = Cloth::sheet(corner, [DVec3::X * 0.3, DVec3::Y * 0.3], [10, 10], 0.1)?;
    /// let mut scene = Scene::new(sheet, 4e-3);
    /// scene.bodies.push(Body::ball("ball", DVec3::ZERO, 0.1, 16)?);
    /// scene.add(Gravity::default()).add(Stretch::isotropic(400.0)).add(Friction { coefficient: 0.5 });
    /// scene.add(BodyContact(Thickness::new(4e-3))).add(SelfCollision(Thickness::new(4e-3)));
    /// let mut simulation = Simulation::new(scene, 1)?;
    /// for _ in 0..500 {
    ///     simulation.step()?;
    /// }
    /// let load = simulation.body_load(0, DVec3::ZERO).expect("there is one body");
    /// let weight = 0.009 * 9.81;
    /// assert!((load.total().force.z / weight + 1.0).abs() < 0.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn body_load(&self, body: usize, about: DVec3) -> Option<BodyLoad> {
        let load = self.loads.now.bodies.get(body)?;
        Some(load.map(|part| part.about(about)))
    }

    /// Returns the mean load on a body in the last [`step`](Self::step), [`run`](Self::run) or [`advance`](Self::advance), with
    /// torques about a point; `None` if there is no such body. Times the length of that call it is the impulse, in N·s.
    #[must_use]
    pub fn mean_body_load(&self, body: usize, about: DVec3) -> Option<BodyLoad> {
        let impulse = self.loads.impulses.bodies.get(body)?;
        Some(impulse.map(|part| self.loads.mean(part).about(about)))
    }

    /// Returns the load on a group of [`Pins`](crate::effects::Pins) at the end of the last step, with the torque about a point;
    /// `None` if there is no such group. This is what moves or holds the pins feels: the cloth's pull, the weight of the pinned
    /// vertices and their inertia. Of a soft pin it is the pull of its spring. A vertex in several groups counts in each.
    #[must_use]
    pub fn pin_load(&self, group: usize, about: DVec3) -> Option<Wrench> {
        Some(self.loads.now.pins.get(group)?.about(about))
    }

    /// Returns the mean of [`pin_load`](Self::pin_load) in the last call, as [`mean_body_load`](Self::mean_body_load) does.
    #[must_use]
    pub fn mean_pin_load(&self, group: usize, about: DVec3) -> Option<Wrench> {
        Some(self.loads.mean(*self.loads.impulses.pins.get(group)?).about(about))
    }

    /// Returns the load on a group of [`Attachments`](crate::effects::Attachments) at the end of the last step, with the torque
    /// about a point; `None` if there is no such group. Vertices that the step released are still in it.
    #[must_use]
    pub fn attachment_load(&self, group: usize, about: DVec3) -> Option<Wrench> {
        Some(self.loads.now.attachments.get(group)?.about(about))
    }

    /// Returns the mean of [`attachment_load`](Self::attachment_load) in the last call, as
    /// [`mean_body_load`](Self::mean_body_load) does.
    #[must_use]
    pub fn mean_attachment_load(&self, group: usize, about: DVec3) -> Option<Wrench> {
        Some(self.loads.mean(*self.loads.impulses.attachments.get(group)?).about(about))
    }

    /// Returns the force, in N, that the last solve left in sum: the cloth has moved as if it acted on free vertices besides all
    /// others. It bounds the error of all loads together, and a finer [`accuracy`](crate::Scene::accuracy) lowers it. At rest it
    /// vanishes.
    #[must_use]
    pub fn unbalanced_force(&self) -> DVec3 {
        self.made.solve.left(&self.made.inverse_masses)
    }

    /// Returns the contacts that pushed a body in the last part of the last step, in a fixed order. Their sum is the contact and
    /// the friction of [`body_load`](Self::body_load).
    pub fn contact_loads(&self, body: usize) -> impl Iterator<Item = ContactLoad> {
        let contacts = self.loads.contacts.iter().filter(move |(own, _)| *own == body);
        contacts.map(|(_, contact)| *contact)
    }
}
