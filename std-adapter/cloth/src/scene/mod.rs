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

mod file;
mod read_cloth;

use crate::effects::{Called, Effect, Effects};
use crate::input::{AREA_DENSITY, FREQUENCY, Field, LARGEST_TIME, LINEAR_DENSITY, TIME, ValueError, suggestion};
use crate::world::{Body, Cloth, SceneParts};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use selvedge_files::bytes::Fingerprint;
use selvedge_files::excerpt::excerpt;
use std::ops::Range;

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

/// What to do when edges pass through faces where the simulation starts: of the cloth with itself or with bodies, as far as effects are
/// to keep them apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TangledStart {
    /// Do not start, and tell where.
    #[default]
    Refuse,
    /// What meets leaves the promise until it is apart; see [`Simulation::crossings`](crate::Simulation::crossings).
    Tolerate,
    /// Pull it apart before the first step, or tell what is left; see [`Simulation::untangled`](crate::Simulation::untangled).
    Untangle,
}

/// A scene: cloths, bodies and effects. Read from a file, or made in code:
///
/// ```
/// use selvedge_cloth::effects::{Bend, BodyContact, Gravity, SelfCollision, Stretch, Thickness};
/// use selvedge_cloth::{Body, Cloth, BodyMotion, Placement, Scene, Simulation};
/// use selvedge_cloth::glam::DVec3;
///
/// let cloth = Cloth::sheet(DVec3::new(-0.15, -0.15, 0.12), [DVec3::X * 0.3, DVec3::Y * 0.3], [12, 12], 0.2)?;
/// let mut scene = Scene::new(cloth, 2e-3);
/// let mut ball = Body::ball("ball", DVec3::ZERO, 0.1, 24)?;
/// ball.motion = BodyMotion::Driven(Placement::default());
/// scene.bodies.push(ball);
/// scene.add(Gravity::default()).add(Stretch::isotropic(1000.0)).add(Bend::isotropic(1e-5));
/// scene.add(BodyContact(Thickness::new(4e-3))).add(SelfCollision(Thickness::new(4e-3)));
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
    /// What is simulated, at rest. Vertices are numbered through all of them, in this order.
    pub cloths: Vec<Cloth>,
    /// What they meet.
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
    /// What to do when surfaces pass through each other at the start.
    pub tangled_start: TangledStart,
    /// The effects called for, in the order in which they run.
    effects: Effects,
    /// Effects that single cloths have instead of the scene's, with the names of these cloths.
    own: Vec<(String, Effects)>,
}

const TIME_STEP: Field = Field::new("time_step", TIME, 1e-6, 0.1);
const FRAME_RATE: Field = Field::new("frames_per_second", FREQUENCY, 0.001, 1e6);

/// As long as a time step, and up to a day and more.
fn duration_field(time_step: f64) -> Field {
    Field::new("duration", TIME, time_step, LARGEST_TIME)
}

impl Scene {
    /// A cloth alone, and the length of a step in seconds; for as long as it is run, without any effect yet. More cloths are pushed to
    /// [`cloths`](Self::cloths).
    #[must_use]
    pub fn new(cloth: Cloth, time_step: f64) -> Self {
        Self {
            name: "scene".to_owned(),
            cloths: vec![cloth],
            bodies: Vec::new(),
            time_step,
            duration: LARGEST_TIME,
            frame_rate: 60.0,
            up: DVec3::Z,
            text: String::new(),
            on_blocked: OnBlocked::default(),
            tangled_start: TangledStart::default(),
            effects: Effects::default(),
            own: Vec::new(),
        }
    }

    /// Calls for an effect, instead of one of the same name if there is one. In which order they are added does not matter for ours; a
    /// caller's own run after them, in the order in which they are added.
    pub fn add(&mut self, effect: impl Effect + 'static) -> &mut Self {
        self.effects.add(effect);
        self
    }

    /// Gives one cloth an effect of its own, instead of the scene's of the same name. `cloth` is the cloth's name.
    ///
    /// Not for effects that act on the whole scene, such as gravity.
    ///
    /// ```
    /// use selvedge_cloth::effects::Stretch;
    /// use selvedge_cloth::glam::DVec3;
    /// use selvedge_cloth::{Cloth, Scene};
    ///
    /// let sheet = || Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [10, 10], 0.2);
    /// let mut scene = Scene::new(sheet()?.named("coat"), 1e-3);
    /// scene.cloths.push(sheet()?.named("lining"));
    /// scene.add(Stretch::isotropic(500.0)).add_to("lining", Stretch::isotropic(80.0));
    /// scene.check()?;
    /// # Ok::<(), selvedge_cloth::ValueError>(())
    /// ```
    pub fn add_to(&mut self, cloth: &str, effect: impl Effect + 'static) -> &mut Self {
        match self.own.iter_mut().find(|(name, _)| name == cloth) {
            Some((_, own)) => own.add(effect),
            None => {
                let mut own = Effects::default();
                own.add(effect);
                self.own.push((cloth.to_owned(), own));
            }
        }
        self
    }

