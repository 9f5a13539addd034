//! Whether a pair touches at some time in [0, 1]: the answer, without rounding and without tolerance.
//!
//! # At one time
//! The two sets touch when the hull of the pair's corners contains the origin: a triangle (VF) or a parallelogram (EE) with corners
//! e₁ … e_N in order. That is so exactly if
//! 1. the origin is in a plane with them: the signed volume K = e₁·(e₂ × e₃), which is that of [`kernel`], is zero;
//! 2. along no axis do the cross products e₁×e₂, e₂×e₃, …, e_N×e₁ have components of both signs;
//! 3. along no axis do all corners have coordinates of one strict sign.
//!
//! Each is necessary: a polygon that contains the origin turns around it, if at all, in one sense, in projection too; and has no side
//! of any plane through it to itself. They suffice. Where the polygon has an area, one component of its normal is not zero, and
//! projection along that axis loses nothing; the cross products add up to twice the projected area, so they are not all zero, and
//! 2 puts the origin on the inner side of every edge of a convex polygon. Where it has none, the corners are on one line and the cross products add up to zero,
//! so by 2 all of them are: either that line goes through the origin, and 3 says whether it has corners on both sides (or in it),
//! or else neighbours are equal, all corners one point, and 3 says whether that is the origin.
//!
//! So there is no case for parallel edges, edges without length, faces without area. (If along some axis cross products are not
//! all zero, there is an area, and 3 need not be asked.)
//!
//! # At some time
//! Corners are linear in time, cross products quadratic, K cubic.
//! * Start and end are looked at first.
//! * Where K is not zero throughout, contact in between is at one of its roots. Descartes' rule, the number of changes of sign among its
//!   coefficients, says if there is none, or exactly one. If there may be more, the roots of the derivative divide the step into
//!   parts where K has one root at most: one where it changes sign from end to end; and K may be zero at those roots themselves, without changing sign.
//! * Where K is zero throughout, the times of contact are a closed set, whose first time, if it is not 0, is a root
//!   of one of the quadratics or linear polynomials of 2 and 3, all of which are tried.
//!
//! Either way signs are needed of polynomials of degree three at most, at roots of polynomials of degree two at most: see `moment`. At
//! a root of the cubic, the sign of a quadratic follows from where its roots are, before or after; which again are signs of the cubic, and of its derivative, at
//! roots of quadratics. Nothing is isolated, refined, or iterated.
//!
//! # Work
//! What takes time is a sign at a root: about 17 products of numbers of up to nine times a coordinate's words. For a contact at one time
//! as many polynomials are asked as there are in 2 and 3, six for each corner: 24 at most. At a crossing of the cubic a quadratic has two roots to be compared
//! with it, each by one sign, and by two more for either end of the crossing's interval, if it has any, so that a polynomial takes 10 signs; at a
//! root, one. So there are at most
//! * 3·24·10 + 2·(24 + 1) = 770 signs where K is not zero throughout (three crossings, two turning points),
//! * 36·24 = 864 signs where it is (12 roots of linear polynomials, 24 of quadratics).
//!
//! Along one axis alone nearly every contact is settled, with a handful of signs. (A polynomial that is zero throughout takes none.)

mod moment;
mod remainder;
mod rounded;
#[cfg(test)]
mod tests;

use super::aligned::{AlignedPair, Units};
use super::integer::Integer;
use super::kernel::{self, Judge, Width};
use crate::PairKind;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use core::cmp::Ordering;
use core::ops::ControlFlow;
use moment::{Crossing, Moment, Root, sign_before_end};

/// Whether the closed vertex and face, or the two closed edges, share a point at some time in [0, 1].
///
/// Exact for all finite input, in every floating-point environment; `None` if a coordinate is NaN or infinite.
///
/// With most pairs [`contact`](crate::elementary::contact()) has the same answer sooner.
///
/// ```
/// use selvedge_core::{exact, glam::DVec3, points::VertexAndFace, Motion, PrimitivePair, VertexFace};
/// let falls_past = |x| VertexFace {
///     vertex: Motion::new(DVec3::new(x, 0.5, 1.0), DVec3::new(x, 0.5, -1.0)),
///     face: [DVec3::ZERO, DVec3::X, DVec3::ONE].map(Motion::resting),
/// };
/// let touches = |x| exact::touches::<VertexAndFace, _>(&falls_past(x).points());
/// // The face's border belongs to it.
/// assert_eq!(touches(0.5_f64.next_down()), Some(false));
/// assert_eq!(touches(0.5), Some(true));
/// assert_eq!(touches(f64::NAN), None);
/// ```
#[must_use]
pub fn touches<P: PairShape, S: Scalar>(points: &PairPoints<S>) -> Option<bool> {
    let pair = AlignedPair::new::<P, S>(points)?;
    Some(match Width::of(&pair) {
        Width::Words1 => in_words::<P, 1, 2, 3, 16>(&pair),
        Width::Words2 => in_words::<P, 2, 4, 6, 32>(&pair),
        Width::Words5 => in_words::<P, 5, 10, 15, 80>(&pair),
        Width::Words33 => in_words::<P, 33, 66, 99, 528>(&pair),
    })
}

