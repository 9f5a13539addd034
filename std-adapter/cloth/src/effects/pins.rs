//! Pins: vertices that are kinematic, moved by keyframes of their own, by the body that they follow, or by the caller.

use super::registration::{Effect, Registration, Scope};
use super::vertices::{named_cloth, no_vertex, of_cloth};
use crate::input::{Field, LARGEST_COORDINATE, LENGTH, SceneError, Table, ValueError, suggestion};
use crate::plan::Plan;
use crate::step::Carrier;
use crate::world::{Motion, RigidMotion, SceneParts};
use selvedge_core::glam::DVec3;

const LOWER: Field = Field::vector("lower", LENGTH, LARGEST_COORDINATE);
const UPPER: Field = Field::vector("upper", LENGTH, LARGEST_COORDINATE);
const CENTRE: Field = Field::vector("centre", LENGTH, LARGEST_COORDINATE);
const RADIUS: Field = Field::new("radius", LENGTH, 1e-6, LARGEST_COORDINATE);

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["group"],
    needs: &[],
    read: |table, world| {
        let mut pins = Pins::default();
        let mut taken = vec![false; world.cloth_vertices()];
        for table in table.tables("group")? {
            let group = read_group(&table, world)?;
            group.check(world, &mut taken).map_err(|error| match error.field {
                "vertices" => table.error(way(&table), error.message),
                _ => table.placed(&error),
            })?;
            pins.groups.push(group);
        }
        Ok(Box::new(pins))
    },
};

/// Vertices of the cloth that go where they are told, whatever pulls at them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pins {
    /// Each vertex is in one of them at most.
    pub groups: Vec<PinGroup>,
}

/// Pinned vertices that are moved together.
#[derive(Clone, Debug, PartialEq)]
pub struct PinGroup {
    /// As the scene numbers them, through all cloths; [`Scene::part`](crate::Scene::part) knows some by name.
    pub vertices: Vec<u32>,
    /// What moves them.
    pub motion: PinMotion,
}

/// What moves pins.
#[derive(Clone, Debug, PartialEq)]
pub enum PinMotion {
    /// They are fixed to a body, by its index in the scene, where both are at the start.
    Body(usize),
    /// They go on their own: a driven group by [`Simulation::move_pins`](crate::Simulation::move_pins).
    Own(Motion),
}

impl PinGroup {
    /// Vertices that stay where they are.
    #[must_use]
    pub fn resting(vertices: impl Into<Vec<u32>>) -> Self {
        Self {
            vertices: vertices.into(),
            motion: PinMotion::Own(RigidMotion::resting().into()),
        }
    }

    /// Marks its vertices as taken.
    fn check(&self, world: &SceneParts<'_>, taken: &mut [bool]) -> Result<(), ValueError> {
        let wrong = |message: String| Err(ValueError::new("vertices", message));
        if self.vertices.is_empty() {
            return wrong("no vertex of the cloth is in this group".to_owned());
        }
        for &vertex in &self.vertices {
            match taken.get_mut(vertex as usize) {
                None => return wrong(no_vertex(vertex, taken.len())),
                Some(true) => return wrong(format!("vertex {vertex} is pinned twice")),
                Some(taken) => *taken = true,
            }
        }
        match &self.motion {
            PinMotion::Body(body) if *body < world.bodies.len() => match &world.bodies[*body].motion {
                Motion::Animated(_) => {
                    let name = &world.bodies[*body].name;
                    let message =
                        format!("pins cannot follow '{name}', which changes its shape; give them a motion of their own");
                    Err(ValueError::new("follow", message))
                }
                _ => Ok(()),
            },
            PinMotion::Body(body) => {
                let message = format!("there is no body {body}: the scene has {}, from 0 on", world.bodies.len());
                Err(ValueError::new("follow", message))
            }
            PinMotion::Own(motion) => motion.check(self.vertices.len(), world.time_step),
        }
    }
}

/// How a table says which vertices.
const WAYS: [&str; 4] = ["part", "vertices", "box", "ball"];

fn way(table: &Table<'_>) -> &'static str {
    WAYS.into_iter().rev().find(|way| table.has(way)).unwrap_or(WAYS[0])
}

/// Exactly one of `part`, `vertices`, `box` and `ball` says which vertices; `follow` or keyframes where they go.
fn read_group(table: &Table<'_>, world: &SceneParts<'_>) -> Result<PinGroup, SceneError> {
    table.expect_keys(&[&WAYS[..], &["cloth", "follow"], &Motion::KEYS].concat())?;
    if WAYS.into_iter().filter(|way| table.has(way)).count() != 1 {
        let message = "pins need exactly one of `part`, `vertices`, `box` and `ball`".to_owned();
        return Err(table.error("part", message));
    }
    let vertices = match way(table) {
        "box" => within(table, world, in_box(&table.required_table("box")?)?)?,
        "ball" => within(table, world, in_ball(&table.required_table("ball")?)?)?,
        _ => of_cloth(table, world)?,
    };
    let motion = match table.text("follow")? {
        None => PinMotion::Own(Motion::read(table, world.time_step)?),
        Some(_) if table.has("keyframes") => {
            let message = "pins that `follow` a body have no keyframes of their own".to_owned();
            return Err(table.error("keyframes", message));
        }
        Some(name) => {
            let names = || world.bodies.iter().map(|body| body.name.as_str());
            let Some(body) = names().position(|body| body == name) else {
                let message = format!("there is no body '{name}'{}", suggestion(name, names()));
                return Err(table.error("follow", message));
            };
            PinMotion::Body(body)
        }
    };
    Ok(PinGroup { vertices, motion })
}

fn in_box(table: &Table<'_>) -> Result<impl Fn(DVec3) -> bool, SceneError> {
    table.expect_keys(&["lower", "upper"])?;
    let [lower, upper] = [table.required_vector(&LOWER)?, table.required_vector(&UPPER)?];
    Ok(move |p: DVec3| p.cmpge(lower).all() && p.cmple(upper).all())
}

fn in_ball(table: &Table<'_>) -> Result<impl Fn(DVec3) -> bool, SceneError> {
    table.expect_keys(&["centre", "radius"])?;
    let centre = table.required_vector(&CENTRE)?;
    let radius = table.required_number(&RADIUS)?;
    Ok(move |p: DVec3| p.distance(centre) <= radius)
}

/// Of all cloths, or of the one that is named.
fn within(table: &Table<'_>, world: &SceneParts<'_>, is_inside: impl Fn(DVec3) -> bool) -> Result<Vec<u32>, SceneError> {
    let only = if table.has("cloth") {
        Some(named_cloth(table, world)?)
    } else {
        None
    };
    let cloths = world.cloths.iter().zip(world.vertices_of_cloths()).enumerate();
    let wanted = cloths.filter(|(index, _)| only.is_none_or(|only| only == *index));
    let vertices = wanted.flat_map(|(_, (cloth, vertices))| vertices.zip(&cloth.mesh.positions));
    let inside = vertices.filter(|(_, position)| is_inside(**position));
    Ok(inside.map(|(vertex, _)| vertex as u32).collect())
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
            let carrier = match &group.motion {
                PinMotion::Body(body) => *body as Carrier,
                PinMotion::Own(motion) => plan.add_motion(motion.clone(), group.vertices.clone()),
            };
            plan.pins.push(carrier);
            for &vertex in &group.vertices {
                plan.pin(vertex, carrier);
            }
        }
    }
}
