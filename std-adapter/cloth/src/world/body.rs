//! `[[body]]`: what the cloth meets.

use super::motion::{Motion, RigidMotion};
use super::shapes;
use crate::input::{Count, Field, LARGEST_COORDINATE, LENGTH, SceneError, Table, ValueError};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;

/// A kinematic body: it goes where it is told, whatever the cloth does.
///
/// ```
/// use selvedge_cloth::{Body, Motion, Placement};
/// use selvedge_cloth::glam::DVec3;
///
/// let mut ball = Body::ball("ball", DVec3::ZERO, 0.1, 24)?;
/// ball.motion = Motion::Driven(Placement::at(DVec3::Z));
/// assert!(Body::ball("ball", DVec3::ZERO, -0.1, 24).is_err());
/// # Ok::<(), selvedge_cloth::ValueError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Body {
    /// Its name in the scene and in messages.
    pub name: String,
    /// Its surface at rest.
    pub mesh: Mesh,
    /// Where it goes; it rests unless told otherwise.
    pub motion: Motion,
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

const FROM: Field = Field::vector("from", LENGTH, LARGEST_COORDINATE);
const TO: Field = Field::vector("to", LENGTH, LARGEST_COORDINATE);
const CENTRE: Field = Field::vector("centre", LENGTH, LARGEST_COORDINATE);
const RADIUS: Field = Field::new("radius", LENGTH, 1e-4, LARGEST_COORDINATE);
const AROUND: Count = Count::new("around", 6, 1024);

impl Body {
    /// All points within `radius` of the line from one point to another, in metres, as a mesh with so many vertices `around`. The cloth
    /// slides on the smooth surface.
    ///
    /// # Errors
    /// If a number is beyond its range.
    pub fn capsule(name: &str, [from, to]: [DVec3; 2], radius: f64, around: u32) -> Result<Self, ValueError> {
        let checked = FROM.check_vector(from).and(TO.check_vector(to));
        let checked = checked.and(RADIUS.check(radius)).and(AROUND.check(around));
        checked.map_err(|error| error.of(name))?;
        Ok(Self {
            capsule: Some(([from, to], radius)),
            ..Self::of_mesh(name, shapes::capsule([from, to], radius, around))
        })
    }

    /// A ball, in metres, as a mesh with so many vertices `around`. The cloth slides on the smooth surface.
    ///
    /// # Errors
    /// If a number is beyond its range.
    pub fn ball(name: &str, centre: DVec3, radius: f64, around: u32) -> Result<Self, ValueError> {
        CENTRE.check_vector(centre).map_err(|error| error.of(name))?;
        Self::capsule(name, [centre; 2], radius, around)
    }

    /// Any surface, in metres.
    #[must_use]
    pub fn of_mesh(name: &str, mesh: Mesh) -> Self {
        Self {
            name: name.to_owned(),
            mesh,
            motion: Motion::Keyframes(RigidMotion::resting()),
            capsule: None,
        }
    }

    /// What the mesh and the motion may be.
    pub(crate) fn check(&self, time_step: f64) -> Result<(), ValueError> {
        let checked = shapes::check(&self.mesh).and_then(|()| self.motion.check(time_step));
        checked.map_err(|error| error.of(&self.name))
    }

    pub(crate) fn read(table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        let own: &[&str] = match table.required_choice("shape", &SHAPES)? {
            BodyShape::Capsule => &["from", "to", "radius", "around"],
            BodyShape::Ball => &["centre", "radius", "around"],
            BodyShape::File => &["file"],
        };
        let keys = [&["name", "shape"], &Motion::KEYS[..], own].concat();
        table.expect_keys(&keys)?;
        let Some(name) = table.text("name")? else {
            let message = "[body] needs `name`, such as \"arm\"".to_owned();
            return Err(table.error("name", message));
        };
        let radius = || table.required_number(&RADIUS);
        let around = || table.count(&AROUND).map(|n| n.unwrap_or(24));
        let made = match table.required_choice("shape", &SHAPES)? {
            BodyShape::Capsule => {
                let ends = [table.required_vector(&FROM)?, table.required_vector(&TO)?];
                Self::capsule(name, ends, radius()?, around()?)
            }
            BodyShape::Ball => Self::ball(name, table.required_vector(&CENTRE)?, radius()?, around()?),
            BodyShape::File => Ok(Self::of_mesh(name, shapes::of_file(table)?)),
        };
        let mut body = made.map_err(|error| table.placed(&error))?;
        body.motion = Motion::read(table, time_step)?;
        Ok(body)
    }
}
