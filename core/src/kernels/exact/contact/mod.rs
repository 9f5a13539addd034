//! The exact decision whether a pair touches at some time in [0, 1], without rounding and without tolerance.
//!
//! # At one time
//! The two sets touch when the hull of the pair's corners contains the origin: a triangle (VF) or a parallelogram (EE) with
//! corners e₁ … e_N in order. That is so exactly if
//! 1. the origin is in a plane with them: the signed volume K = e₁·(e₂ × e₃), which is that of [`kernel`], is zero;
//! 2. along no axis do the cross products e₁×e₂, e₂×e₃, …, e_N×e₁ have components of both signs;
//! 3. along no axis do all corners have coordinates of one strict sign.
//!
//! Each condition is necessary. A polygon that contains the origin turns around it, if at all, in one sense, in projection too.
//! It does not lie strictly on one side of any plane through the origin. They are also sufficient. If the polygon has an area,
//! one component of its normal is not zero, and projection along that axis loses nothing. The cross products add up to twice the
//! projected area, so they are not all zero. So 2 puts the origin on the inner side of every edge of a convex polygon. If it has
//! no area, the corners are on one line and the cross products add up to zero. So by 2 all of them are zero. If that line passes
//! through the origin, 3 decides whether it has corners on both sides or at it. Otherwise neighbours are equal, all corners are
//! one point, and 3 decides whether that is the origin.
//!
//! So there are no special cases for parallel edges, edges without length, or faces without area. (If along some axis cross
//! products are not all zero, there is an area, and 3 is not needed.)
//!
//! # At some time
//! Corners are linear in time, cross products quadratic, K cubic.
//! * Start and end are tested first.
//! * If K is not zero throughout, contact in between is at one of its roots. Descartes' rule, the number of changes of sign among
//!   its coefficients, shows if there is none, or exactly one. If there may be more, the roots of the derivative divide the step
//!   into parts in which K has at most one root. It has one if it changes sign from end to end. K may also be zero at those roots
//!   themselves, without changing sign.
//! * If K is zero throughout, the times of contact are a closed set. Its first time, if it is not 0, is a root of one of the
//!   quadratics or linear polynomials of 2 and 3. All of them are tried.
//!
//! Both need signs of polynomials of degree at most three, at roots of polynomials of degree at most two: see `moment`. At a root
//! of the cubic, the sign of a quadratic follows from the position of its roots, before or after. These are signs of the cubic,
//! and of its derivative, at roots of quadratics. Nothing is isolated, refined, or iterated.
//!
//! # Work
//! The costly step is a sign at a root: about 17 products of numbers of up to nine times a coordinate's words. A contact at one
//! time needs the polynomials of 2 and 3, six for each corner: at most 24. At a crossing of the cubic, a quadratic has two roots
//! to compare with it. Each takes one sign, and two more for either end of the crossing's interval, if it has any. So a
//! polynomial takes 10 signs; at a root, one. So there are at most
//! * 3·24·10 + 2·(24 + 1) = 770 signs where K is not zero throughout (three crossings, two turning points),
//! * 36·24 = 864 signs where it is (12 roots of linear polynomials, 24 of quadratics).
//!
//! Nearly every contact is settled along one axis, with a handful of signs. (A polynomial that is zero throughout takes none.)

mod moment;
mod remainder;
mod rounded;
#[cfg(test)]
mod tests;

use super::aligned::AlignedPair;
use super::integer::{Space, Whole, Words};
use super::kernel::{self, Arithmetic, Fixed, Width, control_values};
use crate::PairKind;
use crate::motion::PrimitivePair;
use crate::scalar::Scalar;
use core::cmp::Ordering;
use moment::{Crossing, End, ExactTime, Root, sign_before_end};

/// Returns whether the closed vertex and face, or the two closed edges, share a point at some time in [0, 1].
///
/// The result is exact for all finite input, in every floating-point environment. It is `None` if a coordinate is NaN or
/// infinite.
///
/// For most pairs, [`contact`](crate::elementary::contact()) returns the same answer sooner.
///
/// ```
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// use selvedge_core::kernels::exact;
/// let falls_past = |x| PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(x, 0.5, 1.0), DVec3::new(x, 0.5, -1.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::ONE].map(Motion::resting),
/// );
/// let touches = |x| exact::touches(&falls_past(x));
/// // The face's border belongs to it.
/// assert_eq!(touches(0.5_f64.next_down()), Some(false));
/// assert_eq!(touches(0.5), Some(true));
/// assert_eq!(touches(f64::NAN), None);
/// ```
#[must_use]
pub fn touches<S: Scalar>(pair: &PrimitivePair<S>) -> Option<bool> {
    AlignedPair::new(pair).map(|pair| touches_aligned(&pair))
}

