//! Points that move on a straight line during the step, and the two primitive pairs made of them.

use crate::coplanarity::MovingTetrahedron;
use crate::points::{EdgeAndEdge, PairPoints, PairShape, VertexAndFace};
use crate::scalar::{Position, Scalar};
use crate::vector::Vector;

/// A point that moves from `start` (time 0) to `end` (time 1) at constant velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion<S: Scalar> {
    /// Position at time 0.
    pub start: S::Vector,
    /// Position at time 1.
    pub end: S::Vector,
}

impl<S: Scalar> Motion<S> {
    /// From `start` to `end`.
    #[inline]
    pub const fn new<P: Position<Scalar = S>>(start: P, end: P) -> Self
    where
        S: Scalar<Vector = P>,
    {
        Self { start, end }
    }

    /// At the same place throughout.
    #[inline]
    pub const fn resting<P: Position<Scalar = S>>(position: P) -> Self
    where
        S: Scalar<Vector = P>,
    {
        Self::new(position, position)
    }

    /// Start and end as arrays.
    #[inline(always)]
    pub(crate) fn ends(&self) -> [[S; 3]; 2] {
        [self.start.into(), self.end.into()]
    }

    #[inline(always)]
    pub(crate) fn is_finite(&self) -> bool {
        let [[x, y, z], [u, v, w]] = self.ends();
        // `&`, not `&&`: six tests without a branch.
        x.is_finite() & y.is_finite() & z.is_finite() & u.is_finite() & v.is_finite() & w.is_finite()
    }
}

impl From<([f32; 3], [f32; 3])> for Motion<f32> {
    fn from((start, end): ([f32; 3], [f32; 3])) -> Self {
        Self::new(start.into(), end.into())
    }
}

impl From<([f64; 3], [f64; 3])> for Motion<f64> {
    fn from((start, end): ([f64; 3], [f64; 3])) -> Self {
        Self::new(start.into(), end.into())
    }
}

/// A moving vertex and a moving triangle.
///
/// ```
/// use selvedge_core::{glam::Vec3, Motion, VertexFace};
/// let pair = VertexFace::<f32> {
///     vertex: Motion::from(([0.2, 0.2, 1.0], [0.2, 0.2, -1.0])),
///     face: [Vec3::ZERO, Vec3::X, Vec3::Y].map(Motion::resting),
/// };
/// assert_eq!(pair.vertex.start, Vec3::new(0.2, 0.2, 1.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VertexFace<S: Scalar> {
    /// The vertex.
    pub vertex: Motion<S>,
    /// The triangle's three vertices. The triangle is closed: its border belongs to it.
    pub face: [Motion<S>; 3],
}

/// Two moving edges.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EdgeEdge<S: Scalar> {
    /// One edge's two ends. Edges are closed: their ends belong to them.
    pub first: [Motion<S>; 2],
    /// The other edge's two ends.
    pub second: [Motion<S>; 2],
}

mod sealed {
    pub trait Sealed {}
    impl<S: crate::Scalar> Sealed for super::VertexFace<S> {}
    impl<S: crate::Scalar> Sealed for super::EdgeEdge<S> {}
}

/// What [`VertexFace`] and [`EdgeEdge`] have in common. Sealed.
///
/// Both are two closed convex sets, each the hull of its moving points; they touch when the sets share a point.
pub trait PrimitivePair<S: Scalar>: Copy + sealed::Sealed {
    /// Which points belong together.
    type Shape: PairShape;

    /// The points of one set, then those of the other: vertex, face; or first, second edge.
    fn motions(&self) -> [Motion<S>; 4];

    /// The same points, as the kernels take them.
    #[inline(always)]
    fn points(&self) -> PairPoints<S> {
        let motions = self.motions();
        PairPoints {
            start: motions.map(|motion| Vector::from(motion.start.into())),
            end: motions.map(|motion| Vector::from(motion.end.into())),
        }
    }

    /// The four points as a tetrahedron that is flat whenever they are coplanar.
    #[inline(always)]
    fn tetrahedron(&self) -> MovingTetrahedron<S> {
        self.points().tetrahedron::<Self::Shape>()
    }
}

impl<S: Scalar> PrimitivePair<S> for VertexFace<S> {
    type Shape = VertexAndFace;

    #[inline(always)]
    fn motions(&self) -> [Motion<S>; 4] {
        let [a, b, c] = self.face;
        [self.vertex, a, b, c]
    }
}

impl<S: Scalar> PrimitivePair<S> for EdgeEdge<S> {
    type Shape = EdgeAndEdge;

    #[inline(always)]
    fn motions(&self) -> [Motion<S>; 4] {
        let ([u, v], [k, l]) = (self.first, self.second);
        [u, v, k, l]
    }
}