    /// All cloths at rest, as one mesh: in the order of the scene, with its numbers of vertices.
    #[must_use]
    pub fn all_cloth(&self) -> Mesh {
        let mut all = Mesh::default();
        for Cloth { mesh, .. } in &self.cloths {
            append(&mut all, mesh);
        }
        all
    }

    /// The loose edges of all cloths, on the vertices of [`all_cloth`](Self::all_cloth).
    #[must_use]
    pub fn all_loose_edges(&self) -> Vec<[u32; 2]> {
        let mut first = 0;
        let mut all = Vec::new();
        for Cloth { mesh, topology, .. } in &self.cloths {
            all.extend(topology.loose_edges().map(|edge| edge.map(|vertex| first + vertex)));
            first += mesh.positions.len() as u32;
        }
        all
    }

    /// What contact keeps a cloth from itself, in metres, by its index; `None` if nothing does. Of a rope that is its diameter.
    pub(crate) fn thickness_of(&self, cloth: usize) -> Option<f64> {
        self.called().fabrics().get(cloth)?.thickness
    }

    /// The vertices of a part of a cloth, as the scene numbers them: of pins and seams. `None` if there is no such cloth or part.
    #[must_use]
    pub fn part(&self, cloth: &str, part: &str) -> Option<Vec<u32>> {
        let parts = self.parts().ok()?;
        let index = self.cloths.iter().position(|own| own.name == cloth)?;
        let first = parts.vertices_of_cloths().nth(index)?.start as u32;
        let vertices = self.cloths[index].part(part)?;
        Some(vertices.iter().map(|&vertex| first + vertex).collect())
    }

