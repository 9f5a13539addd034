//! Scenes: what is to be simulated, as a TOML file or code says it.
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

use super::effects::{self, Effect, Gravity};
use super::input::{AREA_DENSITY, FREQUENCY, Field, LARGEST_TIME, SceneError, Source, TIME, Table, ValueError};
use super::world::{Body, Cloth, SceneParts};
use selvedge_core::glam::DVec3;
use selvedge_files::bytes::Fingerprint;
use selvedge_files::excerpt::excerpt;
use std::path::Path;

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

/// A scene: cloth, bodies and effects. Read from a file, or made in code:
///
/// ```
/// use selvedge_cloth::effects::{Bend, BodyContact, Gravity, SelfCollision, Stretch, Thickness};
/// use selvedge_cloth::{Body, Cloth, Motion, Placement, Scene, Simulation};
/// use selvedge_cloth::glam::DVec3;
///
/// let cloth = Cloth::sheet(DVec3::new(-0.15, -0.15, 0.12), [DVec3::X * 0.3, DVec3::Y * 0.3], [12, 12], 0.2)?;
/// let mut scene = Scene::new(cloth, 2e-3);
/// let mut ball = Body::ball("ball", DVec3::ZERO, 0.1, 24)?;
/// ball.motion = Motion::Driven(Placement::default());
/// scene.bodies.push(ball);
/// scene.add(Gravity::default()).add(Stretch::isotropic(1000.0)).add(Bend::isotropic(1e-5));
/// scene.add(BodyContact(Thickness::of(4e-3))).add(SelfCollision(Thickness::of(4e-3)));
///
/// let mut simulation = Simulation::new(scene, 1)?;
/// for step in 1..=50 {
///     simulation.place_body(0, Placement::at(DVec3::Z * (0.001 * f64::from(step))))?;
///     simulation.step()?;
/// }
/// let lowest = simulation.positions()[..169].iter().map(|p| p.z).fold(1.0, f64::min);
/// assert!(lowest > 0.0 && simulation.is_certified());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
    /// The file's text; empty if there is no file.
    pub text: String,
    /// What to do when the cloth cannot go on.
    pub on_blocked: OnBlocked,
    /// The effects called for, in the order in which they run.
    pub(crate) effects: Vec<Box<dyn Effect>>,
}

const TIME_STEP: Field = Field::new("time_step", TIME, 1e-6, 0.1);
const FRAME_RATE: Field = Field::new("frames_per_second", FREQUENCY, 0.001, 1e6);

/// As long as a time step, and up to a day and more.
fn duration_field(time_step: f64) -> Field {
    Field::new("duration", TIME, time_step, LARGEST_TIME)
}

impl Scene {
    /// A cloth alone, and the length of a step in seconds; for as long as it is run, without any effect yet.
    #[must_use]
    pub fn new(cloth: Cloth, time_step: f64) -> Self {
        Self {
            name: "scene".to_owned(),
            cloth,
            bodies: Vec::new(),
            time_step,
            duration: LARGEST_TIME,
            frame_rate: 60.0,
            up: DVec3::Z,
            text: String::new(),
            on_blocked: OnBlocked::default(),
            effects: Vec::new(),
        }
    }

    /// Calls for an effect, instead of one of the same name if there is one. In which order they are added does not matter for ours; a
    /// caller's own run after them, in the order in which they are added.
    pub fn add(&mut self, effect: impl Effect + 'static) -> &mut Self {
        let name = effect.name();
        self.effects.retain(|other| other.name() != name);
        let rank = effects::rank(name);
        let place = self.effects.partition_point(|other| effects::rank(other.name()) <= rank);
        self.effects.insert(place, Box::new(effect));
        self
    }