/// With coordinates of `N` words; `N2` = 2·`N`, `N3` = 3·`N`, `R` = 16·`N`.
///
/// Out of line, so that a call pays for the stack of its own width only.
#[inline(never)]
fn in_words<P: PairShape, const N: usize, const N2: usize, const N3: usize, const R: usize>(pair: &AlignedPair) -> bool {
    let mut volume = Volume([Integer::ZERO; 4]);
    // It does not break off.
    let _ = kernel::in_words::<N, N2, N3>(pair, &mut volume);
    let axes = pair.coordinates::<N>();
    match P::KIND {
        PairKind::VertexFace => Polygon::<3, N>::of_vertex_face(&axes).touches::<N3, R>(&volume.0),
        PairKind::EdgeEdge => Polygon::<4, N>::of_edge_edge(&axes).touches::<N3, R>(&volume.0),
    }
}

/// Notes the control values k₀, 3k₁, 3k₂, k₃: the volume's coefficients in s.
struct Volume<const C: usize>([Integer<C>; 4]);

impl<const C: usize> Judge for Volume<C> {
    #[inline(always)]
    fn wants(&self, _: usize) -> bool {
        true
    }

    #[inline(always)]
    fn judge<const N2: usize, const N3: usize>(
        &mut self,
        index: usize,
        value: &Integer<N3>,
        _: impl FnOnce() -> [Integer<N2>; 3],
        _: Units,
    ) -> ControlFlow<()> {
        if let Some(coefficient) = self.0.get_mut(index) {
            *coefficient = value.widened();
        }
        ControlFlow::Continue(())
    }
}

/// One coordinate of a corner, at the start and at the end of the step: the coefficients of a linear polynomial in s.
type Linear<const N: usize> = [Integer<N>; 2];

/// The moving corners of a pair, around the triangle or parallelogram, along each axis.
struct Polygon<const CORNERS: usize, const N: usize>([[Linear<N>; CORNERS]; 3]);

impl<const N: usize> Polygon<3, N> {
    fn of_vertex_face(axes: &[[Integer<N>; 8]; 3]) -> Self {
        Self(axes.each_ref().map(|[p0, a0, b0, c0, p1, a1, b1, c1]| {
            [
                [p0.minus(a0), p1.minus(a1)],
                [p0.minus(b0), p1.minus(b1)],
                [p0.minus(c0), p1.minus(c1)],
            ]
        }))
    }
}

impl<const N: usize> Polygon<4, N> {
    fn of_edge_edge(axes: &[[Integer<N>; 8]; 3]) -> Self {
        Self(axes.each_ref().map(|[u0, v0, k0, l0, u1, v1, k1, l1]| {
            [
                [u0.minus(k0), u1.minus(k1)],
                [u0.minus(l0), u1.minus(l1)],
                [v0.minus(l0), v1.minus(l1)],
                [v0.minus(k0), v1.minus(k1)],
            ]
        }))
    }
}

impl<const CORNERS: usize, const N: usize> Polygon<CORNERS, N> {
    fn touches<const C: usize, const R: usize>(&self, volume: &[Integer<C>; 4]) -> bool {
        let signs = volume.each_ref().map(Integer::sign);
        let [at_start, .., at_end] = signs;
        if at_start.is_eq() && self.touches_at_an_end::<0, C>() || at_end.is_eq() && self.touches_at_an_end::<1, C>() {
            return true;
        }
        let search = Search::<CORNERS, N, C, R>(self);
        match changes_of_sign(signs) {
            _ if signs == [Ordering::Equal; 4] => search.touches_in_plane(),
            0 => false,
            1 => search.touches_when_coplanar(&Crossing::<C, R>::between_ends(volume)),
            _ => search.touches_at_one_of_many(volume),
        }
    }

    /// At the start (`END` = 0) or end (1) of the step, when the origin is in a plane with the corners.
    fn touches_at_an_end<const END: usize, const C: usize>(&self) -> bool {
        contains_origin(
            self,
            |[[a, b], [c, d]]| minor::<N, C>(&a[END], &b[END], &c[END], &d[END]).sign(),
            |coordinate| coordinate[END].sign(),
        )
    }

    /// The corners along the two other axes, for each axis.
    fn projections(&self) -> [[&[Linear<N>; CORNERS]; 2]; 3] {
        let [x, y, z] = &self.0;
        [[y, z], [z, x], [x, y]]
    }
}

/// The coordinates along two axes of a corner and of the next.
type Neighbours<'a, const N: usize> = [[&'a Linear<N>; 2]; 2];

/// All neighbours, around the polygon.
fn neighbours<'a, const CORNERS: usize, const N: usize>(
    [y, z]: [&'a [Linear<N>; CORNERS]; 2],
) -> impl Iterator<Item = Neighbours<'a, N>> {
    let next = |coordinates: &'a [Linear<N>; CORNERS]| coordinates.iter().cycle().skip(1);
    let corners = y.iter().zip(z).zip(next(y).zip(next(z)));
    corners.map(|((y0, z0), (y1, z1))| [[y0, z0], [y1, z1]])
}