    /// What effects act on.
    pub(crate) fn parts(&self) -> Result<SceneParts<'_>, ValueError> {
        SceneParts::new(&self.cloths, &self.bodies, self.time_step)
    }

    pub(crate) fn called(&self) -> Called<'_> {
        let own = |cloth: &Cloth| {
            let own = self.own.iter().find(|(name, _)| *name == cloth.name);
            own.map_or_else(Effects::default, |(_, own)| own.clone())
        };
        Called::new(&self.effects, &self.cloths, self.cloths.iter().map(own).collect())
    }

    /// Every effect of a single cloth names a cloth that is there.
    fn check_own(&self) -> Result<(), ValueError> {
        let is_there = |name: &str| self.cloths.iter().any(|cloth| cloth.name == name);
        let Some((name, _)) = self.own.iter().find(|(name, _)| !is_there(name)) else {
            return Ok(());
        };
        let names = self.cloths.iter().map(|cloth| cloth.name.as_str());
        let message = format!("there is no cloth '{}'{}", excerpt(name, 40), suggestion(name, names));
        Err(ValueError::new("cloth", message))
    }

    /// Whether all of it makes sense, alone and together. A scene from a file does; [`Simulation::new`](crate::Simulation::new) asks.
    ///
    /// # Errors
    /// What does not, and what would.
    pub fn check(&self) -> Result<(), ValueError> {
        TIME_STEP.check(self.time_step)?;
        duration_field(self.time_step).check(self.duration)?;
        FRAME_RATE.check(self.frame_rate)?;
        for (index, cloth) in self.cloths.iter().enumerate() {
            check_name("cloths", self.cloths[..index].iter().map(|other| &other.name), &cloth.name)?;
            cloth.check()?;
        }
        for (index, body) in self.bodies.iter().enumerate() {
            check_name("bodies", self.bodies[..index].iter().map(|other| &other.name), &body.name)?;
            body.check(self.time_step)?;
        }
        let parts = self.parts()?;
        self.check_own()?;
        self.called().check(&parts).map_err(|wrong| wrong.error)?;
        check_start(self.tangled_start, &self.called().names())
    }

    /// The effects that the scene calls for, in the order in which they run.
    #[must_use]
    pub fn effect_names(&self) -> Vec<&'static str> {
        self.called().names()
    }

    /// Forgets all effects but the first `count`, in the order in which they run. What an effect needs runs before it, so that the
    /// rest is a scene as well. It is another scene for checkpoints.
    pub fn keep_first_effects(&mut self, count: usize) {
        let names = self.effect_names();
        let first = &names[..count.min(names.len())];
        self.effects.keep(first);
        self.own.iter_mut().for_each(|(_, own)| own.keep(first));
    }

    /// What the cloths are made of, for people to read: their weight, and what effects say of them, each with its value and unit.
    #[must_use]
    pub fn fabric(&self) -> Vec<(String, String)> {
        let mut fabric = Vec::new();
        for cloth in &self.cloths {
            if let Some(material) = cloth.material {
                fabric.push((self.of_cloth(cloth, "material"), material.name.to_owned()));
            }
            if cloth.has_triangles() {
                fabric.push((self.of_cloth(cloth, "weight"), AREA_DENSITY.written_short(cloth.density)));
            }
            if cloth.has_loose_edges() {
                let weight = LINEAR_DENSITY.written_short(cloth.linear_density);
                fabric.push((self.of_cloth(cloth, "weight of loose edges"), weight));
            }
        }
        self.each_acting(|cloth, effect| {
            for (what, value) in effect.fabric() {
                fabric.push((
                    cloth.map_or_else(|| what.to_owned(), |cloth| self.of_cloth(cloth, what)),
                    value,
                ));
            }
        });
        fabric
    }

    /// What a cloth has, and which it is if there are several.
    fn of_cloth(&self, cloth: &Cloth, what: &str) -> String {
        match self.cloths.len() {
            1 => what.to_owned(),
            _ => format!("{what} of '{}'", cloth.name),
        }
    }

    /// Shows every effect that acts, and the cloth whose own it is; the scene's once, however many cloths it acts on.
    fn each_acting(&self, mut show: impl FnMut(Option<&Cloth>, &dyn Effect)) {
        let called = self.called();
        for name in called.names() {
            if let Some(effect) = self.effects.get(name) {
                show(None, effect);
            }
            for (cloth, own) in self.cloths.iter().zip(called.own()) {
                if let Some(effect) = own.get(name) {
                    show(Some(cloth), effect);
                }
            }
        }
    }

    /// What trades time for accuracy, by name, each with its value and unit: the time step, and settings of effects, those that the
    /// file leaves to their defaults included.
    #[must_use]
    pub fn settings(&self) -> Vec<(String, String)> {
        let mut settings = vec![("time step".to_owned(), TIME.written_short(self.time_step))];
        self.each_acting(|cloth, effect| {
            let name = cloth.map_or_else(|| effect.name().to_owned(), |cloth| self.of_cloth(cloth, effect.name()));
            let named = effect.settings().into_iter();
            settings.extend(named.map(|(setting, value)| (format!("{name}: {setting}"), value)));
        });
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
        take(format!("{:?}", (self.time_step, self.on_blocked, self.tangled_start, &self.effects)).as_bytes());
        let called = self.called();
        for (cloth, effects) in self.cloths.iter().zip(called.own()) {
            let Cloth {
                name,
                density,
                velocity,
                warp,
                linear_density,
                topology,
                ..
            } = cloth;
            take(format!("{:?}", (name, density, velocity, warp, effects)).as_bytes());
            if topology.loose_edges().len() > 0 {
                take(format!("{:?}", (linear_density, topology.loose_edges().collect::<Vec<_>>())).as_bytes());
            }
        }
        for body in &self.bodies {
            take(format!("{:?}", (&body.name, &body.motion)).as_bytes());
        }
        let cloths = self.cloths.iter().map(|cloth| &cloth.mesh);
        let meshes = cloths.chain(self.bodies.iter().map(|body| &body.mesh));
        for mesh in meshes {
            let coordinates = mesh.positions.iter().flat_map(|position| position.to_array());
            coordinates.for_each(|x| take(&x.to_le_bytes()));
            mesh.triangles.iter().flatten().for_each(|vertex| take(&vertex.to_le_bytes()));
        }
        fingerprint.value()
    }
}

/// What nobody keeps apart is not tangled.
fn check_start(start: TangledStart, effects: &[&str]) -> Result<(), ValueError> {
    let has_contact = effects
        .iter()
        .any(|effect| ["self_collision", "body_contact"].contains(effect));
    if start == TangledStart::Refuse || has_contact {
        return Ok(());
    }
    let message =
        "`tangled_start` has nothing to act on: it needs [effects.self_collision] or [effects.body_contact] in the scene";
    Err(ValueError::new(START, message.to_owned()))
}

const START: &str = "tangled_start";

/// Adds a mesh to others; returns its vertices among all.
pub(crate) fn append(all: &mut Mesh, mesh: &Mesh) -> Range<usize> {
    let first = all.positions.len();
    all.positions.extend_from_slice(&mesh.positions);
    let numbered = |triangle: &[u32; 3]| triangle.map(|vertex| first as u32 + vertex);
    all.triangles.extend(mesh.triangles.iter().map(numbered));
    first..all.positions.len()
}

/// No two of a kind have one name, which messages and scenes tell them by.
fn check_name<'a>(kind: &str, mut others: impl Iterator<Item = &'a String>, name: &str) -> Result<(), ValueError> {
    if others.any(|other| other == name) {
        let message = format!("there are two {kind} named '{}'", excerpt(name, 40));
        return Err(ValueError::new("name", message));
    }
    Ok(())
}
