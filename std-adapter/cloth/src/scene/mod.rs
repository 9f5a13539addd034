//! Scenes, from a TOML file or from code.
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
use crate::identity::{Identify, Identity};
use crate::input::{AREA_DENSITY, FREQUENCY, Field, LARGEST_TIME, LINEAR_DENSITY, TIME, ValueError, suggestion};
use crate::solve::Accuracy;
use crate::world::{Body, Cloth, SceneParts};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use selvedge_files::excerpt::excerpt;
use std::ops::Range;

/// The response when bodies or pins force the cloth into an intersection.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OnBlocked {
    /// Stop with an error that names the time, the body and the pair.
    #[default]
    Stop,
    /// Let the clock of bodies and pins wait.
    Hold,
    /// Exclude the body from the guarantee until it is apart from the cloth again. If pins block the cloth, their clock waits.
    Yield,
}

/// The response when edges pass through faces at the start, between pairs that contact effects keep apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TangledStart {
    /// Refuse the scene with a list of all intersections.
    #[default]
    Refuse,
    /// Exclude what intersects from the guarantee until it is apart; see [`Simulation::crossings`](crate::Simulation::crossings).
    Tolerate,
    /// Pull it apart before the first step, or refuse the scene with the remaining intersections. See
    /// [`Simulation::untangled`](crate::Simulation::untangled).
    Untangle,
}

crate::identify!(enum OnBlocked { 0 => Stop, 1 => Hold, 2 => Yield });
crate::identify!(enum TangledStart { 0 => Refuse, 1 => Tolerate, 2 => Untangle });

/// A scene: cloths, bodies and effects, read from a file or made in code.
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
    /// The name: the key `name` of the file, or the file's name.
    pub name: String,
    /// The cloths at rest. Vertices are numbered through all of them, in this order.
    pub cloths: Vec<Cloth>,
    /// The bodies that the cloths meet.
    pub bodies: Vec<Body>,
    /// The length of a step, in seconds, at most a sixtieth. A scene [by frames](Self::by_frames) has no longer ones.
    pub time_step: f64,
    /// True if the scene runs [frame by frame](crate::Simulation::advance), in as many steps as the cloth needs: in a file,
    /// without a `time_step`. The frames are those of [`frame_rate`](Self::frame_rate), which is then at least 1 Hz.
    pub by_frames: bool,
    /// The length of the simulation, in seconds.
    pub duration: f64,
    /// The number of frames to write for each simulated second.
    pub frame_rate: f64,
    /// The direction against gravity, of any length; z if the scene has no gravity.
    pub up: DVec3,
    /// The text of the file; empty if there is no file.
    pub text: String,
    /// Remarks for people about the scene's files, such as vertices that were left out.
    pub remarks: Vec<String>,
    /// The response when bodies or pins force the cloth into an intersection.
    pub on_blocked: OnBlocked,
    /// The response to intersections at the start.
    pub tangled_start: TangledStart,
    /// The accuracy to which each step is solved.
    pub accuracy: Accuracy,
    effects: Effects,
    /// Effects that single cloths have instead of the scene's, by the names of the cloths.
    own: Vec<(String, Effects)>,
}

/// A longer step stretches cloth under its own weight beyond any limit.
const TIME_STEP: Field = Field::new("time_step", TIME, 1e-6, 0.0167).with_hint(
    "; use a shorter step, or frames (without `time_step`, or `advance` in code), which take as many steps as the cloth needs",
);

/// The longest step of a [frame](crate::Simulation::advance), in seconds.
pub(crate) const LONGEST_STEP_OF_FRAME: f64 = 1.0 / 240.0;

/// Frames of a scene by frames take a second at most.
const fn frame_rate_field(by_frames: bool) -> Field {
    Field::new("frames_per_second", FREQUENCY, if by_frames { 1.0 } else { 0.001 }, 1e6)
}

/// Returns the fewest steps of a frame of so many seconds.
pub(crate) fn steps_of_frame(seconds: f64) -> f64 {
    // A frame of 1/60 s takes four steps, not five, whatever rounding makes of it.
    (seconds / LONGEST_STEP_OF_FRAME * (1.0 - 1e-9)).ceil().max(1.0)
}

