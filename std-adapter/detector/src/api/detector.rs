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

/// Finds the contacts of a mesh, one step after another. `S` is the format of the positions, `f32` or `f64`; they come as glam's vectors or
/// as arrays of three ([`Position`]).
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
/// # What can be asked
/// | question | method | what it saves |
/// |---|---|---|
/// | all contacts with their times | [`contacts`](Self::contacts) | |
/// | the earliest contact | [`earliest`](Self::earliest) | looks at a short part of the step first, and never beyond the earliest contact so far |
/// | is the step free of contact? | [`is_free`](Self::is_free) | ends at the first contact |
/// | how far may each vertex go? | [`truncate`](Self::truncate) | only vertices that would come into contact are held back |
/// | where does a contact lie, and what is its normal? | [`contact_geometry`](Self::contact_geometry), [`contact_geometries`](Self::contact_geometries) | only contacts are looked at |
/// | which pairs are near each other at rest? | [`near`](Self::near) | |
/// | which pairs come near each other? | [`candidates`](Self::candidates) | ends after the broad phase |
/// | which primitives meet in one state, at rest? | [`intersections`](Self::intersections), [`has_intersections`](Self::has_intersections) | exact, and passing through counts as well |
/// | contacts of pairs that the caller has | [`contacts_of`](Self::contacts_of) | no broad phase |
///
/// Steps that go on from one another, as a simulation's, take less time if one says so ([`set_coherent`](Self::set_coherent)).
///
/// Vertices that rest, and meshes that never move, are named once
/// ([`set_moving`](Self::set_moving)): pairs in which nothing moves are not looked at, and boxes of what rests
/// are fitted once. Several meshes are one topology, the triangles of each with their own vertices.
///
/// # What is promised
/// * **No contact is missed** and no time is later than the exact one, rounding included, in every floating-point environment
///   ([`selvedge_core`](crate::core)). Pairs that come within the tolerance of the separation, or too close for
///   rounding to tell, may count as contacts.
/// * Positions in `f32` are computed with in `f64` where `f32` leaves a pair open: contacts are as sharp, and times, rounded
///   down, as late as if they were given in `f64`. Positions in `f64` that are all `f32` numbers are as fast as those in `f32`.
/// * The same contacts with the same times in the same order, on any number of threads and every instruction set. (The order is
///   that of the hierarchies, which depends on the steps before; the set and the times do not.)
/// * After the first step nothing is allocated, unless there are more pairs than ever or hierarchies are built anew. (With
///   several threads rayon may still allocate for its queues; where steps go on from one another, so may what finds pairs again.)
/// * Frames of the wrong length, and positions that are not finite, are errors.
#[derive(Debug)]
pub struct CollisionDetector<S: Scalar> {
    pub(super) engine: MeshEngine,
    pub(super) workers: Workers,
    criterion: Criterion<S>,
}

