//! A simulation, and the results that a caller can read between two steps.

use super::added_forces::AddedForces;
use super::ahead::Ahead;
use super::assembly::Assembly;
use super::loads::Loads;
use super::measures::{EdgeStretch, EffectTime};
use super::state::State;
use super::substep::SubstepWork;
use super::tangled::Untangled;
use super::tearing::Tearing;
use super::waiting::Waiting;
use crate::contact::{ContactCounts, ContactSeconds, Crossing, ProximityPair};
use crate::effects::GRAVITY;
use crate::model::energy::{Configuration, Energy, StoredEnergy};
use crate::model::step::Release;
use crate::model::triangle_edges::{edges_of, once_each};
use crate::scene::{OnBlocked, TangledStart};
use crate::solve::SolveCounts;
use crate::world::{FileNumbering, Kinematic, MeshInFiles, Pose};
use selvedge::Mesh;
use selvedge::parallel::Workers;
use selvedge_core::glam::DVec3;
use std::ops::Range;

/// A scene in motion.
///
/// [`step`](Self::step) advances it by the scene's time step. Between steps you read positions and move what is
/// [driven](crate::BodyMotion::Driven).
///
/// ```
/// use selvedge_cloth::effects::{BodyContact, Gravity, SelfCollision, Stretch, Thickness};
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::{Body, Cloth, Scene, Simulation};
///
/// // A sheet of 30 cm above a ball of 10 cm radius. Units are SI.
/// let corner = DVec3::new(-0.15, -0.15, 0.11);
/// let sheet = Cloth::sheet(corner, [DVec3::X * 0.3, DVec3::Y * 0.3], [12, 12], 0.2)?;
/// let mut scene = Scene::new(sheet, 2e-3);
/// scene.bodies.push(Body::ball("ball", DVec3::ZERO, 0.1, 24)?);
/// scene.add(Gravity::default()).add(Stretch::isotropic(1000.0));
/// scene.add(BodyContact(Thickness::new(4e-3))).add(SelfCollision(Thickness::new(4e-3)));
///
/// let mut simulation = Simulation::new(scene, 1)?;
/// while simulation.time() < 0.1 {
///     simulation.step()?;
/// }
/// assert!(simulation.is_certified());
/// let sheet = simulation.vertices_of_cloth(0).expect("there is one cloth");
/// let ball = &simulation.positions()[sheet.end..];
/// assert!(simulation.positions()[sheet].iter().all(|point| point.length() > 0.1) && !ball.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Simulation {
    pub(super) name: String,
    pub(super) time_step: f64,
    /// The length of a frame in seconds, in a scene by frames.
    pub(super) frame: Option<f64>,
    /// True if contact has no data besides the state, as after a checkpoint.
    pub(super) is_fresh: bool,
    pub(super) fingerprint: u64,
    pub(super) cloth_names: Vec<String>,
    pub(super) numbering: FileNumbering,
    pub(super) made: Assembly,
    /// The points that carriers move, for kinematic vertices.
    pub(super) carried: Vec<DVec3>,
    pub(super) effects: Vec<EffectTime>,
    pub(super) on_blocked: OnBlocked,
    pub(super) tangled_start: TangledStart,
    pub(super) body_names: Vec<String>,
    pub(super) threads: Workers,
    pub(super) state: State,
    pub(super) work: Work,
    pub(super) loads: Loads,
    pub(super) added_forces: AddedForces,
    pub(super) untangled: Option<Untangled>,
    /// The motion for which bodies and pins wait.
    pub(super) waiting: Option<Waiting>,
    /// The state of tears, if cloths may tear.
    pub(super) tearing: Option<Box<Tearing>>,
}

/// Buffers of a step; their memory is used again.
#[derive(Debug, Default)]
pub(super) struct Work {
    pub(super) poses: Vec<[Pose; 2]>,
    pub(super) substep: SubstepWork,
    pub(super) ahead: Ahead,
}

impl Simulation {
    /// The scene's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the number of steps so far.
    #[must_use]
    pub fn steps_done(&self) -> u64 {
        self.state.step
    }

    /// Returns the seconds of a frame in a scene [by frames](crate::Scene::by_frames), where the simulation chooses its steps;
    /// `None` if its steps are as long as the scene says.
    #[must_use]
    pub const fn frame_seconds(&self) -> Option<f64> {
        self.frame
    }

