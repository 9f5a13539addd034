//! Jumps: bodies, and the cloth that hangs on them, elsewhere in no time.

use super::assembly::Assembly;
use super::drive::DriveError;
use super::simulation::Simulation;
use crate::contact::Crossing;
use crate::input::{LARGEST_COORDINATE, ValueError};
use crate::model::step::{FREE, Memory, MovedAnchor};
use crate::world::Placement;
use selvedge_core::glam::DVec3;

/// A jump that was not made; nothing has changed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TeleportError {
    /// A body cannot be moved, or a number is out of range.
    #[error(transparent)]
    Drive(#[from] DriveError),
    /// There is no such cloth.
    #[error("there is no cloth {cloth}: the scene has {cloths}, numbered from 0")]
    NoCloth {
        /// The number that was given.
        cloth: usize,
        /// The number of cloths.
        cloths: usize,
    },
    /// Cloth that would jump is also held by something that stays.
    #[error("the cloth '{cloth}' is held by {what} as well, which stays: name all bodies that hold the cloth")]
    Held {
        /// The name of the cloth.
        cloth: String,
        /// A description of what stays.
        what: String,
    },
    /// Something is in the way there.
    #[error("there is no room: {crossings} edges would meet faces; the first is {first}")]
    NoRoom {
        /// The number of pairs of an edge and a face that would meet.
        crossings: usize,
        /// The first of them.
        first: Crossing,
    },
}

impl From<ValueError> for TeleportError {
    fn from(error: ValueError) -> Self {
        Self::Drive(error.into())
    }
}

/// What a jump moves.
struct Moved {
    /// For each motion, whether it moves.
    motions: Vec<bool>,
    /// For each vertex, whether it moves.
    vertices: Vec<bool>,
}

impl Simulation {
    /// Moves [driven](crate::BodyMotion::Driven) and [free](crate::BodyMotion::Free) bodies elsewhere at once, and with them
    /// their pins and the cloth that hangs on them. A game uses it for a figure that teleports, or where its world gets another
    /// origin.
    ///
    /// It is no step: no time passes, nothing is swept on the way, and the cloth does not feel it. `by` is applied to positions
    /// in the world: they are rotated about the origin, then translated. Velocities turn along, so that they stay the same
    /// relative to the bodies.
    ///
    /// A piece of cloth moves if it is pinned or attached to one of the `bodies`, or if it belongs to one of the `cloths`. Name a
    /// garment there that a figure wears without pins. Driven pins of such cloth move as well. Goals of earlier calls for the
    /// next step are dropped for all that moves. The new state is checked like the start of a scene.
    ///
    /// ```
    /// use selvedge_cloth::effects::{PinGroup, PinMotion, Pins, Stretch};
    /// use selvedge_cloth::glam::DVec3;
    /// use selvedge_cloth::{Body, BodyMotion, Cloth, Placement, Scene, Simulation};
    ///
    /// // A cape on a ball, in its middle.
    /// let cape = Cloth::sheet(DVec3::new(-0.5, -0.5, 0.2), [DVec3::X, DVec3::Y], [2, 2], 0.2)?;
    /// let mut scene = Scene::new(cape, 1e-3);
    /// let mut ball = Body::ball("ball", DVec3::ZERO, 0.1, 12)?;
    /// ball.motion = BodyMotion::Driven(Placement::default());
    /// scene.bodies.push(ball);
    /// scene.add(Stretch::isotropic(400.0));
    /// scene.add(Pins { groups: vec![PinGroup::new([4], PinMotion::Body(0))] });
    ///
    /// let mut simulation = Simulation::new(scene, 1)?;
    /// simulation.teleport(&[0], &[], Placement::at(100.0 * DVec3::X))?;
    /// assert!(simulation.positions().iter().all(|position| position.x > 99.0));
    /// assert_eq!((simulation.time(), simulation.velocities()[0]), (0.0, DVec3::ZERO));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error, and changes nothing, if a number is wrong, a body is neither driven nor free, something else holds the
    /// cloth, or the cloth or a body would meet something there.
    pub fn teleport(&mut self, bodies: &[usize], cloths: &[usize], by: Placement) -> Result<(), TeleportError> {
        let by = by.checked()?;
        let moved = self.find_moved(bodies, cloths)?;
        let mut placements = Vec::new();
        let mut positions = self.state.positions.clone();
        for (vertex, position) in positions.iter_mut().enumerate() {
            if moved.vertices[vertex] {
                *position = by.apply(*position);
            }
        }
        for (carrier, motion) in self.made.motions.iter().enumerate() {
            let placement = motion.driven().and_then(|driven| driven.placement);
            let Some(placement) = placement.filter(|_| moved.motions[carrier]) else {
                continue;
            };
            let placement = by.after(&placement).checked()?;
            placements.push((carrier, placement));
            // The next step starts from this placement, to the last bit.
            for (vertex, position) in positions.iter_mut().enumerate() {
                if self.made.carriers[vertex] as usize == carrier {
                    *position = placement.apply(self.carried[vertex]);
                }
            }
        }
        let mut free_bodies = Vec::new();
        for (body, free) in self.free_bodies().filter(|(body, _)| moved.motions[*body]) {
            let mut free = free.clone();
            free.teleport(&by);
            let own = self.made.body_vertices[body].clone();
            let members = own.chain(free.riders.iter().map(|&rider| rider as usize));
            members
                .zip(free.positions())
                .for_each(|(vertex, position)| positions[vertex] = position);
            free_bodies.push((body, free));
        }
        let is_far = |position: &&DVec3| !position.abs().cmple(DVec3::splat(LARGEST_COORDINATE)).all();
        if let Some(far) = positions.iter().find(is_far) {
            let message = format!("a vertex would be at {far}, which is not within {LARGEST_COORDINATE} metres");
            return Err(ValueError::new("by", message).into());
        }
        self.check_room(&mut positions)?;
        self.arrive(&moved, &placements, &by);
        for (body, moved) in free_bodies {
            if let Some(free) = self.made.motions[body].free_mut() {
                *free = moved;
            }
        }
        Ok(())
    }

