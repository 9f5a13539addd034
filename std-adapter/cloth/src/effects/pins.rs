//! Pins: vertices that are kinematic, moved by keyframes of their own or by the body that they follow.

use super::registration::{Effect, Registration};
use crate::input::{LARGEST_COORDINATE, LENGTH, SceneError, Table, suggestion};
use crate::plan::Plan;
use crate::step::Carrier;
use crate::world::{RigidMotion, World};

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["group"],
    needs: &[],
    read: |table, world| {
        let groups = table.tables("group")?;
        if groups.is_empty() {
            let message = "pins need at least one [[effects.pins.group]]".to_owned();
            return Err(table.error("group", message));
        }
        let mut taken = vec![false; world.cloth.mesh.positions.len()];
        let groups = groups.iter().map(|group| read_group(group, world, &mut taken));
        Ok(Box::new(Pins {
            groups: groups.collect::<Result<_, _>>()?,
        }))
    },
};

#[derive(Debug)]
struct Pins {
    groups: Vec<Group>,
}

#[derive(Debug)]
struct Group {
    vertices: Vec<u32>,
    follows: Follows,
}

#[derive(Debug)]
enum Follows {
    Body(usize),
    Own(RigidMotion),
}

/// Exactly one of `part`, `vertices`, `box` and `ball` says which vertices; `follow` or keyframes where they go.
fn read_group(table: &Table<'_>, world: &World<'_>, taken: &mut [bool]) -> Result<Group, SceneError> {
    let own = &["part", "vertices", "box", "ball", "follow", "pivot", "axis", "keyframes"];
    table.expect_keys(own)?;
    let count = taken.len() as u64;
    let ways = ["part", "vertices", "box", "ball"].map(|key| table.has(key));
    let vertices = match ways {
        [true, false, false, false] => {
            let part = table.text("part")?.unwrap_or_default();
            let vertices = world.cloth.selection(part);
            vertices.map_err(|message| table.error("part", message))?.to_vec()
        }
        [false, true, false, false] => {
            let vertices = table.counts("vertices", 0..=count - 1)?.unwrap_or_default();
            vertices.into_iter().map(|vertex| vertex as u32).collect()
        }
        [false, false, true, false] => in_box(&table.required_table("box")?, world)?,
        [false, false, false, true] => in_ball(&table.required_table("ball")?, world)?,
        _ => {
            let message = "pins need exactly one of `part`, `vertices`, `box` and `ball`".to_owned();
            return Err(table.error("part", message));
        }
    };
    if vertices.is_empty() {
        let message = "no vertex of the cloth is in this group".to_owned();
        let ways = ["vertices", "box", "ball"];
        let way = ways.into_iter().find(|key| table.has(key));
        return Err(table.error(way.unwrap_or("part"), message));
    }
    for &vertex in &vertices {
        if std::mem::replace(&mut taken[vertex as usize], true) {
            let message = format!("vertex {vertex} is pinned twice");
            return Err(table.error("vertices", message));
        }
    }
    let follows = match table.text("follow")? {
        None => Follows::Own(RigidMotion::read(table, world.time_step)?),
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
            Follows::Body(body)
        }
    };
    Ok(Group { vertices, follows })
}

fn in_box(table: &Table<'_>, world: &World<'_>) -> Result<Vec<u32>, SceneError> {
    table.expect_keys(&["lower", "upper"])?;
    let lower = table.required_vector("lower", LENGTH, LARGEST_COORDINATE)?;
    let upper = table.required_vector("upper", LENGTH, LARGEST_COORDINATE)?;
    let positions = world.cloth.mesh.positions.iter().enumerate();
    let inside = positions.filter(|(_, p)| p.cmpge(lower).all() && p.cmple(upper).all());
    Ok(inside.map(|(vertex, _)| vertex as u32).collect())
}

fn in_ball(table: &Table<'_>, world: &World<'_>) -> Result<Vec<u32>, SceneError> {
    table.expect_keys(&["centre", "radius"])?;
    let centre = table.required_vector("centre", LENGTH, LARGEST_COORDINATE)?;
    let radius = table.required_number("radius", LENGTH, 1e-6..=LARGEST_COORDINATE)?;
    let positions = world.cloth.mesh.positions.iter().enumerate();
    let inside = positions.filter(|(_, p)| p.distance(centre) <= radius);
    Ok(inside.map(|(vertex, _)| vertex as u32).collect())
}

impl Effect for Pins {
    fn register(self: Box<Self>, plan: &mut Plan<'_>) {
        for group in self.groups {
            let carrier = match group.follows {
                Follows::Body(body) => body as Carrier,
                Follows::Own(motion) => {
                    plan.motions.push(motion);
                    plan.motions.len() as Carrier - 1
                }
            };
            for vertex in group.vertices {
                plan.pin(vertex, carrier);
            }
        }
    }
}
