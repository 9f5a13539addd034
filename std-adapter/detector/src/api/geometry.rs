//! The geometry of contacts, and the near pairs of a mesh at rest.

use super::criterion::Criterion;
use super::detector::CollisionDetector;
use crate::mesh::Topology;
use crate::parallel;
use crate::step::{Contact, Frame, StepError, check_length, check_pair, exactly};
use selvedge_core::PairKind;
use selvedge_core::elementary::Limits;
use selvedge_core::narrowing::limits_in_f64;
use selvedge_core::separation::closest::ClosestPoints;
use selvedge_core::separation::gap::{GapError, distance_from_below};
use selvedge_core::separation::geometry::{Geometry, geometry};
use selvedge_core::separation::largest_coordinate;
use selvedge_core::{Motion, Position, PrimitivePair, Scalar};

/// Two primitives, their vertices, and their closest points at some time, in `f64` for either format of positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactGeometry {
    /// Vertex–face or edge–edge.
    pub kind: PairKind,
    /// The vertex and the face, or the two edges, as the [`Topology`] numbers them.
    pub pair: [u32; 2],
    /// The vertex and the corners of the face, or the ends of both edges, as the mesh numbers them.
    pub vertices: [u32; 4],
    /// Points, weights, normal, distance and speed, with [guarantees](selvedge_core::separation::geometry).
    pub geometry: Geometry,
}

impl<S: Scalar> CollisionDetector<S> {
    /// Returns the geometry of one contact of the step from `start` to `end`, at its time.
    ///
    /// ```
    /// use selvedge::{CollisionDetector, Topology, glam::DVec3};
    ///
    /// // A triangle falls flat onto a larger one.
    /// let mut detector = CollisionDetector::<f64>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    /// let large = [DVec3::new(-5.0, -5.0, 0.0), DVec3::new(5.0, -5.0, 0.0), DVec3::new(0.0, 5.0, 0.0)];
    /// let small = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.1), DVec3::new(0.0, 1.0, 1.2)];
    /// let start = [large, small].concat();
    /// let end = [large, small.map(|vertex| vertex - 2.0 * DVec3::Z)].concat();
    ///
    /// let first = detector.earliest(&start, &end)?.expect("they meet");
    /// let found = detector.contact_geometry(&start, &end, &first)?;
    /// assert_eq!(found.vertices, [3, 0, 1, 2]);
    /// assert_eq!(found.geometry.normal, Some(DVec3::Z));
    /// assert_eq!(found.geometry.speed, -2.0);
    /// assert!(found.geometry.points[0].length() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if a frame has the wrong length, the mesh does not have the pair, or the time is not in [0, 1]. Positions
    /// that are not finite give no normal.
    pub fn contact_geometry<P: Position<Scalar = S>>(
        &self,
        start: &[P],
        end: &[P],
        contact: &Contact<S>,
    ) -> Result<ContactGeometry, StepError> {
        let expected = self.topology().vertex_count();
        for (frame, positions) in [(Frame::Start, start), (Frame::End, end)] {
            if positions.len() != expected {
                let found = positions.len();
                return Err(StepError::WrongLength { frame, found, expected });
            }
        }
        check_contact(self.topology(), contact)?;
        Ok(geometry_of(self.topology(), [start, end], contact))
    }