    /// Returns the number of times that [`run`](Self::run) has succeeded, where nothing else has run: steps, or frames in a scene
    /// [by frames](crate::Scene::by_frames).
    #[must_use]
    pub fn runs_done(&self) -> u64 {
        self.frame
            .map_or(self.state.step, |seconds| (self.time() / seconds).round() as u64)
    }

    /// The time simulated so far, in seconds.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.time(self.time_step)
    }

    /// Returns all positions in metres: the vertices of each cloth, then the bodies'. After cloth
    /// [tears](crate::effects::Tearing) there are more.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.state.positions
    }

    /// Returns the triangles on [`positions`](Self::positions): those of each cloth, then the bodies'. Their number and order
    /// never change; after cloth [tears](crate::effects::Tearing) some name other vertices.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.made.triangles
    }

    /// Returns the edges of cloths that belong to no triangle (ropes, laces and fringes), on [`positions`](Self::positions).
    #[must_use]
    pub fn loose_edges(&self) -> &[[u32; 2]] {
        &self.made.loose_edges
    }

    /// Returns the present state as one mesh, in which cloths from files have the vertices and faces of their files.
    ///
    /// Vertices that `weld` merged are apart again, in the same place, so that texture coordinates and seams fit. Vertices that
    /// the cloth does not have stay where the file puts them. Vertices that tears add follow those of the file.
    #[must_use]
    pub fn mesh_in_files(&self) -> MeshInFiles {
        self.numbering
            .numbered(&self.mesh(), &self.made.loose_edges, &self.made.vertices_of_cloths)
    }

    /// Returns [`positions`](Self::positions) and [`triangles`](Self::triangles).
    pub(super) fn mesh(&self) -> Mesh {
        Mesh::new(self.state.positions.clone(), self.made.triangles.clone())
    }

    /// Returns the velocities of [`positions`](Self::positions), in m/s.
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
        self.made.vertices_of_cloths.get(cloth).cloned()
    }

    /// The vertices of a body, among the [`positions`](Self::positions); `None` if there is no such body.
    #[must_use]
    pub fn body_vertices(&self, body: usize) -> Option<Range<usize>> {
        self.made.body_vertices.get(body).cloned()
    }

    /// Returns the pairs that came near each other in the last part of the last step, at the start of that part. Empty without a
    /// contact effect.
    pub fn near_pairs(&self) -> impl Iterator<Item = ProximityPair> {
        let rows = self.made.solve.rows.iter().filter(|row| !row.is_smooth());
        rows.map(|row| ProximityPair {
            vertices: row.vertices,
            weights: row.weights,
            normal: row.normal,
            thickness: row.thickness,
        })
    }

    /// Returns the number of the cloths' vertices.
    #[must_use]
    pub fn cloth_vertices(&self) -> usize {
        self.made.cloth_vertices
    }

    /// Returns the number of the cloths' triangles.
    #[must_use]
    pub fn cloth_triangles(&self) -> usize {
        self.made.cloth_triangles
    }

    /// Returns the stretch of all cloths together, loose edges included. Finds the edges again, in O(n log n) time.
    #[must_use]
    pub fn edge_stretch(&self) -> EdgeStretch {
        let of_triangles = edges_of(&self.made.triangles[..self.made.cloth_triangles]);
        let edges = once_each(of_triangles.chain(self.made.loose_edges.iter().copied()));
        let length = |all: &[DVec3], [a, b]: [u32; 2]| all[a as usize].distance(all[b as usize]);
        let stretch = |&edge: &[u32; 2]| length(&self.state.positions, edge) / length(&self.made.rest, edge);
        let mut all: Vec<f64> = edges.iter().map(stretch).collect();
        all.sort_unstable_by(f64::total_cmp);
        let at = |index: usize| all.get(index).copied().unwrap_or(1.0);
        EdgeStretch {
            percentile_99: at(all.len() * 99 / 100),
            largest: at(all.len().saturating_sub(1)),
        }
    }

    /// Returns the present energy of the cloth and of free bodies: of their motion, and of effects. It takes about as long as the
    /// effects' share of a step.
    ///
    /// Each step takes some of the energy, as implicit steps do: in free fall ½·m·g²·h·t, for a mass m after a time t in steps of
    /// h.
    #[must_use]
    pub fn energy(&self) -> Energy {
        let now = Configuration {
            positions: &self.state.positions,
            inverse_masses: &self.made.inverse_masses,
        };
        let forces = self.made.forces.iter();
        let forces = forces.filter_map(|force| Some((force.effect, force.energy(&now)?)));
        let terms = self.made.solve.terms.iter();
        let terms = terms.flat_map(|entry| entry.action.energy(&now, entry.effect));
        let mut energy = Energy::of_motion(&self.made.inverse_masses, &self.state.velocities);
        for (effect, stored) in forces.chain(terms) {
            energy.add(self.effects[effect].name, stored);
        }
        for free in self
            .made
            .motions
            .iter()
            .filter_map(Kinematic::free)
            .filter(|free| free.proxy.is_none())
        {
            energy.kinetic += free.kinetic_energy();
            if self.made.of_free_bodies.gravity != DVec3::ZERO {
                let of_weight = -free.mass.mass * self.made.of_free_bodies.gravity.dot(free.state.centre);
                energy.add(GRAVITY, StoredEnergy::Gravitational(of_weight));
            }
        }
        energy
    }

    /// Returns the vertices that [`Attachments`](crate::effects::Attachments) have released so far, in their order. Other effects
    /// [with a memory](crate::effects::Memory) may add some.
    #[must_use]
    pub fn released(&self) -> Vec<Release> {
        self.made.memories().flat_map(|memory| memory.released()).collect()
    }

    /// Returns the effects of the scene, in the order in which they run, and the time that each has taken.
    #[must_use]
    pub fn effects(&self) -> &[EffectTime] {
        &self.effects
    }

    /// Returns the counts of the solves so far.
    #[must_use]
    pub fn solve_counts(&self) -> SolveCounts {
        self.made.solve.counts
    }

    /// Returns the seconds of the solves so far, without those of [effects](Self::effects): contact and friction in the solve,
    /// and its linear problems.
    #[must_use]
    pub fn solve_seconds(&self) -> f64 {
        self.made.solve.seconds
    }

    /// Returns the counts of contact so far; `None` if the scene has no contact effect.
    #[must_use]
    pub fn contact_counts(&self) -> Option<&ContactCounts> {
        self.made.contact.as_ref().map(|contact| &contact.counts)
    }

    /// Returns the times of contact so far, without pushes; `None` if the scene has no contact effect.
    #[must_use]
    pub fn contact_seconds(&self) -> Option<&ContactSeconds> {
        self.made.contact.as_ref().map(|contact| &contact.stages)
    }

    /// Steps in which bodies or pins had to wait, or to be let pass.
    #[must_use]
    pub fn blocked_steps(&self) -> u64 {
        self.state.blocked_steps
    }

    /// Returns the number of steps after which an edge was longer than its limit by more than 5 %
    /// ([`longest_over_limit`](Self::longest_over_limit)).
    #[must_use]
    pub fn overstretched_steps(&self) -> u64 {
        self.state.overstretched_steps
    }

    /// Returns the edges and faces that meet although effects should keep them apart, in a scene that starts tangled and
    /// [tolerates](TangledStart::Tolerate) that. It stays empty after all are apart.
    #[must_use]
    pub fn crossings(&self) -> &[Crossing] {
        self.made.contact.as_ref().map_or(&[], |contact| contact.exempt().crossings())
    }

    /// Returns the number of pairs without a guarantee since the start: those about [`crossings`](Self::crossings), and those
    /// that are not yet apart by their separation.
    #[must_use]
    pub fn tolerated_pairs(&self) -> usize {
        self.made.contact.as_ref().map_or(0, |contact| contact.tolerated_pairs())
    }

    /// Returns the scene's treatment of a tangled start.
    #[must_use]
    pub fn tangled_start(&self) -> TangledStart {
        self.tangled_start
    }

    /// Returns the result of untangling before the first step; `None` without untangling.
    #[must_use]
    pub fn untangled(&self) -> Option<&Untangled> {
        self.untangled.as_ref()
    }

    /// Returns whether the state is certified free of the intersections that the scene's contact effects name. It is false
    /// without a contact effect, while a body is let pass, and while a tangled start is tolerated.
    #[must_use]
    pub fn is_certified(&self) -> bool {
        let contact = self.made.contact.as_ref();
        contact.is_some_and(|contact| contact.exempt().is_empty())
    }

    /// Returns the time by which bodies and pins lag behind their keyframes, in seconds.
    #[must_use]
    pub fn lag(&self) -> f64 {
        // A lag below a millionth of a step is rounding.
        let lag = self.time() - self.state.clock;
        if lag > 1e-6 * self.time_step { lag } else { 0.0 }
    }
}
