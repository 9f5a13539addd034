//! Several meshes that come and go.

use super::criterion::Criterion;
use super::world_contacts::{WorldContact, of_meshes};
use super::world_error::WorldError;
use crate::engine::Wanted;
use crate::engine::world::{Frames, Given, MOST_VERTICES, MeshHandle, Moves, Stage, WorldMesh, between_poses};
use crate::mesh::Topology;
use crate::parallel::Workers;
#[cfg(feature = "parallel")]
use crate::parallel::{ThreadError, Threads};
use crate::step::{Cancellation, Frame, Groups, Motions, Step, StepError, check_frame, exactly, rounded};
use selvedge_core::Position;
use selvedge_core::glam::{DQuat, DVec3};
use selvedge_core::narrowing::limits_in_f64;
use std::sync::Arc;

/// The motion of a mesh in a step.
#[derive(Clone, Copy, Debug)]
pub enum MeshMotion<'a, P> {
    /// Each vertex moves straight, at constant velocity: cloth and soft bodies. Such a mesh can also meet itself.
    Deforming {
        /// Positions at the start, one for each vertex.
        start: &'a [P],
        /// Positions at the end.
        end: &'a [P],
    },
    /// The mesh moves as one body, in the shape that it was [inserted](World::insert) with, from one pose to another. A pose is a
    /// rotation and the position of the shape's origin. The body turns the short way at a constant rate, about an axis through
    /// its origin, and the origin moves straight.
    ///
    /// If the two rotations are equal, every vertex moves straight between its two positions, rounded to the world's format.
    /// Otherwise vertices move on [arcs](selvedge_core::paths::RigidMotion::between), from their start positions in `f64`.
    Rigid {
        /// The pose at the start.
        start: (DQuat, DVec3),
        /// The pose at the end.
        end: (DQuat, DVec3),
    },
}

/// Finds the contacts of meshes that come and go: cloth and soft bodies, rigid bodies, and meshes that never move.
///
/// `P` is the type of the positions: glam's vectors or arrays of three, in `f32` or `f64`. A mesh rests where it was inserted.
/// [`contacts`](Self::contacts) takes the motions of a step; all other meshes rest where their last motion ended.
///
/// ```
/// use selvedge::glam::{DQuat, DVec3};
/// use selvedge::{Groups, MeshMotion, Topology, World};
///
/// // A floor, and a plank above it that tips over.
/// let mut world = World::<DVec3>::new();
/// let floor = [DVec3::new(-9.0, -9.0, 0.0), DVec3::new(9.0, -9.0, 0.0), DVec3::new(0.0, 9.0, 0.0)];
/// let floor = world.insert(Topology::new(3, vec![[0, 1, 2]])?, &floor, Groups::ALL)?;
/// let plank = [DVec3::new(-2.0, 0.1, 0.0), DVec3::new(-2.0, -0.1, 0.0), DVec3::new(2.0, 0.0, 0.0)];
/// let plank = world.insert(Topology::new(3, vec![[0, 1, 2]])?, &plank, Groups::ALL)?;
///
/// let start = (DQuat::IDENTITY, DVec3::new(0.0, 0.0, 1.0));
/// let end = (DQuat::from_rotation_y(1.0), DVec3::new(0.0, 0.0, 1.0));
/// let mut contacts = Vec::new();
/// world.contacts(&[(plank, MeshMotion::Rigid { start, end })], &mut contacts)?;
/// // Its tip, vertex 2, is down after asin(1 / 2) of a turn by one radian.
/// let first = contacts.iter().min_by(|a, b| a.time.total_cmp(&b.time)).expect("a contact");
/// assert_eq!((first.meshes, first.pair), ([plank, floor], [2, 0]));
/// assert!(first.time <= 0.5_f64.asin() && first.time > 0.5_f64.asin() - 1e-6);
///
/// // A removed mesh has no contacts, and its handle is invalid.
/// world.remove(floor)?;
/// world.contacts(&[(plank, MeshMotion::Rigid { start, end })], &mut contacts)?;
/// assert!(contacts.is_empty() && world.remove(floor).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Guarantees
/// * **No contact is missed**, and no time is later than the exact one, rounding included. This holds for straight motion and
///   arcs, for any two meshes of which one moves, and for a deforming mesh with itself. Times are as sharp as [those of a
///   detector](crate::CollisionDetector::earliest). With separation s and tolerance δ, a pair within s + 3δ on arcs may be a
///   contact.
/// * **Contacts of two meshes do not depend on other meshes.** For straight motion they are those of a
///   [`CollisionDetector`](crate::CollisionDetector) for the two as one mesh, with the same times, bit for bit. There is one
///   exception, far from the origin, in `f64`. Between the separation and the tolerance beyond it, such a detector may leave out
///   pairs that a world reports.
/// * The contacts and their order are the same on any number of threads.
/// * **The cost of a step depends on what moves.** The world skips pairs of resting meshes and does not refit them. Inserting a
///   mesh builds its own hierarchies, and in the next step the small one over meshes.
/// * An error loses no mesh. Only a step that was cut short has begun: its meshes rest at the end of their motions unless the
///   next step moves them.
///
/// For piecewise-straight motion, run one step for each segment. For a single pair, core takes [all segments at
/// once](selvedge_core::paths::Polyline).
///
/// Each step begins at the pose of a rotating body, a few roundings away from the ends of the last step's arcs.
#[derive(Debug)]
pub struct World<P: Position> {
    stage: Stage,
    pub(super) workers: Workers,
    criterion: Criterion<P::Scalar>,
}

