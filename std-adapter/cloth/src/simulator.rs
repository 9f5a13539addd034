//! One step after another.
//!
//! Extended position-based dynamics with small steps and one iteration each (Macklin et al. 2016, 2019): velocities take the
//! forces, positions are predicted, constraints move them, and the velocity is what comes out of it.
//!
//! With a contact effect the motion that comes out is then certified ([`contact`](super::contact)), repaired or cut. Bodies and
//! pins have a clock of their own, which may have to wait.
//!
//! **Finite whatever the scene says**: no constraint divides by what may vanish, and no vertex moves faster than
//! [`FASTEST`].

mod drive;
mod tangled;
mod untangle;

pub use drive::DriveError;
pub use tangled::Tangled;
pub use untangle::{Untangled, Untangling};

use super::checkpoint::{Checkpoint, CheckpointError, Sizes};
use super::contact::{Blocker, ContactCounts, ContactSeconds, ContactSolver, Crossing, LARGEST_TURN, NearPair};
use super::energy::{Configuration, Energy};
use super::hierarchy::mesh_spacing;
use super::input::ValueError;
use super::plan::{Entry, Plan};
use super::scene::{OnBlocked, Scene, TangledStart, append};
use super::state::State;
use super::step::{Carrier, Constraint, FREE, Force, Memory, Release, TimeStep, Touches};
use super::world::{Driven, Kinematic, Pose};
use selvedge::verification::parallel::Workers;
use selvedge::{Mesh, StepError, TopologyError};
use selvedge::{ThreadError, Threads};
use selvedge_core::glam::DVec3;
use std::ops::Range;
use std::time::Instant;

/// In m/s: twice the speed of sound and more. What would move faster is slowed down to this.
pub const FASTEST: f64 = 1000.0;

/// A checkpoint can be taken when so many steps are done, and again so many later. There contact forgets what it knows besides
/// the state, which a resumed simulation does not know either.
pub const CHECKPOINT_STEPS: u64 = 200;

/// The shortest part of a step that is tried, in steps, or in parts of one in which nothing turns too far: so a step has an end.
const SHORTEST: f64 = 1.0 / 64.0;

/// A scene in motion.
#[derive(Debug)]
pub struct Simulation {
    name: String,
    time_step: f64,
    fingerprint: u64,
    cloth_names: Vec<String>,
    /// Of each cloth.
    vertices_of_cloths: Vec<Range<usize>>,
    cloth_vertices: usize,
    cloth_triangles: usize,
    triangles: Vec<[u32; 3]>,
    inverse_masses: Vec<f64>,
    /// Of each vertex: whose motion it follows.
    carriers: Vec<Carrier>,
    /// Where all vertices are at rest: the cloth's in the scene, bodies' as their meshes have them.
    rest: Vec<DVec3>,
    /// Of kinematic vertices, where what carries them takes them from.
    carried: Vec<DVec3>,
    /// Kinematic ones: bodies', then those of pins.
    motions: Vec<Kinematic>,
    /// Of each group of pins.
    pins: Vec<Carrier>,
    forces: Vec<Entry<dyn Force>>,
    constraints: Vec<Entry<dyn Constraint>>,
    /// Those of them that remember something.
    remembering: Vec<usize>,
    contact: Option<ContactSolver>,
    friction: Vec<Entry<dyn Constraint>>,
    effects: Vec<EffectTime>,
    on_blocked: OnBlocked,
    tangled_start: TangledStart,
    body_names: Vec<String>,
    body_vertices: Vec<Range<usize>>,
    threads: Workers,
    state: State,
    work: Work,
    /// Before the first step.
    untangled: Option<Untangled>,
}

/// Filled anew in each step.
#[derive(Debug, Default)]
struct Work {
    velocities: Vec<DVec3>,
    predicted: Vec<DVec3>,
    poses: Vec<[Pose; 2]>,
    touches: Touches,
    /// Vertices that constraints hold, and by how much heavier each is, in kg.
    held: Vec<(u32, f64)>,
    /// As constraints see them, if any are held.
    inverse_masses: Vec<f64>,
}