/// Conditions 2 and 3 of the module's documentation, at a time when the first is met: given the signs then of neighbours' cross
/// product and of a coordinate.
#[inline(always)]
fn contains_origin<const CORNERS: usize, const N: usize>(
    polygon: &Polygon<CORNERS, N>,
    cross_sign: impl Fn(Neighbours<'_, N>) -> Ordering,
    coordinate_sign: impl Fn(&Linear<N>) -> Ordering,
) -> bool {
    for projection in polygon.projections() {
        let (mut turns_left, mut turns_right) = (false, false);
        for pair in neighbours(projection) {
            let turn = cross_sign(pair);
            turns_left |= turn.is_gt();
            turns_right |= turn.is_lt();
            if turns_left && turns_right {
                return false;
            }
        }
        if turns_left || turns_right {
            return true;
        }
    }
    polygon.0.iter().all(|corners| {
        let mut signs = corners.iter().map(&coordinate_sign);
        let first = signs.next().unwrap_or(Ordering::Equal);
        first.is_eq() || signs.any(|sign| sign != first)
    })
}

/// For contact within the step, at roots of polynomials.
struct Search<'a, const CORNERS: usize, const N: usize, const C: usize, const R: usize>(&'a Polygon<CORNERS, N>);

impl<const CORNERS: usize, const N: usize, const C: usize, const R: usize> Search<'_, CORNERS, N, C, R> {
    /// At a time when the origin is in a plane with the corners.
    fn touches_when_coplanar(&self, moment: &impl Moment<C>) -> bool {
        contains_origin(
            self.0,
            |neighbours| moment.sign(&cross::<N, C>(neighbours)),
            |coordinate| moment.sign(&coordinate.each_ref().map(Integer::widened)),
        )
    }

    /// In a step with several roots of the volume, or one more than once.
    fn touches_at_one_of_many(&self, volume: &[Integer<C>; 4]) -> bool {
        let [k0, k1, k2, k3] = volume;
        let derivative: [Integer<C>; 3] = [*k1, k2.doubled(), k3.doubled().plus(k3)];
        // 3K = s·K′ + this: where the derivative is zero it has the volume's sign.
        let rest: [Integer<C>; 3] = [k0.doubled().plus(k0), k1.doubled(), *k2];
        let turning_points = Root::<C, R>::positive(&derivative);
        let mut crossing = Crossing::between_ends(volume);
        for turning_point in turning_points.iter().flatten() {
            let sign = turning_point.sign(&rest);
            let touches = if sign.is_eq() {
                self.touches_when_coplanar(turning_point)
            } else {
                sign == crossing.sign_before.reverse() && {
                    crossing.before = Some(turning_point);
                    self.touches_when_coplanar(&crossing)
                }
            };
            if touches {
                return true;
            }
            crossing = Crossing {
                cubic: volume,
                after: Some(turning_point),
                before: None,
                sign_before: sign,
            };
        }
        sign_before_end(volume) == crossing.sign_before.reverse() && self.touches_when_coplanar(&crossing)
    }

    /// In a step throughout which the origin is in a plane with the corners.
    fn touches_in_plane(&self) -> bool {
        let touches_at_a_root_of = |polynomial: &[Integer<C>]| {
            let roots = Root::<C, R>::positive(polynomial);
            roots.iter().flatten().any(|root| self.touches_when_coplanar(root))
        };
        let mut coordinates = self.0.0.iter().flatten();
        let mut projections = self.0.projections().into_iter();
        coordinates.any(|coordinate| touches_at_a_root_of(&coordinate.each_ref().map(Integer::widened)))
            || projections
                .any(|projection| neighbours(projection).any(|neighbours| touches_at_a_root_of(&cross::<N, C>(neighbours))))
    }
}

/// a·d − b·c.
fn minor<const N: usize, const C: usize>(a: &Integer<N>, b: &Integer<N>, c: &Integer<N>, d: &Integer<N>) -> Integer<C> {
    a.times::<N, C>(d).minus(&b.times::<N, C>(c))
}

/// One component of the cross product of neighbours, a quadratic in s.
fn cross<const N: usize, const C: usize>([[[a0, a1], [b0, b1]], [[c0, c1], [d0, d1]]]: Neighbours<'_, N>) -> [Integer<C>; 3] {
    [
        minor(a0, b0, c0, d0),
        minor(a0, b0, c1, d1).plus(&minor(a1, b1, c0, d0)),
        minor(a1, b1, c1, d1),
    ]
}

/// How often the sign changes in a row of coefficients.
fn changes_of_sign(signs: [Ordering; 4]) -> u32 {
    let (mut changes, mut last) = (0, Ordering::Equal);
    for sign in signs.into_iter().filter(|sign| sign.is_ne()) {
        changes += u32::from(sign == last.reverse());
        last = sign;
    }
    changes
}