impl<P: Position> Default for World<P> {
    fn default() -> Self {
        Self::new()
    }
}

impl<P: Position> World<P> {
    /// Makes a world without meshes. It runs on the calling thread.
    #[must_use]
    pub fn new() -> Self {
        Self {
            stage: Stage::new(),
            workers: Workers::default(),
            criterion: Criterion::default(),
        }
    }

    /// Sets the threads that share the work of a step. The default is [`Threads::Calling`].
    ///
    /// # Errors
    /// Returns an error if the requested threads could not be started, or are more than [`Threads::most`]. The old ones then
    /// stay.
    #[cfg(feature = "parallel")]
    pub fn set_threads(&mut self, threads: Threads) -> Result<(), ThreadError> {
        self.workers = Workers::new(threads)?;
        Ok(())
    }

    /// Sets what counts as a contact. The default is [`Criterion::default`].
    ///
    /// There is no exact verdict for rotating bodies: with [`Criterion::Touching`] their contacts are those within its tolerance.
    /// If the separation changes, the next step fits all boxes again.
    ///
    /// # Errors
    /// Returns an error if a length is negative, infinite or NaN. The old criterion then stays.
    pub fn set_criterion(&mut self, criterion: Criterion<P::Scalar>) -> Result<(), WorldError> {
        criterion.check()?;
        self.stage.must_fit |= criterion.limits().separation != self.criterion.limits().separation;
        self.criterion = criterion;
        Ok(())
    }

    /// Returns the handle that cuts steps short from another thread.
    #[must_use]
    pub fn cancellation(&self) -> Cancellation {
        self.stage.engine.stop.cancellation.clone()
    }

    /// Sets the largest number of pairs that a step may look at, as for a [detector](crate::CollisionDetector::set_pair_limit).
    pub fn set_pair_limit(&mut self, limit: Option<u64>) {
        self.stage.engine.stop.set_pair_limit(limit);
    }

    /// Sets the largest memory that the contacts of a step may take, in bytes, as for a
    /// [detector](crate::CollisionDetector::set_memory_limit).
    pub fn set_memory_limit(&mut self, limit: Option<u64>) {
        self.stage.engine.stop.set_memory_limit(limit);
    }

    /// Inserts a mesh that rests at these positions. `groups` say which meshes it collides with, itself included.
    ///
    /// Meshes may share a topology (`Arc`).
    ///
    /// # Errors
    /// Returns an error if the number of positions is wrong, one is NaN or infinite, or the meshes would have more than 2³¹ − 1
    /// vertices.
    pub fn insert(
        &mut self,
        topology: impl Into<Arc<Topology>>,
        positions: &[P],
        groups: Groups,
    ) -> Result<MeshHandle, WorldError> {
        let topology = topology.into();
        check_frame(Frame::Start, positions, topology.vertex_count())?;
        let vertices = self.stage.vertices.saturating_add(positions.len());
        let most = MOST_VERTICES;
        if vertices > most {
            return Err(WorldError::TooLarge { vertices, most });
        }
        let shape = positions.iter().map(|&position| exactly(position)).collect();
        let separation = limits_in_f64(&self.criterion.limits()).separation;
        let mesh = self.workers.run(|| WorldMesh::new(topology, shape, groups, separation));
        let handle = self.stage.meshes.insert(mesh);
        let handle = handle.ok_or(WorldError::TooLarge { vertices, most })?;
        self.stage.vertices = vertices;
        self.stage.are_others = true;
        Ok(handle)
    }