impl<S: Scalar> CollisionDetector<S> {
    /// A detector for a mesh, on the calling thread.
    #[must_use]
    pub fn new(topology: impl Into<Arc<Topology>>) -> Self {
        Self {
            engine: MeshEngine::new(topology.into()),
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

    /// What counts as a contact; at first [`Criterion::default`].
    ///
    /// # Errors
    /// If a length is negative, infinite or NaN. Then it stays as it was.
    pub fn set_criterion(&mut self, criterion: Criterion<S>) -> Result<(), StepError> {
        criterion.check()?;
        self.criterion = criterion;
        Ok(())
    }

    /// Names the vertices that move, true for each that does; `None`: all of them, as at first.
    ///
    /// From the next step on, pairs of which no vertex moves are not looked at. The positions of vertices that do
    /// not move are taken from the next step's start and end, and **not looked at again** until this is called anew.
    ///
    /// # Errors
    /// If the slice's length is not the mesh's number of vertices.
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

    /// Which pairs are looked at from the next step on; at first all.
    ///
    /// Pairs that the caller brings ([`contacts_of`](Self::contacts_of)) are looked at whatever the filter says.
    ///
    /// # Errors
    /// If a list of the filter's does not have an entry for each of the mesh's vertices, or names one that is not there. Then it stays as it was.
    pub fn set_collision_filter(&mut self, filter: CollisionFilter) -> Result<(), StepError> {
        filter.check(self.topology().vertex_count())?;
        self.engine.set_filter(filter);
        Ok(())
    }

    /// Whether steps go on from one another, as those of a simulation do; at first not.
    ///
    /// Then pairs that are near each other are found for several steps at once and followed: a step mostly looks at them alone. Worth it
    /// where a step moves vertices by much less than an edge, and not where every step is another motion.
    ///
    /// The answers of [`contacts`](Self::contacts), [`earliest`](Self::earliest) and [`is_free`](Self::is_free) are those of a detector
    /// that has seen no step before, with the same times, **whatever the steps are**: one that begins elsewhere than where the
    /// one before has ended, or a mesh that jumps, only takes longer. Contacts come in ascending order of their pairs' numbers. (A pair that the
    /// elementary test gives up on though it is farther apart than the tolerance, as it may with a face without area, can be left out, in
    /// one step and not in another: only where that is proven.) Other questions are answered as ever.
    ///
    /// ```
    /// use selvedge::{CollisionDetector, Topology, glam::DVec3};
    ///
    /// // A triangle that slides along a larger one, at a distance, and in the end comes down.
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

    /// Replaces `contacts` by all contacts of the step from `start` to `end`, one position for each vertex: vertex–face first.
    ///
    /// # Errors
    /// If a frame's length is not the mesh's number of vertices, a coordinate is NaN or infinite, or the step is cut short: by a
    /// [`cancellation`](Self::cancellation), or by more pairs than [allowed](Self::set_pair_limit). What is in `contacts` then is of no use.
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
        self.engine.pairs.stop.result()
    }

    /// The earliest contact of the step; of several at the same time the one with the smallest numbers, vertex–face first.
    ///
    /// It is the first of all that [`contacts`](Self::contacts) finds, with the same time. Writing s for the separation and δ for the
    /// tolerance of the [criterion](Self::set_criterion):
    /// * **The time is a certified lower bound.** Before it no two primitives are within s of each other, rounding included. So the
    ///   step may be taken up to it (`start + (end − start)·time`, but for the rounding of these positions), and any step shorter
    ///   than it is free. `None` is a proof that the whole step is.
    /// * **How early it may be.** At that time the distance of the pair is at most s + δ and a rounding error
    ///   ([bounded there](selvedge_core::elementary::advance#what-is-promised)). If it comes closer at a speed of v there,
    ///   in lengths a step, and goes on to come within s, the exact time is about δ/v later. But it need not: a pair that comes within
    ///   s + δ and turns back, a near miss, may be a contact as any other, and then the exact first contact is that of another pair, or
    ///   there is none. A near miss at more than s + δ never is; the time may well come after it.
    /// * **The exception**: a pair too close for rounding to tell, within some 2⁻⁴⁸ of the size of its
    ///   differences, counts from when that cannot be excluded, which may be long before it touches, or though it never does. Of such pairs
    ///   it may tell one that [`contacts`](Self::contacts) does not have, or another time.
    ///
    /// So it is not a proof of contact. Where a step without contact must not be cut short,
    /// [`elementary::contact`](selvedge_core::elementary::contact()) decides whether the pair touches, exactly.
    ///
    /// # Errors
    /// As [`contacts`](Self::contacts).
    pub fn earliest<P: Position<Scalar = S>>(&mut self, start: &[P], end: &[P]) -> Result<Option<Contact<S>>, StepError> {
        let step = self.step(start, end)?;
        let question = self.question(Wanted::Earliest);
        let earliest = self.engine.earliest(&self.workers, &step, &question);
        self.engine.pairs.stop.result()?;
        Ok(earliest.as_ref().map(in_format_of_positions))
    }

    /// Whether the step is certainly free of contact.
    ///
    /// # Errors
    /// As [`contacts`](Self::contacts).
    pub fn is_free<P: Position<Scalar = S>>(&mut self, start: &[P], end: &[P]) -> Result<bool, StepError> {
        let step = self.step(start, end)?;
        let question = self.question(Wanted::Any);
        self.engine.run(&self.workers, &step, &question);
        if self.engine.statistics().contacts.total() > 0 {
            return Ok(false);
        }
        self.engine.pairs.stop.result()?;
        Ok(true)
    }

    /// Replaces `end` by positions to which the step is free of contact, each on the way of its vertex from `start` to `wanted`: vertices that
    /// would come into contact are held back, each as far as its own neighbourhood asks for, and all others reach where they are wanted.
    ///
    /// For solvers that would else cut the whole step at its [earliest](Self::earliest) contact.
    ///
    /// * **The step from `start` to `end` is certified free**, by the same tests as [`is_free`](Self::is_free), but for pairs that are
    ///   [in contact](Truncation::in_contact) at the start: their vertices rest.
    /// * A vertex ends exactly where it is wanted, or in the box of its way, rounding included. Where the whole step is free, `end` is `wanted`.
    /// * The share of its way that a vertex goes is for all of its motion, so that what slides along something, nearer than its next
    ///   step, is held back as well: a separation between the two leaves it room.
    /// * The same bits for any number of threads. It always ends ([how](selvedge_core::separation::truncation) shares are chosen).
    ///
    /// A body that has to reach its position is held back as all others are: whoever cannot have that cuts the step at the contacts of that body.
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
    /// // Nearly down on it, and the other all the way.
    /// assert!(end[3].z < 0.01 && end[6..] == wanted[6..]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`contacts`](Self::contacts).
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
        let ways = [&start[..], &wanted];
        let truncation = self
            .engine
            .truncate(&self.workers, ways, &question, rounded::<P>, &mut ends)?;
        end.clear();
        end.extend(ends.into_iter().map(nearest::<P>));
        Ok(truncation)
    }

    /// Replaces `vertex_face` and `edge_edge` by the pairs that boxes leave: vertex and face, or two edges, the smaller
    /// number first. All others are certainly farther apart than the separation throughout the step.
    ///
    /// # Errors
    /// As [`contacts`](Self::contacts).
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
        self.engine.pairs.stop.result()
    }

    /// Replaces `contacts` by those of the pairs given, in their order, vertex–face first: a vertex and a face, or two edges.
    ///
    /// Pairs that share a vertex are in contact at time 0. Each pair goes through moving boxes first, those of all primitives of the
    /// mesh made for the step: for a list that is much shorter than the mesh that is most of the time.
    ///
    /// # Errors
    /// As [`contacts`](Self::contacts), and if a pair names what the mesh does not have.
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
        self.engine.pairs.stop.result()
    }

    /// The mesh's vertices, edges and triangles.
    #[must_use]
    pub fn topology(&self) -> &Topology {
        self.engine.topology()
    }

    /// How many threads a step uses.
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