/// Returns the number of words that the search needs with coordinates of `N` words, without corners and volume. The derivative,
/// the polynomial in place of the volume, and the roots take nine numbers of 3·N + 2. A cross product takes 10·N + 6, its roots
/// 6·N + 6, twice a coefficient 3·N + 3. The largest of `moment`'s numbers takes 126·N + 30.
const fn space(n: usize) -> usize {
    9 * (3 * n + 2) + 10 * n + 6 + 6 * n + 6 + 3 * n + 3 + 126 * n + 30
}

fn touches_aligned(pair: &AlignedPair) -> bool {
    match Width::of(pair) {
        Width::Words1 => in_words::<1, 2, 3, { space(1) }>(pair),
        Width::Words2 => in_words::<2, 4, 6, { space(2) }>(pair),
        Width::Words5 => in_words::<5, 10, 15, { space(5) }>(pair),
        Width::Words33 => in_space(pair),
    }
}

/// Decides with coordinates of `N` words; `N2` = 2·`N`, `N3` = 3·`N`, and `WORDS` of space.
///
/// It is out of line, like the next, so that a call takes the stack of its own width only.
#[inline(never)]
fn in_words<const N: usize, const N2: usize, const N3: usize, const WORDS: usize>(pair: &AlignedPair) -> bool {
    let mut arithmetic = Fixed::<N, N2, N3>;
    let coordinates = arithmetic.coordinates(pair);
    let volume = control_values(pair.kind, &coordinates, &mut arithmetic);
    if is_never_zero(volume.each_ref().map(Whole::sign)) {
        return false;
    }
    let corners = corners(pair.kind, &coordinates, &mut arithmetic);
    let polygon = Polygon::new(pair.kind, &corners);
    polygon.touches(volume.each_ref().map(Whole::words), &mut Space::new(&mut [0; WORDS]))
}

/// Decides with coordinates of 33 words, all numbers in a space: corners take 24 of 34 words.
#[inline(never)]
fn in_space(pair: &AlignedPair) -> bool {
    let mut words = [0; kernel::space(33) + 24 * 34 + space(33)];
    let mut space = Space::new(&mut words);
    let coordinates = space.coordinates(pair);
    let volume = control_values(pair.kind, &coordinates, &mut space);
    if is_never_zero(volume.map(Words::sign)) {
        return false;
    }
    let corners = corners(pair.kind, &coordinates, &mut space);
    Polygon::new(pair.kind, &corners).touches(volume, &mut space)
}

/// Returns whether a polynomial with coefficients of these signs is zero at no s in [0, ∞].
fn is_never_zero(signs: [Ordering; 4]) -> bool {
    signs == [Ordering::Less; 4] || signs == [Ordering::Greater; 4]
}

/// The corners around the polygon, with the first again after the last. A triangle has one entry less, and its last is unused.
type Around<T> = [T; 5];

/// Returns each corner's coordinates at the start and at the end, along each axis.
#[inline(always)]
fn corners<A: Arithmetic>(kind: PairKind, axes: &[[A::One; 8]; 3], arithmetic: &mut A) -> [Around<[A::One; 2]>; 3] {
    axes.each_ref().map(|[a0, b0, c0, d0, a1, b1, c1, d1]| {
        let mut minus =
            |[p0, p1]: [&A::One; 2], [q0, q1]: [&A::One; 2]| [arithmetic.difference(p0, q0), arithmetic.difference(p1, q1)];
        let (a, b, c, d) = ([a0, a1], [b0, b1], [c0, c1], [d0, d1]);
        match kind {
            PairKind::VertexFace => {
                let first = minus(a, b);
                [first, minus(a, c), minus(a, d), first, first]
            }
            PairKind::EdgeEdge => {
                let first = minus(a, c);
                [first, minus(a, d), minus(b, d), minus(b, c), first]
            }
        }
    })
}

/// One coordinate of a corner, at the start and at the end of the step: the coefficients of a linear polynomial in s.
type Linear<'a> = [Words<'a>; 2];

/// The moving corners of a pair, around the triangle or parallelogram, along each axis.
struct Polygon<'a> {
    corners: [Around<Linear<'a>>; 3],
    count: usize,
}

impl<'a> Polygon<'a> {
    fn new<T: Whole>(kind: PairKind, corners: &'a [Around<[T; 2]>; 3]) -> Self {
        Self {
            corners: corners
                .each_ref()
                .map(|axis| axis.each_ref().map(|ends| ends.each_ref().map(T::words))),
            count: match kind {
                PairKind::VertexFace => 3,
                PairKind::EdgeEdge => 4,
            },
        }
    }

