//! Whether a pair touches at some time in [0, 1]: the answer, without rounding and without tolerance.
//!
//! # At one time
//! The two sets touch when the hull of the pair's corners contains the origin: a triangle (VF) or a parallelogram (EE) with corners
//! e₁ … e_N in order. That is so exactly if
//! 1. the origin is in a plane with them: K = e₁·(e₂ × e₃) is zero;
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
//! Along one axis alone nearly every contact is settled, with a handful of signs.

mod moment;
#[cfg(test)]
mod tests;
mod whole;

use super::aligned::AlignedPair;
use super::integer::Integer;
use super::kernel::bits_in;
use crate::points::{PairPoints, PairShape, Shape};
use crate::scalar::Scalar;
use core::cmp::Ordering;
use moment::{Crossing, End, Moment, Root, Start, sign_after_start, sign_before_end};
use whole::Whole;

/// Whether the closed vertex and face, or the two closed edges, share a point at some time in [0, 1].
///
/// Exact for all finite input, in every floating-point environment; `None` if a coordinate is NaN or infinite.
///
/// With most pairs [`contact`](crate::elementary::contact) has the same answer sooner.
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
    let bits = pair.bits();
    Some(if bits <= bits_in::<1>() {
        in_words::<P, 1, 3, 16>(&pair)
    } else if bits <= bits_in::<2>() {
        in_words::<P, 2, 6, 32>(&pair)
    } else if bits <= bits_in::<5>() {
        in_words::<P, 5, 15, 80>(&pair)
    } else {
        in_words::<P, 33, 99, 528>(&pair)
    })
}

/// With coordinates of `N` words; `C` = 3·`N`, `R` = 16·`N`.
///
/// Out of line, so that a call pays for the stack of its own width only.
#[inline(never)]
fn in_words<P: PairShape, const N: usize, const C: usize, const R: usize>(
    pair: &AlignedPair,
) -> bool {
    let axes = pair.coordinates::<N>();
    match P::SHAPE {
        Shape::VertexFace => Polygon::<3, C, R>::of_vertex_face(&axes).touches(),
        Shape::EdgeEdge => Polygon::<4, C, R>::of_edge_edge(&axes).touches(),
    }
}

/// A polynomial in s = t/(1 − t) of degree 1, 2 or 3: see `moment`.
type Linear<const C: usize> = [Whole<C>; 2];
type Quadratic<const C: usize> = [Whole<C>; 3];
type Cubic<const C: usize> = [Whole<C>; 4];

/// The moving corners of a pair, around the triangle or parallelogram, along each axis; with `R` words to work with.
struct Polygon<const CORNERS: usize, const C: usize, const R: usize>([[Linear<C>; CORNERS]; 3]);

impl<const C: usize, const R: usize> Polygon<3, C, R> {
    fn of_vertex_face<const N: usize>(axes: &[[Integer<N>; 8]; 3]) -> Self {
        Self(axes.each_ref().map(|[p0, a0, b0, c0, p1, a1, b1, c1]| {
            [
                corner([p0, a0], [p1, a1]),
                corner([p0, b0], [p1, b1]),
                corner([p0, c0], [p1, c1]),
            ]
        }))
    }
}

impl<const C: usize, const R: usize> Polygon<4, C, R> {
    fn of_edge_edge<const N: usize>(axes: &[[Integer<N>; 8]; 3]) -> Self {
        Self(axes.each_ref().map(|[u0, v0, k0, l0, u1, v1, k1, l1]| {
            [
                corner([u0, k0], [u1, k1]),
                corner([u0, l0], [u1, l1]),
                corner([v0, l0], [v1, l1]),
                corner([v0, k0], [v1, k1]),
            ]
        }))
    }
}

/// The difference of two points, at the start and at the end.
fn corner<const N: usize, const C: usize>(
    [p0, q0]: [&Integer<N>; 2],
    [p1, q1]: [&Integer<N>; 2],
) -> Linear<C> {
    [Whole::new(&p0.minus(q0)), Whole::new(&p1.minus(q1))]
}

impl<const CORNERS: usize, const C: usize, const R: usize> Polygon<CORNERS, C, R> {
    fn touches(&self) -> bool {
        let volume = self.volume();
        if self.touches_at(&Start, &volume) || self.touches_at(&End, &volume) {
            return true;
        }
        if volume.iter().all(Whole::is_zero) {
            return self.touches_in_plane();
        }
        match changes_of_sign(&volume) {
            0 => false,
            1 => self.touches_when_coplanar(&Crossing::<C, R> {
                cubic: &volume,
                after: None,
                before: None,
                sign_before: sign_after_start(&volume),
            }),
            _ => self.touches_at_one_of_many(&volume),
        }
    }

    fn touches_at(&self, moment: &impl Moment<C>, volume: &Cubic<C>) -> bool {
        moment.sign(volume).is_eq() && self.touches_when_coplanar(moment)
    }

