//! Points that move on a straight line during the step, and primitive pairs of them.

use crate::kind::PairKind;
use crate::scalar::{Position, Scalar};

/// A point that moves from `start` (time 0) to `end` (time 1) at constant velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion<S: Scalar> {
    /// The position at time 0.
    pub start: S::Vector,
    /// The position at time 1.
    pub end: S::Vector,
}

impl<S: Scalar> Motion<S> {
    /// Makes a motion from `start` to `end`.
    #[inline]
    pub const fn new<P: Position<Scalar = S>>(start: P, end: P) -> Self
    where
        S: Scalar<Vector = P>,
    {
        Self { start, end }
    }

    /// Makes a point that rests at `position`.
    #[inline]
    pub const fn resting<P: Position<Scalar = S>>(position: P) -> Self
    where
        S: Scalar<Vector = P>,
    {
        Self::new(position, position)
    }

    /// Returns the position at a time in [0, 1] of the step. Rounding included, it lies in the box of the two ends, and is
    /// exactly one of them at 0 and at 1. Along each axis the error is at most 8u times the larger coordinate.
    ///
    /// ```
    /// use selvedge_core::{Motion, glam::DVec3};
    /// assert_eq!(Motion::new(DVec3::ZERO, DVec3::new(1.0, 2.0, -4.0)).at(0.5), DVec3::new(0.5, 1.0, -2.0));
    /// ```
    #[must_use]
    pub fn at(&self, time: S) -> S::Vector {
        let [from, to] = self.ends();
        let mut there = [S::ZERO; 3];
        for axis in 0..3 {
            let (from, to) = (from[axis], to[axis]);
            // This is a weighted sum, since a difference of the two could overflow.
            let between = from * (S::ONE - time) + to * time;
            there[axis] = between.larger(from.smaller(to)).smaller(from.larger(to));
        }
        match time {
            time if time == S::ONE => self.end,
            time if time == S::ZERO => self.start,
            _ => there.into(),
        }
    }

    /// Returns the start and the end as arrays.
    #[inline(always)]
    pub(crate) fn ends(&self) -> [[S; 3]; 2] {
        [self.start.into(), self.end.into()]
    }

    #[inline(always)]
    pub(crate) fn is_finite(&self) -> bool {
        let [[x, y, z], [u, v, w]] = self.ends();
        // `&` instead of `&&` makes six tests without branches.
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

/// Four moving points, as a vertex and a triangle or as two edges.
///
/// Each side is a closed convex set, the hull of its moving points: a triangle includes its border, an edge its ends. The pair
/// touches when the two sets share a point.
///
/// ```
/// use selvedge_core::{glam::Vec3, Motion, PairKind, PrimitivePair};
/// let pair = PrimitivePair::<f32>::vertex_face(
///     Motion::from(([0.2, 0.2, 1.0], [0.2, 0.2, -1.0])),
///     [Vec3::ZERO, Vec3::X, Vec3::Y].map(Motion::resting),
/// );
/// assert_eq!(pair.kind, PairKind::VertexFace);
/// assert_eq!(pair.motions[0].start, Vec3::new(0.2, 0.2, 1.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrimitivePair<S: Scalar> {
    /// The kind of the pair.
    pub kind: PairKind,
    /// The points of one set, then those of the other: vertex, face; or first edge, second edge.
    pub motions: [Motion<S>; 4],
}

impl<S: Scalar> PrimitivePair<S> {
    /// Makes a pair from the motions of its four points.
    #[inline(always)]
    #[must_use]
    pub const fn new(kind: PairKind, motions: [Motion<S>; 4]) -> Self {
        Self { kind, motions }
    }

    /// Makes a pair of a vertex and a triangle, given by its three vertices.
    #[inline(always)]
    #[must_use]
    pub const fn vertex_face(vertex: Motion<S>, [a, b, c]: [Motion<S>; 3]) -> Self {
        Self::new(PairKind::VertexFace, [vertex, a, b, c])
    }

    /// Makes a pair of two edges, each given by its two ends.
    #[inline(always)]
    #[must_use]
    pub const fn edge_edge([u, v]: [Motion<S>; 2], [k, l]: [Motion<S>; 2]) -> Self {
        Self::new(PairKind::EdgeEdge, [u, v, k, l])
    }

    /// Returns the points of the first set and those of the second.
    #[inline(always)]
    #[must_use]
    pub const fn sets(&self) -> [&[Motion<S>]; 2] {
        match (self.kind, &self.motions) {
            (PairKind::VertexFace, [vertex, face @ ..]) => [core::slice::from_ref(vertex), face],
            (PairKind::EdgeEdge, [first @ .., _, _]) => {
                let [_, _, second @ ..] = &self.motions;
                [first, second]
            }
        }
    }

    /// Returns the same pair in `f64`, exactly.
    #[inline]
    #[must_use]
    pub fn widened(&self) -> PrimitivePair<f64> {
        let widened = |position: S::Vector| {
            let coordinates: [S; 3] = position.into();
            coordinates.map(S::to_f64).into()
        };
        let motions = self
            .motions
            .map(|motion| Motion::new(widened(motion.start), widened(motion.end)));
        PrimitivePair::new(self.kind, motions)
    }
}
