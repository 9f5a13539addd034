//! A mesh's contacts, step by step.

use super::criterion::{CandidateBoxes, Criterion};
use crate::engine::{MeshEngine, Question, Wanted, in_format_of_positions};
use crate::mesh::Topology;
use crate::parallel::Workers;
#[cfg(feature = "parallel")]
use crate::parallel::{ThreadError, Threads};
use crate::step::{CollisionFilter, Contact, Step, StepError, Truncation, exactly, nearest, rounded};
use selvedge_core::{Position, Scalar};
use std::sync::Arc;

/// Finds the contacts of a mesh, one step after another.
///
/// `S` is the format of the positions, `f32` or `f64`. Positions are glam's vectors or arrays of three ([`Position`]).
///
/// ```text
/// once per mesh   topology
/// every step      positions at the start and at the end
///   │  broad phase   hierarchies of moving boxes, refitted: candidate VF and EE pairs
///   │  filter        certified non-coplanarity, sixteen pairs at a time
///   │  elementary    certified time of impact, in sweeps over all open pairs
///   ▼
/// contacts with their times, in a buffer of the caller's
/// ```
///
/// ```
/// use selvedge::{CollisionDetector, Topology, glam::DVec3};
///
/// // Once: a small triangle above a large one.
/// let topology = Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?;
/// let mut detector = CollisionDetector::<f64>::new(topology);
/// let mut contacts = Vec::new();
///
/// let mut start = vec![DVec3::new(-5.0, -5.0, 0.0), DVec3::new(5.0, -5.0, 0.0), DVec3::new(0.0, 5.0, 0.0)];
/// start.extend([DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.1), DVec3::new(0.0, 1.0, 1.2)]);
/// for _ in 0..3 {
///     // Each step: it falls by 0.4.
///     let mut end = start.clone();
///     for vertex in &mut end[3..] {
///         vertex.z -= 0.4;
///     }
///     detector.contacts(&start, &end, &mut contacts)?;
///     start = end;
/// }
/// // In the third step its three vertices go through the large face.
/// assert_eq!(contacts.len(), 3);
/// assert_eq!(contacts[0].pair[1], 0);
/// let first = contacts.iter().map(|contact| contact.time).fold(1.0, f64::min);
/// assert!(first <= 0.5 && first > 0.5 - 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Which method to call
/// | result | method | cost |
/// |---|---|---|
/// | all contacts with their times | [`contacts`](Self::contacts) | |
/// | the earliest contact | [`earliest`](Self::earliest) | does not look beyond the earliest contact so far |
/// | whether the step is free of contact | [`is_free`](Self::is_free) | ends at the first contact |
/// | how far each vertex may go | [`truncate`](Self::truncate) | holds back only vertices that would come into contact |
/// | points and normal of a contact | [`contact_geometry`](Self::contact_geometry), [`contact_geometries`](Self::contact_geometries) | looks at contacts only |
/// | pairs that are near each other at rest | [`near`](Self::near) | |
/// | pairs that come near each other | [`candidates`](Self::candidates) | ends after the broad phase |
/// | primitives that intersect in one state | [`intersections`](Self::intersections), [`has_intersections`](Self::has_intersections) | exact; finds primitives that pass through each other too |
/// | contacts of listed pairs | [`contacts_of`](Self::contacts_of) | no broad phase |
///
/// If each step starts where the last ended, as in a simulation, call [`set_coherent`](Self::set_coherent); it is faster.
///
/// If some vertices rest, name the moving ones with [`set_moving`](Self::set_moving). The detector then skips pairs in which
/// nothing moves, and fits the boxes of resting vertices once. To detect contacts between several meshes, put them into one
/// topology, or use a [`World`](crate::World).
///
/// # Guarantees
/// * **No contact is missed**, and no time is later than the exact one. This includes rounding, and holds in every floating-point
///   environment ([`selvedge_core`](crate::core)). A pair that comes within the tolerance of the separation may count as a
///   contact. So may a pair that comes within 2⁻⁴⁵ of its size of the separation, which rounding hides, and one with coordinates
///   that differ by more than 2²⁵⁰. No pair that stays farther apart is a contact ([reason by
///   reason](selvedge_core::elementary::advance#what-is-promised)).
/// * Positions in `f32` give contacts that are as sharp as those of the same positions in `f64`: pairs that `f32` leaves open are
///   decided in `f64`. Times are rounded down. Positions in `f64` that are all `f32` numbers take as little time as `f32`.
/// * The contacts, their times and their order are the same on any number of threads and every instruction set. The order depends
///   on the hierarchies, and so on earlier steps; the set of contacts and the times do not.
/// * After the first step nothing is allocated, unless there are more pairs than before or hierarchies are built again. Rayon may
///   still allocate for its queues, and coherent steps for pairs that are found again.
/// * Frames of the wrong length and positions that are not finite are errors.
#[derive(Debug)]
pub struct CollisionDetector<S: Scalar> {
    pub(super) engine: MeshEngine,
    pub(super) workers: Workers,
    criterion: Criterion<S>,
}