    fn touches(&self, volume: [Words<'_>; 4], space: &mut Space<'_>) -> bool {
        let signs = volume.map(Words::sign);
        let [at_start, .., at_end] = signs;
        if at_start.is_eq() && self.contains_origin(&End::Start, space)
            || at_end.is_eq() && self.contains_origin(&End::End, space)
        {
            return true;
        }
        match changes_of_sign(signs) {
            _ if signs == [Ordering::Equal; 4] => self.touches_in_plane(space),
            0 => false,
            1 => self.contains_origin(&Crossing::between_ends(volume), space),
            _ => self.touches_at_one_of_many(volume, space),
        }
    }

    fn coordinates(&self) -> impl Iterator<Item = &[Linear<'a>]> {
        self.corners.iter().map(|axis| axis.get(..self.count).unwrap_or_default())
    }

    /// Returns all neighbours around the polygon, along the two other axes for each axis.
    fn projections(&self) -> [impl Iterator<Item = Neighbours<'a>>; 3] {
        let [x, y, z] = &self.corners;
        [[y, z], [z, x], [x, y]].map(|[y, z]| {
            let corners = y.iter().zip(z);
            let next = corners.clone().skip(1);
            corners
                .zip(next)
                .take(self.count)
                .map(|((y0, z0), (y1, z1))| Neighbours([[*y0, *z0], [*y1, *z1]]))
        })
    }

    /// Returns whether the hull of the corners contains the origin, at a time when the corners are coplanar with it.
    fn contains_origin(&self, moment: &dyn ExactTime, space: &mut Space<'_>) -> bool {
        for projection in self.projections() {
            let (mut turns_left, mut turns_right) = (false, false);
            for neighbours in projection {
                let turn = moment.turn(&neighbours, space);
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
        self.coordinates().all(|corners| {
            let mut signs = corners.iter().map(|coordinate| moment.sign(coordinate, space));
            let first = signs.next().unwrap_or(Ordering::Equal);
            first.is_eq() || signs.any(|sign| sign != first)
        })
    }

    /// Decides a step with several roots of the volume, or a multiple one.
    fn touches_at_one_of_many(&self, volume: [Words<'_>; 4], space: &mut Space<'_>) -> bool {
        let mut space = space.scratch();
        let [k0, k1, k2, k3] = volume;
        let derivative = [k1, space.doubled(k2), space.tripled(k3)];
        // The rest is defined by 3K = s·K′ + rest: where the derivative is zero, it has the volume's sign.
        let rest = [space.tripled(k0), space.doubled(k1), k2];
        let turning_points = Root::positive(&derivative, &mut space);
        let mut crossing = Crossing::between_ends(volume);
        for turning_point in turning_points.into_iter().flatten() {
            let sign = turning_point.sign(&rest, &mut space);
            let touches = if sign.is_eq() {
                self.contains_origin(&turning_point, &mut space)
            } else {
                sign == crossing.sign_before.reverse() && {
                    crossing.before = Some(turning_point);
                    self.contains_origin(&crossing, &mut space)
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
        sign_before_end(&volume) == crossing.sign_before.reverse() && self.contains_origin(&crossing, &mut space)
    }

    /// Decides a step throughout which the origin is in a plane with the corners.
    fn touches_in_plane(&self, space: &mut Space<'_>) -> bool {
        self.coordinates()
            .flatten()
            .any(|coordinate| self.touches_at_a_root_of(coordinate, &mut space.scratch()))
            || self.projections().into_iter().flatten().any(|neighbours| {
                let mut space = space.scratch();
                let cross = neighbours.cross(&mut space);
                self.touches_at_a_root_of(&cross, &mut space)
            })
    }

    fn touches_at_a_root_of<'b>(&self, polynomial: &[Words<'b>], space: &mut Space<'b>) -> bool {
        let roots = Root::positive(polynomial, space);
        roots.iter().flatten().any(|root| self.contains_origin(root, space))
    }
}

/// The coordinates of a corner and of the next, along two axes.
struct Neighbours<'a>([[Linear<'a>; 2]; 2]);

impl Neighbours<'_> {
    /// Returns one component of their cross product, a quadratic in s.
    fn cross<'b>(&self, space: &mut Space<'b>) -> [Words<'b>; 3] {
        let Self([[[a0, a1], [b0, b1]], [[c0, c1], [d0, d1]]]) = *self;
        let (one_part, other_part) = (space.minor(a0, b0, c1, d1), space.minor(a1, b1, c0, d0));
        [
            space.minor(a0, b0, c0, d0),
            space.plus(one_part, other_part),
            space.minor(a1, b1, c1, d1),
        ]
    }
}

/// Returns the number of changes of sign in a row of coefficients.
fn changes_of_sign(signs: [Ordering; 4]) -> u32 {
    let (mut changes, mut last) = (0, Ordering::Equal);
    for sign in signs.into_iter().filter(|sign| sign.is_ne()) {
        changes += u32::from(sign == last.reverse());
        last = sign;
    }
    changes
}
