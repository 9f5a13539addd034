//! `[[body]]`: what the cloth meets.

use super::error::SceneError;
use super::motion::RigidMotion;
use super::quantity::LENGTH;
use super::table::Table;
use super::{WORLD, shapes};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;

/// A rigid body on a prescribed motion.
#[derive(Clone, Debug)]
pub struct Body {
    /// Its name in the scene and in messages.
    pub name: String,
    /// Its surface at rest.
    pub mesh: Mesh,
    /// Where it goes.
    pub motion: RigidMotion,
    /// Two points and a radius if it is a capsule or a ball: then contact is with the smooth surface.
    pub(crate) capsule: Option<([DVec3; 2], f64)>,
}

#[derive(Clone, Copy)]
enum Shape {
    Capsule,
    Ball,
    File,
}

const SHAPES: [(&str, Shape); 3] = [("capsule", Shape::Capsule), ("ball", Shape::Ball), ("file", Shape::File)];

impl Body {
    pub(super) fn read(table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        let own: &[&str] = match table.required_choice("shape", &SHAPES)? {
            Shape::Capsule => &["from", "to", "radius", "around"],
            Shape::Ball => &["centre", "radius", "around"],
            Shape::File => &["file"],
        };
        let keys = [&["name", "shape"], &RigidMotion::KEYS[..], own].concat();
        table.expect_keys(&keys)?;
        let Some(name) = table.text("name")? else {
            let message = "[body] needs `name`, such as \"arm\"".to_owned();
            return Err(table.error("name", message));
        };
        let radius = || table.required_number("radius", LENGTH, 1e-4..=WORLD);
        let around = || table.count("around", 6..=1024).map(|n| n.unwrap_or(24) as u32);
        let (mesh, capsule) = match table.required_choice("shape", &SHAPES)? {
            Shape::Capsule => {
                let ends = [
                    table.required_vector("from", LENGTH, WORLD)?,
                    table.required_vector("to", LENGTH, WORLD)?,
                ];
                let radius = radius()?;
                (shapes::capsule(ends, radius, around()?), Some((ends, radius)))
            }
            Shape::Ball => {
                let ends = [table.required_vector("centre", LENGTH, WORLD)?; 2];
                let radius = radius()?;
                (shapes::capsule(ends, radius, around()?), Some((ends, radius)))
            }
            Shape::File => (super::mesh_file(table)?, None),
        };
        Ok(Self {
            name: name.to_owned(),
            mesh,
            motion: RigidMotion::read(table, time_step)?,
            capsule,
        })
    }
}