    /// At a time when the origin is in a plane with the corners.
    fn touches_when_coplanar(&self, moment: &impl Moment<C>) -> bool {
        for [y, z] in self.projections() {
            let (mut turns_left, mut turns_right) = (false, false);
            for ((y0, z0), (y1, z1)) in y.iter().zip(z).zip(around(y).zip(around(z))) {
                match moment.sign(&cross(y0, z0, y1, z1)) {
                    Ordering::Less => turns_right = true,
                    Ordering::Equal => {}
                    Ordering::Greater => turns_left = true,
                }
                if turns_left && turns_right {
                    return false;
                }
            }
            if turns_left || turns_right {
                return true;
            }
        }
        self.0.iter().all(|corners| {
            let mut signs = corners.iter().map(|corner| moment.sign(corner));
            let first = signs.next().unwrap_or(Ordering::Equal);
            first.is_eq() || signs.any(|sign| sign != first)
        })
    }

    /// In a step with several roots of the volume, or one more than once.
    fn touches_at_one_of_many(&self, volume: &Cubic<C>) -> bool {
        let [k0, k1, k2, k3] = volume;
        let derivative: Quadratic<C> = [*k1, k2.times_small(2), k3.times_small(3)];
        // 3K = s·K′ + this: where the derivative is zero it has the volume's sign.
        let rest: Quadratic<C> = [k0.times_small(3), k1.times_small(2), *k2];
        let turning_points = Root::<C, R>::positive(&derivative);
        let mut after = None;
        let mut sign_before = sign_after_start(volume);
        for turning_point in turning_points.iter().flatten() {
            let sign = turning_point.sign(&rest);
            let touches = if sign.is_eq() {
                self.touches_when_coplanar(turning_point)
            } else {
                sign == sign_before.reverse()
                    && self.touches_when_coplanar(&Crossing {
                        cubic: volume,
                        after,
                        before: Some(turning_point),
                        sign_before,
                    })
            };
            if touches {
                return true;
            }
            (after, sign_before) = (Some(turning_point), sign);
        }
        sign_before_end(volume) == sign_before.reverse()
            && self.touches_when_coplanar(&Crossing {
                cubic: volume,
                after,
                before: None,
                sign_before,
            })
    }

    /// In a step throughout which the origin is in a plane with the corners.
    fn touches_in_plane(&self) -> bool {
        let touches_at_a_root_of = |polynomial: &[Whole<C>]| {
            Root::<C, R>::positive(polynomial)
                .iter()
                .flatten()
                .any(|root| self.touches_when_coplanar(root))
        };
        self.0.iter().flatten().any(|c| touches_at_a_root_of(c))
            || self.projections().iter().any(|[y, z]| {
                let corners = y.iter().zip(*z).zip(around(y).zip(around(z)));
                corners
                    .into_iter()
                    .any(|((y0, z0), (y1, z1))| touches_at_a_root_of(&cross(y0, z0, y1, z1)))
            })
    }

    /// The corners along the two other axes, for each axis.
    fn projections(&self) -> [[&[Linear<C>; CORNERS]; 2]; 3] {
        let [x, y, z] = &self.0;
        [[y, z], [z, x], [x, y]]
    }

    /// The determinant of the first three corners.
    fn volume(&self) -> Cubic<C> {
        let mut volume = [Whole::ZERO; 4];
        for (x, [y, z]) in self.0.iter().zip(self.projections()) {
            if let ([x0, ..], [_, y1, y2, ..], [_, z1, z2, ..]) =
                (x.as_slice(), y.as_slice(), z.as_slice())
            {
                let normal = cross(y1, z1, y2, z2);
                for (i, factor) in x0.iter().enumerate() {
                    for (j, component) in normal.iter().enumerate() {
                        if let Some(sum) = volume.get_mut(i + j) {
                            *sum = sum.plus(&factor.times::<C, C>(component));
                        }
                    }
                }
            }
        }
        volume
    }
}

/// The corners, beginning with the second and ending with the first.
fn around<T, const N: usize>(corners: &[T; N]) -> impl Iterator<Item = &T> {
    corners.iter().cycle().skip(1)
}

/// One component of the cross product of two corners.
fn cross<const C: usize>(
    [a0, a1]: &Linear<C>,
    [b0, b1]: &Linear<C>,
    [c0, c1]: &Linear<C>,
    [d0, d1]: &Linear<C>,
) -> Quadratic<C> {
    let minor = |a: &Whole<C>, b: &Whole<C>, c: &Whole<C>, d: &Whole<C>| -> Whole<C> {
        a.times::<C, C>(d).minus(&b.times::<C, C>(c))
    };
    [
        minor(a0, b0, c0, d0),
        minor(a0, b1, c0, d1).plus(&minor(a1, b0, c1, d0)),
        minor(a1, b1, c1, d1),
    ]
}

/// How often the sign changes in a row of coefficients.
fn changes_of_sign<const C: usize>(polynomial: &[Whole<C>]) -> u32 {
    let (mut changes, mut last) = (0, Ordering::Equal);
    for sign in polynomial.iter().map(Whole::sign).filter(|s| s.is_ne()) {
        changes += u32::from(sign == last.reverse() && last.is_ne());
        last = sign;
    }
    changes
}
