//! The caller moves bodies and pins, changes the wind, and pushes vertices, from step to step.

use super::assembly::Assembly;
use super::errors::Blocked;
use super::simulation::Simulation;
use super::state::FASTEST;
use crate::effects::Wind;
use crate::input::{FORCE, Field, LARGEST_COORDINATE, LENGTH, ValueError};
use crate::world::{Driven, FASTEST_VERTEX, Placement};
use selvedge_core::glam::DVec3;

/// A motion or a force that cannot be set; nothing has changed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DriveError {
    /// There is no such body.
    #[error("there is no body {body}: the scene has {bodies}, numbered from 0")]
    NoBody {
        /// The number that was given.
        body: usize,
        /// The number of bodies.
        bodies: usize,
    },
    /// There is no such group of pins.
    #[error("there is no group {group} of pins: the scene has {groups}, numbered from 0")]
    NoPins {
        /// The number that was given.
        group: usize,
        /// The number of groups.
        groups: usize,
    },
    /// The body or the pins follow keyframes, or a body.
    #[error("{what} cannot be moved by hand: make it driven (`driven = true` in a scene's text, `BodyMotion::Driven` in code)")]
    NotDriven {
        /// A description of the body or the pins.
        what: String,
    },
    /// The body is not a proxy.
    #[error("the body '{name}' is not a proxy: make it one (`proxy = true` beside its `mass`, `FreeMotion::proxy` in code)")]
    NoProxy {
        /// The name of the body.
        name: String,
    },
    /// The number of positions differs from the number of vertices.
    #[error("{found} positions were given for {expected} vertices")]
    VertexCount {
        /// The number of vertices.
        expected: usize,
        /// The number of positions.
        found: usize,
    },
    /// The number of forces differs from the number of vertices.
    #[error("{found} forces were given for {expected} vertices")]
    ForceCount {
        /// The number of vertices.
        expected: usize,
        /// The number of forces.
        found: usize,
    },
    /// There is no such vertex of cloth.
    #[error("there is no vertex {vertex} of cloth: the scene has {vertices}, numbered from 0")]
    NoVertex {
        /// The vertex.
        vertex: u32,
        /// The number of vertices of cloth.
        vertices: usize,
    },
    /// A number is not finite, or out of its range.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// The scene has no wind.
    #[error("the scene has no wind: add it (`[effects.wind]` in a scene's text, `Wind` in code)")]
    NoWind,
}

/// The largest component of a force on a vertex.
const FORCE_ON_VERTEX: Field = Field::vector("force", FORCE, 1e6);

impl Simulation {
    /// Moves a [driven](crate::BodyMotion::Driven) body to another placement in the next step. A step in which a vertex would be
    /// faster than 100 m/s fails, before anything moves; [`teleport`](Self::teleport) jumps. It turns about its origin, the
    /// shorter way round, and moves along, both evenly. After a step that is cut or has to wait the body is on the way, where
    /// [`placement`](Self::placement) says. It stays there until the next call.
    ///
    /// # Errors
    /// Returns an error if there is no such body, it is not driven, or the placement is invalid.
    pub fn place_body(&mut self, body: usize, placement: Placement) -> Result<(), DriveError> {
        let placement = placement.checked()?;
        self.driven_body(body)?.lead_to(placement);
        Ok(())
    }

    /// Moves each vertex of a [driven](crate::BodyMotion::Driven) body straight to a position, in metres, in the next step. This
    /// suits a body that changes its shape, such as a skinned figure. Pins that follow the body do not follow such a motion: move
    /// them separately.
    ///
    /// # Errors
    /// Returns an error if there is no such body, or it is not driven. Each vertex needs one position, finite and within a
    /// kilometre.
    pub fn move_body(&mut self, body: usize, positions: &[DVec3]) -> Result<(), DriveError> {
        let driven = self.driven_body(body)?;
        check_positions(positions, driven.vertices.len())?;
        driven.lead_points_to(positions.to_vec());
        Ok(())
    }

