//! A pair's four points in lanes, and what tells a vertex–face pair from an edge–edge pair.

use crate::coplanarity::MovingTetrahedron;
use crate::kind::PairKind;
use crate::lanes::{Lanes, Rounding};
use crate::vector::Vector;

/// Four points at the start and at the end of the step: those of one set, then those of the other.
///
/// VF: vertex, face. EE: first edge, second edge.
#[derive(Clone, Copy, Debug)]
pub struct PairPoints<L> {
    /// Positions at time 0.
    pub start: [Vector<L>; 4],
    /// Positions at time 1.
    pub end: [Vector<L>; 4],
}

/// Which of four points belong together, as a type: [`VertexAndFace`] or [`EdgeAndEdge`].
pub trait PairShape {
    /// The same as a value.
    const KIND: PairKind;

    /// The smallest and largest value over each set's points, given one value for each point. NaN may be dropped.
    fn ranges<L: Lanes>(values: [L; 4]) -> [[L; 2]; 2];

    /// The points in the roles a, b, c, p of the signed volume ([`coplanarity`](crate::coplanarity)).
    fn volume_points<T>(points: [T; 4]) -> [T; 4];

    /// The differences of a point of one set and a point of the other: three for VF (the first twice), four for EE. The
    /// sets touch exactly when 0 lies in their convex hull.
    fn corners<L: Lanes>(points: [Vector<L>; 4]) -> [Vector<L>; 4];
}

/// One point against three.
#[derive(Clone, Copy, Debug)]
pub enum VertexAndFace {}

/// Two points against two.
#[derive(Clone, Copy, Debug)]
pub enum EdgeAndEdge {}

impl PairShape for VertexAndFace {
    const KIND: PairKind = PairKind::VertexFace;

    #[inline(always)]
    fn ranges<L: Lanes>([vertex, a, b, c]: [L; 4]) -> [[L; 2]; 2] {
        [[vertex; 2], [a.smaller(b).smaller(c), a.larger(b).larger(c)]]
    }

    /// a, b, c are the face and p the vertex.
    #[inline(always)]
    fn volume_points<T>([vertex, a, b, c]: [T; 4]) -> [T; 4] {
        [a, b, c, vertex]
    }

    #[inline(always)]
    fn corners<L: Lanes>([vertex, a, b, c]: [Vector<L>; 4]) -> [Vector<L>; 4] {
        [vertex - a, vertex - a, vertex - b, vertex - c]
    }
}

impl PairShape for EdgeAndEdge {
    const KIND: PairKind = PairKind::EdgeEdge;

    #[inline(always)]
    fn ranges<L: Lanes>([u, v, k, l]: [L; 4]) -> [[L; 2]; 2] {
        [[u.smaller(v), u.larger(v)], [k.smaller(l), k.larger(l)]]
    }

    /// With edges (u, v) and (k, l): a = k, b = u, c = v, p = l (the paper, equations 5 to 11).
    #[inline(always)]
    fn volume_points<T>([u, v, k, l]: [T; 4]) -> [T; 4] {
        [k, u, v, l]
    }

    #[inline(always)]
    fn corners<L: Lanes>([u, v, k, l]: [Vector<L>; 4]) -> [Vector<L>; 4] {
        [u - k, u - l, v - k, v - l]
    }
}

impl<L: Lanes> PairPoints<L> {
    /// The four points as a tetrahedron that is flat whenever they are coplanar.
    #[inline(always)]
    #[must_use]
    pub fn tetrahedron<P: PairShape>(&self) -> MovingTetrahedron<L> {
        MovingTetrahedron::from_points(P::volume_points(self.start), P::volume_points(self.end))
    }

    /// True only where all 24 coordinates are finite. (Also false where their sum overflows.)
    ///
    /// A sum is NaN or infinite if a term is: two dozen additions, without a branch, cost less than as many tests.
    #[inline(always)]
    #[must_use]
    pub fn is_finite(&self) -> L::Mask {
        let [a, b, c, d] = self.start;
        let [e, f, g, h] = self.end;
        let sum = ((a + e) + (b + f)) + ((c + g) + (d + h));
        let sum = (sum.x + sum.y) + sum.z;
        sum.splat(L::Scalar::INFINITY).greater(sum.abs())
    }
}