impl<S: Scalar> CollisionDetector<S> {
    /// Makes a detector for a mesh. It runs on the calling thread.
    #[must_use]
    pub fn new(topology: impl Into<Arc<Topology>>) -> Self {
        Self {
            engine: MeshEngine::new(topology.into()),
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
    /// # Errors
    /// Returns an error if a length is negative, infinite or NaN. The old criterion then stays.
    pub fn set_criterion(&mut self, criterion: Criterion<S>) -> Result<(), StepError> {
        criterion.check()?;
        self.criterion = criterion;
        Ok(())
    }

    /// Sets which vertices move, with one entry for each vertex. `None`, the default, means that all move.
    ///
    /// From the next step on, the detector skips pairs without a moving vertex. It reads the positions of resting vertices in the
    /// next step, and **not again** until the next call of this method.
    ///
    /// # Errors
    /// Returns an error if the slice's length is not the mesh's number of vertices.
    pub fn set_moving(&mut self, moving: Option<&[bool]>) -> Result<(), StepError> {
        let expected = self.topology().vertex_count();
        match moving {
            Some(moving) if moving.len() != expected => Err(StepError::WrongCount {
                found: moving.len(),
                expected,
            }),
            _ => {
                self.engine.set_moving(moving.map(<[bool]>::to_vec));
                Ok(())
            }
        }
    }

    /// Sets which pairs may collide, from the next step on. By default all may.
    ///
    /// Listed pairs ([`contacts_of`](Self::contacts_of)) are tested whatever the filter says.
    ///
    /// # Errors
    /// Returns an error if a list of the filter has the wrong length, or names a vertex that does not exist. The old filter then
    /// stays.
    pub fn set_collision_filter(&mut self, filter: CollisionFilter) -> Result<(), StepError> {
        filter.check(self.topology().vertex_count())?;
        self.engine.set_filter(filter);
        Ok(())
    }

    /// Sets whether each step starts where the last ended, as in a simulation. The default is false.
    ///
    /// The detector then finds near pairs for several steps at once and follows them, so that most steps look at these pairs
    /// only. This pays where a step moves vertices by much less than an edge, and not where every step is a different motion.
    ///
    /// [`contacts`](Self::contacts), [`earliest`](Self::earliest) and [`is_free`](Self::is_free) return what a new detector
    /// returns, with the same times, **whatever the steps are**. A step that starts elsewhere, or a mesh that jumps, only takes
    /// longer. Contacts come in ascending order of their pairs. There is one exception. The elementary test can give up on a pair
    /// that is farther apart than the tolerance, such as one with a face without area. Such a pair may be left out in one step
    /// and not in another, but only where it is proven apart. Other methods do not change.
    ///
    /// ```
    /// use selvedge::{CollisionDetector, Topology, glam::DVec3};
    ///
    /// // A triangle that slides along a larger one and comes down in the last step.
    /// let mut detector = CollisionDetector::<f64>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    /// detector.set_coherent(true);
    /// let large = [DVec3::new(-5.0, -5.0, 0.0), DVec3::new(5.0, -5.0, 0.0), DVec3::new(0.0, 5.0, 0.0)];
    /// let small = [DVec3::new(0.0, 0.0, 0.2), DVec3::new(1.0, 0.0, 0.3), DVec3::new(0.0, 1.0, 0.4)];
    /// let frame = |step: u32| {
    ///     let fallen = if step == 60 { 0.3 } else { 0.0 };
    ///     let by = DVec3::new(0.01 * f64::from(step), 0.0, -fallen);
    ///     large.into_iter().chain(small.map(|point| point + by)).collect::<Vec<_>>()
    /// };
    /// let mut contacts = Vec::new();
    /// for step in 0..60 {
    ///     detector.contacts(&frame(step), &frame(step + 1), &mut contacts)?;
    ///     assert_eq!(contacts.is_empty(), step < 59);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_coherent(&mut self, coherent: bool) {
        self.engine.set_coherent(coherent);
    }

    /// Replaces `contacts` by all contacts of the step from `start` to `end`, vertex–face pairs first. There is one position for
    /// each vertex.
    ///
    /// # Errors
    /// Returns an error if a frame's length is not the mesh's number of vertices, or a coordinate is NaN or infinite. Also
    /// returns an error if the step is cut short: by a [`cancellation`](Self::cancellation), or by more
    /// [pairs](Self::set_pair_limit) or [memory](Self::set_memory_limit) than allowed. `contacts` is then incomplete.
    pub fn contacts<P: Position<Scalar = S>>(
        &mut self,
        start: &[P],
        end: &[P],
        contacts: &mut Vec<Contact<S>>,
    ) -> Result<(), StepError> {
        let step = self.step(start, end)?;
        let question = self.question(Wanted::All);
        self.engine.run(&self.workers, &step, &question);
        self.engine.collect_contacts(contacts);
        self.engine.result()
    }

    /// Returns the earliest contact of the step. If several have the same time, it returns the one with the smallest numbers,
    /// vertex–face pairs first.
    ///
    /// It is the first contact that [`contacts`](Self::contacts) finds, with the same time. Let s be the separation and δ the
    /// tolerance of the [criterion](Self::set_criterion):
    /// * **The time is a certified lower bound.** Before it no two primitives are within s of each other, rounding included. So
    ///   the mesh may move up to that time (`start + (end − start)·time`, apart from rounding), and any shorter step is free.
    ///   `None` proves that the whole step is free.
    /// * **The time may be early.** At that time the distance of the pair is at most s + δ and a rounding error
    ///   ([bounded there](selvedge_core::elementary::advance#what-is-promised)). If the pair approaches at a speed of v lengths
    ///   per step and comes within s, the exact time is about δ/v later. A near miss, a pair that comes within s + δ and turns
    ///   back, may also count. The exact first contact is then that of another pair, or there is none. A near miss at more than s
    ///   + δ never counts.
    /// * **Exception.** Rounding hides whether a pair within 2⁻⁴⁵ of the size of its differences touches. It is reported from the
    ///   time at which it comes so near, even if it never touches. For such pairs the result may be a pair that
    ///   [`contacts`](Self::contacts) does not have, or another time.
    ///
    /// So the result does not prove contact. [`elementary::contact`](selvedge_core::elementary::contact()) decides exactly
    /// whether a pair touches.
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts).
    pub fn earliest<P: Position<Scalar = S>>(&mut self, start: &[P], end: &[P]) -> Result<Option<Contact<S>>, StepError> {
        let step = self.step(start, end)?;
        let question = self.question(Wanted::Earliest);
        let earliest = self.engine.earliest(&self.workers, &step, &question);
        self.engine.result()?;
        Ok(earliest.as_ref().map(in_format_of_positions))
    }