    /// Removes a mesh. Its handle stays invalid for good.
    ///
    /// # Errors
    /// Returns an error if the world does not have the mesh.
    pub fn remove(&mut self, mesh: MeshHandle) -> Result<(), WorldError> {
        let removed = self.stage.meshes.remove(mesh).ok_or(WorldError::NoSuchMesh { mesh })?;
        self.stage.vertices -= removed.shape.len();
        self.stage.are_others = true;
        Ok(())
    }

    /// Sets which meshes a mesh collides with from now on.
    ///
    /// # Errors
    /// Returns an error if the world does not have the mesh.
    pub fn set_groups(&mut self, mesh: MeshHandle, groups: Groups) -> Result<(), WorldError> {
        let entry = self.stage.meshes.get_mut(mesh).ok_or(WorldError::NoSuchMesh { mesh })?;
        entry.groups = groups;
        self.stage.are_others = true;
        Ok(())
    }

    /// Returns all meshes, in ascending order of their handles.
    pub fn meshes(&self) -> impl Iterator<Item = MeshHandle> {
        self.stage.meshes.iter().map(|(handle, _)| handle)
    }

    /// Returns a mesh's vertices, edges and triangles.
    ///
    /// # Errors
    /// Returns an error if the world does not have the mesh.
    pub fn topology(&self, mesh: MeshHandle) -> Result<&Topology, WorldError> {
        Ok(self.mesh(mesh)?.hierarchies.topology())
    }