    /// Exchanges the positions, if nothing meets there that did not meet before.
    fn check_room(&mut self, positions: &mut Vec<DVec3>) -> Result<(), TeleportError> {
        std::mem::swap(&mut self.state.positions, positions);
        let Some(contact) = &mut self.made.contact else {
            return Ok(());
        };
        let before = contact.exempt().crossings().len();
        self.state.begin_anew(contact, self.time_step);
        let yielding = contact.exempt().yielding.clone();
        let found = contact.tolerate(&self.state.positions);
        let mut found = found.map_err(|error| ValueError::new("by", error.to_string()))?;
        found.retain(|crossing| crossing.body.is_none_or(|body| !yielding[body]));
        if found.len() <= before {
            return Ok(());
        }
        std::mem::swap(&mut self.state.positions, positions);
        self.state.begin_anew(contact, self.time_step);
        let restored = contact.tolerate(&self.state.positions);
        restored.map_err(|error| ValueError::new("by", error.to_string()))?;
        Err(TeleportError::NoRoom {
            crossings: found.len(),
            first: found[0],
        })
    }

    /// Brings all but the positions up to date.
    fn arrive(&mut self, moved: &Moved, placements: &[(usize, Placement)], by: &Placement) {
        for (velocity, _) in self
            .state
            .velocities
            .iter_mut()
            .zip(&moved.vertices)
            .filter(|(_, moves)| **moves)
        {
            *velocity = by.rotation * *velocity;
        }
        let motions = self.made.motions.iter_mut().zip(&moved.motions);
        for driven in motions
            .filter(|(_, moves)| **moves)
            .filter_map(|(motion, _)| motion.driven_mut())
        {
            driven.stand(None);
        }
        for &(carrier, placement) in placements {
            if let Some(driven) = self.made.motions[carrier].driven_mut() {
                driven.stand(Some(placement));
            }
        }
        for memory in self.made.memories_mut() {
            memory.teleport(&moved.vertices, &|point| by.apply(point));
        }
        self.waiting = None;
        let history = &mut self.work.substep.history;
        history.teleport(&moved.vertices, |point| by.apply(point), |vector| by.rotation * vector);
        self.made.solve.forget();
    }