/// Returns the field of a duration: at least a time step, and at most a little more than a day.
fn duration_field(time_step: f64) -> Field {
    Field::new("duration", TIME, time_step, LARGEST_TIME)
}

impl Scene {
    /// Makes a scene of one cloth, without effects; `time_step` is in seconds. The duration is unlimited. Push more cloths to
    /// [`cloths`](Self::cloths).
    #[must_use]
    pub fn new(cloth: Cloth, time_step: f64) -> Self {
        Self {
            name: "scene".to_owned(),
            cloths: vec![cloth],
            bodies: Vec::new(),
            time_step,
            by_frames: false,
            duration: LARGEST_TIME,
            frame_rate: 60.0,
            up: DVec3::Z,
            text: String::new(),
            remarks: Vec::new(),
            on_blocked: OnBlocked::default(),
            tangled_start: TangledStart::default(),
            accuracy: Accuracy::default(),
            effects: Effects::default(),
            own: Vec::new(),
        }
    }

    /// Adds an effect. It replaces an effect of the same name.
    ///
    /// The effects of this crate run in a fixed order, whatever the order of these calls. Other effects run after them, in the
    /// order of these calls.
    pub fn add(&mut self, effect: impl Effect + 'static) -> &mut Self {
        self.effects.add(effect);
        self
    }

    /// Gives one cloth an effect of its own, instead of the scene's of the same name. `cloth` is the cloth's name.
    ///
    /// Effects that act on the whole scene, such as gravity, cannot belong to one cloth.
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

    /// Returns all cloths as they start, as one mesh; vertices have the scene's numbers.
    #[must_use]
    pub fn all_cloth(&self) -> Mesh {
        let mut all = Mesh::default();
        for cloth in &self.cloths {
            let vertices = append(&mut all, cloth.mesh());
            all.positions[vertices].copy_from_slice(cloth.start());
        }
        all
    }

    /// Returns the loose edges of all cloths, on the vertices of [`all_cloth`](Self::all_cloth).
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

    /// Returns the distance that contact keeps a cloth from itself, in metres; `None` without contact. For a rope it is the
    /// diameter.
    pub(crate) fn thickness_of(&self, cloth: usize) -> Option<f64> {
        self.called().fabrics().get(cloth)?.thickness
    }

    /// Returns the vertices of a part of a cloth, as the scene numbers them, for pins and seams. `None` if there is no such cloth
    /// or part.
    #[must_use]
    pub fn part(&self, cloth: &str, part: &str) -> Option<Vec<u32>> {
        let parts = self.parts().ok()?;
        let index = self.cloths.iter().position(|own| own.name == cloth)?;
        let first = parts.vertices_of_cloths().nth(index)?.start as u32;
        let vertices = self.cloths[index].part(part)?;
        Some(vertices.iter().map(|&vertex| first + vertex).collect())
    }

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

    /// Checks that effects of single cloths name existing cloths.
    fn check_own(&self) -> Result<(), ValueError> {
        let is_there = |name: &str| self.cloths.iter().any(|cloth| cloth.name == name);
        let Some((name, _)) = self.own.iter().find(|(name, _)| !is_there(name)) else {
            return Ok(());
        };
        let names = self.cloths.iter().map(|cloth| cloth.name.as_str());
        let message = format!("there is no cloth '{}'{}", excerpt(name, 40), suggestion(name, names));
        Err(ValueError::new("cloth", message))
    }

    /// Checks all values, alone and together. Scenes from files are checked already, and
    /// [`Simulation::new`](crate::Simulation::new) checks again.
    ///
    /// # Errors
    /// Returns an error if a value is invalid. The message says which values are valid.
    pub fn check(&self) -> Result<(), ValueError> {
        TIME_STEP.check(self.time_step)?;
        duration_field(self.time_step).check(self.duration)?;
        frame_rate_field(self.by_frames).check(self.frame_rate)?;
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

    /// Returns the names of the scene's effects, in the order in which they run.
    #[must_use]
    pub fn effect_names(&self) -> Vec<&'static str> {
        self.called().names()
    }

    /// Removes all effects but the first `count`, in the order in which they run. The rest is a valid scene, since every effect
    /// runs after those that it needs. Checkpoints treat it as another scene.
    pub fn keep_first_effects(&mut self, count: usize) {
        let names = self.effect_names();
        let first = &names[..count.min(names.len())];
        self.effects.keep(first);
        self.own.iter_mut().for_each(|(_, own)| own.keep(first));
    }