    /// Replaces `geometries` by those of many contacts of a step, in their order, on the detector's threads.
    ///
    /// Nothing is allocated if `geometries` has room.
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts). Also returns an error if the mesh does not have a pair, or a time is
    /// not in [0, 1].
    pub fn contact_geometries<P: Position<Scalar = S>>(
        &self,
        start: &[P],
        end: &[P],
        contacts: &[Contact<S>],
        geometries: &mut Vec<ContactGeometry>,
    ) -> Result<(), StepError> {
        self.step(start, end)?;
        let topology = self.topology();
        contacts.iter().try_for_each(|contact| check_contact(topology, contact))?;
        self.workers
            .run(|| parallel::fill(geometries, contacts, |contact| geometry_of(topology, [start, end], contact)));
        Ok(())
    }

    /// Replaces `near` by all pairs of a mesh at rest that are within `distance` of each other, with their closest points. Use
    /// them for contact forces.
    ///
    /// Pairs ascend by kind and numbers, vertex–face pairs first. Pairs that share a vertex are left out. **No pair is missed.**
    /// A pair that is farther away by up to 2⁻¹⁹ of the distance and a rounding error may be among them; each has the
    /// [range](Geometry::distance) of its distance.
    ///
    /// ```
    /// use selvedge::{CollisionDetector, Topology};
    ///
    /// let mut detector = CollisionDetector::<f32>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    /// let positions = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, 0.5], [1.0, 1.0, 2.0], [2.0, 1.0, 2.0]];
    /// let mut near = Vec::new();
    /// detector.near(&positions, 1.0, &mut near)?;
    /// assert_eq!(near.len(), 1);
    /// assert_eq!(near[0].vertices, [3, 0, 1, 2]);
    /// assert_eq!(near[0].geometry.weights, [1.0, 0.5, 0.25, 0.25]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts). Also returns an error if the distance is negative, infinite or NaN.
    pub fn near<P: Position<Scalar = S>>(
        &mut self,
        positions: &[P],
        distance: S,
        near: &mut Vec<ContactGeometry>,
    ) -> Result<(), StepError> {
        check_length(distance)?;
        let step = self.step(positions, positions)?;
        let limits = Limits {
            separation: distance,
            ..Criterion::default().limits()
        };
        let distance = limits_in_f64(&limits).separation;
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        self.engine
            .candidates(&self.workers, &step, distance, false, [&mut vertex_face, &mut edge_edge]);
        self.engine.result()?;
        near.clear();
        let topology = self.engine.topology();
        let error = GapError::from_largest_coordinate(largest_coordinate(positions).to_f64());
        let mut pairs = Vec::new();
        for (kind, candidates) in [(PairKind::VertexFace, vertex_face), (PairKind::EdgeEdge, edge_edge)] {
            // Most pairs are farther away than their boxes, and need no geometry.
            self.workers.run(|| {
                let is_near = |pair: &[u32; 2]| {
                    let points = topology
                        .vertices_of(kind, *pair)
                        .map(|vertex| exactly(positions[vertex as usize]));
                    let direction = ClosestPoints::from_points(kind, points).direction;
                    let is_farther = distance_from_below(kind, points, direction, error) > distance;
                    !is_farther
                };
                parallel::gather(&mut pairs, &candidates, |chunk, near| {
                    near.extend(chunk.iter().copied().filter(is_near));
                });
            });
            self.engine.pairs.stop.stores(pairs.len() * size_of::<ContactGeometry>());
            self.engine.result()?;
            pairs.sort_unstable();
            let mut found = Vec::new();
            self.workers.run(|| {
                parallel::fill(&mut found, &pairs, |&pair| {
                    let at_start = Contact {
                        kind,
                        pair,
                        time: S::default(),
                    };
                    geometry_of(topology, [positions; 2], &at_start)
                });
            });
            near.extend(found.into_iter().filter(|found| {
                let is_farther = found.geometry.distance[0] > distance;
                !is_farther
            }));
        }
        Ok(())
    }
}

fn check_contact<S: Scalar>(topology: &Topology, contact: &Contact<S>) -> Result<(), StepError> {
    if !(contact.time >= S::ZERO && contact.time <= S::ONE) {
        let time = contact.time.to_f64();
        return Err(StepError::BadTime { time });
    }
    check_pair(topology, contact.kind, contact.pair)
}

/// Returns the geometry of a pair of the mesh.
fn geometry_of<P: Position>(topology: &Topology, [start, end]: [&[P]; 2], contact: &Contact<P::Scalar>) -> ContactGeometry {
    let &Contact { kind, pair, time } = contact;
    let vertices = topology.vertices_of(kind, pair);
    let motions = vertices.map(|vertex| Motion::new(exactly(start[vertex as usize]), exactly(end[vertex as usize])));
    ContactGeometry {
        kind,
        pair,
        vertices,
        geometry: geometry(&PrimitivePair { kind, motions }, time.to_f64()),
    }
}
