//! Several meshes that come and go, and move as they like.

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
use selvedge_core::narrowing::widened;
use std::sync::Arc;

/// How a mesh moves in a step.
#[derive(Clone, Copy, Debug)]
pub enum MeshMotion<'a, P> {
    /// Each vertex straight, at constant velocity: cloth, soft bodies. Such a mesh can also meet itself.
    Deforming {
        /// One position for each vertex, at the start.
        start: &'a [P],
        /// And at the end.
        end: &'a [P],
    },
    /// As one body, of the shape that it was [inserted](World::insert) with, from one pose to another, each a rotation and the place of the
    /// shape's origin. It turns the short way at a constant rate, about an axis through its origin, which moves straight.
    ///
    /// With two rotations that are equal every vertex moves straight, from where it is at the start to where it is at the end, both rounded to
    /// the world's format. Else vertices move on [arcs](selvedge_core::paths::RigidMotion::between), from where `f64` puts them at the start.
    Rigid {
        /// At the start.
        start: (DQuat, DVec3),
        /// At the end.
        end: (DQuat, DVec3),
    },
}

/// Finds the contacts of meshes that come and go: cloth and soft bodies, rigid bodies, and what never moves. `P` is the type of the
/// positions, glam's vectors or arrays of three, in `f32` or `f64`.
///
/// A mesh rests where it was inserted. [`contacts`](Self::contacts) is told what moves in a step, and how; all else rests where its last
/// motion ended.
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
/// // What is removed is met no more, and its handle is good for nothing.
/// world.remove(floor)?;
/// world.contacts(&[(plank, MeshMotion::Rigid { start, end })], &mut contacts)?;
/// assert!(contacts.is_empty() && world.remove(floor).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # What is promised
/// * **No contact is missed** and no time is later than the exact one, rounding included, of vertices on straight ways and on arcs, between
///   any two meshes of which one moves, and of a deforming mesh with itself. Times are as sharp as [those of a
///   detector](crate::CollisionDetector::earliest); on arcs a pair within s + 3δ may be a contact.
/// * **What two meshes do does not depend on the others.** Of straight motions all contacts are those of a
///   [`CollisionDetector`](crate::CollisionDetector) for the two as one mesh, with the same times, bit for bit. (In `f64`, far from the origin
///   for its size, such a detector may leave out pairs between the separation and the tolerance beyond it that a world tells of: boxes of
///   a world are about zero.)
/// * The same contacts in the same order on any number of threads.
/// * **A step costs what moves.** Pairs of meshes that both rest are not looked at; what rests is not refitted. To insert a mesh builds
///   its own hierarchies, and the small one over meshes in the next step.
/// * Where an error is told, no mesh has been lost. Only a step that was cut short has begun: what was to move rests where it would have ended
///   unless it is told to move again.
///
/// Who moves meshes in several straight pieces asks for a step for each of them. Of a single pair core takes them
/// [all at once](selvedge_core::paths::Polyline), also where its points have theirs at different times.
///
/// Where one step ends and the next begins, a body that turns is put at its pose anew: a few roundings away from where the arcs of the
/// step before end.
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
    /// Without meshes, on the calling thread.
    #[must_use]
    pub fn new() -> Self {
        Self {
            stage: Stage::new(),
            workers: Workers::default(),
            criterion: Criterion::default(),
        }
    }

    /// The threads that steps are split between; at first [`Threads::Calling`].
    ///
    /// # Errors
    /// If the operating system refuses the threads, or they are more than [`Threads::most`]. Then they stay as they were.
    #[cfg(feature = "parallel")]
    pub fn set_threads(&mut self, threads: Threads) -> Result<(), ThreadError> {
        self.workers = Workers::new(threads)?;
        Ok(())
    }

    /// What counts as a contact; at first [`Criterion::default`]. Of bodies that turn there is no exact verdict: with
    /// [`Criterion::Touching`] their contacts are those within its tolerance.
    ///
    /// The next step fits all boxes anew.
    ///
    /// # Errors
    /// If a length is negative, infinite or NaN. Then it stays as it was.
    pub fn set_criterion(&mut self, criterion: Criterion<P::Scalar>) -> Result<(), WorldError> {
        criterion.check()?;
        self.stage.must_fit |= criterion.limits().separation != self.criterion.limits().separation;
        self.criterion = criterion;
        Ok(())
    }

    /// What cuts a step short from another thread.
    #[must_use]
    pub fn cancellation(&self) -> Cancellation {
        self.stage.engine.stop.cancellation.clone()
    }

    /// Most pairs that a step may look at, as for a [detector](crate::CollisionDetector::set_pair_limit).
    pub fn set_pair_limit(&mut self, limit: Option<u64>) {
        self.stage.engine.stop.set_pair_limit(limit);
    }

    /// Sets the most memory that the contacts of a step may take, in bytes, as for a [detector](crate::CollisionDetector::set_memory_limit).
    pub fn set_memory_limit(&mut self, limit: Option<u64>) {
        self.stage.engine.stop.set_memory_limit(limit);
    }

    /// A new mesh that rests, at these positions. `groups` say which meshes it is looked at with, itself among them.
    ///
    /// Meshes of one topology may share it (`Arc`).
    ///
    /// # Errors
    /// If there is not one position for each vertex, one is NaN or infinite, or all meshes together would have more than 2³¹ − 1 vertices.
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
        let separation = widened(&self.criterion.limits()).separation;
        let mesh = self.workers.run(|| WorldMesh::new(topology, shape, groups, separation));
        let handle = self.stage.meshes.insert(mesh);
        let handle = handle.ok_or(WorldError::TooLarge { vertices, most })?;
        self.stage.vertices = vertices;
        self.stage.are_others = true;
        Ok(handle)
    }

    /// Takes a mesh out. Its handle then names nothing, for good.
    ///
    /// # Errors
    /// If there is no such mesh.
    pub fn remove(&mut self, mesh: MeshHandle) -> Result<(), WorldError> {
        let removed = self.stage.meshes.remove(mesh).ok_or(WorldError::NoSuchMesh { mesh })?;
        self.stage.vertices -= removed.shape.len();
        self.stage.are_others = true;
        Ok(())
    }

    /// Which meshes this one is looked at with from now on.
    ///
    /// # Errors
    /// If there is no such mesh.
    pub fn set_groups(&mut self, mesh: MeshHandle, groups: Groups) -> Result<(), WorldError> {
        let own = self.stage.meshes.get_mut(mesh).ok_or(WorldError::NoSuchMesh { mesh })?;
        own.groups = groups;
        self.stage.are_others = true;
        Ok(())
    }

    /// All meshes that there are, in ascending order of their handles.
    pub fn meshes(&self) -> impl Iterator<Item = MeshHandle> {
        self.stage.meshes.iter().map(|(handle, _)| handle)
    }

    /// A mesh's vertices, edges and triangles.
    ///
    /// # Errors
    /// If there is no such mesh.
    pub fn topology(&self, mesh: MeshHandle) -> Result<&Topology, WorldError> {
        Ok(self.mesh(mesh)?.hierarchies.topology())
    }

    /// Replaces `contacts` by all contacts of a step in which these meshes move, and all others rest. A mesh that is listed moves, even if it
    /// ends where it starts.
    ///
    /// # Errors
    /// If a mesh is not there, is listed twice, or its positions or poses are not in order: then nothing has changed. Or if the step is cut
    /// short: by a [`cancellation`](Self::cancellation), or by more pairs than [allowed](Self::set_pair_limit). What is in `contacts` then
    /// is of no use.
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

    /// The earliest contact of such a step: the step is certainly free of contact until its time, and free altogether if there is none. Of
    /// several at the same time the first by kind, meshes and pair.
    ///
    /// # Errors
    /// As [`contacts`](Self::contacts).
    pub fn earliest(
        &mut self,
        motions: &[(MeshHandle, MeshMotion<'_, P>)],
    ) -> Result<Option<WorldContact<P::Scalar>>, WorldError> {
        self.run(motions, Wanted::Earliest)??;
        let earliest = self.stage.earliest();
        Ok(earliest.map(|(source, contact)| of_meshes(self.stage.sources[source], contact)))
    }

    /// Whether such a step is certainly free of contact.
    ///
    /// # Errors
    /// As [`contacts`](Self::contacts).
    pub fn is_free(&mut self, motions: &[(MeshHandle, MeshMotion<'_, P>)]) -> Result<bool, WorldError> {
        let ended = self.run(motions, Wanted::Any)?;
        if self.stage.engine.contacts().any(|(_, found)| !found.is_empty()) {
            return Ok(false);
        }
        ended?;
        Ok(true)
    }

    /// Does a step, if it is in order; then whether it was cut short.
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

/// A mesh's motion that is in order.
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

    /// How often each mesh's hierarchies were built, and where its rows are.
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
        // More rows of nobody than of meshes: places are given anew, and hierarchies stay.
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
