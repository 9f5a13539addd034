//! Scenes: what a TOML file calls for.
//!
//! ```
//! use selvedge_cloth::Scene;
//! use std::path::Path;
//!
//! let text = r#"
//! time_step = "2 ms"
//! duration = "1 s"
//!
//! [cloth]
//! shape = "sheet"
//! sides = { first = [0.3, 0, 0], second = [0, 0, 0.3] }
//! cells = [10, 10]
//! density = "200 g/m2"
//!
//! [effects.gravity]
//! "#;
//! let scene = Scene::parse(text, Path::new("fall.toml"))?;
//! assert_eq!(scene.effect_names(), ["gravity"]);
//!
//! let wrong = text.replace("gravity", "gravty");
//! let error = Scene::parse(&wrong, Path::new("fall.toml")).unwrap_err();
//! assert_eq!(error.to_string(), "fall.toml:11:10: there is no effect 'gravty'; did you mean 'gravity'?");
//! # Ok::<(), selvedge_cloth::SceneError>(())
//! ```

mod body;
mod cloth;
mod error;
mod motion;
mod quantity;
mod shapes;
pub(crate) mod table;

pub use body::Body;
pub use cloth::Cloth;
pub use error::SceneError;
pub use motion::RigidMotion;

pub(crate) use error::suggestion;
pub(crate) use motion::Pose;
pub(crate) use quantity::{
    ACCELERATION, AIR_DENSITY, BENDING_STIFFNESS, FREQUENCY, LENGTH, MEMBRANE_STIFFNESS, PRESSURE, RATIO, SPEED,
};

use super::effects::{self, Named};
use quantity::TIME;
use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use selvedge_files::excerpt::excerpt;
use selvedge_files::mesh;
use std::path::Path;
use table::{Source, Table};

/// The largest coordinate that a scene may give, in metres.
pub(crate) const WORLD: f64 = 1e3;
/// The longest time that a scene may give, in seconds.
const LARGEST_TIME: f64 = 1e5;

/// What to do when bodies or pins force the cloth where it cannot go without intersecting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OnBlocked {
    /// End the simulation, and say where.
    #[default]
    Stop,
    /// The clock of bodies and pins waits.
    Hold,
    /// The body's pairs leave the promise until it is apart from the cloth again; where pins are in the way, their clock waits.
    Yield,
}

/// A scene, ready to be simulated.
#[derive(Debug)]
pub struct Scene {
    /// `name`, or the file's.
    pub name: String,
    /// The cloth at rest.
    pub cloth: Cloth,
    /// What it meets.
    pub bodies: Vec<Body>,
    /// Seconds.
    pub time_step: f64,
    /// Seconds.
    pub duration: f64,
    /// How many frames to write for each second simulated.
    pub frame_rate: f64,
    /// Against gravity, of any length; z where the scene names no gravity.
    pub up: DVec3,
    /// The file's text.
    pub text: String,
    /// What to do when the cloth cannot go on.
    pub on_blocked: OnBlocked,
    /// Tells checkpoints of this scene from others': from its text and all its meshes.
    pub(crate) fingerprint: u64,
    /// The effects called for, in the order of the registry.
    pub(crate) effects: Vec<Named>,
}

/// What effects are checked against.
#[derive(Clone, Copy, Debug)]
pub(crate) struct World<'a> {
    pub(crate) cloth: &'a Cloth,
    pub(crate) bodies: &'a [Body],
    /// Seconds.
    pub(crate) time_step: f64,
}

