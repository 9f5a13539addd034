//! `[[body]]`: what the cloth meets.

use super::motion::RigidMotion;
use super::shapes;
use crate::input::{LARGEST_COORDINATE, LENGTH, SceneError, Table};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;

/// A rigid, kinematic body: it follows a given motion.
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
enum BodyShape {
    Capsule,
    Ball,
    File,
}

const SHAPES: [(&str, BodyShape); 3] = [
    ("capsule", BodyShape::Capsule),
    ("ball", BodyShape::Ball),
    ("file", BodyShape::File),
];

impl Body {
    pub(crate) fn read(table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        let own: &[&str] = match table.required_choice("shape", &SHAPES)? {
            BodyShape::Capsule => &["from", "to", "radius", "around"],
            BodyShape::Ball => &["centre", "radius", "around"],
            BodyShape::File => &["file"],
        };
        let keys = [&["name", "shape"], &RigidMotion::KEYS[..], own].concat();
        table.expect_keys(&keys)?;
        let Some(name) = table.text("name")? else {
            let message = "[body] needs `name`, such as \"arm\"".to_owned();
            return Err(table.error("name", message));
        };
        let radius = || table.required_number("radius", LENGTH, 1e-4..=LARGEST_COORDINATE);
        let around = || table.count("around", 6..=1024).map(|n| n.unwrap_or(24) as u32);
        let (mesh, capsule) = match table.required_choice("shape", &SHAPES)? {
            BodyShape::Capsule => {
                let ends = [
                    table.required_vector("from", LENGTH, LARGEST_COORDINATE)?,
                    table.required_vector("to", LENGTH, LARGEST_COORDINATE)?,
                ];
                let radius = radius()?;
                (shapes::capsule(ends, radius, around()?), Some((ends, radius)))
            }
            BodyShape::Ball => {
                let ends = [table.required_vector("centre", LENGTH, LARGEST_COORDINATE)?; 2];
                let radius = radius()?;
                (shapes::capsule(ends, radius, around()?), Some((ends, radius)))
            }
            BodyShape::File => (shapes::of_file(table)?, None),
        };
        Ok(Self {
            name: name.to_owned(),
            mesh,
            motion: RigidMotion::read(table, time_step)?,
            capsule,
        })
    }
}