    /// Returns whether the step is certainly free of contact.
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts).
    pub fn is_free<P: Position<Scalar = S>>(&mut self, start: &[P], end: &[P]) -> Result<bool, StepError> {
        let step = self.step(start, end)?;
        let question = self.question(Wanted::Any);
        self.engine.run(&self.workers, &step, &question);
        if self.engine.statistics().contacts.total() > 0 {
            return Ok(false);
        }
        self.engine.result()?;
        Ok(true)
    }

    /// Replaces `end` by positions on the path from `start` to `wanted` to which the step is free of contact.
    ///
    /// Vertices that would come into contact are held back, each as far as its own neighbourhood requires. All others reach their
    /// wanted position. Use this in a solver instead of cutting the whole step at its [earliest](Self::earliest) contact.
    ///
    /// * **The step from `start` to `end` is certified free**, by the tests of [`is_free`](Self::is_free). Pairs that are
    ///   [in contact](Truncation::in_contact) at the start are the exception: their vertices rest.
    /// * A vertex ends exactly at its wanted position, or in the box of its path, rounding included. If the whole step is free,
    ///   `end` is `wanted`.
    /// * A vertex goes a share of its whole motion. So a vertex that slides along a surface, nearer than its next step, is held
    ///   back too. A separation leaves it room.
    /// * The result has the same bits for any number of threads. The method always ends; core describes
    ///   [how](selvedge_core::separation::truncation) shares are chosen.
    ///
    /// Bodies that must reach their position are held back like all others. If that is not acceptable, cut the step at the
    /// contacts of that body.
    ///
    /// ```
    /// use selvedge::{CollisionDetector, Topology, glam::DVec3};
    ///
    /// // Two small triangles above a large one; the first falls through it, the second beside it.
    /// let mut detector = CollisionDetector::<f64>::new(Topology::new(9, vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]])?);
    /// let large = [DVec3::new(-5.0, -5.0, 0.0), DVec3::new(5.0, -5.0, 0.0), DVec3::new(0.0, 5.0, 0.0)];
    /// let small = |x| [DVec3::new(x, 0.0, 0.2), DVec3::new(x + 1.0, 0.0, 0.3), DVec3::new(x, 1.0, 0.4)];
    /// let start = [large, small(0.0), small(9.0)].concat();
    /// let mut wanted = start.clone();
    /// wanted[3..].iter_mut().for_each(|vertex| vertex.z -= 0.5);
    ///
    /// let mut end = Vec::new();
    /// let truncation = detector.truncate(&start, &wanted, &mut end)?;
    /// assert_eq!((truncation.held_back, truncation.in_contact), (3, 0));
    /// assert!(detector.is_free(&start, &end)?);
    /// // One is nearly down; the other goes all the way.
    /// assert!(end[3].z < 0.01 && end[6..] == wanted[6..]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts).
    pub fn truncate<P: Position<Scalar = S>>(
        &mut self,
        start: &[P],
        wanted: &[P],
        end: &mut Vec<P>,
    ) -> Result<Truncation, StepError> {
        self.step(start, wanted)?;
        let question = self.question(Wanted::All);
        let [start, wanted] = [start, wanted].map(|positions| positions.iter().map(|&p| exactly(p)).collect::<Vec<_>>());
        let mut ends = Vec::new();
        let frames = [&start[..], &wanted];
        let truncation = self
            .engine
            .truncate(&self.workers, frames, &question, rounded::<P>, &mut ends)?;
        end.clear();
        end.extend(ends.into_iter().map(nearest::<P>));
        Ok(truncation)
    }

    /// Replaces `vertex_face` and `edge_edge` by the candidates: vertex and face, or two edges with the smaller number first. All
    /// other pairs are certainly farther apart than the separation throughout the step.
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts).
    pub fn candidates<P: Position<Scalar = S>>(
        &mut self,
        start: &[P],
        end: &[P],
        boxes: CandidateBoxes,
        vertex_face: &mut Vec<[u32; 2]>,
        edge_edge: &mut Vec<[u32; 2]>,
    ) -> Result<(), StepError> {
        let step = self.step(start, end)?;
        let separation = self.question(Wanted::All).limits.separation;
        self.engine
            .candidates(&self.workers, &step, separation, boxes.are_swept(), [vertex_face, edge_edge]);
        self.engine.result()
    }

    /// Replaces `contacts` by those of listed pairs, in their order, vertex–face pairs first. A pair is a vertex and a face, or
    /// two edges.
    ///
    /// Pairs that share a vertex are in contact at time 0. The method makes boxes for all primitives of the mesh, which takes
    /// most of the time if the list is much shorter than the mesh.
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts). Also returns an error if the mesh does not have a vertex, face or edge
    /// of a pair.
    pub fn contacts_of<P: Position<Scalar = S>>(
        &mut self,
        start: &[P],
        end: &[P],
        vertex_face: &[[u32; 2]],
        edge_edge: &[[u32; 2]],
        contacts: &mut Vec<Contact<S>>,
    ) -> Result<(), StepError> {
        let step = self.step(start, end)?;
        let question = self.question(Wanted::All);
        self.engine
            .run_on(&self.workers, &step, &question, [vertex_face, edge_edge])?;
        self.engine.collect_contacts(contacts);
        self.engine.result()
    }

    /// Returns the mesh's vertices, edges and triangles.
    #[must_use]
    pub fn topology(&self) -> &Topology {
        self.engine.topology()
    }

    /// Returns the number of threads that a step uses.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.workers.count()
    }

    pub(super) fn step<'a, P: Position>(&self, start: &'a [P], end: &'a [P]) -> Result<Step<'a, P>, StepError> {
        self.engine.pairs.stop.admits()?;
        Step::checked(start, end, self.topology().vertex_count())
    }

    pub(super) fn question(&self, wanted: Wanted) -> Question {
        self.criterion.question(wanted)
    }
}