    /// Whether all of it makes sense, alone and together. A scene from a file does; [`Simulation::new`](crate::Simulation::new) asks.
    ///
    /// # Errors
    /// What does not, and what would.
    pub fn check(&self) -> Result<(), ValueError> {
        TIME_STEP.check(self.time_step)?;
        duration_field(self.time_step).check(self.duration)?;
        FRAME_RATE.check(self.frame_rate)?;
        self.cloth.check()?;
        for (index, body) in self.bodies.iter().enumerate() {
            check_name(&self.bodies[..index], body)?;
            body.check(self.time_step)?;
        }
        let world = SceneParts {
            cloth: &self.cloth,
            bodies: &self.bodies,
            time_step: self.time_step,
        };
        effects::check(&self.effects, &world)
    }

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
        let time_step = root.required_number(&TIME_STEP)?;
        let duration = root.required_number(&duration_field(time_step))?;
        let cloth = Cloth::read(&root.required_table("cloth")?)?;
        let bodies = read_bodies(&root, time_step)?;
        let world = SceneParts {
            cloth: &cloth,
            bodies: &bodies,
            time_step,
        };
        let effects = match root.table("effects")? {
            Some(table) => effects::read(&table, &world)?,
            None => Vec::new(),
        };
        let gravity = match root.table("effects")? {
            Some(table) => Gravity::read_acceleration(&table)?,
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
            frame_rate: root.number(&FRAME_RATE)?.unwrap_or(60.0),
            on_blocked: root.choice("on_blocked", &choices)?.unwrap_or_default(),
            up: gravity.map_or(DVec3::Z, |acceleration| -acceleration),
            text: text.to_owned(),
            time_step,
            duration,
            cloth,
            bodies,
            effects,
        })
    }

    /// The effects that the scene calls for, in the order in which they run.
    #[must_use]
    pub fn effect_names(&self) -> Vec<&'static str> {
        self.effects.iter().map(|effect| effect.name()).collect()
    }

    /// Forgets all effects but the first `count`, in the order in which they run. What an effect needs runs before it, so that the
    /// rest is a scene as well. It is another scene for checkpoints.
    pub fn keep_first_effects(&mut self, count: usize) {
        self.effects.truncate(count);
    }

    /// What the cloth is made of, for people to read: its weight, and what effects say of it, each with its value and unit.
    #[must_use]
    pub fn fabric(&self) -> Vec<(&'static str, String)> {
        let mut fabric = vec![("weight", AREA_DENSITY.written_short(self.cloth.density))];
        fabric.extend(self.effects.iter().flat_map(|effect| effect.fabric()));
        fabric
    }

    /// What trades time for accuracy, by name, each with its value and unit: the time step, and settings of effects, those that the
    /// file leaves to their defaults included.
    #[must_use]
    pub fn settings(&self) -> Vec<(String, String)> {
        let mut settings = vec![("time step".to_owned(), TIME.written_short(self.time_step))];
        for effect in &self.effects {
            let named = effect.settings().into_iter();
            settings.extend(named.map(|(name, value)| (format!("{}: {name}", effect.name()), value)));
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

    /// Tells checkpoints of this scene from others': from its text and all that it was made into.
    pub(crate) fn fingerprint(&self) -> u64 {
        // Numbers are written so that they read back.
        let mut fingerprint = Fingerprint::default();
        let mut take = |bytes: &[u8]| fingerprint.take(bytes);
        take(self.text.as_bytes());
        let Cloth {
            density, velocity, warp, ..
        } = &self.cloth;
        let numbers = (self.time_step, self.on_blocked, density, velocity, warp, &self.effects);
        take(format!("{numbers:?}").as_bytes());
        for body in &self.bodies {
            take(format!("{:?}", (&body.name, &body.motion)).as_bytes());
        }
        let meshes = std::iter::once(&self.cloth.mesh).chain(self.bodies.iter().map(|body| &body.mesh));
        for mesh in meshes {
            let coordinates = mesh.positions.iter().flat_map(|position| position.to_array());
            coordinates.for_each(|x| take(&x.to_le_bytes()));
            mesh.triangles.iter().flatten().for_each(|vertex| take(&vertex.to_le_bytes()));
        }
        fingerprint.value()
    }
}

/// No two bodies have one name, which messages and scenes tell them by.
fn check_name(others: &[Body], body: &Body) -> Result<(), ValueError> {
    if others.iter().any(|other| other.name == body.name) {
        let message = format!("there are two bodies named '{}'", excerpt(&body.name, 40));
        return Err(ValueError::new("name", message));
    }
    Ok(())
}

fn read_bodies(root: &Table<'_>, time_step: f64) -> Result<Vec<Body>, SceneError> {
    let mut bodies: Vec<Body> = Vec::new();
    for table in root.tables("body")? {
        let body = Body::read(&table, time_step)?;
        check_name(&bodies, &body).map_err(|error| table.placed(&error))?;
        bodies.push(body);
    }
    Ok(bodies)
}