/// An effect that the scene calls for, and the time that it has taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectTime {
    /// As in the scene.
    pub name: &'static str,
    /// Seconds, so far.
    pub seconds: f64,
}

/// How long the edges of the cloth are, over their lengths at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeStretch {
    /// No more than one in a hundred edges is longer.
    pub percentile_99: f64,
    /// Of the longest.
    pub largest: f64,
}

/// A step that could not be made without an intersection, and was not.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "blocked at {time:.6} s: no motion was found that leaves {what} free{}",
    .body.as_ref().map_or(String::new(), |body| format!(" of the body '{body}'"))
)]
pub struct Blocked {
    /// In seconds.
    pub time: f64,
    /// The pair that is in the way, in words.
    pub what: String,
    /// The body that is in the way; `None` if it is a pin.
    pub body: Option<String>,
}

/// A simulation could not be set up.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// Cloth and bodies together have too many triangles.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// Something in the scene cannot be.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// The scene starts with surfaces that pass through each other, which no certificate can end.
    #[error(transparent)]
    Tangled(Box<Tangled>),
    /// A position is not finite.
    #[error(transparent)]
    Positions(#[from] StepError),
    /// The operating system refused the threads.
    #[error(transparent)]
    Threads(#[from] ThreadError),
}

/// What the clock of bodies and pins did in a step.
enum Clock {
    Went,
    Waited,
}

impl Simulation {
    /// Sets a scene up, on `threads` threads (0: one for each core). The number of threads changes no bit of the result.
    ///
    /// # Errors
    /// If something in the scene cannot be, it starts with an intersection, or the operating system refuses the threads.
    pub fn new(scene: Scene, threads: usize) -> Result<Self, SetupError> {
        Self::new_telling(scene, threads, &mut |_| ())
    }

    /// The same, and tells how untangling goes, before each of its steps, if the scene is [to be untangled](TangledStart::Untangle).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn new_telling(scene: Scene, threads: usize, tell: &mut (dyn FnMut(Untangling) + Send)) -> Result<Self, SetupError> {
        scene.check()?;
        let fingerprint = scene.fingerprint();
        let threads = Workers::new(Threads::from_count(threads))?;
        let mut plan = Plan::new(scene.parts()?);
        let names = scene.called().register(&mut plan);
        let times = names.into_iter().map(|name| EffectTime { name, seconds: 0.0 }).collect();
        let Plan {
            mut inverse_masses,
            mut carriers,
            mut motions,
            pins,
            forces,
            constraints,
            contact,
            friction,
            ..
        } = plan;
        let Scene {
            name,
            cloths,
            bodies,
            time_step,
            on_blocked,
            tangled_start,
            ..
        } = scene;
        let mut all = Mesh::default();
        let vertices_of_cloths: Vec<_> = cloths.iter().map(|cloth| append(&mut all, &cloth.mesh)).collect();
        let (cloth_vertices, cloth_triangles) = (all.positions.len(), all.triangles.len());
        let mut body_vertices = Vec::with_capacity(bodies.len());
        for (carrier, body) in bodies.iter().enumerate() {
            body_vertices.push(append(&mut all, &body.mesh));
            carriers.resize(all.positions.len(), carrier as Carrier);
        }
        let Mesh {
            positions: rest,
            triangles,
        } = all;
        inverse_masses.resize(rest.len(), 0.0);
        let remembers = |&index: &usize| constraints[index].action.memory().is_some();
        let remembering = (0..constraints.len()).filter(remembers).collect();
        let poses: Vec<Pose> = motions.iter().map(|motion| motion.pose(0.0)).collect();
        let mut carried = rest.clone();
        for (point, &carrier) in carried[..cloth_vertices].iter_mut().zip(&carriers) {
            // Pins that follow a driven body start where the cloth is, wherever that body stands.
            let body = motions.get(carrier as usize).filter(|_| (carrier as usize) < bodies.len());
            if let Some(standing) = body.and_then(Kinematic::driven).and_then(|driven| driven.placement) {
                *point = standing.apply_inverse(*point);
            }
        }
        let start = carried
            .iter()
            .zip(&carriers)
            .map(|(&point, &carrier)| poses.get(carrier as usize).map_or(point, |pose| pose.apply(point)));
        let mut positions: Vec<DVec3> = start.collect();
        motions.iter_mut().for_each(|motion| motion.put(0.0, &mut positions));
        let mut velocities = vec![DVec3::ZERO; rest.len()];
        for (cloth, vertices) in cloths.iter().zip(&vertices_of_cloths) {
            let free = vertices.clone().filter(|&vertex| carriers[vertex] == FREE);
            free.for_each(|vertex| velocities[vertex] = cloth.velocity);
        }
        let state = State {
            step: 0,
            blocked_steps: 0,
            clock: 0.0,
            velocities,
            positions,
        };
        let mut contact = ContactSolver::new(contact, &triangles, &rest, &carriers, cloth_vertices, bodies.len())?;
        if let Some(contact) = &mut contact {
            begin_anew(contact, &state, time_step);
            let found = contact.tolerate(&state.positions)?;
            if !found.is_empty() && tangled_start == TangledStart::Refuse {
                return Err(SetupError::Tangled(Box::new(Tangled {
                    crossings: found,
                    mesh: Mesh {
                        positions: state.positions,
                        triangles,
                    },
                    cloth_triangles,
                    body_names: bodies.into_iter().map(|body| body.name).collect(),
                    untangled: None,
                })));
            }
        }
        let spacing = cloths.iter().map(mesh_spacing).fold(f64::INFINITY, f64::min);
        let mut simulation = Self {
            name,
            time_step,
            on_blocked,
            tangled_start,
            body_vertices,
            pins,
            body_names: bodies.into_iter().map(|body| body.name).collect(),
            contact,
            fingerprint,
            cloth_names: cloths.into_iter().map(|cloth| cloth.name).collect(),
            cloth_triangles,
            cloth_vertices,
            vertices_of_cloths,
            triangles,
            inverse_masses,
            motions,
            forces,
            constraints,
            remembering,
            effects: times,
            threads,
            state,
            work: Work {
                touches: Touches {
                    wanted: !friction.is_empty(),
                    list: Vec::new(),
                },
                ..Work::default()
            },
            friction,
            carriers,
            rest,
            carried,
            untangled: None,
        };
        if tangled_start == TangledStart::Untangle && !simulation.is_apart() {
            let untangled = simulation.untangle(spacing, tell);
            simulation.check_untangled(untangled)?;
        }
        Ok(simulation)
    }

    /// The scene's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Steps done so far.
    #[must_use]
    pub fn steps_done(&self) -> u64 {
        self.state.step
    }

    /// The time simulated so far, in seconds.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.step as f64 * self.time_step
    }

    /// Where everything is: the vertices of each cloth, then the bodies'.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.state.positions
    }

    /// Triangles on [`positions`](Self::positions): those of each cloth, then the bodies'.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// How fast each of the [`positions`](Self::positions) moves, in m/s.
    #[must_use]
    pub fn velocities(&self) -> &[DVec3] {
        &self.state.velocities
    }

    /// The bodies' names, in the order of the scene.
    #[must_use]
    pub fn body_names(&self) -> &[String] {
        &self.body_names
    }

    /// The cloths' names, in the order of the scene.
    #[must_use]
    pub fn cloth_names(&self) -> &[String] {
        &self.cloth_names
    }

    /// The vertices of a cloth, among the [`positions`](Self::positions); `None` if there is no such cloth.
    #[must_use]
    pub fn vertices_of_cloth(&self, cloth: usize) -> Option<Range<usize>> {
        self.vertices_of_cloths.get(cloth).cloned()
    }

    /// The vertices of a body, among the [`positions`](Self::positions); `None` if there is no such body.
    #[must_use]
    pub fn body_vertices(&self, body: usize) -> Option<Range<usize>> {
        self.body_vertices.get(body).cloned()
    }

    /// The pairs that came near each other in the last part of the last step, as contact saw them at its start. None without a contact
    /// effect.
    pub fn near_pairs(&self) -> impl Iterator<Item = NearPair> {
        self.contact.iter().flat_map(|contact| contact.near_pairs())
    }

    /// How many of the vertices are of cloth.
    #[must_use]
    pub fn cloth_vertices(&self) -> usize {
        self.cloth_vertices
    }

    /// How many of the triangles are of cloth.
    #[must_use]
    pub fn cloth_triangles(&self) -> usize {
        self.cloth_triangles
    }

    /// How much cloth is stretched now, of all cloths together. Finds the edges anew, in O(n log n) time.
    #[must_use]
    pub fn edge_stretch(&self) -> EdgeStretch {
        let cloth = self.triangles[..self.cloth_triangles].iter();
        let ends = cloth.flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let mut edges: Vec<[u32; 2]> = ends.map(|(a, b)| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges.dedup();
        let length = |all: &[DVec3], [a, b]: [u32; 2]| all[a as usize].distance(all[b as usize]);
        let stretch = |&edge: &[u32; 2]| length(&self.state.positions, edge) / length(&self.rest, edge);
        let mut all: Vec<f64> = edges.iter().map(stretch).collect();
        all.sort_unstable_by(f64::total_cmp);
        let at = |index: usize| all.get(index).copied().unwrap_or(1.0);
        EdgeStretch {
            percentile_99: at(all.len() * 99 / 100),
            largest: at(all.len().saturating_sub(1)),
        }
    }

    /// The energy that the cloth has now: of its motion, and what its effects hold. Takes about as long as the effects' share of a step.
    ///
    /// Each step takes some of it, as implicit steps do: in free fall ½·m·g²·h·t, of a mass m after a time t in steps of h.
    #[must_use]
    pub fn energy(&self) -> Energy {
        let now = Configuration {
            positions: &self.state.positions,
            inverse_masses: &self.inverse_masses,
        };
        let forces = self.forces.iter().map(|entry| (entry.effect, entry.action.energy(&now)));
        let constraints = self.constraints.iter().map(|entry| (entry.effect, entry.action.energy(&now)));
        let mut energy = Energy::of_motion(&self.inverse_masses, &self.state.velocities);
        for (effect, stored) in forces.chain(constraints) {
            if let Some(stored) = stored {
                energy.add(self.effects[effect].name, stored);
            }
        }
        energy
    }

    /// The vertices that [`Attachments`](crate::effects::Attachments) have let go of so far, in their order; what effects of a caller's own
    /// [remember](crate::effects::Memory) may add to it.
    #[must_use]
    pub fn released(&self) -> Vec<Release> {
        self.memories().flat_map(|memory| memory.released()).collect()
    }

    /// The effects that were constructed, in the order in which they run, and the time that each has taken.
    #[must_use]
    pub fn effects(&self) -> &[EffectTime] {
        &self.effects
    }

    /// What contact has counted so far; `None` if the scene has no contact effect.
    #[must_use]
    pub fn contact_counts(&self) -> Option<&ContactCounts> {
        self.contact.as_ref().map(|contact| &contact.counts)
    }

    /// What contact has taken so far, besides the pushes; `None` if the scene has no contact effect.
    #[must_use]
    pub fn contact_seconds(&self) -> Option<&ContactSeconds> {
        self.contact.as_ref().map(|contact| &contact.stages)
    }

    /// Steps in which bodies or pins had to wait, or to be let pass.
    #[must_use]
    pub fn blocked_steps(&self) -> u64 {
        self.state.blocked_steps
    }

    /// Edges that meet faces now although effects are to keep them apart, of a scene that starts tangled and
    /// [tolerates](TangledStart::Tolerate) that; empty for good once all is apart.
    #[must_use]
    pub fn crossings(&self) -> &[Crossing] {
        self.contact.as_ref().map_or(&[], |contact| contact.exempt().crossings())
    }

    /// How many pairs have left the promise since the start: those about [`crossings`](Self::crossings), and those that are not apart by their
    /// separation yet.
    #[must_use]
    pub fn tolerated_pairs(&self) -> usize {
        self.contact.as_ref().map_or(0, |contact| contact.tolerated_pairs())
    }

    /// What the scene wants of a tangled start.
    #[must_use]
    pub fn tangled_start(&self) -> TangledStart {
        self.tangled_start
    }

    /// What was untangled before the first step; `None` if nothing was.
    #[must_use]
    pub fn untangled(&self) -> Option<&Untangled> {
        self.untangled.as_ref()
    }

    /// Whether the state is certified to be free of intersections of whatever the scene's contact effects name: not without any,
    /// not while a body is let pass, and not while what was tangled at the start is tolerated.
    #[must_use]
    pub fn is_certified(&self) -> bool {
        let contact = self.contact.as_ref();
        contact.is_some_and(|contact| contact.exempt().is_empty())
    }

    /// How far bodies and pins are behind their keyframes, in seconds.
    #[must_use]
    pub fn lag(&self) -> f64 {
        // Below a millionth of a step it is rounding.
        let lag = self.time() - self.state.clock;
        if lag > 1e-6 * self.time_step { lag } else { 0.0 }
    }

    /// Does one step.
    ///
    /// # Errors
    /// If bodies or pins force the cloth where it cannot go without intersecting, and the scene wants to stop then. What is
    /// done of the step stays.
    pub fn step(&mut self) -> Result<(), Blocked> {
        // Taken out so that they can run what borrows the rest.
        let threads = std::mem::take(&mut self.threads);
        let clock = self.state.clock;
        for driven in self.motions.iter_mut().filter_map(Kinematic::driven_mut) {
            driven.begin(clock, self.time_step, &self.state.positions, &self.carried);
        }
        let result = threads.run(|| self.whole_step());
        let clock = self.state.clock;
        let has_arrived = matches!(result, Ok(Clock::Went));
        for driven in self.motions.iter_mut().filter_map(Kinematic::driven_mut) {
            driven.end(clock, has_arrived);
        }
        self.threads = threads;
        result.map(drop)
    }

    fn whole_step(&mut self) -> Result<Clock, Blocked> {
        let mut left = self.time_step;
        let mut of_the_step = Clock::Went;
        let mut was_blocked = false;
        let mut longest = left;
        let shortest = SHORTEST * self.without_large_turn(left);
        while left > 0.0 {
            let blocker = match self.part(left.min(longest), shortest) {
                Ok(h) => {
                    left = if h < left { left - h } else { 0.0 };
                    // What follows is likely to need as short a part: tried with twice that, at most.
                    longest = 2.0 * h;
                    continue;
                }
                Err(blocker) => blocker,
            };
            was_blocked = true;
            match (self.on_blocked, blocker.body, &mut self.contact) {
                (OnBlocked::Yield, Some(body), Some(contact)) => contact.let_pass(body),
                (OnBlocked::Yield | OnBlocked::Hold, ..) => {
                    // Without anything that is forced to move a step can always be made.
                    self.attempt(left, 0.0).map_err(|blocker| self.described(blocker))?;
                    left = 0.0;
                    of_the_step = Clock::Waited;
                }
                (OnBlocked::Stop, ..) => return Err(self.described(blocker)),
            }
        }
        self.state.step += 1;
        self.state.blocked_steps += u64::from(was_blocked);
        if let Some(contact) = &mut self.contact {
            contact.take_back(&self.state.positions);
            if self.state.step.is_multiple_of(CHECKPOINT_STEPS) {
                begin_anew(contact, &self.state, self.time_step);
            }
        }
        Ok(of_the_step)
    }

    /// All that the rest of the simulation depends on, and what has been measured so far, every [`CHECKPOINT_STEPS`] steps;
    /// `None` in between. What the caller has said of the next step, and of the wind, is not in it.
    #[must_use]
    pub fn checkpoint(&self) -> Option<Vec<u8>> {
        if !self.state.step.is_multiple_of(CHECKPOINT_STEPS) {
            return None;
        }
        let mut checkpoint = Checkpoint {
            state: self.state.clone(),
            effects: self.effects.iter().map(|effect| effect.seconds).collect(),
            placements: self.driven().map(|driven| driven.placement).collect(),
            memories: self.remembered(),
            ..Checkpoint::default()
        };
        if let Some(contact) = &self.contact {
            checkpoint.yielding = contact.exempt().yielding.clone();
            checkpoint.parting = contact.exempt().parting().map(<[_]>::to_vec);
            (checkpoint.counts, checkpoint.stages) = (contact.counts, contact.stages);
        }
        Some(checkpoint.write(self.fingerprint))
    }

    /// Goes on from a checkpoint of the same scene: with the same bits as if it had never ended. Counters and times go on as well.
    ///
    /// # Errors
    /// If it is not a checkpoint, is damaged, or is one of another scene; then nothing has changed.
    pub fn resume(&mut self, checkpoint: &[u8]) -> Result<(), CheckpointError> {
        let sizes = Sizes {
            vertices: self.state.positions.len(),
            yielding: self.contact.as_ref().map_or(0, |c| c.exempt().yielding.len()),
            effects: self.effects.len(),
            placements: self.driven().count(),
            memories: self.remembered().len(),
        };
        let checkpoint = Checkpoint::read(checkpoint, self.fingerprint, sizes)?;
        if let Some(contact) = &mut self.contact {
            let positions = &checkpoint.state.positions;
            if !contact.set_parting(checkpoint.parting.as_deref(), positions) {
                return Err(CheckpointError::Damaged);
            }
            contact.set_yielding(&checkpoint.yielding);
            begin_anew(contact, &checkpoint.state, self.time_step);
            (contact.counts, contact.stages) = (checkpoint.counts, checkpoint.stages);
        }
        for (effect, seconds) in self.effects.iter_mut().zip(checkpoint.effects) {
            effect.seconds = seconds;
        }
        let driven = self.motions.iter_mut().filter_map(Kinematic::driven_mut);
        for (driven, placement) in driven.zip(checkpoint.placements) {
            driven.placement = placement;
        }
        self.recall(&checkpoint.memories);
        self.state = checkpoint.state;
        Ok(())
    }

    /// What all constraints remember, one after the other.
    fn remembered(&self) -> Vec<f64> {
        self.memories().flat_map(Memory::numbers).collect()
    }

    /// Takes back what was [`remembered`](Self::remembered) once.
    fn recall(&mut self, mut numbers: &[f64]) {
        for &index in &self.remembering {
            if let Some(memory) = self.constraints[index].action.memory_mut() {
                let own;
                (own, numbers) = numbers.split_at(memory.numbers().len());
                memory.recall(own);
            }
        }
    }

    fn memories(&self) -> impl Iterator<Item = &dyn Memory> {
        let all = self.remembering.iter();
        all.filter_map(|&index| self.constraints[index].action.memory())
    }

    fn driven(&self) -> impl Iterator<Item = &Driven> {
        self.motions.iter().filter_map(Kinematic::driven)
    }

    /// Goes on by as much of `left` seconds as possible: returns how much. Half of it if that fails, and so on, but not by less than
    /// `shortest`.
    fn part(&mut self, left: f64, shortest: f64) -> Result<f64, Blocker> {
        let mut h = self.without_large_turn(left);
        loop {
            match self.attempt(h, h) {
                Err(_) if 0.5 * h >= shortest => {
                    h *= 0.5;
                    if let Some(contact) = &mut self.contact {
                        contact.counts.cuts += 1;
                    }
                }
                result => return result.map(|()| h),
            }
        }
    }

    /// `h`, halved until no body or pin turns by more in that time than contact can certify.
    fn without_large_turn(&self, mut h: f64) -> f64 {
        let clock = self.state.clock;
        let turns_too_far =
            |motion: &Kinematic, h: f64| (motion.pose(clock + h).angle - motion.pose(clock).angle).abs() > LARGEST_TURN;
        if self.contact.is_some() {
            while self.motions.iter().any(|motion| turns_too_far(motion, h)) {
                h *= 0.5;
            }
        }
        h
    }

    fn described(&self, blocker: Blocker) -> Blocked {
        Blocked {
            time: blocker.time,
            what: blocker.pair(),
            body: blocker.body.map(|body| self.body_names[body].clone()),
        }
    }

    /// Goes on by `h` seconds, bodies and pins by `ticks` seconds of their clock. If that is not possible nothing changes.
    fn attempt(&mut self, h: f64, ticks: f64) -> Result<(), Blocker> {
        let Self {
            state,
            work,
            inverse_masses,
            carriers,
            carried,
            effects,
            contact,
            motions,
            ..
        } = self;
        let clock = state.clock;
        work.poses.clear();
        let poses = |motion: &Kinematic| [clock, clock + ticks].map(|time| motion.pose(time));
        work.poses.extend(motions.iter().map(poses));
        work.touches.list.clear();
        let step = TimeStep {
            time: state.step as f64 * self.time_step,
            h,
            start: &state.positions,
            inverse_masses,
            held: &[],
            poses: &work.poses,
        };
        let velocities = &mut work.velocities;
        velocities.clone_from(&state.velocities);
        for Entry { effect, action } in &mut self.forces {
            timed(effects, *effect, || action.apply(&step, velocities));
        }
        // Where inertia leads, and bodies and pins go.
        let predicted = |vertex: usize| match step.poses.get(carriers[vertex] as usize) {
            Some([_, pose]) if pose.is_rigid() => pose.apply(carried[vertex]),
            Some(_) => step.start[vertex],
            None => step.start[vertex] + limited(velocities[vertex], FASTEST) * h,
        };
        let (positions, touches) = (&mut work.predicted, &mut work.touches);
        positions.clear();
        positions.extend((0..step.start.len()).map(predicted));
        motions.iter_mut().for_each(|motion| motion.put(clock + ticks, positions));
        work.held.clear();
        for &index in &self.remembering {
            if let Some(memory) = self.constraints[index].action.memory() {
                memory.hold(h, &mut work.held);
            }
        }
        let step = if work.held.is_empty() {
            step
        } else {
            let own = &mut work.inverse_masses;
            own.clone_from(inverse_masses);
            for &(vertex, mass) in &work.held {
                let inverse_mass = &mut own[vertex as usize];
                *inverse_mass /= 1.0 + *inverse_mass * mass;
            }
            TimeStep {
                inverse_masses: own,
                held: &work.held,
                ..step
            }
        };
        for Entry { effect, action } in &mut self.constraints {
            timed(effects, *effect, || action.project(&step, positions, touches));
        }
        if let Some(contact) = contact {
            contact.prepare(step.start, positions, h);
            for with_body in [true, false] {
                if let Some(effect) = contact.settings.effect(with_body) {
                    timed(effects, effect, || contact.push(with_body, &step, positions, touches));
                }
            }
        }
        for Entry { effect, action } in &mut self.friction {
            timed(effects, *effect, || action.project(&step, positions, touches));
        }
        for (vertex, position) in positions.iter_mut().enumerate() {
            if carriers[vertex] == FREE {
                let start = step.start[vertex];
                *position = start + limited(*position - start, FASTEST * h);
            }
        }
        if let Some(contact) = contact {
            contact.certify(&step, positions)?;
        }
        for &index in &self.remembering {
            if let Some(memory) = self.constraints[index].action.memory_mut() {
                memory.settle(&step, positions);
            }
        }
        for (vertex, &position) in positions.iter().enumerate() {
            state.velocities[vertex] = (position - state.positions[vertex]) / h;
        }
        std::mem::swap(&mut state.positions, positions);
        state.clock += ticks;
        Ok(())
    }
}

/// Has contact forget all but the state, which everything is expected to go on from straight ahead in steps of `h` seconds: so a simulation
/// that goes on from here, and one that is resumed here, are alike.
fn begin_anew(contact: &mut ContactSolver, state: &State, h: f64) {
    let ways = state.positions.iter().zip(&state.velocities);
    let end: Vec<_> = ways
        .map(|(&position, &velocity)| position + limited(velocity, FASTEST) * h)
        .collect();
    contact.refresh(&state.positions, &end, h);
}

/// Runs what an effect does, and adds the time to it.
fn timed(effects: &mut [EffectTime], effect: usize, action: impl FnOnce()) {
    let begin = Instant::now();
    action();
    effects[effect].seconds += begin.elapsed().as_secs_f64();
}

/// The vector, no longer than `longest`; zero if it is not finite.
fn limited(vector: DVec3, longest: f64) -> DVec3 {
    let squared = vector.length_squared();
    if squared <= longest * longest {
        vector
    } else if squared.is_finite() {
        vector * (longest / squared.sqrt())
    } else {
        DVec3::ZERO
    }
}