    /// Replaces `contacts` by all contacts of a step in which these meshes move and all others rest. A listed mesh counts as
    /// moving even if it ends where it starts.
    ///
    /// # Errors
    /// Returns an error if a mesh does not exist or is listed twice, or if its positions or poses are invalid. The world is then
    /// unchanged. Also returns an error if the step is cut short: by a [`cancellation`](Self::cancellation), or by more
    /// [pairs](Self::set_pair_limit) or [memory](Self::set_memory_limit) than allowed.
    pub fn contacts(
        &mut self,
        motions: &[(MeshHandle, MeshMotion<'_, P>)],
        contacts: &mut Vec<WorldContact<P::Scalar>>,
    ) -> Result<(), WorldError> {
        self.run(motions, Wanted::All)??;
        contacts.clear();
        let stage = &self.stage;
        for (source, found) in stage.engine.contacts() {
            contacts.extend(found.iter().map(|contact| of_meshes(stage.sources[source], contact)));
        }
        Ok(())
    }

    /// Returns the earliest contact of such a step. The step is certainly free of contact before its time, or altogether if the
    /// result is `None`. If several contacts have the same time, it returns the first by kind, meshes and pair.
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts).
    pub fn earliest(
        &mut self,
        motions: &[(MeshHandle, MeshMotion<'_, P>)],
    ) -> Result<Option<WorldContact<P::Scalar>>, WorldError> {
        self.run(motions, Wanted::Earliest)??;
        let earliest = self.stage.earliest();
        Ok(earliest.map(|(source, contact)| of_meshes(self.stage.sources[source], contact)))
    }

    /// Returns whether such a step is certainly free of contact.
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts).
    pub fn is_free(&mut self, motions: &[(MeshHandle, MeshMotion<'_, P>)]) -> Result<bool, WorldError> {
        let ended = self.run(motions, Wanted::Any)?;
        if self.stage.engine.contacts().any(|(_, found)| !found.is_empty()) {
            return Ok(false);
        }
        ended?;
        Ok(true)
    }

    /// Runs a step with valid motions. The inner result says whether it was cut short.
    fn run(&mut self, motions: &[(MeshHandle, MeshMotion<'_, P>)], wanted: Wanted) -> Result<Result<(), StepError>, WorldError> {
        self.stage.engine.stop.admits()?;
        self.check_once(motions)?;
        let checked = || motions.iter().map(|&(mesh, motion)| self.checked(mesh, motion)).collect();
        let checked: Vec<_> = self.workers.run::<Result<_, _>>(checked)?;
        let given: Vec<Given<'_>> = checked.iter().map(Checked::given).collect();
        let question = self.criterion.question(wanted);
        let Self { stage, workers, .. } = self;
        Ok(workers.run(|| stage.run(&given, &question)))
    }

    pub(super) fn mesh(&self, mesh: MeshHandle) -> Result<&WorldMesh, WorldError> {
        self.stage.meshes.get(mesh).ok_or(WorldError::NoSuchMesh { mesh })
    }

    fn check_once(&self, motions: &[(MeshHandle, MeshMotion<'_, P>)]) -> Result<(), WorldError> {
        let mut listed: Vec<_> = motions.iter().map(|&(mesh, _)| mesh).collect();
        listed.sort_unstable();
        match listed.windows(2).find(|two| two[0] == two[1]) {
            Some(two) => Err(WorldError::MovedTwice { mesh: two[0] }),
            None => Ok(()),
        }
    }

    fn checked<'a>(&self, handle: MeshHandle, motion: MeshMotion<'a, P>) -> Result<Checked<'a, P>, WorldError> {
        let mesh = self.mesh(handle)?;
        match motion {
            MeshMotion::Deforming { start, end } => {
                let step = Step::checked(start, end, mesh.shape.len());
                let step = step.map_err(|error| WorldError::BadPositions { mesh: handle, error })?;
                Ok(Checked::Deforming(handle, step))
            }
            MeshMotion::Rigid { start, end } => {
                let frames = between_poses(&mesh.shape, [start, end], rounded::<P>);
                let (frames, moves) = frames.ok_or(WorldError::BadPose { mesh: handle })?;
                Ok(Checked::Rigid(handle, frames, moves))
            }
        }
    }
}

/// A valid motion of a mesh.
enum Checked<'a, P> {
    Deforming(MeshHandle, Step<'a, P>),
    Rigid(MeshHandle, Frames, Moves),
}

impl<P: Position> Checked<'_, P> {
    fn given(&self) -> Given<'_> {
        match self {
            Self::Deforming(mesh, step) => (*mesh, step as &dyn Motions, Moves::Deforming),
            Self::Rigid(mesh, frames, moves) => (*mesh, frames as &dyn Motions, *moves),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn sheet() -> (Arc<Topology>, Vec<DVec3>) {
        let triangles = (0..98).map(|k| [k, k + 1, k + 2]).collect();
        let vertex = |k: u32| DVec3::new(f64::from(k / 2), f64::from(k % 2), f64::from(k) * 0.01);
        (
            Arc::new(Topology::new(100, triangles).unwrap()),
            (0..100).map(vertex).collect(),
        )
    }

    /// Returns how often the hierarchies of each mesh were built, and where its rows are.
    fn state(world: &World<DVec3>) -> BTreeMap<MeshHandle, (usize, Option<u32>)> {
        let meshes = world.stage.meshes.iter();
        let state = |mesh: &WorldMesh| {
            let builds = mesh.hierarchies.statistics().builds;
            (builds, mesh.rows_at.map(|place| place.first))
        };
        meshes.map(|(handle, mesh)| (handle, state(mesh))).collect()
    }

    #[test]
    fn to_insert_and_remove_meshes_leaves_the_others_hierarchies_and_rows_as_they_are() {
        let (topology, positions) = sheet();
        let at = |z: f64| -> Vec<DVec3> { positions.iter().map(|&position| position + z * DVec3::Z).collect() };
        let mut world = World::<DVec3>::new();
        let insert = |world: &mut World<DVec3>, z| world.insert(Arc::clone(&topology), &at(z), Groups::ALL).unwrap();
        let [first, second, cloth] = [0.0, 5.0, 9.0].map(|z| insert(&mut world, z));
        let step = |world: &mut World<DVec3>| {
            let (start, end) = (at(9.0), at(-1.0));
            let falls = MeshMotion::Deforming {
                start: &start,
                end: &end,
            };
            let mut contacts = Vec::new();
            world.contacts(&[(cloth, falls)], &mut contacts).unwrap();
            let mut meshes: Vec<_> = contacts.iter().flat_map(|contact| contact.meshes).collect();
            meshes.sort_unstable();
            meshes.dedup();
            meshes
        };
        assert_eq!(step(&mut world), [first, second, cloth]);
        let before = state(&world);
        assert!(before.values().all(|&(builds, row)| builds == 1 && row.is_some()));
        let third = insert(&mut world, 7.0);
        assert_eq!(step(&mut world), [first, second, cloth, third]);
        let mut after = state(&world);
        assert_eq!(after.remove(&third), Some((1, Some(300))));
        assert_eq!(after, before);
        // Most rows then belong to no mesh: rows get new places, and hierarchies stay.
        for mesh in [first, second, third] {
            world.remove(mesh).unwrap();
        }
        let last = insert(&mut world, 3.0);
        assert_eq!(step(&mut world), [cloth, last]);
        let rows = state(&world);
        assert!(
            rows.values()
                .all(|&(builds, row)| builds == 1 && row.is_some_and(|row| row < 200)),
            "{rows:?}"
        );
    }
}