    /// Moves each vertex of a group of driven pins straight to a position, in metres, in the next step. `group` is the index of
    /// the group in [`Pins`](crate::effects::Pins). Soft pins pull their vertices towards these positions.
    ///
    /// # Errors
    /// Returns an error if there is no such group, or it is not driven. Each vertex needs one position, finite and within a
    /// kilometre.
    pub fn move_pins(&mut self, group: usize, positions: &[DVec3]) -> Result<(), DriveError> {
        let groups = self.made.pins.len();
        let carrier = *self.made.pins.get(group).ok_or(DriveError::NoPins { group, groups })? as usize;
        let own = (carrier >= self.body_names.len()).then(|| self.made.motions[carrier].driven_mut());
        let driven = own.flatten().ok_or_else(|| DriveError::NotDriven {
            what: format!("the group {group} of pins"),
        })?;
        check_positions(positions, driven.vertices.len())?;
        driven.lead_points_to(positions.to_vec());
        Ok(())
    }

    /// The present placement of a [driven](crate::BodyMotion::Driven) or [free](crate::BodyMotion::Free) body; `None` for any
    /// other body, and for one that was moved vertex by vertex.
    #[must_use]
    pub fn placement(&self, body: usize) -> Option<Placement> {
        let is_body = body < self.body_names.len();
        let motion = is_body.then(|| &self.made.motions[body])?;
        match motion.free() {
            Some(free) => Some(free.placement()),
            None => motion.driven()?.placement,
        }
    }

    /// Sets the velocity of the [`Wind`] from now on, in m/s.
    ///
    /// # Errors
    /// Returns an error if the scene has no wind, or the velocity is not allowed.
    pub fn set_wind(&mut self, velocity: DVec3) -> Result<(), DriveError> {
        Wind::check_velocity(velocity).map_err(|error| error.with_owner("wind"))?;
        // Each of several cloths has its own wind.
        let terms = self.made.solve.terms.iter_mut();
        let taken = terms.map(|term| term.action.set_wind(velocity));
        let is_taken = taken.fold(false, |any, taken| any | taken);
        if let Some(tearing) = &mut self.tearing {
            tearing.wind = Some(velocity);
        }
        if is_taken { Ok(()) } else { Err(DriveError::NoWind) }
    }

    /// Adds a force, in N, on each of these vertices of cloth, for the whole of the next [`step`](Self::step),
    /// [`run`](Self::run) or [`advance`](Self::advance). After that call it is gone, even if the call fails. Forces on the same
    /// vertex add up. On a pinned vertex, the force goes to what [holds](Self::pin_load) it.
    ///
    /// ```
    /// use selvedge_cloth::effects::{Gravity, RopeStretch};
    /// use selvedge_cloth::glam::DVec3;
    /// use selvedge_cloth::{Cloth, Scene, Simulation};
    ///
    /// // A rope of 10 g floats while each of its ends is lifted by half of its weight.
    /// let rope = Cloth::rope(&[DVec3::ZERO, DVec3::X], 1, 0.01)?;
    /// let mut scene = Scene::new(rope, 1e-3);
    /// scene.add(Gravity::default()).add(RopeStretch::new(1000.0));
    /// let mut simulation = Simulation::new(scene, 1)?;
    /// simulation.add_force(&[0, 1], DVec3::Z * (0.005 * 9.81))?;
    /// simulation.advance(0.1)?;
    /// assert!(simulation.velocities().iter().all(|velocity| velocity.length() < 1e-9));
    /// simulation.advance(0.1)?;
    /// assert!(simulation.velocities()[0].z < -0.9, "the forces are gone");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if a vertex is not of cloth, or a component of the force is not finite or above 1 MN. Then no force is
    /// added.
    pub fn add_force(&mut self, vertices: &[u32], force: DVec3) -> Result<(), DriveError> {
        self.check_of_cloth(vertices)?;
        FORCE_ON_VERTEX.check_vector(force)?;
        self.added_forces.0.extend(vertices.iter().map(|&vertex| (vertex, force)));
        Ok(())
    }

