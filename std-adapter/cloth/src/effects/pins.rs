//! Pins: kinematic vertices, moved by keyframes, by a body that they follow, or by the caller.

pub use super::selection::PinMotion;

use super::registration::{Effect, Registration, Scope};
use super::selection::{check_body, check_vertices, keys, placed, read_motion, read_vertices};
use crate::effects::plan::Plan;
use crate::input::ValueError;
use crate::model::step::Carrier;
use crate::world::{BodyMotion, KeyframeMotion, SceneParts};

pub(super) const REGISTRATION: Registration = Registration::new(&["group"], |table, world| {
    let mut pins = Pins::default();
    let mut taken = vec![false; world.cloth_vertices()];
    for table in table.tables("group")? {
        table.expect_keys(&keys(&[]))?;
        let group = PinGroup {
            vertices: read_vertices(&table, world)?,
            motion: read_motion(&table, world)?,
        };
        group.check(world, &mut taken).map_err(|error| placed(&table, error))?;
        pins.groups.push(group);
    }
    Ok(Box::new(pins))
});

/// Vertices of the cloth that follow a prescribed motion. Forces do not move them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pins {
    /// Groups of vertices. A vertex may be in one group at most.
    pub groups: Vec<PinGroup>,
}

/// A group of pinned vertices with a common motion.
#[derive(Clone, Debug, PartialEq)]
pub struct PinGroup {
    /// The vertices, as the scene numbers them through all cloths. [`Scene::part`](crate::Scene::part) returns named ones.
    pub vertices: Vec<u32>,
    /// The motion.
    pub motion: PinMotion,
}

impl PinGroup {
    /// Holds vertices at their initial positions.
    #[must_use]
    pub fn resting(vertices: impl Into<Vec<u32>>) -> Self {
        Self {
            vertices: vertices.into(),
            motion: PinMotion::Own(KeyframeMotion::resting().into()),
        }
    }

    /// Checks the group, and marks its vertices as taken.
    fn check(&self, world: &SceneParts<'_>, taken: &mut [bool]) -> Result<(), ValueError> {
        check_vertices(&self.vertices, taken, "pinned")?;
        match &self.motion {
            &PinMotion::Body(body) => {
                check_body(body, world)?;
                match &world.bodies[body].motion {
                    BodyMotion::Keyframes(motion) => motion.check_speed(&world.positions_of(&self.vertices)),
                    BodyMotion::Animated(_) => {
                        let name = &world.bodies[body].name;
                        let message = format!("pins cannot follow '{name}', which deforms; give them a motion of their own");
                        Err(ValueError::new("follow", message))
                    }
                    BodyMotion::Driven(_) => Ok(()),
                }
            }
            PinMotion::Own(motion) => motion.check(&world.positions_of(&self.vertices), world.time_step),
        }
    }
}

impl Effect for Pins {
    fn name(&self) -> &'static str {
        "pins"
    }

    fn scope(&self) -> Scope {
        Scope::Scene
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        if self.groups.is_empty() {
            return Err(ValueError::new("group", "pins need at least one [[effects.pins.group]]"));
        }
        let mut taken = vec![false; world.cloth_vertices()];
        self.groups.iter().try_for_each(|group| group.check(world, &mut taken))
    }

    fn register(&self, plan: &mut Plan<'_>) {
        for group in &self.groups {
            let vertices = plan.scene.numbered(&group.vertices);
            let carrier = match &group.motion {
                PinMotion::Body(body) => *body as Carrier,
                PinMotion::Own(motion) => plan.add_motion(motion.clone(), vertices.clone()),
            };
            plan.pins.push(carrier);
            vertices.into_iter().for_each(|vertex| plan.pin(vertex, carrier));
        }
    }
}
