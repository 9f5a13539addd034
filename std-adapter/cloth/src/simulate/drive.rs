//! What a caller says from step to step: where bodies and pins go, how the wind blows.

use super::simulation::Simulation;
use crate::effects::Wind;
use crate::input::{Field, LARGEST_COORDINATE, LENGTH, ValueError};
use crate::world::{Driven, Placement};
use selvedge_core::glam::DVec3;

/// Something cannot be moved as asked; nothing has changed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DriveError {
    /// There is no such body.
    #[error("there is no body {body}: the scene has {bodies}, numbered from 0")]
    NoBody {
        /// What was asked for.
        body: usize,
        /// How many there are.
        bodies: usize,
    },
    /// There is no such group of pins.
    #[error("there is no group {group} of pins: the scene has {groups}, numbered from 0")]
    NoPins {
        /// What was asked for.
        group: usize,
        /// How many there are.
        groups: usize,
    },
    /// It follows keyframes, or a body.
    #[error("{what} cannot be moved by hand: give it `BodyMotion::Driven` in the scene")]
    NotDriven {
        /// In words.
        what: String,
    },
    /// One position is needed for each vertex.
    #[error("{found} positions were given for {expected} vertices")]
    VertexCount {
        /// How many vertices it has.
        expected: usize,
        /// How many positions were given.
        found: usize,
    },
    /// A number is not finite, or beyond its range.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// The scene calls for no wind.
    #[error("the scene has no wind: add the effect `Wind` to it")]
    NoWind,
}

impl Simulation {
    /// Leads a [driven](crate::BodyMotion::Driven) body to another placement in the next step: it turns about its origin, the shorter way
    /// round, and moves along, both evenly. A step that is cut or has to wait leaves it on the way, where [`placement`](Self::placement)
    /// says; unless it is told again it stays there.
    ///
    /// # Errors
    /// Returns an error if there is no such body, it is not driven, or the placement is none.
    pub fn place_body(&mut self, body: usize, placement: Placement) -> Result<(), DriveError> {
        let placement = placement.checked()?;
        self.driven_body(body)?.lead_to(placement);
        Ok(())
    }

    /// Leads each vertex of a [driven](crate::BodyMotion::Driven) body straight to a position, in metres, in the next step: a body that
    /// changes its shape, such as a skinned figure. Pins that follow it know no way to go then, and stay: move them on their own.
    ///
    /// # Errors
    /// Returns an error if there is no such body, it is not driven, or the positions are not one for each vertex, finite and
    /// within a kilometre.
    pub fn move_body(&mut self, body: usize, positions: &[DVec3]) -> Result<(), DriveError> {
        let driven = self.driven_body(body)?;
        check_positions(positions, driven.vertices.len())?;
        driven.lead_points_to(positions.to_vec());
        Ok(())
    }

    /// The same for a group of pins, by its index in [`Pins`](crate::effects::Pins), whose motion is driven.
    ///
    /// # Errors
    /// Returns an error if there is no such group, it is not driven, or the positions are not one for each vertex, finite and
    /// within a kilometre.
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

    /// Where a [driven](crate::BodyMotion::Driven) body stands now; `None` for any other, and for one that was moved vertex by vertex.
    #[must_use]
    pub fn placement(&self, body: usize) -> Option<Placement> {
        let is_body = body < self.body_names.len();
        let driven = is_body.then(|| self.made.motions[body].driven()).flatten();
        driven.and_then(|driven| driven.placement)
    }

    /// Lets the [`Wind`](crate::effects::Wind) blow so from now on, in m/s.
    ///
    /// # Errors
    /// Returns an error if the scene calls for no wind, or no wind can blow so.
    pub fn set_wind(&mut self, velocity: DVec3) -> Result<(), DriveError> {
        Wind::check_velocity(velocity).map_err(|error| error.of("wind"))?;
        // Each of several cloths has its own.
        let taken = self.made.forces.iter_mut().map(|force| force.action.set_wind(velocity));
        let is_taken = taken.fold(false, |any, taken| any | taken);
        if let Some(tearing) = &mut self.tearing {
            tearing.wind = Some(velocity);
        }
        if is_taken { Ok(()) } else { Err(DriveError::NoWind) }
    }

    fn driven_body(&mut self, body: usize) -> Result<&mut Driven, DriveError> {
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

/// Whether there is one for each vertex, and all are within reach.
fn check_positions(positions: &[DVec3], expected: usize) -> Result<(), DriveError> {
    if positions.len() != expected {
        let found = positions.len();
        return Err(DriveError::VertexCount { expected, found });
    }
    let reach = Field::vector("positions", LENGTH, LARGEST_COORDINATE);
    positions.iter().try_for_each(|&position| reach.check_vector(position))?;
    Ok(())
}
