//! Bodies, `[[body]]`: the obstacles of the cloth.

use super::animation::{Animation, RATE, START};
use super::free::FreeMotion;
use super::keyframes::KeyframeMotion;
use super::motion::BodyMotion;
use super::{read_mesh, shapes};
use crate::input::{Count, Field, LARGEST_COORDINATE, LENGTH, SceneError, Table, ValueError};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use selvedge_files::animation::{self, AnimationProblem, Choice};
use selvedge_files::mesh::{self, CacheFormat, MeshError, MeshSequence, ReadOptions};

/// A body. It follows its motion, and the cloth does not push it, unless it is [free](BodyMotion::Free).
///
/// ```
/// use selvedge_cloth::{Body, BodyMotion, Placement};
/// use selvedge_cloth::glam::DVec3;
///
/// let mut ball = Body::ball("ball", DVec3::ZERO, 0.1, 24)?;
/// ball.motion = BodyMotion::Driven(Placement::at(DVec3::Z));
/// assert!(Body::ball("ball", DVec3::ZERO, -0.1, 24).is_err());
/// # Ok::<(), selvedge_cloth::ValueError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Body {
    /// The name in the scene and in messages. Names of bodies in a scene must differ.
    pub name: String,
    /// The surface at rest, in metres.
    pub mesh: Mesh,
    /// The motion; the body rests by default.
    pub motion: BodyMotion,
    /// Two points and a radius if the body is a capsule or a ball. Contact then uses the smooth surface.
    pub(crate) capsule: Option<([DVec3; 2], f64)>,
}

crate::identify!(Body {
    name,
    mesh,
    motion,
    capsule
});

#[derive(Clone, Copy)]
enum BodyShape {
    Capsule,
    Ball,
    File,
    Mesh,
    Frames,
    Figure,
}

const SHAPES: [(&str, BodyShape); 6] = [
    ("capsule", BodyShape::Capsule),
    ("ball", BodyShape::Ball),
    ("file", BodyShape::File),
    ("mesh", BodyShape::Mesh),
    ("frames", BodyShape::Frames),
    ("gltf", BodyShape::Figure),
];

const FROM: Field = Field::vector("from", LENGTH, LARGEST_COORDINATE);
const TO: Field = Field::vector("to", LENGTH, LARGEST_COORDINATE);
const CENTRE: Field = Field::vector("centre", LENGTH, LARGEST_COORDINATE);
const RADIUS: Field = Field::new("radius", LENGTH, 1e-4, LARGEST_COORDINATE);
const AROUND: Count = Count::new("around", 6, 1024);

impl Body {
    /// Makes a capsule: all points within `radius` of a line between two points, in metres. The mesh has `around` vertices around
    /// the axis. The cloth slides on the smooth surface.
    ///
    /// # Errors
    /// Returns an error if a number is out of range.
    pub fn capsule(name: &str, [from, to]: [DVec3; 2], radius: f64, around: u32) -> Result<Self, ValueError> {
        let checked = FROM.check_vector(from).and(TO.check_vector(to));
        let checked = checked.and(RADIUS.check(radius)).and(AROUND.check(around));
        checked.map_err(|error| error.with_owner(name))?;
        Ok(Self {
            capsule: Some(([from, to], radius)),
            ..Self::from_mesh(name, shapes::capsule([from, to], radius, around))
        })
    }

    /// Makes a ball, in metres. The mesh has `around` vertices around its equator. The cloth slides on the smooth surface.
    ///
    /// # Errors
    /// Returns an error if a number is out of range.
    pub fn ball(name: &str, centre: DVec3, radius: f64, around: u32) -> Result<Self, ValueError> {
        CENTRE.check_vector(centre).map_err(|error| error.with_owner(name))?;
        Self::capsule(name, [centre; 2], radius, around)
    }

    /// Makes a body from any surface, in metres.
    #[must_use]
    pub fn from_mesh(name: &str, mesh: Mesh) -> Self {
        Self {
            name: name.to_owned(),
            mesh,
            motion: BodyMotion::Keyframes(KeyframeMotion::resting()),
            capsule: None,
        }
    }