    /// Returns the properties of the cloths for display: their weight, and the properties that effects report, each with value
    /// and unit.
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

    /// Returns the name of a property, with the cloth's name if there are several.
    fn of_cloth(&self, cloth: &Cloth, what: &str) -> String {
        match self.cloths.len() {
            1 => what.to_owned(),
            _ => format!("{what} of '{}'", cloth.name),
        }
    }

    /// Calls `show` for every effect: once for the scene's, and once for each cloth that has its own.
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

    /// Returns the settings that trade time for accuracy, each with value and unit: the time step, the accuracy of its solve, and
    /// settings of effects, defaults included.
    #[must_use]
    pub fn settings(&self) -> Vec<(String, String)> {
        let longest = if self.by_frames { "longest time step" } else { "time step" };
        let mut settings = vec![
            (longest.to_owned(), TIME.written_short(self.time_step)),
            ("accuracy".to_owned(), self.accuracy.name().to_owned()),
        ];
        self.each_acting(|cloth, effect| {
            let name = cloth.map_or_else(|| effect.name().to_owned(), |cloth| self.of_cloth(cloth, effect.name()));
            let named = effect.settings().into_iter();
            settings.extend(named.map(|(setting, value)| (format!("{name}: {setting}"), value)));
        });
        settings
    }

    /// Returns the time that passes in one call of [`Simulation::run`](crate::Simulation::run), in seconds: a step, or a frame in
    /// a scene [by frames](Self::by_frames).
    #[must_use]
    pub fn time_of_run(&self) -> f64 {
        if self.by_frames {
            self.frame_rate.recip()
        } else {
            self.time_step
        }
    }

    /// Returns whether the scene has a duration: a scene that code makes or runs may have none.
    #[must_use]
    pub fn has_duration(&self) -> bool {
        self.duration < LARGEST_TIME
    }

    /// Returns the number of steps in the duration; of frames in a scene [by frames](Self::by_frames).
    #[must_use]
    pub fn steps(&self) -> u64 {
        // A duration that is a whole number of steps up to rounding needs no step more.
        (self.duration / self.time_of_run() - 1e-6).ceil().max(1.0) as u64
    }

    /// Returns the number of steps from one frame to the next; 1 in a scene [by frames](Self::by_frames).
    #[must_use]
    pub fn steps_per_frame(&self) -> u64 {
        (1.0 / (self.frame_rate * self.time_of_run())).round().max(1.0) as u64
    }

    /// Returns a number that distinguishes this scene's checkpoints from those of other scenes. It depends on the text and on all
    /// parts.
    pub(crate) fn fingerprint(&self) -> u64 {
        let mut identity = Identity::default();
        let settings: [&dyn Identify; 7] = [
            &self.text,
            &self.time_of_run(),
            &self.time_step,
            &self.on_blocked,
            &self.tangled_start,
            &self.accuracy,
            &self.effects,
        ];
        settings.iter().for_each(|setting| setting.identify(&mut identity));
        for (cloth, effects) in self.cloths.iter().zip(self.called().own()) {
            cloth.identify(&mut identity);
            effects.identify(&mut identity);
        }
        self.bodies.iter().for_each(|body| body.identify(&mut identity));
        identity.value()
    }
}

/// Refuses `tangled_start` without a contact effect.
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

/// Appends a mesh to another; returns the range of its vertices.
pub(crate) fn append(all: &mut Mesh, mesh: &Mesh) -> Range<usize> {
    let first = all.positions.len();
    all.positions.extend_from_slice(&mesh.positions);
    let numbered = |triangle: &[u32; 3]| triangle.map(|vertex| first as u32 + vertex);
    all.triangles.extend(mesh.triangles.iter().map(numbered));
    first..all.positions.len()
}

/// Checks that no other thing of the same kind has this name.
fn check_name<'a>(kind: &str, mut others: impl Iterator<Item = &'a String>, name: &str) -> Result<(), ValueError> {
    if others.any(|other| other == name) {
        let message = format!("there are two {kind} named '{}'", excerpt(name, 40));
        return Err(ValueError::new("name", message));
    }
    Ok(())
}