    /// Adds a force of its own on each of these vertices, as [`add_force`](Self::add_force) does.
    ///
    /// # Errors
    /// Returns the errors of [`add_force`](Self::add_force), and one if the number of forces is not that of the vertices.
    pub fn add_forces(&mut self, vertices: &[u32], forces: &[DVec3]) -> Result<(), DriveError> {
        let (expected, found) = (vertices.len(), forces.len());
        if expected != found {
            return Err(DriveError::ForceCount { expected, found });
        }
        self.check_of_cloth(vertices)?;
        forces.iter().try_for_each(|&force| FORCE_ON_VERTEX.check_vector(force))?;
        self.added_forces
            .0
            .extend(vertices.iter().zip(forces).map(|(&vertex, &force)| (vertex, force)));
        Ok(())
    }

    fn check_of_cloth(&self, vertices: &[u32]) -> Result<(), DriveError> {
        let cloth = self.made.cloth_vertices;
        match vertices.iter().find(|&&vertex| vertex as usize >= cloth) {
            Some(&vertex) => Err(DriveError::NoVertex { vertex, vertices: cloth }),
            None => Ok(()),
        }
    }

    /// Sets the velocity, in m/s, with which vertices of cloth start the next step, as if a hand pulled them. Pinned vertices
    /// keep theirs. The next step is certified like any other.
    ///
    /// # Errors
    /// If a vertex is not of cloth, or a component of the velocity is not finite or not below [`FASTEST`].
    pub fn set_velocity(&mut self, vertices: &[u32], velocity: DVec3) -> Result<(), DriveError> {
        const SPEED: Field = Field::vector("velocity", crate::input::SPEED, FASTEST);
        SPEED.check_vector(velocity)?;
        self.check_of_cloth(vertices)?;
        for &vertex in vertices {
            if self.made.inverse_masses[vertex as usize] > 0.0 {
                self.state.velocities[vertex as usize] = velocity;
            }
        }
        Ok(())
    }

    /// Returns the first body or group of pins that the caller moves faster than [`FASTEST_VERTEX`] in the step that begins.
    pub(super) fn first_too_fast(&self) -> Option<Blocked> {
        let Assembly { motions, carriers, .. } = &self.made;
        let driven = (0_u32..)
            .zip(motions)
            .filter_map(|(carrier, motion)| Some((carrier, motion.driven()?)));
        let mut speeds = driven.map(|(carrier, driven)| {
            let own = self
                .state
                .positions
                .iter()
                .zip(carriers)
                .filter(|(_, whose)| **whose == carrier);
            (carrier, driven.speed(own.map(|(position, _)| *position)))
        });
        let (carrier, speed) = speeds.find(|(_, speed)| *speed > FASTEST_VERTEX)?;
        let body = self.body_names.get(carrier as usize).cloned();
        let what = match &body {
            Some(name) => format!("the body '{name}'"),
            None => {
                let group = self.made.pins.iter().position(|pins| *pins == carrier);
                format!("the group {} of pins", group.unwrap_or_default())
            }
        };
        let (time, speed) = (self.time(), Some(speed));
        Some(Blocked { time, what, body, speed })
    }

    /// Drops what the caller has set for the step that begins.
    pub(super) fn drop_goals(&mut self) {
        self.added_forces.0.clear();
        for motion in &mut self.made.motions {
            if let Some(driven) = motion.driven_mut() {
                driven.stand(driven.placement);
            }
            if let Some(proxy) = motion.free_mut().and_then(|free| free.proxy.as_mut()) {
                proxy.forget_goal();
            }
        }
    }

    pub(super) fn driven_body(&mut self, body: usize) -> Result<&mut Driven, DriveError> {
        let bodies = self.body_names.len();
        if body >= bodies {
            return Err(DriveError::NoBody { body, bodies });
        }
        let Self { made, body_names, .. } = self;
        made.motions[body].driven_mut().ok_or_else(|| DriveError::NotDriven {
            what: format!("the body '{}'", body_names[body]),
        })
    }
}

/// Checks that there is one position for each vertex, and that all are within reach.
fn check_positions(positions: &[DVec3], expected: usize) -> Result<(), DriveError> {
    if positions.len() != expected {
        let found = positions.len();
        return Err(DriveError::VertexCount { expected, found });
    }
    let reach = Field::vector("positions", LENGTH, LARGEST_COORDINATE);
    positions.iter().try_for_each(|&position| reach.check_vector(position))?;
    Ok(())
}