    /// Makes a body that deforms from its triangles and the motion of its vertices.
    #[must_use]
    pub fn animated(name: &str, triangles: Vec<[u32; 3]>, animation: Animation) -> Self {
        let positions = animation.positions_at(animation.span()[0]);
        Self {
            motion: BodyMotion::Animated(animation),
            ..Self::from_mesh(name, Mesh { positions, triangles })
        }
    }

    pub(crate) fn check(&self, time_step: f64) -> Result<(), ValueError> {
        let checked = shapes::check(&self.mesh).and_then(|()| self.check_motion(time_step));
        checked.map_err(|error| error.with_owner(&self.name))
    }

    fn check_motion(&self, time_step: f64) -> Result<(), ValueError> {
        match &self.motion {
            BodyMotion::Free(motion) => motion.check(&self.mesh),
            motion => motion.check(&self.mesh.positions, time_step),
        }
    }

    pub(crate) fn read(table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        let shape = table.required_choice("shape", &SHAPES)?;
        let own: &[&str] = match shape {
            BodyShape::Capsule => &["from", "to", "radius", "around"],
            BodyShape::Ball => &["centre", "radius", "around"],
            BodyShape::File => &[&["file", "group"], &read_mesh::MESH_KEYS[..]].concat(),
            BodyShape::Mesh => &[&["mesh", "frames_per_second", "start"], &read_mesh::MESH_KEYS[..]].concat(),
            BodyShape::Frames => &[
                "files",
                "mesh",
                "frames_per_second",
                "start",
                "scale",
                "unit",
                "rotation",
                "translation",
            ],
            BodyShape::Figure => &[
                "file",
                "node",
                "animation",
                "start",
                "scale",
                "unit",
                "rotation",
                "translation",
            ],
        };
        let motion: &[&str] = match shape {
            BodyShape::Frames | BodyShape::Figure => &[],
            _ => &[&BodyMotion::KEYS[..], &FreeMotion::KEYS].concat(),
        };
        table.expect_keys(&[&["name", "shape"], motion, own].concat())?;
        let Some(name) = table.text("name")? else {
            let message = "[body] needs `name`, such as \"arm\"".to_owned();
            return Err(table.error("name", message));
        };
        let radius = || table.required_number(&RADIUS);
        let around = || table.count(&AROUND).map(|n| n.unwrap_or(24));
        let made = match shape {
            BodyShape::Capsule => {
                let ends = [table.required_vector(&FROM)?, table.required_vector(&TO)?];
                Self::capsule(name, ends, radius()?, around()?)
            }
            BodyShape::Ball => Self::ball(name, table.required_vector(&CENTRE)?, radius()?, around()?),
            BodyShape::File => Ok(Self::from_mesh(name, read_mesh::of_file(table)?)),
            BodyShape::Mesh if !table.named_mesh()?.frames.is_empty() => {
                return Self::read_frames_of_code(name, table, time_step);
            }
            BodyShape::Mesh => Ok(Self::from_mesh(name, read_mesh::of_code(table)?)),
            BodyShape::Frames => return Self::read_frames(name, table, time_step),
            BodyShape::Figure => return Self::read_figure(name, table, time_step),
        };
        let mut body = made.map_err(|error| table.placed(&error))?;
        body.motion = match BodyMotion::KEYS.into_iter().find(|key| table.has(key)) {
            Some(key) if FreeMotion::is_in(table) => {
                return Err(table.error(key, format!("a free body has no `{key}`: it moves by itself")));
            }
            None if FreeMotion::is_in(table) => FreeMotion::read(table)?.into(),
            _ => BodyMotion::read(table, time_step)?,
        };
        let checked = body.check_motion(time_step);
        checked.map_err(|error| table.placed(&error.with_owner(name)))?;
        Ok(body)
    }

