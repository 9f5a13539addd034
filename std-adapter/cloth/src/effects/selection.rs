//! The vertices and the motion of a group of pins or attachments.

use super::vertices::{named_cloth, no_vertex, of_cloth};
use crate::input::{Field, LARGEST_COORDINATE, LENGTH, SceneError, Table, ValueError, suggestion};
use crate::world::{BodyMotion, SceneParts};
use selvedge_core::glam::DVec3;

const LOWER: Field = Field::vector("lower", LENGTH, LARGEST_COORDINATE);
const UPPER: Field = Field::vector("upper", LENGTH, LARGEST_COORDINATE);
const CENTRE: Field = Field::vector("centre", LENGTH, LARGEST_COORDINATE);
const RADIUS: Field = Field::new("radius", LENGTH, 1e-6, LARGEST_COORDINATE);

/// The keys that select vertices; a table has exactly one of them.
pub(super) const SELECTORS: [&str; 4] = ["part", "vertices", "box", "ball"];

/// The motion of a group of vertices.
#[derive(Clone, Debug, PartialEq)]
pub enum PinMotion {
    /// They are fixed to a body at its initial placement. The body is given by its index in the scene.
    Body(usize),
    /// They have a motion of their own. [`Simulation::move_pins`](crate::Simulation::move_pins) moves a driven group of pins.
    Own(BodyMotion),
}

crate::identify!(enum PinMotion { 0 => Body(body), 1 => Own(motion) });

/// Returns the key that selects the vertices.
fn selector(table: &Table<'_>) -> &'static str {
    SELECTORS.into_iter().rev().find(|key| table.has(key)).unwrap_or(SELECTORS[0])
}

/// Returns the keys of a group's table: the common ones and `own`.
pub(super) fn group_keys<'a>(own: &[&'a str]) -> Vec<&'a str> {
    [&SELECTORS[..], &["cloth", "follow"], &BodyMotion::KEYS, own].concat()
}

/// Adds the place to an error about a group.
pub(super) fn placed(table: &Table<'_>, error: ValueError) -> SceneError {
    match error.field {
        "vertices" => table.error(selector(table), error.message),
        _ => table.placed(&error),
    }
}

/// Reads the vertices, which exactly one of `part`, `vertices`, `box` and `ball` selects.
pub(super) fn read_vertices(table: &Table<'_>, world: &SceneParts<'_>) -> Result<Vec<u32>, SceneError> {
    if SELECTORS.into_iter().filter(|key| table.has(key)).count() != 1 {
        let message = "a group needs exactly one of `part`, `vertices`, `box` and `ball`".to_owned();
        return Err(table.error("part", message));
    }
    match selector(table) {
        "box" => within(table, world, in_box(&table.required_table("box")?)?),
        "ball" => within(table, world, in_ball(&table.required_table("ball")?)?),
        _ => of_cloth(table, world),
    }
}

/// Reads the motion: `follow`, or keyframes.
pub(super) fn read_motion(table: &Table<'_>, world: &SceneParts<'_>) -> Result<PinMotion, SceneError> {
    match table.text("follow")? {
        None => Ok(PinMotion::Own(BodyMotion::read(table, world.time_step)?)),
        Some(_) if table.has("keyframes") => {
            let message = "a group that follows a body (`follow`) has no keyframes of its own".to_owned();
            Err(table.error("keyframes", message))
        }
        Some(name) => {
            let names = || world.bodies.iter().map(|body| body.name.as_str());
            let Some(body) = names().position(|body| body == name) else {
                let message = format!("there is no body '{name}'{}", suggestion(name, names()));
                return Err(table.error("follow", message));
            };
            Ok(PinMotion::Body(body))
        }
    }
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

/// Selects vertices of all cloths, or of the one that is named.
fn within(table: &Table<'_>, world: &SceneParts<'_>, is_inside: impl Fn(DVec3) -> bool) -> Result<Vec<u32>, SceneError> {
    let only = if table.has("cloth") {
        Some(named_cloth(table, world)?)
    } else {
        None
    };
    let cloths = world.cloths.iter().zip(world.vertices_of_cloths()).enumerate();
    let wanted = cloths.filter(|(index, _)| only.is_none_or(|only| only == *index));
    let vertices = wanted.flat_map(|(_, (cloth, vertices))| vertices.zip(cloth.start()));
    let inside = vertices.filter(|(_, position)| is_inside(**position));
    Ok(inside.map(|(vertex, _)| vertex as u32).collect())
}

/// Checks that there are vertices, that all are of cloth, and that none of them is `taken`. Marks them as taken. Messages contain
/// `done`, such as "pinned".
pub(super) fn check_vertices(vertices: &[u32], taken: &mut [bool], done: &str) -> Result<(), ValueError> {
    let wrong = |message: String| Err(ValueError::new("vertices", message));
    if vertices.is_empty() {
        return wrong("no vertex of the cloth is in this group".to_owned());
    }
    for &vertex in vertices {
        match taken.get_mut(vertex as usize) {
            None => return wrong(no_vertex(vertex, taken.len())),
            Some(true) => return wrong(format!("vertex {vertex} is {done} twice")),
            Some(taken) => *taken = true,
        }
    }
    Ok(())
}

pub(super) fn check_body(body: usize, world: &SceneParts<'_>) -> Result<(), ValueError> {
    if body < world.bodies.len() {
        return Ok(());
    }
    let message = format!(
        "there is no body {body}: the scene has {}, numbered from 0",
        world.bodies.len()
    );
    Err(ValueError::new("follow", message))
}
