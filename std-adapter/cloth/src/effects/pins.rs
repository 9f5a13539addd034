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
    let mut taken = Taken::new(world);
    for table in table.tables("group")? {
        table.expect_keys(&keys(&[]))?;
        let group = PinGroup {
            vertices: read_vertices(&table, world)?,
            motion: read_motion(&table, world)?,
        };
        pins.groups.push(group);
        let checked = pins.check_group(pins.groups.len() - 1, world, &mut taken);
        checked.map_err(|error| placed(&table, error))?;
    }
    Ok(Box::new(pins))
});

/// Vertices of the cloth that follow a prescribed motion. Forces do not move them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pins {
    /// Groups of vertices. A vertex may be in several groups if their motions are the same and not driven, such as the corner of
    /// two sides.
    pub groups: Vec<PinGroup>,
}

/// The group of each vertex that is pinned so far.
struct Taken(Vec<Option<usize>>);

impl Taken {
    fn new(world: &SceneParts<'_>) -> Self {
        Self(vec![None; world.cloth_vertices()])
    }
}

impl Pins {
    /// Checks a group against those before it, and marks its vertices as taken.
    fn check_group(&self, index: usize, world: &SceneParts<'_>, taken: &mut Taken) -> Result<(), ValueError> {
        let group = &self.groups[index];
        let mut is_own = vec![false; taken.0.len()];
        check_vertices(&group.vertices, &mut is_own, "pinned")?;
        let is_driven = matches!(&group.motion, PinMotion::Own(BodyMotion::Driven(_)));
        for &vertex in &group.vertices {
            let before = taken.0[vertex as usize].replace(index);
            if before.is_some_and(|before| is_driven || self.groups[before].motion != group.motion) {
                let message = format!("vertex {vertex} is pinned twice, with different motions");
                return Err(ValueError::new("vertices", message));
            }
        }
        group.check(world)
    }
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

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
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

crate::identify!(Pins { groups });
crate::identify!(PinGroup { vertices, motion });

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
        let mut taken = Taken::new(world);
        (0..self.groups.len()).try_for_each(|index| self.check_group(index, world, &mut taken))
    }

    fn register(&self, plan: &mut Plan<'_>) {
        for group in &self.groups {
            let vertices = plan.scene.numbered(&group.vertices);
            let carrier = match &group.motion {
                PinMotion::Body(body) => *body as Carrier,
                PinMotion::Own(motion) => plan.add_motion(motion.clone(), vertices.clone()),
            };
            plan.pins.push(carrier);
            vertices.iter().for_each(|&vertex| plan.pin(vertex, carrier));
            plan.pinned.push(vertices);
        }
    }
}