    fn read_frames_of_code(name: &str, table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        if let Some(key) = BodyMotion::KEYS.into_iter().find(|key| table.has(key)) {
            let message = format!("a mesh with frames moves by them, and has no `{key}`");
            return Err(table.error(key, message));
        }
        let given = table.named_mesh()?;
        let rate = table.required_number(&RATE)?;
        let placement = read_mesh::placement(table)?;
        let mut frames = given.frames.clone();
        frames.iter_mut().for_each(|frame| read_mesh::place(&placement, frame));
        let animation = Animation::from_frames(frames, rate);
        Self::read_animated(name, table, time_step, given.mesh.triangles.clone(), animation, "mesh")
    }

    fn read_frames(name: &str, table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        let files = table.folder().join(table.required_text("files", "\"frames/body-####.ply\"")?);
        let rate = table.required_number(&RATE)?;
        let wrong = |error: MeshError| table.error("files", error.to_string());
        let (triangles, mut frames) = match (CacheFormat::from_path(&files), table.text("mesh")?) {
            (None, None) => {
                let MeshSequence { triangles, frames, .. } = mesh::read_sequence_from(table.files(), &files).map_err(wrong)?;
                (triangles, frames)
            }
            (Some(_), Some(mesh)) => {
                let mesh = read_mesh::read_whole(table, "mesh", &table.folder().join(mesh), &ReadOptions::default())?;
                let frames = mesh::read_point_cache(table.files(), &files, mesh.positions.len()).map_err(wrong)?;
                (mesh.topology.triangles().to_vec(), frames)
            }
            (Some(_), None) => {
                let message = "a point cache has no triangles: name the mesh that it moves, such as `mesh = \"body.obj\"`";
                return Err(table.error("files", message.to_owned()));
            }
            (None, Some(_)) => {
                let message = "`mesh` is for point caches (.mdd, .pc2): numbered files have their own triangles";
                return Err(table.error("mesh", message.to_owned()));
            }
        };
        let placement = read_mesh::placement(table)?;
        frames.iter_mut().for_each(|frame| read_mesh::place(&placement, frame));
        let animation = Animation::from_frames(frames, rate);
        Self::read_animated(name, table, time_step, triangles, animation, "files")
    }

    fn read_figure(name: &str, table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        let file = table.required_text("file", "\"figure.glb\"")?;
        let choice = Choice {
            node: table.text("node")?,
            animation: table.text("animation")?,
            at_rest: false,
        };
        let figure = animation::read_from(table.files(), &table.folder().join(file), &choice).map_err(|error| {
            let key = match error.problem {
                AnimationProblem::NoSuchNode { .. } | AnimationProblem::SeveralNodes { .. } => "node",
                AnimationProblem::NoSuchAnimation { .. } | AnimationProblem::SeveralAnimations { .. } => "animation",
                _ => "file",
            };
            table.error(key, error.to_string())
        })?;
        if let Some(part) = figure.left_out().iter().find(|part| part.may_have_area) {
            return Err(table.error(
                "file",
                format!("{file}: not all of the file can be read: {part}; export it as plain triangles"),
            ));
        }
        let figure = figure.transformed(read_mesh::placement(table)?);
        let triangles = figure.mesh().triangles.clone();
        Self::read_animated(name, table, time_step, triangles, Animation::from_figure(figure), "file")
    }

    /// Reads the remaining keys of an animation, which was read from the value of `key`.
    fn read_animated(
        name: &str,
        table: &Table<'_>,
        time_step: f64,
        triangles: Vec<[u32; 3]>,
        animation: Result<Animation, ValueError>,
        key: &str,
    ) -> Result<Self, SceneError> {
        let start = table.number(&START)?;
        let of_file = |error: ValueError| table.error(key, error.message);
        let animation = animation.map_err(of_file)?;
        let animation = match start {
            None => animation,
            Some(start) => animation.starting_at(start),
        };
        let body = Self::animated(name, triangles, animation);
        body.check(time_step).map_err(of_file)?;
        Ok(body)
    }
}