    /// Finds what moves with the bodies and cloths.
    fn find_moved(&mut self, bodies: &[usize], cloths: &[usize]) -> Result<Moved, TeleportError> {
        for &body in bodies {
            if self.body_motion(body).is_none() {
                self.driven_body(body)?;
            }
        }
        let made = &self.made;
        let count = made.vertices_of_cloths.len();
        if let Some(&cloth) = cloths.iter().find(|&&cloth| cloth >= count) {
            return Err(TeleportError::NoCloth { cloth, cloths: count });
        }
        let mut moved = Moved {
            motions: (0..made.motions.len()).map(|carrier| bodies.contains(&carrier)).collect(),
            vertices: vec![false; self.state.positions.len()],
        };
        for &cloth in cloths {
            moved.vertices[made.vertices_of_cloths[cloth].clone()].fill(true);
        }
        let held: Vec<_> = made.memories().flat_map(Memory::held_by).collect();
        let body_at = |vertex: u32| made.body_vertices.iter().position(|own| own.contains(&(vertex as usize)));
        for (vertex, on_body) in &held {
            let moves = on_body.and_then(body_at).is_some_and(|body| bodies.contains(&body));
            moved.vertices[*vertex as usize] |= moves;
        }
        // Pins that move may hold other pieces, which then move as well.
        let anchors = made.anchors();
        let mut reached = 0;
        loop {
            moved.follow(made, &anchors, self.body_names.len());
            let now = moved.vertices.iter().filter(|moves| **moves).count();
            if now == reached {
                break;
            }
            reached = now;
        }
        self.check_nothing_stays(&moved, &held)?;
        Ok(moved)
    }

    /// Refuses a jump of cloth that something holds which stays.
    fn check_nothing_stays(&self, moved: &Moved, held: &[(u32, Option<u32>)]) -> Result<(), TeleportError> {
        let made = &self.made;
        let refuse = |vertex: usize, what: String| {
            let cloth = made.vertices_of_cloths.iter().position(|own| own.contains(&vertex));
            let cloth = self.cloth_names[cloth.unwrap_or_default()].clone();
            Err(TeleportError::Held { cloth, what })
        };
        let body = |body: usize| format!("the body '{}'", self.body_names[body]);
        for vertex in (0..made.cloth_vertices).filter(|&vertex| moved.vertices[vertex]) {
            let carrier = made.carriers[vertex];
            if carrier != FREE && !moved.motions[carrier as usize] {
                let group = made.pins.iter().position(|pins| *pins == carrier).unwrap_or_default();
                let is_body = (carrier as usize) < self.body_names.len();
                let pins = || format!("the group {group} of pins");
                return refuse(vertex, if is_body { body(carrier as usize) } else { pins() });
            }
        }
        for &(vertex, on_body) in held.iter().filter(|(vertex, _)| moved.vertices[*vertex as usize]) {
            match on_body {
                Some(on) if moved.vertices[on as usize] => {}
                Some(on) => {
                    let own = made.body_vertices.iter().position(|own| own.contains(&(on as usize)));
                    return refuse(vertex as usize, body(own.unwrap_or_default()));
                }
                None => return refuse(vertex as usize, "attachments or soft pins with keyframes".to_owned()),
            }
        }
        Ok(())
    }
}

impl Moved {
    /// Lets everything move whose motion moves, each piece of which a vertex moves, and driven pins of such pieces.
    fn follow(&mut self, made: &Assembly, anchors: &[MovedAnchor], bodies: usize) {
        let moves_pins =
            |carrier: usize| carrier >= bodies && made.motions.get(carrier).is_some_and(|motion| motion.driven().is_some());
        for (moves, &carrier) in self.vertices.iter_mut().zip(&made.carriers) {
            *moves |= carrier != FREE && self.motions[carrier as usize];
        }
        for anchor in anchors {
            self.vertices[anchor.vertex as usize] |= self.motions[anchor.carrier as usize];
        }
        for piece in made.pieces.vertices() {
            if !piece.clone().any(|vertex| self.vertices[vertex as usize]) {
                continue;
            }
            for vertex in piece {
                self.vertices[vertex as usize] = true;
                let carrier = made.carriers[vertex as usize] as usize;
                if moves_pins(carrier) {
                    self.motions[carrier] = true;
                }
            }
        }
        for anchor in anchors.iter().filter(|anchor| self.vertices[anchor.vertex as usize]) {
            let carrier = anchor.carrier as usize;
            self.motions[carrier] |= moves_pins(carrier);
        }
    }
}
