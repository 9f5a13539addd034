//! A pair's four points in lanes, and the differences between vertex–face and edge–edge pairs.

use crate::coplanarity::MovingTetrahedron;
use crate::kind::PairKind;
use crate::lanes::{Lanes, Rounding};
use crate::motion::PrimitivePair;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// Four points at the start and at the end of the step: the points of one set, then those of the other.
///
/// VF is a vertex and a face; EE is the first and the second edge.
#[derive(Clone, Copy, Debug)]
pub struct PairPoints<L> {
    /// The positions at time 0.
    pub start: [Vector<L>; 4],
    /// The positions at time 1.
    pub end: [Vector<L>; 4],
}

/// A [`PairKind`] that the compiler knows: [`VertexFace`] or [`EdgeEdge`].
pub trait PairShape {
    /// The kind as a value.
    const KIND: PairKind;

    /// Returns the smallest and largest value over each set's points, given one value for each point. NaN may be dropped.
    fn ranges<L: Lanes>(values: [L; 4]) -> [[L; 2]; 2];

    /// Returns the points in the roles a, b, c, p of the signed volume ([`coplanarity`](crate::coplanarity)).
    fn volume_points<T>(points: [T; 4]) -> [T; 4];

    /// Returns the differences of a point of one set and a point of the other: three for VF (the first twice), four for EE. The
    /// sets touch exactly when 0 lies in their convex hull.
    fn corners<L: Lanes>(points: [Vector<L>; 4]) -> [Vector<L>; 4];

    /// Returns a multiple of the vector from the middle of the second set to that of the first.
    fn between_middles<L: Lanes>(points: [Vector<L>; 4]) -> Vector<L>;
}

/// A vertex and a face: one point and three.
#[derive(Clone, Copy, Debug)]
pub enum VertexFace {}

/// Two edges: two points and two.
#[derive(Clone, Copy, Debug)]
pub enum EdgeEdge {}

impl PairShape for VertexFace {
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

    #[inline(always)]
    fn between_middles<L: Lanes>([vertex, a, b, c]: [Vector<L>; 4]) -> Vector<L> {
        vertex.scaled(vertex.x.splat(L::Scalar::small(3))) - (a + b + c)
    }
}

impl PairShape for EdgeEdge {
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

    #[inline(always)]
    fn between_middles<L: Lanes>([u, v, k, l]: [Vector<L>; 4]) -> Vector<L> {
        (u + v) - (k + l)
    }
}

/// Selects code by a kind that is known at run time: `of_kind!(kind, P => code)`, where `P` is the [`PairShape`] of the kind.
///
/// This is the only way from a [`PairKind`] to code that is compiled for each kind.
#[macro_export]
macro_rules! of_kind {
    ($kind:expr, $pair:ident => $code:expr) => {
        match $kind {
            $crate::PairKind::VertexFace => {
                type $pair = $crate::kernels::points::VertexFace;
                $code
            }
            $crate::PairKind::EdgeEdge => {
                type $pair = $crate::kernels::points::EdgeEdge;
                // Both arms begin with the same loads. Without this, LLVM moves them ahead of the branch, where registers do not
                // suffice.
                ::core::hint::black_box(());
                $code
            }
        }
    };
}

impl<S: Scalar> From<&PrimitivePair<S>> for PairPoints<S> {
    #[inline(always)]
    fn from(pair: &PrimitivePair<S>) -> Self {
        // The calls are written out, since `map` with a closure is not always inlined.
        let [a, b, c, d] = &pair.motions;
        let vector = |position: S::Vector| Vector::from(position.into());
        Self {
            start: [vector(a.start), vector(b.start), vector(c.start), vector(d.start)],
            end: [vector(a.end), vector(b.end), vector(c.end), vector(d.end)],
        }
    }
}

impl<S: Scalar> From<&PrimitivePair<S>> for MovingTetrahedron<S> {
    #[inline(always)]
    fn from(pair: &PrimitivePair<S>) -> Self {
        of_kind!(pair.kind, P => PairPoints::from(pair).tetrahedron::<P>())
    }
}

impl<L: Lanes> PairPoints<L> {
    /// Returns the four points as a tetrahedron that is flat whenever they are coplanar.
    #[inline(always)]
    #[must_use]
    pub fn tetrahedron<P: PairShape>(&self) -> MovingTetrahedron<L> {
        MovingTetrahedron::from_points(P::volume_points(self.start), P::volume_points(self.end))
    }

    /// Returns true only where all 24 coordinates are finite. It is also false where their sum overflows.
    ///
    /// A sum is NaN or infinite if a term is. Two dozen additions without a branch cost less than as many tests.
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