impl Scene {
    /// Reads a scene file. Paths in it are relative to its folder.
    ///
    /// # Errors
    /// If it cannot be read, or something in it is wrong: the message names file, line and column.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let bytes = std::fs::read(path).map_err(|error| SceneError::whole(path, format!("cannot be read: {error}")))?;
        let text = String::from_utf8(bytes)
            .map_err(|_| SceneError::whole(path, "is not UTF-8 text; a scene is a TOML file".to_owned()))?;
        Self::parse(&text, path)
    }

    /// Reads a scene from the text of a file. `path` is for messages and for the paths in it.
    ///
    /// # Errors
    /// If something in it is wrong.
    pub fn parse(text: &str, path: &Path) -> Result<Self, SceneError> {
        let root = toml::de::DeTable::parse(text).map_err(|error| {
            let span = error.span().unwrap_or(0..0);
            SceneError::at(path, text, &span, error.message().trim().replace('\n', ", "))
        })?;
        let source = Source { path, text };
        let root = Table::root(&source, root.get_ref());
        root.expect_keys(&[
            "name",
            "time_step",
            "duration",
            "frames_per_second",
            "on_blocked",
            "cloth",
            "body",
            "effects",
        ])?;
        let time_step = root.required_number("time_step", TIME, 1e-6..=0.1)?;
        let duration = root.required_number("duration", TIME, time_step..=LARGEST_TIME)?;
        let cloth = Cloth::read(&root.required_table("cloth")?)?;
        let bodies = read_bodies(&root, time_step)?;
        let world = World {
            cloth: &cloth,
            bodies: &bodies,
            time_step,
        };
        let effects = match root.table("effects")? {
            Some(table) => effects::read(&table, &world)?,
            None => Vec::new(),
        };
        let gravity = match root.table("effects")? {
            Some(table) => table.table("gravity")?,
            None => None,
        };
        let gravity = match gravity {
            Some(table) => table.vector("acceleration", ACCELERATION, 1e4)?,
            None => None,
        };
        let choices = [
            ("stop", OnBlocked::Stop),
            ("hold", OnBlocked::Hold),
            ("yield", OnBlocked::Yield),
        ];
        let stem = path.file_stem().map(|stem| stem.to_string_lossy());
        Ok(Self {
            name: root
                .text("name")?
                .map_or_else(|| stem.unwrap_or_default().into_owned(), str::to_owned),
            frame_rate: root.number("frames_per_second", FREQUENCY, 0.001..=1e6)?.unwrap_or(60.0),
            on_blocked: root.choice("on_blocked", &choices)?.unwrap_or_default(),
            up: gravity.map_or(DVec3::Z, |acceleration| -acceleration),
            text: text.to_owned(),
            time_step,
            duration,
            fingerprint: fingerprint(text, &cloth, &bodies),
            cloth,
            bodies,
            effects,
        })
    }

    /// The effects that the scene calls for, in the order in which they run.
    #[must_use]
    pub fn effect_names(&self) -> Vec<&'static str> {
        self.effects.iter().map(|(name, _)| *name).collect()
    }

    /// Forgets all effects but the first `count`, in the order in which they run. What an effect needs runs before it, so that the
    /// rest is a scene as well. It is another scene for checkpoints.
    pub fn keep_first_effects(&mut self, count: usize) {
        if count < self.effects.len() {
            self.effects.truncate(count);
            self.fingerprint = self.fingerprint.rotate_left(1 + count as u32);
        }
    }

    /// What trades time for accuracy, by name, each with its value and unit: the time step, and settings of effects, those that the
    /// file leaves to their defaults included.
    #[must_use]
    pub fn settings(&self) -> Vec<(String, String)> {
        let mut settings = vec![("time step".to_owned(), TIME.written_short(self.time_step))];
        for (effect, of_effect) in &self.effects {
            let named = of_effect.settings().into_iter();
            settings.extend(named.map(|(name, value)| (format!("{effect}: {name}"), value)));
        }
        settings
    }

    /// How many steps the duration takes.
    #[must_use]
    pub fn steps(&self) -> u64 {
        // A duration that is a whole number of steps but for rounding is no step more.
        (self.duration / self.time_step - 1e-6).ceil().max(1.0) as u64
    }

    /// How many steps there are from one frame to the next.
    #[must_use]
    pub fn steps_per_frame(&self) -> u64 {
        (1.0 / (self.frame_rate * self.time_step)).round().max(1.0) as u64
    }
}

fn fingerprint(text: &str, cloth: &Cloth, bodies: &[Body]) -> u64 {
    // FNV-1a: the same in every version of every compiler.
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut take = |bytes: &[u8]| {
        for &byte in bytes {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    take(text.as_bytes());
    let meshes = std::iter::once(&cloth.mesh).chain(bodies.iter().map(|body| &body.mesh));
    for position in meshes.flat_map(|mesh| &mesh.positions) {
        position.to_array().iter().for_each(|x| take(&x.to_le_bytes()));
    }
    hash
}

fn read_bodies(root: &Table<'_>, time_step: f64) -> Result<Vec<Body>, SceneError> {
    let mut bodies: Vec<Body> = Vec::new();
    for table in root.tables("body")? {
        let body = Body::read(&table, time_step)?;
        if bodies.iter().any(|other| other.name == body.name) {
            let message = format!("there are two bodies named '{}'", excerpt(&body.name, 40));
            return Err(table.error("name", message));
        }
        bodies.push(body);
    }
    Ok(bodies)
}

/// The mesh of the file that `file` names.
fn mesh_file(table: &Table<'_>) -> Result<Mesh, SceneError> {
    let Some(file) = table.text("file")? else {
        let message = "shape \"file\" needs `file`, such as \"shirt.obj\"".to_owned();
        return Err(table.error("file", message));
    };
    let read = mesh::read(&table.folder().join(file));
    let mesh = read.map_err(|error| table.error("file", error.to_string()))?.mesh;
    match mesh.positions.iter().find(|p| p.abs().max_element() > WORLD) {
        None => Ok(mesh),
        Some(far) => {
            let message = format!("the mesh has a vertex at {far}, more than {WORLD} metres away");
            Err(table.error("file", message))
        }
    }
}
